#include "clients/bots/outlook.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace poolhall::bots {
namespace {

using rules::TurnKind;

// Random layouts a number of balls, and places of the cue ball tried on each.
constexpr int layouts = 40;
constexpr int places = 24;
// A player who plays for position has about the best of so many random places.
constexpr int places_in_play = 4;
// A break that keeps the table, about.
constexpr double good_break = 0.6;

// A part of the mouth: its middle moved by `shift` half widths to the side, `share` of its width.
struct MouthPart {
  double shift = 0;
  double share = 1;
};

bool is_blocked(const Position& position, Point from, Point to, BallMask ignored, double radius) {
  const Point along = to - from;
  const double square = dot(along, along);
  for (unsigned left = position.on_table & ~unsigned{ignored}; left != 0; left &= left - 1) {
    const Point off = position.at[static_cast<std::size_t>(std::countr_zero(left))] - from;
    const double t = square > 0 ? std::clamp(dot(off, along) / square, 0.0, 1.0) : 0.0;
    const Point gap = off - t * along;
    if (dot(gap, gap) < 4 * radius * radius) {
      return true;
    }
  }
  return false;
}

template <class Action>
void for_each_ball(BallMask balls, Action action) {
  for (unsigned left = balls; left != 0; left &= left - 1) {
    action(BallId(static_cast<std::uint8_t>(std::countr_zero(left))));
  }
}

}  // namespace

Outlook::Outlook(const Hall& hall, rules::RuleSet rules, double aim_error, Dice dice)
    : hall_(hall),
      felt_{hall.table.width, hall.table.length, hall.radius(), hall.pockets, {}},
      rules_(rules),
      aim_error_(aim_error) {
  measure_chances(dice);
  work_out_prospects();
}

// The whole mouth, or a half of it where something is in the way, or for a ball on the rail, which
// can only run along it, the corner's end at that rail.
std::optional<PotLine> Outlook::open_line(const Position& position, BallId ball,
                                          const PocketTarget& pocket) const {
  constexpr std::array<MouthPart, 5> parts{
      {{0, 1}, {0.5, 0.5}, {-0.5, 0.5}, {0.95, 0.3}, {-0.95, 0.3}}};
  physics::Ball<double> object;
  object.id = ball;
  object.position = position.at[physics::number(ball)];
  const Point to_pocket = pocket.centre - object.position;
  if (dot(to_pocket, pocket.outward) <= 0 || dot(to_pocket, object.position - position.cue()) < 0) {
    return std::nullopt;  // from behind the pocket, or a cut of more than a right angle
  }
  const auto movers = static_cast<BallMask>(only(ball) | 1U);
  for (const MouthPart& part : parts) {
    PocketTarget target = pocket;
    target.half_width *= part.share;
    target.centre = pocket.centre +
                    (part.shift * pocket.half_width) * Point{-pocket.outward.y, pocket.outward.x};
    auto line = line_to(felt_, position.cue(), object, target);
    if (line && !is_blocked(position, object.position, target.centre, movers, felt_.radius) &&
        !is_blocked(position, position.cue(), line->ghost, movers, felt_.radius)) {
      line->chance = chance_of(*line, target, felt_.radius, aim_error_);
      return line;
    }
  }
  return std::nullopt;
}

void Outlook::find_lines(const Position& position, std::vector<PotLine>& lines) const {
  lines.clear();
  for_each_ball(balls_on(position), [&](BallId ball) {
    for (const PocketTarget& pocket : felt_.pockets) {
      if (auto line = open_line(position, ball, pocket)) {
        lines.push_back(*line);
      }
    }
  });
  std::ranges::stable_sort(lines, std::ranges::greater{}, &PotLine::chance);
}

double Outlook::best_chance(const Position& position) const {
  double best = 0;
  for_each_ball(balls_on(position), [&](BallId ball) {
    for (const PocketTarget& pocket : felt_.pockets) {
      if (const auto line = open_line(position, ball, pocket)) {
        best = std::max(best, line->chance);
      }
    }
  });
  return best;
}

// ---- A position's worth ----

// The best pocket counts, and a little of the second best.
double Outlook::ease(const Position& position, BallId ball) const {
  constexpr double usual_run = 0.6;       // m, of the cue ball
  constexpr double usual_cos_cut = 0.82;  // 35 degrees
  constexpr double second_counts = 0.4;
  constexpr double least = 0.3;
  const Point object = position.at[physics::number(ball)];
  const auto movers = static_cast<BallMask>(only(ball) | 1U);
  double best = 0;
  double second = 0;
  for (const PocketTarget& pocket : felt_.pockets) {
    const Point to_pocket = pocket.centre - object;
    const double run = std::sqrt(dot(to_pocket, to_pocket));
    const double entry = dot(to_pocket, pocket.outward);
    if (run <= 0 || entry < 0.3 * run ||
        is_blocked(position, object, pocket.centre, movers, felt_.radius)) {
      continue;
    }
    PotLine line;
    line.course = (1 / run) * to_pocket;
    line.cue_run = usual_run;
    line.object_run = run;
    line.cos_cut = usual_cos_cut;
    const double chance = chance_of(line, pocket, felt_.radius, aim_error_);
    second = std::max(second, std::min(best, chance));
    best = std::max(best, chance);
  }
  return std::max(least, 1 - (1 - best) * (1 - second_counts * second));
}

