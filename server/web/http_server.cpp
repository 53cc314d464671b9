#include "server/web/http_server.hpp"

#include <fmt/format.h>

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/async_result.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <utility>

#include "server/web/routes.hpp"

namespace poolhall::web {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using asio::ip::tcp;

namespace {

constexpr auto awaited = asio::as_tuple(asio::use_awaitable);
constexpr std::chrono::seconds patience{30};
constexpr std::uint32_t header_bytes = 8 * 1024;
constexpr std::uint64_t body_bytes = 256 * 1'024;  // a tournament of 256 entries
constexpr std::size_t connections = 256;
constexpr std::chrono::milliseconds breath{100};

std::string_view without_port(std::string_view host) {
  if (host.starts_with('[')) {
    return host.substr(0, std::min(host.find(']') + 1, host.size()));
  }
  return host.substr(0, std::min(host.find(':'), host.size()));
}

std::string path_of(const http::request<http::string_body>& request) {
  const std::string target{request.target().data(), request.target().size()};
  return target.substr(0, target.find('?'));
}

}  // namespace

HttpServer::HttpServer(asio::io_context& io, Sources sources)
    : io_(io), sources_(std::move(sources)), acceptor_(io) {}

tl::expected<void, std::string> HttpServer::open(const std::string& host, std::uint16_t port) {
  boost::system::error_code error;
  const auto address = asio::ip::make_address(host, error);
  if (error) {
    return tl::unexpected(host + ": expected the address of this machine to listen on");
  }
  const tcp::endpoint local{address, port};
  if (!acceptor_.open(local.protocol(), error) &&
      !acceptor_.set_option(tcp::acceptor::reuse_address(true), error) &&
      !acceptor_.bind(local, error)) {
    acceptor_.listen(128, error);
  }
  if (error) {
    acceptor_.close();
    return tl::unexpected(fmt::format("{}:{}: {}", host, port, error.message()));
  }
  host_ = host;
  return {};
}

void HttpServer::start() {
  asio::co_spawn(io_, accept_loop(), asio::detached);
}

void HttpServer::stop() {
  boost::system::error_code error;
  acceptor_.close(error);
}

std::uint16_t HttpServer::port() const {
  boost::system::error_code error;
  return acceptor_.local_endpoint(error).port();
}

asio::awaitable<void> HttpServer::accept_loop() {
  while (acceptor_.is_open()) {
    auto [error, socket] = co_await acceptor_.async_accept(awaited);
    if (!error && open_ < connections) {
      ++open_;
      asio::co_spawn(io_, serve(std::move(socket)), [this](std::exception_ptr) { --open_; });
    } else if (error && error != asio::error::operation_aborted) {
      // Most likely no file descriptor is left: those that there are will be free again.
      asio::steady_timer pause{io_, breath};
      co_await pause.async_wait(awaited);
    }
  }
}

asio::awaitable<void> HttpServer::serve(tcp::socket socket) {
  beast::tcp_stream stream{std::move(socket)};
  beast::flat_buffer buffer{header_bytes + body_bytes};
  for (bool keep = true; keep;) {
    http::request_parser<http::string_body> parser;
    parser.header_limit(header_bytes);
    parser.body_limit(body_bytes);
    stream.expires_after(patience);
    const auto [failed, got] = co_await http::async_read(stream, buffer, parser, awaited);
    if (failed) {
      break;
    }
    const Request request = parser.release();
    keep = request.keep_alive();
    const Page page = co_await page_for(request);
    http::response<http::string_body> response{http::int_to_status(page.status), request.version()};
    response.set(http::field::content_type, page.type);
    response.set(http::field::cache_control, "no-store");
    response.set("X-Content-Type-Options", "nosniff");
    response.keep_alive(keep);
    response.body() = page.body;
    response.prepare_payload();
    if (request.method() == http::verb::head) {
      response.body().clear();
    }
    stream.expires_after(patience);
    const auto [broken, sent] = co_await http::async_write(stream, response, awaited);
    keep = keep && !broken;
  }
  boost::system::error_code error;
  stream.socket().shutdown(tcp::socket::shutdown_send, error);
}

// A page of somebody else's that a browser was made to ask names another host.
bool HttpServer::is_own_host(std::string_view host) const {
  const std::string_view name = without_port(host);
  return name == "localhost" || name == "127.0.0.1" || name == "[::1]" || name == host_ ||
         host_ == "0.0.0.0" || host_ == "::";
}

// Browsers name the site whose page asks, but for their own GETs.
bool HttpServer::is_own_origin(std::string_view origin, std::string_view host) {
  const auto scheme = origin.find("://");
  return origin.empty() || (scheme != std::string_view::npos && origin.substr(scheme + 3) == host);
}

asio::awaitable<Page> HttpServer::page_for(const Request& request) {
  const std::string_view host{request[http::field::host].data(), request[http::field::host].size()};
  if (!is_own_host(host)) {
    co_return refusal(421, "wrong_host", "this server has another name");
  }
  const std::string_view origin{request[http::field::origin].data(),
                                request[http::field::origin].size()};
  if (!is_own_origin(origin, host)) {
    co_return refusal(403, "wrong_origin", "another site's page may not ask this");
  }
  std::string path = path_of(request);
  const Routing routing =
      route_of({request.method_string().data(), request.method_string().size()}, path);
  if (const auto* missing = std::get_if<NoRoute>(&routing)) {
    co_return *missing == NoRoute::path
        ? refusal(404, "not_found", "there is no such path; see /api/openapi.json")
        : refusal(405, "method_not_allowed", "see /api/openapi.json for what this path takes");
  }
  if (Admin::is_for(path)) {
    AdminRequest asked;
    asked.path = path;
    asked.authorization = std::string{request[http::field::authorization]};
    asked.body = request.body();
    co_return co_await admin(std::move(asked));
  }
  if (path == "/api/openapi.json") {
    co_return Page{200, "application/json", openapi_document()};
  }
  if (path == "/healthz") {
    co_return sources_.health();
  }
  if (path == "/metrics") {
    co_return Page{200, "text/plain; version=0.0.4", sources_.metrics()};
  }
  if (path == "/api/live") {
    co_return Page{200, "application/json", sources_.live()};
  }
  co_return co_await read(std::move(path));
}

asio::awaitable<Page> HttpServer::read(std::string path) {
  Page page = co_await asio::async_initiate<const asio::use_awaitable_t<>, void(Page)>(
      [this](auto handler, std::string wanted) {
        // A shared handler: std::function wants to be able to copy what it holds.
        auto shared = std::make_shared<decltype(handler)>(std::move(handler));
        sources_.read([wanted](storage::Reader& reader) { return answer(reader, wanted); },
                      [shared](Page done) { (*shared)(std::move(done)); });
      },
      asio::use_awaitable, std::move(path));
  co_return page;
}

asio::awaitable<Page> HttpServer::admin(AdminRequest request) {
  Page page = co_await asio::async_initiate<const asio::use_awaitable_t<>, void(Page)>(
      [this](auto handler, const AdminRequest& asked) {
        auto shared = std::make_shared<decltype(handler)>(std::move(handler));
        sources_.admin(asked, [shared](Page done) { (*shared)(std::move(done)); });
      },
      asio::use_awaitable, std::move(request));
  co_return page;
}

}  // namespace poolhall::web
