// The database in trouble while games go on: they stand, nothing is lost, no clock runs, and all
// goes on when it is over.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>
#include <iterator>

#include "../../integration/net/http_client.hpp"
#include "../../integration/net/scripted_play.hpp"
#include "../../integration/net/server_process.hpp"
#include "../../integration/net/test_server.hpp"
#include "server/storage/sqlite_database.hpp"
#include "tests/support/raw_sqlite.hpp"
#include "tests/support/temporary_directory.hpp"
#include "weak_disk.hpp"

namespace poolhall::net_tests {
namespace {

using protocol::Received;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

net::ServerOptions options_with_page(const std::filesystem::path& database) {
  net::ServerOptions options = test_options(database);
  options.settings.http = "127.0.0.1:0";
  options.settings.limits.messages_per_second = 1e6;  // tests ask often
  options.settings.limits.message_burst = 1e6;
  return options;
}

class Trouble : public ::testing::Test {
 protected:
  [[nodiscard]] int health() {
    return http_call(server_.server().http_endpoint()->port, {"GET", "/healthz"}).status;
  }
  // Anna's shot is on its way to the database, which takes nothing.
  std::int64_t shoot_into_trouble() {
    const auto id = anna_.send(scripted_shot(anna_.wait_for<Turn>()));
    while (health() != 503) {
    }
    return id;
  }
  void expect_answered(std::int64_t id) {
    const auto answer = anna_.answer_to(id);
    const auto* reply = std::get_if<protocol::ReplyMessage>(&answer);
    ASSERT_NE(reply, nullptr);
    const auto& shot = std::get<protocol::ShotReply<Received>>(reply->reply);
    EXPECT_EQ(shot.repetition, protocol::Repetition::first_time);
    auto reader = storage::open_sqlite_reader(directory_ / "test.db").value();
    EXPECT_EQ(reader->turn(shot.shot.game, 1).value()->shot->executed, shot.shot.executed);
  }

  test_support::TemporaryDirectory directory_;
  WeakDisk disk_;
  TestServer server_{options_with_page(directory_ / "test.db")};
  WireClient anna_{server_.port()};
  WireClient bert_{server_.port()};
};

TEST_F(Trouble, OfALockedFileIsWaitedOut) {
  anna_.join("anna");
  bert_.join("bert");
  static_cast<void>(start_game(anna_, bert_, "bert"));
  EXPECT_EQ(health(), 200);
  test_support::RawSqlite other{directory_ / "test.db"};
  other.run("BEGIN IMMEDIATE");
  const auto shot = shoot_into_trouble();
  static_cast<void>(anna_.call<protocol::PingReply>(protocol::Ping{}));
  other.run("ROLLBACK");
  expect_answered(shot);
  EXPECT_EQ(health(), 200);
  EXPECT_GT(bert_.wait_for<protocol::GameShot<Received>>().events.size(), 1U);
}

// Who comes meanwhile was not too slow: the server was.
TEST_F(Trouble, OfALockedFileIsToldToWhoLogsIn) {
  anna_.join("anna");
  bert_.join("bert");
  static_cast<void>(start_game(anna_, bert_, "bert"));
  test_support::RawSqlite other{directory_ / "test.db"};
  other.run("BEGIN IMMEDIATE");
  const auto shot = shoot_into_trouble();
  WireClient carl{server_.port()};
  carl.hello();
  static_cast<void>(carl.send(protocol::Register{"carl", {}}));
  std::string last;
  while (const auto message = carl.next_message()) {
    if (const auto* error = std::get_if<protocol::ErrorMessage>(&*message)) {
      last = error->code;
    }
  }
  EXPECT_EQ(last, "paused");
  other.run("ROLLBACK");
  expect_answered(shot);
}

class TroubleOf : public Trouble, public ::testing::WithParamInterface<int> {};

TEST_P(TroubleOf, TheDiskPausesGamesAndChargesNobody) {
  WireClient carl{server_.port()};
  WireClient dora{server_.port()};
  anna_.join("anna");
  bert_.join("bert");
  carl.join("carl");
  dora.join("dora");
  static_cast<void>(start_game(anna_, bert_, "bert"));
  const milliseconds time{1'000};
  const protocol::GameId thinking = start_game(carl, dora, "dora", {.game_ms = time.count()});
  const Turn turn = carl.wait_for<Turn>();

  disk_.fail_with(GetParam());
  const auto shot = shoot_into_trouble();
  const auto before = carl.call<protocol::SyncReply<Received>>(protocol::Sync{thinking});
  EXPECT_FALSE(before.snapshot.clocks.deadline_ms);
  for (const auto until = steady_clock::now() + time * 3 / 2; steady_clock::now() < until;) {
    static_cast<void>(dora.call<protocol::PingReply>(protocol::Ping{}));
    static_cast<void>(health());
  }
  EXPECT_EQ(carl.kept<protocol::GameOver>(), 0U);
  const auto after = carl.call<protocol::SyncReply<Received>>(protocol::Sync{thinking});
  EXPECT_EQ(after.snapshot.clocks.own_ms, before.snapshot.clocks.own_ms);
  disk_.work();

  expect_answered(shot);
  static_cast<void>(carl.call<protocol::ShotReply<Received>>(scripted_shot(turn)));
  EXPECT_EQ(health(), 200);
}

TEST_P(TroubleOf, TheDiskDoesNotStopARequestThatComesMeanwhile) {
  anna_.join("anna");
  bert_.join("bert");
  const protocol::GameId game = start_game(anna_, bert_, "bert");
  disk_.fail_with(GetParam());
  const auto shot = shoot_into_trouble();
  WireClient carl{server_.port()};
  carl.hello();
  const auto registration = carl.send(protocol::Register{"carl", {}});
  const auto concession = bert_.send(protocol::Concede{game});
  disk_.work();
  expect_answered(shot);
  EXPECT_TRUE(std::holds_alternative<protocol::ReplyMessage>(bert_.answer_to(concession)));
  EXPECT_TRUE(std::holds_alternative<protocol::ReplyMessage>(carl.answer_to(registration)));
}

INSTANTIATE_TEST_SUITE_P(Disk, TroubleOf,
                         ::testing::Values(SQLITE_FULL, SQLITE_IOERR_WRITE, SQLITE_CORRUPT));

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

void limit_files(pid_t process, rlim_t bytes) {
  rlimit limit{};
  prlimit(process, RLIMIT_FSIZE, nullptr, &limit);
  limit.rlim_cur = bytes;
  prlimit(process, RLIMIT_FSIZE, &limit, nullptr);
}

TEST(TroubleOfTheProgram, ThatMayWriteNoMoreIsLoggedAndOver) {
  test_support::TemporaryDirectory directory;
  ServerProcess server{directory.path()};
  WireClient anna{server.port()};
  WireClient bert{server.port()};
  anna.join("anna");
  bert.join("bert");
  static_cast<void>(start_game(anna, bert, "bert"));
  const Turn turn = anna.wait_for<Turn>();
  limit_files(server.pid(), std::filesystem::file_size(directory / "server.db-wal"));
  const auto shot = anna.send(scripted_shot(turn));
  const std::filesystem::path log = directory / "server.log";
  while (text_of(log).find("the database takes nothing, games stand") == std::string::npos) {
  }
  limit_files(server.pid(), RLIM_INFINITY);
  EXPECT_TRUE(std::holds_alternative<protocol::ReplyMessage>(anna.answer_to(shot)));
  EXPECT_EQ(server.terminate(), 0);
  EXPECT_NE(text_of(log).find("the database works again"), std::string::npos);
}

}  // namespace
}  // namespace poolhall::net_tests
