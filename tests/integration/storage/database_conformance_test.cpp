// What every implementation of storage::Database has to do. Another one is added to the
// instantiation at the end.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "sample_records.hpp"
#include "server/storage/sqlite_database.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::storage {
namespace {

using test_support::TemporaryDirectory;
using testing::ElementsAre;
using testing::IsEmpty;

struct Implementation {
  std::string name;
  std::function<Expected<std::unique_ptr<Database>>(const std::filesystem::path&)> open;
};

class DatabaseConformance : public testing::TestWithParam<Implementation> {
 protected:
  void SetUp() override {
    reopen();
    add_samples(*database_);
  }

  void reopen() {
    database_.reset();
    auto opened = GetParam().open(directory_ / "test.db");
    ASSERT_TRUE(opened) << opened.error().reason;
    database_ = std::move(*opened);
  }

  void in_transaction(const std::function<Expected<void>()>& work) {
    ASSERT_TRUE(database_->begin());
    const auto done = work();
    ASSERT_TRUE(done) << done.error().reason;
    ASSERT_TRUE(database_->commit());
  }

  StorageFault fault_in_transaction(const std::function<Expected<void>()>& work) {
    EXPECT_TRUE(database_->begin());
    const auto done = work();
    database_->rollback();
    EXPECT_FALSE(done);
    return done ? StorageFault::internal : done.error().fault;
  }

