// What the protocol's fuzzers do with an input: decode it and hold the answer against what must be
// true of every answer; what is not true aborts. The normal tests run the same over the corpus.
//
//   fuzz::request(bytes);
#pragma once

#include <array>
#include <string_view>

namespace poolhall::fuzz {

void request(std::string_view input);         // an agent's line
void json(std::string_view input);            // any JSON text
void framing(std::string_view input);         // two bytes of settings, then a stream
void server_message(std::string_view input);  // a byte for the method, then a server's line
void scene(std::string_view input);           // a scene file
void record(std::string_view input);          // a stored state, event log or ruling
void judge(std::string_view input);           // a document for the referee

struct Target {
  std::string_view name;  // also of its corpus' folder
  void (*run)(std::string_view);
};
inline constexpr std::array targets{
    Target{"request", request}, Target{"json", json},
    Target{"framing", framing}, Target{"server_message", server_message},
    Target{"scene", scene},     Target{"record", record},
    Target{"judge", judge}};

}  // namespace poolhall::fuzz
