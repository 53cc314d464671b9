#include "tests/support/session_recorder.hpp"

#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <optional>

#include "protocol/codec.hpp"

namespace poolhall::test_support {
namespace {

std::string file_of_this_session(const char* folder) {
  static std::atomic<int> sessions{0};
  return std::string(folder) + '/' + std::to_string(::getpid()) + '-' + std::to_string(++sessions) +
         ".txt";
}

// The next whole line of what has come, without its end.
std::optional<std::string> take_line(std::string& bytes) {
  const auto end = bytes.find('\n');
  if (end == std::string::npos) {
    return std::nullopt;
  }
  std::string line = bytes.substr(0, end);
  bytes.erase(0, end + 1);
  if (line.ends_with('\r')) {
    line.pop_back();
  }
  return line;
}

// Whether it is a request. A line that is wrong on purpose may be anything, even no text.
bool is_request(const std::string& line) {
  return protocol::decode_request(line, protocol::Limits{}).has_value();
}

}  // namespace

SessionRecorder::SessionRecorder() {
  if (const char* folder = std::getenv("POOLHALL_SESSIONS")) {
    file_.open(file_of_this_session(folder));
  }
}

void SessionRecorder::sent(std::string_view bytes) {
  if (!file_.is_open()) {
    return;
  }
  to_server_ += bytes;
  while (const auto line = take_line(to_server_)) {
    if (is_request(*line)) {
      file_ << "> " << *line << '\n';
    } else {
      file_ << "! " << line->size() << " bytes\n";
    }
  }
}

void SessionRecorder::received(std::string_view bytes) {
  if (!file_.is_open()) {
    return;
  }
  to_agent_ += bytes;
  if (to_agent_.starts_with("HTTP/")) {
    file_.close();  // the page's port: its answers are held against other schemas
    return;
  }
  while (const auto line = take_line(to_agent_)) {
    file_ << "< " << *line << '\n';
  }
}

}  // namespace poolhall::test_support