double Outlook::running_out(const Position& position, BallMask balls, BallMask last,
                            std::size_t theirs) const {
  std::array<double, physics::max_balls> eases{};
  std::size_t count = 0;
  for_each_ball(static_cast<BallMask>(balls & ~unsigned{last}),
                [&](BallId ball) { eases[count++] = ease(position, ball); });
  std::sort(eases.begin(), eases.begin() + static_cast<std::ptrdiff_t>(count));  // hard ones last
  double wins = 1;
  std::size_t left = 1;
  const auto step = [&](double ease_of_ball) {
    const double chance = std::min(
        prospects_.next[left] * ease_of_ball / std::max(prospects_.ease[left], 1e-3), 0.999);
    const std::size_t of_theirs = rules_ == rules::RuleSet::nine_ball ? left : theirs;
    wins = chance * wins + (1 - chance) * (1 - prospects_.arriving[of_theirs][left]);
    ++left;
  };
  for_each_ball(last, [&](BallId ball) { step(ease(position, ball)); });
  for (std::size_t i = 0; i < count; ++i) {
    step(eases[i]);
  }
  return wins;
}

double Outlook::with_chance(const Position& position, BallMask ball, double chance) const {
  if (rules_ == rules::RuleSet::nine_ball) {
    const auto left = static_cast<std::size_t>(std::popcount(position.on_table & ~1U));
    const auto rest = static_cast<BallMask>(position.on_table & ~1U & ~unsigned{ball});
    const double potted = left <= 1      ? 1.0
                          : chance > 0.0 ? running_out(position, rest, the_nine, left - 1)
                                         : 0.0;
    return chance * potted + (1 - chance) * (1 - prospects_.arriving[left][left]);
  }
  const auto group = group_balls(position, position.to_move);
  const BallMask mine = group ? *group : (ball & stripes) != 0 ? stripes : solids;
  const auto theirs = static_cast<BallMask>((solids | stripes) & ~unsigned{mine});
  const auto n = static_cast<std::size_t>(left_of(position, mine));
  const auto m = static_cast<std::size_t>(left_of(position, theirs));
  const auto rest = static_cast<BallMask>(position.on_table & (mine | the_eight) & ~unsigned{ball});
  const double potted = (ball & the_eight) != 0 ? 1.0
                        : chance > 0.0          ? running_out(position, rest, the_eight, m)
                                                : 0.0;
  return chance * potted + (1 - chance) * (1 - prospects_.arriving[m][n]);
}

double Outlook::at_the_table(const Position& position) const {
  // The likeliest pot, of either group where the table is open.
  std::array<double, 2> chances{};
  std::array<BallMask, 2> balls{};
  for_each_ball(balls_on(position), [&](BallId ball) {
    const bool striped = !position.first_group && (only(ball) & stripes) != 0;
    const std::size_t kind = striped ? 1 : 0;
    for (const PocketTarget& pocket : felt_.pockets) {
      const auto line = open_line(position, ball, pocket);
      if (line && line->chance > chances[kind]) {
        chances[kind] = line->chance;
        balls[kind] = only(ball);
      }
    }
  });
  double best = missed(position);
  for (std::size_t kind = 0; kind < 2; ++kind) {
    if (chances[kind] > 0) {
      best = std::max(best, with_chance(position, balls[kind], chances[kind]));
    }
  }
  return best;
}

double Outlook::in_hand(const Position& position) const {
  const BallMask on = balls_on(position);
  const auto left = static_cast<std::size_t>(
      rules_ == rules::RuleSet::nine_ball
          ? std::popcount(position.on_table & ~1U)
          : left_of(position, group_balls(position, position.to_move).value_or(solids)));
  const double anywhere = prospects_.in_hand[left];
  const double chance =
      position.kind == TurnKind::ball_in_hand ? anywhere : (anywhere + prospects_.first[left]) / 2;
  const auto one_of_them = static_cast<BallMask>(on & (~unsigned{on} + 1));
  return with_chance(position, one_of_them, chance);
}

double Outlook::breaking() const {
  const std::size_t all = rules_ == rules::RuleSet::nine_ball ? 9 : 8;
  return good_break * prospects_.in_play[all][all] +
         (1 - good_break) * (1 - prospects_.arriving[all][all]);
}

double Outlook::choosing(const Position& position) const {
  Position next = position;
  next.choice = Choice::none;
  next.kind = position.has(1) ? TurnKind::shot : TurnKind::ball_in_hand_behind_head_string;
  switch (position.choice) {
    case Choice::illegal_break:
      return std::max(mover_wins(next), std::max(breaking(), 1 - breaking()));
    case Choice::break_foul:
      next.kind = TurnKind::ball_in_hand_behind_head_string;
      return mover_wins(next);
    case Choice::eight_on_break:
      next = with_spotted(next, BallId{8}, hall_.table, hall_.radius());
      return std::max(mover_wins(next), breaking());
    case Choice::eight_with_foul:
      next = with_spotted(next, BallId{8}, hall_.table, hall_.radius());
      next.kind = TurnKind::ball_in_hand_behind_head_string;
      return std::max(mover_wins(next), breaking());
    case Choice::push_out:
    case Choice::none:
      break;
  }
  const double shooting = mover_wins(next);
  return std::max(shooting, 1 - shooting);
}

