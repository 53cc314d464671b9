// Who comes to a tournament and who leaves it, before it begins and while it goes on.
#include <gtest/gtest.h>

#include <map>

#include "admin_fixture.hpp"
#include "scripted_play.hpp"
#include "server/ledger/stored_tournament.hpp"
#include "server/storage/sqlite_database.hpp"
#include "wire_client.hpp"

// A namespace of its own: some of its names are another file's.
namespace poolhall::net_tests::entries_tests {
namespace {

using protocol::Membership;
using protocol::Received;

const std::string head = "name = \"cup\"\nmirrored = \"none\"\nnoise = \"none\"\n";
const std::string anna_and_bert = "[[entry]]\nagent = \"anna\"\n[[entry]]\nagent = \"bert\"\n";
const std::string swiss =
    head + "format = \"swiss\"\ngames_per_match = 1\nrounds = 2\n" + anna_and_bert;
const std::string three = head +
                          "games_per_match = 2\nmax_concurrent_games = 1\n"
                          "[[entry]]\nagent = \"anna\"\n[[entry]]\nagent = \"bert\"\n"
                          "[[entry]]\nagent = \"carl\"\n";

class Entries : public AdminFixture {
 protected:
  [[nodiscard]] std::unique_ptr<WireClient> client(const std::string& name) {
    auto joined = std::make_unique<WireClient>(server_->port());
    tokens_[name] = joined->join(name);
    return joined;
  }
  [[nodiscard]] std::unique_ptr<WireClient> again(const std::string& name) {
    auto back = std::make_unique<WireClient>(server_->port());
    back->login(tokens_.at(name));
    return back;
  }
  void create(const std::string& file) {
    const auto made = post("tournaments", file);
    ASSERT_EQ(made.status, 201) << made.body;
  }
  void begin() { ASSERT_EQ(post("tournaments/cup/start").status, 200); }
  [[nodiscard]] tournament::Names names() const {
    const auto reader = storage::open_sqlite_reader(directory_ / "test.db").value();
    return ledger::stored_tournament(*reader, "cup").value()->book.names();
  }

