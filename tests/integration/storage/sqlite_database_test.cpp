#include "server/storage/sqlite_database.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>
#include <random>

#include "sample_records.hpp"
#include "tests/support/raw_sqlite.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::storage {
namespace {

using test_support::RawSqlite;
using test_support::TemporaryDirectory;
using testing::HasSubstr;

StorageError error_of(const std::filesystem::path& file) {
  auto opened = open_sqlite(file);
  EXPECT_FALSE(opened);
  return opened ? StorageError{} : opened.error();
}

// Counts the rows that statements stepped over because no index led them past; of all connections
// that are opened while it lives.
class RowsScanned {
 public:
  RowsScanned() {
    count = 0;
    sqlite3_auto_extension(entry());
  }
  ~RowsScanned() { sqlite3_cancel_auto_extension(entry()); }
  RowsScanned(const RowsScanned&) = delete;
  RowsScanned& operator=(const RowsScanned&) = delete;

  [[nodiscard]] static int take() { return std::exchange(count, 0); }

 private:
  static int add(unsigned, void*, void* statement, void*) {
    count += sqlite3_stmt_status(static_cast<sqlite3_stmt*>(statement),
                                 SQLITE_STMTSTATUS_FULLSCAN_STEP, 1);
    return 0;
  }
  static int watch(sqlite3* connection, const char**, const void*) {
    return sqlite3_trace_v2(connection, SQLITE_TRACE_PROFILE, add, nullptr);
  }
  static void (*entry())() { return reinterpret_cast<void (*)()>(watch); }

  static inline int count = 0;
};

TEST(SqliteDatabase, says_that_the_directory_is_missing) {
  TemporaryDirectory directory;
  const StorageError error = error_of(directory / "nowhere/test.db");
  EXPECT_EQ(error.fault, StorageFault::cannot_open);
  EXPECT_THAT(error.reason, HasSubstr("there is no directory"));
}

TEST(SqliteDatabase, says_that_a_directory_is_not_a_file) {
  TemporaryDirectory directory;
  EXPECT_THAT(error_of(directory.path()).reason, HasSubstr("not a file"));
}

TEST(SqliteDatabase, says_that_a_file_is_not_a_database) {
  TemporaryDirectory directory;
  std::ofstream(directory / "test.db") << std::string(5000, 'x');
  EXPECT_EQ(error_of(directory / "test.db").fault, StorageFault::not_a_database);
}

TEST(SqliteDatabase, leaves_another_programs_database_alone) {
  TemporaryDirectory directory;
  RawSqlite(directory / "test.db").run("CREATE TABLE mine(x)");
  EXPECT_EQ(error_of(directory / "test.db").fault, StorageFault::foreign);
}

TEST(SqliteDatabase, refuses_a_newer_schema_and_says_which) {
  TemporaryDirectory directory;
  ASSERT_TRUE(open_sqlite(directory / "test.db"));
  RawSqlite(directory / "test.db").run("PRAGMA user_version = 999");
  const StorageError error = error_of(directory / "test.db");
  EXPECT_EQ(error.fault, StorageFault::newer_schema);
  EXPECT_THAT(error.reason, HasSubstr("999"));
}

TEST(SqliteDatabase, keeps_who_had_left_when_it_takes_over_the_third_schema) {
  TemporaryDirectory directory;
  ASSERT_TRUE(open_sqlite(directory / "test.db"));
  RawSqlite(directory / "test.db")
      .run(
          "ALTER TABLE turns DROP COLUMN texts;"
          "ALTER TABLE entries ADD COLUMN withdrawn INTEGER NOT NULL DEFAULT 0;"
          "ALTER TABLE entries DROP COLUMN from_round; ALTER TABLE entries DROP COLUMN until_round;"
          "INSERT INTO agents VALUES(1, 'anna', x'01', NULL, 0), (2, 'bert', x'02', NULL, 0);"
          "INSERT INTO tournaments VALUES('cup', 1, 'cup', '', 'open', 0);"
          "INSERT INTO entries(tournament, agent, place, withdrawn) VALUES('cup', 1, 0, 1),"
          " ('cup', 2, 1, 0); PRAGMA user_version = 3");
  const auto entries = open_sqlite(directory / "test.db").value()->entries("cup").value();
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[0].until_round, 0U);
  EXPECT_EQ(entries[1].until_round, std::nullopt);
  EXPECT_EQ(entries[0].from_round, 0U);
}

