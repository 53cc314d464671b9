#include "server/net/figures.hpp"

#include <fmt/format.h>

#include <string_view>

#include "protocol/json_writer.hpp"
#include "server/meter/work_meter.hpp"

namespace poolhall::net {

namespace {

template <class Value>
void metric(std::string& out, std::string_view name, std::string_view type, std::string_view help,
            Value value) {
  out += fmt::format("# HELP poolhall_{0} {2}\n# TYPE poolhall_{0} {1}\npoolhall_{0} {3}\n", name,
                     type, help, value);
}

double seconds(std::chrono::nanoseconds time) {
  return std::chrono::duration<double>(time).count();
}

void add_process(std::string& out) {
  out +=
      "# HELP poolhall_cpu_seconds_total Processor time by kind of work, from a sample.\n"
      "# TYPE poolhall_cpu_seconds_total counter\n";
  const auto times = meter::work_times();
  for (std::size_t i = 0; i < times.size(); ++i) {
    out += fmt::format("poolhall_cpu_seconds_total{{area=\"{}\"}} {}\n",
                       meter::name(static_cast<meter::Area>(i)), seconds(times[i]));
  }
  metric(out, "process_cpu_seconds_total", "counter", "Processor time of the server.",
         seconds(meter::process_time()));
  metric(out, "process_resident_memory_bytes", "gauge", "Memory that the server occupies.",
         meter::resident_bytes());
}

}  // namespace

web::Page health_page(const ArenaFigures& figures) {
  if (figures.storage_in_trouble) {
    return web::refusal(503, "database", "the database takes nothing; games stand");
  }
  return {200, "application/json", "{\"status\":\"ok\"}"};
}

std::string metrics_of(const ArenaFigures& figures, const storage::WriterStatistics& writing,
                       std::size_t spectators) {
  std::string out;
  metric(out, "connections", "gauge", "Agents' connections.", figures.connections);
  metric(out, "agents_here", "gauge", "Agents that are logged in.", figures.agents_here);
  metric(out, "agents_known", "gauge", "Agents in the database.", figures.agents_known);
  metric(out, "games", "gauge", "Games that go on.", figures.games);
  metric(out, "matches", "gauge", "Matches that go on.", figures.matches);
  metric(out, "spectators", "gauge", "People's browsers that watch a game or the lobby.",
         spectators);
  metric(out, "house_bots", "gauge", "Processes of house bots.", figures.house_bots);
  metric(out, "games_over_total", "counter", "Games that ended.", figures.games_over);
  metric(out, "storage_in_trouble", "gauge", "1 while the database takes nothing.",
         figures.storage_in_trouble ? 1 : 0);
  metric(out, "commits_total", "counter", "Transactions committed.", writing.commits);
  metric(out, "writes_total", "counter", "Pieces of work committed.", writing.written);
  metric(out, "writes_waiting", "gauge", "Pieces of work that wait.", writing.waiting);
  metric(out, "writer_busy_seconds_total", "counter", "Time spent writing.", seconds(writing.busy));
  metric(out, "largest_group", "gauge", "Most pieces of work in one transaction.",
         writing.largest_group);
  add_process(out);
  return out;
}

std::string live_json(const Arena& arena, States states) {
  protocol::JsonWriter out;
  out.begin_object().key("games").begin_array();
  arena.for_each_game([&](const LiveGame& live) {
    const match::Game& game = live.game();
    out.begin_object().key("game").integer(protocol::number(game.record().id));
    out.key("agents").begin_array();
    out.string(live.card().names[0]).string(live.card().names[1]).end_array();
    if (states == States::included) {
      out.key("turn").integer(game.state().turn);
      out.key("to_move").integer(rules::index(game.state().to_move));
      out.key("kind").string(rules::name(game.state().kind));
      out.key("state").raw(game.state_json());
    }
    out.end_object();
  });
  out.end_array().end_object();
  return std::move(out).text();
}

}  // namespace poolhall::net
