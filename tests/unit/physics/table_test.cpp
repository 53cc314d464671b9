#include "physics/table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <string>

#include "physics/noise_presets.hpp"

namespace poolhall::physics {
namespace {

using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

constexpr double table_ball_radius = 0.028575;

// The `key = value` lines of a preset's file.
std::map<std::string, std::string> settings(const std::string& path) {
  std::ifstream file(std::string(POOLHALL_SOURCE_DIR) + "/config/" + path);
  EXPECT_TRUE(file.is_open()) << path;
  std::map<std::string, std::string> found;
  for (std::string line; std::getline(file, line);) {
    const auto equals = line.find(" = ");
    if (line.empty() || line[0] == '#' || equals == std::string::npos)
      continue;
    found[line.substr(0, equals)] = line.substr(equals + 3);
  }
  return found;
}

double number_of(const std::map<std::string, std::string>& found, const std::string& key) {
  const auto place = found.find(key);
  EXPECT_NE(place, found.end()) << key;
  return place == found.end() ? 0 : std::stod(place->second);
}

void expect_pocket(const std::map<std::string, std::string>& file, const std::string& key,
                   const JawPocket& pocket) {
  EXPECT_EQ(pocket.width, number_of(file, key + ".width"));
  EXPECT_EQ(pocket.angle, number_of(file, key + ".angle"));
  EXPECT_EQ(pocket.depth, number_of(file, key + ".depth"));
  EXPECT_EQ(pocket.radius, number_of(file, key + ".radius"));
  EXPECT_EQ(pocket.jaw_radius, number_of(file, key + ".jaw_radius"));
}

TEST(PresetTable, TheFourTablesAreCompiledIn) {
  EXPECT_THAT(preset_table_names(), UnorderedElementsAre("olympiad", "bar7", "wpa8", "wpa9"));
  EXPECT_FALSE(preset_table("snooker").has_value());
}

TEST(PresetTable, IsWhatItsFileSays) {
  for (const std::string& name : preset_table_names()) {
    const auto file = settings("tables/" + name + ".toml");
    const Table table = preset_table(name).value();
    EXPECT_EQ(table.width, number_of(file, "width"));
    EXPECT_EQ(table.length, number_of(file, "length"));
    EXPECT_EQ(table.head_string, number_of(file, "head_string"));
    EXPECT_EQ(table.foot_spot_x, number_of(file, "foot_spot_x"));
    EXPECT_EQ(table.foot_spot_y, number_of(file, "foot_spot_y"));
    if (const auto* mouths = std::get_if<MouthLines>(&table.pockets)) {
      EXPECT_EQ(file.at("pockets.kind"), "\"mouth_lines\"");
      EXPECT_EQ(mouths->corner, number_of(file, "pockets.corner"));
      EXPECT_EQ(mouths->side, number_of(file, "pockets.side"));
    } else {
      EXPECT_EQ(file.at("pockets.kind"), "\"jaws\"");
      const Jaws& jaws = std::get<Jaws>(table.pockets);
      EXPECT_EQ(jaws.cushion_width, number_of(file, "pockets.cushion_width"));
      expect_pocket(file, "pockets.corner", jaws.corner);
      expect_pocket(file, "pockets.side", jaws.side);
    }
  }
}

TEST(PresetTable, HasTheHeadStringAndFootSpotAtTheQuarters) {
  for (const std::string& name : preset_table_names()) {
    const Table table = preset_table(name).value();
    EXPECT_DOUBLE_EQ(table.head_string, table.length / 4) << name;
    EXPECT_DOUBLE_EQ(table.foot_spot_x, table.width / 2) << name;
    EXPECT_DOUBLE_EQ(table.foot_spot_y, 3 * table.length / 4) << name;
    EXPECT_TRUE(check_table(table, table_ball_radius).has_value()) << name;
  }
}

TEST(PresetNoiseFiles, AreWhatIsCompiledIn) {
  for (const NoisePreset& preset : noise_presets()) {
    const auto file = settings("noise/" + preset.name + ".toml");
    EXPECT_EQ(preset.deviations.a, number_of(file, "a"));
    EXPECT_EQ(preset.deviations.b, number_of(file, "b"));
    EXPECT_EQ(preset.deviations.theta, number_of(file, "theta"));
    EXPECT_EQ(preset.deviations.phi, number_of(file, "phi"));
    EXPECT_EQ(preset.deviations.v, number_of(file, "v"));
  }
}

struct BadTable {
  const char* what;
  Table table;
  Fault fault;
  const char* field;
};

Table changed(const char* preset, void (*change)(Table&)) {
  Table table = preset_table(preset).value();
  change(table);
  return table;
}

class CheckTable : public ::testing::TestWithParam<BadTable> {};

TEST_P(CheckTable, NamesTheFieldThatIsWrong) {
  const Expected<void> checked = check_table(GetParam().table, table_ball_radius);
  ASSERT_FALSE(checked.has_value());
  EXPECT_EQ(checked.error().fault, GetParam().fault);
  EXPECT_EQ(checked.error().field, GetParam().field);
  EXPECT_THAT(checked.error().reason, HasSubstr("expected"));
}

INSTANTIATE_TEST_SUITE_P(
    Table, CheckTable,
    ::testing::Values(
        BadTable{"nan width",
                 changed("olympiad",
                         [](Table& bad) { bad.width = std::numeric_limits<double>::quiet_NaN(); }),
                 Fault::not_finite, "/width"},
        BadTable{"no length", changed("olympiad", [](Table& bad) { bad.length = 0; }),
                 Fault::out_of_range, "/length"},
        BadTable{"nose above the ball", changed("bar7", [](Table& bad) { bad.nose_height = 0.06; }),
                 Fault::out_of_range, "/nose_height"},
        BadTable{"head string off", changed("bar7", [](Table& bad) { bad.head_string = -0.1; }),
                 Fault::out_of_range, "/head_string"},
        BadTable{
            "mouth below zero",
            changed("olympiad", [](Table& bad) { std::get<MouthLines>(bad.pockets).side = -0.1; }),
            Fault::out_of_range, "/pockets/side"},
        BadTable{"facing at right angles",
                 changed("wpa9", [](Table& bad) { std::get<Jaws>(bad.pockets).corner.angle = 45; }),
                 Fault::out_of_range, "/pockets/corner/angle"},
        BadTable{
            "mouths meet",
            changed("olympiad", [](Table& bad) { std::get<MouthLines>(bad.pockets).corner = 1.6; }),
            Fault::bad_table, "/pockets"},
        BadTable{"hole out of reach",
                 changed("wpa8", [](Table& bad) { std::get<Jaws>(bad.pockets).side.depth = 0.3; }),
                 Fault::bad_table, "/pockets/side"}),
    [](const auto& param) {
      std::string name = param.param.what;
      for (char& c : name) {
        if (c == ' ')
          c = '_';
      }
      return name;
    });

}  // namespace
}  // namespace poolhall::physics
