#include "protocol/table_json.hpp"

#include "protocol/json_parts.hpp"

namespace poolhall::protocol {
namespace {

void write_jaw_pocket(JsonWriter& out, const physics::JawPocket& pocket) {
  out.begin_object().key("width").number(pocket.width).key("angle").number(pocket.angle);
  out.key("depth").number(pocket.depth).key("radius").number(pocket.radius);
  out.key("jaw_radius").number(pocket.jaw_radius).end_object();
}

struct PocketsWriter {
  JsonWriter& out;
  void operator()(const physics::NoPockets&) const { out.string("none"); }
  void operator()(const physics::MouthLines& mouths) const {
    out.begin_object().key("kind").string("mouth_lines");
    out.key("corner").number(mouths.corner).key("side").number(mouths.side).end_object();
  }
  void operator()(const physics::Jaws& jaws) const {
    out.begin_object().key("kind").string("jaws");
    out.key("cushion_width").number(jaws.cushion_width).key("corner");
    write_jaw_pocket(out, jaws.corner);
    out.key("side");
    write_jaw_pocket(out, jaws.side);
    out.end_object();
  }
};

void refuse_unknown(const JsonNode& node, UnknownKeys unknown,
                    std::initializer_list<std::string_view> known) {
  if (unknown == UnknownKeys::refused) {
    node.only(known);
  }
}

physics::JawPocket read_jaw_pocket(const JsonNode& node, UnknownKeys unknown) {
  refuse_unknown(node, unknown, {"width", "angle", "depth", "radius", "jaw_radius"});
  return {node.at("width").number(), node.at("angle").number(), node.at("depth").number(),
          node.at("radius").number(), node.at("jaw_radius").number()};
}

physics::Pockets read_pockets(const JsonNode& node, UnknownKeys unknown) {
  if (node.is_string("none")) {
    return physics::NoPockets{};
  }
  if (!node.is_object()) {
    node.refuse_expecting("\"none\" or an object with \"kind\"");
    return physics::NoPockets{};
  }
  const JsonNode kind = node.at("kind");
  if (kind.is_string("mouth_lines")) {
    refuse_unknown(node, unknown, {"kind", "corner", "side"});
    return physics::MouthLines{node.at("corner").number(), node.at("side").number()};
  }
  if (kind.is_string("jaws")) {
    refuse_unknown(node, unknown, {"kind", "cushion_width", "corner", "side"});
    return physics::Jaws{node.at("cushion_width").number(),
                         read_jaw_pocket(node.at("corner"), unknown),
                         read_jaw_pocket(node.at("side"), unknown)};
  }
  kind.refuse_expecting("\"mouth_lines\" or \"jaws\"");
  return physics::NoPockets{};
}

std::string names_of(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) {
    list += list.empty() ? "" : ", ";
    list += '"' + name + '"';
  }
  return list;
}

// `other` is what may stand in the name's place.
physics::Table table_of_preset(const JsonNode& node, const std::string& other = "") {
  return node.one_of(physics::preset_table,
                     other + "one of " + names_of(physics::preset_table_names()));
}

physics::Materials materials_of_preset(const JsonNode& node, const std::string& other = "") {
  return node.one_of(physics::preset_materials,
                     other + "one of " + names_of(physics::preset_material_names()));
}

void read_spots(const JsonNode& node, physics::Table& table) {
  if (const auto head_string = node.find("head_string")) {
    table.head_string = head_string->number();
  }
  if (const auto spot = node.find("foot_spot")) {
    const physics::Vec2<double> point = read_point(*spot);
    table.foot_spot_x = point.x;
    table.foot_spot_y = point.y;
  }
}

physics::Table inline_table(const JsonNode& node) {
  physics::Table table;
  table.name = "";
  table.width = node.at("width").number();
  table.length = node.at("length").number();
  table.head_string = table.length / 4;
  table.foot_spot_x = table.width / 2;
  table.foot_spot_y = 3 * table.length / 4;
  return table;
}

void read_number(const JsonNode& node, std::string_view key, double& value) {
  if (const auto member = node.find(key)) {
    value = member->number();
  }
}

// Unset stays, null unsets.
void read_optional(const JsonNode& node, std::string_view key, std::optional<double>& value) {
  if (node.value() == nullptr || node.value()->member(key) == nullptr) {
    return;
  }
  const auto member = node.find(key);
  value = member ? std::optional(member->number()) : std::nullopt;
}

struct CushionWriter {
  JsonWriter& out;
  void operator()(const physics::DampedCushion& c) const {
    out.key("model").string("damped").key("normal").number(c.normal);
    out.key("tangential").number(c.tangential).key("spin").number(c.spin);
  }
  void operator()(const physics::Han2005Cushion& c) const {
    out.key("model").string("han2005");
    restitution_and_friction(c);
  }
  void operator()(const physics::Mathavan2010Cushion& c) const {
    out.key("model").string("mathavan2010");
    restitution_and_friction(c);
  }
  void operator()(const physics::SpringCushion& c) const {
    out.key("model").string("spring").key("stiffness").number(c.stiffness);
    out.key("damping_ratio").number(c.damping_ratio).key("friction").number(c.friction);
    nose_height(c.nose_height);
  }
  template <class Cushion>
  void restitution_and_friction(const Cushion& c) const {
    out.key("restitution").number(c.restitution).key("friction").number(c.friction);
    nose_height(c.nose_height);
  }
  void nose_height(const std::optional<double>& height) const {
    if (height) {
      out.key("nose_height").number(*height);
    }
  }
};

// The model's values as they were, if the cushion is of that model, else its defaults.
template <class Model>
Model start_from(const physics::Cushion& before) {
  const auto* same = std::get_if<Model>(&before);
  return same == nullptr ? Model{} : *same;
}

physics::DampedCushion read_damped(const JsonNode& node, physics::DampedCushion cushion) {
  read_number(node, "normal", cushion.normal);
  read_number(node, "tangential", cushion.tangential);
  read_number(node, "spin", cushion.spin);
  return cushion;
}

template <class Model>
Model read_restitution_model(const JsonNode& node, Model cushion) {
  read_number(node, "restitution", cushion.restitution);
  read_number(node, "friction", cushion.friction);
  read_optional(node, "nose_height", cushion.nose_height);
  return cushion;
}

physics::SpringCushion read_spring(const JsonNode& node, physics::SpringCushion cushion) {
  read_number(node, "stiffness", cushion.stiffness);
  read_number(node, "damping_ratio", cushion.damping_ratio);
  read_number(node, "friction", cushion.friction);
  read_optional(node, "nose_height", cushion.nose_height);
  return cushion;
}

physics::Cushion read_cushion(const JsonNode& node, const physics::Cushion& before,
                              UnknownKeys unknown) {
  const JsonNode model = node.at("model");
  if (model.is_string("damped")) {
    refuse_unknown(node, unknown, {"model", "normal", "tangential", "spin"});
    return read_damped(node, start_from<physics::DampedCushion>(before));
  }
  if (model.is_string("spring")) {
    refuse_unknown(node, unknown,
                   {"model", "stiffness", "damping_ratio", "friction", "nose_height"});
    return read_spring(node, start_from<physics::SpringCushion>(before));
  }
  refuse_unknown(node, unknown, {"model", "restitution", "friction", "nose_height"});
  if (model.is_string("han2005")) {
    return read_restitution_model(node, start_from<physics::Han2005Cushion>(before));
  }
  if (model.is_string("mathavan2010")) {
    return read_restitution_model(node, start_from<physics::Mathavan2010Cushion>(before));
  }
  model.refuse_expecting("\"damped\", \"han2005\", \"mathavan2010\" or \"spring\"");
  return before;
}

void read_spin_decay(const JsonNode& node, physics::Materials& materials) {
  const auto mu_spin = node.find("mu_spin");
  const auto deceleration = node.find("spin_deceleration");
  if (mu_spin && deceleration) {
    deceleration->refuse("stands beside mu_spin; expected only one of the two");
    return;
  }
  if (mu_spin) {
    materials.spin_deceleration.reset();
  } else if (deceleration) {
    materials.mu_spin.reset();
  }
  read_optional(node, "mu_spin", materials.mu_spin);
  read_optional(node, "spin_deceleration", materials.spin_deceleration);
}

void read_material_numbers(const JsonNode& node, physics::Materials& m) {
  read_number(node, "gravity", m.gravity);
  read_number(node, "ball_radius", m.ball_radius);
  read_number(node, "ball_mass", m.ball_mass);
  read_number(node, "mu_slide", m.mu_slide);
  read_number(node, "mu_roll", m.mu_roll);
  read_number(node, "ball_restitution", m.ball_restitution);
  read_number(node, "cue_mass", m.cue_mass);
  read_number(node, "tip_restitution", m.tip_restitution);
  read_number(node, "squirt_end_mass_ratio", m.squirt_end_mass_ratio);
  read_number(node, "miscue_limit", m.miscue_limit);
  read_number(node, "max_cue_speed", m.max_cue_speed);
  read_number(node, "separation_speed", m.separation_speed);
}

void read_ball_friction(const JsonNode& node, physics::Materials& materials) {
  const auto friction = node.find("ball_friction");
  if (!friction) {
    return;
  }
  if (friction->is_string("alciatore")) {
    materials.ball_friction = physics::AlciatoreFriction{};
  } else if (friction->value()->as<std::string>() != nullptr) {
    friction->refuse_expecting("a number or \"alciatore\"");
  } else {
    materials.ball_friction = physics::ConstantFriction{friction->number()};
  }
}

}  // namespace

