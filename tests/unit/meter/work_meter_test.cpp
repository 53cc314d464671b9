#include "server/meter/work_meter.hpp"

#include <gtest/gtest.h>

namespace poolhall::meter {
namespace {

// Until this thread has worked for so long.
void work_for(Nanoseconds time) {
  const Nanoseconds until = process_time() + time;
  while (process_time() < until) {
  }
}

TEST(WorkMeter, CountsWorkUnderItsAreaAlone) {
  const auto before = work_times();
  for (int i = 0; i < 70; ++i) {
    static_cast<void>(metered(Area::rules, [] {
      work_for(std::chrono::microseconds{200});
      return 0;
    }));
  }
  const auto after = work_times();
  const auto spent =
      after[static_cast<std::size_t>(Area::rules)] - before[static_cast<std::size_t>(Area::rules)];
  EXPECT_GE(spent, std::chrono::milliseconds{10});
  EXPECT_EQ(after[static_cast<std::size_t>(Area::physics)],
            before[static_cast<std::size_t>(Area::physics)]);
}

TEST(WorkMeter, KnowsThatAProcessTakesMemory) {
  EXPECT_GT(resident_bytes(), 100'000U);
}

}  // namespace
}  // namespace poolhall::meter
