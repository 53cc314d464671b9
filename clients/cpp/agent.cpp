#include "clients/cpp/agent.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "clients/cpp/token.hpp"

namespace poolhall::client {
namespace {

using protocol::ErrorCode;
using protocol::Method;

constexpr std::chrono::milliseconds retry_delay{250};
// A player whose moves are refused so often in one turn will not find one.
constexpr std::uint32_t hopeless_refusals = 10;

std::optional<std::int64_t> own_id(const protocol::RequestId& id) {
  std::int64_t value = 0;
  const char* end = id.json.data() + id.json.size();
  const auto [stop, error] = std::from_chars(id.json.data(), end, value);
  if (error != std::errc{} || stop != end) {
    return std::nullopt;
  }
  return value;
}

std::string text_of(const protocol::ErrorMessage& message) {
  const std::string& reason = message.error.reason;
  std::string text = reason.starts_with(message.code) ? reason : message.code + ": " + reason;
  return message.error.field.empty() ? text : text + " (" + message.error.field + ")";
}

bool is_refusal_of_a_move(ErrorCode code) {
  return code == ErrorCode::bad_shot || code == ErrorCode::bad_call ||
         code == ErrorCode::bad_cue_ball_position || code == ErrorCode::bad_decision ||
         code == ErrorCode::invalid_params;
}

}  // namespace

Agent::Agent(AgentSettings settings, PlayerFactory factory, Outside& outside)
    : settings_(std::move(settings)),
      factory_(std::move(factory)),
      outside_(outside),
      token_(settings_.token.value_or(random_token())),
      may_be_registered_(settings_.token.has_value()) {}

void Agent::log(std::string_view line) const {
  if (settings_.log) {
    settings_.log(line);
  }
}

void Agent::begin_session() {
  in_flight_.clear();
  stage_ = Stage::greeting;
  send(
      protocol::Hello{
          .name = settings_.name, .client = settings_.software, .detail = settings_.detail},
      {});
}

void Agent::session_ended() {
  in_flight_.clear();
  stage_ = Stage::greeting;
}

void Agent::send(const protocol::Request& request, InFlight in_flight) {
  in_flight.method = protocol::method_of(request);
  const std::int64_t id = next_id_++;
  in_flight_[id] = in_flight;
  outside_.send(protocol::encode_request(id, request));
}

void Agent::send_ping() {
  if (is_logged_in()) {
    send(protocol::Ping{}, {});
  }
}

void Agent::act(GameDesk& desk, GameDesk::Step step) {
  switch (step) {
    case GameDesk::Step::nothing:
      return;
    case GameDesk::Step::think:
      outside_.think(desk.info(), desk.player(), *desk.task());
      return;
    case GameDesk::Step::send:
      send_answer(desk);
      return;
  }
}

void Agent::send_answer(const GameDesk& desk) {
  if (is_logged_in() && desk.answer() && desk.task()) {
    send(*desk.answer(), {.game = game_id(desk.info()), .key = desk.task()->key});
  }
}

void Agent::send_answer_again(protocol::GameId game) {
  if (const auto desk = desks_.find(game); desk != desks_.end()) {
    send_answer(desk->second);
  }
}

void Agent::move_chosen(protocol::GameId game, TurnKey key, const Move& move) {
  const auto desk = desks_.find(game);
  if (desk == desks_.end()) {
    return;
  }
  const bool is_hopeless = key.refusals >= hopeless_refusals;
  act(desk->second, desk->second.move_chosen(key, is_hopeless ? Move{Concede{}} : move));
}

std::optional<Agent::InFlight> Agent::take(const protocol::RequestId& id) {
  const auto number = own_id(id);
  const auto found = number ? in_flight_.find(*number) : in_flight_.end();
  if (found == in_flight_.end()) {
    return std::nullopt;
  }
  const InFlight in_flight = found->second;
  in_flight_.erase(found);
  return in_flight;
}

std::optional<End> Agent::line_came(std::string_view line) {
  const auto message = protocol::decode_server_message(line, [&](const protocol::RequestId& id) {
    const auto number = own_id(id);
    const auto found = number ? in_flight_.find(*number) : in_flight_.end();
    return found == in_flight_.end() ? std::nullopt : std::optional<Method>(found->second.method);
  });
  if (!message) {
    log("the server's line was not understood: " + message.error().field + " " +
        message.error().reason);
    return std::nullopt;
  }
  if (const auto* reply = std::get_if<protocol::ReplyMessage>(&*message)) {
    return reply_came(*reply);
  }
  if (const auto* error = std::get_if<protocol::ErrorMessage>(&*message)) {
    return error_came(*error);
  }
  if (const auto* note = std::get_if<protocol::NotificationMessage>(&*message)) {
    return std::visit([this](const auto& value) { return notified(value); }, note->notification);
  }
  return std::nullopt;
}

// ---- Replies ----

std::optional<End> Agent::reply_came(const protocol::ReplyMessage& message) {
  const auto in_flight = take(message.id);
  if (!in_flight) {
    return std::nullopt;
  }
  switch (in_flight->method) {
    case Method::hello:
      if (may_be_registered_) {
        stage_ = Stage::logging_in;
        send(protocol::Login{token_}, {});
      } else {
        stage_ = Stage::registering;
        may_be_registered_ = true;  // the reply may get lost
        send(protocol::Register{settings_.name, token_}, {});
      }
      return std::nullopt;
    case Method::register_agent:
    case Method::login:
      if (const auto* reply = std::get_if<protocol::LoginReply>(&message.reply)) {
        return logged_in(*reply);
      }
      return std::nullopt;
    case Method::shot:
      if (const auto* reply =
              std::get_if<protocol::ShotReply<protocol::Received>>(&message.reply)) {
        seen(reply->shot);
      }
      [[fallthrough]];
    case Method::decide:
    case Method::concede:
      if (const auto desk = desks_.find(*in_flight->game); desk != desks_.end()) {
        desk->second.turn_over(in_flight->key.turn);
      }
      return std::nullopt;
    case Method::ack:
      return acknowledged();
    case Method::sync:
      if (const auto* reply =
              std::get_if<protocol::SyncReply<protocol::Received>>(&message.reply)) {
        return synchronised(*reply);
      }
      return std::nullopt;
    case Method::challenge:
      challenges_made_.insert(in_flight->index);
      return std::nullopt;
    case Method::tournament_join:
      tournaments_joined_.insert(in_flight->index);
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

std::optional<End> Agent::logged_in(const protocol::LoginReply& reply) {
  stage_ = Stage::logged_in;
  if (reply.token) {
    token_ = *reply.token;
  }
  log("logged in as " + reply.agent + ", games under way: " + std::to_string(reply.games.size()));
  add_to_next_noise();  // before anything that a game may come of
  send_wishes();
  return std::nullopt;
}

void Agent::add_to_next_noise() {
  if (settings_.noise == NoisePart::added) {
    send(protocol::GameReady{noise_parts_.commit()}, {});
  }
}

// Before the first turn only: later nothing can be added.
void Agent::reveal(const protocol::GameTerms<protocol::Received>& terms) {
  const auto& commitment = terms.agent_commitments[rules::index(terms.seat)];
  const auto secret = commitment ? noise_parts_.secret_for(*commitment) : std::nullopt;
  if (secret) {
    send(protocol::GameReveal{terms.game, *secret}, {.game = terms.game});
  }
}

void Agent::send_wishes() {
  for (std::size_t i = 0; i < settings_.tournaments.size(); ++i) {
    if (!tournaments_joined_.contains(i)) {
      send(protocol::TournamentJoin{settings_.tournaments[i]}, {.index = i});
    }
  }
  for (std::size_t i = 0; i < settings_.challenges.size(); ++i) {
    if (!challenges_made_.contains(i)) {
      auto challenge = settings_.challenges[i];
      if (!challenge.challenge_id) {
        // One id for all repetitions: a lost reply must not become a second game.
        challenge.challenge_id = protocol::ShotId{"\"" + random_token().text + "\""};
        settings_.challenges[i] = challenge;
      }
      send(challenge, {.index = i});
    }
  }
}

std::optional<End> Agent::acknowledged() {
  if (settings_.games && finished_.size() >= *settings_.games) {
    return End{Ending::finished, "all games are played"};
  }
  return std::nullopt;
}

std::optional<End> Agent::synchronised(const protocol::SyncReply<protocol::Received>& reply) {
  open_desk(reply.snapshot.terms);
  if (reply.over) {
    return notified(*reply.over);
  }
  return reply.pending ? notified(*reply.pending) : std::nullopt;
}

// ---- Errors ----

std::optional<End> Agent::error_came(const protocol::ErrorMessage& message) {
  if (message.error.code == ErrorCode::superseded) {
    return End{Ending::superseded, text_of(message)};
  }
  const auto in_flight = take(message.id);
  if (!in_flight) {
    log("the server says " + text_of(message));
    return std::nullopt;
  }
  switch (in_flight->method) {
    case Method::hello:
    case Method::register_agent:
    case Method::login:
      return login_failed(message, stage_);
    case Method::shot:
    case Method::decide:
    case Method::concede:
      answer_failed(message, *in_flight);
      return std::nullopt;
    case Method::challenge:
    case Method::tournament_join:
      if (message.retryable) {
        log("will ask again after the next login: " + text_of(message));
        return std::nullopt;
      }
      return End{Ending::refused, text_of(message)};
    case Method::ack:
      return acknowledged();
    default:
      log("the server refused: " + text_of(message));
      return std::nullopt;
  }
}

std::optional<End> Agent::login_failed(const protocol::ErrorMessage& message, Stage stage) {
  if (stage == Stage::logging_in && message.error.code == ErrorCode::unauthorized &&
      !settings_.name.empty()) {
    stage_ = Stage::registering;
    send(protocol::Register{settings_.name, token_}, {});
    return std::nullopt;
  }
  if (message.retryable) {
    log("not logged in: " + text_of(message));
    stage_ = Stage::put_off;
    return std::nullopt;
  }
  return End{Ending::refused, text_of(message)};
}

void Agent::answer_failed(const protocol::ErrorMessage& message, const InFlight& in_flight) {
  log("game " + std::to_string(protocol::number(*in_flight.game)) + ": " + text_of(message));
  const auto found = desks_.find(*in_flight.game);
  if (found == desks_.end()) {
    return;
  }
  GameDesk& desk = found->second;
  const ErrorCode code = message.error.code;
  if (is_refusal_of_a_move(code) && !message.error.foul) {
    act(desk, desk.refused(in_flight.key));
  } else if (message.retryable) {
    outside_.wake(*in_flight.game, retry_delay);
  } else {
    desk.turn_over(in_flight.key.turn);
    if (code == ErrorCode::conflicting_shot) {
      // Somebody else played this turn with our token; what is pending now comes with the login.
      send(protocol::Sync{*in_flight.game}, {});
    }
  }
}

// ---- Notifications ----

void Agent::open_desk(const protocol::GameTerms<protocol::Received>& terms) {
  if (desks_.contains(terms.game) || finished_.contains(terms.game)) {
    return;
  }
  GameInfo info = game_info(terms);
  log("game " + info.game + " against " + info.opponent);
  auto player = factory_(info);
  desks_.emplace(terms.game, GameDesk(std::move(info), std::move(player)));
}

std::optional<End> Agent::notified(const protocol::GameStart<protocol::Received>& start) {
  open_desk(start.terms);
  reveal(start.terms);
  add_to_next_noise();
  return std::nullopt;
}

std::optional<End> Agent::notified(const protocol::GameSnapshot<protocol::Received>& snapshot) {
  open_desk(snapshot.terms);
  if (snapshot.state.turn == 1) {
    reveal(snapshot.terms);
  }
  return std::nullopt;
}

std::optional<End> Agent::notified(const protocol::GameTurn<protocol::Received>& turn) {
  const auto desk = desks_.find(turn.game);
  if (desk == desks_.end()) {
    send(protocol::Sync{turn.game}, {.game = turn.game});
    return std::nullopt;
  }
  const Clock clock{std::chrono::milliseconds(turn.clock.own_ms),
                    std::chrono::milliseconds(turn.clock.opponent_ms)};
  act(desk->second, desk->second.turn_came({{turn.turn, turn.refusals}, turn.state, clock}));
  return std::nullopt;
}

void Agent::seen(const protocol::GameShot<protocol::Received>& shot) {
  if (const auto desk = desks_.find(shot.game); desk != desks_.end()) {
    desk->second.shot_seen({shot.intended, shot.executed, shot.moved});
  }
}

std::optional<End> Agent::notified(const protocol::GameShot<protocol::Received>& shot) {
  seen(shot);
  return std::nullopt;
}

std::optional<End> Agent::notified(const protocol::GameTurnLost<protocol::Received>& lost) {
  if (const auto desk = desks_.find(lost.game); desk != desks_.end()) {
    desk->second.turn_over(lost.turn);
  }
  return std::nullopt;
}

std::optional<End> Agent::notified(const protocol::GameOver& over) {
  if (const auto desk = desks_.find(over.game); desk != desks_.end()) {
    log("game " + desk->second.info().game + " is over: " + std::string(name(over.reason)));
    if (settings_.on_game_over) {
      settings_.on_game_over(desk->second.info(), over);
    }
    desks_.erase(desk);
  }
  finished_.insert(over.game);
  send(protocol::Ack{over.game}, {.game = over.game});
  return std::nullopt;
}

std::optional<End> Agent::notified(const protocol::MatchOver& over) {
  send(protocol::Ack{over.match}, {});
  return std::nullopt;
}

std::optional<End> Agent::notified(const protocol::TournamentOver& over) {
  send(protocol::Ack{over.tournament}, {});
  return std::nullopt;
}

std::optional<End> Agent::notified(const protocol::ChallengeOffer& offer) {
  if (settings_.offers == OfferPolicy::accept) {
    send(protocol::ChallengeAccept{offer.challenge}, {});
  } else {
    send(protocol::ChallengeDecline{offer.challenge}, {});
  }
  return std::nullopt;
}

std::optional<End> Agent::notified(const protocol::ChallengeOver& over) {
  log("challenge " + std::to_string(protocol::number(over.challenge)) + ": " +
      std::string(name(over.outcome)));
  return std::nullopt;
}

std::optional<End> Agent::notified(const protocol::LagProbe& probe) {
  outside_.send(protocol::encode_lag({probe.t}));
  return std::nullopt;
}

std::optional<End> Agent::notified(const protocol::Superseded&) {
  return End{Ending::superseded, "another login with the same token took over"};
}

}  // namespace poolhall::client