physics::Table read_table(const JsonNode& node, UnknownKeys unknown) {
  if (!node.is_object()) {
    return table_of_preset(node, "an object or ");
  }
  refuse_unknown(
      node, unknown,
      {"preset", "name", "width", "length", "pockets", "nose_height", "head_string", "foot_spot"});
  const auto preset = node.find("preset");
  physics::Table table = preset ? table_of_preset(*preset) : inline_table(node);
  read_number(node, "width", table.width);
  read_number(node, "length", table.length);
  if (const auto pockets = preset ? node.find("pockets") : std::optional(node.at("pockets"))) {
    table.pockets = read_pockets(*pockets, unknown);
  }
  if (const auto name = node.find("name")) {
    table.name = name->string();
  }
  read_optional(node, "nose_height", table.nose_height);
  read_spots(node, table);
  return table;
}

physics::Materials read_materials(const JsonNode& node, UnknownKeys unknown) {
  if (!node.is_object()) {
    return materials_of_preset(node, "an object or ");
  }
  refuse_unknown(node, unknown,
                 {"preset", "name", "gravity", "ball_radius", "ball_mass", "mu_slide", "mu_roll",
                  "mu_spin", "spin_deceleration", "ball_restitution", "ball_friction", "cushion",
                  "cue_mass", "tip_restitution", "squirt_end_mass_ratio", "miscue_limit",
                  "max_cue_speed", "separation_speed"});
  physics::Materials materials;
  if (const auto preset = node.find("preset")) {
    materials = materials_of_preset(*preset);
  }
  if (const auto name = node.find("name")) {
    materials.name = name->string();
  }
  read_material_numbers(node, materials);
  read_spin_decay(node, materials);
  read_ball_friction(node, materials);
  if (const auto cushion = node.find("cushion")) {
    materials.cushion = read_cushion(*cushion, materials.cushion, unknown);
  }
  return materials;
}

