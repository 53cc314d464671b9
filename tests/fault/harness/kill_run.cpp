#include "tests/fault/harness/kill_run.hpp"

#include <algorithm>
#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <csignal>
#include <fstream>
#include <memory>
#include <optional>
#include <ostream>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "server/storage/failpoint.hpp"
#include "tests/support/process/server_process.hpp"

namespace poolhall::fault {

namespace asio = boost::asio;
using asio::ip::tcp;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using storage::Failpoint;
using test_support::Child;
using test_support::ServerProcess;

namespace {

constexpr std::array failpoints{Failpoint::after_receive, Failpoint::after_simulate,
                                Failpoint::before_commit, Failpoint::after_commit,
                                Failpoint::before_send};
// A random kill comes so long after the server's start.
constexpr milliseconds soonest_kill{30};
constexpr milliseconds latest_kill{450};
// A failpoint kills when it has been passed so often at most.
constexpr int most_passes = 60;
constexpr milliseconds failpoint_patience{8'000};
constexpr milliseconds pairing_interval{40};
constexpr std::chrono::seconds next_challenge{1};
// One in so many chances to concede to an opponent who is away.
constexpr std::int64_t concessions_to_absent = 20;
constexpr std::chrono::seconds longest_end{60};

constexpr std::string_view settings = R"([log]
level = "warning"
[limits]
connections_per_address = 1000000
connections = 1000000
takeover_interval_seconds = 0
)";

// How one life of the server ends.
struct Order {
  std::optional<Failpoint> place{};  // unset: at a random moment
};

class KillRun {
 public:
  explicit KillRun(const KillOptions& options)
      : options_(options), random_(options.seed), life_(io_), pairing_(io_) {}

  KillReport go();

 private:
  void make_agents();
  void order_kills();
  void start_server();
  void watch_life(Order order);
  void await_failpoint(Failpoint place, SteadyTime give_up);
  void kill();
  void server_died();
  void let_games_end();
  void look_whether_ended();
  void pair_up();
  void finish();
  [[nodiscard]] bool all_quiet() const;
  [[nodiscard]] std::int64_t drawn(std::int64_t least, std::int64_t most) {
    return std::uniform_int_distribution<std::int64_t>(least, most)(random_);
  }

