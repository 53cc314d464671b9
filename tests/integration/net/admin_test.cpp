// The host's calls over HTTP: who may make them, and what they do to tournaments, agents, games.
#include <gtest/gtest.h>

#include <fstream>

#include "admin_fixture.hpp"
#include "protocol/json_node.hpp"
#include "scripted_play.hpp"
#include "server/net/tokens.hpp"
#include "server/web/admin.hpp"
#include "server/web/routes.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::net_tests {
namespace {

using protocol::Received;

// Two agents who come by themselves, one match of two games.
const std::string cup_file =
    "name = \"cup\"\ngames_per_match = 2\nmirrored = \"none\"\nnoise = \"none\"\n"
    "[[entry]]\nagent = \"anna\"\n[[entry]]\nagent = \"bert\"\n";

class AdminCalls : public AdminFixture {
 protected:
  [[nodiscard]] std::string status_of(const std::string& tournament) const {
    return member(http_call(http(), {"GET", "/api/tournaments/" + tournament}).body, "status");
  }
};

TEST_F(AdminCalls, NeedTheTokenInTheHeader) {
  HttpCall call{"POST", "/api/admin/agents", R"({"name":"anna"})"};
  EXPECT_EQ(http_call(http(), call).status, 401);
  call.token = token_ + "x";
  EXPECT_EQ(http_call(http(), call).status, 401);
  call.token.clear();
  call.path += "?token=" + token_;
  EXPECT_EQ(http_call(http(), call).status, 401);
  call.path = "/api/admin/agents";
  call.token = token_;
  EXPECT_EQ(http_call(http(), call).status, 201);
}

TEST_F(AdminCalls, AreNotMadeByOtherSitesPages) {
  HttpCall call{"POST", "/api/admin/agents", R"({"name":"anna"})", token_};
  call.headers = {"Origin: http://evil.example"};
  EXPECT_EQ(http_call(http(), call).status, 403);
  call.headers = {"Origin: null"};
  EXPECT_EQ(http_call(http(), call).status, 403);
  call.headers.clear();
  call.host = "evil.example";
  EXPECT_EQ(http_call(http(), call).status, 421);
  call.host = "127.0.0.1";
  call.headers = {"Origin: http://127.0.0.1"};
  EXPECT_EQ(http_call(http(), call).status, 201);
}

// What a browser says of a page that a reverse proxy with TLS hands on.
TEST_F(AdminCalls, AreMadeByTheServersOwnPageBehindAProxy) {
  HttpCall call{"POST", "/api/admin/agents", R"({"name":"anna"})", token_};
  call.host = "Pool.example.org";
  call.headers = {"Origin: https://Pool.example.org"};
  EXPECT_EQ(http_call(http(), call).status, 201);
  call.headers = {"Origin: https://evil.example"};
  const auto refused = http_call(http(), call);
  EXPECT_EQ(refused.status, 403);
  EXPECT_NE(refused.body.find("https://evil.example"), std::string::npos) << refused.body;
}

TEST_F(AdminCalls, AreRefusedByAServerWithoutAToken) {
  net::ServerOptions options = test_options(directory_ / "other.db");
  options.settings.http = "127.0.0.1:0";
  TestServer other{options};
  const auto answer = http_call(other.server().http_endpoint()->port,
                                {"POST", "/api/admin/agents", R"({"name":"a"})", token_});
  EXPECT_EQ(answer.status, 403);
  EXPECT_EQ(member(answer.body, "code"), "no_admin");
}

TEST_F(AdminCalls, SayWhatIsWrongWithThem) {
  EXPECT_EQ(post("nothing").status, 404);
  EXPECT_EQ(post("tournaments/cup").status, 404);
  EXPECT_EQ(post("tournaments//start").status, 404);
  EXPECT_EQ(post("games/x/void").status, 404);
  EXPECT_EQ(http_call(http(), {"GET", "/api/admin/agents", "", token_}).status, 405);
  const auto no_name = post("agents", "{}");
  EXPECT_EQ(no_name.status, 400);
  EXPECT_NE(member(no_name.body, "reason").find("/name"), std::string::npos) << no_name.body;
  const auto bad_name = post("agents", R"({"name":"an na"})");
  EXPECT_EQ(bad_name.status, 400);
  EXPECT_EQ(member(bad_name.body, "code"), "bad_name");
  const auto bad_file = post("tournaments", "name = \"cup\"\nturns = 3\n");
  EXPECT_EQ(bad_file.status, 400);
  EXPECT_NE(bad_file.body.find("tournament:2:1"), std::string::npos) << bad_file.body;
  EXPECT_EQ(post("tournaments/cup/start").status, 404);
}

TEST_F(AdminCalls, AddAnAgentToAServerThatRegistersNobody) {
  registration_ = "closed";
  start();
  {
    WireClient anna{port()};
    anna.hello();
    EXPECT_EQ(anna.refused(protocol::Register{"anna", {}}).code, "registration_closed");
  }
  const auto added = post("agents", R"({"name":"anna"})");
  ASSERT_EQ(added.status, 201) << added.body;
  EXPECT_EQ(post("agents", R"({"name":"Anna"})").status, 409);
  WireClient anna{port()};
  EXPECT_EQ(anna.login(member(added.body, "token")).agent, "anna");
}

TEST_F(AdminCalls, StartATournamentThatIsPlayedToItsEnd) {
  WireClient anna{port()};
  WireClient bert{port()};
  anna.join("anna");
  bert.join("bert");
  EXPECT_EQ(post("tournaments", cup_file).status, 201);
  EXPECT_EQ(status_of("cup"), "open");
  EXPECT_EQ(post("tournaments", cup_file).status, 201) << "the same again is the same";
  EXPECT_EQ(post("tournaments", cup_file + "[clock]\nincrement_seconds = 1\n").status, 409);
  EXPECT_EQ(post("tournaments/cup/resume").status, 409);
  EXPECT_EQ(post("tournaments/cup/start").status, 200);
  for (int i = 0; i < 2; ++i) {
    const auto game = anna.wait_for<protocol::GameStart<Received>>().terms.game;
    static_cast<void>(anna.call<protocol::GameReply>(protocol::Concede{game}));
  }
  const auto over = bert.wait_for<protocol::TournamentOver>();
  ASSERT_EQ(over.standings.size(), 2U);
  EXPECT_EQ(over.standings[0].agent, "bert");
  EXPECT_EQ(over.standings[0].points, 2);
  EXPECT_EQ(post("tournaments/cup/abort").status, 409);
}

TEST_F(AdminCalls, TakeATournamentAsJsonToo) {
  const auto made = post("tournaments", R"({"name":"cup","games_per_match":2,"mirrored":"none",
      "clock":{"game_seconds":30},"entry":[{"agent":"anna"},{"house":"random"}]})");
  EXPECT_EQ(made.status, 201) << made.body;
  EXPECT_EQ(status_of("cup"), "open");
  EXPECT_EQ(post("tournaments", R"({"name":null})").status, 400);
  EXPECT_EQ(post("tournaments", "{").status, 400);
}