TEST(SqliteDatabase, keeps_turns_when_it_takes_over_the_fourth_schema) {
  TemporaryDirectory directory;
  TurnRecord turn = sample_turn(1, 1);
  turn.state_before += '\n';  // so that its texts stay apart, as they were then
  {
    auto owner = open_sqlite(directory / "test.db").value();
    add_samples(*owner);
    ASSERT_TRUE(owner->begin() && owner->append_turn(turn) && owner->commit());
  }
  RawSqlite(directory / "test.db")
      .run("ALTER TABLE turns DROP COLUMN texts; PRAGMA user_version = 4");
  auto owner = open_sqlite(directory / "test.db").value();
  EXPECT_EQ(owner->turn(GameId{1}, 1).value(), turn);
  ASSERT_TRUE(owner->begin() && owner->append_turn(sample_turn(1, 2)) && owner->commit());
  EXPECT_EQ(owner->turn(GameId{1}, 2).value(), sample_turn(1, 2));
}

TEST(SqliteDatabase, says_which_process_owns_the_file) {
  TemporaryDirectory directory;
  auto owner = open_sqlite(directory / "test.db");
  ASSERT_TRUE(owner);
  const StorageError error = error_of(directory / "test.db");
  EXPECT_EQ(error.fault, StorageFault::locked);
  EXPECT_THAT(error.reason, HasSubstr(std::to_string(getpid())));
}

TEST(SqliteDatabase, knows_a_locked_file_by_another_name) {
  TemporaryDirectory directory;
  auto owner = open_sqlite(directory / "test.db");
  ASSERT_TRUE(owner);
  std::filesystem::create_symlink(directory / "test.db", directory / "alias.db");
  EXPECT_EQ(error_of(directory / "alias.db").fault, StorageFault::locked);
}

TEST(SqliteDatabase, is_free_again_when_its_owner_is_closed) {
  TemporaryDirectory directory;
  ASSERT_TRUE(open_sqlite(directory / "test.db"));
  EXPECT_TRUE(open_sqlite(directory / "test.db"));
}

TEST(SqliteDatabase, reads_beside_the_owner_what_is_committed) {
  TemporaryDirectory directory;
  auto owner = open_sqlite(directory / "test.db").value();
  add_samples(*owner);
  auto reader = open_sqlite_reader(directory / "test.db");
  ASSERT_TRUE(reader) << reader.error().reason;
  ASSERT_TRUE(owner->begin());
  ASSERT_TRUE(owner->append_turn(sample_turn(1, 1)));
  EXPECT_EQ((*reader)->turn(GameId{1}, 1).value(), std::nullopt);
  ASSERT_TRUE(owner->commit());
  EXPECT_EQ((*reader)->turn(GameId{1}, 1).value(), sample_turn(1, 1));
}

// Else a start of the server and the logins after it would take the longer, the more was played.
TEST(SqliteDatabase, finds_what_goes_on_and_what_is_untold_without_walking_through_what_is_over) {
  TemporaryDirectory directory;
  auto owner = open_sqlite(directory / "test.db").value();
  add_samples(*owner);
  ASSERT_TRUE(owner->begin());
  for (std::uint32_t number = 2; number < 100; ++number) {
    GameRecord game = sample_game(number + 1, number);
    ASSERT_TRUE(owner->add_game(game));
    game.over = true;
    game.result = rules::GameResult{rules::Seat::first, rules::EndReason::conceded};
    game.acknowledged = {true, number > 2};
    ASSERT_TRUE(owner->update_game(game));
  }
  ASSERT_TRUE(owner->commit());
  const RowsScanned scanned;
  auto reader = open_sqlite_reader(directory / "test.db").value();
  EXPECT_EQ(reader->game_ids().value().size(), 100U);
  EXPECT_GE(RowsScanned::take(), 98);  // it does count
  EXPECT_TRUE(reader->counters());
  EXPECT_EQ(reader->unfinished_games().value().size(), 2U);
  EXPECT_EQ(reader->unfinished_matches().value().size(), 1U);
  EXPECT_EQ(reader->unacknowledged_by(AgentId{1}, 256).value().size(), 1U);
  EXPECT_TRUE(reader->untold_matches(AgentId{1}, 256));
  EXPECT_TRUE(reader->untold_tournaments(AgentId{1}, 256));
  EXPECT_LE(RowsScanned::take(), 5);
}

