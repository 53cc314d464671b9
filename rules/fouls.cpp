#include "rules/fouls.hpp"

#include <algorithm>
#include <utility>

#include "rules/common_clauses.hpp"

namespace poolhall::rules {
namespace {

bool contains(const std::vector<BallId>& balls, BallId ball) {
  return std::find(balls.begin(), balls.end(), ball) != balls.end();
}

// Which of the balls that were struck first counts as the first one, and what it breaks.
struct FirstContact {
  BallEvent contact;
  bool wrong_ball = false;
  bool in_kitchen = false;
};

bool from_kitchen(const GameState& ready) {
  return ready.kind == TurnKind::break_shot ||
         ready.kind == TurnKind::ball_in_hand_behind_head_string;
}

FirstContact judged(const GameState& ready, const ShotFacts& facts, const Duties& duties,
                    const physics::Table& table, const BallEvent& contact) {
  const bool wrong = duties.right_ball_first && !contains(duties.first_balls, contact.ball);
  const bool lies_inside = find_ball(ready, contact.ball)->position.y < table.head_string;
  const bool has_left =
      applies(clauses::kitchen_left_before, facts.cue_ball_farthest_y >= table.head_string);
  return {contact, applies(clauses::wrong_ball_first, wrong),
          from_kitchen(ready) && applies(clauses::kitchen_first_ball, lies_inside) && !has_left};
}

// Of balls struck at once the shooter has the benefit of the one that breaks the least.
FirstContact first_contact(const GameState& ready, const ShotFacts& facts, const Duties& duties,
                           const physics::Table& table) {
  const auto weight = [](const FirstContact& first) {
    return (first.wrong_ball ? 1 : 0) + (first.in_kitchen ? 1 : 0);
  };
  FirstContact best = judged(ready, facts, duties, table, facts.first_contacts.front());
  for (const BallEvent& contact : facts.first_contacts) {
    const FirstContact other = judged(ready, facts, duties, table, contact);
    if (weight(other) < weight(best)) {
      best = other;
    }
  }
  return best;
}

FoulReport with_contact_fouls(FoulReport report, const GameState& ready, const ShotFacts& facts,
                              const Duties& duties, const physics::Table& table) {
  const FirstContact first = first_contact(ready, facts, duties, table);
  const std::size_t event = first.contact.event;
  report.first_contact = first.contact.ball;
  if (facts.first_contacts.size() > 1) {
    report.notes.push_back(finding(clauses::simultaneous_contact, event));
  }
  if (first.wrong_ball) {
    report.fouls.push_back(foul(FoulCode::wrong_ball_first, clauses::wrong_ball_first,
                                ball_words(first.contact.ball) + " was struck first, not " +
                                    (duties.first_balls.size() > 1 ? "one of " : "") +
                                    ball_words(duties.first_balls),
                                event));
  }
  const bool driven = std::any_of(facts.driven_to_rail.begin(), facts.driven_to_rail.end(),
                                  [event](const BallEvent& rail) { return rail.event > event; });
  if (duties.rail_after_contact && applies(clauses::no_rail_after_contact, !driven)) {
    report.fouls.push_back(foul(FoulCode::no_rail_after_contact, clauses::no_rail_after_contact,
                                "after the contact with " + ball_words(first.contact.ball) +
                                    " no ball was pocketed or driven to a rail",
                                event));
  }
  if (first.in_kitchen) {
    report.fouls.push_back(foul(FoulCode::kitchen, clauses::kitchen_first_ball,
                                ball_words(first.contact.ball) +
                                    " lay in the kitchen and was struck before the cue ball had "
                                    "left it",
                                event));
  }
  return report;
}

}  // namespace

std::string ball_words(BallId ball) {
  return ball == physics::cue_ball ? "the cue ball"
                                   : "the " + std::to_string(physics::number(ball));
}

std::string ball_words(const std::vector<BallId>& balls) {
  std::string words;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    words += i == 0 ? "" : i + 1 == balls.size() ? " and " : ", ";
    words += ball_words(balls[i]);
  }
  return words;
}

FoulRecord foul(FoulCode code, const Clause& clause, const std::string& detail,
                std::optional<std::size_t> event) {
  return {code, std::string(clause.rule), detail.empty() ? std::string(clause.text) : detail,
          event};
}

Finding finding(const Clause& clause, std::optional<std::size_t> event) {
  return {std::string(clause.rule), std::string(clause.text), event};
}

Finding said(const Clause& clause, std::string text) {
  return {std::string(clause.rule), std::move(text), std::nullopt};
}

FoulReport standard_fouls(const GameState& ready, const ShotFacts& facts, const Duties& duties,
                          const physics::Table& table) {
  FoulReport report;
  const auto down = std::find_if(facts.pocketed.begin(), facts.pocketed.end(),
                                 [](const auto& p) { return p.ball == physics::cue_ball; });
  if (applies(clauses::scratch, down != facts.pocketed.end())) {
    const bool known = down != facts.pocketed.end();
    report.fouls.push_back(
        foul(FoulCode::scratch, clauses::scratch,
             known ? "the cue ball was pocketed in " + std::string(physics::name(down->pocket))
                   : std::string{},
             known ? std::optional{down->event} : std::nullopt));
  }
  const bool no_contact = facts.first_contacts.empty();
  if (duties.strike_a_ball && applies(clauses::no_ball_hit, no_contact)) {
    report.fouls.push_back(foul(FoulCode::no_ball_hit, clauses::no_ball_hit, ""));
  }
  if (!no_contact) {
    report = with_contact_fouls(std::move(report), ready, facts, duties, table);
  }
  if (applies(clauses::ball_off_table, !facts.driven_off.empty())) {
    std::vector<BallId> off;
    for (const BallEvent& ball : facts.driven_off) {
      off.push_back(ball.ball);
    }
    const auto event = off.empty() ? std::nullopt : std::optional{facts.driven_off.front().event};
    report.fouls.push_back(
        foul(FoulCode::ball_off_table, clauses::ball_off_table,
             off.empty()
                 ? ""
                 : ball_words(off) + (off.size() > 1 ? " were" : " was") + " driven off the table",
             event));
  }
  return report;
}

std::optional<FoulRecord> illegal_break(const ShotFacts& facts, std::string_view rule) {
  const std::size_t driven = facts.object_balls_driven_to_rail();
  const bool legal = applies(clauses::break_pocketed, facts.object_ball_pocketed()) ||
                     applies(clauses::four_to_a_rail, driven >= 4);
  if (!applies(clauses::illegal_break, !legal)) {
    return std::nullopt;
  }
  FoulRecord record =
      foul(FoulCode::illegal_break, clauses::illegal_break,
           "no ball was pocketed and " + std::to_string(driven) + " object ball" +
               (driven == 1 ? " was" : "s were") + " driven to a rail, not at least four");
  record.rule = rule;
  return record;
}

}  // namespace poolhall::rules
