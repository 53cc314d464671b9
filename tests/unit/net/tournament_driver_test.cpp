#include "server/net/tournament_driver.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <memory>

namespace poolhall::net {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// A server in memory: matches end when the test says so. What is stored outlives a driver, as a
// database does.
class FakeHost final : public MatchHost {
 public:
  TournamentCard open_tournament(const TournamentCard& card) override {
    if (!stored) {
      stored = card;
    }
    return *stored;
  }
  void set_status(const std::string&, TournamentStatus status) override { stored->status = status; }
  std::vector<TournamentCard> tournaments() const override { return {*stored}; }
  void enter(const TournamentEntry& entry) override { entered.push_back(entry); }
  std::vector<TournamentEntry> entries(const std::string&) const override { return entered; }
  void set_intake(const std::string&, const Intake& now) override { intake = now; }
  void start_match(const MatchOrder& order) override { orders.push_back(order); }
  void cancel_match(const std::string&, std::uint32_t pairing) override {
    cancelled.push_back(pairing);
  }
  std::vector<MatchOutcome> finished_matches(const std::string&) const override { return finished; }
  std::vector<MatchOutcome> unfinished_matches(const std::string&) const override {
    return unfinished;
  }
  void on_match_over(std::function<void(const MatchOutcome&)> callback) override {
    match_over_ = std::move(callback);
  }
  void on_game_over(std::function<void(const MatchOrder&, const GameOutcome&)> callback) override {
    game_over_ = std::move(callback);
  }
  void on_entries_changed(std::function<void(const std::string&)> callback) override {
    entries_changed_ = std::move(callback);
  }
  // Somebody who had entered leaves.
  void withdraw(const std::string& name) {
    for (TournamentEntry& entry : entered) {
      if (entry.name == name) {
        entry.until_round = intake.next_round;
      }
    }
    entries_changed_("cup");
  }
  void announce_end(const std::string&, const std::vector<protocol::StandingRow>& rows) override {
    announced = rows;
  }

  // The oldest order that is not over is played; agents[winner] wins all its games.
  void play_next(std::uint32_t winner) {
    const MatchOrder order = orders.at(played++);
    MatchOutcome outcome{order.tournament, order.pairing, MatchId{order.pairing + 1}, {}};
    for (std::uint32_t number = 0; number < order.games; ++number) {
      outcome.games.push_back({.number = number,
                               .breaker = number % 2,
                               .winner = winner,
                               .reason = rules::EndReason::eight_pocketed});
      game_over_(order, outcome.games.back());
    }
    finished.push_back(outcome);
    match_over_(outcome);
  }
  void play_one_game(std::size_t order, std::uint32_t number, std::uint32_t winner) {
    game_over_(orders.at(order), {.number = number, .breaker = number % 2, .winner = winner});
  }

  std::optional<TournamentCard> stored;
  std::vector<TournamentEntry> entered;
  Intake intake;
  std::vector<MatchOrder> orders;
  std::vector<std::uint32_t> cancelled;
  std::size_t played = 0;
  std::vector<MatchOutcome> finished;
  std::vector<MatchOutcome> unfinished;
  std::vector<protocol::StandingRow> announced;

 private:
  std::function<void(const std::string&)> entries_changed_;
  std::function<void(const MatchOutcome&)> match_over_;
  std::function<void(const MatchOrder&, const GameOutcome&)> game_over_;
};

const std::string three_entries =
    "name = \"cup\"\ngames_per_match = 2\nrules = \"9-ball\"\nnoise = \"low\"\n"
    "max_concurrent_games = 3\n[clock]\ngame_seconds = 30\n"
    "[[entry]]\nname = \"light\"\nhouse = \"greedy\"\noptions = {effort = 5}\n"
    "[[entry]]\nname = \"mine\"\ncommand = \"./mine\"\n"
    "[[entry]]\nagent = \"Anna\"\n";

settings::TournamentFile file(const std::string& text) {
  const auto settings = settings::parse_tournament(text, "cup.toml");
  EXPECT_TRUE(settings);
  return {settings.value(), text};
}

class TournamentDriverTest : public testing::Test {
 protected:
  TournamentDriver& begin(const std::string& text = three_entries, std::uint64_t seed = 7) {
    driver_ = std::make_unique<TournamentDriver>(file(text), host_, [this] { return now_; });
    driver_->on_change([this] { view_ = driver_->view(); });
    begun_ = driver_->begin(seed);
    return *driver_;
  }

