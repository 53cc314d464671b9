#include "server/storage/writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <mutex>

#include "sample_records.hpp"
#include "server/storage/failpoint.hpp"
#include "server/storage/sqlite_database.hpp"
#include "tests/support/raw_sqlite.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::storage {
namespace {

using test_support::TemporaryDirectory;
using testing::ElementsAre;

class WriterTest : public testing::Test {
 protected:
  WriterTest() {
    auto database = open_sqlite(directory_ / "test.db").value();
    add_samples(*database);
    database_ = std::move(database);
  }
  ~WriterTest() override { set_failpoint_handler({}); }

  void start(WriterOptions options = {}) {
    writer_ = std::make_unique<Writer>(std::move(database_), std::move(options));
  }

  Writer::Work turn(std::uint32_t number) {
    return [number](Database& database) { return database.append_turn(sample_turn(1, number)); };
  }

  // Keeps the writer's thread busy until the returned promise is kept.
  std::shared_ptr<std::promise<void>> hold() {
    auto gate = std::make_shared<std::promise<void>>();
    auto begun = std::make_shared<std::promise<void>>();
    auto opened = gate->get_future().share();
    EXPECT_EQ(
        writer_->post(
            [begun, opened, first = std::make_shared<bool>(true)](Database&) -> Expected<void> {
              if (*first)
                begun->set_value();
              *first = false;
              opened.wait();
              return {};
            },
            [](const Expected<void>&) {}),
        Posted::accepted);
    begun->get_future().wait();
    return gate;
  }

  TemporaryDirectory directory_;
  std::unique_ptr<Database> database_;
  std::unique_ptr<Writer> writer_;
};

TEST_F(WriterTest, tells_only_what_another_connection_can_read) {
  start();
  auto reader = open_sqlite_reader(directory_ / "test.db").value();
  for (std::uint32_t number = 1; number <= 20; ++number) {
    std::promise<bool> readable;
    ASSERT_EQ(writer_->post(turn(number),
                            [&](const Expected<void>& stored) {
                              readable.set_value(
                                  stored && reader->turn(GameId{1}, number).value().has_value());
                            }),
              Posted::accepted);
    EXPECT_TRUE(readable.get_future().get()) << number;
  }
}

TEST_F(WriterTest, writes_what_waits_in_one_commit_and_tells_it_in_order) {
  start();
  auto gate = hold();
  std::vector<std::uint32_t> told;
  for (std::uint32_t number = 1; number <= 50; ++number) {
    ASSERT_EQ(writer_->post(turn(number),
                            [&told, number](const Expected<void>& stored) {
                              if (stored)
                                told.push_back(number);
                            }),
              Posted::accepted);
  }
  gate->set_value();
  writer_->flush();
  ASSERT_EQ(told.size(), 50U);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(writer_->statistics().commits, 2U);
  EXPECT_EQ(writer_->statistics().largest_group, 50U);
}

TEST_F(WriterTest, waits_for_others_where_several_came_together_but_not_when_it_is_stopped) {
  start({.between_commits = std::chrono::hours(1)});
  const auto gate = hold();
  EXPECT_EQ(writer_->post(turn(1), {}), Posted::accepted);
  EXPECT_EQ(writer_->post(turn(2), {}), Posted::accepted);
  gate->set_value();
  writer_->flush();
  bool stored = false;
  EXPECT_EQ(writer_->post(turn(3), [&](const Expected<void>& done) { stored = done.has_value(); }),
            Posted::accepted);
  EXPECT_EQ(writer_->statistics().waiting, 1);
  writer_->stop();
  EXPECT_TRUE(stored);
  EXPECT_EQ(writer_->statistics().commits, 3);
}

TEST_F(WriterTest, tells_a_conflict_to_its_author_and_stores_the_rest) {
  start();
  auto gate = hold();
  std::vector<std::string> told;
  const auto note = [&](const Expected<void>& stored) {
    told.emplace_back(stored ? "stored" : name(stored.error().fault));
  };
  for (const std::uint32_t number : {1, 2, 1, 3})
    ASSERT_EQ(writer_->post(turn(number), note), Posted::accepted);
  gate->set_value();
  writer_->flush();
  EXPECT_THAT(told, ElementsAre("stored", "stored", "conflict", "stored"));
  auto reader = open_sqlite_reader(directory_ / "test.db").value();
  EXPECT_TRUE(reader->turn(GameId{1}, 3).value().has_value());
}

TEST_F(WriterTest, takes_no_more_than_its_bound) {
  start({.queue_bound = 3});
  auto gate = hold();
  EXPECT_EQ(writer_->post(turn(1), {}), Posted::accepted);
  EXPECT_EQ(writer_->post(turn(2), {}), Posted::accepted);
  EXPECT_EQ(writer_->post(turn(3), {}), Posted::full);
  gate->set_value();
  writer_->flush();
  EXPECT_EQ(writer_->post(turn(3), {}), Posted::accepted);
}

TEST_F(WriterTest, writes_what_it_has_when_it_is_stopped) {
  start();
  auto gate = hold();
  std::atomic<int> stored{0};
  for (std::uint32_t number = 1; number <= 10; ++number)
    ASSERT_EQ(writer_->post(turn(number), [&](const Expected<void>& ok) { stored += ok ? 1 : 0; }),
              Posted::accepted);
  gate->set_value();
  writer_->stop();
  EXPECT_EQ(stored, 10);
  EXPECT_EQ(writer_->post(turn(11), {}), Posted::stopping);
}

// Another program holds SQLite's write lock for a while.
TEST_F(WriterTest, says_that_the_file_is_held_and_stores_everything_when_it_is_free) {
  std::mutex mutex;
  std::vector<std::string> health;
  std::promise<void> trouble;
  start({.on_health =
             [&](const WriterHealth& now) {
               const std::lock_guard lock(mutex);
               health.emplace_back(now.trouble ? name(now.trouble->fault) : "writing");
               if (now.trouble)
                 trouble.set_value();
             },
         .retry_first = std::chrono::milliseconds(1)});
  test_support::RawSqlite other(directory_ / "test.db");
  other.run("BEGIN IMMEDIATE");

  std::promise<bool> stored;
  ASSERT_EQ(writer_->post(turn(1),
                          [&](const Expected<void>& done) { stored.set_value(done.has_value()); }),
            Posted::accepted);
  trouble.get_future().wait();
  other.run("ROLLBACK");
  EXPECT_TRUE(stored.get_future().get());
  writer_->flush();
  const std::lock_guard lock(mutex);
  EXPECT_THAT(health, ElementsAre("busy", "writing"));
}

// Fails with a full disk until `free`; otherwise another database's work.
class FullDisk final : public Database {
 public:
  FullDisk(std::unique_ptr<Database> database, std::atomic<bool>& free)
      : database_(std::move(database)), free_(free) {}

