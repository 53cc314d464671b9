#include "server/net/shared_noise.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace poolhall::net {
namespace {

using How = SharedNoise::Run;
using rules::Seat;
using testing::ElementsAre;
using testing::IsEmpty;

class SharedNoiseTest : public testing::Test {
 protected:
  void submit(PairSide side, Seat seat, std::uint32_t index) {
    pair_.submit(side, {seat, index},
                 [this, side](How how) { runs_[static_cast<std::size_t>(side)].push_back(how); });
  }

  boost::asio::io_context io_;
  DeadlineQueue deadlines_{io_};
  SharedNoise pair_{{}, deadlines_};
  std::array<std::vector<How>, 2> runs_;
};

TEST_F(SharedNoiseTest, RunsBothShotsOnceBothAreThere) {
  submit(PairSide::first, Seat::first, 1);
  EXPECT_THAT(runs_[0], IsEmpty());
  submit(PairSide::second, Seat::first, 1);
  EXPECT_THAT(runs_[0], ElementsAre(How::shared));
  EXPECT_THAT(runs_[1], ElementsAre(How::shared));
}

TEST_F(SharedNoiseTest, DrawsAfreshForAShotThatWasRunBefore) {
  submit(PairSide::first, Seat::first, 1);
  submit(PairSide::second, Seat::first, 1);
  submit(PairSide::second, Seat::first, 1);  // its first was refused; the other's was run
  EXPECT_THAT(runs_[1], ElementsAre(How::shared, How::alone));
}

TEST_F(SharedNoiseTest, LetsTheOlderGoOnWhenEachWaitsForAnotherShot) {
  submit(PairSide::first, Seat::first, 2);
  submit(PairSide::second, Seat::second, 1);
  EXPECT_THAT(runs_[0], ElementsAre(How::alone));
  EXPECT_THAT(runs_[1], IsEmpty());
  submit(PairSide::first, Seat::second, 1);
  EXPECT_THAT(runs_[0], ElementsAre(How::alone, How::shared));
  EXPECT_THAT(runs_[1], ElementsAre(How::shared));
  submit(PairSide::second, Seat::first, 2);
  EXPECT_THAT(runs_[1], ElementsAre(How::shared, How::alone));
}

TEST_F(SharedNoiseTest, WaitsForNobodyOnceTheOtherGameIsOver) {
  submit(PairSide::first, Seat::first, 1);
  pair_.leave(PairSide::second);
  submit(PairSide::first, Seat::first, 2);
  EXPECT_THAT(runs_[0], ElementsAre(How::alone, How::alone));
}

TEST_F(SharedNoiseTest, WaitsNoLongerThanItsPatience) {
  SharedNoise pair({}, deadlines_, std::chrono::milliseconds{0});
  std::vector<How> runs;
  const auto note = [&](How how) { runs.push_back(how); };
  pair.submit(PairSide::first, {Seat::first, 1}, note);
  EXPECT_THAT(runs, IsEmpty());
  io_.run();
  EXPECT_THAT(runs, ElementsAre(How::alone));
  pair.submit(PairSide::second, {Seat::first, 1}, note);
  EXPECT_THAT(runs, ElementsAre(How::alone, How::alone));
}

// After a restart: what either game has stored may have been seen by the player of both.
TEST_F(SharedNoiseTest, SharesNothingThatOneGameHasStoredAlready) {
  SharedNoise pair({SharedNoise::ShotsOfSeats{2, 0}, SharedNoise::ShotsOfSeats{1, 1}}, deadlines_);
  std::vector<How> runs;
  const auto note = [&](How how) { runs.push_back(how); };
  pair.submit(PairSide::second, {Seat::first, 2}, note);
  pair.submit(PairSide::first, {Seat::second, 1}, note);
  EXPECT_THAT(runs, ElementsAre(How::alone, How::alone));
  pair.submit(PairSide::first, {Seat::first, 3}, note);
  pair.submit(PairSide::second, {Seat::first, 3}, note);
  EXPECT_THAT(runs, ElementsAre(How::alone, How::alone, How::shared, How::shared));
}

}  // namespace
}  // namespace poolhall::net
