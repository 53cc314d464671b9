#include "server/web/http_call.hpp"

#include <sys/socket.h>
#include <sys/time.h>

#include <fmt/format.h>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>

namespace poolhall::web {

namespace asio = boost::asio;
namespace http = boost::beast::http;

namespace {

constexpr timeval reply_patience{30, 0};

tl::unexpected<std::string> call_error(const HttpCall& call,
                                       const boost::system::error_code& error) {
  return tl::unexpected(fmt::format("{}: {}", call.server, error.message()));
}

http::request<http::string_body> request_of(const HttpCall& call) {
  http::request<http::string_body> request(
      call.method == "POST" ? http::verb::post : http::verb::get, call.target, 11);
  request.set(http::field::host, call.server);
  request.set(http::field::connection, "close");
  if (!call.token.empty()) {
    request.set(http::field::authorization, "Bearer " + call.token);
  }
  if (call.method == "POST") {
    request.set(http::field::content_type, call.content_type);
    request.body() = call.body;
    request.prepare_payload();
  }
  return request;
}

}  // namespace

tl::expected<HttpReply, std::string> http_call(const HttpCall& call) {
  const auto colon = call.server.rfind(':');
  if (colon == std::string::npos) {
    return tl::unexpected(fmt::format("\"{}\" came, expected HOST:PORT", call.server));
  }
  std::string host = call.server.substr(0, colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
    host = host.substr(1, host.size() - 2);
  }
  asio::io_context io;
  asio::ip::tcp::socket socket(io);
  boost::system::error_code error;
  const auto places =
      asio::ip::tcp::resolver(io).resolve(host, call.server.substr(colon + 1), error);
  if (error) {
    return call_error(call, error);
  }
  if (asio::connect(socket, places, error); error) {
    return call_error(call, error);
  }
  ::setsockopt(socket.native_handle(), SOL_SOCKET, SO_RCVTIMEO, &reply_patience,
               sizeof reply_patience);
  ::setsockopt(socket.native_handle(), SOL_SOCKET, SO_SNDTIMEO, &reply_patience,
               sizeof reply_patience);
  if (http::write(socket, request_of(call), error); error) {
    return call_error(call, error);
  }
  boost::beast::flat_buffer buffer;
  http::response_parser<http::string_body> parser;
  parser.body_limit(std::uint64_t{1} << 30U);
  if (http::read(socket, buffer, parser, error); error) {
    return call_error(call, error);
  }
  return HttpReply{parser.get().result_int(), std::move(parser.get().body())};
}

}  // namespace poolhall::web