  Expected<void> commit() override {
    if (free_)
      return database_->commit();
    return tl::unexpected(StorageError{StorageFault::disk_full, "the disk is full"});
  }
  Expected<void> begin() override { return database_->begin(); }
  void rollback() override { database_->rollback(); }
  Expected<void> append_turn(const TurnRecord& turn) override {
    return database_->append_turn(turn);
  }

  Expected<Counters> counters() override { return database_->counters(); }
  Expected<std::vector<AgentRecord>> agents() override { return database_->agents(); }
  Expected<std::optional<AgentRecord>> agent(AgentId id) override { return database_->agent(id); }
  Expected<std::optional<AgentRecord>> agent_named(std::string_view name) override {
    return database_->agent_named(name);
  }
  Expected<std::optional<AgentRecord>> agent_with_token(const Digest& hash) override {
    return database_->agent_with_token(hash);
  }
  Expected<std::vector<TournamentRecord>> tournaments() override {
    return database_->tournaments();
  }
  Expected<std::vector<EntryRecord>> entries(std::string_view id) override {
    return database_->entries(id);
  }
  Expected<std::optional<MatchRecord>> match(MatchId id) override { return database_->match(id); }
  Expected<std::vector<MatchRecord>> matches_of(std::string_view id) override {
    return database_->matches_of(id);
  }
  Expected<std::vector<MatchRecord>> unfinished_matches() override {
    return database_->unfinished_matches();
  }
  Expected<std::optional<GameRecord>> game(GameId id) override { return database_->game(id); }
  Expected<std::vector<GameRecord>> games_of(MatchId id) override {
    return database_->games_of(id);
  }
  Expected<std::optional<MatchRecord>> match_requested(std::string_view request) override {
    return database_->match_requested(request);
  }
  Expected<std::vector<GameRecord>> unacknowledged_by(AgentId id, std::size_t most) override {
    return database_->unacknowledged_by(id, most);
  }
  Expected<std::vector<MatchRecord>> untold_matches(AgentId id, std::size_t most) override {
    return database_->untold_matches(id, most);
  }
  Expected<std::vector<TournamentRecord>> untold_tournaments(AgentId id,
                                                             std::size_t most) override {
    return database_->untold_tournaments(id, most);
  }
  Expected<std::vector<FinalStanding>> final_standings(std::string_view id) override {
    return database_->final_standings(id);
  }
  Expected<std::vector<UnfinishedGame>> unfinished_games() override {
    return database_->unfinished_games();
  }
  Expected<std::vector<ResultRecord>> results() override { return database_->results(); }
  Expected<std::vector<GameId>> game_ids() override { return database_->game_ids(); }
  Expected<std::optional<TurnRecord>> turn(GameId game, std::uint32_t number) override {
    return database_->turn(game, number);
  }
  Expected<void> each_turn(GameId game,
                           const std::function<bool(const TurnRecord&)>& visit) override {
    return database_->each_turn(game, visit);
  }
  Expected<void> consistently(const std::function<void()>& read) override {
    return database_->consistently(read);
  }
  Expected<std::vector<std::string>> check_structure() override {
    return database_->check_structure();
  }
  Expected<void> add_agent(const AgentRecord& agent) override {
    return database_->add_agent(agent);
  }
  Expected<void> add_tournament(const TournamentRecord& tournament) override {
    return database_->add_tournament(tournament);
  }
  Expected<void> set_tournament_status(std::string_view id, TournamentStatus status) override {
    return database_->set_tournament_status(id, status);
  }
  Expected<void> add_entry(const EntryRecord& entry) override {
    return database_->add_entry(entry);
  }
  Expected<void> update_entry(const EntryRecord& entry) override {
    return database_->update_entry(entry);
  }
  Expected<void> add_match(const MatchRecord& match) override {
    return database_->add_match(match);
  }
  Expected<void> update_match(const MatchRecord& match) override {
    return database_->update_match(match);
  }
  Expected<void> finish_tournament(std::string_view id,
                                   const std::vector<FinalStanding>& standings) override {
    return database_->finish_tournament(id, standings);
  }
  Expected<void> acknowledge_match(MatchId id, AgentId agent) override {
    return database_->acknowledge_match(id, agent);
  }
  Expected<void> acknowledge_tournament(std::string_view id, AgentId agent) override {
    return database_->acknowledge_tournament(id, agent);
  }
  Expected<void> set_agent_token(AgentId id, const Digest& token_hash) override {
    return database_->set_agent_token(id, token_hash);
  }
  Expected<void> add_game(const GameRecord& game) override { return database_->add_game(game); }
  Expected<void> update_game(const GameRecord& game) override {
    return database_->update_game(game);
  }