TEST_F(AdminCalls, RefuseATournamentWithABotThatThereIsNot) {
  const auto made =
      post("tournaments", R"({"name":"cup","entry":[{"name":"a","house":"randm"},{"agent":"b"}]})");
  EXPECT_EQ(made.status, 400);
  EXPECT_NE(made.body.find(R"(got house = \"randm\", expected one of random, greedy, planner)"),
            std::string::npos)
      << made.body;
}

TEST_F(AdminCalls, RefuseATournamentThatNeedsMoreHouseBotsThanMayRun) {
  const std::string two = R"({"name":"two","entry":[{"house":"random"},{"house":"greedy"}]})";
  const std::string one = R"({"name":"one","entry":[{"house":"random"},{"agent":"b"}]})";
  const std::string stored = R"({"name":"old","entry":[{"house":"random"},{"house":"greedy"}]})";
  EXPECT_EQ(post("tournaments", stored).status, 201);
  max_house_bots_ = 1;
  start();
  const auto made = post("tournaments", two);
  EXPECT_EQ(made.status, 400);
  EXPECT_EQ(member(made.body, "reason"),
            "tournament: got 2 entries with house or command, a game of theirs needs 2 of this "
            "server's processes, expected max_house_bots >= 2, it is 1");
  EXPECT_EQ(post("tournaments", one).status, 201);
  EXPECT_EQ(post("tournaments/old/start").status, 409);
}

