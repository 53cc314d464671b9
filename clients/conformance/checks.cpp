#include "clients/conformance/checks.hpp"

#include <iterator>

#include "clients/conformance/positions.hpp"

namespace poolhall::conformance {
namespace {

void play_position(Host& host, GamePlan plan) {
  host.arrive();
  HostedGame& game = host.begin(std::move(plan));
  host.hand_turn(game);
  const auto accepted = host.acceptable(game);
  if (!accepted) {
    throw Stop{Verdict::warning, "three refusals: the turn is lost"};
  }
  host.store(*accepted);
  host.reply_to(*accepted);
}

std::vector<Script> all_scripts() {
  std::vector<Script> all;
  for (std::vector<Script> part :
       {session_scripts(), line_scripts(), turn_scripts(), return_scripts(), position_scripts()}) {
    all.insert(all.end(), std::make_move_iterator(part.begin()),
               std::make_move_iterator(part.end()));
  }
  return all;
}

}  // namespace

std::vector<Script> position_scripts() {
  std::vector<Script> scripts;
  for (const Position& position : positions()) {
    scripts.push_back(
        {position.info, [make = position.plan](Host& host) { play_position(host, make()); }});
  }
  return scripts;
}

const std::vector<Script>& scripts() {
  static const std::vector<Script> all = all_scripts();
  return all;
}

}  // namespace poolhall::conformance
