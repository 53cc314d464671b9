#include "tests/fault/harness/bad_run.hpp"

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <thread>
#include <utility>

#include "server/net/server.hpp"
#include "server/storage/sqlite_database.hpp"
#include "tests/fault/harness/bad_client.hpp"
#include "tests/fault/harness/end_log.hpp"
#include "tests/fault/harness/survivor.hpp"

namespace poolhall::fault {

namespace asio = boost::asio;
using storage::TurnRecord;

namespace {

constexpr std::size_t most_differences = 10;
constexpr std::chrono::milliseconds look_again{20};
constexpr std::chrono::seconds longest_run{120};

// Who plays, and a server in this process that they play on.
class GoodGames {
 public:
  GoodGames(const BadOptions& options, const std::filesystem::path& database);
  ~GoodGames();
  GoodGames(const GoodGames&) = delete;
  GoodGames& operator=(const GoodGames&) = delete;

  // Until all games are over; `meanwhile` is called when they have begun.
  void play(const std::function<void(std::uint16_t port)>& meanwhile);
  [[nodiscard]] const SurvivorCounts& counts() const { return counts_; }

 private:
  void await(const std::function<bool()>& state, const char* what);
  void start_matches();
  [[nodiscard]] bool all_in() const;
  [[nodiscard]] bool all_done() const;

