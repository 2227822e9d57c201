// SPDX-License-Identifier: BSD-3-Clause
#include "files/job_schema.hpp"

#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "files/job_records.hpp"
#include "files/record_json.hpp"
#include "scene/effect_keys.hpp"
#include "scene/model.hpp"
#include "scene/place_records.hpp"
#include "scene/scene_records.hpp"

namespace tripoint {
namespace {

using json = nlohmann::ordered_json;

json of_type(const char* type) { return {{"type", type}}; }
json list_of(json items) { return {{"type", "array"}, {"items", std::move(items)}}; }
json table(std::string_view name) { return {{"$ref", "#/$defs/" + std::string(name)}}; }

json numbers(int count) {
  json list = list_of(of_type("number"));
  list["minItems"] = list["maxItems"] = count;
  return list;
}

/// The table whose schema a member of this type has, and how many numbers it is; none of others.
template <class T>
inline constexpr std::string_view table_of = "";
template <>
inline constexpr std::string_view table_of<Shape> = "shape";
template <>
inline constexpr std::string_view table_of<TemperatureField> = "temperature";
template <>
inline constexpr std::string_view table_of<VelocityField> = "velocity_field";
template <>
inline constexpr std::string_view table_of<JointSpring> = "joint.spring";
template <>
inline constexpr std::string_view table_of<JointMotor> = "joint.motor";
template <class T>
inline constexpr int numbers_of = 0;
template <>
inline constexpr int numbers_of<std::array<double, 2>> = 2;
template <>
inline constexpr int numbers_of<Vec3> = 3;
template <>
inline constexpr int numbers_of<Quaternion> = 4;

/// How a member of this type is written (record_json.hpp: put).
template <class T>
json schema_of(const Key& key, std::string_view yes) {
  if constexpr (std::is_same_v<T, bool>) {
    return yes.empty() ? of_type("boolean") : json{{"enum", split_words(key.words)}};
  } else if constexpr (std::is_enum_v<T>) {
    return {{"enum", split_words(key.words)}};
  } else if constexpr (record_json::is_word_list<T> || std::is_same_v<T, std::array<bool, 3>>) {
    return list_of({{"enum", split_words(key.words)}});
  } else if constexpr (std::integral<T>) {
    return of_type("integer");
  } else if constexpr (std::is_same_v<T, double>) {
    return of_type("number");
  } else if constexpr (numbers_of<T> != 0) {
    return numbers(numbers_of<T>);
  } else if constexpr (std::is_same_v<T, std::array<Vec3, 3>>) {
    return list_of(numbers(3));
  } else if constexpr (std::is_same_v<T, std::vector<double>>) {
    return list_of(of_type("number"));
  } else if constexpr (std::is_same_v<T, Settings>) {
    return of_type("object");
  } else if constexpr (!table_of<T>.empty()) {
    return table(table_of<T>);
  } else if constexpr (std::is_same_v<T, std::vector<Keyframe>>) {
    return list_of(table("keyframe"));
  } else if constexpr (requires(T value) { value.has_value(); }) {
    return schema_of<typename T::value_type>(key, yes);
  } else if constexpr (std::is_same_v<T, std::string>) {
    return of_type("string");
  } else {
    return list_of(of_type("string"));
  }
}

std::string described(const Key& key) {
  return std::string(key.meaning) + (key.unit.empty() ? "" : " [" + std::string(key.unit) + "]");
}

/// Adds a key to the schema of its table. A value that may be missing may be null too.
void add(json& to, std::string_view name, const Key& key, json value, bool required) {
  if (required) to["required"].push_back(name);
  if (!required) value = {{"anyOf", {std::move(value), of_type("null")}}};
  value["description"] = described(key);
  to["properties"][std::string(name)] = std::move(value);
}

/// The value of a key that no member keeps: a table of its own, or one that job.cpp has a rule for.
json schema_of(const Key& key) {
  switch (key.type) {
    case ValueType::integer:
      return of_type("integer");
    case ValueType::flag:
      return of_type("boolean");
    case ValueType::text:
      return of_type("string");
    case ValueType::word:
      return {{"enum", split_words(key.words)}};
    case ValueType::table:
      return table(key.words);
    case ValueType::tables:
      return list_of(table(key.words));
    default:
      return of_type("object");
  }
}

/// Whether the reader refuses a job that lacks the member (record_json.hpp: take).
template <class T>
bool is_needed(const Key& key, bool later) {
  if constexpr (std::is_same_v<T, std::string>)
    return !later && key.required();
  else if constexpr (std::is_same_v<T, Shape>)
    return key.table != "body";
  else if constexpr (std::is_same_v<T, bool>)
    return false;
  else
    return !later && (std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, Vec3> ||
                      std::is_same_v<T, Quaternion> || std::is_same_v<T, std::array<Vec3, 3>> ||
                      std::is_same_v<T, std::vector<double>>);
}

template <class Owner, class T>
void add_entry(json& to, const Kept<Owner, T>& entry) {
  add(to, entry.in_job, entry.key, schema_of<T>(entry.key, entry.yes), is_needed<T>(entry.key, entry.later));
}

void add_entry(json& to, const Key& key) { add(to, key.name, key, schema_of(key), key.required()); }

template <class Record>
void add_record(json& to, const Record& list) {
  std::apply([&](const auto&... entries) { (add_entry(to, entries), ...); }, list);
}

template <class... Records>
json object_of(const Records&... lists) {
  json out{{"type", "object"}, {"properties", json::object()}, {"required", json::array()}};
  (add_record(out, lists), ...);
  return out;
}

template <class Owner>
void add_effect_keys(json& to, std::string_view of_table) {
  Owner owner;
  each_effect_key(owner, of_table, [&](const Key& key, const auto& value) {
    add(to, key.name, key, schema_of<std::remove_cvref_t<decltype(value)>>(key, ""), false);
  });
}

/// The kinds of a shape or a field. Parts of a shape stand in one list; the first of a difference is the one
/// that is cut.
template <class Owner>
json kinds_of(const json& plain_value) {
  json any = json::array();
  const auto one = [&](const auto& of) {
    json kind = object_of(of.record);
    if (of.word == "union" || of.word == "difference")
      kind = {{"type", "object"}, {"properties", {{"of", list_of(table("shape"))}}}, {"required", {"of"}}};
    if (of.word == "constant")
      kind = {{"type", "object"}, {"properties", {{"value", plain_value}}}, {"required", {"value"}}};
    if constexpr (std::is_same_v<Owner, Shape>) {
      kind["properties"]["rotation"] = numbers(4);
      kind["properties"]["rotation_centre"] = numbers(3);
    }
    kind["properties"]["kind"] = {{"const", of.word}};
    kind["required"].push_back("kind");
    any.push_back(std::move(kind));
  };
  std::apply([&](const auto&... all) { (one(all), ...); }, kinds<Owner>);
  return {{"anyOf", any}};
}

json named(const char* title, json whole) {
  json out{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  out.update(whole);
  return out;
}

json scene_schema() {
  json scene = object_of(record<Scene>);
  add_effect_keys<Scene>(scene, "scene");
  const std::set<std::string> optional{"outflows", "contacts", "forces", "springs", "joints", "sources"};
  for (const char* list : {"materials", "bodies", "events", "inflows", "outflows", "contacts", "forces",
                           "springs", "joints", "sources"}) {
    const std::string one =
        std::string(list) == "bodies" ? "body" : std::string(list, std::char_traits<char>::length(list) - 1);
    scene["properties"][list] = list_of(table(one));
    if (!optional.contains(list)) scene["required"].push_back(list);
  }
  scene["properties"]["model"] = table("model");
  return scene;
}

json model_schema() {
  json model = of_type("object");
  for (const ModelTerm& t : model_terms())
    for (const ModelForm& form : t.forms)
      model["properties"][std::string(t.name)]["enum"].push_back(form.word);
  return model;
}

json modes_schema() {
  json modes = of_type("object");
  for (const DeclaredTerm& one : declared_terms())
    modes["properties"][std::string(one.term.name)] = {{"enum", {"corrected", "paper"}}};
  return modes;
}

}  // namespace

json job_schema() {
  json out = named("JOB.json of tripoint, contract 1", object_of(records::of_job));
  json& tables = out["$defs"];
  tables["resolution"] = object_of(records::of_resolution);
  tables["gauge"] = object_of(records::of_gauge);
  tables["scene"] = scene_schema();
  tables["modes"] = modes_schema();
  tables["model"] = model_schema();
  tables["material"] = object_of(record<Material>);
  add_effect_keys<Material>(tables["material"], "material");
  tables["body"] = object_of(record<Body>, records::of_job_body, records::of_mass);
  tables["event"] = object_of(record<Event>);
  tables["inflow"] = object_of(record<Inflow>);
  tables["outflow"] = object_of(record<Outflow>);
  tables["contact"] = object_of(record<ContactLaw>);
  tables["force"] = object_of(record<AppliedForce>);
  tables["spring"] = object_of(record<Spring>);
  tables["joint"] = object_of(record<Joint>);
  tables["joint.spring"] = object_of(record<JointSpring>);
  tables["joint.motor"] = object_of(record<JointMotor>);
  tables["source"] = object_of(record<HeatSource>);
  tables["keyframe"] = object_of(record<Keyframe>);
  tables["shape"] = kinds_of<Shape>({});
  tables["temperature"] = kinds_of<TemperatureField>(of_type("number"));
  tables["velocity_field"] = kinds_of<VelocityField>(numbers(3));
  return out;
}

json result_schema() {
  json out = named("result.json of tripoint, contract 1", object_of(records::of_result));
  json& tables = out["$defs"];
  tables["counters"] = object_of(records::of_counters);
  tables["seconds"] = object_of(records::of_seconds);
  tables["readback"] = object_of(records::of_readback);
  tables["readback.body"] = object_of(records::of_readback_body);
  tables["readback.joint"] = object_of(records::of_readback_joint);
  tables["divergence"] = object_of(records::of_divergence);
  return out;
}

}  // namespace tripoint
