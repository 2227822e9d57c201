// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/effect_keys.hpp"
#include "scene/scene_keys.hpp"
#include "scene/scene_records.hpp"
#include "scene/value_reader.hpp"
#include "tables/library.hpp"
#include "tables/nearest.hpp"

namespace tripoint {
namespace {

/// Phase of a body where the case does not say: by melting, else by the abilities of its material.
std::pair<Phase, std::string> phase_rule(const Material& m,
                                         const std::optional<TemperatureField>& temperature) {
  const Phase solid = m.solid == SolidKind::rigid ? Phase::rigid : Phase::elastic;
  const bool constant = temperature && temperature->kind == TemperatureField::Kind::constant;
  if (m.t_melt && constant) {
    if (temperature->value > *m.t_melt)
      return {Phase::liquid, fmt::format("its temperature is above t_melt = {} K", *m.t_melt)};
    return {solid,
            fmt::format("its temperature is not above t_melt = {} K, and its material is {} when solid",
                        *m.t_melt, to_string(m.solid))};
  }
  if (m.viscosity > 0.0 && !m.young_modulus)
    return {Phase::liquid, "its material has a viscosity and no young_modulus"};
  return {solid, fmt::format("its material is {} when solid", to_string(m.solid))};
}

/// The rotation of a body is that of its shape, about the same centre.
void turn(const TableReader& in, Shape& shape, const Quaternion& rotation) {
  if (shape.rotation != Quaternion{})
    in.refuse("rotation", "its shape has a rotation too: write one of them");
  if (shape.kind == Shape::Kind::half_space)
    in.refuse("rotation", "a half space has no centre to turn about: turn its normal");
  shape.rotation = rotation;
}

}  // namespace

void plain_name(TableReader& in, std::string_view key, const std::string& name) {
  const bool plain = !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.' || c == ' ';
  });
  if (!plain) in.refuse(key, "write a name of 1 to 64 letters, digits, blanks, or any of _ - .");
}

std::string entry_name(const TomlNode& node, std::size_t number) {
  const auto* name = node.find("name");
  return name && name->kind == TomlNode::Kind::text ? printable(name->text) : std::to_string(number);
}

Material read_material(const TomlNode& node, Reading& reading) {
  TableReader in(node, "material", "material." + entry_name(node, 1), reading.decisions, scene_keys());
  Material m;
  RecordReader read(in, m, reading);
  read("name");
  TomlNode library;
  if (const auto file = library_file(m.name); !file.empty()) {
    const TomlNode document = read_toml(file);
    if (const auto* values = document.find("material")) library = *values;
    const auto* source = library.find("source");
    in.fall_back_on(library, fmt::format("library, cases/materials/{}.toml{}", m.name,
                                         source ? ": " + source->text : ""));
  }
  read("density");
  read_effect_keys(in, "material", m, reading);
  static_cast<void>(in.maybe_text("source"));
  read.rest();
  for (const EffectRule& rule : effect_rules())
    if (rule.settle_material) rule.settle_material(in, m);
  if (read("solid")) {
    m.solid = m.young_modulus ? SolidKind::elastic : SolidKind::rigid;
    // A liquid that never freezes is no solid; the word then only names the solid that it would be.
    if (m.viscosity > 0.0 && !m.young_modulus && !m.t_melt) m.solid = SolidKind::elastic;
    in.ruled("solid", fmt::format("\"{}\"", to_string(m.solid)),
             m.young_modulus                 ? "young_modulus is given"
             : m.solid == SolidKind::elastic ? "a liquid that does not freeze"
                                             : "no young_modulus is given");
  }
  return m;
}

/// @throws InputError when the body's material is not among these
static const Material& material_named(TableReader& in, const std::string& name,
                                      const std::vector<Material>& materials) {
  const auto material = std::ranges::find(materials, name, &Material::name);
  if (material != materials.end()) return *material;
  auto known = library_names();
  for (const auto& m : materials) known.push_back(m.name);
  in.refuse("material",
            fmt::format("no material is named \"{}\"{}", printable(name), suggestion(name, known)));
}

/// @throws InputError when the velocities, keyframes and motion of a body contradict one another
static void refuse_other_motion(TableReader& in, const Body& b) {
  const bool has_velocity = in.has("velocity") || in.has("angular_velocity");
  const std::string velocity = in.has("velocity") ? "velocity" : "angular_velocity";
  if (!b.keyframes.empty() && has_velocity)
    in.refuse(velocity, "the keyframes of the body give its velocities: remove it, or the keyframes");
  if (!b.keyframes.empty() && b.motion != Motion::prescribed)
    in.refuse("keyframes", "only a prescribed body follows keyframes: write motion = \"prescribed\"");
  if (b.motion == Motion::fixed && has_velocity)
    in.refuse(velocity, "a fixed body does not move: remove it, or write motion = \"prescribed\"");
  if (b.phase == Phase::rigid && b.velocity.kind != VelocityField::Kind::constant)
    in.refuse("velocity", "a rigid body has one velocity: write [x, y, z] and angular_velocity");
}

