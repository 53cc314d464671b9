#include "tests/bench/server/metrics.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <sstream>
#include <stdexcept>

namespace poolhall::bench {

namespace asio = boost::asio;
using asio::ip::tcp;

std::string body_at(std::uint16_t port, const std::string& path) {
  asio::io_context io;
  tcp::socket socket(io);
  socket.connect({asio::ip::address_v4::loopback(), port});
  const std::string request = "GET " + path +
                              " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
                              "\r\nConnection: close\r\n\r\n";
  asio::write(socket, asio::buffer(request));
  std::string answer;
  boost::system::error_code end;
  asio::read(socket, asio::dynamic_buffer(answer), end);
  const auto head = answer.find("\r\n\r\n");
  return head == std::string::npos ? "" : answer.substr(head + 4);
}

Metrics metrics_at(std::uint16_t port) {
  Metrics metrics;
  std::istringstream lines(body_at(port, "/metrics"));
  for (std::string line; std::getline(lines, line);) {
    const auto space = line.rfind(' ');
    if (line.starts_with("poolhall_") && space != std::string::npos) {
      metrics[line.substr(0, space)] = std::stod(line.substr(space + 1));
    }
  }
  if (metrics.empty()) {
    throw std::runtime_error("no metrics from the server at port " + std::to_string(port));
  }
  return metrics;
}

}  // namespace poolhall::bench
