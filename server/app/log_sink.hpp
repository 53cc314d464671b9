// The log on standard error, without ever waiting for whoever reads it: a line that a full pipe or
// a stopped terminal does not take is dropped and counted, and the games go on.
//
//   spdlog::set_default_logger(std::make_shared<spdlog::logger>(
//       "poolhall", std::make_shared<LogSink>()));
#pragma once

#include <spdlog/sinks/ansicolor_sink.h>

#include <atomic>
#include <cstdint>

namespace poolhall::app {

class LogSink : public spdlog::sinks::ansicolor_stderr_sink_mt {
 public:
  void log(const spdlog::details::log_msg& message) override;

 private:
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace poolhall::app