  TemporaryDirectory directory_;
  std::unique_ptr<Database> database_;
};

TEST_P(DatabaseConformance, gives_back_what_was_added_after_it_is_opened_again) {
  reopen();
  EXPECT_EQ(database_->agent(AgentId{1}).value(), sample_agent(1, "Anna"));
  EXPECT_EQ(database_->match(MatchId{1}).value(), sample_match(1));
  EXPECT_EQ(database_->game(GameId{1}).value(), sample_game(1, 0));
  EXPECT_EQ(database_->tournaments().value().at(0).settings, "a = 1");
}

TEST_P(DatabaseConformance, gives_back_each_bit_of_a_shot) {
  in_transaction([&] { return database_->append_turn(sample_turn(1, 1)); });
  reopen();
  EXPECT_EQ(database_->turn(GameId{1}, 1).value(), sample_turn(1, 1));
}

TEST_P(DatabaseConformance, keeps_what_a_turn_does_not_have_apart_from_zero) {
  TurnRecord plain = sample_turn(1, 2);
  plain.shot->cue_ball.reset();
  plain.shot->call = {.kind = rules::Call::Kind::safety};
  TurnRecord decision = sample_ending(1, 3);
  decision.action = TurnAction::decision;
  decision.decision = rules::Decision::rerack_breaker_breaks;
  decision.result = rules::GameResult{std::nullopt, rules::EndReason::stalemate};
  in_transaction([&] { return database_->append_turn(plain); });
  in_transaction([&] { return database_->append_turn(decision); });
  EXPECT_EQ(database_->turn(GameId{1}, 2).value(), plain);
  EXPECT_EQ(database_->turn(GameId{1}, 3).value(), decision);
}

TEST_P(DatabaseConformance, visits_a_games_turns_in_order_until_told_to_stop) {
  in_transaction([&] { return database_->append_turn(sample_turn(1, 2)); });
  in_transaction([&] { return database_->append_turn(sample_turn(2, 1)); });
  in_transaction([&] { return database_->append_turn(sample_turn(1, 1)); });
  std::vector<std::uint32_t> seen;
  ASSERT_TRUE(database_->each_turn(GameId{1}, [&](const TurnRecord& turn) {
    seen.push_back(turn.number);
    return true;
  }));
  EXPECT_THAT(seen, ElementsAre(1, 2));
  seen.clear();
  ASSERT_TRUE(database_->each_turn(GameId{1}, [&](const TurnRecord& turn) {
    seen.push_back(turn.number);
    return false;
  }));
  EXPECT_THAT(seen, ElementsAre(1));
}

TEST_P(DatabaseConformance, forgets_what_was_rolled_back) {
  ASSERT_TRUE(database_->begin());
  ASSERT_TRUE(database_->append_turn(sample_turn(1, 1)));
  database_->rollback();
  EXPECT_EQ(database_->turn(GameId{1}, 1).value(), std::nullopt);
  in_transaction([&] { return database_->append_turn(sample_turn(1, 1)); });
}

TEST_P(DatabaseConformance, finds_agents_by_name_whatever_its_case_and_by_token) {
  EXPECT_EQ(database_->agent_named("aNNA").value(), sample_agent(1, "Anna"));
  EXPECT_EQ(database_->agent_with_token(digest_of(2)).value(), sample_agent(2, "Bob"));
  EXPECT_EQ(database_->agent_named("Ann").value(), std::nullopt);
  EXPECT_EQ(database_->agent_with_token(digest_of(3)).value(), std::nullopt);
  EXPECT_EQ(database_->agents().value().size(), 2U);
}

TEST_P(DatabaseConformance, refuses_a_second_agent_of_the_same_name_or_token) {
  AgentRecord same_name = sample_agent(3, "ANNA");
  EXPECT_EQ(fault_in_transaction([&] { return database_->add_agent(same_name); }),
            StorageFault::conflict);
  AgentRecord same_token = sample_agent(3, "Carl");
  same_token.token_hash = digest_of(1);
  EXPECT_EQ(fault_in_transaction([&] { return database_->add_agent(same_token); }),
            StorageFault::conflict);
}

TEST_P(DatabaseConformance, refuses_the_same_turn_twice_and_turns_of_no_game) {
  in_transaction([&] { return database_->append_turn(sample_turn(1, 1)); });
  EXPECT_EQ(fault_in_transaction([&] { return database_->append_turn(sample_ending(1, 1)); }),
            StorageFault::conflict);
  EXPECT_EQ(fault_in_transaction([&] { return database_->append_turn(sample_turn(9, 1)); }),
            StorageFault::conflict);
}

TEST_P(DatabaseConformance, refuses_a_second_match_of_a_pairing_or_a_request) {
  MatchRecord same_pairing = sample_match(2);
  same_pairing.request.reset();
  EXPECT_EQ(fault_in_transaction([&] { return database_->add_match(same_pairing); }),
            StorageFault::conflict);
  MatchRecord same_request = sample_match(2);
  same_request.pairing = 4;
  EXPECT_EQ(fault_in_transaction([&] { return database_->add_match(same_request); }),
            StorageFault::conflict);
}

TEST_P(DatabaseConformance, refuses_to_change_what_is_not_there) {
  EXPECT_EQ(fault_in_transaction([&] { return database_->update_game(sample_game(9, 0)); }),
            StorageFault::conflict);
  EXPECT_EQ(fault_in_transaction([&] { return database_->update_match(sample_match(9)); }),
            StorageFault::conflict);
}

TEST_P(DatabaseConformance, gives_unfinished_games_with_their_last_turn_and_shot_counts) {
  TurnRecord first = sample_turn(1, 1);
  first.seat = rules::Seat::first;
  first.shot->index = 1;
  in_transaction([&] { return database_->append_turn(first); });
  in_transaction([&] { return database_->append_turn(sample_turn(1, 2)); });
  reopen();
  const auto unfinished = database_->unfinished_games().value();
  ASSERT_EQ(unfinished.size(), 2U);
  EXPECT_EQ(unfinished[0].game, sample_game(1, 0));
  EXPECT_EQ(unfinished[0].last_turn, sample_turn(1, 2));
  EXPECT_THAT(unfinished[0].shots, ElementsAre(1, 5));
  EXPECT_EQ(unfinished[1].last_turn, std::nullopt);
  EXPECT_THAT(unfinished[1].shots, ElementsAre(0, 0));
}

TEST_P(DatabaseConformance, lists_a_finished_game_for_each_agent_until_it_acknowledged) {
  GameRecord game = sample_game(1, 0);
  game.over = true;
  game.result = rules::GameResult{rules::Seat::second, rules::EndReason::eight_pocketed};
  game.turns = 7;
  game.head = digest_of(7);
  game.acknowledged = {true, false};  // seat 0 is agent 2
  game.finished = UnixMicros{99};
  game.agent_secrets[1] = digest_of(9);
  in_transaction([&] { return database_->update_game(game); });
  EXPECT_EQ(database_->game(GameId{1}).value(), game);
  EXPECT_THAT(database_->unacknowledged_by(AgentId{1}, 9).value(), ElementsAre(game));
  EXPECT_THAT(database_->unacknowledged_by(AgentId{1}, 0).value(), IsEmpty());
  EXPECT_THAT(database_->unacknowledged_by(AgentId{2}, 9).value(), IsEmpty());
  EXPECT_EQ(database_->unfinished_games().value().size(), 1U);
}

TEST_P(DatabaseConformance, lists_the_latest_of_many_finished_games_whichever_seat_the_agent_had) {
  std::vector<GameRecord> games{sample_game(1, 0), sample_game(2, 1), sample_game(3, 2)};
  std::swap(games[2].agents[0], games[2].agents[1]);
  in_transaction([&] { return database_->add_game(games[2]); });
  for (GameRecord& game : games) {
    game.over = true;
    game.result = rules::GameResult{rules::Seat::first, rules::EndReason::conceded};
    in_transaction([&] { return database_->update_game(game); });
  }
  for (const AgentId agent : {AgentId{1}, AgentId{2}}) {
    EXPECT_EQ(database_->unacknowledged_by(agent, 9).value(), games);
    EXPECT_THAT(database_->unacknowledged_by(agent, 2).value(), ElementsAre(games[1], games[2]));
  }
}

TEST_P(DatabaseConformance, lists_results_of_scored_games_as_they_ended) {
  EXPECT_THAT(database_->results().value(), IsEmpty());
  GameRecord last = sample_game(1, 0);
  last.over = true;
  last.result = rules::GameResult{rules::Seat::second, rules::EndReason::eight_pocketed};
  last.finished = UnixMicros{99};
  GameRecord first = sample_game(2, 1);
  first.over = true;
  first.result = rules::GameResult{std::nullopt, rules::EndReason::stalemate};
  first.finished = UnixMicros{98};
  in_transaction([&] { return database_->update_game(last); });
  in_transaction([&] { return database_->update_game(first); });
  const auto results = database_->results().value();
  ASSERT_EQ(results.size(), 2U);
  EXPECT_EQ(results[0].game, GameId{2});
  EXPECT_FALSE(results[0].result.winner);
  EXPECT_EQ(results[1].game, GameId{1});
  EXPECT_EQ(results[1].agents, last.agents);
  EXPECT_EQ(results[1].breaker, rules::Seat::second);
  EXPECT_EQ(results[1].result, *last.result);
  EXPECT_EQ(results[1].finished, UnixMicros{99});
  last.result->reason = rules::EndReason::void_game;
  in_transaction([&] { return database_->update_game(last); });
  EXPECT_EQ(database_->results().value().size(), 1U) << "void games are no results";
}

TEST_P(DatabaseConformance, finishes_matches_and_lists_the_others) {
  EXPECT_EQ(database_->unfinished_matches().value().size(), 1U);
  MatchRecord finished = sample_match(1);
  finished.over = true;
  finished.finished = UnixMicros{77};
  finished.seal = digest_of(61);
  in_transaction([&] { return database_->update_match(finished); });
  EXPECT_THAT(database_->unfinished_matches().value(), IsEmpty());
  const auto matches = database_->matches_of("demo").value();
  EXPECT_THAT(matches, ElementsAre(finished));
}

TEST_P(DatabaseConformance, lists_the_latest_finished_matches_until_each_agent_acknowledged) {
  MatchRecord later = sample_match(2);
  later.pairing = 4;
  later.request.reset();
  in_transaction([&] { return database_->add_match(later); });
  EXPECT_THAT(database_->untold_matches(AgentId{1}, 9).value(), IsEmpty());
  const auto over = [](MatchRecord match, std::int64_t when) {
    match.over = true;
    match.finished = UnixMicros{when};
    return match;
  };
  in_transaction([&] { return database_->update_match(over(sample_match(1), 77)); });
  in_transaction([&] { return database_->update_match(over(later, 78)); });
  in_transaction([&] { return database_->acknowledge_match(MatchId{1}, AgentId{2}); });
  const auto ids = [&](AgentId agent, std::size_t most) {
    std::vector<MatchId> found;
    const auto untold = database_->untold_matches(agent, most);
    for (const MatchRecord& match : untold.value())
      found.push_back(match.id);
    return found;
  };
  EXPECT_THAT(ids(AgentId{1}, 9), ElementsAre(MatchId{1}, MatchId{2}));
  EXPECT_THAT(ids(AgentId{1}, 1), ElementsAre(MatchId{2}));
  EXPECT_THAT(ids(AgentId{2}, 9), ElementsAre(MatchId{2}));
}

TEST_P(DatabaseConformance, keeps_the_texts_of_a_turn_whatever_they_are) {
  std::vector<TurnRecord> turns;
  for (const char* text : {"", "\n", "a\n", "{}", "\xff"}) {
    turns.push_back(sample_turn(1, static_cast<std::uint32_t>(turns.size() + 1)));
    turns.back().shot->events = text;
    turns.push_back(sample_turn(1, static_cast<std::uint32_t>(turns.size() + 1)));
    turns.back().ruling = text;
    turns.push_back(sample_turn(1, static_cast<std::uint32_t>(turns.size() + 1)));
    turns.back().state_before = text;
    turns.back().ruling.reset();
    turns.push_back(sample_ending(1, static_cast<std::uint32_t>(turns.size() + 1)));
    turns.back().state_after = text;
  }
  for (const TurnRecord& turn : turns)
    in_transaction([&] { return database_->append_turn(turn); });
  for (const TurnRecord& turn : turns)
    EXPECT_EQ(database_->turn(GameId{1}, turn.number).value(), turn) << turn.number;
}

TEST_P(DatabaseConformance, finds_the_match_that_a_challenge_asked_for) {
  EXPECT_EQ(database_->match_requested("\"again\"").value(), sample_match(1));
  EXPECT_EQ(database_->match_requested("\"never\"").value(), std::nullopt);
}

TEST_P(DatabaseConformance, keeps_the_last_final_table_and_whom_to_tell_it) {
  const FinalStanding anna{1, "Anna", 2.5, 4, 2, 1, 1};
  const FinalStanding bob{2, "Bob", 1.5, 4, 1, 2, 1};
  for (const std::int64_t agent : {1, 2}) {
    in_transaction([&] {
      return database_->add_entry({.tournament = "demo",
                                   .agent = AgentId{agent},
                                   .place = static_cast<std::uint32_t>(agent)});
    });
  }
  EXPECT_THAT(database_->final_standings("demo").value(), IsEmpty());
  in_transaction([&] { return database_->finish_tournament("demo", {bob, anna}); });
  in_transaction([&] { return database_->finish_tournament("demo", {anna, bob}); });
  EXPECT_THAT(database_->final_standings("demo").value(), ElementsAre(anna, bob));
  in_transaction([&] { return database_->acknowledge_tournament("demo", AgentId{2}); });
  EXPECT_EQ(database_->untold_tournaments(AgentId{1}, 9).value().at(0).id, "demo");
  EXPECT_THAT(database_->untold_tournaments(AgentId{2}, 9).value(), IsEmpty());
}

TEST_P(DatabaseConformance, gives_an_agent_another_token) {
  in_transaction([&] { return database_->set_agent_token(AgentId{1}, digest_of(200)); });
  EXPECT_EQ(database_->agent_with_token(digest_of(200)).value()->name, "Anna");
  EXPECT_EQ(database_->agent_with_token(digest_of(1)).value(), std::nullopt);
}

TEST_P(DatabaseConformance, keeps_entries_in_their_order_with_their_options) {
  const EntryRecord bob{.tournament = "demo",
                        .agent = AgentId{2},
                        .place = 0,
                        .house_bot = "greedy",
                        .house_options = {"--samples", "8", ""}};
  EntryRecord anna{.tournament = "demo", .agent = AgentId{1}, .place = 1, .command = "./anna"};
  in_transaction([&] { return database_->add_entry(anna); });
  in_transaction([&] { return database_->add_entry(bob); });
  EXPECT_THAT(database_->entries("demo").value(), ElementsAre(bob, anna));
  anna.from_round = 2;
  anna.until_round = 5;
  in_transaction([&] { return database_->update_entry(anna); });
  EXPECT_THAT(database_->entries("demo").value(), ElementsAre(bob, anna));
}

TEST_P(DatabaseConformance, changes_a_tournaments_status) {
  in_transaction(
      [&] { return database_->set_tournament_status("demo", TournamentStatus::finished); });
  EXPECT_EQ(database_->tournaments().value().at(0).status, TournamentStatus::finished);
}

TEST_P(DatabaseConformance, counts_on_after_the_largest_ids) {
  const Counters expected{
      .agent = AgentId{3}, .tournament = TournamentId{2}, .match = MatchId{2}, .game = GameId{3}};
  EXPECT_EQ(database_->counters().value(), expected);
  EXPECT_THAT(database_->game_ids().value(), ElementsAre(GameId{1}, GameId{2}));
  EXPECT_THAT(database_->games_of(MatchId{1}).value(),
              ElementsAre(sample_game(1, 0), sample_game(2, 1)));
}

TEST_P(DatabaseConformance, finds_nothing_wrong_with_its_own_structure) {
  EXPECT_THAT(database_->check_structure().value(), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Sqlite, DatabaseConformance,
                         testing::Values(Implementation{
                             "sqlite", [](const auto& file) { return open_sqlite(file); }}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace poolhall::storage