 private:
  std::unique_ptr<Database> database_;
  std::atomic<bool>& free_;
};

TEST_F(WriterTest, loses_nothing_while_the_disk_is_full) {
  std::atomic<bool> free{false};
  std::promise<void> full;
  std::atomic<int> troubles{0};
  database_ = std::make_unique<FullDisk>(std::move(database_), free);
  start({.on_health =
             [&](const WriterHealth& health) {
               if (health.trouble && ++troubles == 1)
                 full.set_value();
             },
         .retry_first = std::chrono::milliseconds(1)});
  std::vector<std::uint32_t> told;
  const auto post = [&](std::uint32_t number) {
    ASSERT_EQ(writer_->post(turn(number),
                            [&told, number](const Expected<void>& stored) {
                              ASSERT_TRUE(stored);
                              told.push_back(number);
                            }),
              Posted::accepted);
  };
  post(1);
  full.get_future().wait();
  post(2);
  post(3);
  free = true;
  writer_->flush();
  EXPECT_THAT(told, ElementsAre(1, 2, 3));
  EXPECT_EQ(troubles, 1);
}

TEST_F(WriterTest, stops_out_of_patience_and_tells_the_trouble) {
  std::atomic<bool> free{false};
  database_ = std::make_unique<FullDisk>(std::move(database_), free);
  start({.retry_first = std::chrono::milliseconds(1), .patience = std::chrono::milliseconds(20)});
  std::vector<std::string> told;
  ASSERT_EQ(writer_->post(turn(1),
                          [&](const Expected<void>& stored) {
                            told.emplace_back(stored ? "stored" : name(stored.error().fault));
                          }),
            Posted::accepted);
  writer_->stop();
  EXPECT_THAT(told, ElementsAre("disk_full"));
}

TEST_F(WriterTest, passes_the_failpoints_around_each_commit) {
  std::mutex mutex;
  std::vector<std::string> passed;
  set_failpoint_handler([&](Failpoint place) {
    const std::lock_guard lock(mutex);
    passed.emplace_back(name(place));
  });
  start();
  ASSERT_EQ(writer_->post(turn(1),
                          [&](const Expected<void>&) {
                            const std::lock_guard lock(mutex);
                            passed.emplace_back("told");
                          }),
            Posted::accepted);
  writer_->flush();
  const std::lock_guard lock(mutex);
  EXPECT_THAT(passed, ElementsAre("before_commit", "after_commit", "told"));
}

}  // namespace
}  // namespace poolhall::storage
