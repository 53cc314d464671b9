#include "physics/materials.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "physics/ball_friction.hpp"

namespace poolhall::physics {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(PresetMaterials, AreOlympiadMarlowAndModern) {
  EXPECT_THAT(preset_material_names(), ElementsAre("olympiad", "marlow", "modern"));
  for (const std::string& name : preset_material_names()) {
    const Materials m = preset_materials(name).value();
    EXPECT_EQ(m.name, name);
    EXPECT_EQ(m.gravity, 9.81);
    EXPECT_TRUE(check_materials(m).has_value()) << name;
  }
  EXPECT_FALSE(preset_materials("ice").has_value());
}

TEST(PresetMaterials, OlympiadIsThePapers) {
  const Materials m = preset_materials("olympiad").value();
  EXPECT_EQ(m.ball_radius, 0.028575);
  EXPECT_EQ(m.ball_mass, 0.16301);
  EXPECT_EQ(m.mu_slide, 0.2);
  EXPECT_EQ(m.mu_roll, 0.015);
  EXPECT_EQ(m.mu_spin, 0.044);
  EXPECT_EQ(m.ball_restitution, 1);
  EXPECT_EQ(std::get<ConstantFriction>(m.ball_friction).coefficient, 0.01);
  EXPECT_EQ(std::get<DampedCushion>(m.cushion).normal, 0.6);
  EXPECT_EQ(m.tip_restitution, 1);
  EXPECT_EQ(m.cue_mass, 0.5287);
  EXPECT_EQ(preset_materials("marlow")->mu_roll, 0.016);
}

TEST(PresetMaterials, ModernIsTheMeasuredSet) {
  const Materials m = preset_materials("modern").value();
  EXPECT_EQ(m.ball_mass, 0.170097);
  EXPECT_EQ(m.mu_roll, 0.01);
  EXPECT_EQ(m.spin_deceleration, 10);
  EXPECT_FALSE(m.mu_spin.has_value());
  EXPECT_EQ(m.ball_restitution, 0.95);
  EXPECT_TRUE(std::holds_alternative<AlciatoreFriction>(m.ball_friction));
  EXPECT_EQ(std::get<Han2005Cushion>(m.cushion).restitution, 0.85);
  EXPECT_EQ(m.tip_restitution, 0.73);
  EXPECT_EQ(m.cue_mass, 0.567);
  EXPECT_EQ(m.miscue_limit, 0.5);
}

// Alciatore TP A.14: mu = 9.951e-3 + 0.108 exp(-1.088 v).
TEST(BallFriction, IsConstantOrAlciatoresFit) {
  EXPECT_EQ(ball_friction_coefficient<double>(ConstantFriction{0.06}, 3.0), 0.06);
  EXPECT_NEAR(ball_friction_coefficient<double>(AlciatoreFriction{}, 0.0), 0.117951, 1e-15);
  EXPECT_NEAR(ball_friction_coefficient<double>(AlciatoreFriction{}, 1.0),
              9.951e-3 + 0.108 * std::exp(-1.088), 1e-16);
  EXPECT_NEAR(ball_friction_coefficient<double>(AlciatoreFriction{}, 1e6), 9.951e-3, 1e-18);
}

struct BadMaterials {
  const char* what;
  void (*spoil)(Materials&);
  Fault fault;
  const char* field;
};

class CheckMaterials : public ::testing::TestWithParam<BadMaterials> {};

TEST_P(CheckMaterials, NamesTheFieldThatIsWrong) {
  Materials m = preset_materials("olympiad").value();
  GetParam().spoil(m);
  const Expected<void> checked = check_materials(m);
  ASSERT_FALSE(checked.has_value());
  EXPECT_EQ(checked.error().fault, GetParam().fault);
  EXPECT_EQ(checked.error().field, GetParam().field);
  EXPECT_THAT(checked.error().reason, HasSubstr("expected"));
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Materials, CheckMaterials,
    ::testing::Values(BadMaterials{"gravity", [](Materials& m) { m.gravity = 0; },
                                   Fault::out_of_range, "/gravity"},
                      BadMaterials{"radius", [](Materials& m) { m.ball_radius = -1; },
                                   Fault::out_of_range, "/ball_radius"},
                      BadMaterials{"slide", [](Materials& m) { m.mu_slide = nan; },
                                   Fault::not_finite, "/mu_slide"},
                      BadMaterials{"roll", [](Materials& m) { m.mu_roll = -0.01; },
                                   Fault::out_of_range, "/mu_roll"},
                      BadMaterials{"spin", [](Materials& m) { m.spin_deceleration = -1; },
                                   Fault::out_of_range, "/spin_deceleration"},
                      BadMaterials{"bounce", [](Materials& m) { m.ball_restitution = 1.01; },
                                   Fault::out_of_range, "/ball_restitution"},
                      BadMaterials{"ball_friction",
                                   [](Materials& m) { m.ball_friction = ConstantFriction{-1}; },
                                   Fault::out_of_range, "/ball_friction"},
                      BadMaterials{"damped",
                                   [](Materials& m) {
                                     m.cushion = DampedCushion{1.1, 0.9, 0.1};
                                   },
                                   Fault::out_of_range, "/cushion/normal"},
                      BadMaterials{"han",
                                   [](Materials& m) {
                                     m.cushion = Han2005Cushion{0.85, -1, {}};
                                   },
                                   Fault::out_of_range, "/cushion/friction"},
                      BadMaterials{"mathavan",
                                   [](Materials& m) {
                                     m.cushion = Mathavan2010Cushion{0.85, 0.2, 0.06};
                                   },
                                   Fault::out_of_range, "/cushion/nose_height"},
                      BadMaterials{"spring",
                                   [](Materials& m) {
                                     m.cushion = SpringCushion{1e4, 1, 0.2, {}};
                                   },
                                   Fault::out_of_range, "/cushion/damping_ratio"},
                      BadMaterials{"miscue", [](Materials& m) { m.miscue_limit = 0; },
                                   Fault::out_of_range, "/miscue_limit"}),
    [](const auto& param) { return std::string(param.param.what); });

}  // namespace
}  // namespace poolhall::physics
