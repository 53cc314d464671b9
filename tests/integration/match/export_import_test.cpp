#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "server/match/export_lines.hpp"
#include "server/match/import_lines.hpp"
#include "server/match/record_lines.hpp"
#include "server/match/verify.hpp"
#include "server/storage/sqlite_database.hpp"
#include "tests/support/played_game.hpp"
#include "tests/support/raw_sqlite.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::match {
namespace {

using protocol::GameId;
using protocol::MatchId;
using testing::HasSubstr;
using testing::Not;

class ExportImport : public testing::Test {
 protected:
  ExportImport() {
    auto database = storage::open_sqlite(file_).value();
    add_players(*database);
    must(database->begin());
    must(database->add_tournament({.id = "cup",
                                   .wire_id = protocol::TournamentId{4},
                                   .title = "The \"cup\"",
                                   .settings = "name = \"cup\"\nnoise = \"variable\"\n",
                                   .status = storage::TournamentStatus::running,
                                   .created = storage::UnixMicros{5}}));
    must(database->add_entry({.tournament = "cup",
                              .agent = storage::AgentId{2},
                              .house_bot = "greedy",
                              .house_options = {"--effort", "7"}}));
    must(database->commit());
    PlayedGame(*database, order_of(1), 5).play(10);
    PlayedGame(*database, order_of(2), 6).play(3);
    add_mirrored_pair(*database, 4);
  }

  void finish_first_match() {
    auto database = storage::open_sqlite(file_).value();
    const auto record = must(database->match(MatchId{1})).value();
    must(database->begin());
    must(database->update_match(finished(record, storage::UnixMicros{9})));
    must(database->set_tournament_status("cup", storage::TournamentStatus::finished));
    must(database->commit());
  }

  [[nodiscard]] static std::string exported(const std::filesystem::path& file,
                                            const ExportPart& part = {}) {
    auto reader = storage::open_sqlite_reader(file).value();
    std::string text;
    must(export_lines(*reader, part, [&](const std::string& line) { text += line + "\n"; }));
    return text;
  }

  [[nodiscard]] static tl::expected<ImportReport, ImportError> import(
      const std::filesystem::path& file, const std::string& text) {
    auto database = storage::open_sqlite(file).value();
    std::istringstream lines(text);
    return import_lines(*database, lines);
  }

  [[nodiscard]] static VerifyReport verified(const std::filesystem::path& file) {
    auto reader = storage::open_sqlite_reader(file).value();
    return verify(*reader, {}).value();
  }

  test_support::TemporaryDirectory directory_;
  std::filesystem::path file_ = directory_ / "test.db";
  std::filesystem::path other_ = directory_ / "other.db";
};

TEST_F(ExportImport, GivesADatabaseThatIsVerifiedAndExportedTheSame) {
  finish_first_match();
  const std::string text = exported(file_);
  const auto report = import(other_, text);
  ASSERT_TRUE(report) << report.error().line << report.error().field << report.error().reason;
  EXPECT_EQ(report->agents, 2U);
  EXPECT_EQ(report->tournaments, 1U);
  EXPECT_EQ(report->matches, 2U);
  EXPECT_EQ(report->games, 4U);
  const VerifyReport found = verified(other_);
  EXPECT_TRUE(found.same());
  EXPECT_EQ(found.turns, report->turns);
  EXPECT_EQ(exported(other_), text);
}

TEST_F(ExportImport, TakesAPartIntoADatabaseThatHasOthers) {
  finish_first_match();
  const std::string one = exported(file_, {.game = GameId{2}});
  const std::string pair = exported(file_, {.match = MatchId{2}});
  EXPECT_EQ(import(other_, one)->games, 1U);
  const auto report = import(other_, pair);
  ASSERT_TRUE(report) << report.error().reason;
  EXPECT_EQ(report->agents, 0U);
  EXPECT_EQ(report->games, 2U);
  EXPECT_TRUE(verified(other_).same());
  EXPECT_EQ(exported(other_, {.game = GameId{2}}), one);
  EXPECT_EQ(exported(other_, {.match = MatchId{2}}), pair);
}

// What shares its deviates cannot be checked without the game that they come from.
TEST_F(ExportImport, ExportsASharingGameWithTheFirstOfItsPair) {
  const auto report = import(other_, exported(file_, {.game = GameId{102}}));
  ASSERT_TRUE(report) << report.error().reason;
  EXPECT_EQ(report->games, 2U);
  EXPECT_TRUE(verified(other_).same());
}

TEST_F(ExportImport, ShowsNoSecretOfAMatchThatGoesOn) {
  const std::string text = exported(file_, {.match = MatchId{1}});
  const auto games = must(storage::open_sqlite_reader(file_).value()->games_of(MatchId{1}));
  ASSERT_EQ(games.size(), 2U);
  for (const storage::GameRecord& game : games) {
    EXPECT_THAT(text, Not(HasSubstr(to_hex(game.key))));
    EXPECT_THAT(text, Not(HasSubstr(to_hex(game.seal))));
  }
  EXPECT_THAT(exported(file_), HasSubstr("\"settings\":null"));
  const auto report = import(other_, text);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().field, "/match/seed");
  const auto whole = import(other_, exported(file_));
  ASSERT_FALSE(whole);
  EXPECT_EQ(whole.error().field, "/tournament/status");
  EXPECT_THAT(whole.error().reason, HasSubstr("tournament \"cup\" is unfinished"));
  finish_first_match();
  EXPECT_THAT(exported(file_), HasSubstr(to_hex(games[0].key)));
}

