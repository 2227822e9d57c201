// SPDX-License-Identifier: BSD-3-Clause
#include "job/scene_json.hpp"

#include <algorithm>
#include <initializer_list>

#include <nlohmann/json.hpp>

#include "scene/effect_keys.hpp"
#include "scene/place_records.hpp"
#include "scene/scene_records.hpp"

/// A record goes into JSON and comes back by the list of its keys (scene/record.hpp). Only fields that a job states otherwise
/// than a case file are written by hand.
namespace tripoint {
namespace {

using json = nlohmann::ordered_json;

/// An object whose first members are these, in this order, which jobs have had from the start.
json beginning_with(std::initializer_list<const char*> names) {
  json out = json::object();
  for (const char* name : names) out[name] = nullptr;
  return out;
}

template <class Owner>
void put_record(const Owner&, json& out);
template <class Owner>
void take_record(const JsonObject&, Owner&);
json kind_json(const auto& owner);
template <class Owner>
Owner from_kind_json(const JsonObject&);

// --- one value --------------------------------------------------------------------------------------------------------

/// Whether it is a list of words of one enumeration.
template <class T>
inline constexpr bool is_word_list = false;
template <class E>
inline constexpr bool is_word_list<std::vector<E>> = std::is_enum_v<E>;

/// How a value of a member's type is written. `key` and `yes` are those of its row.
template <class T>
json put(const Key& key, std::string_view yes, const T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    if (yes.empty()) return value;
    const auto words = split_words(key.words);
    return *std::ranges::find_if(words, [&](const std::string& word) { return (word == yes) == value; });
  } else if constexpr (std::is_enum_v<T>) {
    return split_words(key.words).at(static_cast<std::size_t>(value));
  } else if constexpr (is_word_list<T>) {
    json list = json::array();
    for (const auto one : value) list.push_back(split_words(key.words).at(static_cast<std::size_t>(one)));
    return list;
  } else if constexpr (std::is_same_v<T, Vec3> || std::is_same_v<T, Quaternion>) {
    return to_json(value);
  } else if constexpr (std::is_same_v<T, Shape> || std::is_same_v<T, TemperatureField> || std::is_same_v<T, VelocityField>) {
    return kind_json(value);
  } else if constexpr (std::is_same_v<T, std::array<bool, 3>>) {
    json list = json::array();
    for (std::size_t k = 0; k < 3; ++k)
      if (value[k]) list.push_back(split_words(key.words).at(k));
    return list;
  } else if constexpr (std::is_same_v<T, std::array<Vec3, 3>>) {
    return json::array({to_json(value[0]), to_json(value[1]), to_json(value[2])});
  } else if constexpr (std::is_same_v<T, std::vector<Keyframe>>) {
    json list = json::array();
    for (const Keyframe& k : value) put_record(k, list.emplace_back(json::object()));
    return list;
  } else if constexpr (requires { value.has_value(); }) {
    return value ? put(key, yes, *value) : json(nullptr);
  } else {
    return value;
  }
}

/// The number of a word in a list; @throws InputError where it is none of them
std::size_t place_of(const JsonObject& o, const std::string& name, const std::string& word,
                     const std::vector<std::string>& words) {
  const auto at = std::ranges::find(words, word);
  if (at == words.end()) throw InputError(o.path() + "." + name + ": \"" + word + "\" is unknown");
  return static_cast<std::size_t>(at - words.begin());
}

/// Reads a member. Flags, lists, texts that have a default and what may be unknown stay as they are where a job lacks them.
/// @param later whether any value does so
template <class T>
void take(const JsonObject& o, const std::string& name, const Key& key, std::string_view yes, bool later, T& value) {
  if constexpr (std::is_same_v<T, double>) {
    value = later ? o.number_or(name, value) : o.number(name);
  } else if constexpr (std::is_same_v<T, bool>) {
    if (yes.empty())
      value = o.flag_or(name, value);
    else if (o.has(name))
      value = split_words(key.words)[place_of(o, name, o.text(name), split_words(key.words))] == yes;
  } else if constexpr (std::is_same_v<T, std::string>) {
    value = later || !key.required() ? o.text_or(name, value) : o.text(name);
  } else if constexpr (std::is_same_v<T, std::uint64_t>) {
    value = static_cast<std::uint64_t>(o.integer(name));
  } else if constexpr (std::is_enum_v<T>) {
    if (!later || o.has(name)) value = static_cast<T>(place_of(o, name, o.text(name), split_words(key.words)));
  } else if constexpr (std::is_same_v<T, Vec3>) {
    value = o.vector(name);
  } else if constexpr (std::is_same_v<T, Quaternion>) {
    value = o.quaternion(name);
  } else if constexpr (std::is_same_v<T, Shape>) {
    if (o.has(name) || key.table != "body") value = from_kind_json<T>(o.object(name));
  } else if constexpr (std::is_same_v<T, TemperatureField> || std::is_same_v<T, VelocityField>) {
    if (o.has(name)) value = from_kind_json<T>(o.object(name));
  } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
    value = o.texts(name);
  } else if constexpr (is_word_list<T>) {
    value.clear();
    for (const std::string& word : o.texts(name))
      value.push_back(static_cast<typename T::value_type>(place_of(o, name, word, split_words(key.words))));
  } else if constexpr (std::is_same_v<T, std::array<std::string, 3>>) {
    const std::vector<std::string> parts = o.texts(name);
    if (parts.size() != 3) throw InputError(o.path() + "." + name + ": expected 3 expressions");
    std::ranges::copy(parts, value.begin());
  } else if constexpr (std::is_same_v<T, std::array<bool, 3>>) {
    const auto words = split_words(key.words);
    for (const std::string& word : o.texts(name))
      value[std::min<std::size_t>(std::ranges::find(words, word) - words.begin(), 2)] = true;
  } else if constexpr (std::is_same_v<T, std::array<Vec3, 3>>) {
    value = o.rows(name);
  } else if constexpr (std::is_same_v<T, std::vector<Keyframe>>) {
    for (const JsonObject& k : o.objects(name)) take_record(k, value.emplace_back());
  } else {  // values that may be unknown
    value.reset();
    if (o.has(name)) take(o, name, key, yes, false, value.emplace());
  }
}

