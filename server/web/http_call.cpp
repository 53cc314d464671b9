#include "server/web/http_call.hpp"

#include <fmt/format.h>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "server/web/awaited.hpp"
#include "server/web/wire.hpp"

namespace poolhall::web {

namespace asio = boost::asio;
namespace http = boost::beast::http;
using asio::ip::tcp;
using Reply = tl::expected<HttpReply, std::string>;

namespace {

constexpr std::uint64_t longest_answer = std::uint64_t{1} << 30U;

struct Address {
  bool is_encrypted = false;
  std::string host;  // of an IPv6 address without its brackets
  std::string port;
  std::string name;  // as it goes into the head
};

// Takes the prefix off; whether it was there.
bool takes(std::string_view& text, std::string_view prefix) {
  const bool has = text.starts_with(prefix);
  text.remove_prefix(has ? prefix.size() : 0);
  return has;
}

tl::expected<Address, std::string> address_of(const std::string& server) {
  std::string_view rest = server;
  Address address;
  address.is_encrypted = takes(rest, "https://");
  const bool is_named = address.is_encrypted || takes(rest, "http://");
  if (is_named && rest.ends_with('/')) {
    rest.remove_suffix(1);
  }
  address.name = rest;
  const auto colon = rest.rfind(':');
  const bool has_port =
      colon != std::string_view::npos && rest.find(']', colon) == std::string_view::npos;
  if ((!has_port && !is_named) || rest.empty() || rest.find('/') != std::string_view::npos) {
    return tl::unexpected(
        fmt::format("\"{}\" came, expected HOST:PORT or https://HOST:PORT", server));
  }
  address.port = has_port ? rest.substr(colon + 1) : address.is_encrypted ? "443" : "80";
  address.host = rest.substr(0, has_port ? colon : rest.size());
  if (address.host.size() > 2 && address.host.front() == '[' && address.host.back() == ']') {
    address.host = address.host.substr(1, address.host.size() - 2);
  }
  return address;
}

// Null: no encryption.
tl::expected<std::optional<asio::ssl::context>, std::string> tls_of(const Address& address,
                                                                    const HttpCall& call) {
  std::optional<asio::ssl::context> context;
  if (!address.is_encrypted) {
    return context;
  }
  context.emplace(asio::ssl::context::tls_client);
  SSL_CTX_set_min_proto_version(context->native_handle(), TLS1_2_VERSION);
  boost::system::error_code error;
  if (call.ca_file.empty()) {
    context->set_default_verify_paths(error);
  } else {
    context->load_verify_file(call.ca_file, error);
  }
  if (error) {
    return tl::unexpected(fmt::format("{}: {}", call.ca_file, error.message()));
  }
  return context;
}

http::request<http::string_body> request_of(const HttpCall& call, const Address& address) {
  http::request<http::string_body> request(
      call.method == "POST" ? http::verb::post : http::verb::get, call.target, 11);
  request.set(http::field::host, address.name);
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

asio::awaitable<Reply> exchange(const HttpCall& call, const Address& address,
                                asio::ssl::context* tls, tcp::socket socket) {
  const auto failure = [&call](const boost::system::error_code& error) {
    return tl::unexpected(fmt::format("{}: {}", call.server, error.message()));
  };
  tcp::resolver resolver(socket.get_executor());
  const auto [unresolved, places] =
      co_await resolver.async_resolve(address.host, address.port, awaited);
  if (unresolved) {
    co_return failure(unresolved);
  }
  if (const auto [unreachable, place] = co_await asio::async_connect(socket, places, awaited);
      unreachable) {
    co_return failure(unreachable);
  }
  Wire wire{std::move(socket), tls};
  if (const auto error = co_await wire.shake_hands_with(address.host); error) {
    co_return failure(error);
  }
  wire.expires_after(call.patience);
  const auto request = request_of(call, address);
  if (const auto [unsent, sent] = co_await http::async_write(wire, request, awaited); unsent) {
    co_return failure(unsent);
  }
  boost::beast::flat_buffer buffer;
  http::response_parser<http::string_body> parser;
  parser.body_limit(longest_answer);
  if (const auto [unread, got] = co_await http::async_read(wire, buffer, parser, awaited); unread) {
    co_return failure(unread);
  }
  co_return HttpReply{parser.get().result_int(), std::move(parser.get().body())};
}

}  // namespace

Reply http_call(const HttpCall& call) {
  const auto address = address_of(call.server);
  if (!address) {
    return tl::unexpected(address.error());
  }
  auto tls = tls_of(*address, call);
  if (!tls) {
    return tl::unexpected(tls.error());
  }
  asio::io_context io;
  Reply reply = tl::unexpected(std::string{});
  asio::co_spawn(io, exchange(call, *address, *tls ? &**tls : nullptr, tcp::socket(io)),
                 [&reply](std::exception_ptr failed, Reply got) {
                   if (failed) {
                     std::rethrow_exception(failed);
                   }
                   reply = std::move(got);
                 });
  io.run();
  return reply;
}

}  // namespace poolhall::web
