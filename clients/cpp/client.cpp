#include "clients/cpp/client.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/asio/use_awaitable.hpp>

#include <algorithm>
#include <chrono>
#include <exception>
#include <random>
#include <utility>

#include "clients/cpp/awaited.hpp"
#include "clients/cpp/connection.hpp"
#include "clients/cpp/transport.hpp"

namespace poolhall::client {

namespace asio = boost::asio;
using SteadyClock = std::chrono::steady_clock;

namespace {

class Backoff {
 public:
  Backoff(std::chrono::milliseconds first, std::chrono::milliseconds last)
      : first_(first), last_(last), next_(first) {}

  void reset() { next_ = first_; }

  // Between half and all of the current delay, so that a crowd of bots does not come back in step.
  std::chrono::milliseconds next() {
    const auto delay = std::exchange(next_, std::min(next_ * 2, last_));
    std::uniform_int_distribution<std::int64_t> jitter(delay.count() / 2, delay.count());
    return std::chrono::milliseconds(jitter(generator_));
  }

 private:
  std::chrono::milliseconds first_;
  std::chrono::milliseconds last_;
  std::chrono::milliseconds next_;
  std::minstd_rand generator_{std::random_device{}()};
};

}  // namespace

// Everything but the thinking happens on the thread that called run().
class Client::Life : public Outside {
 public:
  Life(ClientOptions options, PlayerFactory factory)
      : options_(std::move(options)),
        agent_(options_.agent, std::move(factory), *this),
        signals_(io_),
        pause_(io_),
        watch_(io_),
        thinkers_(std::max(options_.threads, 1U)) {}

  End run() {
    for (const int signal : options_.stop_signals) {
      signals_.add(signal);
    }
    if (!options_.stop_signals.empty()) {
      signals_.async_wait([this](const boost::system::error_code& error, int) {
        if (!error) {
          finish({Ending::stopped, "stopped by a signal"});
        }
      });
    }
    asio::co_spawn(io_, live(), [this](const std::exception_ptr& failure) {
      failure_ = failure_ ? failure_ : failure;
      signals_.cancel();
    });
    io_.run();
    thinkers_.join();
    if (failure_) {
      std::rethrow_exception(failure_);
    }
    return end_.value_or(End{});
  }

  void stop() {
    asio::post(io_, [this] { finish({Ending::stopped, "stopped by the host program"}); });
  }

  // ---- Outside ----

  void send(std::string line) override {
    if (connection_) {
      connection_->send(std::move(line));
    }
  }

  void think(const GameInfo& info, std::shared_ptr<Player> player, const TurnTask& task) override {
    asio::post(thinkers_, [this, info, player = std::move(player), task,
                           asked = std::chrono::steady_clock::now()] {
      try {
        // It may have waited for another game's move to be chosen.
        Clock clock = task.clock;
        clock.own -= std::chrono::duration_cast<std::chrono::microseconds>(
            std::chrono::steady_clock::now() - asked);
        clock.own = std::max(clock.own, std::chrono::microseconds{0});
        const Move move = player->choose({info, task.state, clock, task.key.refusals, task.shots});
        asio::post(io_, [this, game = game_id(info), key = task.key, move] {
          agent_.move_chosen(game, key, move);
        });
      } catch (...) {
        asio::post(io_, [this, failure = std::current_exception()] {
          failure_ = failure;
          finish({Ending::stopped, "a player failed"});
        });
      }
    });
  }

  void wake(protocol::GameId game, std::chrono::milliseconds delay) override {
    auto timer = std::make_shared<asio::steady_timer>(io_, delay);
    timer->async_wait([this, game, timer](const boost::system::error_code& error) {
      if (!error && !end_) {
        agent_.send_answer_again(game);
      }
    });
  }

 private:
  void finish(End end) {
    if (!end_) {
      end_ = std::move(end);
    }
    pause_.cancel();
    if (connection_) {
      connection_->close();
    } else {
      io_.stop();  // an attempt to connect may last for minutes
    }
  }

  asio::awaitable<tl::expected<std::unique_ptr<Transport>, ConnectionError>> connect() const {
    if (options_.tls) {
      co_return co_await connect_tls(options_.host, options_.port, *options_.tls);
    }
    co_return co_await connect_tcp(options_.host, options_.port);
  }

  asio::awaitable<void> live() {
    Backoff backoff(options_.first_backoff, options_.last_backoff);
    while (!end_) {
      auto transport = co_await connect();
      if (end_) {
        break;
      }
      if (transport) {
        co_await serve(*std::move(transport));
        if (was_logged_in_) {
          backoff.reset();
        }
      } else {
        log(transport.error().reason);
      }
      if (!end_) {
        pause_.expires_after(backoff.next());
        co_await pause_.async_wait(awaited);
      }
    }
  }

  // One connection, from its first line to its end.
  asio::awaitable<void> serve(std::unique_ptr<Transport> transport) {
    connection_ = std::make_shared<Connection>(io_.get_executor(), std::move(transport),
                                               protocol::Limits{}.server_line_bytes);
    connected_at_ = last_line_at_ = SteadyClock::now();
    was_logged_in_ = false;
    agent_.begin_session();
    asio::co_spawn(io_, watch(connection_), asio::detached);
    while (!end_) {
      const auto line = co_await connection_->read_line();
      if (!line) {
        log("connection lost: " + line.error().reason);
        break;
      }
      last_line_at_ = SteadyClock::now();
      if (auto end = agent_.line_came(*line)) {
        finish(*std::move(end));
      }
      was_logged_in_ = was_logged_in_ || agent_.is_logged_in();
      if (agent_.is_put_off()) {
        break;
      }
    }
    connection_->close();
    watch_.cancel();
    connection_.reset();
    agent_.session_ended();
  }

  // Gives up a connection on which nothing happens any more.
  asio::awaitable<void> watch(std::shared_ptr<Connection> watched) {
    const auto step = std::min(options_.login_deadline, options_.silence) / 2;
    while (connection_ == watched) {
      watch_.expires_after(step);
      co_await watch_.async_wait(awaited);
      const auto now = SteadyClock::now();
      if (connection_ != watched) {
        co_return;
      }
      const bool is_late = !agent_.is_logged_in() && now - connected_at_ > options_.login_deadline;
      if (is_late || now - last_line_at_ > 2 * options_.silence) {
        watched->close();
        co_return;
      }
      if (now - last_line_at_ > options_.silence) {
        agent_.send_ping();
      }
    }
  }

  void log(std::string_view line) const {
    if (options_.agent.log) {
      options_.agent.log(line);
    }
  }

  ClientOptions options_;
  asio::io_context io_{1};
  Agent agent_;
  asio::signal_set signals_;
  asio::steady_timer pause_;  // between two connections
  asio::steady_timer watch_;
  std::shared_ptr<Connection> connection_;
  SteadyClock::time_point connected_at_{};
  SteadyClock::time_point last_line_at_{};
  bool was_logged_in_ = false;
  std::optional<End> end_{};
  std::exception_ptr failure_;
  // Last, so that no thought outlives what it reports to.
  asio::thread_pool thinkers_;
};

Client::Client(ClientOptions options, PlayerFactory factory)
    : life_(std::make_unique<Life>(std::move(options), std::move(factory))) {}

Client::~Client() = default;

End Client::run() {
  return life_->run();
}

void Client::stop() {
  life_->stop();
}

End play(ClientOptions options, std::function<Move(const TurnView&)> choose) {
  return Client(std::move(options), player_from(std::move(choose))).run();
}

}  // namespace poolhall::client
