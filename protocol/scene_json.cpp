#include "protocol/scene_json.hpp"

#include <array>

#include "physics/motion.hpp"
#include "protocol/json_parts.hpp"
#include "protocol/simulation_text.hpp"

namespace poolhall::protocol {
namespace {

constexpr std::array<std::string_view, 4> precision_names{"double", "long_double", "float128",
                                                          "mp100"};

std::optional<Precision> precision_of(std::string_view text) {
  for (std::size_t i = 0; i < precision_names.size(); ++i) {
    if (precision_names[i] == text) {
      return static_cast<Precision>(i);
    }
  }
  return std::nullopt;
}

std::optional<physics::MotionState> pocketed_only(std::string_view text) {
  const auto state = physics::motion_state(text);
  return state == physics::MotionState::pocketed ? state : std::nullopt;
}

double number_or_zero(const JsonNode& node, std::string_view key) {
  const auto member = node.find(key);
  return member ? member->number() : 0;
}

physics::Ball<double> read_ball(const JsonNode& node, double radius) {
  node.only({"id", "x", "y", "vx", "vy", "wx", "wy", "wz", "state", "pocket"});
  physics::Ball<double> ball;
  ball.id = read_ball_id(node.at("id"));
  if (const auto pocket = node.find("pocket")) {
    node.only({"id", "state", "pocket"});
    ball.pocket = read_pocket(*pocket);
    ball.state = physics::MotionState::pocketed;
    if (const auto state = node.find("state")) {
      static_cast<void>(state->one_of(pocketed_only, "\"pocketed\" beside a pocket"));
    }
    return ball;
  }
  ball.position = read_point(node);
  ball.velocity = {number_or_zero(node, "vx"), number_or_zero(node, "vy")};
  ball.angular_velocity = {number_or_zero(node, "wx"), number_or_zero(node, "wy"),
                           number_or_zero(node, "wz")};
  if (const auto state = node.find("state")) {
    ball.state = state->one_of(physics::motion_state,
                               "\"stationary\", \"spinning\", \"rolling\" or \"sliding\"");
  } else {
    ball.state = physics::motion_state_of(ball.velocity, ball.angular_velocity, radius);
  }
  return ball;
}

physics::BallSet<double> read_balls(const JsonNode& node, double radius) {
  physics::BallSet<double> balls;
  for (const JsonNode& element : node.elements()) {
    if (balls.count == physics::max_balls) {
      node.refuse_expecting("at most " + std::to_string(physics::max_balls) + " balls");
      break;
    }
    balls[balls.count++] = read_ball(element, radius);
  }
  return balls;
}

ShotParams read_shot(const JsonNode& node) {
  node.only({"a", "b", "theta", "phi", "v"});
  return read_shot_params(node);
}

physics::SimulationOptions read_options(const JsonNode& root) {
  physics::SimulationOptions options;
  if (const auto t_max = root.find("t_max")) {
    options.t_max = t_max->number();
    if (*options.t_max < 0) {
      t_max->refuse_expecting("a number of seconds, not negative");
    }
  }
  if (const auto contact = root.find("contact")) {
    options.contact =
        contact->one_of(physics::contact_model, "\"cluster\", \"sequential\" or \"hertz\"");
  }
  if (const auto solver = root.find("solver")) {
    options.solver = solver->one_of(physics::root_solver,
                                    "\"bracketed\", \"closed_form\" or \"closed_form_polished\"");
  }
  if (const auto limit = root.find("event_limit")) {
    options.event_limit = limit->integer<std::uint32_t>(1);
  }
  return options;
}

SceneFile read_scene(const JsonNode& root) {
  root.only({"table", "physics", "balls", "shot", "t_max", "precision", "contact", "solver",
             "event_limit"});
  SceneFile file;
  file.table = read_table(root.at("table"), UnknownKeys::refused);
  file.materials = read_materials(root.at("physics"), UnknownKeys::refused);
  file.balls = read_balls(root.at("balls"), file.materials.ball_radius);
  if (const auto shot = root.find("shot")) {
    file.shot = read_shot(*shot);
  }
  file.options = read_options(root);
  if (const auto precision = root.find("precision")) {
    file.precision =
        precision->one_of(precision_of, "\"double\", \"long_double\", \"float128\" or \"mp100\"");
  }
  return file;
}

NoiseParams read_noise_or_preset(const JsonNode& node) {
  if (node.is_object()) {
    return read_noise(node);
  }
  return node.one_of(noise_preset,
                     "\"none\", \"low\", \"olympiad\", \"high\" or {a, b, theta, phi, v}");
}

}  // namespace

std::string_view name(Precision precision) {
  return precision_names[static_cast<std::size_t>(precision)];
}

Expected<SceneFile> decode_scene(std::string_view text) {
  return read_document(text, document_bounds, read_scene);
}

Expected<EvaluationOrder> decode_evaluation(std::string_view text, std::uint32_t most_samples) {
  return read_document(text, document_bounds, [most_samples](const JsonNode& root) {
    root.only({"scene", "noise", "samples", "seed"});
    EvaluationOrder order;
    order.scene = read_scene(root.at("scene"));
    order.noise = read_noise_or_preset(root.at("noise"));
    if (const auto samples = root.find("samples")) {
      order.samples = samples->integer<std::uint32_t>(1, most_samples);
    }
    if (const auto seed = root.find("seed")) {
      order.seed = seed->integer<std::uint64_t>(0);
    }
    return order;
  });
}

Error scene_error(const physics::Error& error) {
  return error_from(error, "");
}

std::string encode_simulation(const physics::Simulation<double>& simulation) {
  return simulation_text(simulation);
}

}  // namespace poolhall::protocol