  std::map<std::string, std::string> tokens_;
};

Membership join(WireClient& client) {
  return client.call<protocol::TournamentReply>(protocol::TournamentJoin{protocol::TournamentId{1}})
      .membership;
}

Membership leave(WireClient& client) {
  return client
      .call<protocol::TournamentReply>(protocol::TournamentLeave{protocol::TournamentId{1}})
      .membership;
}

std::string why_not(WireClient& client) {
  const auto refusal = client.refused(protocol::TournamentJoin{protocol::TournamentId{1}});
  return refusal.code + ": " + refusal.error.reason;
}

void concede_next(WireClient& client) {
  const auto game = client.wait_for<protocol::GameStart<Received>>().terms.game;
  static_cast<void>(client.call<protocol::GameReply>(protocol::Concede{game}));
}

std::vector<std::pair<std::string, double>> table_of(const protocol::TournamentOver& over) {
  std::vector<std::pair<std::string, double>> table;
  for (const protocol::StandingRow& row : over.standings) {
    table.emplace_back(row.agent, row.points);
  }
  return table;
}

using Table = std::vector<std::pair<std::string, double>>;

TEST_F(Entries, WhoJoinsBeforeTheStartPlays) {
  const auto anna = client("anna");
  const auto bert = client("bert");
  const auto carl = client("carl");
  create(head + "games_per_match = 1\n" + anna_and_bert);
  EXPECT_EQ(join(*carl), Membership::joined);
  EXPECT_EQ(join(*carl), Membership::joined) << "again is the same";
  EXPECT_EQ(leave(*bert), Membership::left);
  EXPECT_EQ(names(), (tournament::Names{"anna", "carl"}));
  begin();
  concede_next(*anna);
  EXPECT_EQ(table_of(carl->wait_for<protocol::TournamentOver>()),
            (Table{{"carl", 1}, {"anna", 0}}));
}

TEST_F(Entries, WhoHasLeftBeforeTheStartMayComeBackUntilThen) {
  const auto anna = client("anna");
  const auto bert = client("bert");
  create(swiss);
  EXPECT_EQ(leave(*bert), Membership::left);
  EXPECT_EQ(post("tournaments/cup/start").status, 409) << "one entry is no tournament";
  start();
  const auto back = again("bert");
  EXPECT_EQ(join(*back), Membership::joined);
  EXPECT_EQ(names(), (tournament::Names{"anna", "bert"}));
}

TEST_F(Entries, ALateEntryPlaysFromTheNextRoundOfASwissTournament) {
  const auto anna = client("anna");
  const auto bert = client("bert");
  const auto carl = client("carl");
  create(swiss);
  begin();
  const auto game = anna->wait_for<protocol::GameStart<Received>>().terms.game;
  EXPECT_EQ(join(*carl), Membership::joined);
  static_cast<void>(anna->call<protocol::GameReply>(protocol::Concede{game}));
  // In the second round anna, who has played the first one, gets the bye.
  concede_next(*carl);
  EXPECT_EQ(table_of(carl->wait_for<protocol::TournamentOver>()),
            (Table{{"bert", 2}, {"anna", 1}, {"carl", 0}}));
}

TEST_F(Entries, ALateEntryIsInTheSameScheduleAfterARestart) {
  {
    const auto anna = client("anna");
    const auto bert = client("bert");
    const auto carl = client("carl");
    create(swiss);
    begin();
    static_cast<void>(anna->wait_for<protocol::GameStart<Received>>());
    EXPECT_EQ(join(*carl), Membership::joined);
  }
  start();
  const auto anna = again("anna");
  const auto carl = again("carl");
  const auto game = anna->wait_for<protocol::GameSnapshot<Received>>().terms.game;
  static_cast<void>(anna->call<protocol::GameReply>(protocol::Concede{game}));
  concede_next(*carl);
  EXPECT_EQ(table_of(carl->wait_for<protocol::TournamentOver>()),
            (Table{{"bert", 2}, {"anna", 1}, {"carl", 0}}));
}

TEST_F(Entries, NobodyJoinsWhereTheFormatOrTheFileDoesNotAllowIt) {
  const auto anna = client("anna");
  const auto bert = client("bert");
  const auto carl = client("carl");
  create(head + "join = \"never\"\n" + anna_and_bert);
  EXPECT_NE(why_not(*carl).find("tournament_closed"), std::string::npos);
  EXPECT_EQ(join(*anna), Membership::joined) << "the file's own are in it";
  begin();
  EXPECT_NE(why_not(*carl).find("tournament_closed"), std::string::npos);
  EXPECT_EQ(post("tournaments/cup/enter", R"({"agent":"carl"})").status, 409)
      << "a round robin that goes on takes nobody";
}

TEST_F(Entries, AfterTheLastRoundIsDrawnNobodyJoins) {
  const auto anna = client("anna");
  const auto bert = client("bert");
  const auto carl = client("carl");
  create(swiss);
  begin();
  concede_next(*anna);
  static_cast<void>(anna->wait_for<protocol::GameStart<Received>>());  // of the second round
  EXPECT_NE(why_not(*carl).find("takes no entries any more"), std::string::npos);
}

TEST_F(Entries, WhoLeavesForfeitsTheMatchThatGoesOnAndPlaysNoOther) {
  const auto anna = client("anna");
  const auto bert = client("bert");
  const auto carl = client("carl");
  create(three);
  begin();
  static_cast<void>(bert->wait_for<Turn>());  // of the first match, bert against carl
  EXPECT_EQ(leave(*bert), Membership::left);
  for (int game = 0; game < 2; ++game) {
    const auto over = carl->wait_for<protocol::GameOver>();
    EXPECT_EQ(over.reason, rules::EndReason::forfeit);
    EXPECT_TRUE(over.scored);
    EXPECT_TRUE(over.winner);
  }
  EXPECT_EQ(carl->wait_for<protocol::MatchOver>().own_points, 2);
  EXPECT_NE(why_not(*bert).find("tournament_closed"), std::string::npos);
  concede_next(*anna);
  concede_next(*anna);
  EXPECT_EQ(table_of(anna->wait_for<protocol::TournamentOver>()),
            (Table{{"carl", 4}, {"anna", 0}, {"bert", 0}}));
}

TEST_F(Entries, AShotThatIsBeingPlayedIsStoredBeforeTheForfeit) {
  const auto anna = client("anna");
  const auto bert = client("bert");
  create(head + "games_per_match = 1\n" + anna_and_bert);
  begin();
  const auto shot = anna->send(scripted_shot(anna->wait_for<Turn>()));
  EXPECT_EQ(post("tournaments/cup/withdraw", R"({"agent":"anna"})").status, 200);
  static_cast<void>(anna->answer_to(shot));
  EXPECT_EQ(bert->wait_for<protocol::GameOver>().reason, rules::EndReason::forfeit);
  EXPECT_EQ(table_of(bert->wait_for<protocol::TournamentOver>()),
            (Table{{"bert", 1}, {"anna", 0}}));
}

TEST_F(Entries, WhoHasLeftStaysOutAfterARestart) {
  {
    const auto anna = client("anna");
    const auto bert = client("bert");
    const auto carl = client("carl");
    create(three);
    begin();
    static_cast<void>(bert->wait_for<Turn>());
    EXPECT_EQ(post("tournaments/cup/pause").status, 200);
    EXPECT_EQ(leave(*bert), Membership::left);
    EXPECT_EQ(carl->wait_for<protocol::GameOver>().reason, rules::EndReason::forfeit);
  }
  start();
  const auto anna = again("anna");
  const auto carl = again("carl");
  EXPECT_EQ(post("tournaments/cup/resume").status, 200);
  EXPECT_EQ(carl->wait_for<protocol::MatchOver>().own_points, 2);
  concede_next(*anna);
  concede_next(*anna);
  EXPECT_EQ(table_of(anna->wait_for<protocol::TournamentOver>()),
            (Table{{"carl", 4}, {"anna", 0}, {"bert", 0}}));
}

TEST_F(Entries, TheHostEntersAndWithdrawsAgents) {
  const auto anna = client("anna");
  const auto carl = client("carl");
  create(head + "games_per_match = 1\njoin = \"never\"\n" + anna_and_bert);
  EXPECT_EQ(post("tournaments/none/withdraw", R"({"agent":"anna"})").status, 404);
  EXPECT_EQ(post("tournaments/cup/withdraw", R"({"agent":"dora"})").status, 404);
  EXPECT_EQ(post("tournaments/cup/enter", R"({"agent":"dora"})").status, 404);
  EXPECT_EQ(post("tournaments/cup/enter", R"({"name":"carl"})").status, 400);
  EXPECT_EQ(post("tournaments/cup/enter", R"({"agent":"carl"})").status, 200);
  // Of the file, and has not registered.
  EXPECT_EQ(post("tournaments/cup/withdraw", R"({"agent":"bert"})").status, 200);
  EXPECT_EQ(names(), (tournament::Names{"anna", "carl"}));
  begin();
  static_cast<void>(anna->wait_for<Turn>());
  EXPECT_EQ(post("tournaments/cup/withdraw", R"({"agent":"anna"})").status, 200);
  EXPECT_EQ(table_of(carl->wait_for<protocol::TournamentOver>()),
            (Table{{"carl", 1}, {"anna", 0}}));
}

}  // namespace
}  // namespace poolhall::net_tests::entries_tests
