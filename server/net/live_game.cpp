#include "server/net/live_game.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "server/match/chain.hpp"
#include "server/storage/failpoint.hpp"

namespace poolhall::net {

using match::Phase;
using protocol::Error;
using protocol::ErrorCode;
using std::chrono::steady_clock;

namespace {

// Requests that one game keeps while something is in flight.
constexpr std::size_t waiting_bound = 16;
constexpr std::chrono::milliseconds writer_retry{50};
// After so many refusals of the database a game cannot go on: it is void.
constexpr std::uint32_t failures_bound = 3;

}  // namespace

LiveGame::LiveGame(match::Game game, GameCard card, GameServices& services, Start start)
    : game_(std::move(game)), card_(std::move(card)), services_(services), start_(start) {}

void LiveGame::begin() {
  if (start_ == Start::fresh) {
    for (const Seat seat : both_seats) {
      push(seat,
           protocol::GameStart<Outgoing>{terms_of(record(), card_, seat), {game_.state_json()}});
    }
  }
  await_agents();
}

void LiveGame::await_agents() {
  const auto wait =
      start_ == Start::fresh ? services_.limits.arrival_deadline : services_.limits.return_deadline;
  arrival_deadline_ =
      services_.deadlines.at(steady_clock::now() + wait, [this] { start_waited_enough(); });
  go_on();
}

void LiveGame::start_waited_enough() {
  if (halted_ || game_.phase() != Phase::due) {
    return;
  }
  if (suspended_ || !services_.has_places(record().id)) {
    await_agents();  // not everybody may be able to come
    return;
  }
  const bool first_here = session_of(Seat::first) != nullptr;
  const bool second_here = session_of(Seat::second) != nullptr;
  awaiting_agents_ = false;
  const Seat to_move = game_.state().to_move;
  if (start_ == Start::fresh && first_here != second_here) {
    forfeit(first_here ? Seat::second : Seat::first);
  } else if (start_ == Start::fresh && !first_here && has_never_registered(to_move)) {
    forfeit(to_move);  // nobody would hear its clock
  } else {
    go_on();
  }
}

bool LiveGame::has_never_registered(Seat seat) const {
  const Agent* agent = services_.book.find(record().agents[rules::index(seat)]);
  return agent != nullptr && is_unclaimed(agent->record.token_hash);
}

void LiveGame::places_given() {
  if (awaiting_agents_ && arrival_deadline_.is_set() && game_.phase() == Phase::due) {
    await_agents();  // from now on
  }
}

bool LiveGame::all_needed_are_in() const {
  if (!services_.has_places(record().id)) {
    return false;  // one that plays another game of its own may be gone before this one is over
  }
  if (start_ == Start::resume) {
    return session_of(game_.state().to_move) != nullptr;
  }
  return session_of(Seat::first) && session_of(Seat::second);
}

// After whatever happened: the end, the next turn, and what has waited.
void LiveGame::go_on() {
  if (called_off_ && !in_flight()) {
    end_as_void();
    return;
  }
  if (left_ && !in_flight() && game_.phase() != Phase::over) {
    forfeit(*left_);
    return;
  }
  if (game_.phase() == Phase::due && !halted_ && (!awaiting_agents_ || all_needed_are_in())) {
    awaiting_agents_ = false;
    arrival_deadline_.cancel();
    if (awaits_reveals()) {
      return;
    }
    begin_turn();
  }
  take_waiting();
  if (halted_ && !in_flight()) {
    services_.on_quiet();
  }
}

void LiveGame::begin_turn() {
  const Seat mover = game_.state().to_move;
  if (const auto session = session_of(mover)) {
    session->probe_lag();
    session->push(
        turn_of(game_, clocks_if_begun(game_, mover, steady_clock::now(), services_.time)));
  }
  game_.begin_turn(match::rounded_up(steady_clock::now()));
  watch_flag();
}

void LiveGame::watch_flag() {
  if (suspended_) {
    game_.pause(match::rounded_down(steady_clock::now()));
  }
  const auto expires = game_.expires(lag_of(game_.state().to_move));
  if (!expires || halted_) {
    flag_.cancel();
    return;
  }
  flag_ = services_.deadlines.at(SteadyTime{*expires}, [weak = weak_from_this()] {
    if (const auto self = weak.lock()) {
      self->flag_due();
    }
  });
}

void LiveGame::flag_due() {
  const Seat mover = game_.state().to_move;
  if (const auto session = session_of(mover)) {
    session->read_arrived();
  }
  if (game_.phase() != Phase::thinking) {
    return;
  }
  const match::Arrival now{match::rounded_down(steady_clock::now()), lag_of(mover),
                           storage::unix_now()};
  match::Answer answer = game_.expire(now);
  if (std::holds_alternative<match::Store>(answer)) {
    act(std::move(answer), GameRequest{});
  } else {
    watch_flag();  // a new measurement of the lag has moved it
  }
}

// What was read before the flag fell has come in time: when exactly it had arrived nobody knows.
match::Arrival LiveGame::arrival_of(const GameRequest& request) const {
  match::Arrival arrival{match::rounded_down(request.read_at), lag_of(request.seat),
                         storage::unix_now()};
  if (const auto expires = game_.expires(arrival.lag)) {
    arrival.at = std::min(arrival.at, *expires - match::Instant{1});
  }
  return arrival;
}

bool LiveGame::in_flight() const {
  return game_.phase() == Phase::playing || game_.phase() == Phase::storing;
}

bool LiveGame::is_awaited(Seat seat, const protocol::Request& request) const {
  if (game_.phase() != Phase::thinking || game_.state().to_move != seat) {
    return false;
  }
  if (const auto* shot = std::get_if<protocol::Shot>(&request)) {
    return shot->turn == game_.state().turn;
  }
  const auto* decide = std::get_if<protocol::Decide>(&request);
  return decide != nullptr && decide->turn == game_.state().turn;
}

void LiveGame::take(const GameRequest& request) {
  if (halted_) {
    request.asker.refuse(
        {ErrorCode::shutting_down, "", "the server stops; ask again when it is back", record().id});
    return;
  }
  // Nobody is played out of its part in the noise by a quick shot.
  const bool waits = game_.phase() == Phase::due && may_be_revealed() &&
                     !std::holds_alternative<protocol::Concede>(request.what);
  match::Answer answer = waits ? match::Answer{match::Later{}} : ask(request);
  act(std::move(answer), request);
}

match::Answer LiveGame::ask(const GameRequest& request) {
  const match::Arrival arrival = arrival_of(request);
  if (const auto* shot = std::get_if<protocol::Shot>(&request.what)) {
    return game_.shot(request.seat, *shot, arrival);
  }
  if (const auto* decide = std::get_if<protocol::Decide>(&request.what)) {
    return game_.decide(request.seat, *decide, arrival);
  }
  return game_.concede(request.seat, arrival);
}

void LiveGame::act(match::Answer answer, const GameRequest& request) {
  if (auto* job = std::get_if<match::Play>(&answer)) {
    play(std::move(job->job), request.asker);
  } else if (auto* what = std::get_if<match::Store>(&answer)) {
    write(std::move(*what), request.asker);
  } else if (const auto* refused = std::get_if<match::Refuse>(&answer)) {
    request.asker.refuse(refused->error);
    watch_flag();
  } else if (const auto* past = std::get_if<match::Past>(&answer)) {
    look_up(past->turn, request);
  } else if (std::holds_alternative<match::Join>(answer)) {
    joined_.push_back(request.asker);
  } else if (std::holds_alternative<match::Later>(answer)) {
    if (waiting_.size() < waiting_bound) {
      waiting_.push_back(request);
    } else {
      request.asker.refuse({ErrorCode::rate_limited, "",
                            "too many requests while a turn is being played", record().id});
    }
  } else {
    request.asker.reply(protocol::GameReply{record().id});
  }
}

void LiveGame::play(match::ShotJob job, const Asker& asker) {
  flag_.cancel();
  asker_ = asker;
  storage::failpoint(storage::Failpoint::after_receive);
  if (pair_) {
    play_in_pair(std::move(job));
  } else {
    run(std::move(job));
  }
}

// The clock stands while the shot waits for that of the other game.
void LiveGame::play_in_pair(match::ShotJob job) {
  const SharedNoise::ShotKey key{job.row.seat, job.row.shot->index};
  pair_->noise->submit(
      pair_->side, key, [self = shared_from_this(), job](SharedNoise::Run how) mutable {
        const storage::GameRecord& first =
            self->pair_->first ? self->pair_->first->record() : self->record();
        if (how == SharedNoise::Run::shared) {
          match::share_deviates(job, match::mixed_key(first.key, first.agent_secrets), first.id);
        }
        self->run(std::move(job));
      });
}

void LiveGame::run(match::ShotJob job) {
  boost::asio::post(services_.workers, [self = shared_from_this(), job = std::move(job)] {
    match::PlayOutcome outcome = match::play(job);
    storage::failpoint(storage::Failpoint::after_simulate);
    boost::asio::post(self->services_.io, [self, outcome = std::move(outcome)]() mutable {
      self->settle(std::move(outcome));
    });
  });
}

void LiveGame::settle(match::PlayOutcome outcome) {
  if (const auto* fault = std::get_if<match::ServerFault>(&outcome)) {
    spdlog::error("game {}: a shot could not be played: {}", number(record().id), fault->reason);
  }
  GameRequest request;
  request.asker = asker_;
  match::Answer answer = game_.settle(std::move(outcome), match::rounded_up(steady_clock::now()));
  if (const auto* refused = std::get_if<match::Refuse>(&answer)) {
    for (const Asker& other : std::exchange(joined_, {})) {
      other.refuse(refused->error);
    }
  }
  act(std::move(answer), request);
  if (!in_flight()) {
    go_on();
  }
}

void LiveGame::write(match::Store what, const Asker& asker) {
  flag_.cancel();
  asker_ = asker;
  store_ = std::make_shared<const match::Store>(std::move(what));
  post_write();
}

void LiveGame::post_write() {
  const storage::Posted posted = services_.writer.post(
      [what = store_](storage::Database& database) -> storage::Expected<void> {
        auto appended = database.append_turn(what->turn);
        if (!appended || !what->game) {
          return appended;
        }
        return database.update_game(*what->game);
      },
      [self = shared_from_this()](const storage::Expected<void>& stored) {
        self->written(stored);
      });
  if (posted != storage::Posted::accepted) {
    // The database is in trouble: the game stands, its clock too, and nothing is lost.
    write_retry_ =
        services_.deadlines.at(steady_clock::now() + writer_retry, [this] { post_write(); });
  }
}

void LiveGame::written(const storage::Expected<void>& stored) {
  if (!stored) {
    not_written(stored.error());
    return;
  }
  failures_ = 0;
  const auto what = std::exchange(store_, nullptr);
  game_.stored();
  tell(*what);
  if (game_.phase() == Phase::over) {
    if (pair_) {
      pair_->noise->leave(pair_->side);
    }
    const auto self = shared_from_this();  // on_over may let go of this game
    tell_over();
    take_waiting();
    services_.on_over(*this);
    if (halted_) {
      services_.on_quiet();
    }
    return;
  }
  go_on();
}

void LiveGame::not_written(const storage::StorageError& error) {
  spdlog::error("game {}: turn {} cannot be stored: {}", number(record().id), store_->turn.number,
                error.reason);
  const Error reason{ErrorCode::internal, "", "the turn could not be stored", record().id};
  store_.reset();
  asker_.refuse(reason);
  for (const Asker& asker : std::exchange(joined_, {})) {
    asker.refuse(reason);
  }
  game_.not_stored(match::rounded_up(steady_clock::now()));
  if (++failures_ == failures_bound || called_off_) {
    end_as_void();
    return;
  }
  watch_flag();
  if (left_) {
    go_on();
  } else {
    take_waiting();
  }
}

void LiveGame::take_waiting() {
  const auto noise_is_made = [this] { return game_.phase() != Phase::due || !may_be_revealed(); };
  while (!waiting_.empty() && !in_flight() && noise_is_made()) {
    const GameRequest request = std::move(waiting_.front());
    waiting_.erase(waiting_.begin());
    take(request);
  }
}

void LiveGame::look_up(std::uint32_t turn, const GameRequest& request) const {
  if (game_.last_turn() && game_.last_turn()->number == turn) {
    answer_from(*game_.last_turn(), request);
    return;
  }
  services_.archive.read(
      [id = record().id, turn](storage::Reader& reader) { return reader.turn(id, turn); },
      [self = shared_from_this(),
       request](const storage::Expected<std::optional<storage::TurnRecord>>& row) {
        if (row && *row) {
          self->answer_from(**row, request);
        } else {
          request.asker.refuse({ErrorCode::stale_turn, "/params/turn", "got a turn that is over",
                                self->record().id});
        }
      });
}

void LiveGame::answer_from(const storage::TurnRecord& row, const GameRequest& request) const {
  if (const auto* shot = std::get_if<protocol::Shot>(&request.what)) {
    answer_from_row(row, request.asker, request.seat, *shot);
  } else if (const auto* decide = std::get_if<protocol::Decide>(&request.what)) {
    answer_from_row(row, request.asker, request.seat, *decide);
  } else {
    request.asker.refuse({ErrorCode::game_over, "/params/game", "the game is over", record().id});
  }
}

void LiveGame::forfeit(Seat loser) {
  const match::Arrival now{match::rounded_down(steady_clock::now()), {}, storage::unix_now()};
  act(game_.forfeit(loser, now), GameRequest{});
}

void LiveGame::leave(Seat loser) {
  left_ = left_.value_or(loser);
  go_on();
}

void LiveGame::call_off() {
  called_off_ = true;
  go_on();
}

void LiveGame::end_as_void() {
  if (game_.phase() == Phase::over) {
    return;
  }
  const match::Arrival now{match::rounded_down(steady_clock::now()), {}, storage::unix_now()};
  act(game_.make_void(now), GameRequest{});
}

void LiveGame::suspend() {
  suspended_ = true;
  watch_flag();
}

void LiveGame::go_on_after_suspension() {
  suspended_ = false;
  game_.unpause(match::rounded_up(steady_clock::now()));
  watch_flag();
  if (game_.phase() == Phase::due && awaiting_agents_) {
    await_agents();
  }
}

void LiveGame::halt() {
  halted_ = true;
  flag_.cancel();
  if (pair_) {
    pair_->noise->leave(pair_->side);
  }
}

bool LiveGame::may_be_revealed() const {
  return reveals_being_stored_ > 0 || (!reveals_over_ && game_.awaits_reveal());
}

// The first turn waits for those who have committed themselves, and for what is being stored.
bool LiveGame::awaits_reveals() {
  if (may_be_revealed() && !reveals_over_ && !reveal_deadline_.is_set()) {
    reveal_deadline_ =
        services_.deadlines.at(steady_clock::now() + services_.limits.reveal_deadline, [this] {
          reveals_over_ = true;
          go_on();
        });
  }
  return may_be_revealed();
}

void LiveGame::reveal(const Asker& asker, Seat seat, const protocol::GameReveal& request) {
  if (halted_) {
    asker.refuse(
        {ErrorCode::shutting_down, "", "the server stops; ask again when it is back", record().id});
    return;
  }
  const auto row = game_.reveal(seat, match::digest_of(request.secret.text));
  if (!row) {
    asker.refuse(row.error());
    return;
  }
  if (!*row && reveals_being_stored_ == 0) {
    asker.reply(protocol::GameReply{record().id});
    return;
  }
  ++reveals_being_stored_;
  const auto posted = services_.writer.post(
      [game = record()](storage::Database& database) { return database.update_game(game); },
      [self = shared_from_this(), asker, seat](const storage::Expected<void>& stored) {
        self->revealed(asker, seat, stored);
      });
  if (posted != storage::Posted::accepted) {
    revealed(asker, seat,
             tl::unexpected(storage::StorageError{storage::StorageFault::busy,
                                                  "the database takes nothing at the moment"}));
  }
}

void LiveGame::revealed(const Asker& asker, Seat seat, const storage::Expected<void>& stored) {
  --reveals_being_stored_;
  if (stored) {
    asker.reply(protocol::GameReply{record().id});
  } else {
    game_.not_revealed(seat);
    asker.refuse({ErrorCode::internal, "", stored.error().reason, record().id});
  }
  go_on();
}

}  // namespace poolhall::net