TEST(SqliteDatabase, reads_consistently_while_the_owner_writes) {
  TemporaryDirectory directory;
  auto owner = open_sqlite(directory / "test.db").value();
  add_samples(*owner);
  auto reader = open_sqlite_reader(directory / "test.db").value();
  std::vector<bool> seen;
  ASSERT_TRUE(reader->consistently([&] {
    seen.push_back(reader->turn(GameId{1}, 1).value().has_value());
    ASSERT_TRUE(owner->begin());
    ASSERT_TRUE(owner->append_turn(sample_turn(1, 1)));
    ASSERT_TRUE(owner->commit());
    seen.push_back(reader->turn(GameId{1}, 1).value().has_value());
  }));
  seen.push_back(reader->turn(GameId{1}, 1).value().has_value());
  EXPECT_THAT(seen, testing::ElementsAre(false, false, true));
}

TEST(SqliteDatabase, lets_nobody_but_its_owner_read_the_keys_in_it) {
  TemporaryDirectory directory;
  auto owner = open_sqlite(directory / "test.db").value();
  add_samples(*owner);
  using std::filesystem::perms;
  for (const char* name : {"test.db", "test.db-wal"}) {
    const perms given = std::filesystem::status(directory / name).permissions();
    EXPECT_EQ(given, perms::owner_read | perms::owner_write) << name;
  }
}

TEST(SqliteDatabase, makes_no_file_for_a_reader) {
  TemporaryDirectory directory;
  EXPECT_FALSE(open_sqlite_reader(directory / "test.db"));
  EXPECT_FALSE(std::filesystem::exists(directory / "test.db"));
}

TEST(SqliteDatabase, says_which_stored_value_is_unreadable) {
  TemporaryDirectory directory;
  auto owner = open_sqlite(directory / "test.db").value();
  add_samples(*owner);
  ASSERT_TRUE(owner->begin());
  ASSERT_TRUE(owner->append_turn(sample_turn(1, 1)));
  ASSERT_TRUE(owner->commit());
  RawSqlite(directory / "test.db").run("UPDATE turns SET call_pocket = 'middle'");
  const auto turn = owner->turn(GameId{1}, 1);
  ASSERT_FALSE(turn);
  EXPECT_EQ(turn.error().fault, StorageFault::unreadable);
  EXPECT_THAT(turn.error().reason, HasSubstr("call_pocket: got middle"));
}

// The child commits one turn, begins another and is killed.
void write_and_die(const std::filesystem::path& file) {
  auto database = open_sqlite(file).value();
  add_samples(*database);
  const bool committed = database->begin() && database->append_turn(sample_turn(1, 1)) &&
                         database->commit() && database->begin() &&
                         database->append_turn(sample_turn(1, 2));
  if (committed)
    std::raise(SIGKILL);
  _exit(1);
}

// That cannot be made shorter.
std::string noise_text(std::size_t length) {
  std::mt19937 random(7);
  std::string text(length, ' ');
  for (char& character : text)
    character = static_cast<char>(' ' + random() % 90);
  return text;
}

TEST(SqliteDatabase, says_that_the_texts_of_a_turn_are_unreadable) {
  for (const char* damage : {"texts = x'28b52ffd'", "texts = x''", "state_after = '{}'",
                             "ruling = '{}'", "events = '[]'", "texts = NULL"}) {
    TemporaryDirectory directory;
    {
      auto owner = open_sqlite(directory / "test.db").value();
      add_samples(*owner);
      ASSERT_TRUE(owner->begin() && owner->append_turn(sample_turn(1, 1)) && owner->commit());
    }
    RawSqlite(directory / "test.db").run(std::string("UPDATE turns SET ") + damage);
    const auto turn = open_sqlite(directory / "test.db").value()->turn(GameId{1}, 1);
    ASSERT_FALSE(turn) << damage;
    EXPECT_EQ(turn.error().fault, StorageFault::unreadable) << damage;
    EXPECT_THAT(turn.error().reason, HasSubstr("texts")) << damage;
  }
}

