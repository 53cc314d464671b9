#include "physics/generalized_reflections.hpp"

#include <gtest/gtest.h>

namespace poolhall::physics {
namespace {

using Graph = ContactGraph<double>;

Graph row_of(std::size_t balls, double speed) {
  Graph graph;
  for (std::size_t i = 0; i < balls; ++i) {
    graph.add_ball({i == 0 ? speed : 0.0, 0});
  }
  for (std::size_t i = 0; i + 1 < balls; ++i) {
    graph.add_contact(i, i + 1, {1, 0});
  }
  return graph;
}

double energy(const Graph& graph) {
  double sum = 0;
  for (std::size_t i = 0; i < graph.balls(); ++i) {
    sum += dot(graph.velocity(i), graph.velocity(i)) / 2;
  }
  return sum;
}

TEST(GeneralizedReflections, NewtonsCradleOfFiveSendsTheLastBall) {
  Graph graph = row_of(5, 2);
  GeneralizedReflections<double> gr;
  gr.resolve(graph, 1.0, 0.0);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(graph.velocity(i).x, 0, 1e-15);
  }
  EXPECT_NEAR(graph.velocity(4).x, 2, 1e-15);
}

TEST(GeneralizedReflections, SymmetricTwoBallHitOfTheTextbook) {
  const double s = 0.5, h = std::sqrt(3.0) / 2;
  Graph graph;
  graph.add_ball({1, 0});
  graph.add_ball({0, 0});
  graph.add_ball({0, 0});
  graph.add_contact(0, 1, {h, s});
  graph.add_contact(0, 2, {h, -s});
  GeneralizedReflections<double> gr;
  gr.resolve(graph, 1.0, 0.0);
  EXPECT_NEAR(graph.velocity(0).x, -0.2, 1e-15);
  EXPECT_NEAR(length(graph.velocity(1)), 0.6928203230275509, 1e-15);
  EXPECT_EQ(graph.velocity(1).y, -graph.velocity(2).y);
}

// A rack of 15 touching balls struck at the apex by a sixteenth.
Graph rack(double radius, double gap) {
  Graph graph;
  std::array<Vec2<double>, 16> at{};
  at[0] = {0, -2 * radius};
  std::size_t n = 1;
  for (int row = 0; row < 5; ++row) {
    for (int j = 0; j <= row; ++j) {
      at[n++] = {(2 * j - row) * (radius + gap / 2), row * std::sqrt(3.0) * (radius + gap / 2)};
    }
  }
  for (std::size_t i = 0; i < 16; ++i) {
    graph.add_ball({0, i == 0 ? 8.0 : 0.0});
  }
  for (std::size_t i = 0; i < 16; ++i) {
    for (std::size_t k = i + 1; k < 16; ++k) {
      const Vec2<double> d = at[k] - at[i];
      if (length(d) < 2 * radius + 2 * gap + 1e-9) {
        graph.add_contact(i, k, (1 / length(d)) * d);
      }
    }
  }
  return graph;
}

TEST(GeneralizedReflections, RackKeepsEnergyMomentumAndMirrorSymmetry) {
  Graph graph = rack(0.028575, 0);
  ASSERT_EQ(graph.contacts(), 31U);
  const double before = energy(graph);
  GeneralizedReflections<double> gr;
  gr.resolve(graph, 1.0, 0.0);
  EXPECT_NEAR(energy(graph), before, 1e-12 * before);
  Vec2<double> sum{};
  for (std::size_t i = 0; i < 16; ++i) {
    sum = sum + graph.velocity(i);
  }
  EXPECT_NEAR(sum.x, 0, 1e-12);
  EXPECT_NEAR(sum.y, 8, 1e-12);
  std::size_t n = 1;
  for (std::size_t row = 0; row < 5; ++row) {
    for (std::size_t j = 0; j <= row; ++j) {
      EXPECT_NEAR(graph.velocity(n + j).x, -graph.velocity(n + row - j).x, 1e-11);
      EXPECT_NEAR(graph.velocity(n + j).y, graph.velocity(n + row - j).y, 1e-11);
    }
    n += row + 1;
  }
  for (std::size_t k = 0; k < graph.contacts(); ++k) {
    EXPECT_GT(graph.separating(k), -1e-10);
  }
}

TEST(GeneralizedReflections, MirroredContactsTakeMirroredImpulses) {
  Graph graph = rack(0.028575, 0);
  GeneralizedReflections<double> gr;
  gr.resolve(graph, 0.95, 1e-3);
  // Impulses come in mirrored pairs: every one off the axis occurs twice.
  std::vector<double> off_axis;
  for (std::size_t k = 0; k < graph.contacts(); ++k) {
    off_axis.push_back(gr.impulse(k));
  }
  std::sort(off_axis.begin(), off_axis.end());
  double unpaired = 0;
  for (std::size_t k = 0; k < graph.contacts(); ++k) {
    const auto& c = graph.contact(k);
    if (std::abs(c.normal.y) < 1e-9) {
      continue;  // a row's middle contact is its own mirror image
    }
    double nearest = 1;
    for (std::size_t l = 0; l < graph.contacts(); ++l) {
      if (l != k) {
        nearest = std::min(nearest, std::abs(gr.impulse(k) - gr.impulse(l)));
      }
    }
    if (c.first != 0) {
      unpaired = std::max(unpaired, nearest);
    }
  }
  EXPECT_LT(unpaired, 1e-10);
}

TEST(GeneralizedReflections, RestitutionOfOneContactIsThatOfAPair) {
  Graph graph = row_of(2, 1);
  GeneralizedReflections<double> gr;
  gr.resolve(graph, 0.9, 1e-3);
  EXPECT_NEAR(graph.separating(0), 0.9, 1e-15);
  EXPECT_NEAR(gr.impulse(0), 0.95, 1e-15);
  EXPECT_FALSE(gr.raised());
}

TEST(GeneralizedReflections, InelasticRowMovesOnAtTheSeparationSpeed) {
  Graph graph = row_of(3, 1);
  GeneralizedReflections<double> gr;
  gr.resolve(graph, 0.0, 1e-3);
  EXPECT_TRUE(gr.raised());
  EXPECT_NEAR(graph.separating(0), 1e-3, 1e-14);
  EXPECT_NEAR(graph.separating(1), 1e-3, 1e-14);
}

}  // namespace
}  // namespace poolhall::physics