// --- a record ---------------------------------------------------------------------------------------------------------

template <class Owner>
void put_record(const Owner& owner, json& out) {
  each_kept_of(owner, [&](const auto& entry) {
    const auto& value = owner.*entry.member;
    out[std::string(entry.in_job)] = put(entry.key, entry.yes, value);
  });
}

template <class Owner>
void take_record(const JsonObject& o, Owner& owner) {
  each_kept_of(owner, [&](const auto& entry) {
    take(o, std::string(entry.in_job), entry.key, entry.yes, entry.later, owner.*entry.member);
  });
}

/// Values of keys that effects bring, as they are kept in a scene or a material.
template <class Owner>
void put_effect_values(const Owner& owner, std::string_view table, json& out) {
  each_effect_key(owner, table, [&](const Key& key, const auto& value) { out[std::string(key.name)] = put(key, "", value); });
}

/// A missing value stays as the owner has it.
template <class Owner>
void take_effect_values(const JsonObject& o, std::string_view table, Owner& owner) {
  each_effect_key(owner, table, [&](const Key& key, auto& value) { take(o, std::string(key.name), key, "", true, value); });
}

// --- shapes, and fields of the start ----------------------------------------------------------------------------------

template <class Owner>
std::vector<std::string> kind_words() {
  return std::apply([](const auto&... all) { return std::vector<std::string>{std::string(all.word)...}; }, kinds<Owner>);
}

/// A shape or a field: its kind, and the keys of that.
json kind_json(const auto& owner) {
  using Owner = std::remove_cvref_t<decltype(owner)>;
  json out{{"kind", kind_words<Owner>().at(static_cast<std::size_t>(owner.kind))}};
  put_record(owner, out);
  if constexpr (std::is_same_v<Owner, Shape>) {
    if (owner.kind != Shape::Kind::unite && owner.kind != Shape::Kind::difference) return out;
    out["of"] = json::array();
    for (const Shape& part : owner.of) out["of"].push_back(kind_json(part));
  } else if (owner.kind == Owner::Kind::constant) {
    out["value"] = put(Key{}, "", owner.value);
  }
  return out;
}

