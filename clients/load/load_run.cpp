#include "clients/load/load_run.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <memory>
#include <queue>
#include <random>
#include <utility>

#include "clients/load/load_agent.hpp"
#include "clients/load/pace.hpp"

namespace poolhall::load {

namespace asio = boost::asio;
using std::chrono::steady_clock;

namespace {

// Logins under way at the same time: more would only wait for each other.
constexpr std::size_t logins_at_once = 64;
constexpr std::size_t descriptors_besides = 64;
// For everybody to be in, and for the first games to begin.
constexpr std::chrono::seconds patience{120};

std::chrono::nanoseconds seconds_of(double seconds) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(seconds));
}

// Room for that many connections; what was done about it, or nothing if that is not allowed.
std::optional<std::string> raise_descriptors(std::size_t connections, LoadReport& report) {
  const rlim_t wanted = connections + descriptors_besides;
  rlimit limit{};
  ::getrlimit(RLIMIT_NOFILE, &limit);
  if (limit.rlim_cur >= wanted) {
    return std::nullopt;
  }
  const rlim_t before = limit.rlim_cur;
  limit.rlim_cur = wanted;
  limit.rlim_max = std::max(limit.rlim_max, wanted);  // root may
  if (::setrlimit(RLIMIT_NOFILE, &limit) != 0) {
    return "this process may have " + std::to_string(before) + " file descriptors, " +
           std::to_string(wanted) + " are needed (ulimit -n)";
  }
  report.raised.push_back("file descriptors of this process: " + std::to_string(before) + " to " +
                          std::to_string(wanted));
  return std::nullopt;
}

std::string drawn_prefix() {
  std::random_device device;
  return "load" + std::to_string(device() % 1'000'000);
}

class Run final : public Overseer {
 public:
  explicit Run(const LoadOptions& options) : options_(options), clock_(io_), due_timer_(io_) {}

  LoadReport go();

  void agent_in(LoadAgent& agent) override;
  void turn_came(LoadAgent& agent) override;
  void answered(LoadAgent& agent, std::string_view code) override;
  void game_began(LoadAgent& agent) override;
  void game_over(LoadAgent& agent) override;
  void trouble(LoadAgent& agent, const std::string& what) override;

 private:
  enum class Stage : std::uint8_t { logging_in, starting, warming_up, measuring, over };
  // One game after another between two agents: those at 2 i and 2 i + 1.
  struct Table {
    bool playing = false;
    SteadyTime due{};  // of the next answer, in open loop
  };
  struct Due {
    SteadyTime when;
    std::size_t agent;
    bool operator<(const Due& other) const { return when > other.when; }
  };

  void make_agents();
  void connect_more();
  void start_games();
  void warm_up();
  void measure();
  void finish();
  void fail(const std::string& why);
  void answer_when_due(LoadAgent& agent);
  void arm();
  void answer_due();
  [[nodiscard]] std::size_t players() const { return 2UL * options_.games; }
  [[nodiscard]] bool is_player(const LoadAgent& agent) const { return agent.index < players(); }
  void later(std::chrono::nanoseconds wait, std::function<void()> what);

  LoadOptions options_;
  asio::io_context io_{1};
  asio::steady_timer clock_;
  asio::steady_timer due_timer_;
  Traffic traffic_;
  LoadReport report_;
  std::vector<std::unique_ptr<LoadAgent>> agents_;
  std::vector<Table> tables_;
  std::priority_queue<Due> due_;
  Pace pace_;
  std::size_t connected_ = 0;
  std::size_t in_ = 0;
  std::size_t playing_ = 0;
  Stage stage_ = Stage::logging_in;
  SteadyTime began_{};
};

LoadReport Run::go() {
  const std::size_t agents = players() + options_.idle;
  if (const auto failure = raise_descriptors(agents, report_)) {
    report_.failure = failure;
    return std::move(report_);
  }
  make_agents();
  connect_more();
  later(patience, [this] { fail("not all agents were in after two minutes"); });
  io_.run();
  return std::move(report_);
}

void Run::make_agents() {
  const std::string prefix = options_.prefix.empty() ? drawn_prefix() : options_.prefix;
  for (std::size_t i = 0; i < players() + options_.idle; ++i) {
    agents_.push_back(std::make_unique<LoadAgent>(
        io_, traffic_,
        LoadAgentSettings{prefix + '-' + std::to_string(i), options_.detail, options_.noise,
                          options_.seed},
        *this));
    agents_.back()->index = i;
  }
  tables_.resize(options_.games);
  if (options_.rate) {
    pace_.games = options_.games;
    pace_.period = seconds_of(static_cast<double>(options_.games) / *options_.rate);
  }
}

void Run::later(std::chrono::nanoseconds wait, std::function<void()> what) {
  clock_.expires_after(wait);
  clock_.async_wait([what = std::move(what)](const boost::system::error_code& error) {
    if (!error) {
      what();
    }
  });
}

void Run::connect_more() {
  while (connected_ < agents_.size() && connected_ - in_ < logins_at_once) {
    agents_[connected_++]->connect(options_.server);
  }
}

