// Why the server in this process ended each connection, out of its own log. While it lives, the
// log goes here and nowhere else.
//
//   EndLog log;
//   std::optional<std::string> why = log.await_end(local_port_of_the_client);
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace poolhall::fault {

class EndLog {
 public:
  EndLog();
  ~EndLog();
  EndLog(const EndLog&) = delete;
  EndLog& operator=(const EndLog&) = delete;

  // Nothing when it has not ended after half a minute.
  [[nodiscard]] std::optional<std::string> await_end(std::uint16_t client_port);

 private:
  class Sink;
  struct Before;
  std::shared_ptr<Sink> sink_;
  std::unique_ptr<Before> before_;
};

}  // namespace poolhall::fault