TEST_F(ExportImport, KeepsAHiddenLevelUntilTheTournamentIsOver) {
  storage::MatchRecord match;
  match.tournament = "cup";
  match.terms.noise = "low";
  match.terms.noise_hidden = true;
  storage::GameRecord game;
  game.terms = match.terms;
  game.noise = protocol::noise_preset("low").value();
  game.initial_state = "{}";
  for (const Secrets secrets : {Secrets::kept, Secrets::level_kept}) {
    EXPECT_THAT(line_of(match, secrets), HasSubstr("\"noise\":\"hidden\""));
    EXPECT_THAT(line_of(game, secrets), HasSubstr("\"noise\":null"));
    EXPECT_THAT(line_of(game, secrets), Not(HasSubstr("low")));
    EXPECT_THAT(line_of(game, secrets), Not(HasSubstr("0.25")));
  }
  EXPECT_THAT(line_of(game, Secrets::told), HasSubstr("\"noise\":{\"a\":0.25"));
}

// Every line in turn damaged in some way: refused with its number, and nothing of it is there.
TEST_F(ExportImport, RefusesBrokenLinesWithTheirNumberAndTakesNothing) {
  finish_first_match();
  const std::string text = exported(file_);
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    lines.push_back(line);
  const auto joined = [](const std::vector<std::string>& all) {
    std::string whole;
    for (const std::string& line : all)
      whole += line + "\n";
    return whole;
  };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    auto broken = lines;
    broken[i].resize(broken[i].size() / 2);
    const auto report = import(other_, joined(broken));
    ASSERT_FALSE(report) << i;
    EXPECT_EQ(report.error().line, i + 1) << report.error().reason;
  }
  EXPECT_THAT(storage::open_sqlite_reader(other_).value()->agents().value(), testing::IsEmpty());
  EXPECT_FALSE(import(other_, text.substr(0, text.size() - 1)));
  EXPECT_FALSE(import(other_, ""));
  EXPECT_TRUE(import(other_, text));
  const auto again = import(other_, text);
  ASSERT_FALSE(again);
  EXPECT_THAT(again.error().reason, HasSubstr("UNIQUE"));
}

struct Damage {
  const char* what;
  const char* from;
  const char* to;
  const char* field;
};

TEST_F(ExportImport, NamesTheFieldThatIsWrong) {
  finish_first_match();
  const std::string text = exported(file_);
  for (const Damage& damage : {
           Damage{"a missing member", "\"refusals\":0,", "", "/turn/refusals"},
           Damage{"another type", "\"attempt\":0", "\"attempt\":\"0\"", "/game/attempt"},
           Damage{"an unknown name", "\"action\":\"shot\"", "\"action\":\"shoot\"", "/turn/action"},
           Damage{"a changed number", "\"used_us\":1", "\"used_us\":2", "/turn/checksum"},
           Damage{"a changed state", "\"to_move\":0", "\"to_move\":1", "/game/seal"},
           Damage{"a changed match", "\"mirrored\":\"none\"", "\"mirrored\":\"rack\"",
                  "/match/seal"},
           Damage{"a short digest", "\"commitment\":\"", "\"commitment\":\"0", "/game/commitment"},
           Damage{"a missing turn", "\"game\":1,\"turn\":2,", "\"game\":1,\"turn\":3,",
                  "/turn/turn"},
           Damage{"another format", "\"format\":2", "\"format\":3", "/export/format"},
           Damage{"an unknown kind", "{\"agent\":", "{\"player\":", "/player"},
       }) {
    std::string broken = text;
    const auto at = broken.find(damage.from);
    ASSERT_NE(at, std::string::npos) << damage.what;
    broken.replace(at, std::string(damage.from).size(), damage.to);
    const auto report = import(other_, broken);
    ASSERT_FALSE(report) << damage.what;
    EXPECT_EQ(report.error().field, damage.field) << damage.what << ": " << report.error().reason;
  }
}

}  // namespace
}  // namespace poolhall::match
