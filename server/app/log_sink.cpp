#include "server/app/log_sink.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <spdlog/details/log_msg.h>
#include <unistd.h>

namespace poolhall::app {
namespace {

// A pipe is writable when it takes a page at once, and a line is shorter.
bool takes_a_line() {
  pollfd standard_error{STDERR_FILENO, POLLOUT, 0};
  return ::poll(&standard_error, 1, 0) > 0;
}

}  // namespace

void LogSink::log(const spdlog::details::log_msg& message) {
  using Base = spdlog::sinks::ansicolor_stderr_sink_mt;
  if (!takes_a_line()) {
    ++dropped_;
    return;
  }
  if (const std::uint64_t dropped = dropped_.exchange(0); dropped > 0) {
    const std::string text =
        fmt::format("{} lines of the log were dropped: nobody read it", dropped);
    Base::log(
        spdlog::details::log_msg(message.time, {}, message.logger_name, spdlog::level::warn, text));
  }
  if (takes_a_line()) {
    Base::log(message);
  } else {
    ++dropped_;
  }
}

}  // namespace poolhall::app