std::string encode_table(const physics::Table& table) {
  JsonWriter out;
  out.begin_object().key("name").string(table.name).key("width").number(table.width);
  out.key("length").number(table.length).key("pockets");
  std::visit(PocketsWriter{out}, table.pockets);
  if (table.nose_height) {
    out.key("nose_height").number(*table.nose_height);
  }
  out.key("head_string").number(table.head_string).key("foot_spot");
  write_point(out, {table.foot_spot_x, table.foot_spot_y});
  out.end_object();
  return std::move(out).text();
}

Expected<physics::Table> decode_table(std::string_view text) {
  return read_document(text, document_bounds,
                       [](const JsonNode& node) { return read_table(node, UnknownKeys::refused); });
}

std::string encode_materials(const physics::Materials& m) {
  JsonWriter out;
  out.begin_object().key("name").string(m.name).key("gravity").number(m.gravity);
  out.key("ball_radius").number(m.ball_radius).key("ball_mass").number(m.ball_mass);
  out.key("mu_slide").number(m.mu_slide).key("mu_roll").number(m.mu_roll);
  if (m.spin_deceleration) {
    out.key("spin_deceleration").number(*m.spin_deceleration);
  } else if (m.mu_spin) {
    out.key("mu_spin").number(*m.mu_spin);
  } else {
    out.key("mu_spin").null();
  }
  out.key("ball_restitution").number(m.ball_restitution).key("ball_friction");
  if (const auto* constant = std::get_if<physics::ConstantFriction>(&m.ball_friction)) {
    out.number(constant->coefficient);
  } else {
    out.string("alciatore");
  }
  out.key("cushion").begin_object();
  std::visit(CushionWriter{out}, m.cushion);
  out.end_object().key("cue_mass").number(m.cue_mass);
  out.key("tip_restitution").number(m.tip_restitution);
  out.key("squirt_end_mass_ratio").number(m.squirt_end_mass_ratio);
  out.key("miscue_limit").number(m.miscue_limit).key("max_cue_speed").number(m.max_cue_speed);
  out.key("separation_speed").number(m.separation_speed).end_object();
  return std::move(out).text();
}

Expected<physics::Materials> decode_materials(std::string_view text) {
  return read_document(text, document_bounds, [](const JsonNode& node) {
    return read_materials(node, UnknownKeys::refused);
  });
}

}  // namespace poolhall::protocol
