#include "server/app/table_svg.hpp"

#include <array>
#include <cmath>
#include <string_view>
#include <variant>

#include <fmt/format.h>

#include "physics/coefficients.hpp"
#include "physics/motion.hpp"
#include "physics/table_geometry.hpp"

namespace poolhall::app {
namespace {

using physics::Vec2;

constexpr double margin = 0.12;  // m around the noses

// The printed colours of the balls 0..8; 9..15 are the stripes of 1..7.
constexpr std::array<std::string_view, 9> colours{"#f8f8f0", "#e8b800", "#1848b8",
                                                  "#d02020", "#602890", "#e87018",
                                                  "#107038", "#7a1c28", "#181818"};

std::string_view colour(physics::BallId ball) {
  const unsigned number = physics::number(ball);
  return colours[number > 8 ? number - 8 : number];
}

// Where a ball is on its way through the log.
struct Way {
  physics::Ball<double> ball;
  double since = 0;  // s
  std::string path;
};

// From where the ball was to where it is at `t`, along the parabola of its motion.
void go_on(Way& way, double t, const Vec2<double>& end,
           const physics::Coefficients<double>& coefficients) {
  const double waited = t - way.since;
  const auto motion = physics::segment(way.ball, physics::Instant<double>{}, coefficients);
  const Vec2<double> from = way.ball.position;
  const bool moves = motion.state == physics::MotionState::sliding ||
                     motion.state == physics::MotionState::rolling;
  if (!moves || waited <= 0) {
    return;
  }
  const Vec2<double> control = from + (waited / 2) * motion.velocity;
  if (way.path.empty()) {
    way.path = fmt::format("M{:.5f} {:.5f}", from.x, from.y);
  }
  way.path += fmt::format("Q{:.5f} {:.5f} {:.5f} {:.5f}", control.x, control.y, end.x, end.y);
}

std::vector<Way> ways_of(const physics::Scene<double>& scene,
                         const physics::Simulation<double>& simulation, double until) {
  const auto coefficients = physics::coefficients<double>(scene.materials);
  std::vector<Way> ways;
  for (const physics::Ball<double>& ball : scene.balls) {
    ways.push_back({ball, 0, {}});
  }
  for (const physics::Event<double>& event : simulation.events) {
    for (std::size_t i = 0; i < event.ball_count; ++i) {
      for (Way& way : ways) {
        if (way.ball.id == event.after[i].id) {
          go_on(way, event.t, event.after[i].position, coefficients);
          way.ball = event.after[i];
          way.since = event.t;
        }
      }
    }
  }
  for (std::size_t i = 0; i < ways.size(); ++i) {
    go_on(ways[i], until, simulation.balls[i].position, coefficients);
  }
  return ways;
}

struct PocketPainter {
  const physics::Table& table;
  std::string& svg;

  void operator()(const physics::NoPockets&) const {}

  void operator()(const physics::MouthLines& mouths) const {
    const double leg = mouths.corner / std::sqrt(2.0);
    for (const double x : {0.0, table.width}) {
      const double inward = x == 0 ? leg : -leg;
      line({x + inward, 0}, {x, leg});
      line({x + inward, table.length}, {x, table.length - leg});
      line({x, (table.length - mouths.side) / 2}, {x, (table.length + mouths.side) / 2});
    }
  }

  void operator()(const physics::Jaws& jaws) const {
    const double out = jaws.corner.depth / std::sqrt(2.0);
    for (const double x : {0.0, table.width}) {
      const double side = x == 0 ? -1 : 1;
      hole({x + side * out, -out}, jaws.corner.radius);
      hole({x + side * out, table.length + out}, jaws.corner.radius);
      hole({x + side * jaws.side.depth, table.length / 2}, jaws.side.radius);
    }
  }

