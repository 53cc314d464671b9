#include "tests/fault/harness/end_log.hpp"

#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <string_view>

namespace poolhall::fault {
namespace {

constexpr std::chrono::seconds log_patience{60};

}  // namespace

// "connection 7 from 127.0.0.1:40312 has ended, agent 3: too_slow: no login within 2000 ms"
class EndLog::Sink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  std::optional<std::string> await_end(std::uint16_t port) {
    std::unique_lock lock(ends_mutex_);
    if (!ended_.wait_for(lock, log_patience, [&] { return ends_.contains(port); })) {
      return std::nullopt;
    }
    return ends_.at(port);
  }

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    const std::string_view text(message.payload.data(), message.payload.size());
    const std::size_t ended = text.find(" has ended");
    if (!text.starts_with("connection ")) {
      return;
    }
    const std::size_t colon = text.rfind(':', ended);
    std::uint16_t port = 0;
    std::from_chars(text.data() + colon + 1, text.data() + std::min(ended, text.size()), port);
    const std::size_t why = ended == std::string_view::npos ? ended : text.find(": ", ended);
    const std::lock_guard lock(ends_mutex_);
    if (why == std::string_view::npos) {
      ends_.erase(port);  // a new connection from a port that an older one had
    } else {
      ends_.insert_or_assign(port, std::string(text.substr(why + 2)));
      ended_.notify_all();
    }
  }
  void flush_() override {}

 private:
  std::mutex ends_mutex_;
  std::condition_variable ended_;
  std::map<std::uint16_t, std::string> ends_;
};

struct EndLog::Before {
  std::shared_ptr<spdlog::logger> logger = spdlog::default_logger();
};

EndLog::EndLog() : sink_(std::make_shared<Sink>()), before_(std::make_unique<Before>()) {
  spdlog::set_default_logger(std::make_shared<spdlog::logger>("ends", sink_));
}

EndLog::~EndLog() {
  spdlog::set_default_logger(before_->logger);
}

std::optional<std::string> EndLog::await_end(std::uint16_t client_port) {
  return sink_->await_end(client_port);
}

}  // namespace poolhall::fault