double Outlook::mover_wins(const Position& position) const {
  if (position.is_over) {
    return !position.winner ? 0.5 : *position.winner == position.to_move ? 1.0 : 0.0;
  }
  switch (position.kind) {
    case TurnKind::break_shot:
      return breaking();
    case TurnKind::shot:
      return at_the_table(position);
    case TurnKind::decision:
      return choosing(position);
    default:
      return in_hand(position);
  }
}

double Outlook::wins(const Position& position, rules::Seat seat) const {
  const double mover = mover_wins(position);
  return position.to_move == seat ? mover : 1 - mover;
}

// ---- Chances from random layouts ----

// `balls` to pot for the player to move; in 8-ball about as many of the opponent's beside them.
Position Outlook::random_layout(int balls, Dice& dice) const {
  Position position;
  position.rules = rules_;
  position.kind = TurnKind::ball_in_hand;
  std::vector<BallId> ids;
  if (rules_ == rules::RuleSet::nine_ball) {
    for (int i = 0; i < balls; ++i) {
      ids.push_back(BallId(static_cast<std::uint8_t>(9 - i)));
    }
  } else {
    position.first_group = rules::Group::solids;
    ids.push_back(BallId{8});
    for (int i = 1; i < balls; ++i) {
      ids.push_back(BallId(static_cast<std::uint8_t>(i)));
      ids.push_back(BallId(static_cast<std::uint8_t>(8 + i)));
    }
  }
  const double edge = hall_.radius();
  for (const BallId id : ids) {
    for (int draw = 0; draw < 100 && !position.has(only(id)); ++draw) {
      const Point place{dice.uniform(edge, hall_.table.width - edge),
                        dice.uniform(edge, hall_.table.length - edge)};
      if (with_cue_ball(position, place, hall_)) {
        position.on_table |= only(id);
        position.at[physics::number(id)] = place;
      }
    }
  }
  return position;
}

double Outlook::mean_ease(const Position& layout) const {
  const BallMask mine = rules_ == rules::RuleSet::nine_ball
                            ? static_cast<BallMask>(layout.on_table & ~1U)
                            : static_cast<BallMask>(layout.on_table & (solids | the_eight));
  double sum = 0;
  for_each_ball(mine, [&](BallId ball) { sum += ease(layout, ball); });
  return sum / std::max(std::popcount(mine), 1);
}

void Outlook::measure_chances(Dice& dice) {
  const int most = rules_ == rules::RuleSet::nine_ball ? 9 : 8;
  for (int balls = 1; balls <= most; ++balls) {
    double first = 0;
    double next = 0;
    double in_hand = 0;
    double easy = 0;
    for (int i = 0; i < layouts; ++i) {
      const Position layout = random_layout(balls, dice);
      easy += mean_ease(layout) / layouts;
      double best = 0;
      double best_of_few = 0;
      double groups = 0;
      for (int k = 0; k < places; ++k) {
        const Point place{dice.uniform(0, hall_.table.width), dice.uniform(0, hall_.table.length)};
        const auto placed = with_cue_ball(layout, place, hall_);
        const double chance = placed ? best_chance(*placed) : 0;
        first += chance / (places * layouts);
        best = std::max(best, chance);
        best_of_few = std::max(best_of_few, chance);
        if (k % places_in_play == places_in_play - 1) {
          groups += best_of_few;
          best_of_few = 0;
        }
      }
      next += groups * places_in_play / (places * layouts);
      in_hand += best / layouts;
    }
    const auto n = static_cast<std::size_t>(balls);
    prospects_.first[n] = first;
    prospects_.next[n] = next;
    prospects_.in_hand[n] = in_hand;
    prospects_.ease[n] = easy;
  }
}

void Outlook::work_out_prospects() {
  constexpr int rounds = 60;  // the two players' chances hang on each other
  const bool nine = rules_ == rules::RuleSet::nine_ball;
  const std::size_t most = nine ? 9 : 8;
  auto& [in_play, arriving, next, first, in_hand, ease] = prospects_;
  const auto step = [&](std::size_t n, std::size_t m) {
    const double potted = n == 1 ? 1.0 : nine ? in_play[n - 1][n - 1] : in_play[n - 1][m];
    const double missed = 1 - arriving[m][n];
    in_play[n][m] = next[n] * potted + (1 - next[n]) * missed;
    arriving[n][m] = first[n] * potted + (1 - first[n]) * missed;
  };
  for (std::size_t n = 1; n <= most; ++n) {
    for (std::size_t m = 1; m <= n; ++m) {
      arriving[n][m] = arriving[m][n] = 0.5;
      for (int round = 0; round < rounds && (!nine || n == m); ++round) {
        step(n, m);
        step(m, n);
      }
    }
  }
}

}  // namespace poolhall::bots