TEST_F(AdminCalls, AreSeenAtOnceByWhoReadsAPage) {
  WireClient anna{port()};
  WireClient bert{port()};
  anna.join("anna");
  bert.join("bert");
  const auto is = [this](const std::string& status) {
    return http_call(http(), {"GET", "/api/tournaments/cup/status.txt"})
        .body.starts_with("Tournament cup: " + status);
  };
  EXPECT_EQ(post("tournaments", cup_file).status, 201);
  EXPECT_TRUE(is("open"));
  EXPECT_EQ(post("tournaments/cup/start").status, 200);
  EXPECT_TRUE(is("running"));
  EXPECT_EQ(post("tournaments/cup/abort").status, 200);
  EXPECT_TRUE(is("aborted"));
}

TEST_F(AdminCalls, HoldATournamentBetweenTwoGamesAcrossARestart) {
  std::string anna_token;
  {
    WireClient anna{port()};
    WireClient bert{port()};
    anna_token = anna.join("anna");
    bert.join("bert");
    EXPECT_EQ(post("tournaments", cup_file).status, 201);
    EXPECT_EQ(post("tournaments/cup/start").status, 200);
    const auto game = anna.wait_for<protocol::GameStart<Received>>().terms.game;
    EXPECT_EQ(post("tournaments/cup/pause").status, 200);
    static_cast<void>(anna.call<protocol::GameReply>(protocol::Concede{game}));
    static_cast<void>(anna.wait_for<protocol::GameOver>());
    static_cast<void>(anna.call<protocol::AckReply>(protocol::Ack{game}));
    EXPECT_EQ(status_of("cup"), "paused");
  }
  start();
  WireClient anna{port()};
  EXPECT_TRUE(anna.login(anna_token).games.empty());
  EXPECT_EQ(anna.kept<protocol::GameStart<Received>>(), 0U);
  EXPECT_EQ(post("tournaments/cup/resume").status, 200);
  const auto game = anna.wait_for<protocol::GameStart<Received>>().terms.game;
  static_cast<void>(anna.call<protocol::GameReply>(protocol::Concede{game}));
  EXPECT_EQ(anna.wait_for<protocol::TournamentOver>().standings.size(), 2U);
}

TEST_F(AdminCalls, GoOnWithARunningTournamentAfterARestart) {
  std::string anna_token;
  {
    WireClient anna{port()};
    WireClient bert{port()};
    anna_token = anna.join("anna");
    bert.join("bert");
    EXPECT_EQ(post("tournaments", cup_file).status, 201);
    EXPECT_EQ(post("tournaments/cup/start").status, 200);
    const auto game = anna.wait_for<protocol::GameStart<Received>>().terms.game;
    static_cast<void>(anna.call<protocol::GameReply>(protocol::Concede{game}));
    static_cast<void>(anna.wait_for<protocol::GameStart<Received>>());
  }
  start();
  WireClient anna{port()};
  anna.login(anna_token);
  const auto game = anna.wait_for<protocol::GameSnapshot<Received>>().terms.game;
  static_cast<void>(anna.call<protocol::GameReply>(protocol::Concede{game}));
  EXPECT_EQ(anna.wait_for<protocol::TournamentOver>().standings.front().points, 2);
}

TEST_F(AdminCalls, AbortATournamentAndItsGames) {
  WireClient anna{port()};
  WireClient bert{port()};
  anna.join("anna");
  bert.join("bert");
  EXPECT_EQ(post("tournaments", cup_file).status, 201);
  EXPECT_EQ(post("tournaments/cup/start").status, 200);
  static_cast<void>(anna.wait_for<Turn>());
  EXPECT_EQ(post("tournaments/cup/abort").status, 200);
  const auto over = anna.wait_for<protocol::GameOver>();
  EXPECT_EQ(over.reason, rules::EndReason::void_game);
  EXPECT_FALSE(over.scored);
  EXPECT_EQ(anna.wait_for<protocol::MatchOver>().own_points, 0);
  EXPECT_EQ(status_of("cup"), "aborted");
  EXPECT_EQ(post("tournaments/cup/start").status, 409);
}

