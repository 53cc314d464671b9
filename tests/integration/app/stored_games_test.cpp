// `poolhall verify`, `replay` and `export` as programs, on a database with a game in it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "protocol/json_value.hpp"
#include "server/storage/sqlite_database.hpp"
#include "tests/support/played_game.hpp"
#include "tests/support/raw_sqlite.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall {
namespace {

using test_support::Ran;
using test_support::RawSqlite;
using testing::HasSubstr;
using testing::Not;

class StoredGames : public testing::Test {
 protected:
  StoredGames() {
    auto database = storage::open_sqlite(file_).value();
    match::add_players(*database);
    match::PlayedGame(*database, match::order_of(1), 5).play(6);
    first_shot_ = RawSqlite(file_).text("SELECT min(number) FROM turns WHERE action = 'shot'");
  }

  [[nodiscard]] Ran run(const std::string& arguments) const {
    return test_support::run_command(std::string(POOLHALL_PROGRAM) + " " + arguments);
  }

  [[nodiscard]] std::string at(const std::string& name) const {
    return (directory_ / name).string();
  }

  test_support::TemporaryDirectory directory_;
  std::filesystem::path file_ = directory_ / "games.db";
  std::string first_shot_;  // number of its turn
};

TEST_F(StoredGames, are_verified_with_exit_code_0) {
  const Ran ran = run("verify --db " + file_.string());
  EXPECT_EQ(ran.exit_code, 0) << ran.out << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("1 games (0 unfinished), 7 turns"));
}

TEST_F(StoredGames, differ_with_exit_code_1_and_the_first_difference_named) {
  RawSqlite(file_).run("UPDATE turns SET executed_v = executed_v + 1e-15 WHERE number = " +
                       first_shot_);
  const Ran ran = run("verify --db " + file_.string());
  EXPECT_EQ(ran.exit_code, 1);
  EXPECT_THAT(ran.out, HasSubstr("game 1, turn " + first_shot_ + ": executed_v: stored "));
}

TEST_F(StoredGames, cannot_be_verified_without_a_file_which_is_exit_code_2) {
  const Ran ran = run("verify --db " + at("nowhere.db"));
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_THAT(ran.err, HasSubstr("there is no such file"));
}

TEST_F(StoredGames, are_told_turn_by_turn) {
  const Ran ran = run("replay 1 --db " + file_.string());
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("game 1: Anna against Bob, 8-ball on olympiad"));
  EXPECT_THAT(ran.out, HasSubstr("turn   1  Anna  shot"));
  EXPECT_THAT(ran.out, HasSubstr("(conceded)"));
}

TEST_F(StoredGames, show_one_shot_as_a_picture) {
  const Ran ran = run("replay 1 --shot " + first_shot_ + " --ascii --db " + file_.string() +
                      " --svg " + at("shot.svg"));
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, Not(HasSubstr("(conceded)")));
  EXPECT_THAT(ran.out, HasSubstr("O--"));
  EXPECT_THAT(test_support::bytes_of(at("shot.svg")), HasSubstr("<svg"));
}

TEST_F(StoredGames, that_do_not_exist_are_said_so) {
  EXPECT_THAT(run("replay 9 --db " + file_.string()).err, HasSubstr("no game 9"));
  EXPECT_THAT(run("replay 1 --shot 99 --db " + file_.string()).err, HasSubstr("no turn 99"));
}

TEST_F(StoredGames, are_exported_as_json_lines_without_keys_while_the_match_goes_on) {
  const Ran ran = run("export --db " + file_.string());
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  std::istringstream lines(ran.out);
  std::vector<std::string> kinds;
  for (std::string line; std::getline(lines, line);) {
    const auto value = protocol::parse_json(line, {16, 1'000'000});
    ASSERT_TRUE(value) << line.substr(0, 200);
    kinds.push_back(value->as<protocol::JsonObject>()->front().first);
    if (kinds.back() == "game") {
      EXPECT_TRUE(value->member("game")->member("key")->is_null());
    }
  }
  EXPECT_THAT(kinds, testing::ElementsAre("export", "agent", "agent", "match", "game", "turn",
                                          "turn", "turn", "turn", "turn", "turn", "turn"));
}

// Whose keys are told then.
void end_match(const std::filesystem::path& file) {
  auto database = storage::open_sqlite(file).value();
  match::must(database->begin());
  const auto record = match::must(database->match(protocol::MatchId{1})).value();
  match::must(database->update_match(match::finished(record, storage::UnixMicros{1})));
  match::must(database->commit());
}

