// What nobody may see before its time: keys until their match is over, a hidden level until the
// tournament is. Everything that leaves the server is searched: both players' lines, the web's
// pages, an export, the log.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <future>
#include <sstream>

#include "protocol/json_writer.hpp"
#include "scripted_play.hpp"
#include "server/match/chain.hpp"
#include "server/match/export_lines.hpp"
#include "server/match/fair_noise.hpp"
#include "server/match/sha256.hpp"
#include "server/match/verify.hpp"
#include "server/storage/sqlite_database.hpp"
#include "test_server.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::net_tests {
namespace {

using protocol::GameId;
using protocol::GameReply;
using protocol::Received;
using testing::HasSubstr;
using testing::Not;

constexpr const char* hidden_cup = "cup";

// Everything that spdlog says while this is there.
class CapturedLog {
 public:
  CapturedLog() : before_(spdlog::default_logger()) {
    auto logger = std::make_shared<spdlog::logger>(
        "captured", std::make_shared<spdlog::sinks::ostream_sink_mt>(text_));
    logger->set_level(spdlog::level::trace);
    spdlog::set_default_logger(logger);
  }
  ~CapturedLog() { spdlog::set_default_logger(before_); }
  CapturedLog(const CapturedLog&) = delete;
  CapturedLog& operator=(const CapturedLog&) = delete;

  [[nodiscard]] std::string text() {
    spdlog::default_logger()->flush();
    return text_.str();
  }

 private:
  std::ostringstream text_;
  std::shared_ptr<spdlog::logger> before_;
};

std::string get(std::uint16_t port, const std::string& path) {
  WireClient client{port};
  client.send_bytes("GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
                    "\r\nConnection: close\r\n\r\n");
  std::string text;
  while (const auto line = client.read_line())
    text += *line + "\n";
  return text + client.rest();
}

std::string exported(const std::filesystem::path& file) {
  auto reader = storage::open_sqlite_reader(file).value();
  std::string text;
  const auto done =
      match::export_lines(*reader, {}, [&](const std::string& line) { text += line; });
  EXPECT_TRUE(done);
  return text;
}

std::string as_json(double value) {
  protocol::JsonWriter out;
  return std::move(out.number(value)).text();
}

class Secrets : public ::testing::Test {
 protected:
  Secrets() {
    anna_.join("anna");
    bert_.join("bert");
  }

  static net::ServerOptions options(const std::filesystem::path& file) {
    net::ServerOptions options = test_options(file);
    options.settings.http = "127.0.0.1:0";
    return options;
  }

  // A match between the two under a hidden level that is drawn for each game.
  void start_match(std::uint32_t games, storage::Mirror mirrored) {
    server_.server().post([=](net::MatchHost& host) {
      static_cast<void>(host.open_tournament(
          {hidden_cup, "The cup", "noise = \"variable\"", net::TournamentStatus::running}));
      for (const char* name : {"anna", "bert"})
        host.enter({.tournament = hidden_cup, .name = name});
      net::MatchOrder order;
      order.tournament = hidden_cup;
      order.agents = {"anna", "bert"};
      order.games = games;
      order.terms.noise = "variable";
      order.terms.noise_hidden = true;
      order.mirrored = mirrored;
      host.start_match(order);
    });
  }

  void finish_tournament() {
    std::promise<void> done;
    server_.server().post([&](net::MatchHost& host) {
      host.set_status(hidden_cup, net::TournamentStatus::finished);
      done.set_value();
    });
    done.get_future().wait();
  }

  [[nodiscard]] std::vector<storage::GameRecord> games() const {
    auto reader = storage::open_sqlite_reader(file_).value();
    return reader->games_of(protocol::MatchId{1}).value();
  }

  // All that has left the server by now.
  [[nodiscard]] std::string everything() {
    const std::uint16_t port = server_.server().http_endpoint()->port;
    std::string text = anna_.heard() + bert_.heard() + exported(file_) + log_.text();
    for (const char* path : {"/api/tournaments", "/api/tournaments/cup", "/api/games/1",
                             "/api/games/2", "/api/games/1/shots/1", "/api/games/2/shots/1",
                             "/api/agents", "/api/live", "/metrics", "/healthz"})
      text += get(port, path);
    return text;
  }