template <class Owner>
Owner from_kind_json(const JsonObject& o) {
  Owner owner;
  owner.kind = static_cast<typename Owner::Kind>(place_of(o, "kind", o.text("kind"), kind_words<Owner>()));
  take_record(o, owner);
  if constexpr (std::is_same_v<Owner, Shape>) {
    if (owner.kind == Shape::Kind::unite || owner.kind == Shape::Kind::difference)
      for (const JsonObject& part : o.objects("of")) owner.of.push_back(from_kind_json<Shape>(part));
  } else if (owner.kind == Owner::Kind::constant) {
    take(o, "value", Key{}, "", false, owner.value);
  }
  return owner;
}

// --- materials, bodies, events ----------------------------------------------------------------------------------------

json material_json(const Material& m) {
  json out = beginning_with({"name", "density", "solid", "stiffness", "solid_conductivity", "solid_heat_capacity"});
  put_record(m, out);
  put_effect_values(m, "material", out);
  return out;
}

Material material_from(const JsonObject& o) {
  Material m;
  take_record(o, m);
  take_effect_values(o, "material", m);
  return m;
}

/// A body as the case file says it and as its particles are: `velocity` is that of the centre of mass, the field beside it.
json body_json(const Body& b, const JobBody& j) {
  const MassProperties& p = j.properties;
  json out = beginning_with({"name", "index", "material", "phase", "motion", "keyframes", "temperature_held", "mass", "centre",
                             "principal_inertia", "principal_axes", "orientation", "velocity", "angular_velocity",
                             "velocity_field", "temperature", "shape"});
  put_record(b, out);
  out["index"] = j.index;
  out["mass"] = p.mass;
  out["centre"] = to_json(p.centre);
  out["principal_inertia"] = to_json(p.principal_inertia);
  out["principal_axes"] = to_json(p.principal_axes);
  out["orientation"] = to_json(j.orientation);
  out["velocity"] = to_json(j.velocity);
  out["angular_velocity"] = to_json(j.angular_velocity);
  return out;
}

void body_from(const JsonObject& o, Scene& scene, std::vector<JobBody>& bodies) {
  Body b;
  take_record(o, b);
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
  j.angular_velocity = b.angular_velocity;
  if (!o.has("velocity_field")) b.velocity.value = j.velocity;
  scene.bodies.push_back(std::move(b));
  bodies.push_back(std::move(j));
}

json event_json(const Event& e) {
  json out = beginning_with({"kind"});
  put_record(e, out);
  return out;
}

template <class T>
void take_list(const JsonObject& o, const std::string& name, std::vector<T>& list) {
  for (const JsonObject& one : o.objects(name)) take_record(one, list.emplace_back());
}

json modes_json(const Scene& s) {
  json modes = json::object();
  for (const DeclaredTerm& one : declared_terms()) modes[std::string(one.term.name)] = to_string(s.mode_of(one.term));
  return modes;
}

}  // namespace

json scene_to_json(const Scene& s, const std::vector<JobBody>& bodies) {
  json out = beginning_with({"end_time", "gravity", "spacing", "support_ratio", "mode", "modes", "time_step", "seed", "jitter",
                             "min", "max", "periodic", "output_interval", "settle", "merge_distance", "contact", "clamp"});
  put_record(s, out);
  out["modes"] = modes_json(s);
  out["clamp"] = s.clamps();
  put_effect_values(s, "scene", out);
  out["materials"] = out["bodies"] = out["events"] = out["inflows"] = json::array();
  for (const Material& m : s.materials) out["materials"].push_back(material_json(m));
  for (std::size_t k = 0; k < s.bodies.size(); ++k) out["bodies"].push_back(body_json(s.bodies[k], bodies.at(k)));
  for (const Event& e : s.events) out["events"].push_back(event_json(e));
  for (const Inflow& f : s.inflows) put_record(f, out["inflows"].emplace_back(json::object()));
  return out;
}

void scene_from_json(const json& value, Scene& s, std::vector<JobBody>& bodies) {
  const JsonObject o(value, "scene");
  take_record(o, s);
  const JsonObject modes = o.object("modes");
  for (const DeclaredTerm& one : declared_terms())
    s.modes[one.term] = mode_from(modes.text_or(std::string(one.term.name), std::string(to_string(s.mode))));
  take_effect_values(o, "scene", s);
  for (const JsonObject& m : o.objects("materials")) s.materials.push_back(material_from(m));
  for (const JsonObject& b : o.objects("bodies")) body_from(b, s, bodies);
  take_list(o, "events", s.events);
  take_list(o, "inflows", s.inflows);
}

}  // namespace tripoint
