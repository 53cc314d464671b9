// What somebody else has changed in a file, or what a disk has lost, is named when it is read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <initializer_list>
#include <memory>
#include <string>

#include "sample_records.hpp"
#include "server/storage/sqlite_database.hpp"
#include "tests/support/raw_sqlite.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::storage {
namespace {

using test_support::RawSqlite;
using test_support::TemporaryDirectory;
using testing::ElementsAre;
using testing::HasSubstr;

// A change of one row, and how its reading fails.
struct Damage {
  const char* change;
  const char* reason;
};

class DamagedDatabase : public testing::Test {
 protected:
  DamagedDatabase() {
    add_samples(*owner_);
    const bool added = owner_->begin() && owner_->append_turn(sample_turn(1, 1)) &&
                       owner_->append_turn(sample_ending(2, 1)) && owner_->commit();
    EXPECT_TRUE(added);
    raw_.run("PRAGMA synchronous = OFF");
  }

  // Makes each change alone in the row of the table, and reads.
  template <class Read>
  void expect_named(const std::string& table, const std::string& row,
                    std::initializer_list<Damage> damages, Read read) {
    raw_.run("CREATE TABLE sound AS SELECT * FROM " + table);
    for (const auto& [change, reason] : damages) {
      raw_.run("UPDATE " + table + " SET " + change + " WHERE " + row);
      const auto found = read();
      EXPECT_FALSE(found) << change;
      if (!found) {
        EXPECT_EQ(found.error().fault, StorageFault::unreadable) << change;
        EXPECT_THAT(found.error().reason, HasSubstr(reason)) << change;
      }
      raw_.run("DELETE FROM " + table + "; INSERT INTO " + table + " SELECT * FROM sound");
    }
    EXPECT_TRUE(read());
    raw_.run("DROP TABLE sound");
  }

