#include "server/web/workbench.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "physics/noise_presets.hpp"
#include "physics/samples.hpp"
#include "physics/simulator.hpp"
#include "protocol/json_writer.hpp"
#include "protocol/scene_json.hpp"
#include "protocol/table_json.hpp"

namespace poolhall::web {

using protocol::JsonWriter;

namespace {

Page wrong(const protocol::Error& error) {
  JsonWriter out;
  out.begin_object().key("error").begin_object();
  out.key("code").string("bad_scene").key("field").string(error.field);
  out.key("reason").string(error.reason).end_object().end_object();
  return {422, "application/json", std::move(out).text()};
}

protocol::Error refused(std::string field, std::string reason) {
  return {protocol::ErrorCode::invalid_params, std::move(field), std::move(reason)};
}

// Bounds what a scene may cost.
protocol::Expected<void> admit(protocol::SceneFile& scene) {
  if (scene.precision != protocol::Precision::double_precision) {
    return tl::unexpected(refused("/precision", "expected \"double\", got \"" +
                                                    std::string(name(scene.precision)) +
                                                    "\", which poolhall simulate runs"));
  }
  if (scene.options.contact == physics::ContactModel::hertz) {
    return tl::unexpected(refused(
        "/contact",
        "expected \"cluster\" or \"sequential\", got \"hertz\", which poolhall simulate runs"));
  }
  scene.options.event_limit = std::min(scene.options.event_limit, most_events);
  return {};
}

// What many samples left behind, by ball.
struct Cloud {
  struct BallCloud {
    std::vector<physics::Vec2<double>> rests;
    std::array<std::uint32_t, physics::pocket_count> pocketed{};
    bool moved = false;
  };
  std::array<BallCloud, physics::max_balls> balls;
  std::uint32_t samples = 0;
  std::uint32_t moved = 0;
  std::uint32_t unfinished = 0;
};

void add(Cloud& cloud, const physics::Scene<double>& scene,
         const physics::Simulation<double>& done) {
  ++cloud.samples;
  cloud.unfinished += done.ending == physics::Ending::event_limit ? 1U : 0U;
  for (std::size_t i = 0; i < scene.balls.count; ++i) {
    const physics::Ball<double>& before = scene.balls[i];
    const physics::Ball<double>& after = done.balls[i];
    Cloud::BallCloud& ball = cloud.balls[physics::number(after.id)];
    if (before.pocket) {
      continue;
    }
    if (after.pocket) {
      ++ball.pocketed[static_cast<std::size_t>(*after.pocket)];
    } else {
      ball.rests.push_back(after.position);
    }
    ball.moved = ball.moved || after.pocket || after.position.x != before.position.x ||
                 after.position.y != before.position.y;
  }
}

void write_ball(JsonWriter& out, unsigned id, const Cloud::BallCloud& ball) {
  out.begin_object().key("ball").integer(id);
  out.key("pocketed").begin_object();
  for (std::size_t p = 0; p < ball.pocketed.size(); ++p) {
    if (ball.pocketed[p] > 0) {
      out.key(physics::name(static_cast<physics::PocketId>(p))).integer(ball.pocketed[p]);
    }
  }
  out.end_object().key("x").begin_array();
  for (const auto& place : ball.rests) {
    out.number(place.x);
  }
  out.end_array().key("y").begin_array();
  for (const auto& place : ball.rests) {
    out.number(place.y);
  }
  out.end_array().end_object();
}

Page page_of(const Cloud& cloud) {
  JsonWriter out;
  out.begin_object().key("samples").integer(cloud.samples);
  out.key("moved").integer(cloud.moved).key("unfinished").integer(cloud.unfinished);
  out.key("balls").begin_array();
  for (unsigned id = 0; id < cloud.balls.size(); ++id) {
    if (cloud.balls[id].moved) {
      write_ball(out, id, cloud.balls[id]);
    }
  }
  out.end_array().end_object();
  return {200, "application/json", std::move(out).text()};
}

protocol::Expected<Cloud> play_samples(const protocol::EvaluationOrder& order) {
  physics::Scene<double> scene = protocol::scene_of(order.scene);
  if (const auto fine = physics::check_scene(scene); !fine) {
    return tl::unexpected(protocol::scene_error(fine.error()));
  }
  Cloud cloud;
  std::size_t events = 0;
  for (std::uint32_t i = 0; i < order.samples && events < most_sampled_events; ++i) {
    const protocol::ExecutedShot executed = protocol::executed_shot(
        *order.scene.shot, order.noise, physics::sample_deviates(order.seed, i), scene.balls,
        scene.table, scene.materials);
    scene.shot = protocol::to_physics(executed.params);
    const auto done = physics::simulate(scene, order.scene.options);
    if (!done) {
      return tl::unexpected(protocol::scene_error(done.error()));
    }
    events += done->events.size();
    cloud.moved += executed.moved ? 1U : 0U;
    add(cloud, scene, *done);
  }
  return cloud;
}

}  // namespace

Page simulate_page(std::string_view text) {
  auto scene = protocol::decode_scene(text);
  if (!scene) {
    return wrong(scene.error());
  }
  if (const auto admitted = admit(*scene); !admitted) {
    return wrong(admitted.error());
  }
  const auto done = physics::simulate(protocol::scene_of(*scene), scene->options);
  if (!done) {
    return wrong(protocol::scene_error(done.error()));
  }
  return {200, "application/json", protocol::encode_simulation(*done) + '\n'};
}

Page presets_page() {
  JsonWriter out;
  out.begin_object().key("tables").begin_array();
  for (const std::string& name : physics::preset_table_names()) {
    out.raw(protocol::encode_table(*physics::preset_table(name)));
  }
  out.end_array().key("physics").begin_array();
  for (const std::string& name : physics::preset_material_names()) {
    out.raw(protocol::encode_materials(*physics::preset_materials(name)));
  }
  out.end_array().key("noise").begin_array();
  for (const physics::NoisePreset& preset : physics::noise_presets()) {
    const auto& sigma = preset.deviations;
    out.begin_object().key("name").string(preset.name);
    out.key("a").number(sigma.a).key("b").number(sigma.b).key("theta").number(sigma.theta);
    out.key("phi").number(sigma.phi).key("v").number(sigma.v).end_object();
  }
  out.end_array().end_object();
  return {200, "application/json", std::move(out).text()};
}

Page evaluate_page(std::string_view text) {
  auto order = protocol::decode_evaluation(text, most_samples);
  if (!order) {
    return wrong(order.error());
  }
  if (const auto admitted = admit(order->scene); !admitted) {
    protocol::Error error = admitted.error();
    error.field = "/scene" + error.field;
    return wrong(error);
  }
  if (!order->scene.shot) {
    return wrong(refused("/scene/shot", "expected a shot, got none"));
  }
  const auto cloud = play_samples(*order);
  if (!cloud) {
    protocol::Error error = cloud.error();
    error.field = "/scene" + error.field;
    return wrong(error);
  }
  return page_of(*cloud);
}

}  // namespace poolhall::web
