// Bytes to lines. Fed with whatever a socket gave, in chunks of any size; keeps at most `limit`
// bytes. A line ends with "\n" or "\r\n" and comes without its end.
//
//   LineSplitter splitter(limits.line_bytes_before_login);
//   for (std::string_view rest = chunk; !rest.empty();) {
//     LineSplitter::Step step = splitter.next(rest);
//     rest = step.rest;
//     if (step.kind == LineSplitter::Kind::line) handle(step.line);
//   }
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace poolhall::protocol {

class LineSplitter {
 public:
  enum class Kind : std::uint8_t {
    more,      // the chunk is used up, no line has ended
    line,      // `line` is complete
    too_long,  // the line has passed the limit: said once, the rest of it is skipped
  };
  struct Step {
    Kind kind = Kind::more;
    std::string_view line;  // valid until the next call and while the chunk is
    std::string_view rest;  // of the chunk
  };

  explicit LineSplitter(std::size_t limit);

  // The most bytes that a line may have from now on, its end not counted.
  void set_limit(std::size_t limit);

  [[nodiscard]] Step next(std::string_view chunk);

  // Whether a line has begun and not ended: the line's deadline runs.
  [[nodiscard]] bool inside_line() const;

 private:
  [[nodiscard]] Step complete(std::string_view tail, std::string_view rest);
  [[nodiscard]] Step grow(std::string_view tail);

  std::size_t limit_;
  std::string pending_;            // of a line that has not ended; at most limit_ + 1 bytes ("\r")
  bool skipping_ = false;          // inside a line that was too long
  bool returned_pending_ = false;  // the last line given out stands in pending_
};

}  // namespace poolhall::protocol
