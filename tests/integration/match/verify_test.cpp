#include "server/match/verify.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/match/chain.hpp"
#include "server/storage/sqlite_database.hpp"
#include "server/storage/sqlite_rows.hpp"
#include "tests/support/played_game.hpp"
#include "tests/support/raw_sqlite.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::match {
namespace {

using protocol::GameId;
using test_support::RawSqlite;
using test_support::TemporaryDirectory;

std::string told(const VerifyReport& report) {
  std::string text;
  for (const std::string& line : report.structure)
    text += line + "\n";
  for (const Difference& d : report.differences)
    text += std::to_string(number(d.game)) + " " + (d.turn ? std::to_string(*d.turn) : "-") + " " +
            d.field + ": " + d.reason + "\n";
  return text;
}

class VerifyTest : public testing::Test {
 protected:
  // Two games: one over, one going on.
  VerifyTest() {
    auto database = storage::open_sqlite(file_).value();
    add_players(*database);
    PlayedGame(*database, order_of(1), 5).play(14);
    PlayedGame going_on(*database, order_of(2), 6);
    for (int turn = 0; turn < 3; ++turn)
      going_on.one_turn();
  }

  [[nodiscard]] VerifyReport report() const {
    auto reader = storage::open_sqlite_reader(file_).value();
    return verify(*reader, {}).value();
  }

  TemporaryDirectory directory_;
  std::filesystem::path file_ = directory_ / "test.db";
};

TEST_F(VerifyTest, finds_every_stored_shot_bit_for_bit_the_same) {
  const VerifyReport all = report();
  EXPECT_TRUE(all.same()) << told(all);
  EXPECT_EQ(all.games, 2U);
  EXPECT_EQ(all.unfinished, 1U);
  EXPECT_GE(all.shots, 10U);
  EXPECT_EQ(all.other_version, 0U);
}

// SQL that changes the least bit of a value, or another value where it has no bits of its own.
std::string changed(const std::string& column, const std::string& type) {
  const auto toggled = [](const std::string& x) {
    return "CASE WHEN (" + x + ") & 1 THEN (" + x + ") - 1 ELSE (" + x + ") + 1 END";
  };
  if (column == "number")
    return column + " + 1048576";  // with its least bit changed it would be another row's
  if (type == "integer")
    return toggled(column);
  if (type == "real")
    return column + " + max(abs(" + column + ") * 2.3e-16, 5e-324)";
  if (type == "text") {
    const std::string middle = "length(" + column + ") / 2 + 1";
    return "substr(" + column + ", 1, " + middle + " - 1) || char(" +
           toggled("unicode(substr(" + column + ", " + middle + ", 1))") + ") || substr(" + column +
           ", " + middle + " + 1)";
  }
  return "randomblob(32)";
}

std::vector<std::string> split(std::string_view columns) {
  std::vector<std::string> names{""};
  for (const char c : columns) {
    if (c == ',')
      names.emplace_back();
    else
      names.back() += c;
  }
  return names;
}

// Columns of one row, each damaged in a copy of its own; how many were.
template <class Check>
int damage_each(const TemporaryDirectory& directory, const std::filesystem::path& file,
                const std::string& table, std::string_view columns, const std::string& where,
                Check check) {
  int damaged = 0;
  for (const std::string& column : split(columns)) {
    const std::filesystem::path copy = directory / (table + "-" + column + ".db");
    std::filesystem::copy_file(file, copy);
    {
      RawSqlite raw(copy);
      const std::string type =
          raw.text("SELECT typeof(" + column + ") FROM " + table + " WHERE " + where);
      if (type == "null")
        continue;
      raw.run("UPDATE " + table + " SET " + column + " = " + changed(column, type) + " WHERE " +
              where);
    }
    ++damaged;
    auto reader = storage::open_sqlite_reader(copy).value();
    check(column, verify(*reader, {}).value());
  }
  return damaged;
}

TEST_F(VerifyTest, finds_and_locates_a_change_in_any_value_of_a_shot) {
  const int damaged =
      damage_each(directory_, file_, "turns", storage::turn_columns, "game = 1 AND number = 5",
                  [](const std::string& column, const VerifyReport& found) {
                    EXPECT_FALSE(found.same()) << column;
                    if (column == "game")
                      return;  // then the turn is another game's
                    ASSERT_EQ(found.differences.size(), 1U) << column << "\n" << told(found);
                    EXPECT_EQ(found.differences[0].game, GameId{1}) << column;
                    EXPECT_EQ(found.differences[0].turn, 5U) << column << "\n" << told(found);
                  });
  EXPECT_GE(damaged, 33);
}

TEST_F(VerifyTest, finds_and_locates_a_change_in_any_value_of_a_game) {
  const int damaged = damage_each(directory_, file_, "games", storage::game_columns, "id = 1",
                                  [](const std::string& column, const VerifyReport& found) {
                                    EXPECT_FALSE(found.same()) << column;
                                    if (column == "id")
                                      return;  // then it is another game
                                    ASSERT_EQ(found.differences.size(), 1U) << column << "\n"
                                                                            << told(found);
                                    EXPECT_EQ(found.differences[0].game, GameId{1}) << column;
                                  });
  EXPECT_GE(damaged, 38);
}

TEST_F(VerifyTest, finds_a_missing_last_turn) {
  RawSqlite(file_).run(
      "DELETE FROM turns WHERE game = 1 AND number = "
      "(SELECT max(number) FROM turns WHERE game = 1)");
  const VerifyReport found = report();
  ASSERT_EQ(found.differences.size(), 1U);
  EXPECT_EQ(found.differences[0].field, "over");
}

// A file of another version: every row says so, and its checksums are as that version made them.
TEST_F(VerifyTest, judges_shots_of_another_physics_version_without_playing_them) {
  auto database = storage::open_sqlite(file_).value();
  storage::GameRecord game = must(database->game(GameId{2})).value();
  storage::Digest head = first_link(game);
  std::vector<storage::TurnRecord> turns;
  must(database->each_turn(GameId{2}, [&](const storage::TurnRecord& row) {
    turns.push_back(row);
    return true;
  }));
  RawSqlite raw(file_);
  raw.run("DELETE FROM turns WHERE game = 2");
  must(database->begin());
  for (storage::TurnRecord& row : turns) {
    row.physics_version = "physics-of-old";
    row.checksum = chained(head, row);
    head = row.checksum;
    must(database->append_turn(row));
  }
  must(database->commit());
  const VerifyReport all = report();
  EXPECT_TRUE(all.same()) << told(all);
  EXPECT_EQ(all.other_version, turns.size());
}

}  // namespace
}  // namespace poolhall::match
