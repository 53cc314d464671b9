#include "server/match/game.hpp"

#include <algorithm>
#include <utility>

#include "physics/version.hpp"
#include "protocol/state_json.hpp"
#include "rules/version.hpp"
#include "server/match/chain.hpp"

namespace poolhall::match {

using protocol::ErrorCode;
using storage::TurnAction;

namespace {

constexpr std::array<Seat, 2> both_seats{Seat::first, Seat::second};

// -0 becomes 0, so that a stored number comes back with the same bits from any database.
double plain(double x) {
  return x + 0.0;
}

protocol::ShotParams plain(const protocol::ShotParams& p) {
  return {plain(p.a), plain(p.b), plain(p.theta), plain(p.phi), plain(p.v)};
}

bool same_content(const protocol::Shot& one, const protocol::Shot& other) {
  return one.params == other.params && one.cue_ball == other.cue_ball && one.call == other.call;
}

GameClock clock_of(const storage::GameRecord& game,
                   const std::optional<storage::TurnRecord>& last_turn) {
  const ClockSettings settings = clock_settings(game.terms);
  if (!last_turn)
    return GameClock(settings);
  return {settings, {.left = last_turn->clock.left, .lag_left = last_turn->clock.lag_left}};
}

}  // namespace

tl::expected<Game, std::string> Game::open(const storage::UnfinishedGame& unfinished) {
  Game game;
  game.record_ = unfinished.game;
  game.last_turn_ = unfinished.last_turn;
  game.shots_ = unfinished.shots;
  const storage::TermsRecord& terms = game.record_.terms;
  game.board_ = preset_board(terms.table, terms.materials);
  if (!game.board_)
    return tl::unexpected("no preset table \"" + terms.table + "\" or materials \"" +
                          terms.materials + "\"");
  game.state_json_ = game.last_turn_ ? game.last_turn_->state_after : game.record_.initial_state;
  auto state = protocol::decode_state(game.state_json_);
  if (!state)
    return tl::unexpected("stored state: " + state.error().field + ": " + state.error().reason);
  game.state_ = std::move(*state);
  game.head_ = game.last_turn_ ? game.last_turn_->checksum : first_link(game.record_);
  game.clock_ = clock_of(game.record_, game.last_turn_);
  game.phase_ = game.record_.over ? Phase::over : Phase::due;
  return game;
}

bool Game::awaits_reveal() const {
  if (last_turn_ || phase_ != Phase::due)
    return false;
  return std::any_of(both_seats.begin(), both_seats.end(), [&](Seat seat) {
    return record_.agent_commitments[index(seat)] && !record_.agent_secrets[index(seat)];
  });
}

protocol::Expected<std::optional<storage::GameRecord>> Game::reveal(Seat by,
                                                                    const storage::Digest& secret) {
  const std::optional<storage::Digest>& commitment = record_.agent_commitments[index(by)];
  if (!commitment)
    return tl::unexpected(error(ErrorCode::invalid_params, "/params/game",
                                "game.start has no commitment of yours: nothing to reveal"));
  if (!is_committed(*commitment, secret))
    return tl::unexpected(error(ErrorCode::invalid_params, "/params/secret",
                                "its SHA-256 is not what you have committed to"));
  std::optional<storage::Digest>& revealed = record_.agent_secrets[index(by)];
  if (revealed)
    return std::nullopt;
  if (last_turn_ || phase_ != Phase::due)
    return tl::unexpected(error(ErrorCode::stale_turn, "/params/game",
                                "the first turn has begun: the noise is made without it"));
  revealed = secret;
  seal_beginning();
  return record_;
}

void Game::not_revealed(Seat by) {
  record_.agent_secrets[index(by)].reset();
  seal_beginning();
}

void Game::seal_beginning() {
  record_.seal = seal(record_);
  head_ = first_link(record_);
}

void Game::begin_turn(Instant now) {
  if (phase_ != Phase::due)
    return;
  clock_.begin_turn(state_.to_move, now);
  phase_ = Phase::thinking;
}

protocol::Error Game::error(ErrorCode code, std::string field, std::string reason) const {
  return {code, std::move(field), std::move(reason), record_.id, false};
}

std::optional<Answer> Game::turned_away(Seat by, std::uint32_t turn) const {
  if (turn < state_.turn || phase_ == Phase::over) {
    if (turn >= 1 && turn <= (last_turn_ ? last_turn_->number : 0))
      return Past{turn};
    const bool over = phase_ == Phase::over;
    return Refuse{
        error(over ? ErrorCode::game_over : ErrorCode::stale_turn, "/params/turn",
              "got " + std::to_string(turn) +
                  (over ? ", but the game is over" : ", expected " + std::to_string(state_.turn)))};
  }
  if (turn > state_.turn) {
    return Refuse{error(
        ErrorCode::stale_turn, "/params/turn",
        "got " + std::to_string(turn) + ", the current turn is " + std::to_string(state_.turn))};
  }
  if (by != state_.to_move) {
    return Refuse{error(ErrorCode::not_your_turn, "/params/turn",
                        "turn " + std::to_string(turn) + " is the opponent's")};
  }
  return std::nullopt;
}

Answer Game::meets(const protocol::Shot& shot) const {
  if (!in_flight_->shot || in_flight_->shot->shot_id != shot.shot_id)
    return Later{};
  if (same_content(*in_flight_->shot, shot))
    return Join{};
  return Refuse{error(ErrorCode::conflicting_shot, "/params/shot_id",
                      "got " + shot.shot_id.json + " again with another content")};
}

Answer Game::meets(const protocol::Decide& decide) const {
  if (in_flight_->decide && in_flight_->decide->choice == decide.choice)
    return Join{};
  return Later{};
}

void Game::pause(Instant now) {
  if (clock_.running())
    clock_.pause(now);
}

void Game::unpause(Instant now) {
  if (phase_ == Phase::thinking && !clock_.running())
    clock_.resume(now);
}

std::optional<Answer> Game::stop_clock(const Arrival& arrival) {
  if (!clock_.running())
    clock_.resume(arrival.at);
  switch (clock_.stop(arrival.at, arrival.lag)) {
    case ClockVerdict::in_time:
      return std::nullopt;
    case ClockVerdict::shot_cap_over:
      return lose_turn(rules::FoulCode::shot_time_exceeded, arrival.date,
                       error(ErrorCode::stale_turn, "/params/turn",
                             "the time for this turn was over before the request came"));
    case ClockVerdict::game_time_over:
      break;
  }
  const rules::GameResult result{other(state_.to_move), rules::EndReason::timeout};
  storage::TurnRecord turn = row(TurnAction::timeout, arrival.date);
  return store(std::move(turn), rules::ended(state_, result),
               error(ErrorCode::stale_turn, "/params/turn",
                     "the game clock was at zero before the request came"));
}

// A row of the current turn with what is known before its outcome. The clock must be stopped.
storage::TurnRecord Game::row(TurnAction action, storage::UnixMicros date) const {
  storage::TurnRecord turn;
  turn.game = record_.id;
  turn.number = state_.turn;
  turn.action = action;
  turn.seat = state_.to_move;
  turn.state_before = state_json_;
  turn.refusals = refusals_;
  turn.clock = clock_part(action);
  turn.stored = date;
  turn.physics_version = physics::version;
  turn.rules_version = rules::version;
  return turn;
}

storage::ClockPart Game::clock_part(TurnAction action) const {
  GameClock after = clock_;
  TurnTime time;
  if (after.in_turn())
    time = is_played(action) ? after.finish_turn() : after.abandon_turn();
  return {.used = time.used,
          .forgiven = time.forgiven,
          .left = after.balance().left,
          .lag_left = after.balance().lag_left};
}

Answer Game::shot(Seat by, const protocol::Shot& shot, const Arrival& arrival) {
  if (auto answer = turned_away(by, shot.turn))
    return *answer;
  if (in_flight_)
    return meets(shot);
  begin_turn(arrival.at);
  if (auto answer = stop_clock(arrival))
    return std::move(*answer);

  storage::TurnRecord turn = row(TurnAction::shot, arrival.date);
  turn.request = shot.shot_id;
  storage::ShotPart& part = turn.shot.emplace();
  part.index = shots_[index(by)] + 1;
  part.intended = plain(shot.params);
  if (shot.cue_ball)
    part.cue_ball = physics::Vec2<double>{plain(shot.cue_ball->x), plain(shot.cue_ball->y)};
  part.call = shot.call;
  phase_ = Phase::playing;
  in_flight_ = InFlight{.turn = turn, .shot = shot};
  return Play{{.board = board_,
               .state = state_,
               .noise = record_.noise,
               .key = mixed_key(record_.key, record_.agent_secrets),
               .index = {record_.id, by, part.index},
               .previous = head_,
               .row = std::move(turn)}};
}

Answer Game::settle(PlayOutcome outcome, Instant now) {
  const storage::UnixMicros date = in_flight_->turn.stored;
  if (auto* played = std::get_if<PlayedTurn>(&outcome)) {
    InFlight what = std::move(*in_flight_);
    what.turn = std::move(played->record);
    what.next = std::move(played->next);
    return being_stored(std::move(what), std::nullopt);
  }
  in_flight_.reset();
  if (auto* refusal = std::get_if<protocol::Error>(&outcome))
    return refuse(std::move(*refusal), now, date);
  const rules::GameResult result{std::nullopt, rules::EndReason::void_game};
  return store(row(TurnAction::void_game, date), rules::ended(state_, result),
               error(ErrorCode::internal, "", "the server failed; the game is void"));
}

Answer Game::decide(Seat by, const protocol::Decide& decide, const Arrival& arrival) {
  if (auto answer = turned_away(by, decide.turn))
    return *answer;
  if (in_flight_)
    return meets(decide);
  begin_turn(arrival.at);
  if (auto answer = stop_clock(arrival))
    return std::move(*answer);
  auto next = rules::decide(state_, decide.choice, board_->table, board_->materials);
  if (!next)
    return refuse(protocol::error_from(next.error(), "/params"), arrival.answered(), arrival.date);
  storage::TurnRecord turn = row(TurnAction::decision, arrival.date);
  turn.decision = decide.choice;
  Answer answer = store(std::move(turn), std::move(*next), std::nullopt);
  in_flight_->decide = decide;
  return answer;
}

Answer Game::refuse(protocol::Error refusal, Instant now, storage::UnixMicros date) {
  refusal.game = record_.id;
  ++refusals_;
  if (refusals_ >= record_.terms.max_refusals) {
    refusal.foul = true;
    return lose_turn(rules::FoulCode::too_many_refusals, date, std::move(refusal));
  }
  clock_.resume(now);
  phase_ = Phase::thinking;
  return Refuse{std::move(refusal)};
}

Answer Game::lose_turn(rules::FoulCode code, storage::UnixMicros date,
                       std::optional<protocol::Error> error) {
  rules::Ruling ruling = rules::judge_lost_turn(state_, code, board_->table, board_->materials);
  storage::TurnRecord turn = row(TurnAction::lost_turn, date);
  turn.ruling = protocol::encode_ruling(ruling);
  return store(std::move(turn), std::move(ruling.next), std::move(error));
}

Answer Game::end(TurnAction action, Seat seat, const rules::GameResult& result,
                 const Arrival& arrival) {
  if (phase_ == Phase::over)
    return Refuse{error(ErrorCode::game_over, "/params/game", "the game is over")};
  if (in_flight_)
    return Later{};
  if (clock_.running()) {
    if (action == TurnAction::void_game)
      static_cast<void>(clock_.stop(arrival.at, arrival.lag));
    else if (auto answer = stop_clock(arrival))
      return std::move(*answer);
  }
  storage::TurnRecord turn = row(action, arrival.date);
  turn.seat = seat;
  return store(std::move(turn), rules::ended(state_, result), std::nullopt);
}

Answer Game::concede(Seat by, const Arrival& arrival) {
  const rules::GameResult result{other(by), rules::EndReason::conceded};
  if (phase_ == Phase::over && state_.result == result)
    return Done{};
  if (in_flight_ && in_flight_->turn.action == TurnAction::concession &&
      in_flight_->turn.seat == by)
    return Join{};
  return end(TurnAction::concession, by, result, arrival);
}

Answer Game::forfeit(Seat loser, const Arrival& now) {
  return end(TurnAction::forfeit, loser, {other(loser), rules::EndReason::forfeit}, now);
}

Answer Game::make_void(const Arrival& now) {
  return end(TurnAction::void_game, state_.to_move, {std::nullopt, rules::EndReason::void_game},
             now);
}

Answer Game::expire(const Arrival& now) {
  const std::optional<Instant> due = clock_.expires(now.lag);
  if (phase_ != Phase::thinking || !due || now.at < *due)
    return Later{};
  std::optional<Answer> answer = stop_clock(now);
  std::get<Store>(*answer).error.reset();
  return std::move(*answer);
}

Answer Game::store(storage::TurnRecord turn, rules::GameState next,
                   std::optional<protocol::Error> error) {
  turn.state_after = protocol::encode_state(next);
  turn.result = next.result;
  turn.checksum = chained(head_, turn);
  return being_stored({.turn = std::move(turn), .next = std::move(next)}, std::move(error));
}

Answer Game::being_stored(InFlight what, std::optional<protocol::Error> error) {
  Store answer{.turn = what.turn, .error = std::move(error)};
  if (what.next->result)
    answer.game = finished(record_, what.turn);
  in_flight_ = std::move(what);
  phase_ = Phase::storing;
  return answer;
}

void Game::stored() {
  InFlight what = std::move(*in_flight_);
  in_flight_.reset();
  if (what.next->result)
    record_ = finished(record_, what.turn);
  if (what.turn.shot)
    shots_[index(what.turn.seat)] = what.turn.shot->index;
  state_ = std::move(*what.next);
  state_json_ = what.turn.state_after;
  head_ = what.turn.checksum;
  last_turn_ = std::move(what.turn);
  clock_ = clock_of(record_, last_turn_);
  refusals_ = 0;
  phase_ = state_.result ? Phase::over : Phase::due;
}

void Game::not_stored(Instant now) {
  in_flight_.reset();
  if (!clock_.in_turn()) {
    phase_ = Phase::due;
    return;
  }
  clock_.resume(now);
  phase_ = Phase::thinking;
}

std::optional<storage::GameRecord> Game::acknowledge(Seat by) {
  bool& acknowledged = record_.acknowledged[index(by)];
  if (!record_.over || acknowledged)
    return std::nullopt;
  acknowledged = true;
  record_.seal = seal(record_);
  return record_;
}

}  // namespace poolhall::match
