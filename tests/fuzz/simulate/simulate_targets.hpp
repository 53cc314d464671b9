// What the simulator's fuzzers do with an input: simulate what it says and hold the result against
// what must be true of every shot; what is not true aborts. The normal tests run the same over the
// corpus.
//
//   fuzz::simulate(bytes);
#pragma once

#include <string_view>

namespace poolhall::fuzz {

void simulate(std::string_view input);  // a scene file, as `poolhall simulate` is given
// Bytes that choose tables, materials and balls from what is hard: touching, frozen to rails, in
// jaws, at denormal and absurd speeds. Most inputs are possible scenes.
void balls(std::string_view input);

}  // namespace poolhall::fuzz