  KillOptions options_;
  std::mt19937_64 random_;
  asio::io_context io_{1};
  asio::steady_timer life_;
  asio::steady_timer pairing_;
  load::Traffic traffic_;
  Ledger ledger_;
  KillReport report_;
  std::vector<std::unique_ptr<Survivor>> agents_;
  std::vector<SteadyTime> challenged_;  // by pair
  std::vector<Order> orders_;           // what is still to come
  std::unique_ptr<ServerProcess> server_;
  std::vector<double> starts_ms_;
  bool ending_ = false;
  SteadyTime end_deadline_{};
};

KillReport KillRun::go() {
  const SteadyTime began = steady_clock::now();
  std::ofstream(options_.directory / "settings.toml") << settings;
  make_agents();
  order_kills();
  start_server();
  pair_up();
  io_.run();
  report_.findings = ledger_.compare(options_.directory / "server.db");
  Child verify(
      {options_.program.string(), "verify", "--db", (options_.directory / "server.db").string()},
      {.output = Child::Output::log, .log = options_.directory / "verify.log"});
  report_.verify_exit = verify.wait().exit_code.value_or(-1);
  report_.seconds = std::chrono::duration<double>(steady_clock::now() - began).count();
  for (const double start : starts_ms_) {
    report_.mean_start_ms += start / static_cast<double>(starts_ms_.size());
    report_.longest_start_ms = std::max(report_.longest_start_ms, start);
  }
  return std::move(report_);
}

void KillRun::make_agents() {
  for (std::uint32_t i = 0; i < 2 * options_.games; ++i) {
    agents_.push_back(
        std::make_unique<Survivor>(io_, traffic_,
                                   SurvivorSettings{.name = "survivor-" + std::to_string(i),
                                                    .seed = options_.seed * 100'003 + i},
                                   ledger_, report_.agents));
  }
  challenged_.resize(options_.games);
}

void KillRun::order_kills() {
  orders_.assign(options_.kills, Order{});
  for (const Failpoint place : failpoints) {
    orders_.insert(orders_.end(), options_.kills_a_failpoint, Order{place});
  }
  std::shuffle(orders_.begin(), orders_.end(), random_);
}

void KillRun::start_server() {
  std::vector<std::string> environment;
  const bool is_last = orders_.empty();
  const Order order = is_last ? Order{} : orders_.back();
  if (order.place) {
    environment.push_back("POOLHALL_FAILPOINT=" + std::string(storage::name(*order.place)) + ":" +
                          std::to_string(drawn(1, most_passes)));
  }
  const SteadyTime began = steady_clock::now();
  server_ = std::make_unique<ServerProcess>(test_support::ServerProcessOptions{
      .program = options_.program,
      .directory = options_.directory,
      .more_arguments = {"--config", (options_.directory / "settings.toml").string()},
      .environment = environment});
  starts_ms_.push_back(
      std::chrono::duration<double, std::milli>(steady_clock::now() - began).count());
  for (const auto& agent : agents_) {
    agent->server_is_at({asio::ip::address_v4::loopback(), server_->port()}, began);
  }
  if (is_last) {
    let_games_end();
  } else {
    orders_.pop_back();
    watch_life(order);
  }
}

void KillRun::watch_life(Order order) {
  if (order.place) {
    await_failpoint(*order.place, steady_clock::now() + failpoint_patience);
    return;
  }
  life_.expires_after(milliseconds{drawn(soonest_kill.count(), latest_kill.count())});
  life_.async_wait([this](const boost::system::error_code& error) {
    if (!error) {
      kill();
    }
  });
}

void KillRun::await_failpoint(Failpoint place, SteadyTime give_up) {
  if (server_->has_ended()) {
    static_cast<void>(server_->wait());
    ++report_.failpoint_kills[std::string(storage::name(place))];
    server_died();
    return;
  }
  if (steady_clock::now() > give_up) {
    kill();  // too little was played; it counts as a random one
    return;
  }
  life_.expires_after(milliseconds{5});
  life_.async_wait([this, place, give_up](const boost::system::error_code& error) {
    if (!error) {
      await_failpoint(place, give_up);
    }
  });
}

void KillRun::kill() {
  server_->kill();
  ++report_.random_kills;
  server_died();
}

void KillRun::server_died() {
  // What it had sent before it died is in the sockets and counts as told.
  life_.expires_after(milliseconds{2});
  life_.async_wait([this](const boost::system::error_code& error) {
    if (error) {
      return;
    }
    for (const auto& agent : agents_) {
      agent->server_is_gone();
    }
    if (options_.progress != nullptr && orders_.size() % 50 == 0) {
      *options_.progress << "  " << orders_.size() << " kills to go, " << ledger_.moves()
                         << " moves told so far\n"
                         << std::flush;
    }
    start_server();
  });
}

void KillRun::pair_up() {
  const SteadyTime now = steady_clock::now();
  // Some games end while an agent is away: it has to learn of it.
  for (std::size_t i = 0; i < agents_.size() && !ending_; ++i) {
    Survivor& opponent = *agents_[i ^ 1U];
    if (!agents_[i]->is_in() && opponent.is_in() && opponent.games() > 0 &&
        drawn(0, concessions_to_absent) == 0) {
      opponent.concede_games();
    }
  }
  for (std::size_t pair = 0; pair < challenged_.size() && !ending_; ++pair) {
    Survivor& one = *agents_[2 * pair];
    const Survivor& other = *agents_[2 * pair + 1];
    if (one.is_in() && other.is_in() && one.games() + other.games() == 0 &&
        now - challenged_[pair] > next_challenge) {
      challenged_[pair] = now;
      one.challenge(other.name());
    }
  }
  pairing_.expires_after(pairing_interval);
  pairing_.async_wait([this](const boost::system::error_code& error) {
    if (!error) {
      pair_up();
    }
  });
}

void KillRun::let_games_end() {
  ending_ = true;
  end_deadline_ = steady_clock::now() + longest_end;
  for (const auto& agent : agents_) {
    agent->hurry();
  }
  look_whether_ended();
}

bool KillRun::all_quiet() const {
  return std::all_of(agents_.begin(), agents_.end(), [](const auto& agent) {
    return agent->is_in() && agent->games() == 0 && agent->all_acknowledged();
  });
}

// Twice in a row: a challenge may be under way.
void KillRun::look_whether_ended() {
  static constexpr milliseconds look_again{300};
  life_.expires_after(look_again);
  life_.async_wait([this, quiet = all_quiet()](const boost::system::error_code& error) {
    if (error) {
      return;
    }
    if (quiet && all_quiet()) {
      report_.all_games_ended = true;
      finish();
    } else if (steady_clock::now() > end_deadline_) {
      for (const auto& agent : agents_) {
        if (!agent->is_in() || agent->games() > 0) {
          report_.agents.complaints.push_back(agent->standing());
        }
      }
      finish();
    } else {
      look_whether_ended();
    }
  });
}

void KillRun::finish() {
  for (const auto& agent : agents_) {
    agent->server_is_gone();
  }
  static_cast<void>(server_->terminate());
  io_.stop();
}

}  // namespace

KillReport run_kills(const KillOptions& options) {
  return KillRun(options).go();
}

void print(const KillReport& report, std::ostream& out) {
  out << "kills: " << report.random_kills << " at random moments";
  for (const auto& [place, hits] : report.failpoint_kills) {
    out << ", " << hits << " at " << place;
  }
  out << "; in " << static_cast<int>(report.seconds) << " s, a start of the server took "
      << static_cast<int>(report.mean_start_ms) << " ms, at most "
      << static_cast<int>(report.longest_start_ms) << " ms\n";
  const LedgerFindings& found = report.findings;
  const SurvivorCounts& agents = report.agents;
  out << "database: " << found.games << " games, " << found.turns << " turns, " << found.shots
      << " shots; agents were told of " << found.told << " moves and logged in " << agents.logins
      << " times\n"
      << "requests under way when the server died: " << agents.repeated << " repeated, "
      << agents.had_been_stored << " of them had been stored\n"
      << "acknowledged and lost: " << found.lost << "; played twice: " << found.played_twice
      << "; turns out of order: " << found.gaps << "; games stuck: " << found.stuck
      << "; wrong clocks: " << found.wrong_clocks << "\n"
      << "ends learned of at a later login: " << agents.ends_learned_late
      << "; never learned of: " << found.untold_ends << "; wrong: " << found.wrong_ends << "\n"
      << "poolhall verify: exit code " << report.verify_exit << "\n";
  if (!report.all_games_ended) {
    out << "not every game came to its end\n";
  }
  for (const std::string& line : found.examples) {
    out << "  " << line << '\n';
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(agents.complaints.size(), 10); ++i) {
    out << "  " << agents.complaints[i] << '\n';
  }
}

}  // namespace poolhall::fault
