#include "tests/fault/harness/survivor.hpp"

#include <utility>

#include "clients/load/seen_line.hpp"

namespace poolhall::fault {

using load::LineKind;
using std::chrono::steady_clock;

namespace {

constexpr std::chrono::milliseconds shortest_absence{50};
constexpr std::chrono::milliseconds longest_absence{400};
constexpr std::chrono::milliseconds before_next_try{20};

std::string token_of(const std::string& name, std::uint64_t seed) {
  std::seed_seq mixed(name.begin(), name.end());
  std::mt19937_64 random(mixed);
  random.discard(seed % 1000);
  std::string token;
  while (token.size() < 64) {
    token += "0123456789abcdef"[random() % 16];
  }
  return token;
}

std::uint64_t occurrences(std::string_view text, std::string_view of) {
  std::uint64_t count = 0;
  for (std::size_t at = text.find(of); at != std::string_view::npos; at = text.find(of, at + 1)) {
    ++count;
  }
  return count;
}

}  // namespace

Survivor::Survivor(boost::asio::io_context& io, load::Traffic& traffic, SurvivorSettings settings,
                   Ledger& ledger, SurvivorCounts& counts)
    : io_(io),
      traffic_(traffic),
      settings_(std::move(settings)),
      ledger_(ledger),
      counts_(counts),
      token_(token_of(settings_.name, settings_.seed)),
      random_(settings_.seed) {}

bool Survivor::happens(double chance) {
  return !hurrying_ && std::uniform_real_distribution<>(0, 1)(random_) < chance;
}

void Survivor::after(std::chrono::milliseconds wait, std::function<void()> what) {
  auto timer = std::make_shared<boost::asio::steady_timer>(io_, wait);
  timer->async_wait([timer, what = std::move(what)](const boost::system::error_code& error) {
    if (!error) {
      what();
    }
  });
}

void Survivor::server_is_at(const boost::asio::ip::tcp::endpoint& server, SteadyTime started) {
  server_ = server;
  server_started_ = started;
  connect();
}

void Survivor::server_is_gone() {
  server_.reset();
  go_away();
}

void Survivor::hurry() {
  hurrying_ = true;
  for (auto& [game, desk] : desks_) {
    if (stage_ == Stage::in && desk.turn && !desk.sent) {
      answer(game, desk);
    }
  }
}

void Survivor::connect() {
  if (stage_ != Stage::away || !server_) {
    return;
  }
  stage_ = Stage::connecting;
  ++session_;
  link_ = std::make_shared<load::Link>(io_, traffic_);
  recorder_ = {};
  link_->open(
      *server_,
      {.on_open =
           [this] {
             protocol::Hello hello;
             hello.name = settings_.name;
             static_cast<void>(send(hello));
             if (known_) {
               stage_ = Stage::logging_in;
               login_id_ = send(protocol::Login{{token_}});
             } else {
               stage_ = Stage::registering;
               login_id_ = send(protocol::Register{settings_.name, protocol::Hex256{token_}});
             }
           },
       .on_line = [this](std::string_view line) { line_came(line); },
       .on_end =
           [this, session = session_](const std::string&) {
             if (session == session_) {
               go_away();
               after(before_next_try, [this] { connect(); });
             }
           }});
}

void Survivor::go_away() {
  stage_ = Stage::away;
  ++session_;
  if (link_) {
    link_->close();
  }
  for (auto& [game, desk] : desks_) {
    desk.turn.reset();  // comes again after the login
  }
  acks_.clear();
}

void Survivor::send_line(std::string line) {
  recorder_.sent(line);
  link_->send(std::move(line));
}

std::int64_t Survivor::send(const protocol::Request& request) {
  send_line(protocol::encode_request(next_id_, request));
  return next_id_++;
}

void Survivor::challenge(const std::string& opponent) {
  protocol::Challenge challenge;
  challenge.opponent = opponent;
  challenge.challenge_id = protocol::ShotId{'"' + std::to_string(++challenges_) + '"'};
  static_cast<void>(send(challenge));
}

void Survivor::logged_in(std::string_view line) {
  stage_ = Stage::in;
  known_ = true;
  ++counts_.logins;
  counts_.ends_learned_late += occurrences(line, R"("status":"over")");
  for (auto& [game, desk] : desks_) {
    if (desk.sent) {
      desk.sent->id = send(desk.sent->request);
      desk.sent->repeated = true;
      ++counts_.repeated;
    }
  }
}

void Survivor::line_came(std::string_view line) {
  recorder_.received(line);
  recorder_.received("\n");
  const load::SeenLine seen = load::look_at(line);
  switch (seen.kind) {
    case LineKind::reply:
      return reply_came(seen.id, line);
    case LineKind::error:
      return error_came(seen.id, line);
    case LineKind::turn:
      return turn_came(line);
    case LineKind::offer:
      static_cast<void>(send(protocol::ChallengeAccept{
          protocol::ChallengeId{load::integer_in(line, "challenge").value_or(0)}}));
      return;
    case LineKind::start:
      return open_desk(line);
    case LineKind::state:
      open_desk(line);
      ledger_.told_state(
          line, desk_of(line)->seat,
          std::chrono::duration_cast<storage::Micros>(steady_clock::now() - server_started_));
      return;
    case LineKind::game_over:
      return over(line);
    case LineKind::lag:
      send_line(protocol::encode_lag({load::integer_in(line, "t").value_or(0)}));
      return;
    case LineKind::superseded:
      counts_.complaints.push_back(name() + " was superseded by nobody");
      return;
    case LineKind::match_over:
      return;
    case LineKind::other:
      if (Desk* desk = desk_of(line); desk != nullptr && line.find(R"("by":)") < 200) {
        ledger_.told_move(line, desk->seat);
      }
  }
}

Survivor::Desk* Survivor::desk_of(std::string_view line) {
  const auto found = desks_.find(load::integer_in(line, "game").value_or(0));
  return found == desks_.end() ? nullptr : &found->second;
}

Survivor::Desk* Survivor::desk_asking(std::int64_t id) {
  for (auto& [game, desk] : desks_) {
    if (desk.sent && desk.sent->id == id) {
      return &desk;
    }
  }
  return nullptr;
}

void Survivor::open_desk(std::string_view line) {
  felt_ = load::felt_in(line);
  Desk& desk = desks_[load::integer_in(line, "game").value_or(0)];
  desk.seat = load::integer_in(line, "seat") == 0 ? rules::Seat::first : rules::Seat::second;
}

void Survivor::turn_came(std::string_view line) {
  const auto turn = load::turn_in(line);
  Desk* desk = desk_of(line);
  if (!turn || desk == nullptr) {
    counts_.complaints.push_back("a turn of no known game: " + std::string(line.substr(0, 120)));
    return;
  }
  if (desk->sent && desk->sent->turn.turn == turn->turn) {
    return;  // its answer is under way again
  }
  desk->turn = turn;
  think(turn->game);
}

void Survivor::think(std::int64_t game) {
  const auto most = hurrying_ ? 0 : settings_.longest_thought.count();
  const std::chrono::milliseconds thought{
      std::uniform_int_distribution<std::int64_t>(0, most)(random_)};
  after(thought, [this, game, session = session_] {
    const auto found = desks_.find(game);
    if (session == session_ && stage_ == Stage::in && found != desks_.end() && found->second.turn &&
        !found->second.sent) {
      answer(game, found->second);
    }
  });
}

// A later turn may have come before the answer to an earlier one that was repeated.
void Survivor::think_again(std::int64_t game) {
  const auto found = desks_.find(game);
  if (found != desks_.end() && found->second.turn) {
    think(game);
  }
}

void Survivor::concede_games() {
  for (auto& [game, desk] : desks_) {
    desk.conceding = true;
    static_cast<void>(send(protocol::Concede{protocol::GameId{game}}));
  }
}

void Survivor::answer(std::int64_t game, Desk& desk) {
  if (happens(settings_.concedes)) {
    desk.conceding = true;
    static_cast<void>(send(protocol::Concede{protocol::GameId{game}}));
    return;
  }
  Sent sent;
  sent.turn = *std::exchange(desk.turn, std::nullopt);
  sent.request = load::quick_answer(sent.turn, felt_, settings_.seed);
  sent.id = send(sent.request);
  desk.sent = std::move(sent);
  if (happens(settings_.goes_away)) {
    go_away();
    const std::chrono::milliseconds absence{std::uniform_int_distribution<std::int64_t>(
        shortest_absence.count(), longest_absence.count())(random_)};
    after(absence, [this] { connect(); });
  }
}

void Survivor::reply_came(std::int64_t id, std::string_view line) {
  if (id == login_id_) {
    return logged_in(line);
  }
  if (Desk* desk = desk_asking(id)) {
    if (desk->sent->repeated && line.rfind(R"("duplicate":true)") != std::string_view::npos) {
      ++counts_.had_been_stored;
    }
    ledger_.told_move(line, desk->seat);
    const std::int64_t game = desk->sent->turn.game;
    desk->sent.reset();
    think_again(game);
    return;
  }
  acks_.erase(id);
  overtaken_.erase(id);
}

void Survivor::error_came(std::int64_t id, std::string_view line) {
  const std::string_view code = load::error_code_in(line);
  if (id == login_id_ && (stage_ == Stage::logging_in || stage_ == Stage::registering)) {
    // The takeover's interval, or a registration that the server lost with its life.
    if (code == "unauthorized") {
      known_ = false;
    }
    go_away();
    after(before_next_try, [this] { connect(); });
  } else if (Desk* desk = desk_asking(id)) {
    answer_refused(*desk, code, line);
  } else if (overtaken_.erase(id) == 1 && (code == "stale_turn" || code == "game_over")) {
    ++counts_.overtaken;
  } else if (code != "unknown_agent" && code != "unknown_challenge" && code != "game_over" &&
             code != "conflicting_request") {
    counts_.complaints.push_back(std::string(code) +
                                 " to no answer: " + std::string(line.substr(0, 160)));
  }
}

void Survivor::answer_refused(Desk& desk, std::string_view code, std::string_view line) {
  const Sent sent = *std::exchange(desk.sent, std::nullopt);
  if (code.starts_with("bad_")) {
    if (line.find(R"("foul":true)") == std::string_view::npos) {
      desk.turn = sent.turn;
      ++desk.turn->refusals;
      think(sent.turn.game);
    }
    return;
  }
  if (code == "game_over" || code == "stale_turn") {
    ++counts_.overtaken;  // the opponent conceded meanwhile
    think_again(sent.turn.game);
    return;
  }
  counts_.complaints.push_back("an answer got " + std::string(line.substr(0, 200)));
}

std::string Survivor::standing() const {
  std::string text = name() + (is_in() ? " is in" : " is away");
  for (const auto& [game, desk] : desks_) {
    text += ", game " + std::to_string(game);
    if (desk.sent) {
      text += ": turn " + std::to_string(desk.sent->turn.turn) + " was answered";
    } else if (desk.turn) {
      text += ": turn " + std::to_string(desk.turn->turn) +
              (desk.conceding ? " is being conceded" : " waits");
    } else {
      text += ": the opponent's turn";
    }
  }
  return text;
}

void Survivor::over(std::string_view line) {
  ledger_.told_over(name(), line);
  const std::int64_t game = load::integer_in(line, "game").value_or(0);
  if (const auto desk = desks_.find(game); desk != desks_.end()) {
    if (desk->second.sent) {
      overtaken_.insert(desk->second.sent->id);
    }
    desks_.erase(desk);
    ++ends_;
  }
  acks_.emplace(send(protocol::Ack{protocol::GameId{game}}), game);
}

}  // namespace poolhall::fault
