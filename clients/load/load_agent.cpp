#include "clients/load/load_agent.hpp"

#include <utility>

#include "protocol/codec.hpp"

namespace poolhall::load {
namespace {

constexpr std::int64_t hello_id = 1;
constexpr std::int64_t register_id = 2;

}  // namespace

LoadAgent::LoadAgent(boost::asio::io_context& io, Traffic& traffic, LoadAgentSettings settings,
                     Overseer& overseer)
    : settings_(std::move(settings)),
      overseer_(overseer),
      link_(std::make_shared<Link>(io, traffic)) {}

void LoadAgent::connect(const boost::asio::ip::tcp::endpoint& server) {
  link_->open(server,
              {.on_open = [this] { log_in(); },
               .on_line = [this](std::string_view line) { line_came(line); },
               .on_end = [this](const std::string& why) { overseer_.trouble(*this, why); }});
}

void LoadAgent::log_in() {
  protocol::Hello hello;
  hello.name = settings_.name;
  hello.detail = settings_.detail;
  static_cast<void>(send(hello));
  static_cast<void>(send(protocol::Register{settings_.name, std::nullopt}));
}

void LoadAgent::close() {
  link_->close();
}

std::int64_t LoadAgent::send(const protocol::Request& request) {
  link_->send(protocol::encode_request(next_id_, request));
  return next_id_++;
}

void LoadAgent::challenge(const std::string& opponent) {
  protocol::Challenge challenge;
  challenge.opponent = opponent;
  challenge.noise = settings_.noise;
  static_cast<void>(send(challenge));
}

void LoadAgent::answer(SteadyTime due) {
  asked_ = std::exchange(turn_, std::nullopt);
  const protocol::Request request = quick_answer(*asked_, felt_, settings_.seed);
  last_was_shot_ = std::holds_alternative<protocol::Shot>(request);
  sent_ = due;
  answer_id_ = send(request);
}

void LoadAgent::line_came(std::string_view line) {
  const SeenLine seen = look_at(line);
  switch (seen.kind) {
    case LineKind::reply:
      return reply_came(seen.id, line);
    case LineKind::error:
      return error_came(seen.id, line);
    case LineKind::turn:
      turn_ = turn_in(line);
      return overseer_.turn_came(*this);
    case LineKind::offer:
      static_cast<void>(send(protocol::ChallengeAccept{
          protocol::ChallengeId{integer_in(line, "challenge").value_or(0)}}));
      return;
    case LineKind::start:
    case LineKind::state:
      felt_ = felt_in(line);
      return overseer_.game_began(*this);
    case LineKind::game_over:
      static_cast<void>(
          send(protocol::Ack{protocol::GameId{integer_in(line, "game").value_or(0)}}));
      return overseer_.game_over(*this);
    case LineKind::lag:
      link_->send(protocol::encode_lag({integer_in(line, "t").value_or(0)}));
      return;
    case LineKind::superseded:
      return overseer_.trouble(*this, "superseded");
    case LineKind::match_over:
    case LineKind::other:
      return;
  }
}

void LoadAgent::reply_came(std::int64_t id, std::string_view line) {
  if (id == answer_id_) {
    overseer_.answered(*this, "");
    sent_.reset();
  } else if (id == hello_id) {
    connections_allowed_ = integer_in(line, "connections_per_address").value_or(0);
  } else if (id == register_id) {
    overseer_.agent_in(*this);
  }
}

// A refused answer is given again, differently, unless the turn is lost.
void LoadAgent::error_came(std::int64_t id, std::string_view line) {
  const std::string_view code = error_code_in(line);
  if (id == 0 || id != answer_id_) {
    overseer_.trouble(*this, std::string(code));
    return;
  }
  overseer_.answered(*this, code);
  sent_.reset();
  const bool lost = line.find(R"("foul":true)") != std::string_view::npos;
  if (code.starts_with("bad_") && !lost && asked_ && !turn_) {
    turn_ = asked_;
    ++turn_->refusals;
    overseer_.turn_came(*this);
  }
}

}  // namespace poolhall::load
