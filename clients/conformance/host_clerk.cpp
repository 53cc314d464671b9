// The host's clerk: what bots ask beside their games, answered as the real server does.
#include <algorithm>

#include "clients/conformance/host.hpp"
#include "clients/cpp/noise_parts.hpp"
#include "clients/cpp/token.hpp"

namespace poolhall::conformance {

using protocol::ErrorCode;
using protocol::Method;

std::optional<Happening> Host::take(const protocol::Incoming& incoming) {
  const protocol::Request& request = incoming.request;
  const Method method = protocol::method_of(request);
  ++asked_[method];
  if (const auto* lag = std::get_if<protocol::Lag>(&request)) {
    take_lag(incoming, *lag);
    return std::nullopt;
  }
  const protocol::RequestId id = incoming.id.value_or(protocol::RequestId{});
  if (const auto* hello = std::get_if<protocol::Hello>(&request)) {
    take_hello(id, *hello);
    return std::nullopt;
  }
  if (stage_ != Stage::in) {
    return take_login(id, request) ? std::optional{Happening{.kind = Happening::Kind::logged_in}}
                                   : std::nullopt;
  }
  if (method == Method::login || method == Method::register_agent) {
    broke(duties::hello_first, Verdict::failure, "a second login on one connection");
    refuse(id, {ErrorCode::already_logged_in, "/method", "this connection is logged in"});
    return std::nullopt;
  }
  if (const auto refusal = refusals_.find(method); refusal != refusals_.end()) {
    refuse(id, refusal->second);
    refusals_.erase(refusal);
    return std::nullopt;
  }
  if (method == Method::shot || method == Method::decide || method == Method::concede) {
    auto answer = take_answer(id, request);
    return answer ? std::optional{Happening{
                        .kind = Happening::Kind::answer, .answer = std::move(answer), .how = {}}}
                  : std::nullopt;
  }
  serve_simple(id, request);
  return std::nullopt;
}

void Host::take_hello(const protocol::RequestId& id, const protocol::Hello& hello) {
  if (stage_ != Stage::silent) {
    broke(duties::hello_first, Verdict::failure, "a second hello on one connection");
    refuse(id, {ErrorCode::already_logged_in, "/method", "this connection has said hello"});
    return;
  }
  if (hello.least_protocol > protocol::protocol_version ||
      hello.most_protocol < protocol::protocol_version) {
    throw Stop{Verdict::failure, "its hello does not offer version 1 of the protocol"};
  }
  stage_ = Stage::greeted;
  detail_ = hello.detail;
  for (const auto& [game, hosted] : games_) {
    hosted->set_detail(detail_);
  }
  protocol::HelloReply greeting;
  greeting.server = {"poolhall-conformance", "1"};
  greeting.session = "s" + std::to_string(++sessions_);
  greeting.limits = limits_;
  greeting.rules_version = greeting.physics_version = "1";
  greeting.time_ms = time_ms();
  reply(id, greeting);
}

// Whether the bot is logged in now.
bool Host::take_login(const protocol::RequestId& id, const protocol::Request& request) {
  const Method method = protocol::method_of(request);
  if (stage_ == Stage::silent) {
    broke(duties::hello_first, Verdict::failure,
          std::string(protocol::name(method)) + " came before hello");
    refuse(id, {ErrorCode::not_logged_in, "/method", "expected hello to come first"});
    return false;
  }
  if (const auto refusal = refusals_.find(method); refusal != refusals_.end()) {
    refuse(id, refusal->second);
    refusals_.erase(refusal);
    login_refused_ = true;
    return false;
  }
  if (const auto* login = std::get_if<protocol::Login>(&request)) {
    const auto known = names_.find(login->token.text);
    if (known == names_.end()) {
      refuse(id, {ErrorCode::unauthorized, "/params/token", "the token belongs to no agent"});
      return false;
    }
    logged_in(id, login->token, known->second, request);
    return true;
  }
  if (const auto* asked = std::get_if<protocol::Register>(&request)) {
    logged_in(id, asked->token.value_or(client::random_token()), asked->name, request);
    return true;
  }
  if (!login_refused_) {  // else it was sent in the hope of a login
    broke(duties::hello_first, Verdict::failure,
          std::string(protocol::name(method)) + " came before login or register");
  }
  refuse(id, {ErrorCode::not_logged_in, "/method", "expected login or register first"});
  return false;
}

void Host::logged_in(const protocol::RequestId& id, const protocol::Hex256& token, std::string name,
                     const protocol::Request& request) {
  conduct_.seen(duties::hello_first);
  stage_ = Stage::in;
  link_->set_line_limit(limits_.line_bytes);
  const bool is_same = identity_ == token.text;
  identity_ = token.text;
  names_[token.text] = name;
  protocol::LoginReply greeting{std::move(name), {}, {}};
  if (std::holds_alternative<protocol::Register>(request)) {
    greeting.token = token;
  }
  for (const auto& [game, hosted] : games_) {
    if (is_same) {
      greeting.games.push_back(hosted->listing());
    }
  }
  reply(id, greeting);
  probe(time_ms());
}

void Host::probe(std::int64_t t) {
  probes_.insert(t);
  push(protocol::LagProbe{t});
}

void Host::take_lag(const protocol::Incoming& incoming, const protocol::Lag& lag) {
  if (probes_.contains(lag.t)) {
    conduct_.seen(duties::lag_echo);
  } else {
    broke(duties::lag_echo, Verdict::failure,
          "t is " + std::to_string(lag.t) + ", which no probe of this session had");
  }
  if (incoming.id) {
    reply(*incoming.id, protocol::EmptyReply{});
  }
}

void Host::serve(const protocol::RequestId& id, const protocol::Challenge& challenge) {
  challenge_ = challenge;
  match_ = protocol::MatchId{next_id_++};
  reply(id, protocol::ChallengeReply{protocol::ChallengeId{protocol::number(match_)},
                                     protocol::ChallengeStatus::accepted, match_});
}

void Host::serve(const protocol::RequestId& id, const protocol::Sync& sync) {
  const HostedGame* game = find(sync.game);
  if (game == nullptr) {
    refuse(id, {ErrorCode::unknown_game, "/params/game", "none of your games", sync.game});
    return;
  }
  protocol::SyncReply<Outgoing> answer{game->snapshot(), {}, {}};
  if (game->is_bots_turn()) {
    note_handed(*game);
    answer.pending = game->turn();
  }
  if (game->state().result) {
    answer.over = game->over();
  }
  reply(id, answer);
}

void Host::serve(const protocol::RequestId& id, const protocol::GameReady& ready) {
  if (std::find(commitments_.begin(), commitments_.end(), ready.commitment) == commitments_.end()) {
    commitments_.push_back(ready.commitment);
  }
  reply(id, protocol::EmptyReply{});
}

void Host::serve(const protocol::RequestId& id, const protocol::GameReveal& reveal) {
  const auto bound = bound_.find(reveal.game);
  if (bound == bound_.end()) {
    const bool is_waiting = std::find(commitments_.begin(), commitments_.end(),
                                      client::sha256_of(reveal.secret)) != commitments_.end();
    broke(duties::reveals_fit, is_waiting ? Verdict::failure : Verdict::warning,
          is_waiting ? "bytes are revealed whose commitment no game.start has shown yet"
                     : "game.reveal for a game whose terms have no commitment of the bot's");
    refuse(id,
           {ErrorCode::invalid_params, "/params/game", "your seat has no commitment", reveal.game});
    return;
  }
  if (client::sha256_of(reveal.secret) != bound->second) {
    broke(duties::reveals_fit, Verdict::failure,
          "the secret's SHA-256 is not the commitment that game.start has shown");
    refuse(id, {ErrorCode::invalid_params, "/params/secret", "does not match the commitment",
                reveal.game});
    return;
  }
  conduct_.seen(duties::reveals_fit);
  reply(id, protocol::GameReply{reveal.game});
}

void Host::serve_simple(const protocol::RequestId& id, const protocol::Request& request) {
  if (const auto* challenge = std::get_if<protocol::Challenge>(&request)) {
    serve(id, *challenge);
  } else if (const auto* sync = std::get_if<protocol::Sync>(&request)) {
    serve(id, *sync);
  } else if (const auto* ready = std::get_if<protocol::GameReady>(&request)) {
    serve(id, *ready);
  } else if (const auto* reveal = std::get_if<protocol::GameReveal>(&request)) {
    serve(id, *reveal);
  } else if (const auto* ping = std::get_if<protocol::Ping>(&request)) {
    reply(id, protocol::PingReply{ping->t, time_ms()});
  } else if (const auto* ack = std::get_if<protocol::Ack>(&request)) {
    reply(id, protocol::AckReply{ack->what});
  } else if (std::holds_alternative<protocol::TournamentList>(request)) {
    reply(id, protocol::TournamentListReply{});
  } else if (const auto* join = std::get_if<protocol::TournamentJoin>(&request)) {
    reply(id, protocol::TournamentReply{join->tournament, protocol::Membership::joined});
  } else if (const auto* leave = std::get_if<protocol::TournamentLeave>(&request)) {
    reply(id, protocol::TournamentReply{leave->tournament, protocol::Membership::left});
  } else if (const auto* accept = std::get_if<protocol::ChallengeAccept>(&request)) {
    reply(id, protocol::ChallengeReply{accept->challenge, protocol::ChallengeStatus::accepted,
                                       protocol::MatchId{next_id_++}});
  } else if (const auto* decline = std::get_if<protocol::ChallengeDecline>(&request)) {
    reply(id,
          protocol::ChallengeReply{decline->challenge, protocol::ChallengeStatus::declined, {}});
  }
}

int Host::times_asked(Method method) const {
  const auto found = asked_.find(method);
  return found == asked_.end() ? 0 : found->second;
}

void Host::refuse_next(Method method, protocol::Error error) {
  refusals_.insert_or_assign(method, std::move(error));
}

}  // namespace poolhall::conformance