  void line(const Vec2<double>& from, const Vec2<double>& to) const {
    svg += fmt::format(
        R"(<line x1="{:.5f}" y1="{:.5f}" x2="{:.5f}" y2="{:.5f}" stroke="#000" stroke-width="0.012"/>)"
        "\n",
        from.x, from.y, to.x, to.y);
  }
  void hole(const Vec2<double>& centre, double radius) const {
    svg += fmt::format(R"(<circle cx="{:.5f}" cy="{:.5f}" r="{:.5f}" fill="#000"/>)"
                       "\n",
                       centre.x, centre.y, radius);
  }
};

std::string line(const Vec2<double>& from, const Vec2<double>& to) {
  return fmt::format(R"(<path d="M{:.6f} {:.6f}L{:.6f} {:.6f}"/>)"
                     "\n",
                     from.x, from.y, to.x, to.y);
}

// What a ball can touch: noses, the arcs at their ends, facings.
std::string cushion_lines(const physics::TableGeometry<double>& geometry) {
  std::string svg;
  for (const auto& rail : geometry.rails) {
    const bool is_x = rail.axis == physics::Axis::x;
    const Vec2<double> from{is_x ? rail.nose_line : rail.begin, is_x ? rail.begin : rail.nose_line};
    const Vec2<double> to{is_x ? rail.nose_line : rail.end, is_x ? rail.end : rail.nose_line};
    svg += line(from, to);
  }
  for (const auto& arc : geometry.arcs) {
    const Vec2<double> from = arc.centre + arc.radius * arc.first;
    const Vec2<double> to = arc.centre + arc.radius * arc.last;
    svg += fmt::format(R"(<path d="M{:.6f} {:.6f}A{} {} 0 0 1 {:.6f} {:.6f}"/>)"
                       "\n",
                       from.x, from.y, arc.radius, arc.radius, to.x, to.y);
  }
  for (const auto& facing : geometry.facings) {
    svg += line(facing.from, facing.to);
  }
  return svg;
}

std::string table_picture(const physics::Table& table, double radius) {
  std::string svg = fmt::format(
      R"(<rect x="{0}" y="{0}" width="{1}" height="{2}" rx="0.05" fill="#5a3a1c"/>)"
      "\n"
      R"(<rect width="{3}" height="{4}" fill="#2e7d5b"/>)"
      "\n"
      R"(<line y1="{5}" x2="{3}" y2="{5}" stroke="#fff" stroke-opacity="0.4" )"
      R"(stroke-width="0.002" stroke-dasharray="0.02"/>)"
      "\n"
      R"(<circle cx="{6}" cy="{7}" r="0.006" fill="#fff" fill-opacity="0.6"/>)"
      "\n",
      -margin * 0.8, table.width + 1.6 * margin, table.length + 1.6 * margin, table.width,
      table.length, table.head_string, table.foot_spot_x, table.foot_spot_y);
  std::visit(PocketPainter{table, svg}, table.pockets);
  return svg + "<g fill=\"none\" stroke=\"#123f2c\" stroke-width=\"0.006\">\n" +
         cushion_lines(physics::table_geometry<double>(table, radius)) + "</g>\n";
}

std::string ball_picture(const physics::Ball<double>& ball, double radius,
                         std::string_view opacity) {
  return fmt::format(R"(<circle cx="{:.5f}" cy="{:.5f}" r="{}" fill="{}" opacity="{}" stroke="{}" )"
                     R"(stroke-width="{}"/>)"
                     "\n",
                     ball.position.x, ball.position.y, radius, colour(ball.id), opacity,
                     physics::number(ball.id) > 8 ? "#fff" : "#000", radius / 6);
}

// The numbers stand outside the group that is turned upside down.
std::string ball_number(const physics::Ball<double>& ball, double length, double radius) {
  return fmt::format(
      R"(<text x="{:.5f}" y="{:.5f}" font-size="{}" text-anchor="middle" fill="{}">{}</text>)"
      "\n",
      ball.position.x, length - ball.position.y + radius * 0.4, radius * 1.1,
      physics::number(ball.id) == 0 ? "#000" : "#fff", physics::number(ball.id));
}

}  // namespace

physics::Vec2<double> picture_size(const physics::Table& table) {
  return {(table.width + 2 * margin) * 400, (table.length + 2 * margin) * 400};
}

std::string table_svg(const physics::Scene<double>& scene,
                      const physics::Simulation<double>& simulation, double until) {
  const double radius = scene.materials.ball_radius;
  const double length = scene.table.length;
  std::string svg = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="{0} {0} {1} {2}" width="{3:.0f}" )"
      R"(height="{4:.0f}" font-family="sans-serif">)"
      "\n"
      R"svg(<g transform="translate(0 {5}) scale(1 -1)">)svg"
      "\n",
      -margin, scene.table.width + 2 * margin, length + 2 * margin, picture_size(scene.table).x,
      picture_size(scene.table).y, length);
  svg += table_picture(scene.table, radius);
  for (const physics::Ball<double>& ball : scene.balls) {
    svg += ball_picture(ball, radius, "0.3");
  }
  for (const Way& way : ways_of(scene, simulation, until)) {
    if (!way.path.empty()) {
      svg += fmt::format(R"(<path d="{}" fill="none" stroke="{}" stroke-width="0.005"/>)"
                         "\n",
                         way.path, colour(way.ball.id));
    }
  }
  std::string numbers;
  for (const physics::Ball<double>& ball : simulation.balls) {
    if (!ball.pocket) {
      svg += ball_picture(ball, radius, "1");
      numbers += ball_number(ball, length, radius);
    }
  }
  return svg + "</g>\n" + numbers + "</svg>\n";
}

}  // namespace poolhall::app
