#include "server/web/http_server.hpp"

#include <openssl/ssl.h>
#include <openssl/x509v3.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include <fmt/format.h>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket.hpp>
#include <optional>
#include <utility>

#include "server/web/awaited.hpp"
#include "server/web/http_head.hpp"
#include "server/web/pages.hpp"
#include "server/web/wire.hpp"

namespace poolhall::web {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using asio::ip::tcp;

namespace {

constexpr std::chrono::seconds patience{30};
constexpr std::size_t connections = 4096;
constexpr std::size_t connections_from_one = 2048;  // a whole lecture hall may share an address
constexpr std::chrono::milliseconds breath{100};
constexpr int socket_buffer = 128 * 1024;  // what a spectator that does not read costs the system
constexpr std::size_t spectator_message = 1024;  // spectators have nothing to say
// Above the threads of games: what people see may come a little later, a clock may not.
constexpr int niceness = 10;

// For the calling thread, on Linux.
void give_way() {
  const int own = ::getpriority(PRIO_PROCESS, 0);
  static_cast<void>(::setpriority(PRIO_PROCESS, 0, own + niceness));
}

constexpr std::string_view no_room =
    "HTTP/1.1 503 Service Unavailable\r\nContent-Type: application/json\r\nConnection: close\r\n"
    "Content-Length: 81\r\n\r\n"
    R"({"error":{"code":"server_full","reason":"too many connections; come back later"}})";
constexpr std::string_view go_on = "HTTP/1.1 100 Continue\r\n\r\n";

bool is_for(std::string_view name, SSL_CTX* certified) {
  X509* const certificate = SSL_CTX_get0_certificate(certified);
  const std::string text{name};
  return certificate != nullptr &&
         (X509_check_host(certificate, text.data(), text.size(), 0, nullptr) == 1 ||
          X509_check_ip_asc(certificate, text.c_str(), 0) == 1);
}

using Parser = http::request_parser<http::string_body>;

// The request, or what to say instead and whether it is worth saying anything.
struct Reading {
  std::optional<Request> request{};
  std::optional<Page> refusal{};
};

asio::awaitable<Reading> read_request(Wire& wire, beast::flat_buffer& buffer) {
  Parser parser;
  parser.header_limit(header_bytes);
  parser.body_limit(boost::none);  // until it is known where it goes
  wire.expires_after(patience);
  if (const auto [failed, got] = co_await http::async_read_header(wire, buffer, parser, awaited);
      failed) {
    co_return Reading{{}, refusal_of(failed)};
  }
  const std::uint64_t limit = Site::body_limit(text_of(parser.get().target()));
  if (parser.content_length().value_or(0) > limit) {
    co_return Reading{{}, too_long_a_body(limit)};
  }
  parser.body_limit(limit);
  if (beast::iequals(parser.get()[http::field::expect], "100-continue")) {
    co_await asio::async_write(wire, asio::buffer(go_on), awaited);
  }
  if (const auto [failed, got] = co_await http::async_read(wire, buffer, parser, awaited); failed) {
    co_return Reading{
        {}, failed == http::error::body_limit ? too_long_a_body(limit) : refusal_of(failed)};
  }
  co_return Reading{parser.release(), {}};
}

using Socket = websocket::stream<Wire, false>;

// What a spectator sends is read and forgotten, so that its pongs and its end are seen.
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
      name_(std::move(options.name)),
      feed_(io_, options.sources.delay, std::move(options.publisher)) {}

HttpServer::~HttpServer() {
  stop();
}

tl::expected<std::uint16_t, std::string> HttpServer::open(const std::string& host,
                                                          std::uint16_t port,
                                                          asio::ssl::context* tls) {
  boost::system::error_code error;
  const auto address = asio::ip::make_address(host, error);
  if (error) {
    return tl::unexpected(host + ": expected the address of this machine to listen on");
  }
  const tcp::endpoint local{address, port};
  tcp::acceptor acceptor{io_};
  if (!acceptor.open(local.protocol(), error) &&
      !acceptor.set_option(tcp::acceptor::reuse_address(true), error) &&
      !acceptor.bind(local, error)) {
    acceptor.listen(1024, error);
  }
  if (error) {
    return tl::unexpected(fmt::format("{}:{}: {}", host, port, error.message()));
  }
  doors_.push_back({std::move(acceptor), host, tls});
  return doors_.back().acceptor.local_endpoint(error).port();
}

void HttpServer::start() {
  for (Door& door : doors_) {
    asio::co_spawn(io_, accept_loop(door), asio::detached);
  }
  asio::post(workers_, give_way);  // the pool has one
  thread_ = std::thread([this] {
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
    for (Door& door : doors_) {
      door.acceptor.close(error);
    }
    feed_.close();
    io_.stop();
  });
  thread_.join();
  workers_.join();
}

asio::awaitable<void> HttpServer::accept_loop(Door& door) {
  while (door.acceptor.is_open()) {
    auto [error, socket] = co_await door.acceptor.async_accept(awaited);
    if (!error) {
      welcome(std::move(socket), door);
    } else if (error != asio::error::operation_aborted) {
      // Most likely no file descriptor is left: those that there are will be free again.
      asio::steady_timer pause{io_, breath};
      co_await pause.async_wait(awaited);
    }
  }
}

void HttpServer::welcome(tcp::socket socket, const Door& door) {
  boost::system::error_code error;
  Visitor visitor{socket.remote_endpoint(error).address().to_string(), door};
  const auto known = open_from_.find(visitor.address);
  if (open_ >= connections ||
      (known != open_from_.end() && known->second >= connections_from_one)) {
    if (door.tls == nullptr) {
      // Into an empty buffer: it fits or nobody is there.
      static_cast<void>(::send(socket.native_handle(), no_room.data(), no_room.size(),
                               MSG_DONTWAIT | MSG_NOSIGNAL));
    }
    return;
  }
  ++open_;
  const auto from = open_from_.try_emplace(visitor.address, 0).first;
  ++from->second;
  const auto gone = [this, from](std::exception_ptr) {
    --open_;
    if (--from->second == 0) {
      open_from_.erase(from);
    }
  };
  asio::co_spawn(io_, serve(Wire{std::move(socket), door.tls}, std::move(visitor)), gone);
}

asio::awaitable<void> HttpServer::serve(Wire wire, Visitor visitor) {
  if (co_await wire.shake_hands()) {
    co_return;
  }
  beast::flat_buffer buffer{header_bytes + Site::most_body_bytes};
  for (bool keep = true; keep;) {
    Reading reading = co_await read_request(wire, buffer);
    if (reading.refusal) {
      auto response = response_of(std::move(*reading.refusal), Request{});
      response.keep_alive(false);
      co_await http::async_write(wire, response, awaited);
    }
    if (!reading.request) {
      break;
    }
    Request request = std::move(*reading.request);
    if (websocket::is_upgrade(request)) {
      co_await spectate(std::move(wire), std::move(request), std::move(visitor));
      co_return;
    }
    const auto response = response_of(co_await page_for(request, visitor), request);
    wire.expires_after(patience);
    const auto [broken, sent] = co_await http::async_write(wire, response, awaited);
    keep = request.keep_alive() && !broken;
  }
  co_await wire.part();
}

asio::awaitable<void> HttpServer::spectate(Wire wire, Request request, Visitor visitor) {
  const auto topic = topic_of(text_of(request.target()));
  auto refused = why_not(request, visitor);
  if (!refused && !topic) {
    refused = refusal(404, "not_found", "expected /ws/lobby or /ws/games/ and a game's number");
  }
  if (refused) {
    const auto response = response_of(std::move(*refused), request);
    co_await http::async_write(wire, response, awaited);
    co_return;
  }
  wire.expires_never();
  wire.limit_send_buffer(socket_buffer);
  auto socket = std::make_shared<Socket>(std::move(wire));
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

// A page of somebody else's that a browser was made to ask names another host. By TLS the server
// has the names that its certificate is for.
bool HttpServer::is_own_host(std::string_view host, const Door& door) const {
  std::string_view name = without_port(host);
  if (name.starts_with('[') && name.ends_with(']')) {
    name = name.substr(1, name.size() - 2);
  }
  if (name == "localhost" || name == "127.0.0.1" || name == "::1" ||
      (!name_.empty() && beast::iequals(name, name_))) {
    return true;
  }
  if (door.tls != nullptr) {
    return is_for(name, door.tls->native_handle());
  }
  return name == door.host || door.host == "0.0.0.0" || door.host == "::";
}

std::optional<Page> HttpServer::why_not(const Request& request, const Visitor& visitor) const {
  const std::string_view host = text_of(request[http::field::host]);
  const std::string_view origin = text_of(request[http::field::origin]);
  if (!is_own_host(host, visitor.door)) {
    return refusal(421, "wrong_host",
                   fmt::format("got the Host \"{}\", expected localhost, the address that is "
                               "listened on, a name of the certificate or http_name",
                               host));
  }
  if (!is_own_origin(origin, host)) {
    return refusal(403, "wrong_origin",
                   fmt::format("got the Origin \"{}\", another site's; expected none, or a page "
                               "of \"{}\"",
                               origin, host));
  }
  return std::nullopt;
}

asio::awaitable<Page> HttpServer::page_for(const Request& request, const Visitor& visitor) {
  if (auto refused = why_not(request, visitor)) {
    co_return std::move(*refused);
  }
  co_return co_await site_.answer(request, visitor.address);
}

}  // namespace poolhall::web
