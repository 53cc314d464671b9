// The hostile server as scripts see it: it waits for the bot, logs it in, answers what bots ask
// beside their games, hands out turns and takes the answers. What the script does not do itself is
// done as the real server would.
//
//   Host host(options, bot, conduct);
//   host.arrive();
//   HostedGame& game = host.begin({});        // game.start
//   host.play_turn(game);                     // game.turn, answer, reply
//   host.cut(Cut::reset); host.expect_return(); host.tell_again(game);
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "clients/conformance/bot.hpp"
#include "clients/conformance/conduct.hpp"
#include "clients/conformance/hosted_game.hpp"
#include "clients/conformance/transcript.hpp"
#include "clients/conformance/verdict.hpp"
#include "clients/conformance/wire.hpp"
#include "protocol/codec.hpp"

namespace poolhall::conformance {

using Clock = std::chrono::steady_clock;
using Instant = Clock::time_point;
using std::chrono::milliseconds;

struct HostOptions {
  milliseconds clock{10'000};     // on the bot's clock at every turn
  milliseconds patience{10'000};  // for it to connect, to log in and to come back
  milliseconds bound{60'000};     // for one check in all
  std::uint64_t seed = 20261130;  // of racks and of the opponent's shots
  // That the bot plays; unset: what it asks for, or both where it asks for none.
  std::optional<rules::RuleSet> rules{};
  bool all_rules = false;  // both, whatever it asks for
};

// An answer to a turn, as it was read.
struct Answer {
  HostedGame* game = nullptr;
  protocol::RequestId id;
  protocol::Request request;  // Shot, Decide or Concede
};

enum class Cut : std::uint8_t { close, reset };

// What came, as far as the clerk did not deal with it.
struct Happening {
  enum class Kind : std::uint8_t { answer, logged_in, closed, ended, silence };
  Kind kind = Kind::silence;
  std::optional<Answer> answer{};
  std::string how{};  // it ended
};

class Host {
 public:
  Host(const HostOptions& options, Bot& bot, Conduct& conduct);
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  // ---- Arriving ----

  // Starts the bot and lets it log in; then waits a moment for a challenge. If it does not come,
  // throws Stop with this verdict.
  void arrive(Verdict absent = Verdict::not_reached);
  // The next connection and its login. Throws Stop when it does not come.
  void expect_return();
  // Whether the bot, which must not, connects again in `time`.
  [[nodiscard]] bool comes_back_within(milliseconds time);
  void cut(Cut how);
  // Connections are refused for `time`.
  void stay_away(milliseconds time);
  // For `time` who connects is told this and the connection closed; how many did.
  [[nodiscard]] int turn_away(const protocol::Error& error, milliseconds time);

  // ---- Games ----

  // The game that the bot has challenged for, or one of a tournament; game.start is told. Throws
  // Stop if the bot does not play these rules.
  HostedGame& begin(GamePlan plan);
  // game.state, and game.turn where it is the bot's turn.
  void tell_again(HostedGame& game);
  void hand_turn(HostedGame& game);
  // The script hands the turn out itself.
  void note_handed(const HostedGame& game) { handed_.insert({game.id(), game.state().turn}); }
  // The answer to the turn that was handed out last in this game, or in any.
  [[nodiscard]] Answer answer_of(HostedGame& game);
  [[nodiscard]] Answer any_answer();
  // The first answer that can be played; those before are refused as the real server would.
  // Nothing if the turn was lost by refusals.
  struct Accepted {
    Answer answer;
    Played played;
  };
  [[nodiscard]] std::optional<Accepted> acceptable(HostedGame& game);
  [[nodiscard]] std::optional<Accepted> acceptable(Answer answer);
  // As the real server refuses: counted, and the last of a turn is a foul and ends it.
  void refuse_answer(const Answer& answer, protocol::Error error);
  // Nothing was done; the turn goes on.
  void put_off(const Answer& answer, const protocol::Error& error);
  void store(const Accepted& accepted);
  void reply_to(const Accepted& accepted);
  // Both, unless the turn was lost.
  void finish(const std::optional<Accepted>& accepted);
  // All of that.
  void play_turn(HostedGame& game);
  // The opponent plays, if it is its turn, until it is the bot's.
  void play_opponent(HostedGame& game);

  // ---- Lines ----

  void push(const protocol::Notification<Outgoing>& notification);
  void reply(const protocol::RequestId& id, const protocol::Reply<Outgoing>& reply);
  void refuse(const protocol::RequestId& id, const protocol::Error& error);
  // A line with its end, as it is.
  void send_raw(const std::string& line);
  [[nodiscard]] std::string encoded(const protocol::Notification<Outgoing>& notification);
  [[nodiscard]] std::uint64_t next_seq() { return ++seq_; }
  void set_pace(Pace pace) { pace_ = pace; }
  enum class Garnish : std::uint8_t { none, unknown_members };
  void set_garnish(Garnish garnish) { garnish_ = garnish; }
  // What is sent is kept back until flush(), then sent as one piece.
  void hold() { holding_ = true; }
  void flush();

  void probe(std::int64_t t);

  // Serves the bot for `time`; what it answers to turns meanwhile is kept for answer_of().
  void serve_for(milliseconds time);
  [[nodiscard]] const HostOptions& options() const { return options_; }
  [[nodiscard]] const Transcript& transcript() const { return transcript_; }
  // Throws Stop if this standing check has failed in this session.
  void demand(std::string_view duty) const;
  [[nodiscard]] bool is_connected() const { return link_ != nullptr; }
  // How often this was asked.
  [[nodiscard]] int times_asked(protocol::Method method) const;
  // The next request of this kind is refused so, once; answers to turns are not meant.
  void refuse_next(protocol::Method method, protocol::Error error);
  // Answers that came for turns that were over.
  [[nodiscard]] int past_answers() const { return past_answers_; }

 private:
  [[nodiscard]] Happening next(Instant deadline);
  [[nodiscard]] std::optional<Happening> line_came();
  [[nodiscard]] std::optional<Happening> wait_for_io(Instant deadline);
  void connected(std::unique_ptr<Link> link);
  [[nodiscard]] bool log_in_until(Instant deadline);
  [[noreturn]] void give_up(const Happening& happening, const std::string& wanted);

  // The clerk: everything but answers to turns. Nothing if it is dealt with.
  [[nodiscard]] std::optional<Happening> take(const protocol::Incoming& incoming);
  void take_hello(const protocol::RequestId& id, const protocol::Hello& hello);
  [[nodiscard]] bool take_login(const protocol::RequestId& id, const protocol::Request& request);
  void logged_in(const protocol::RequestId& id, const protocol::Hex256& token, std::string name,
                 const protocol::Request& request);
  void serve(const protocol::RequestId& id, const protocol::Challenge& challenge);
  void serve(const protocol::RequestId& id, const protocol::Sync& sync);
  void serve(const protocol::RequestId& id, const protocol::GameReady& ready);
  void serve(const protocol::RequestId& id, const protocol::GameReveal& reveal);
  void serve_simple(const protocol::RequestId& id, const protocol::Request& request);
  void take_lag(const protocol::Incoming& incoming, const protocol::Lag& lag);

  // An answer to the turn that is due; everything else is dealt with.
  [[nodiscard]] std::optional<Answer> take_answer(const protocol::RequestId& id,
                                                  const protocol::Request& request);
  void past_answer(const Answer& answer);
  void forget_key(const Answer& answer);
  [[nodiscard]] std::optional<Answer> kept_answer(const HostedGame* game);
  [[nodiscard]] Answer await_answer(HostedGame* game, milliseconds time, const std::string& wanted);
  void watch_answer(const HostedGame& game, const protocol::Request& request);
  void watch_shot(const HostedGame& game, const protocol::Shot& shot);
  void broke(std::string_view duty, Verdict verdict, std::string why);
  [[nodiscard]] HostedGame* find(protocol::GameId game);

  HostOptions options_;
  Instant begin_ = Clock::now();
  Bot& bot_;
  Conduct& conduct_;
  Transcript transcript_;
  Doorway doorway_;
  std::unique_ptr<Link> link_;
  protocol::Limits limits_;
  protocol::Hex256 token_;  // that the bot was started with
  std::string server_;

  // The agent.
  std::map<std::string, std::string> names_;  // by token
  std::string identity_;                      // token of the last login
  protocol::EventDetail detail_ = protocol::EventDetail::full;
  enum class Stage : std::uint8_t { silent, greeted, in } stage_ = Stage::silent;
  int sessions_ = 0;
  bool login_refused_ = false;  // on this connection
  int lines_read_ = 0;

  // What is going on.
  std::map<protocol::GameId, std::unique_ptr<HostedGame>> games_;
  std::set<std::pair<protocol::GameId, std::uint32_t>> handed_;  // turns
  std::optional<protocol::Challenge> challenge_;                 // the bot's latest
  std::deque<Answer> kept_;
  using ShotKey = std::tuple<protocol::GameId, std::uint32_t, std::string>;
  std::map<ShotKey, protocol::Shot> keys_;
  std::deque<protocol::Hex256> commitments_;
  std::map<protocol::GameId, protocol::Hex256> bound_;  // commitments that game.start has shown
  std::set<std::int64_t> probes_;
  std::map<protocol::Method, int> asked_;
  std::map<protocol::Method, protocol::Error> refusals_;
  int past_answers_ = 0;
  std::int64_t next_id_ = 5'000'000'000;  // beyond 32 bits, as ids may be
  protocol::MatchId match_{};             // of the bot's latest challenge

  // Sending.
  std::uint64_t seq_ = 0;
  Pace pace_ = Pace::whole;
  Garnish garnish_ = Garnish::none;
  bool holding_ = false;
  std::string held_;
};

// `line` with members that no version of the protocol has in each of its objects.
[[nodiscard]] std::string with_unknown_members(std::string_view line);

}  // namespace poolhall::conformance