  CapturedLog log_;
  test_support::TemporaryDirectory directory_;
  std::filesystem::path file_ = directory_ / "test.db";
  TestServer server_{options(file_)};
  WireClient anna_{server_.port()};
  WireClient bert_{server_.port()};
};

TEST_F(Secrets, AreNowhereBeforeTheirTime) {
  const std::string secret(64, 'c');
  const std::string own = match::to_hex(match::digest_of(secret));
  static_cast<void>(anna_.call<protocol::EmptyReply>(
      protocol::GameReady{{match::to_hex(match::sha256(match::digest_of(secret)))}}));
  start_match(2, storage::Mirror::none);
  const auto first = anna_.wait_for<protocol::GameStart<Received>>();
  EXPECT_FALSE(first.terms.noise);
  static_cast<void>(anna_.call<GameReply>(protocol::GameReveal{first.terms.game, {secret}}));
  static_cast<void>(
      anna_.call<protocol::ShotReply<Received>>(scripted_shot(anna_.wait_for<Turn>())));
  static_cast<void>(anna_.call<GameReply>(protocol::Concede{first.terms.game}));
  const auto second = bert_.wait_for<protocol::GameOver>();
  EXPECT_EQ(second.game, first.terms.game);
  static_cast<void>(
      bert_.call<protocol::ShotReply<Received>>(scripted_shot(bert_.wait_for<Turn>())));

  const auto records = games();
  ASSERT_EQ(records.size(), 2U);
  const std::string seen = everything();
  for (const storage::GameRecord& game : records) {
    EXPECT_THAT(seen, HasSubstr(match::to_hex(game.commitment)));
    EXPECT_THAT(seen, Not(HasSubstr(match::to_hex(game.key))));
    EXPECT_THAT(seen, Not(HasSubstr(std::string(game.key.begin(), game.key.end()))));
    EXPECT_THAT(seen, Not(HasSubstr(as_json(game.noise.a))));
    EXPECT_THAT(seen, Not(HasSubstr(as_json(game.noise.v))));
  }
  EXPECT_THAT(seen, Not(HasSubstr(own)));
  EXPECT_THAT(seen, Not(HasSubstr("variable")));

  static_cast<void>(anna_.call<GameReply>(protocol::Concede{records[1].id}));
  const auto over = anna_.wait_for<protocol::MatchOver>();
  EXPECT_EQ(over.seeds[0].key.text, match::to_hex(records[0].key));
  EXPECT_EQ(over.seeds[0].agent_secrets[0]->text, own);
  const std::string after_the_match = everything();
  EXPECT_THAT(after_the_match, HasSubstr(match::to_hex(records[1].key)));
  for (const storage::GameRecord& game : records)
    EXPECT_THAT(after_the_match, Not(HasSubstr(as_json(game.noise.a))));
  EXPECT_THAT(after_the_match, Not(HasSubstr("variable")));

  finish_tournament();
  EXPECT_EQ(server_.stop(), 0);
  EXPECT_THAT(exported(file_), HasSubstr(as_json(records[0].noise.a)));
}

// Both games at once; the second shot of the two that were asked for has the first one's noise.
TEST_F(Secrets, AreSharedByTheGamesOfAMirroredPair) {
  start_match(2, storage::Mirror::noise);
  const auto start = anna_.wait_for<protocol::GameStart<Received>>();
  const Turn annas = anna_.wait_for<Turn>();
  const Turn berts = bert_.wait_for<Turn>();
  ASSERT_NE(annas.game, berts.game);
  const auto one = anna_.send(scripted_shot(annas));
  const auto other = bert_.send(scripted_shot(berts));
  for (auto* answer : {&one, &other}) {
    WireClient& client = answer == &one ? anna_ : bert_;
    EXPECT_TRUE(std::holds_alternative<protocol::ReplyMessage>(client.answer_to(*answer)));
  }
  for (const GameId game : {annas.game, berts.game})
    static_cast<void>(anna_.call<GameReply>(protocol::Concede{game}));
  static_cast<void>(anna_.wait_for<protocol::MatchOver>());
  EXPECT_EQ(server_.stop(), 0);

  auto reader = storage::open_sqlite_reader(file_).value();
  const auto report = match::verify(*reader, {}).value();
  EXPECT_TRUE(report.same()) << (report.differences.empty() ? "" : report.differences[0].reason);
  const auto records = games();
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(records[0].initial_state, records[1].initial_state);
  EXPECT_NE(records[0].key, records[1].key);
  const auto deviates = match::shot_deviates(
      records[0].key, {records[0].id, rules::Seat::first, 1, match::Stream::shared});
  for (const storage::GameRecord& game : records) {
    EXPECT_EQ(game.shared_from, records[0].id);
    const auto turn = reader->turn(game.id, 1).value().value();
    EXPECT_TRUE(turn.shot->shared);
    EXPECT_NEAR(turn.shot->executed.phi, turn.shot->intended.phi + game.noise.phi * deviates[3],
                1e-9);
  }
  EXPECT_EQ(start.terms.commitment.text, match::to_hex(records[0].commitment));
}

}  // namespace
}  // namespace poolhall::net_tests