  BadOptions options_;
  net::Server server_;
  std::thread serving_;
  asio::io_context io_{1};
  load::Traffic traffic_;
  Ledger ledger_;
  SurvivorCounts counts_;
  std::vector<std::unique_ptr<Survivor>> agents_;
};

net::ServerOptions server_options(const std::filesystem::path& database) {
  net::ServerOptions options;
  options.settings.listen = "127.0.0.1:0";
  options.settings.http = "";
  options.settings.database = database.string();
  options.settings.worker_threads = 2;
  options.settings.limits = limits_for_bad_clients();
  options.signals = net::Signals::left_alone;
  return options;
}

GoodGames::GoodGames(const BadOptions& options, const std::filesystem::path& database)
    : options_(options), server_(server_options(database)) {
  if (const auto started = server_.start(); !started) {
    throw std::runtime_error(started.error());
  }
  serving_ = std::thread([this] { static_cast<void>(server_.run()); });
  for (std::uint32_t i = 0; i < 2 * options_.games; ++i) {
    agents_.push_back(
        std::make_unique<Survivor>(io_, traffic_,
                                   SurvivorSettings{.name = "good-" + std::to_string(i),
                                                    .seed = options_.seed * 1'009 + i,
                                                    .longest_thought = options_.longest_thought,
                                                    .goes_away = 0,
                                                    .concedes = 0},
                                   ledger_, counts_));
  }
}

GoodGames::~GoodGames() {
  server_.stop();
  serving_.join();
}

void GoodGames::await(const std::function<bool()>& state, const char* what) {
  const auto deadline = std::chrono::steady_clock::now() + longest_run;
  while (!state()) {
    io_.restart();
    io_.run_for(look_again);
    if (std::chrono::steady_clock::now() > deadline) {
      throw std::runtime_error(std::string("not within two minutes: ") + what);
    }
  }
}

bool GoodGames::all_in() const {
  return std::all_of(agents_.begin(), agents_.end(),
                     [](const auto& agent) { return agent->is_in(); });
}

bool GoodGames::all_done() const {
  return std::all_of(agents_.begin(), agents_.end(), [](const auto& agent) {
    return agent->ends() == 1 && agent->all_acknowledged();
  });
}

// Given seeds and no noise: what is played follows from the agents' answers alone.
void GoodGames::start_matches() {
  server_.post([options = options_](net::MatchHost& host) {
    const std::string tournament = "good";
    static_cast<void>(host.open_tournament({.id = tournament, .title = "", .settings = ""}));
    for (std::uint32_t i = 0; i < 2 * options.games; ++i) {
      host.enter({.tournament = tournament, .name = "good-" + std::to_string(i)});
    }
    for (std::uint32_t i = 0; i < options.games; ++i) {
      net::MatchOrder order;
      order.tournament = tournament;
      order.pairing = i;
      order.agents = {"good-" + std::to_string(2 * i), "good-" + std::to_string(2 * i + 1)};
      order.terms.noise = "none";
      order.seed = options.seed + i;
      host.start_match(order);
    }
  });
}

void GoodGames::play(const std::function<void(std::uint16_t)>& meanwhile) {
  const std::uint16_t port = server_.agents_endpoint().port;
  for (const auto& agent : agents_) {
    agent->server_is_at({asio::ip::address_v4::loopback(), port}, std::chrono::steady_clock::now());
  }
  await([this] { return all_in(); }, "all good clients are in");
  start_matches();
  std::thread others([&] { meanwhile(port); });
  try {
    await([this] { return all_done(); }, "all good games are over");
  } catch (...) {
    others.join();
    throw;
  }
  others.join();
}

// All bad clients at the same time, each as often as the rounds say.
std::vector<BadEnd> let_them_come(std::uint16_t port, std::uint32_t rounds, EndLog& log) {
  const std::vector<BadClient>& clients = bad_clients();
  std::vector<BadEnd> ends(clients.size());
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < clients.size(); ++i) {
    threads.emplace_back([&client = clients[i], &end = ends[i], port, rounds, &log] {
      end.client = client.name;
      for (std::uint32_t round = 0; round < rounds; ++round) {
        try {
          const BadVisit visit = client.visit(port, log);
          ++end.visits;
          end.reason = log.await_end(visit.local_port).value_or("");
          if (visit.fault) {
            end.faults.push_back(*visit.fault);
          }
          if (end.reason.empty() || !end.reason.starts_with(client.expected)) {
            end.faults.push_back("expected \"" + std::string(client.expected) + "\"");
          }
        } catch (const std::exception& error) {
          end.faults.emplace_back(error.what());
        }
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  return ends;
}

using Rows = std::vector<std::vector<TurnRecord>>;

Rows good_rows(const std::filesystem::path& database, std::uint32_t games) {
  const auto reader = storage::open_sqlite_reader(database);
  if (!reader) {
    throw std::runtime_error(reader.error().reason);
  }
  Rows all;
  for (std::int64_t id = 1; id <= games; ++id) {
    std::vector<TurnRecord>& rows = all.emplace_back();
    const auto read = (*reader)->each_turn(protocol::GameId{id}, [&rows](const TurnRecord& row) {
      rows.push_back(row);
      return true;
    });
    if (!read) {
      throw std::runtime_error(read.error().reason);
    }
  }
  return all;
}

// Clocks and dates are another day's; everything else is the game.
TurnRecord without_time(TurnRecord row) {
  row.clock = {};
  row.stored = {};
  row.checksum = {};
  return row;
}

void compare(const Rows& alone, const Rows& among, BadReport& report) {
  for (std::size_t game = 0; game < alone.size(); ++game) {
    ++report.games;
    const std::size_t turns = std::max(alone[game].size(), among[game].size());
    for (std::size_t turn = 0; turn < turns; ++turn) {
      ++report.turns;
      const bool same = turn < std::min(alone[game].size(), among[game].size()) &&
                        without_time(alone[game][turn]) == without_time(among[game][turn]);
      if (!same && report.differences.size() < most_differences) {
        report.differences.push_back("game " + std::to_string(game + 1) + ", turn " +
                                     std::to_string(turn + 1));
      }
    }
    if (alone[game].empty() || !alone[game].back().result) {
      report.differences.push_back("game " + std::to_string(game + 1) + " has no end");
    }
  }
}

}  // namespace

bool BadReport::sound() const {
  return differences.empty() && complaints.empty() && turns > 0 &&
         std::all_of(clients.begin(), clients.end(),
                     [](const BadEnd& end) { return end.faults.empty() && end.visits > 0; });
}

BadReport run_bad_clients(const BadOptions& options) {
  EndLog log;
  BadReport report;
  const std::filesystem::path alone = options.directory / "alone.db";
  const std::filesystem::path among = options.directory / "among.db";
  {
    GoodGames games(options, alone);
    games.play([](std::uint16_t) {});
  }
  {
    GoodGames games(options, among);
    games.play(
        [&](std::uint16_t port) { report.clients = let_them_come(port, options.rounds, log); });
    report.complaints = games.counts().complaints;
  }
  compare(good_rows(alone, options.games), good_rows(among, options.games), report);
  return report;
}

void print(const BadReport& report, std::ostream& out) {
  out << "bad clients, and why the server ended their connections:\n";
  for (const BadEnd& end : report.clients) {
    out << "  " << end.client << " (" << end.visits << "): " << end.reason << '\n';
    for (const std::string& fault : end.faults) {
      out << "    NOT AS IT SHOULD BE: " << fault << '\n';
    }
  }
  out << "good games: " << report.games << " games, " << report.turns << " turns, "
      << (report.differences.empty() ? "all the same to the last bit as without bad clients"
                                     : "DIFFERENT from those without bad clients")
      << '\n';
  for (const std::string& line : report.differences) {
    out << "  " << line << '\n';
  }
  for (const std::string& line : report.complaints) {
    out << "  a good client complains: " << line << '\n';
  }
}

}  // namespace poolhall::fault