TEST_F(AdminCalls, VoidAGameThatIsThenPlayedAgain) {
  WireClient anna{port()};
  WireClient bert{port()};
  anna.join("anna");
  bert.join("bert");
  const protocol::GameId game = start_game(anna, bert, "bert");
  const auto path = [](protocol::GameId id) {
    return "games/" + std::to_string(protocol::number(id)) + "/void";
  };
  EXPECT_EQ(post(path(game)).status, 202);
  const auto over = bert.wait_for<protocol::GameOver>();
  EXPECT_EQ(over.game, game);
  EXPECT_FALSE(over.scored);
  const auto again = bert.wait_for<protocol::GameStart<Received>>();
  EXPECT_EQ(again.terms.match, over.match);
  EXPECT_NE(again.terms.game, game);
  EXPECT_EQ(post(path(game)).status, 409);
  EXPECT_EQ(post(path(protocol::GameId{999})).status, 404);
}

TEST_F(AdminCalls, VoidAGameWhoseShotIsBeingPlayed) {
  WireClient anna{port()};
  WireClient bert{port()};
  anna.join("anna");
  bert.join("bert");
  const protocol::GameId game = start_game(anna, bert, "bert");
  const auto shot = anna.send(scripted_shot(anna.wait_for<Turn>()));
  EXPECT_EQ(post("games/" + std::to_string(protocol::number(game)) + "/void").status, 202);
  static_cast<void>(anna.answer_to(shot));  // played and stored before the end
  EXPECT_EQ(anna.wait_for<protocol::GameOver>().reason, rules::EndReason::void_game);
}

TEST_F(AdminCalls, AndAllOtherPathsStandInTheOpenApiDocument) {
  const auto document = protocol::parse_json(http_call(http(), {"GET", "/api/openapi.json"}).body,
                                             protocol::document_bounds);
  ASSERT_TRUE(document) << document.error().reason;
  const auto* paths = document->member("paths")->as<protocol::JsonObject>();
  ASSERT_NE(paths, nullptr);
  ASSERT_EQ(paths->size(), web::routes().size());
  for (std::size_t i = 0; i < paths->size(); ++i) {
    const web::Route& route = web::routes()[i];
    EXPECT_EQ((*paths)[i].first, route.path);
    std::string path{route.path};
    for (const char* parameter : {"{tournament}", "{game}", "{turn}"}) {
      if (const auto at = path.find(parameter); at != std::string::npos) {
        path.replace(at, std::string(parameter).size(), "7");
      }
    }
    HttpCall call{std::string{route.method}, path, "", token_};
    const auto answer = http_call(http(), call);
    EXPECT_EQ(answer.body.find("no such path"), std::string::npos) << path;
    EXPECT_NE(answer.status, 405) << path;
    call.method = "DELETE";
    EXPECT_EQ(http_call(http(), call).status, 405) << path;
  }
  for (const char* path : {"/api", "/api/game", "/api/games/7/shots", "/api/admin"}) {
    EXPECT_EQ(http_call(http(), {"GET", path}).status, 404) << path;
  }
}

TEST(AdminToken, IsMadeForItsOwnerAloneIfThereIsNoFile) {
  test_support::TemporaryDirectory directory;
  const auto made = net::token_in(directory / "token");
  ASSERT_TRUE(made);
  EXPECT_TRUE(net::is_token(*made));
  EXPECT_EQ(net::token_in(directory / "token"), made);
  EXPECT_EQ(std::filesystem::status(directory / "token").permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST(AdminToken, IsRefusedIfItIsShort) {
  test_support::TemporaryDirectory directory;
  std::ofstream(directory / "token") << "1234\n";
  EXPECT_NE(net::token_in(directory / "token").error().find("16 to 256"), std::string::npos);
  EXPECT_FALSE(net::token_in(directory / "no-such-directory/token"));
}

TEST(AdminJson, BecomesTheTomlOfAFile) {
  EXPECT_EQ(web::toml_from_json(R"({"name":"a \"b\"","n":1.5,"t":{"x":true},"e":[{"h":"g"}]})"),
            "name = \"a \\\"b\\\"\"\nn = 1.5\nt = {x = true}\ne = [{h = \"g\"}]\n");
  EXPECT_FALSE(web::toml_from_json("[1]"));
  EXPECT_FALSE(web::toml_from_json(R"({"a":null})"));
}

}  // namespace
}  // namespace poolhall::net_tests
