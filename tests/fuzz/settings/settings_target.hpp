// What the settings' fuzzer does with an input: reads it as a settings file of the server and of a
// tournament. The normal tests run the same over the corpus.
//
//   fuzz::settings(bytes);
#pragma once

#include <string_view>

namespace poolhall::fuzz {

void settings(std::string_view input);

}  // namespace poolhall::fuzz
