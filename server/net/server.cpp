#include "server/net/server.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/address.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/thread_pool.hpp>
#include <charconv>
#include <fstream>
#include <thread>
#include <utility>

#include "server/net/admin_calls.hpp"
#include "server/net/arena.hpp"
#include "server/net/broadcast.hpp"
#include "server/net/figures.hpp"
#include "server/net/listener.hpp"
#include "server/net/socket_options.hpp"
#include "server/net/tls.hpp"
#include "server/storage/sqlite_database.hpp"
#include "server/web/http_server.hpp"

namespace poolhall::net {

namespace asio = boost::asio;

namespace {

std::size_t worker_count(std::uint32_t wanted) {
  return wanted > 0 ? wanted : std::max(1U, std::thread::hardware_concurrency());
}

ArenaSettings arena_settings(const ServerOptions& options) {
  ArenaSettings settings;
  settings.limits = options.settings.limits;
  settings.name = options.settings.name;
  settings.registration =
      options.settings.registration == "closed" ? Registration::closed : Registration::open;
  settings.house_bots = options.house_bots;
  return settings;
}

// Where bots of the house connect: an address that means "any" is reached by loopback.
Endpoint reachable(Endpoint endpoint) {
  if (endpoint.host == "0.0.0.0") {
    endpoint.host = "127.0.0.1";
  } else if (endpoint.host == "::") {
    endpoint.host = "::1";
  }
  return endpoint;
}

std::string quoted(const std::optional<Endpoint>& endpoint) {
  return endpoint ? '"' + to_string(*endpoint) + '"' : "null";
}

tl::expected<Endpoint, std::string> endpoint_of(const std::string& text) {
  if (const auto endpoint = parse_endpoint(text)) {
    return *endpoint;
  }
  return tl::unexpected(fmt::format("{}: expected HOST:PORT", text));
}

// Whole or not at all: whoever waits for the file never sees half of it.
tl::expected<void, std::string> write_ready_file(const std::filesystem::path& file,
                                                 const std::string& text) {
  const std::filesystem::path part = file.string() + ".part";
  std::ofstream out(part);
  out << text;
  out.close();
  std::error_code error;
  if (out) {
    std::filesystem::rename(part, file, error);
  }
  if (!out || error) {
    return tl::unexpected(file.string() + ": the ready file cannot be written");
  }
  return {};
}

}  // namespace

std::optional<Endpoint> parse_endpoint(const std::string& text) {
  const auto colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0) {
    return std::nullopt;
  }
  Endpoint endpoint{text.substr(0, colon), 0};
  if (endpoint.host.size() > 2 && endpoint.host.front() == '[' && endpoint.host.back() == ']') {
    endpoint.host = endpoint.host.substr(1, endpoint.host.size() - 2);
  }
  if (endpoint.host == "localhost") {
    endpoint.host = "127.0.0.1";
  }
  const char* const first = text.data() + colon + 1;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(first, last, endpoint.port);
  if (error != std::errc{} || end != last || first == last) {
    return std::nullopt;
  }
  return endpoint;
}

bool is_loopback(const Endpoint& endpoint) {
  boost::system::error_code error;
  return boost::asio::ip::make_address(endpoint.host, error).is_loopback();
}

std::optional<std::string> exposed(const settings::ServerSettings& settings) {
  if (settings.plain_beyond_loopback) {
    return std::nullopt;
  }
  for (const std::string& address : {settings.listen, settings.http}) {
    const auto endpoint = parse_endpoint(address);
    if (endpoint && !is_loopback(*endpoint)) {
      return fmt::format(
          "{} is open to others and not encrypted; tls.certificate with tls.listen and tls.http "
          "encrypt, --plain-beyond-loopback allows it",
          address);
    }
  }
  return std::nullopt;
}

std::string to_string(const Endpoint& endpoint) {
  const bool v6 = endpoint.host.find(':') != std::string::npos;
  return v6 ? fmt::format("[{}]:{}", endpoint.host, endpoint.port)
            : fmt::format("{}:{}", endpoint.host, endpoint.port);
}

class Server::Impl {
 public:
  explicit Impl(ServerOptions options)
      : options_(std::move(options)), workers_(worker_count(options_.settings.worker_threads)) {}