TEST(SqliteDatabase, stores_what_a_turn_says_again_and_again_once) {
  TemporaryDirectory directory;
  auto owner = open_sqlite(directory / "test.db").value();
  add_samples(*owner);
  TurnRecord turn = sample_turn(1, 1);
  turn.state_before = turn.state_after = *turn.ruling = turn.shot->events = noise_text(10'000);
  ASSERT_TRUE(owner->begin() && owner->append_turn(turn) && owner->commit());
  EXPECT_EQ(owner->turn(GameId{1}, 1).value(), turn);
  EXPECT_EQ(RawSqlite(directory / "test.db").text("SELECT length(texts) < 10000 FROM turns"), "1");
}

TEST(SqliteDatabase, has_what_was_committed_and_no_more_after_a_kill) {
  TemporaryDirectory directory;
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0)
    write_and_die(directory / "test.db");
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
  auto database = open_sqlite(directory / "test.db");
  ASSERT_TRUE(database) << database.error().reason;
  EXPECT_EQ((*database)->turn(GameId{1}, 1).value(), sample_turn(1, 1));
  EXPECT_EQ((*database)->turn(GameId{1}, 2).value(), std::nullopt);
  EXPECT_EQ((*database)->unfinished_games().value().at(0).last_turn, sample_turn(1, 1));
}

// How often SQLite has begun the write-ahead log anew, for all of it was in the database file: the
// third number of the log's header.
std::uint32_t times_begun_anew(const std::filesystem::path& file) {
  std::array<unsigned char, 16> header{};
  std::ifstream(file.string() + "-wal", std::ios::binary)
      .read(reinterpret_cast<char*>(header.data()), header.size());
  return std::uint32_t{header[12]} << 24 | std::uint32_t{header[13]} << 16 |
         std::uint32_t{header[14]} << 8 | header[15];
}

// Commits turns without a pause until the log has been begun anew twice; their number.
std::uint32_t write_beside_checkpoints(const std::filesystem::path& file, Database& database) {
  TurnRecord turn = sample_turn(1, 1);
  turn.shot->events = noise_text(20'000);
  constexpr std::uint32_t most = 200'000;
  constexpr std::uint32_t least = 512;  // several times what the log may hold
  for (std::uint32_t number = 1; number <= most; ++number) {
    turn.number = number;
    if (!database.begin() || !database.append_turn(turn) || !database.commit())
      return 0;
    if (number % 16 == 0 && number >= least && times_begun_anew(file) >= 2)
      return number;
  }
  return 0;
}

TEST(SqliteDatabase, begins_its_log_anew_though_there_is_always_something_to_write) {
  TemporaryDirectory directory;
  auto owner = open_sqlite(directory / "test.db", {.pages = 64, .log_pages = 128}).value();
  add_samples(*owner);
  const std::uint32_t written = write_beside_checkpoints(directory / "test.db", *owner);
  ASSERT_GT(written, 0U);
  EXPECT_LT(std::filesystem::file_size(directory / "test.db-wal"), written * 20'000);
}

TEST(SqliteDatabase, leaves_the_log_alone_while_somebody_reads_an_older_state) {
  TemporaryDirectory directory;
  auto owner = open_sqlite(directory / "test.db", {.pages = 1}).value();
  add_samples(*owner);
  auto reader = open_sqlite_reader(directory / "test.db").value();
  ASSERT_TRUE(reader->consistently([&] {
    EXPECT_EQ(reader->turn(GameId{1}, 1).value(), std::nullopt);
    for (std::uint32_t number = 1; number <= 50; ++number) {
      ASSERT_TRUE(owner->begin());
      ASSERT_TRUE(owner->append_turn(sample_turn(1, number)));
      ASSERT_TRUE(owner->commit());
    }
    EXPECT_EQ(reader->turn(GameId{1}, 1).value(), std::nullopt);
  }));
  EXPECT_EQ(reader->turn(GameId{1}, 50).value(), sample_turn(1, 50));
}

TEST(SqliteDatabase, has_every_turn_when_it_is_killed_among_checkpoints) {
  TemporaryDirectory directory;
  const std::filesystem::path file = directory / "test.db";
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    auto database = open_sqlite(file, {.pages = 64, .log_pages = 128}).value();
    add_samples(*database);
    const std::uint32_t written = write_beside_checkpoints(file, *database);
    std::ofstream(directory / "written") << written << std::flush;
    std::raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
  std::uint32_t written = 0;
  std::ifstream(directory / "written") >> written;
  ASSERT_GT(written, 0U);
  auto database = open_sqlite(file).value();
  std::uint32_t found = 0;
  ASSERT_TRUE(database->each_turn(GameId{1}, [&](const TurnRecord& turn) {
    found += turn.number == found + 1 ? 1 : 0;
    return true;
  }));
  EXPECT_EQ(found, written);
  EXPECT_THAT(database->check_structure().value(), testing::IsEmpty());
}

}  // namespace
}  // namespace poolhall::storage