void Run::agent_in(LoadAgent& agent) {
  if (in_++ == 0 && agent.connections_allowed() < static_cast<std::int64_t>(agents_.size())) {
    fail("the server allows " + std::to_string(agent.connections_allowed()) +
         " connections from an address, " + std::to_string(agents_.size()) +
         " are wanted: set limits.connections_per_address in its settings");
    return;
  }
  connect_more();
  if (in_ == agents_.size()) {
    start_games();
  }
}

void Run::start_games() {
  stage_ = Stage::starting;
  if (options_.on_stage) {
    options_.on_stage("logged_in");
  }
  if (options_.games == 0) {
    warm_up();
    return;
  }
  later(patience, [this] { fail("not all games had begun after two minutes"); });
  for (std::size_t i = 0; i < players(); i += 2) {
    agents_[i]->challenge(agents_[i + 1]->name());
  }
}

void Run::game_began(LoadAgent& agent) {
  Table& table = tables_.at(agent.index / 2);
  if (std::exchange(table.playing, true)) {
    return;
  }
  if (stage_ == Stage::starting) {
    if (playing_ == 0) {
      pace_.from = steady_clock::now();
    }
    if (options_.rate) {
      table.due = pace_.first_due(agent.index / 2, steady_clock::now());
    }
    if (++playing_ == options_.games) {
      warm_up();
    }
  }
}

void Run::warm_up() {
  stage_ = Stage::warming_up;
  later(seconds_of(options_.warm_up), [this] { measure(); });
}

void Run::measure() {
  stage_ = Stage::measuring;
  began_ = steady_clock::now();
  report_.bytes_in = traffic_.bytes_in;
  report_.bytes_out = traffic_.bytes_out;
  if (options_.on_stage) {
    options_.on_stage("measuring");
  }
  later(seconds_of(options_.seconds), [this] { finish(); });
}

void Run::finish() {
  const SteadyTime now = steady_clock::now();
  stage_ = Stage::over;
  report_.seconds = std::chrono::duration<double>(now - began_).count();
  report_.bytes_in = traffic_.bytes_in - report_.bytes_in;
  report_.bytes_out = traffic_.bytes_out - report_.bytes_out;
  for (const auto& agent : agents_) {
    if (agent->sent() && *agent->sent() < now) {
      ++report_.unanswered;
      report_.latencies.add(now - *agent->sent());
    }
  }
  // What was due and could not be sent, for the turn had not come.
  for (const Table& table : tables_) {
    if (options_.rate && table.due + pace_.period < now) {
      ++report_.unanswered;
      report_.latencies.add(now - table.due);
    }
  }
  if (options_.on_stage) {
    options_.on_stage("measured");
  }
  io_.stop();
}

void Run::fail(const std::string& why) {
  report_.failure = why;
  stage_ = Stage::over;
  io_.stop();
}

void Run::turn_came(LoadAgent& agent) {
  if (!agent.has_turn()) {
    fail("a turn that cannot be read came");
  } else if (!options_.rate) {
    agent.answer(steady_clock::now());
  } else {
    answer_when_due(agent);
  }
}

void Run::answer_when_due(LoadAgent& agent) {
  const Table& table = tables_.at(agent.index / 2);
  due_.push({table.due, agent.index});
  if (due_.top().agent == agent.index) {
    arm();
  }
}

void Run::arm() {
  if (due_.empty()) {
    return;
  }
  due_timer_.expires_at(due_.top().when);
  due_timer_.async_wait([this](const boost::system::error_code& error) {
    if (!error) {
      answer_due();
    }
  });
}

void Run::answer_due() {
  while (!due_.empty() && due_.top().when <= steady_clock::now()) {
    LoadAgent& agent = *agents_[due_.top().agent];
    due_.pop();
    if (agent.has_turn()) {
      Table& table = tables_.at(agent.index / 2);
      agent.answer(table.due);
      table.due += pace_.period;
    }
  }
  arm();
}

void Run::answered(LoadAgent& agent, std::string_view code) {
  if (stage_ != Stage::measuring) {
    return;
  }
  report_.latencies.add(steady_clock::now() - *agent.sent());
  ++report_.answers;
  if (!code.empty()) {
    ++(code.starts_with("bad_") ? report_.refusals : report_.errors)[std::string(code)];
  } else if (agent.last_was_shot()) {
    ++report_.shots;
  }
}

void Run::game_over(LoadAgent& agent) {
  Table& table = tables_.at(agent.index / 2);
  table.playing = false;
  if (agent.index % 2 == 1) {
    return;
  }
  if (stage_ == Stage::measuring) {
    ++report_.games_over;
  }
  agent.challenge(agents_[agent.index + 1]->name());
}

void Run::trouble(LoadAgent& agent, const std::string& what) {
  ++report_.errors[what];
  if (stage_ == Stage::logging_in) {
    fail("agent " + agent.name() + " cannot log in: " + what);
  }
}

}  // namespace

LoadReport run_load(const LoadOptions& options) {
  return Run(options).go();
}

}  // namespace poolhall::load
