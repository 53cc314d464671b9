// The program is killed (SIGKILL) at each named place of a shot's way through it. What it had told
// is there when it is back, what it had not told is played once, and the game goes on to its end.
#include <gtest/gtest.h>

#include "../../integration/net/scripted_play.hpp"
#include "../../integration/net/server_process.hpp"
#include "server/storage/sqlite_database.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::net_tests {
namespace {

using protocol::Received;
using rules::Seat;

// One agent that survives its server: it logs in again and repeats what was not answered.
struct Survivor {
  std::string token;
  std::unique_ptr<WireClient> wire;
  std::optional<protocol::Request> unanswered{};

  void connect(std::uint16_t port) {
    wire = std::make_unique<WireClient>(port);
    wire->login(token);
  }
};

struct Told {
  std::uint32_t turn = 0;
  protocol::ShotParams executed;
};

class Table {
 public:
  explicit Table(const std::string& failpoint) : failpoint_(failpoint) {}

  // Plays `turns` turns, whatever happens to the server; everything that was told.
  void play(std::uint32_t turns) {
    start(failpoint_);
    std::uint32_t played = 0;
    while (played < turns && !over_) {
      try {
        played = play_one();
      } catch (const std::runtime_error&) {
        ASSERT_EQ(server_->wait(), -1) << "the server ended, but not by the kill";
        ++kills_;
        restart();
      }
    }
  }
  // Ends the game and gives the database's rows.
  std::vector<storage::TurnRecord> rows() {
    if (!over_) {
      static_cast<void>(agents_[0].wire->call<protocol::GameReply>(protocol::Concede{game_}));
      static_cast<void>(agents_[1].wire->wait_for<protocol::GameOver>());
    }
    EXPECT_EQ(server_->terminate(), 0);
    std::vector<storage::TurnRecord> rows;
    auto reader = storage::open_sqlite_reader(directory_ / "server.db").value();
    EXPECT_TRUE(reader->each_turn(game_, [&rows](const storage::TurnRecord& row) {
      rows.push_back(row);
      return true;
    }));
    return rows;
  }
  [[nodiscard]] const std::vector<Told>& told() const { return told_; }
  [[nodiscard]] int kills() const { return kills_; }

 private:
  void start(const std::string& failpoint) {
    // Registration and match are stored first, in the same server that will be killed later.
    server_ = std::make_unique<ServerProcess>(
        directory_.path(), std::vector<std::string>{},
        std::vector<std::string>{"POOLHALL_FAILPOINT=" + failpoint});
    for (std::size_t i = 0; i < 2; ++i) {
      agents_[i].wire = std::make_unique<WireClient>(server_->port());
      agents_[i].token = agents_[i].wire->join(i == 0 ? "anna" : "bert");
    }
    game_ = start_game(*agents_[0].wire, *agents_[1].wire, "bert");
  }

  void restart() {
    server_ = std::make_unique<ServerProcess>(directory_.path());
    for (Survivor& agent : agents_) {
      agent.connect(server_->port());
    }
    for (Survivor& agent : agents_) {
      if (agent.unanswered) {
        finish(agent, agent.wire->answer_to(agent.wire->send(*agent.unanswered)));
      }
    }
  }

  // The next turn of whoever is to move; its number.
  std::uint32_t play_one() {
    Survivor& mover = agents_[rules::index(to_move_)];
    const Turn turn = mover.wire->wait_for<Turn>();
    if (turn.turn <= last_turn_) {
      return last_turn_;  // pushed again by the login, and answered since
    }
    mover.unanswered = scripted_answer(turn);
    finish(mover, mover.wire->answer_to(mover.wire->send(*mover.unanswered)));
    return last_turn_;
  }

  void finish(Survivor& agent,
              const std::variant<protocol::ReplyMessage, protocol::ErrorMessage>& answer) {
    agent.unanswered.reset();
    const auto* reply = std::get_if<protocol::ReplyMessage>(&answer);
    ASSERT_NE(reply, nullptr) << std::get<protocol::ErrorMessage>(answer).error.reason;
    rules::GameState after;
    if (const auto* shot = std::get_if<protocol::ShotReply<Received>>(&reply->reply)) {
      told_.push_back({shot->shot.turn, shot->shot.executed});
      last_turn_ = shot->shot.turn;
      after = shot->shot.state;
    } else {
      const auto& decision = std::get<protocol::DecideReply<Received>>(reply->reply).decision;
      last_turn_ = decision.turn;
      after = decision.state;
    }
    to_move_ = after.to_move;
    over_ = after.result.has_value();
  }

  std::string failpoint_;
  test_support::TemporaryDirectory directory_;
  std::unique_ptr<ServerProcess> server_;
  std::array<Survivor, 2> agents_;
  protocol::GameId game_{};
  Seat to_move_ = Seat::first;
  std::uint32_t last_turn_ = 0;
  bool over_ = false;
  int kills_ = 0;
  std::vector<Told> told_;
};

class KilledAt : public ::testing::TestWithParam<const char*> {};

TEST_P(KilledAt, EveryShotIsPlayedOnceAndNoneThatWasToldIsLost) {
  Table table{GetParam()};
  table.play(8);
  const auto rows = table.rows();
  EXPECT_EQ(table.kills(), 1);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].number, i + 1);
  }
  for (const Told& told : table.told()) {
    ASSERT_LE(told.turn, rows.size());
    ASSERT_TRUE(rows[told.turn - 1].shot);
    EXPECT_EQ(rows[told.turn - 1].shot->executed, told.executed);
  }
}

INSTANTIATE_TEST_SUITE_P(Failpoints, KilledAt,
                         ::testing::Values("after_receive:3", "after_simulate:3", "before_commit:6",
                                           "after_commit:6", "before_send:3"));

}  // namespace
}  // namespace poolhall::net_tests