Body read_body(const TomlNode& node, const std::vector<Material>& materials, Reading& reading) {
  TableReader in(node, "body", "body." + entry_name(node, 1), reading.decisions, scene_keys());
  Body b;
  b.place = node.place;
  RecordReader read(in, b, reading);
  read("name");
  plain_name(in, "name", b.name);
  read("material");
  const Material& material = material_named(in, b.material, materials);
  read("shape");
  if (const auto q = in.maybe_numbers("rotation")) turn(in, b.shape, unit_quaternion(in, "rotation", *q));
  read("temperature");
  if (read("phase")) {
    const auto [found, why] = phase_rule(material, b.temperature);
    b.phase = found;
    in.ruled("phase", fmt::format("\"{}\"", to_string(found)), why);
  }
  if (b.phase == Phase::elastic && !material.young_modulus)
    in.refuse(in.has("phase") ? "phase" : "material",
              fmt::format("an elastic body needs young_modulus and poisson_ratio of its material \"{}\": "
                          "give them, or write phase = \"rigid\"",
                          b.material));
  for (const char* key : {"velocity", "angular_velocity", "temperature_held"}) read(key);
  if (b.temperature_held && !b.temperature)
    in.refuse("temperature_held", "no temperature is given to hold: give temperature too");
  read("motion");
  read("keyframes");
  refuse_other_motion(in, b);
  read("slip");
  if (read("joins")) {
    b.joins = material.t_melt.has_value();
    in.ruled("joins", b.joins ? "true" : "false",
             b.joins ? "its material melts" : "its material does not melt");
  }
  read.rest();
  return b;
}

std::vector<Keyframe> read_keyframes(TableReader& owner, const Key& key, Reading& reading) {
  std::vector<Keyframe> frames;
  const auto list = owner.tables(key.name);
  for (std::size_t i = 0; i < list.size(); ++i) {
    TableReader in(*list[i], "keyframe", fmt::format("{}.{}.{}", owner.path(), key.name, i + 1),
                   reading.decisions, scene_keys());
    Keyframe k;
    RecordReader(in, k, reading).all();
    if (!frames.empty() && !(k.time > frames.back().time))
      in.refuse("time", fmt::format("{} s is not after the keyframe before it ({} s): times must rise",
                                    k.time, frames.back().time));
    frames.push_back(k);
  }
  if (list.empty()) owner.ruled(key.name, std::string(key.fallback), std::string(key.note));
  return frames;
}

/// A key that this kind of event does not read would be lost without a word.
static void refuse_keys_of_others(TableReader& in, const std::string& kind) {
  const std::vector<std::pair<std::string_view, std::string_view>> readers{
      {"bodies", "merge split release heat hold"},
      {"region", "split heat grip"},
      {"temperature", "heat"},
      {"until", "heat hold grip"},
      {"keyframes", "grip"}};
  for (const auto& [key, kinds] : readers) {
    const auto known = split_words(kinds);
    if (in.has(key) && std::find(known.begin(), known.end(), kind) == known.end())
      in.refuse(key, fmt::format("a {} event does not read it ({} {}): remove it", kind,
                                 fmt::join(known, ", "), known.size() == 1 ? "does" : "do"));
  }
}

Event read_event(const TomlNode& node, std::size_t number, Reading& reading) {
  TableReader in(node, "event", fmt::format("event.{}", entry_name(node, number)), reading.decisions,
                 scene_keys());
  Event e;
  e.place = node.place;
  RecordReader(in, e, reading).all();
  const auto kind = split_words(key_row("event", "kind").words).at(static_cast<std::size_t>(e.kind));
  if (e.until && !(*e.until > e.time))
    in.refuse("until", "the event ends before it begins: until must be greater than time");
  const auto needs = [&](bool there, std::string_view key) {
    if (!there) in.refuse("", fmt::format("a {} event needs the key `{}`", kind, key));
  };
  if (e.kind == Event::Kind::merge && e.bodies.size() < 2)
    in.refuse(
        "bodies",
        "a merge needs at least two bodies: name another one, which bodies[0] absorbs, or remove the event");
  if (e.kind == Event::Kind::split) {
    needs(e.region.has_value(), "region");
    needs(!e.name.empty(), "name");
  }
  if (e.kind == Event::Kind::heat) {
    needs(e.temperature.has_value(), "temperature");
    needs(e.region || !e.bodies.empty(), "region` or `bodies");
  }
  if (e.kind == Event::Kind::grip) {
    needs(e.region.has_value(), "region");
    needs(!e.keyframes.empty(), "keyframes");
  }
  if (e.kind == Event::Kind::hold) needs(!e.bodies.empty(), "bodies");
  if (e.kind == Event::Kind::release) needs(!e.bodies.empty(), "bodies");
  refuse_keys_of_others(in, kind);
  if (!e.keyframes.empty() && e.keyframes.front().time < e.time)
    in.refuse(
        "keyframes",
        fmt::format("the first is at {} s and the grip begins at {} s: what it takes would jump to where the "
                    "grip is by then; begin with a keyframe at {} s",
                    e.keyframes.front().time, e.time, e.time));
  return e;
}

