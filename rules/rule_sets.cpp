// The games there are.
#include "rules/common_clauses.hpp"
#include "rules/eight_ball.hpp"
#include "rules/game_rules.hpp"
#include "rules/nine_ball.hpp"

namespace poolhall::rules {

const GameRules& game_rules(RuleSet rules) {
  return rules == RuleSet::nine_ball ? nine_ball_rules() : eight_ball_rules();
}

std::vector<const Clause*> all_clauses() {
  std::vector<const Clause*> all(clauses::common.begin(), clauses::common.end());
  for (const GameRules* game : {&eight_ball_rules(), &nine_ball_rules()}) {
    all.insert(all.end(), game->clauses.begin(), game->clauses.end());
  }
  return all;
}

}  // namespace poolhall::rules
