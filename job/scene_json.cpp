// SPDX-License-Identifier: BSD-3-Clause
#include "job/scene_json.hpp"

#include <nlohmann/json.hpp>

#include "scene/effect_keys.hpp"

namespace tripoint {
namespace {

using json = nlohmann::ordered_json;

constexpr const char* shape_kinds[] = {"box", "sphere", "cylinder", "half_space", "union", "difference", "mesh"};
constexpr const char* temperature_kinds[] = {"constant", "cosine", "step", "expression"};
constexpr const char* velocity_kinds[] = {"constant", "cosine", "linear", "taylor_green", "expression"};
constexpr const char* event_kinds[] = {"merge", "split", "release", "heat", "hold", "grip"};
constexpr const char* axes[] = {"x", "y", "z"};

template <class Kind, std::size_t n>
Kind kind_from(const JsonObject& o, const char* const (&words)[n]) {
  const std::string word = o.text("kind");
  for (std::size_t k = 0; k < n; ++k)
    if (word == words[k]) return static_cast<Kind>(k);
  throw InputError(o.path() + ".kind: \"" + word + "\" is unknown");
}

template <class T>
json maybe(const std::optional<T>& v) {
  return v ? json(*v) : json(nullptr);
}
json maybe(const std::optional<Vec3>& v) { return v ? to_json(*v) : json(nullptr); }

// --- shapes -----------------------------------------------------------------------------------------------------------

json to_json(const Shape& s) {
  json out{{"kind", shape_kinds[static_cast<int>(s.kind)]}};
  switch (s.kind) {
    case Shape::Kind::box:
      out["min"] = to_json(s.min), out["max"] = to_json(s.max);
      break;
    case Shape::Kind::sphere:
      out["centre"] = to_json(s.centre), out["radius"] = s.radius;
      break;
    case Shape::Kind::cylinder:
      out["base"] = to_json(s.base), out["axis"] = to_json(s.axis), out["length"] = s.length, out["radius"] = s.radius;
      break;
    case Shape::Kind::half_space:
      out["point"] = to_json(s.point), out["normal"] = to_json(s.normal);
      break;
    case Shape::Kind::mesh:
      out["file"] = s.file, out["scale"] = s.scale;
      break;
    case Shape::Kind::unite:
    case Shape::Kind::difference:
      out["of"] = json::array();
      for (const Shape& part : s.of) out["of"].push_back(to_json(part));
  }
  return out;
}

Shape shape_from(const JsonObject& o) {
  Shape s;
  s.kind = kind_from<Shape::Kind>(o, shape_kinds);
  switch (s.kind) {
    case Shape::Kind::box:
      s.min = o.vector("min"), s.max = o.vector("max");
      break;
    case Shape::Kind::sphere:
      s.centre = o.vector("centre"), s.radius = o.number("radius");
      break;
    case Shape::Kind::cylinder:
      s.base = o.vector("base"), s.axis = o.vector("axis"), s.length = o.number("length"), s.radius = o.number("radius");
      break;
    case Shape::Kind::half_space:
      s.point = o.vector("point"), s.normal = o.vector("normal");
      break;
    case Shape::Kind::mesh:
      s.file = o.text("file"), s.scale = o.number("scale");
      break;
    case Shape::Kind::unite:
    case Shape::Kind::difference:
      for (const JsonObject& part : o.objects("of")) s.of.push_back(shape_from(part));
  }
  return s;
}

// --- fields of the start ----------------------------------------------------------------------------------------------

json to_json(const TemperatureField& t) {
  json out{{"kind", temperature_kinds[static_cast<int>(t.kind)]}};
  switch (t.kind) {
    case TemperatureField::Kind::constant:
      out["value"] = t.value;
      break;
    case TemperatureField::Kind::cosine:
      out["mean"] = t.mean, out["amplitude"] = t.amplitude, out["wave_vector"] = to_json(t.wave_vector), out["phase"] = t.phase;
      break;
    case TemperatureField::Kind::step:
      out["point"] = to_json(t.point), out["normal"] = to_json(t.normal), out["behind"] = t.behind, out["ahead"] = t.ahead;
      break;
    case TemperatureField::Kind::expression:
      out["value"] = t.expression;
  }
  return out;
}

TemperatureField temperature_from(const JsonObject& o) {
  TemperatureField t;
  t.kind = kind_from<TemperatureField::Kind>(o, temperature_kinds);
  switch (t.kind) {
    case TemperatureField::Kind::constant:
      t.value = o.number("value");
      break;
    case TemperatureField::Kind::cosine:
      t.mean = o.number("mean"), t.amplitude = o.number("amplitude"), t.wave_vector = o.vector("wave_vector"),
      t.phase = o.number("phase");
      break;
    case TemperatureField::Kind::step:
      t.point = o.vector("point"), t.normal = o.vector("normal"), t.behind = o.number("behind"), t.ahead = o.number("ahead");
      break;
    case TemperatureField::Kind::expression:
      t.expression = o.text("value");
  }
  return t;
}

json to_json(const VelocityField& v) {
  json out{{"kind", velocity_kinds[static_cast<int>(v.kind)]}};
  switch (v.kind) {
    case VelocityField::Kind::constant:
      out["value"] = to_json(v.value);
      break;
    case VelocityField::Kind::cosine:
      out["mean"] = to_json(v.mean), out["amplitude"] = to_json(v.amplitude), out["wave_vector"] = to_json(v.wave_vector),
      out["phase"] = v.phase;
      break;
    case VelocityField::Kind::linear:
      out["centre"] = to_json(v.centre);
      out["gradient"] = json::array({to_json(v.gradient[0]), to_json(v.gradient[1]), to_json(v.gradient[2])});
      break;
    case VelocityField::Kind::taylor_green:
      out["speed"] = v.speed, out["wavelength"] = v.wavelength;
      break;
    case VelocityField::Kind::expression:
      out["value"] = v.expression;
  }
  return out;
}

// The gradient travels as three rows; JsonObject reads flat lists, so each row is read by its own key-less path here.
std::array<Vec3, 3> rows_from(const json& value, const std::string& path) {
  std::array<Vec3, 3> rows{};
  if (!value.is_array() || value.size() != 3) throw InputError(path + ": expected 3 rows of 3 numbers");
  for (std::size_t i = 0; i < 3; ++i) {
    const json wrapped{{"row", value[i]}};
    rows[i] = JsonObject(wrapped, path).vector("row");
  }
  return rows;
}

VelocityField velocity_from(const json& value, const std::string& path) {
  const JsonObject o(value, path);
  VelocityField v;
  v.kind = kind_from<VelocityField::Kind>(o, velocity_kinds);
  switch (v.kind) {
    case VelocityField::Kind::constant:
      v.value = o.vector("value");
      break;
    case VelocityField::Kind::cosine:
      v.mean = o.vector("mean"), v.amplitude = o.vector("amplitude"), v.wave_vector = o.vector("wave_vector"),
      v.phase = o.number("phase");
      break;
    case VelocityField::Kind::linear:
      v.centre = o.vector("centre"), v.gradient = rows_from(value.value("gradient", json()), path + ".gradient");
      break;
    case VelocityField::Kind::taylor_green:
      v.speed = o.number("speed"), v.wavelength = o.number("wavelength");
      break;
    case VelocityField::Kind::expression: {
      const std::vector<std::string> parts = o.texts("value");
      if (parts.size() != 3) throw InputError(path + ".value: expected 3 expressions");
      for (std::size_t k = 0; k < 3; ++k) v.expression[k] = parts[k];
    }
  }
  return v;
}

json to_json(const std::vector<Keyframe>& frames) {
  json out = json::array();
  for (const Keyframe& k : frames)
    out.push_back({{"time", k.time}, {"position", to_json(k.position)}, {"rotation", to_json(k.rotation)}});
  return out;
}

std::vector<Keyframe> keyframes_from(const JsonObject& o) {
  std::vector<Keyframe> frames;
  for (const JsonObject& k : o.objects("keyframes"))
    frames.push_back({k.number("time"), k.vector("position"), k.quaternion("rotation")});
  return frames;
}

// --- materials, bodies, events ----------------------------------------------------------------------------------------

/// Values of keys that effects bring, as they are kept in a scene or a material.
template <class Owner>
void add_effect_values(const Owner& owner, std::string_view table, json& out) {
  each_effect_key(owner, table, [&]<class T>(const Key& key, const T& value) {
    if constexpr (std::is_same_v<T, std::optional<double>>)
      out[std::string(key.name)] = maybe(value);
    else
      out[std::string(key.name)] = value;
  });
}

/// What is not there stays as the owner has it.
template <class Owner>
void take_effect_values(const JsonObject& o, std::string_view table, Owner& owner) {
  each_effect_key(owner, table, [&]<class T>(const Key& row, T& value) {
    const std::string key(row.name);
    if constexpr (std::is_same_v<T, double>)
      value = o.number_or(key, value);
    else if constexpr (std::is_same_v<T, bool>)
      value = o.flag_or(key, value);
    else if constexpr (std::is_same_v<T, std::string>)
      value = o.text_or(key, value);
    else
      value = o.maybe_number(key);
  });
}

json to_json(const Material& m) {
  json out{{"name", m.name},
           {"density", m.density},
           {"solid", m.solid},
           {"stiffness", maybe(m.stiffness)},
           {"solid_conductivity", maybe(m.solid_conductivity)},
           {"solid_heat_capacity", maybe(m.solid_heat_capacity)}};
  add_effect_values(m, "material", out);
  return out;
}

Material material_from(const JsonObject& o) {
  Material m;
  m.name = o.text("name");
  m.density = o.number("density");
  m.solid = o.text_or("solid", "elastic");
  m.stiffness = o.maybe_number("stiffness");
  m.solid_conductivity = o.maybe_number("solid_conductivity"), m.solid_heat_capacity = o.maybe_number("solid_heat_capacity");
  take_effect_values(o, "material", m);
  return m;
}

json to_json(const Body& b, const JobBody& j) {
  const MassProperties& p = j.properties;
  return {{"name", b.name},
          {"index", j.index},
          {"material", b.material},
          {"phase", to_string(b.phase)},
          {"motion", to_string(b.motion)},
          {"keyframes", to_json(b.keyframes)},
          {"temperature_held", b.temperature_held},
          {"mass", p.mass},
          {"centre", to_json(p.centre)},
          {"principal_inertia", to_json(p.principal_inertia)},
          {"principal_axes", to_json(p.principal_axes)},
          {"orientation", to_json(j.orientation)},
          {"velocity", to_json(j.velocity)},
          {"angular_velocity", to_json(j.angular_velocity)},
          {"velocity_field", to_json(b.velocity)},
          {"temperature", b.temperature ? to_json(*b.temperature) : json(nullptr)},
          {"shape", to_json(b.shape)},
          {"slip", b.free_slip ? "free" : "no"},
          {"joins", b.joins},
          {"joined_to", b.joined_to}};
}

void body_from(const json& value, const JsonObject& o, Scene& scene, std::vector<JobBody>& bodies) {
  Body b;
  b.name = o.text("name");
  b.material = o.text("material");
  b.phase = phase_from(o.text("phase"));
  b.motion = motion_from(o.text("motion"));
  b.keyframes = keyframes_from(o);
  b.temperature_held = o.flag_or("temperature_held", false);
  if (o.has("temperature")) b.temperature = temperature_from(o.object("temperature"));
  if (o.has("velocity_field"))
    b.velocity = velocity_from(value["velocity_field"], o.path() + ".velocity_field");
  else
    b.velocity.value = o.vector("velocity");
  b.angular_velocity = o.vector("angular_velocity");
  if (o.has("shape")) b.shape = shape_from(o.object("shape"));
  b.free_slip = o.text_or("slip", "no") == "free";
  b.joins = o.flag_or("joins", false);
  b.joined_to = o.texts("joined_to");

  JobBody j;
  j.name = b.name;
  j.material = b.material;
  j.index = static_cast<int>(o.integer("index"));
  j.phase = b.phase;
  j.motion = b.motion;
  j.keyframes = b.keyframes;
  j.temperature_held = b.temperature_held;
  j.properties = {o.number("mass"), o.vector("centre"), o.vector("principal_inertia"), o.quaternion("principal_axes")};
  j.orientation = o.quaternion("orientation");
  j.velocity = o.vector("velocity");
  j.angular_velocity = o.vector("angular_velocity");
  scene.bodies.push_back(std::move(b));
  bodies.push_back(std::move(j));
}

json to_json(const Event& e) {
  return {{"kind", event_kinds[static_cast<int>(e.kind)]},
          {"time", e.time},
          {"name", e.name},
          {"bodies", e.bodies},
          {"region", e.region ? to_json(*e.region) : json(nullptr)},
          {"temperature", maybe(e.temperature)},
          {"until", maybe(e.until)},
          {"keyframes", to_json(e.keyframes)}};
}

Event event_from(const JsonObject& o) {
  Event e;
  e.kind = kind_from<Event::Kind>(o, event_kinds);
  e.time = o.number("time");
  e.name = o.text_or("name", "");
  e.bodies = o.texts("bodies");
  if (o.has("region")) e.region = shape_from(o.object("region"));
  e.temperature = o.maybe_number("temperature");
  e.until = o.maybe_number("until");
  e.keyframes = keyframes_from(o);
  return e;
}

json to_json(const Inflow& f) {
  return {{"material", f.material},
          {"shape", to_json(f.shape)},
          {"velocity", to_json(f.velocity)},
          {"temperature", maybe(f.temperature)},
          {"start", f.start},
          {"stop", f.stop},
          {"rate", maybe(f.rate)}};
}

Inflow inflow_from(const JsonObject& o) {
  return {
      o.text("material"), shape_from(o.object("shape")), o.vector("velocity"), o.maybe_number("temperature"), o.number("start"),
      o.number("stop"),   o.maybe_number("rate")};
}

}  // namespace

json scene_to_json(const Scene& s, const std::vector<JobBody>& bodies) {
  json periodic = json::array(), modes = json::object();
  for (std::size_t k = 0; k < 3; ++k)
    if (s.periodic[k]) periodic.push_back(axes[k]);
  for (std::size_t k = 0; k < term_count; ++k) modes[std::string(to_string(static_cast<Term>(k)))] = to_string(s.modes[k]);
  json out{{"end_time", s.end_time},
           {"gravity", to_json(s.gravity)},
           {"spacing", s.spacing},
           {"support_ratio", s.support_ratio},
           {"mode", to_string(s.mode)},
           {"modes", modes},
           {"time_step", maybe(s.time_step)},
           {"seed", s.seed},
           {"jitter", s.jitter},
           {"min", maybe(s.min)},
           {"max", maybe(s.max)},
           {"periodic", periodic},
           {"output_interval", s.output_interval},
           {"settle", s.settle},
           {"merge_distance", s.merge_distance},
           {"contact", s.contact ? "auto" : "none"},
           {"clamp", s.clamps()},
           {"on_failure", s.recovers ? "recover" : "stop"},
           {"unguarded", s.unguarded}};
  add_effect_values(s, "scene", out);
  out["materials"] = out["bodies"] = out["events"] = out["inflows"] = json::array();
  for (const Material& m : s.materials) out["materials"].push_back(to_json(m));
  for (std::size_t k = 0; k < s.bodies.size(); ++k) out["bodies"].push_back(to_json(s.bodies[k], bodies.at(k)));
  for (const Event& e : s.events) out["events"].push_back(to_json(e));
  for (const Inflow& f : s.inflows) out["inflows"].push_back(to_json(f));
  return out;
}

void scene_from_json(const json& value, Scene& s, std::vector<JobBody>& bodies) {
  const JsonObject o(value, "scene");
  s.end_time = o.number("end_time");
  s.gravity = o.vector("gravity");
  s.spacing = o.number("spacing");
  s.support_ratio = o.number("support_ratio");
  s.mode = mode_from(o.text("mode"));
  const JsonObject modes = o.object("modes");
  for (std::size_t k = 0; k < term_count; ++k)
    s.modes[k] = mode_from(modes.text_or(std::string(to_string(static_cast<Term>(k))), std::string(to_string(s.mode))));
  s.time_step = o.maybe_number("time_step");
  s.seed = static_cast<std::uint64_t>(o.integer("seed"));
  s.jitter = o.number("jitter");
  if (o.has("min")) s.min = o.vector("min");
  if (o.has("max")) s.max = o.vector("max");
  for (const std::string& axis : o.texts("periodic")) s.periodic[axis == "x" ? 0 : axis == "y" ? 1 : 2] = true;
  s.output_interval = o.number("output_interval");
  take_effect_values(o, "scene", s);
  s.settle = o.flag_or("settle", false);
  s.merge_distance = o.number_or("merge_distance", 1.5);
  s.contact = o.text_or("contact", "auto") == "auto";
  s.recovers = o.text_or("on_failure", "stop") == "recover";
  s.unguarded = o.texts("unguarded");
  for (const JsonObject& m : o.objects("materials")) s.materials.push_back(material_from(m));
  const std::vector<JsonObject> all = o.objects("bodies");
  for (std::size_t k = 0; k < all.size(); ++k) body_from(value["bodies"][k], all[k], s, bodies);
  for (const JsonObject& e : o.objects("events")) s.events.push_back(event_from(e));
  for (const JsonObject& f : o.objects("inflows")) s.inflows.push_back(inflow_from(f));
}

}  // namespace tripoint
