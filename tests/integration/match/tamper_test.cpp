// A small share of what `poolhall bench tamper` does in full.
#include <gtest/gtest.h>

#include "server/match/verify.hpp"
#include "server/storage/sqlite_database.hpp"
#include "tests/support/played_game.hpp"
#include "tests/support/tampering.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::match {
namespace {

using test_support::StoredValue;

class Tamper : public testing::Test {
 protected:
  Tamper() {
    auto database = storage::open_sqlite(file_).value();
    add_players(*database);
    PlayedGame(*database, order_of(1), 5).play(2);
    add_mirrored_pair(*database, 2);
  }

  // Nothing: it cannot be read.
  [[nodiscard]] static std::optional<VerifyReport> verified(const std::filesystem::path& file) {
    auto reader = storage::open_sqlite_reader(file);
    if (!reader)
      return std::nullopt;
    auto report = verify(**reader, {});
    return report ? std::optional(std::move(*report)) : std::nullopt;
  }

  test_support::TemporaryDirectory directory_;
  std::filesystem::path file_ = directory_ / "test.db";
};

TEST_F(Tamper, FindsOneBitOfHalfOfAllValues) {
  ASSERT_TRUE(verified(file_)->same());
  std::mt19937_64 random(7);
  test_support::Tampering tampering(file_);
  int tried = 0;
  for (const StoredValue& value : tampering.values()) {
    if (random() % 2 != 0 || !tampering.flip(value, random))
      continue;
    ++tried;
    const auto report = verified(file_);
    EXPECT_TRUE(!report || !report->same())
        << value.table << "." << value.column << " of row " << value.row;
    tampering.restore(value);
  }
  EXPECT_GT(tried, 150);
  EXPECT_TRUE(verified(file_)->same());
}

TEST_F(Tamper, NamesTheRow) {
  std::mt19937_64 random(8);
  test_support::Tampering tampering(file_);
  for (const StoredValue& value : tampering.values()) {
    const bool moves_the_row = value.column == "id" || value.column == "game" ||
                               value.column == "number" || value.column == "match";
    if (moves_the_row || random() % 4 != 0 || !tampering.flip(value, random))
      continue;
    const auto report = verified(file_);
    tampering.restore(value);
    ASSERT_TRUE(report && !report->differences.empty()) << value.column;
    const auto names_it = [&](const Difference& difference) {
      if (value.table == "matches")
        return difference.match && number(*difference.match) == value.row;
      return number(difference.game) == value.game && difference.turn.value_or(0) == value.turn;
    };
    EXPECT_TRUE(std::any_of(report->differences.begin(), report->differences.end(), names_it))
        << value.table << "." << value.column << ": " << report->differences[0].reason;
  }
}

TEST_F(Tamper, FindsBitsOfTheFileThatChangeAValue) {
  const std::string values = test_support::all_values(file_);
  const std::string bytes = test_support::file_bytes(file_);
  const std::filesystem::path copy = directory_ / "copy.db";
  std::mt19937_64 random(9);
  int in_values = 0;
  for (int i = 0; i < 150; ++i) {
    std::string changed = bytes;
    const std::size_t at = random() % changed.size();
    changed[at] ^= static_cast<char>(1U << (random() % 8));
    test_support::write_database(copy, changed);
    if (test_support::all_values(copy) == values)
      continue;
    ++in_values;
    const auto report = verified(copy);
    EXPECT_TRUE(!report || !report->same()) << "byte " << at;
  }
  EXPECT_GT(in_values, 20);
}

}  // namespace
}  // namespace poolhall::match