  FakeHost host_;
  SteadyTime now_{1000s};
  std::unique_ptr<TournamentDriver> driver_;
  std::optional<TournamentView> view_;
  tl::expected<void, std::string> begun_;
};

TEST_F(TournamentDriverTest, EntersEverybodyAsTheFileSays) {
  begin();
  ASSERT_TRUE(begun_);
  ASSERT_THAT(host_.entered, SizeIs(3));
  EXPECT_EQ(host_.entered[0].name, "light");
  EXPECT_EQ(host_.entered[0].house_bot, "greedy");
  EXPECT_THAT(host_.entered[0].house_options, ElementsAre("--effort", "5"));
  EXPECT_EQ(host_.entered[1].command, "./mine");
  EXPECT_EQ(host_.entered[2].name, "Anna");
  EXPECT_FALSE(host_.entered[2].house_bot || host_.entered[2].command);
  EXPECT_EQ(host_.stored->status, TournamentStatus::running);
}

TEST_F(TournamentDriverTest, OrdersMatchesOnTheTermsOfTheFile) {
  begin();
  ASSERT_THAT(host_.orders, SizeIs(1));
  const MatchOrder& order = host_.orders.front();
  EXPECT_THAT(order.agents, ElementsAre("mine", "Anna"));
  EXPECT_EQ(order.games, 2u);
  EXPECT_EQ(order.mirrored, storage::Mirror::rack);
  EXPECT_EQ(order.terms.rules, rules::RuleSet::nine_ball);
  EXPECT_EQ(order.terms.noise, "low");
  EXPECT_EQ(order.terms.clock, 30s);
}

TEST_F(TournamentDriverTest, PlaysTheWholeScheduleAndThenSaysSo) {
  begin();
  for (int match = 0; match < 3; ++match) {
    EXPECT_FALSE(view_->over);
    host_.play_next(0);
  }
  EXPECT_TRUE(view_->over);
  EXPECT_THAT(host_.orders, SizeIs(3));
  EXPECT_THAT(view_->games, SizeIs(6));
  EXPECT_EQ(host_.stored->status, TournamentStatus::finished);
  ASSERT_THAT(host_.announced, SizeIs(3));
  EXPECT_EQ(host_.announced[0].games, 4u);
}

TEST_F(TournamentDriverTest, ResultsBelongToThoseWhoPlayed) {
  begin();
  host_.play_next(1);  // mine - Anna: Anna wins both
  ASSERT_THAT(view_->games, SizeIs(2));
  EXPECT_EQ(view_->games[0].breaker, tournament::EntryId{1});
  EXPECT_EQ(view_->games[0].winner, tournament::EntryId{2});
  EXPECT_EQ(view_->games[1].breaker, tournament::EntryId{2});
  EXPECT_EQ(view_->games[1].winner, tournament::EntryId{2});
}

TEST_F(TournamentDriverTest, BegunAgainItGoesOnWithWhatIsNotOver) {
  begin();
  host_.play_next(0);
  ASSERT_THAT(host_.orders, SizeIs(2));
  const MatchOrder interrupted = host_.orders[1];
  host_.unfinished.push_back({"cup", interrupted.pairing, MatchId{9}, {{.winner = 1}}});
  host_.orders.clear();
  host_.played = 0;

  begin(three_entries, 999);
  ASSERT_TRUE(begun_);
  ASSERT_THAT(host_.orders, SizeIs(1));
  EXPECT_EQ(host_.orders[0].pairing, interrupted.pairing);
  EXPECT_EQ(host_.orders[0].seed, interrupted.seed) << "the seed of the first run stays";
  EXPECT_THAT(view_->games, SizeIs(3));
  EXPECT_EQ(progress_of(*view_, now_).finished, 3u);
  host_.play_next(0);
  host_.play_next(0);
  EXPECT_TRUE(view_->over);
  EXPECT_THAT(view_->games, SizeIs(6));
}

TEST_F(TournamentDriverTest, BegunAgainWhenEverythingIsOverItOnlyShowsTheTable) {
  begin();
  for (int match = 0; match < 3; ++match) {
    host_.play_next(0);
  }
  host_.orders.clear();
  begin();
  ASSERT_TRUE(begun_);
  EXPECT_THAT(host_.orders, IsEmpty());
  EXPECT_TRUE(view_->over);
  EXPECT_THAT(view_->games, SizeIs(6));
}

const std::string eight_entries = [] {
  std::string entries;
  for (const char* name : {"a", "b", "c", "d", "e", "f", "g", "h"}) {
    entries += "[[entry]]\nname = \"" + std::string(name) + "\"\nhouse = \"random\"\n";
  }
  return entries;
}();

std::string of_format(const std::string& format) {
  return "name = \"cup\"\nformat = \"" + format +
         "\"\ngames_per_match = 2\nmax_concurrent_games = 4\n" + eight_entries;
}

class FormatTest : public TournamentDriverTest, public testing::WithParamInterface<const char*> {
 protected:
  // Somebody wins; always the same one in the same match.
  static std::uint32_t winner(const FakeHost& host) {
    return host.orders.at(host.played).pairing % 3 == 0 ? 0 : 1;
  }
};

TEST_P(FormatTest, IsPlayedToItsEnd) {
  begin(of_format(GetParam()));
  ASSERT_TRUE(begun_);
  while (!view_->over) {
    ASSERT_LT(host_.played, host_.orders.size());
    host_.play_next(winner(host_));
  }
  EXPECT_EQ(host_.orders.size(), host_.played);
  EXPECT_THAT(host_.announced, SizeIs(8));
}

TEST_P(FormatTest, BegunAgainInTheMiddleItHasTheSameSchedule) {
  begin(of_format(GetParam()));
  while (!view_->over) {
    host_.play_next(winner(host_));
  }
  std::map<std::uint32_t, MatchOrder> all;
  for (const MatchOrder& order : host_.orders) {
    all[order.pairing] = order;
  }
  FakeHost killed;
  TournamentDriver first_run(file(of_format(GetParam())), killed, [this] { return now_; });
  ASSERT_TRUE(first_run.begin(7));
  while (killed.played < all.size() / 2) {
    killed.play_next(winner(killed));
  }
  for (std::size_t i = killed.played; i < killed.orders.size(); ++i) {
    killed.unfinished.push_back({"cup", killed.orders[i].pairing, MatchId{99}, {}});
  }
  killed.orders.resize(killed.played);
  TournamentDriver second_run(file(of_format(GetParam())), killed, [this] { return now_; });
  ASSERT_TRUE(second_run.begin(8));
  while (killed.played < killed.orders.size()) {
    killed.play_next(winner(killed));
  }
  EXPECT_TRUE(second_run.view().over);
  ASSERT_EQ(killed.orders.size(), all.size());
  for (const MatchOrder& order : killed.orders) {
    EXPECT_EQ(order.agents, all[order.pairing].agents);
    EXPECT_EQ(order.seed, all[order.pairing].seed);
  }
  EXPECT_EQ(killed.announced.front().agent, host_.announced.front().agent);
}

INSTANTIATE_TEST_SUITE_P(All, FormatTest,
                         testing::Values("round_robin", "swiss", "single_elimination",
                                         "double_elimination", "gauntlet", "ladder"));

TEST_F(TournamentDriverTest, AnSprtStopsWhenItIsDecided) {
  begin(
      "name = \"cup\"\nformat = \"sprt\"\nrounds = 500\nmax_concurrent_games = 2\n"
      "max_concurrent_games_per_entry = 2\nsprt.elo1 = 200\n"
      "[[entry]]\nagent = \"Anna\"\n[[entry]]\nagent = \"Bert\"\n");
  ASSERT_TRUE(begun_);
  for (std::uint32_t match = 0; !view_->over; ++match) {
    host_.play_next(host_.orders[host_.played].agents[0] == "Anna" ? 0 : 1);
  }
  EXPECT_LT(host_.played, 100U);
  EXPECT_EQ(host_.played, host_.orders.size());
  EXPECT_THAT(view_->remarks, HasSubstr("H1 accepted"));
}

TEST_F(TournamentDriverTest, AnOrderOfWhoLeavesIsTakenBackUnlessItsMatchHasBegun) {
  begin();
  ASSERT_THAT(host_.orders, SizeIs(1));
  EXPECT_THAT(host_.orders[0].agents, ElementsAre("mine", "Anna"));
  host_.withdraw("Anna");
  EXPECT_THAT(host_.cancelled, ElementsAre(0));
  ASSERT_THAT(host_.orders, SizeIs(2));
  EXPECT_THAT(host_.orders[1].agents, ElementsAre("light", "mine"));
  host_.played = 1;
  host_.play_next(0);
  EXPECT_TRUE(view_->over);
  EXPECT_THAT(host_.announced, SizeIs(3));
}

TEST_F(TournamentDriverTest, AMatchThatHasBegunIsPlayedToItsEndThoughOneOfItLeaves) {
  begin();
  host_.unfinished.push_back({"cup", host_.orders[0].pairing, MatchId{1}, {}});
  host_.withdraw("Anna");
  EXPECT_THAT(host_.cancelled, IsEmpty());
  EXPECT_THAT(host_.orders, SizeIs(1));
  host_.unfinished.clear();
  host_.play_next(0);
  EXPECT_FALSE(view_->over) << "light and mine have still to meet";
}

TEST_F(TournamentDriverTest, AnotherTournamentOfTheSameNameIsRefused) {
  begin();
  std::string other = three_entries;
  other.replace(other.find("= 30"), 4, "= 60");
  begin(other);
  ASSERT_FALSE(begun_);
  EXPECT_THAT(begun_.error(), HasSubstr("a tournament \"cup\" with other settings"));
}

TEST_F(TournamentDriverTest, TheSeedOfTheFileDecidesTheRacks) {
  begin("seed = 5\n" + three_entries, 1);
  const std::uint64_t first = host_.orders[0].seed;
  FakeHost other_host;
  TournamentDriver other(file("seed = 5\n" + three_entries), other_host, [this] { return now_; });
  ASSERT_TRUE(other.begin(2));
  EXPECT_EQ(other_host.orders[0].seed, first);
  EXPECT_EQ(host_.stored->settings, "seed = 5\n" + three_entries);
}

TEST_F(TournamentDriverTest, AGameToldTwiceCountsOnce) {
  begin();
  host_.play_one_game(0, 0, 0);
  host_.play_one_game(0, 0, 0);
  EXPECT_THAT(view_->games, SizeIs(1));
  EXPECT_THAT(view_->timed, SizeIs(1));
}

TEST_F(TournamentDriverTest, TheViewTellsWhatRunsAndWhatWaits) {
  begin();
  now_ += 10s;
  host_.play_one_game(0, 0, 0);
  now_ += 5s;
  const tournament::Progress progress = progress_of(*view_, now_);
  EXPECT_EQ(progress.finished, 1u);
  EXPECT_EQ(progress.running, 1u);
  EXPECT_EQ(progress.total, 6u);
  ASSERT_TRUE(progress.remaining);
  // 10 s a game, one at a time: 5 s of the running one and four more.
  EXPECT_NEAR(progress.remaining->count(), 45, 1e-9);
}

}  // namespace
}  // namespace poolhall::net
