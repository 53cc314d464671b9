// The host's games: terms, turns and answers, and what is demanded of an answer.
#include <algorithm>

#include "clients/conformance/host.hpp"

namespace poolhall::conformance {

using protocol::ErrorCode;
using rules::Call;
using rules::TurnKind;

namespace {

// Beside the clock: the way of an answer, on a busy machine.
constexpr milliseconds way{250};
// The referee of the real server; the last of so many refusals is a foul.
constexpr std::uint32_t max_refusals = 3;
constexpr int most_opponents_turns = 12;

std::string turn_text(const HostedGame& game) {
  return "answering turn " + std::to_string(game.state().turn) + " (" +
         std::string(rules::name(game.state().kind)) + ")";
}

template <class T>
bool contains(const std::vector<T>& items, const T& item) {
  return std::find(items.begin(), items.end(), item) != items.end();
}

}  // namespace

HostedGame* Host::find(protocol::GameId game) {
  const auto found = games_.find(game);
  return found == games_.end() ? nullptr : found->second.get();
}

HostedGame& Host::begin(GamePlan plan) {
  std::optional<rules::RuleSet> wanted = options_.rules;
  if (!wanted && !options_.all_rules && challenge_) {
    wanted = challenge_->rules.value_or(rules::RuleSet::eight_ball);
  }
  if (wanted && *wanted != plan.rules) {
    throw Stop{Verdict::not_reached,
               "it plays " + std::string(rules::name(*wanted)) + " (--rules gives it others too)"};
  }
  plan.id = protocol::GameId{next_id_++};
  plan.match = challenge_ ? match_ : protocol::MatchId{next_id_++};
  plan.seed = options_.seed;
  plan.left = std::min(plan.left, options_.clock);
  if (challenge_) {
    plan.opponent = challenge_->opponent;
    plan.clock = challenge_->clock.value_or(plan.clock);
    plan.left = std::min(plan.left, milliseconds(plan.clock.game_ms));
    plan.noise = protocol::noise_preset(challenge_->noise.value_or("olympiad"));
  }
  if (plan.own_commitment) {
    bound_[plan.id] = *plan.own_commitment;
  } else if (!commitments_.empty()) {
    plan.own_commitment = commitments_.front();
    bound_[plan.id] = commitments_.front();
    commitments_.pop_front();
  }
  const protocol::GameId id = plan.id;
  auto& game = games_[id];
  game = std::make_unique<HostedGame>(std::move(plan), detail_);
  push(game->start());
  return *game;
}

void Host::tell_again(HostedGame& game) {
  push(game.snapshot());
  if (game.is_bots_turn()) {
    hand_turn(game);
  }
}

void Host::hand_turn(HostedGame& game) {
  note_handed(game);
  push(game.turn());
}

// ---- Answers ----

std::optional<Answer> Host::take_answer(const protocol::RequestId& id,
                                        const protocol::Request& request) {
  protocol::GameId game_id{};
  std::optional<std::uint32_t> turn;
  if (const auto* shot = std::get_if<protocol::Shot>(&request)) {
    game_id = shot->game;
    turn = shot->turn;
    const ShotKey key{shot->game, shot->turn, shot->shot_id.json};
    const auto [known, is_new] = keys_.emplace(key, *shot);
    conduct_.seen(duties::one_content_per_key);
    if (!is_new && known->second != *shot) {
      broke(duties::one_content_per_key, Verdict::failure,
            "shot_id " + shot->shot_id.json + " of turn " + std::to_string(shot->turn) +
                " came with two contents");
    }
  } else if (const auto* decide = std::get_if<protocol::Decide>(&request)) {
    game_id = decide->game;
    turn = decide->turn;
  } else {
    game_id = std::get<protocol::Concede>(request).game;
  }
  HostedGame* game = find(game_id);
  const auto stray = [&](ErrorCode code, const std::string& what) {
    broke(duties::answers_fit_turns, Verdict::failure, what);
    refuse(id, {code, "/params", what, game_id});
    return std::nullopt;
  };
  if (game == nullptr) {
    return stray(ErrorCode::unknown_game,
                 "the bot has no game " + std::to_string(protocol::number(game_id)));
  }
  if (game->state().result) {
    refuse(id, {ErrorCode::game_over, "/params/game", "the game is over", game_id});
    return std::nullopt;
  }
  Answer answer{game, id, request};
  if (turn && *turn < game->state().turn) {
    past_answer(answer);
    return std::nullopt;
  }
  if (turn && *turn > game->state().turn) {
    return stray(ErrorCode::stale_turn, "turn " + std::to_string(*turn) + " has not come yet");
  }
  if (turn && !game->is_bots_turn()) {
    return stray(ErrorCode::not_your_turn, "it is the other player's turn");
  }
  if (turn && !handed_.contains({game_id, *turn})) {
    return stray(ErrorCode::stale_turn,
                 "turn " + std::to_string(*turn) + " was not handed out yet");
  }
  watch_answer(*game, request);
  return answer;
}

void Host::past_answer(const Answer& answer) {
  ++past_answers_;
  const auto* shot = std::get_if<protocol::Shot>(&answer.request);
  const auto again = shot != nullptr
                         ? answer.game->again(*shot)
                         : answer.game->again(std::get<protocol::Decide>(answer.request));
  if (again) {
    reply(answer.id, *again);
  } else {
    refuse(answer.id, again.error());
  }
}

void Host::watch_answer(const HostedGame& game, const protocol::Request& request) {
  if (std::holds_alternative<protocol::Concede>(request)) {
    return;
  }
  const bool is_decision = game.state().kind == TurnKind::decision;
  const auto* decide = std::get_if<protocol::Decide>(&request);
  if (is_decision != (decide != nullptr)) {
    broke(duties::answers_fit_turns, Verdict::failure,
          is_decision ? "a shot where a decision was due" : "decide where a shot was due");
    return;
  }
  conduct_.seen(duties::answers_fit_turns);
  if (decide == nullptr) {
    watch_shot(game, std::get<protocol::Shot>(request));
    return;
  }
  if (contains(game.state().options, decide->choice)) {
    conduct_.seen(duties::decisions_offered);
  } else {
    broke(duties::decisions_offered, Verdict::failure,
          std::string(rules::name(decide->choice)) + " was not offered");
  }
}

void Host::watch_shot(const HostedGame& game, const protocol::Shot& shot) {
  const TurnKind kind = game.state().kind;
  const std::string_view kind_name = rules::name(kind);
  const bool in_hand = kind != TurnKind::shot;
  conduct_.seen(duties::cue_ball_as_told);
  if (in_hand != shot.cue_ball.has_value()) {
    broke(duties::cue_ball_as_told, Verdict::failure,
          in_hand ? "cue_ball is missing in a turn of kind " + std::string(kind_name)
                  : "cue_ball is given, but the cue ball lies where it lies");
  } else if (in_hand && kind != TurnKind::ball_in_hand &&
             !(shot.cue_ball->y < game.table().head_string)) {
    broke(duties::cue_ball_as_told, Verdict::failure,
          "cue_ball.y is " + std::to_string(shot.cue_ball->y) +
              ", not behind the head string, in a turn of kind " + std::string(kind_name));
  }
  conduct_.seen(duties::calls_offered);
  if (!contains(rules::legal_calls(game.state()), shot.call.kind)) {
    broke(duties::calls_offered, Verdict::failure,
          "a call of a kind that legal.calls has not, in a turn of kind " + std::string(kind_name));
  } else if (shot.call.kind == Call::Kind::pocket &&
             !contains(rules::callable_balls(game.state()), shot.call.ball)) {
    broke(duties::calls_offered, Verdict::failure,
          "ball " + std::to_string(physics::number(shot.call.ball)) +
              " is called, which legal.balls has not");
  }
  conduct_.seen(duties::playable_strokes);
}

// What was read while the script did something else; nothing if there is nothing for `game`, or
// for any where it is null.
std::optional<Answer> Host::kept_answer(const HostedGame* game) {
  for (std::size_t i = 0; i < kept_.size();) {
    if (game != nullptr && kept_[i].game != game) {
      ++i;
      continue;
    }
    Answer kept = std::move(kept_[i]);
    kept_.erase(kept_.begin() + static_cast<std::ptrdiff_t>(i));
    const auto* shot = std::get_if<protocol::Shot>(&kept.request);
    const auto* decide = std::get_if<protocol::Decide>(&kept.request);
    const std::uint32_t due = kept.game->state().turn;
    if ((shot == nullptr || shot->turn == due) && (decide == nullptr || decide->turn == due)) {
      return kept;
    }
    past_answer(kept);
  }
  return std::nullopt;
}

Answer Host::await_answer(HostedGame* game, milliseconds time, const std::string& wanted) {
  const Instant deadline = Clock::now() + time + way;
  while (true) {
    if (auto kept = kept_answer(game)) {
      return *std::move(kept);
    }
    Happening happening = next(deadline);
    if (happening.kind == Happening::Kind::answer) {
      kept_.push_back(*std::move(happening.answer));
    } else if (happening.kind != Happening::Kind::logged_in) {
      give_up(happening, wanted);
    }
  }
}

Answer Host::any_answer() {
  return await_answer(nullptr, options_.clock, "answering its turns");
}

Answer Host::answer_of(HostedGame& game) {
  return await_answer(
      &game, game.plan().left,
      turn_text(game) + " within " + std::to_string(game.plan().left.count()) + " ms");
}

// A shot that was not taken binds no key.
void Host::forget_key(const Answer& answer) {
  if (const auto* shot = std::get_if<protocol::Shot>(&answer.request)) {
    keys_.erase(ShotKey{shot->game, shot->turn, shot->shot_id.json});
  }
}

void Host::put_off(const Answer& answer, const protocol::Error& error) {
  forget_key(answer);
  refuse(answer.id, error);
}

void Host::refuse_answer(const Answer& answer, protocol::Error error) {
  HostedGame& game = *answer.game;
  game.refused();
  forget_key(answer);
  error.foul = game.refusals() >= max_refusals;
  refuse(answer.id, error);
  if (error.foul) {
    push(game.lose_turn(rules::FoulCode::too_many_refusals));
  }
}

std::optional<Host::Accepted> Host::acceptable(Answer answer) {
  HostedGame& game = *answer.game;
  if (std::holds_alternative<protocol::Concede>(answer.request)) {
    reply(answer.id, protocol::GameReply{game.id()});
    game.end({rules::other(game.plan().seat), rules::EndReason::conceded});
    push(game.over());
    throw Stop{Verdict::not_reached, "it conceded"};
  }
  const auto* shot = std::get_if<protocol::Shot>(&answer.request);
  auto played =
      shot != nullptr ? game.judge(*shot) : game.judge(std::get<protocol::Decide>(answer.request));
  if (played) {
    return Accepted{std::move(answer), *std::move(played)};
  }
  if (played.error().code == ErrorCode::bad_shot ||
      played.error().code == ErrorCode::bad_cue_ball_position) {
    broke(duties::playable_strokes, Verdict::warning, played.error().reason);
  }
  refuse_answer(answer, played.error());
  return std::nullopt;
}

std::optional<Host::Accepted> Host::acceptable(HostedGame& game) {
  const std::uint32_t turn = game.state().turn;
  while (game.state().turn == turn) {
    if (auto accepted = acceptable(answer_of(game))) {
      return accepted;
    }
  }
  return std::nullopt;
}

void Host::store(const Accepted& accepted) {
  accepted.answer.game->store(accepted.played);
}

void Host::reply_to(const Accepted& accepted) {
  if (const auto* shot = std::get_if<protocol::GameShot<Outgoing>>(&accepted.played.told)) {
    reply(accepted.answer.id, protocol::ShotReply<Outgoing>{*shot, {}});
  } else {
    reply(accepted.answer.id,
          protocol::DecideReply<Outgoing>{
              std::get<protocol::GameDecision<Outgoing>>(accepted.played.told), {}});
  }
}

void Host::finish(const std::optional<Accepted>& accepted) {
  if (accepted) {
    store(*accepted);
    reply_to(*accepted);
  }
}

void Host::play_turn(HostedGame& game) {
  hand_turn(game);
  finish(acceptable(game));
}

void Host::play_opponent(HostedGame& game) {
  for (int turn = 0; !game.is_bots_turn(); ++turn) {
    if (game.state().result || turn == most_opponents_turns) {
      throw Stop{Verdict::not_reached, "the game did not come back to it"};
    }
    const Played played = game.opponent_plays();
    std::visit([this](const auto& told) { push(told); }, played.told);
  }
}

}  // namespace poolhall::conformance
