// Records to rows and back. The columns of each table stand here in one order, in which they are
// bound and read. Reading is strict: a value of another type, or outside its type's range, is
// Unreadable, never something like it.
//
//   SQLite::Statement insert(db, insert_sql("turns", turn_columns));
//   Binder(insert) << turn;
#pragma once

#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Statement.h>

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "server/storage/records.hpp"

namespace poolhall::storage {

// Stays inside this room's sources: becomes StorageFault::unreadable at its door.
struct Unreadable : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline constexpr std::string_view agent_columns = "id,name,token_hash,house_bot,created";
inline constexpr std::string_view tournament_columns = "id,wire_id,title,settings,status,created";
inline constexpr std::string_view entry_columns =
    "tournament,agent,place,from_round,until_round,house_bot,command";
inline constexpr std::string_view match_columns =
    "id,tournament,pairing,request,first_agent,second_agent,games,rules,table_name,materials,noise,"
    "noise_hidden,rack_gap,rack_jitter,clock_us,increment_us,shot_cap_us,max_refusals,"
    "lag_per_turn_us,lag_per_game_us,seed,mirrored,over,created,finished,challenge,seal";
inline constexpr std::string_view standing_columns = "rank,agent,points,games,wins,losses,draws";
inline constexpr std::string_view game_columns =
    "id,match,number,attempt,first_agent,second_agent,rules,table_name,materials,noise,"
    "noise_hidden,rack_gap,rack_jitter,clock_us,increment_us,shot_cap_us,max_refusals,"
    "lag_per_turn_us,lag_per_game_us,breaker,rack_seed,noise_key,noise_a,noise_b,noise_theta,"
    "noise_phi,noise_v,commitment,initial_state,physics_version,rules_version,created,over,winner,"
    "reason,turns,head,first_acknowledged,second_acknowledged,finished,seal,first_commitment,"
    "second_commitment,shared_from,first_secret,second_secret";
inline constexpr std::string_view result_columns =
    "id,match,first_agent,second_agent,rules,breaker,winner,reason,finished";
inline constexpr std::string_view turn_columns =
    "game,number,action,seat,request,shot_index,intended_a,intended_b,intended_theta,intended_phi,"
    "intended_v,executed_a,executed_b,executed_theta,executed_phi,executed_v,moved,cue_ball_x,"
    "cue_ball_y,call_kind,call_ball,call_pocket,decision,winner,reason,refusals,used_us,"
    "forgiven_us,first_left_us,second_left_us,first_lag_left_us,second_lag_left_us,stored,"
    "physics_version,rules_version,checksum,state_before,state_after,ruling,events,shared,texts";

// "INSERT INTO table(columns) VALUES(?,?,...)"
[[nodiscard]] std::string insert_sql(std::string_view table, std::string_view columns);

// Binds values to a statement's parameters from the first on. Strings and digests are not copied:
// they must live until the statement is reset.
class Binder {
 public:
  explicit Binder(SQLite::Statement& statement) : statement_(statement) {}

  Binder& operator<<(std::int64_t value);
  Binder& operator<<(double value);
  Binder& operator<<(std::string_view text);
  Binder& operator<<(const std::string& text);
  Binder& operator<<(const Digest& digest);
  Binder& operator<<(std::nullopt_t);
  Binder& bytes(std::string_view value);
  template <class T>
  Binder& operator<<(const std::optional<T>& value) {
    return value ? *this << *value : *this << std::nullopt;
  }
  Binder& operator<<(Micros value) { return *this << std::int64_t{value.count()}; }
  Binder& operator<<(UnixMicros value) { return *this << number(value); }

  Binder& operator<<(const AgentRecord& agent);
  Binder& operator<<(const TournamentRecord& tournament);
  Binder& operator<<(const EntryRecord& entry);  // its options have a table of their own
  Binder& operator<<(const MatchRecord& match);
  Binder& operator<<(const GameRecord& game);
  // `texts` is packed_texts(turn): it stands for the long texts, which are then not bound.
  Binder& turn(const TurnRecord& turn, const std::optional<std::string>& texts);

 private:
  void put(const TermsRecord& terms);
  void put(const ShotPart& shot);
  void put(const std::optional<rules::GameResult>& result);

  SQLite::Statement& statement_;
  int next_ = 1;
};

// Reads a row's columns from the first on.
class Columns {
 public:
  explicit Columns(SQLite::Statement& statement) : statement_(statement) {}

  [[nodiscard]] std::int64_t integer();
  [[nodiscard]] double real();
  [[nodiscard]] std::string text();
  [[nodiscard]] std::string bytes();
  [[nodiscard]] Digest digest();
  [[nodiscard]] bool flag();
  [[nodiscard]] std::uint32_t count();  // 0 .. 2^32 - 1
  [[nodiscard]] Micros micros() { return Micros{integer()}; }
  [[nodiscard]] UnixMicros date() { return UnixMicros{integer()}; }
  [[nodiscard]] rules::Seat seat();

  // Nothing, and on to the next column, where this one is null.
  [[nodiscard]] bool skip_null();
  // Fails on the column read last.
  [[noreturn]] void fail(const std::string& expected) const;

  [[nodiscard]] AgentRecord agent();
  [[nodiscard]] TournamentRecord tournament();
  [[nodiscard]] EntryRecord entry();
  [[nodiscard]] MatchRecord match();
  [[nodiscard]] FinalStanding final_standing();
  [[nodiscard]] GameRecord game();
  [[nodiscard]] TurnRecord turn();
  [[nodiscard]] ResultRecord result_row();

 private:
  [[nodiscard]] SQLite::Column take();
  [[nodiscard]] std::optional<std::string> optional_text();
  [[nodiscard]] std::optional<std::uint32_t> optional_count();
  [[nodiscard]] std::optional<Digest> optional_digest();
  [[nodiscard]] TermsRecord terms();
  [[nodiscard]] std::optional<rules::GameResult> result();
  [[nodiscard]] std::optional<ShotPart> shot();
  void texts(TurnRecord& turn);
  [[nodiscard]] rules::Call call();
  [[nodiscard]] protocol::ShotParams stroke();
  [[nodiscard]] ClockPart clock();

  SQLite::Statement& statement_;
  int next_ = 0;
};

}  // namespace poolhall::storage