TEST_F(StoredGames, are_exported_with_their_keys_once_the_match_is_over) {
  end_match(file_);
  EXPECT_THAT(run("export --db " + file_.string()).out,
              HasSubstr("\"key\":\"01080f161d242b323940474e555c636a71787f868d949ba2a9b0b7bec5cc"));
}

TEST_F(StoredGames, are_taken_into_another_database_or_refused_at_their_line) {
  end_match(file_);
  ASSERT_EQ(run("export --db " + file_.string() + " --output " + at("games.jsonl")).exit_code, 0);
  const Ran ran = run("import " + at("games.jsonl") + " --db " + at("other.db"));
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("2 agents, 0 tournaments, 1 matches, 1 games, 7 turns"));
  EXPECT_EQ(run("verify --db " + at("other.db")).exit_code, 0);
  std::ofstream(at("broken.jsonl")) << test_support::bytes_of(at("games.jsonl")).substr(0, 500);
  const Ran broken = run("import " + at("broken.jsonl") + " --db " + at("third.db"));
  EXPECT_EQ(broken.exit_code, 2);
  EXPECT_THAT(broken.err, HasSubstr("broken.jsonl:"));
  EXPECT_THAT(broken.err, HasSubstr("nothing was imported"));
  for (const char* left : {"third.db", "third.db.lock", "third.db-wal", "third.db-shm"}) {
    EXPECT_FALSE(std::filesystem::exists(at(left))) << left;
  }
  EXPECT_EQ(run("import " + at("broken.jsonl") + " --db " + at("other.db")).exit_code, 2);
  EXPECT_TRUE(std::filesystem::exists(at("other.db")));
  EXPECT_EQ(run("import " + at("nowhere.jsonl") + " --db " + at("third.db")).exit_code, 2);
}

TEST_F(StoredGames, have_a_report_of_times_and_noise) {
  const Ran secret = run("fairness 1 --db " + file_.string());
  EXPECT_EQ(secret.exit_code, 0) << secret.err;
  EXPECT_THAT(secret.out, HasSubstr("1 matches, 1 games"));
  EXPECT_THAT(secret.out, testing::ContainsRegex("Anna +[1-9]"));
  EXPECT_THAT(secret.out, HasSubstr("secret as yet in 1 matches"));
  EXPECT_THAT(secret.out, HasSubstr("noise of 0 shots"));
  end_match(file_);
  const std::string shots =
      RawSqlite(file_).text("SELECT count(*) FROM turns WHERE action = 'shot'");
  EXPECT_THAT(run("fairness 1 --db " + file_.string()).out,
              HasSubstr("noise of " + shots + " shots"));
  EXPECT_THAT(run("fairness 7 --db " + file_.string()).err, HasSubstr("there is no match 7"));
  EXPECT_THAT(run("fairness --tournament cup --db " + file_.string()).err,
              HasSubstr("no matches of a tournament cup"));
}

TEST_F(StoredGames, are_drawn_shot_by_shot_on_one_sheet) {
  const Ran ran = run("replay 1 --db " + file_.string() + " --svg " + at("game.svg"));
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  const std::string sheet = test_support::bytes_of(at("game.svg"));
  EXPECT_THAT(sheet, HasSubstr("<svg"));
  EXPECT_THAT(sheet, HasSubstr(">" + first_shot_ + " Anna<"));
  EXPECT_THAT(sheet, HasSubstr("</svg>"));
}

// The program of docs/records.md, as it stands there.
TEST_F(StoredGames, are_checked_by_the_program_of_the_page_of_records) {
  end_match(file_);
  ASSERT_EQ(run("export --db " + file_.string() + " --output " + at("games.jsonl")).exit_code, 0);
  std::ifstream in(POOLHALL_SOURCE_DIR "/docs/records.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  const std::string fence = "```python\n";
  const auto begin = page.find(fence) + fence.size();
  std::ofstream(at("check.py")) << page.substr(begin, page.find("```", begin) - begin);
  const Ran ran =
      test_support::run_command("/usr/bin/python3 " + at("check.py") + " " + at("games.jsonl"));
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("1 commitments and the noise of "));
  EXPECT_THAT(ran.out, Not(HasSubstr(" of 0 shots")));
}

}  // namespace
}  // namespace poolhall
