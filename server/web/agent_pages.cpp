// Pages of agents: what they won, and how their ratings went.
#include <algorithm>
#include <map>
#include <vector>

#include "server/ratings/glicko2.hpp"
#include "server/web/page_parts.hpp"

namespace poolhall::web {

namespace {

using ratings::Glicko2Game;
using ratings::Glicko2Rating;

// Glickman recommends 10 to 15 games a player in a period.
constexpr std::size_t games_in_period = 10;
constexpr double tau = 0.5;
constexpr std::size_t most_games_of_agent = 200;

struct RatingPoint {
  storage::UnixMicros when{};
  std::uint32_t games = 0;  // until then
  Glicko2Rating rating;
};

struct Career {
  std::uint32_t wins = 0;
  std::uint32_t losses = 0;
  std::uint32_t draws = 0;
  Glicko2Rating rating;
  std::vector<RatingPoint> history;

  [[nodiscard]] std::uint32_t games() const { return wins + losses + draws; }
};
using Careers = std::map<storage::AgentId, Career>;

// Glicko-2 in periods: one ends when somebody in it has played enough games, the last with the
// last game.
class Periods {
 public:
  void add(const storage::ResultRecord& result) {
    for (const std::size_t seat : {std::size_t{0}, std::size_t{1}}) {
      Career& career = careers_[result.agents[seat]];
      const auto winner = result.result.winner;
      const double score = !winner ? 0.5 : rules::index(*winner) == seat ? 1 : 0;
      ++(score == 1 ? career.wins : score == 0 ? career.losses : career.draws);
      games_[result.agents[seat]].push_back({result.agents[1 - seat], score});
    }
    last_ = result.finished;
    const auto enough = [this](storage::AgentId agent) {
      return games_[agent].size() >= games_in_period;
    };
    if (enough(result.agents[0]) || enough(result.agents[1])) {
      close();
    }
  }

  [[nodiscard]] Careers take() {
    close();
    return std::move(careers_);
  }

 private:
  struct Game {
    storage::AgentId opponent{};
    double score = 0;
  };

  void close() {
    std::map<storage::AgentId, Glicko2Rating> after;
    for (const auto& [agent, games] : games_) {
      std::vector<Glicko2Game> rated;
      for (const Game& game : games) {
        rated.push_back({careers_[game.opponent].rating, game.score});
      }
      after[agent] = ratings::glicko2(careers_[agent].rating, rated, tau);
    }
    for (const auto& [agent, rating] : after) {
      Career& career = careers_[agent];
      career.rating = rating;
      career.history.push_back({last_, career.games(), rating});
    }
    games_.clear();
  }

  Careers careers_;
  std::map<storage::AgentId, std::vector<Game>> games_;  // of this period
  storage::UnixMicros last_{};
};

std::vector<storage::ResultRecord> seen(std::vector<storage::ResultRecord> results,
                                        const Horizon& horizon) {
  std::erase_if(results, [&](const auto& result) { return !horizon.sees(result.finished); });
  return results;
}

Careers careers_of(const std::vector<storage::ResultRecord>& results) {
  Periods periods;
  for (const storage::ResultRecord& result : results) {
    periods.add(result);
  }
  return periods.take();
}

void write_rating(JsonWriter& out, const Glicko2Rating& rating) {
  out.key("rating").number(rating.rating).key("deviation").number(rating.deviation);
}

void write_agent(JsonWriter& out, const storage::AgentRecord& agent, const Career& career) {
  out.key("agent").string(agent.name).key("house").boolean(agent.house_bot.has_value());
  out.key("games").integer(career.games()).key("wins").integer(career.wins);
  out.key("losses").integer(career.losses).key("draws").integer(career.draws);
  write_rating(out, career.rating);
}

void write_history(JsonWriter& out, const Career& career) {
  out.key("history").begin_array();
  for (const RatingPoint& point : career.history) {
    out.begin_object().key("when_ms").integer(unix_ms(point.when));
    out.key("games").integer(point.games);
    write_rating(out, point.rating);
    out.end_object();
  }
  out.end_array();
}

// The newest first.
void write_games(JsonWriter& out, const std::vector<storage::ResultRecord>& results,
                 storage::AgentId agent, const Names& names) {
  std::size_t listed = 0;
  out.key("last_games").begin_array();
  for (auto result = results.rbegin(); result != results.rend() && listed < most_games_of_agent;
       ++result) {
    if (result->agents[0] != agent && result->agents[1] != agent) {
      continue;
    }
    ++listed;
    out.begin_object().key("game").integer(protocol::number(result->game));
    write_agents(out, result->agents, names);
    out.key("rules").string(rules::name(result->rules)).key("winner");
    if (result->result.winner) {
      out.integer(rules::index(*result->result.winner));
    } else {
      out.null();
    }
    out.key("reason").string(rules::name(result->result.reason));
    out.key("finished_ms").integer(unix_ms(result->finished)).end_object();
  }
  out.end_array();
}

}  // namespace

Page agents_page(Reader& reader, const Horizon& horizon) {
  const auto agents = reader.agents();
  auto results = reader.results();
  if (!agents || !results) {
    return unreadable(agents ? results.error() : agents.error());
  }
  Careers careers = careers_of(seen(std::move(*results), horizon));
  JsonWriter out;
  out.begin_object().key("agents").begin_array();
  for (const storage::AgentRecord& agent : *agents) {
    out.begin_object();
    write_agent(out, agent, careers[agent.id]);
    write_history(out, careers[agent.id]);
    out.end_object();
  }
  out.end_array().end_object();
  return page_of(out);
}

Page agent_page(Reader& reader, std::string_view name, const Horizon& horizon) {
  const auto agent = reader.agent_named(name);
  auto all = reader.results();
  const auto names = names_of(reader);
  if (!agent || !all || !names) {
    return unreadable(!agent ? agent.error() : !all ? all.error() : names.error());
  }
  if (!*agent) {
    return not_found("there is no such agent");
  }
  const auto results = seen(std::move(*all), horizon);
  Careers careers = careers_of(results);
  JsonWriter out;
  out.begin_object();
  write_agent(out, **agent, careers[(*agent)->id]);
  write_history(out, careers[(*agent)->id]);
  write_games(out, results, (*agent)->id, *names);
  out.end_object();
  return page_of(out);
}

}  // namespace poolhall::web