Inflow read_inflow(const TomlNode& node, std::size_t number, double end_time, Reading& reading) {
  TableReader in(node, "inflow", fmt::format("inflow.{}", number), reading.decisions, scene_keys());
  Inflow f;
  RecordReader(in, f, reading).all([&](std::string_view key) {
    if (key == "stop") {
      f.stop = end_time;
      in.ruled("stop", show(end_time), "end_time");
    }
  });
  if (!(norm(f.velocity) > 0.0))
    in.refuse("velocity",
              "nothing flows in at rest: give a velocity, its direction serves where rate is given");
  if (!(f.stop > f.start)) in.refuse("stop", "it ends before it begins: stop must be greater than start");
  return f;
}

Outflow read_outflow(const TomlNode& node, std::size_t number, Reading& reading) {
  TableReader in(node, "outflow", fmt::format("outflow.{}", number), reading.decisions, scene_keys());
  Outflow f;
  f.place = node.place;
  RecordReader(in, f, reading).all();
  return f;
}

ContactLaw read_contact_law(const TomlNode& node, std::size_t number, Reading& reading) {
  TableReader in(node, "contact", fmt::format("contact.{}", number), reading.decisions, scene_keys());
  ContactLaw law;
  law.place = node.place;
  law.materials = in.texts("materials", Repeats::allowed);
  if (law.materials.size() != 2)
    in.refuse("materials", "write the two materials that meet, the same one twice for bodies of one");
  law.friction = in.maybe_number("friction");
  law.restitution = in.maybe_number("restitution");
  if (!law.friction && !law.restitution)
    in.refuse("materials", "give the friction or the restitution of the pair, or both");
  return law;
}

AppliedForce read_force(const TomlNode& node, std::size_t number, Reading& reading) {
  TableReader in(node, "force", fmt::format("force.{}", number), reading.decisions, scene_keys());
  AppliedForce force;
  force.place = node.place;
  RecordReader(in, force, reading).all();
  if (force.value == Vec3{} && force.torque == Vec3{})
    in.refuse("", "it does nothing: give value, torque or both");
  if (force.stop && !(*force.stop > force.start))
    in.refuse("stop", "it ends before it begins: stop must be greater than start");
  return force;
}

Spring read_spring(const TomlNode& node, std::size_t number, Reading& reading) {
  TableReader in(node, "spring", fmt::format("spring.{}", number), reading.decisions, scene_keys());
  Spring s;
  s.place = node.place;
  RecordReader(in, s, reading).all();
  if (s.stiffness == 0.0 && s.damping == 0.0)
    in.refuse("", "it does nothing: give stiffness, damping or both");
  if (s.body == s.other) in.refuse("other", "it holds a body to itself: name another, or \"world\"");
  if (norm(s.point - s.other_point) == 0.0)
    in.refuse("other_point", "the points coincide at the start, and the force has no direction: part them");
  return s;
}

HeatSource read_source(const TomlNode& node, std::size_t number, double end_time, Reading& reading) {
  TableReader in(node, "source", fmt::format("source.{}", number), reading.decisions, scene_keys());
  HeatSource s;
  s.place = node.place;
  RecordReader(in, s, reading).all([&](std::string_view key) {
    if (key != "stop") return;
    s.stop = end_time;
    in.ruled("stop", show(end_time), "end_time");
  });
  if (!(s.stop > s.start)) in.refuse("stop", "it ends before it begins: stop must be greater than start");
  if (int{s.heat.has_value()} + int{s.density.has_value()} + int{s.is_of_surfaces()} != 1)
    in.refuse(
        "",
        "write heat, heat_density, or what goes through surfaces: flux, transfer_coefficient, emissivity");
  if ((s.transfer_coefficient || s.emissivity) && !s.ambient)
    in.refuse("", "convection and radiation need ambient_temperature");
  if (s.ambient && !s.transfer_coefficient && !s.emissivity)
    in.refuse("ambient_temperature",
              "only convection and radiation read it: give transfer_coefficient or emissivity");
  return s;
}

}  // namespace tripoint
