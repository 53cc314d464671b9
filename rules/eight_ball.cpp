#include "rules/eight_ball.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "rules/common_clauses.hpp"
#include "rules/turns.hpp"

namespace poolhall::rules {
namespace eight_ball {
namespace {

// An impossible state that remembers another game counts as one with an open table.
EightBallMemory memory_of(const GameState& state) {
  const auto* memory = std::get_if<EightBallMemory>(&state.memory);
  return memory == nullptr ? EightBallMemory{} : *memory;
}

// 8 in the middle of the third row, a solid and a stripe in the two back corners, the rest random.
std::vector<BallId> rack_order(RackRandom& random) {
  constexpr std::size_t middle = 4;
  constexpr std::size_t left_corner = 10;
  constexpr std::size_t right_corner = 14;
  std::vector<unsigned> solids{1, 2, 3, 4, 5, 6, 7};
  std::vector<unsigned> stripes{9, 10, 11, 12, 13, 14, 15};
  random.shuffle(solids);
  random.shuffle(stripes);
  const bool solid_left = random.below(2) == 0;
  std::vector<unsigned> rest(solids.begin() + 1, solids.end());
  rest.insert(rest.end(), stripes.begin() + 1, stripes.end());
  random.shuffle(rest);
  std::vector<BallId> order(15);
  auto next = rest.begin();
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == middle) {
      order[i] = the_eight;
    } else if (i == left_corner || i == right_corner) {
      order[i] = BallId(static_cast<std::uint8_t>(
          solid_left == (i == left_corner) ? solids.front() : stripes.front()));
    } else {
      order[i] = BallId(static_cast<std::uint8_t>(*next++));
    }
  }
  return order;
}

std::vector<BallId> first_balls(const GameState& state) {
  if (state.kind == TurnKind::break_shot) {
    return object_balls_on_table(state);
  }
  return state.kind == TurnKind::decision ? std::vector<BallId>{} : balls_on(state);
}

std::vector<BallId> balls_to_call(const GameState& state) {
  const bool no_call = applies(clauses::break_no_call, state.kind == TurnKind::break_shot);
  return no_call || state.kind == TurnKind::decision ? std::vector<BallId>{} : balls_on(state);
}

std::vector<Call::Kind> legal_calls(const GameState& state) {
  if (state.kind == TurnKind::decision) {
    return {};
  }
  if (applies(clauses::break_no_call, state.kind == TurnKind::break_shot)) {
    return {Call::Kind::none};
  }
  return {Call::Kind::pocket, Call::Kind::safety};
}

tl::unexpected<Refusal> impossible(std::string field, std::string reason) {
  return tl::unexpected(Refusal{RefusalCode::bad_state, std::move(field), std::move(reason)});
}

Expected<void> check_options(const GameState& state) {
  using enum Decision;
  struct Choice {
    std::vector<Decision> options;
    bool by_breaker;
    bool eight_down;
  };
  static const std::array<Choice, 4> choices{
      {{{accept, rerack_chooser_breaks, rerack_breaker_breaks}, false, false},
       {{accept, accept_ball_in_hand}, false, false},
       {{spot_eight, rerack_breaker_breaks}, true, true},
       {{spot_eight, rerack_chooser_breaks}, false, true}}};
  const auto found = std::find_if(choices.begin(), choices.end(), [&](const Choice& choice) {
    return choice.options == state.options;
  });
  if (found == choices.end()) {
    return impossible("/options", "options that 8-ball never offers together");
  }
  if (found->by_breaker != (state.to_move == state.breaker)) {
    return impossible("/to_move", found->by_breaker
                                      ? "these options are the breaker's, not the opponent's"
                                      : "these options are the opponent's, not the breaker's");
  }
  if (found->eight_down != (find_ball(state, the_eight)->where == Whereabouts::pocketed)) {
    return impossible("/options", found->eight_down
                                      ? "spot_eight is offered, but the 8 is not down"
                                      : "the 8 is down, but spot_eight is not offered");
  }
  return {};
}

Expected<void> check_groups(const GameState& state) {
  if (!memory_of(state).first_seat_group) {
    return {};
  }
  if (state.kind == TurnKind::break_shot || state.kind == TurnKind::decision) {
    return impossible("/groups", "groups are settled, but the table is open until after the break");
  }
  const bool any = std::any_of(state.balls.begin(), state.balls.end(), [](const BallPlace& place) {
    return place.where == Whereabouts::pocketed && rules::group_of(place.id).has_value();
  });
  if (!any) {
    return impossible("/groups", "groups are settled, but no ball of either group is pocketed");
  }
  return {};
}

Expected<void> check(const GameState& state) {
  if (!std::holds_alternative<EightBallMemory>(state.memory)) {
    return impossible("/rules", "the state remembers another game than 8-ball");
  }
  if (auto groups = check_groups(state); !groups) {
    return groups;
  }
  if (state.result) {
    return {};
  }
  if (state.kind == TurnKind::decision) {
    return check_options(state);
  }
  if (!on_table(state, the_eight)) {
    return impossible("/balls/8", "the 8 is down, but the game goes on");
  }
  return {};
}

Verdict judge(const Shot& shot) {
  return shot.ready.kind == TurnKind::break_shot ? judge_break(shot) : judge_shot(shot);
}

}  // namespace

std::optional<Group> group_of_seat(const GameState& state, Seat seat) {
  return rules::group_of(memory_of(state), seat);
}

bool is_cleared(const GameState& state, std::optional<Group> group) {
  const std::vector<BallId> balls = object_balls_on_table(state);
  return std::none_of(balls.begin(), balls.end(), [group](BallId ball) {
    const std::optional<Group> of_ball = rules::group_of(ball);
    return of_ball && (!group || of_ball == group);
  });
}

std::vector<BallId> balls_on(const GameState& state) {
  const std::optional<Group> group = group_of_seat(state, state.to_move);
  if (applies(clauses::eight_when_cleared, is_cleared(state, group))) {
    return on_table(state, the_eight) ? std::vector<BallId>{the_eight} : std::vector<BallId>{};
  }
  std::vector<BallId> balls;
  for (const BallId ball : object_balls_on_table(state)) {
    const bool mine = group ? !applies(clauses::own_group_first, rules::group_of(ball) != group)
                            : !applies(clauses::open_table, ball == the_eight);
    if (mine) {
      balls.push_back(ball);
    }
  }
  return balls;
}

}  // namespace eight_ball

const GameRules& eight_ball_rules() {
  static const GameRules rules{RuleSet::eight_ball,     15,
                               {1, 2, 3, 4, 5},         eight_ball::rack_order,
                               EightBallMemory{},       clauses::eight_ball,
                               eight_ball::check,       eight_ball::balls_to_call,
                               eight_ball::first_balls, eight_ball::legal_calls,
                               eight_ball::judge,       eight_ball::lost_turn,
                               eight_ball::decide};
  return rules;
}

}  // namespace poolhall::rules
