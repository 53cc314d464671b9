// JSON text that is already made: a shot is serialised once, in a worker thread, and the same
// bytes go to the database and into both agents' messages.
//
//   RawJson state{encode_state(next)};
#pragma once

#include <string>

namespace poolhall::protocol {

struct RawJson {
  std::string text;  // one JSON value, no line ends

  friend bool operator==(const RawJson&, const RawJson&) = default;
};

}  // namespace poolhall::protocol