  TemporaryDirectory directory_;
  std::unique_ptr<Database> owner_ = open_sqlite(directory_ / "test.db").value();
  RawSqlite raw_{directory_ / "test.db"};
};

TEST_F(DamagedDatabase, NamesTheValueOfATurnThatCannotBe) {
  expect_named(
      "turns", "game = 1",
      {{"action = 'jump'", "action: got jump, expected the name of a turn's action"},
       {"seat = 2", "seat: got 2, expected 0 or 1"},
       {"decision = 'maybe'", "decision: got maybe, expected the name of a decision"},
       {"winner = 0", "reason: got null, expected a reason beside the winner"},
       {"reason = 'tired'", "reason: got tired, expected the name of an end reason"},
       {"refusals = 4294967296", "refusals: got 4294967296, expected a count"},
       {"checksum = x'00'", "expected 32 bytes"},
       {"texts = NULL", "texts: got null, expected the turn's texts, here or each in its own"},
       {"texts = x'00'", "texts: got 1 bytes, expected the turn's texts"},
       {"ruling = '{}'", "bytes, expected the turn's texts, and nothing in their own columns"},
       {"shared = 2", "shared: got 2, expected 1 in a shot with shared deviates, else null"}},
      [this] { return owner_->turn(GameId{1}, 1); });
}

TEST_F(DamagedDatabase, NamesTheValueOfAShotThatCannotBe) {
  expect_named(
      "turns", "game = 1",
      {{"shot_index = -1", "shot_index: got -1, expected a count"},
       {"shot_index = NULL", "intended_a: got 1.5, expected null in a turn without a shot"},
       {"intended_b = NULL", "intended_b: got null, expected a finite real number"},
       {"executed_v = 9e999", "executed_v: got Inf, expected a finite real number"},
       {"moved = NULL", "moved: got null, expected an integer"},
       {"cue_ball_x = NULL", "cue_ball_y: got 0.125, expected null beside cue_ball_x"},
       {"cue_ball_y = NULL", "cue_ball_y: got null, expected a finite real number"},
       {"call_kind = NULL", "call_kind: got null, expected a text"},
       {"call_kind = 'bank'", "call_kind: got bank, expected none, pocket, safety or push_out"},
       {"call_kind = 'safety'", "call_ball: got 9, expected null beside this kind of call"},
       {"call_kind = 'safety', call_ball = NULL", "call_pocket: got side_right, expected null"},
       {"call_ball = 16", "call_ball: got 16, expected a ball's number"},
       {"call_pocket = 'middle'", "call_pocket: got middle, expected the name of a pocket"}},
      [this] { return owner_->turn(GameId{1}, 1); });
}

TEST_F(DamagedDatabase, NamesAPartOfAShotInATurnWithoutOne) {
  expect_named("turns", "game = 2",
               {{"moved = 1", "moved: got 1, expected null in a turn without a shot"},
                {"texts = NULL, events = '[]'", "texts: got null, expected the turn's texts"},
                {"shared = 1", "shared: got 1, expected 1 in a shot with shared deviates"}},
               [this] { return owner_->turn(GameId{2}, 1); });
}

TEST_F(DamagedDatabase, NamesTheValueOfAGameOrMatchThatCannotBe) {
  const Damage rules{"rules = 'snooker'", "rules: got snooker, expected the name of a rule set"};
  expect_named("games", "id = 1",
               {rules,
                {"rack_gap = 9e999", "rack_gap: got Inf, expected a finite real number"},
                {"noise_key = x'00'", "expected 32 bytes"},
                {"over = 7", "over: got 7, expected 0 or 1"}},
               [this] { return owner_->game(GameId{1}); });
  expect_named("matches", "id = 1",
               {rules, {"mirrored = 3", "mirrored: got 3, expected 0, 1 or 2"}},
               [this] { return owner_->match(MatchId{1}); });
  raw_.run("UPDATE games SET over = 1, finished = 9, reason = 'conceded', winner = 0");
  expect_named("games", "id = 1", {rules}, [this] { return owner_->results(); });
  expect_named("tournaments", "id = 'demo'",
               {{"status = 'asleep'", "status: got asleep, expected a tournament's status"}},
               [this] { return owner_->tournaments(); });
}

TEST_F(DamagedDatabase, RepeatsOnlyTheBeginningOfALongValue) {
  raw_.run("UPDATE turns SET action = '" + std::string(1'000, 'x') + "'");
  const auto turn = owner_->turn(GameId{1}, 1);
  ASSERT_FALSE(turn);
  EXPECT_THAT(turn.error().reason, HasSubstr("got " + std::string(40, 'x') + "..., expected"));
}

TEST_F(DamagedDatabase, HasRowsThatReferToNothing) {
  raw_.run("DELETE FROM games WHERE id = 2");
  EXPECT_THAT(owner_->check_structure().value(),
              ElementsAre("a row of turns refers to nothing in games"));
}

TEST_F(DamagedDatabase, IsReadOnlyWithTheLatestSchema) {
  raw_.run("PRAGMA user_version = 2");
  const auto reader = open_sqlite_reader(directory_ / "test.db");
  ASSERT_FALSE(reader);
  EXPECT_EQ(reader.error().fault, StorageFault::cannot_open);
  EXPECT_THAT(reader.error().reason, HasSubstr("schema 2 is older than"));
  std::ofstream(directory_ / "empty.db").flush();
  const auto empty = open_sqlite_reader(directory_ / "empty.db");
  ASSERT_FALSE(empty);
  EXPECT_THAT(empty.error().reason, HasSubstr("the database is empty"));
}

// The third schema's entries know whether somebody was withdrawn; these know it no more.
TEST_F(DamagedDatabase, StaysAsItIsWhereAMigrationFails) {
  raw_.run("PRAGMA user_version = 3");
  const std::string before = raw_.text("SELECT group_concat(sql) FROM sqlite_master");
  owner_.reset();
  EXPECT_FALSE(open_sqlite(directory_ / "test.db"));
  EXPECT_EQ(raw_.text("PRAGMA user_version"), "3");
  EXPECT_EQ(raw_.text("SELECT group_concat(sql) FROM sqlite_master"), before);
}

}  // namespace
}  // namespace poolhall::storage