  ~Impl() { shut(); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  tl::expected<void, std::string> start();
  int run();
  void stop() {
    asio::post(io_, [this] { begin_stop(); });
  }
  void post(std::function<void(MatchHost&)> work) {
    asio::post(io_, [this, work = std::move(work)] { work(arena_->host()); });
  }
  [[nodiscard]] Endpoint agents() const { return agents_; }
  [[nodiscard]] std::optional<Endpoint> page() const { return page_; }
  [[nodiscard]] std::optional<Endpoint> tls_page() const { return tls_page_; }
  [[nodiscard]] std::optional<Endpoint> tls_agents() const { return tls_agents_; }

 private:
  tl::expected<void, std::string> open_database();
  tl::expected<void, std::string> open_desk();
  tl::expected<void, std::string> listen();
  tl::expected<void, std::string> listen_tls();
  tl::expected<void, std::string> listen_http();
  tl::expected<std::optional<Endpoint>, std::string> open_page(const std::string& address,
                                                               TlsContext* tls);
  void make_http();
  [[nodiscard]] web::Sources page_sources();
  [[nodiscard]] std::function<void(web::Then)> from_games(std::function<web::Page()> make);
  tl::expected<void, std::string> say_ready();
  void watch_signals();
  void begin_stop();
  void shut();

  ServerOptions options_;
  asio::io_context io_{1};
  asio::thread_pool workers_;
  std::unique_ptr<storage::Writer> writer_;
  std::unique_ptr<Archive> archive_;
  std::unique_ptr<Arena> arena_;
  std::unique_ptr<TournamentDesk> desk_;
  std::unique_ptr<web::Admin> admin_;
  std::unique_ptr<TlsContext> tls_;
  std::unique_ptr<Listener> listener_;
  std::unique_ptr<Listener> tls_listener_;
  std::unique_ptr<asio::signal_set> signals_;
  std::unique_ptr<web::HttpServer> http_;
  std::unique_ptr<Archive> web_archive_;  // its readers run on the web's threads
  std::unique_ptr<Broadcast> broadcast_;
  Endpoint agents_;
  std::optional<Endpoint> tls_agents_;
  std::optional<Endpoint> page_;
  std::optional<Endpoint> tls_page_;
  bool stopping_ = false;
  bool shut_ = false;
  bool said_ready_ = false;
};

tl::expected<void, std::string> Server::Impl::start() {
  static_cast<void>(raise_descriptor_limit());
  if (auto opened = open_database(); !opened) {
    return opened;
  }
  if (auto opened = open_desk(); !opened) {
    return opened;
  }
  if (auto listening = listen(); !listening) {
    return listening;
  }
  if (auto listening = listen_tls(); !listening) {
    return listening;
  }
  if (auto listening = listen_http(); !listening) {
    return listening;
  }
  if (options_.signals == Signals::handled) {
    watch_signals();
  }
  arena_->begin(
      {options_.program, to_string(reachable(agents_)), options_.settings.max_house_bots});
  if (options_.stored_tournaments == StoredTournaments::taken_up) {
    desk_->take_up();
  }
  listener_->start();
  if (tls_listener_) {
    tls_listener_->start();
  }
  if (http_) {
    http_->start();
  }
  const auto text = [](const std::optional<Endpoint>& port) {
    return port ? to_string(*port) : std::string("no port");
  };
  spdlog::info("agents on {}, by TLS on {}, page on {}, by TLS on {}, database {}, process {}",
               to_string(agents_), text(tls_agents_), text(page_), text(tls_page_),
               options_.settings.database, ::getpid());
  return say_ready();
}

tl::expected<void, std::string> Server::Impl::say_ready() {
  if (!options_.ready_file) {
    return {};
  }
  said_ready_ = true;
  return write_ready_file(
      *options_.ready_file,
      fmt::format(
          "{{\"agents\": \"{}\", \"agents_tls\": {}, \"http\": {}, \"https\": {}, \"pid\": {}}}\n",
          to_string(agents_), quoted(tls_agents_), quoted(page_), quoted(tls_page_), ::getpid()));
}

tl::expected<void, std::string> Server::Impl::open_database() {
  const std::filesystem::path file = options_.settings.database;
  auto database = storage::open_sqlite(file);
  if (!database) {
    return tl::unexpected(database.error().reason);
  }
  storage::WriterOptions writing;
  writing.deliver = [this](std::function<void()> work) { asio::post(io_, std::move(work)); };
  writing.on_health = [this](const storage::WriterHealth& health) {
    if (arena_) {
      arena_->storage_health(health);
    }
  };
  writer_ = std::make_unique<storage::Writer>(std::move(*database), std::move(writing));
  archive_ = std::make_unique<Archive>(file, io_, workers_);
  arena_ = std::make_unique<Arena>(io_, workers_, *writer_, *archive_, arena_settings(options_));
  const auto reader = storage::open_sqlite_reader(file);
  if (!reader) {
    return tl::unexpected(reader.error().reason);
  }
  if (auto restored = arena_->restore(**reader, options_.stored_tournaments); !restored) {
    return tl::unexpected(restored.error().reason);
  }
  return {};
}

tl::expected<void, std::string> Server::Impl::open_desk() {
  desk_ = std::make_unique<TournamentDesk>(
      arena_->host(), arena_->matches(),
      HouseOffer{options_.house_bots, options_.settings.max_house_bots},
      [this](const std::string& tournament) { arena_->call_off_games_of(tournament); },
      [] { return std::chrono::steady_clock::now(); });
  std::optional<std::string> token;
  if (const std::string& file = options_.settings.admin_token_file; !file.empty()) {
    auto read = token_in(file);
    if (!read) {
      return tl::unexpected(read.error());
    }
    token = std::move(*read);
  }
  admin_ = std::make_unique<web::Admin>(token, host_calls(*arena_, *archive_, *desk_));
  return {};
}

tl::expected<void, std::string> Server::Impl::listen() {
  const auto endpoint = endpoint_of(options_.settings.listen);
  if (!endpoint) {
    return tl::unexpected(endpoint.error());
  }
  listener_ = std::make_unique<Listener>(
      io_, arena_->visitors(), [this](asio::ip::tcp::socket socket, std::function<void()> gone) {
        arena_->accept({std::move(socket), nullptr}, std::move(gone));
      });
  if (auto bound = listener_->open(*endpoint); !bound) {
    return bound;
  }
  agents_ = listener_->endpoint();
  return {};
}

tl::expected<void, std::string> Server::Impl::listen_tls() {
  const settings::TlsSettings& tls = options_.settings.tls;
  if (tls.listen.empty() && tls.http.empty() && tls.certificate.empty() && tls.key.empty()) {
    return {};
  }
  auto context = load_tls(tls);
  if (!context) {
    return tl::unexpected(context.error());
  }
  tls_ = std::move(*context);
  if (tls.listen.empty()) {
    return {};
  }
  const auto endpoint = endpoint_of(tls.listen);
  if (!endpoint) {
    return tl::unexpected(endpoint.error());
  }
  SSL_CTX* const native = tls_->native_handle();
  tls_listener_ = std::make_unique<Listener>(
      io_, arena_->visitors(),
      [this, native](asio::ip::tcp::socket socket, std::function<void()> gone) {
        arena_->accept({std::move(socket), native}, std::move(gone));
      },
      [this, native](asio::ip::tcp::socket socket, const protocol::Error& error) {
        arena_->turn_away({std::move(socket), native}, error);
      });
  if (auto bound = tls_listener_->open(*endpoint); !bound) {
    return bound;
  }
  tls_agents_ = tls_listener_->endpoint();
  return {};
}

tl::expected<void, std::string> Server::Impl::listen_http() {
  const std::string& plain = options_.settings.http;
  const std::string& encrypted = options_.settings.tls.http;
  if (plain.empty() && encrypted.empty()) {
    return {};
  }
  make_http();
  auto page = open_page(plain, nullptr);
  if (!page) {
    return tl::unexpected(page.error());
  }
  auto tls_page = open_page(encrypted, tls_.get());
  if (!tls_page) {
    return tl::unexpected(tls_page.error());
  }
  page_ = std::move(*page);
  tls_page_ = std::move(*tls_page);
  return {};
}

tl::expected<std::optional<Endpoint>, std::string> Server::Impl::open_page(
    const std::string& address, TlsContext* tls) {
  if (address.empty()) {
    return std::nullopt;
  }
  const auto endpoint = endpoint_of(address);
  if (!endpoint) {
    return tl::unexpected(endpoint.error());
  }
  auto bound = http_->open(endpoint->host, endpoint->port, tls);
  if (!bound && options_.page_port == PagePort::or_a_free_one) {
    bound = http_->open(endpoint->host, 0, tls);
  }
  if (!bound) {
    return tl::unexpected(bound.error());
  }
  return Endpoint{endpoint->host, *bound};
}

void Server::Impl::make_http() {
  web::HttpServer::Options options{page_sources(), {}, options_.settings.http_name};
  options.publisher.watch = [this](web::Topic topic, web::Ticket ticket) {
    asio::post(io_, [this, topic, ticket] { broadcast_->watch(topic, ticket); });
  };
  options.publisher.unwatch = [this](web::Topic topic) {
    asio::post(io_, [this, topic] { broadcast_->unwatch(topic); });
  };
  http_ = std::make_unique<web::HttpServer>(std::move(options));
  web_archive_ =
      std::make_unique<Archive>(options_.settings.database, http_->io(), http_->workers());
  broadcast_ = std::make_unique<Broadcast>(io_, *arena_, http_->feed());
}

web::Sources Server::Impl::page_sources() {
  web::Sources sources;
  sources.read = [this](std::function<web::Page(storage::Reader&)> work, web::Then then) {
    web_archive_->read(
        [work = std::move(work)](storage::Reader& reader) -> storage::Expected<web::Page> {
          return work(reader);
        },
        [then = std::move(then)](storage::Expected<web::Page> page) {
          then(page ? std::move(*page) : web::refusal(503, "database", page.error().reason));
        });
  };
  sources.health = from_games([this] { return health_page(arena_->figures()); });
  sources.metrics = from_games([this] {
    return web::Page{200, "text/plain; version=0.0.4",
                     metrics_of(arena_->figures(), writer_->statistics(), http_->spectators())};
  });
  sources.live = from_games([this] {
    const bool delayed = options_.settings.spectator_delay.count() > 0;
    return web::Page{200, "application/json",
                     live_json(*arena_, delayed ? States::left_out : States::included)};
  });
  sources.admin = [this](web::AdminRequest request, web::Then then) {
    asio::post(io_, [this, request = std::move(request), then = std::move(then)] {
      admin_->answer(request, [this, then](web::Page page) {
        asio::post(http_->io(),
                   [then, page = std::move(page)]() mutable { then(std::move(page)); });
      });
    });
  };
  sources.delay = options_.settings.spectator_delay;
  sources.simulations_per_second = options_.settings.simulations_per_second;
  return sources;
}

// A page made on the thread on which the games are, and handed back on the web's.
std::function<void(web::Then)> Server::Impl::from_games(std::function<web::Page()> make) {
  return [this, make = std::move(make)](web::Then then) {
    asio::post(io_, [this, make, then = std::move(then)] {
      asio::post(http_->io(), [then, page = make()]() mutable { then(std::move(page)); });
    });
  };
}

void Server::Impl::watch_signals() {
  signals_ = std::make_unique<asio::signal_set>(io_, SIGTERM, SIGINT);
  signals_->async_wait([this](const boost::system::error_code& error, int) {
    if (!error) {
      begin_stop();
    }
  });
}

void Server::Impl::begin_stop() {
  if (std::exchange(stopping_, true)) {
    return;
  }
  listener_->stop();
  if (tls_listener_) {
    tls_listener_->stop();
  }
  arena_->stop([this] { io_.stop(); });
}

int Server::Impl::run() {
  const auto work = asio::make_work_guard(io_);
  io_.run();
  shut();
  return 0;
}

// What has been told is stored already; what has not is stored now or never told.
void Server::Impl::shut() {
  if (std::exchange(shut_, true)) {
    return;
  }
  if (http_) {
    http_->stop();
  }
  workers_.join();
  if (writer_) {
    writer_->stop();
  }
  if (said_ready_) {
    std::error_code ignored;
    std::filesystem::remove(*options_.ready_file, ignored);
  }
}

Server::Server(ServerOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}
Server::~Server() = default;

tl::expected<void, std::string> Server::start() {
  return impl_->start();
}
int Server::run() {
  return impl_->run();
}
void Server::stop() {
  impl_->stop();
}
void Server::post(std::function<void(MatchHost&)> work) {
  impl_->post(std::move(work));
}
Endpoint Server::agents_endpoint() const {
  return impl_->agents();
}
std::optional<Endpoint> Server::https_endpoint() const {
  return impl_->tls_page();
}

std::optional<Endpoint> Server::tls_endpoint() const {
  return impl_->tls_agents();
}
std::optional<Endpoint> Server::http_endpoint() const {
  return impl_->page();
}

}  // namespace poolhall::net
