#include "server/web/http_server.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <boost/asio/as_tuple.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket.hpp>
#include <charconv>
#include <optional>
#include <utility>

#include "server/web/pages.hpp"

namespace poolhall::web {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using asio::ip::tcp;

namespace {

constexpr auto awaited = asio::as_tuple(asio::use_awaitable);
constexpr std::chrono::seconds patience{30};
constexpr std::uint32_t header_bytes = 8 * 1024;
constexpr std::uint64_t body_bytes = 256 * 1024;  // a tournament of 256 entries
constexpr std::size_t connections = 4096;
constexpr std::chrono::milliseconds breath{100};
constexpr int socket_buffer = 128 * 1024;  // what a spectator that does not read costs the system
constexpr std::size_t spectator_message = 1024;  // spectators have nothing to say
// Above the threads of games: what people see may come a little later, a clock may not.
constexpr int niceness = 5;

constexpr std::string_view security_policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string_view text_of(beast::string_view text) {
  return {text.data(), text.size()};
}

std::string_view without_port(std::string_view host) {
  if (host.starts_with('[')) {
    return host.substr(0, std::min(host.find(']') + 1, host.size()));
  }
  return host.substr(0, std::min(host.find(':'), host.size()));
}

// Browsers name the site whose page asks, but for their own GETs.
bool is_own_origin(std::string_view origin, std::string_view host) {
  const auto scheme = origin.find("://");
  return origin.empty() || (scheme != std::string_view::npos && origin.substr(scheme + 3) == host);
}

// "/ws/lobby", "/ws/games/17"; "/ws" and "/ws?game=17" are the same.
std::optional<Topic> topic_of(std::string_view path) {
  if (path == "/ws/lobby" || path == "/ws") {
    return Topic::lobby;
  }
  constexpr std::string_view games = "/ws/games/";
  constexpr std::string_view query = "/ws?game=";
  if (!path.starts_with(games) && !path.starts_with(query)) {
    return std::nullopt;
  }
  path.remove_prefix(path.starts_with(games) ? games.size() : query.size());
  std::int64_t game = 0;
  const auto [end, error] = std::from_chars(path.data(), path.data() + path.size(), game);
  if (error != std::errc{} || end != path.data() + path.size() || game <= 0) {
    return std::nullopt;
  }
  return game_topic(game);
}

http::response<http::string_body> response_of(Page page, const Request& request) {
  http::response<http::string_body> response{http::int_to_status(page.status), request.version()};
  response.set(http::field::content_type, page.type);
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Content-Security-Policy", security_policy);
  response.keep_alive(request.keep_alive());
  if (page.etag.empty()) {
    response.set(http::field::cache_control, "no-store");
  } else {
    response.set(http::field::cache_control, "no-cache");  // may be kept, must be asked about
    response.set(http::field::etag, page.etag);
    if (text_of(request[http::field::if_none_match]) == page.etag) {
      response.result(http::status::not_modified);
      return response;
    }
  }
  response.body() = std::move(page.body);
  response.prepare_payload();
  if (request.method() == http::verb::head) {
    response.body().clear();
  }
  return response;
}

// What to say to a request that could not be read; nothing to one that never came.
std::optional<Page> refusal_of(const boost::system::error_code& error) {
  if (error == http::error::body_limit) {
    return refusal(413, "too_large", fmt::format("expected at most {} bytes", body_bytes));
  }
  if (error == http::error::header_limit) {
    return refusal(431, "too_large", fmt::format("expected a head of {} bytes", header_bytes));
  }
  if (error == http::error::end_of_stream || error == http::error::partial_message ||
      error.category() != http::make_error_code(http::error::bad_version).category()) {
    return std::nullopt;
  }
  return refusal(400, "bad_request", "this is no HTTP");
}

// What a spectator sends is read and forgotten, so that its pongs and its end are seen.
template <class Socket>
asio::awaitable<void> listen_to(std::shared_ptr<Socket> socket,
                                std::shared_ptr<Spectator> spectator) {
  beast::flat_buffer ignored;
  for (bool open = true; open;) {
    const auto [failed, bytes] = co_await socket->async_read(ignored, awaited);
    ignored.clear();
    open = !failed;
  }
  spectator->leave();
}

template <class Socket>
asio::awaitable<void> tell(std::shared_ptr<Socket> socket, std::shared_ptr<Spectator> spectator,
                           LiveFeed& feed, Topic topic) {
  while (!spectator->has_left()) {
    if (const Message message = spectator->take()) {
      const auto [failed, bytes] = co_await socket->async_write(asio::buffer(*message), awaited);
      if (failed) {
        co_return;
      }
    } else if (spectator->has_gap()) {
      feed.catch_up(spectator, topic);
    } else {
      co_await spectator->bell().async_wait(awaited);
    }
  }
}

}  // namespace

HttpServer::HttpServer(Options options)
    : workers_(1),
      site_(io_, workers_, options.sources),
      feed_(io_, options.sources.delay, std::move(options.publisher)),
      acceptor_(io_) {}

HttpServer::~HttpServer() {
  stop();
}

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
    acceptor_.listen(1024, error);
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
  // 0 is the calling thread, on Linux; the pool has one.
  const auto give_way = [] { static_cast<void>(::setpriority(PRIO_PROCESS, 0, niceness)); };
  asio::post(workers_, give_way);
  thread_ = std::thread([this, give_way] {
    give_way();
    const auto work = asio::make_work_guard(io_);
    io_.run();
  });
}

void HttpServer::stop() {
  if (!thread_.joinable()) {
    return;
  }
  asio::post(io_, [this] {
    boost::system::error_code error;
    acceptor_.close(error);
    feed_.close();
    io_.stop();
  });
  thread_.join();
  workers_.join();
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
      const auto peer = socket.remote_endpoint(error);
      asio::co_spawn(io_, serve(beast::tcp_stream{std::move(socket)}, peer.address().to_string()),
                     [this](std::exception_ptr) { --open_; });
    } else if (error && error != asio::error::operation_aborted) {
      // Most likely no file descriptor is left: those that there are will be free again.
      asio::steady_timer pause{io_, breath};
      co_await pause.async_wait(awaited);
    }
  }
}

template <class Stream>
asio::awaitable<void> HttpServer::serve(Stream stream, std::string address) {
  beast::flat_buffer buffer{header_bytes + body_bytes};
  for (bool keep = true; keep;) {
    http::request_parser<http::string_body> parser;
    parser.header_limit(header_bytes);
    parser.body_limit(body_bytes);
    beast::get_lowest_layer(stream).expires_after(patience);
    const auto [failed, got] = co_await http::async_read(stream, buffer, parser, awaited);
    if (failed) {
      if (const auto page = refusal_of(failed)) {
        auto response = response_of(*page, parser.get());
        response.keep_alive(false);
        co_await http::async_write(stream, response, awaited);
      }
      break;
    }
    Request request = parser.release();
    if (websocket::is_upgrade(request)) {
      co_await spectate(std::move(stream), std::move(request));
      co_return;
    }
    const auto response = response_of(co_await page_for(request, address), request);
    beast::get_lowest_layer(stream).expires_after(patience);
    const auto [broken, sent] = co_await http::async_write(stream, response, awaited);
    keep = request.keep_alive() && !broken;
  }
  boost::system::error_code error;
  beast::get_lowest_layer(stream).socket().shutdown(tcp::socket::shutdown_send, error);
}

template <class Stream>
asio::awaitable<void> HttpServer::spectate(Stream stream, Request request) {
  const std::string_view host = text_of(request[http::field::host]);
  const std::string_view origin = text_of(request[http::field::origin]);
  const auto topic = topic_of(text_of(request.target()));
  if (!topic || !is_own_host(host) || !is_own_origin(origin, host)) {
    const auto response = response_of(
        topic ? refusal(403, "wrong_origin", "this page may not watch here")
              : refusal(404, "not_found", "expected /ws/lobby or /ws/games/ and a game's number"),
        request);
    co_await http::async_write(stream, response, awaited);
    co_return;
  }
  beast::get_lowest_layer(stream).expires_never();
  boost::system::error_code ignored;
  beast::get_lowest_layer(stream).socket().set_option(tcp::socket::send_buffer_size(socket_buffer),
                                                      ignored);
  auto socket = std::make_shared<websocket::stream<Stream>>(std::move(stream));
  socket->set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
  socket->read_message_max(spectator_message);
  socket->auto_fragment(false);
  socket->text(true);
  if (const auto [failed] = co_await socket->async_accept(request, awaited); failed) {
    co_return;
  }
  const auto spectator = std::make_shared<Spectator>(io_.get_executor());
  asio::co_spawn(io_, listen_to(socket, spectator), asio::detached);
  feed_.join(spectator, *topic);
  ++spectators_;
  co_await tell(socket, spectator, feed_, *topic);
  --spectators_;
  feed_.leave(spectator, *topic);
  if (socket->is_open()) {
    co_await socket->async_close(websocket::close_code::going_away, awaited);
  }
}

// A page of somebody else's that a browser was made to ask names another host.
bool HttpServer::is_own_host(std::string_view host) const {
  const std::string_view name = without_port(host);
  return name == "localhost" || name == "127.0.0.1" || name == "[::1]" || name == host_ ||
         host_ == "0.0.0.0" || host_ == "::";
}

asio::awaitable<Page> HttpServer::page_for(const Request& request, std::string address) {
  const std::string_view host = text_of(request[http::field::host]);
  const std::string_view origin = text_of(request[http::field::origin]);
  if (!is_own_host(host)) {
    co_return refusal(421, "wrong_host", "this server has another name");
  }
  if (!is_own_origin(origin, host)) {
    co_return refusal(403, "wrong_origin", "another site's page may not ask this");
  }
  co_return co_await site_.answer(request, std::move(address));
}

}  // namespace poolhall::web
