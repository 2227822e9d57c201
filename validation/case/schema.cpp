// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <nlohmann/json.hpp>

#include "scene/effect_rule.hpp"
#include "scene/scene.hpp"
#include "validation/case/case_keys.hpp"
#include "validation/case/schema.hpp"

/// JSON Schema (2020-12) of the case file, from the key table.
namespace tripoint {
namespace {

using json = nlohmann::ordered_json;

json reference_to(std::string_view table) { return {{"$ref", "#/$defs/" + std::string(table)}}; }
json array_of(json items) { return {{"type", "array"}, {"items", std::move(items)}}; }

json number_schema(const Key& k) {
  json number{{"type", "number"}};
  switch (k.range) {
    case Range::any:
      break;
    case Range::positive:
      number["exclusiveMinimum"] = 0;
      break;
    case Range::not_negative:
      number["minimum"] = 0;
      break;
    case Range::fraction:
      number["minimum"] = 0;
      number["maximum"] = 1;
      break;
    case Range::poisson:
      number["exclusiveMinimum"] = -1;
      number["exclusiveMaximum"] = 0.5;
      break;
    case Range::above_one:
      number["exclusiveMinimum"] = 1;
      break;
  }
  // A text holds a number and a unit of the key's dimension; which units, the reader knows.
  return {{"anyOf", {number, {{"type", "string"}, {"pattern", "^\\s*[+-]?[0-9.]+([eE][+-]?[0-9]+)?.*$"}}}}};
}

json vector_schema(const Key& k) {
  json v = array_of(number_schema(k));
  v["minItems"] = 3;
  v["maxItems"] = 3;
  return v;
}

/// One of the kinds of a family: shape.box, shape.sphere ...
json kinds_of(const std::string& family) {
  json any = json::array();
  for (const auto& t : case_keys().tables())
    if (t.name.starts_with(family + ".")) any.push_back(reference_to(t.name));
  return {{"anyOf", any}};
}

json value_schema(const Key& k) {
  const auto kind_or = [&](const std::string& family, json plain) {
    json s = kinds_of(family);
    s["anyOf"].insert(s["anyOf"].begin(), std::move(plain));
    return s;
  };
  switch (k.type) {
    case ValueType::number:
      return number_schema(k);
    case ValueType::integer:
      return {{"type", "integer"}};
    case ValueType::flag:
      return {{"type", "boolean"}};
    case ValueType::text:
      return {{"type", "string"}};
    case ValueType::word:
      return {{"enum", split_words(k.words)}};
    case ValueType::vector:
      return vector_schema(k);
    case ValueType::numbers:
      return array_of(number_schema(k));
    case ValueType::texts:
      return array_of({{"type", "string"}});
    case ValueType::number_or_auto:
      return {{"anyOf", {number_schema(k), {{"const", "auto"}}}}};
    case ValueType::text_or_texts:
      return {{"anyOf", {{{"type", "string"}}, array_of({{"type", "string"}})}}};
    case ValueType::words:
      return array_of({{"enum", split_words(k.words)}});
    case ValueType::table:
      if (k.words == "engines")
        return {{"type", "object"}, {"additionalProperties", reference_to("engines")}};
      return reference_to(k.words);
    case ValueType::tables:
      if (k.words == "shape") return array_of(kinds_of("shape"));
      if (k.words.empty()) return array_of(vector_schema(k));
      return array_of(reference_to(k.words));
    case ValueType::settings:
      return {{"type", "object"}};
    case ValueType::shape:
      return kinds_of("shape");
    case ValueType::temperature:
      return kind_or("temperature", number_schema(k));
    case ValueType::velocity:
      return kind_or("velocity", vector_schema(k));
    case ValueType::invariant:
      return {{"anyOf", {{{"type", "number"}}, reference_to("invariant")}}};
  }
  return {};
}

json key_schema(const Key& k) {
  json s = value_schema(k);
  std::string text(k.meaning);
  if (!k.unit.empty()) text += " [" + std::string(k.unit) + "]";
  if (k.required())
    text += "; required";
  else if (!k.note.empty())
    text += "; default: " +
            std::string(k.fallback.empty() || k.fallback == "=" ? "" : std::string(k.fallback) + ", ") +
            std::string(k.note);
  s["description"] = text;
  if (k.old) s["deprecated"] = true;
  return s;
}

/// Keys that a table of a case that extends nothing must have.
json required_keys(std::string_view name) {
  json list = json::array();
  for (const auto* k : case_keys().of(name)) {
    // a material of the library brings its own density
    if (k->required() && !(name == "material" && k->name == "density")) list.push_back(k->name);
  }
  return list;
}

bool can_be_partial(const Key& k) {
  return (k.type == ValueType::table || k.type == ValueType::tables) && !k.words.empty();
}

/// Tables of a case that extends another may leave required keys to that one.
json rule_of_whole_cases() {
  json needs{{"required", required_keys("")}, {"properties", json::object()}};
  for (const auto* k : case_keys().of("")) {
    const json list = can_be_partial(*k) ? required_keys(k->words) : json::array();
    if (list.empty() || k->words == "engines") continue;
    const json rule{{"required", list}};
    needs["properties"][std::string(k->name)] = k->type == ValueType::tables ? json{{"items", rule}} : rule;
  }
  return needs;
}

bool is_always_whole(std::string_view name) {
  const auto top = case_keys().of("");
  const bool of_the_top = std::any_of(top.begin(), top.end(),
                                      [&](const Key* k) { return can_be_partial(*k) && k->words == name; });
  return !name.empty() && !of_the_top && name != "gates" && name != "invariant";
}

json table_schema(std::string_view name) {
  json s{{"type", "object"}, {"additionalProperties", false}, {"properties", json::object()}};
  json required = json::array();
  const auto dot = name.find('.');
  if (dot != std::string_view::npos) {
    s["properties"]["kind"] = {{"const", name.substr(dot + 1)}};
    required.push_back("kind");
  }
  for (const auto* k : case_keys().of(name)) s["properties"][std::string(k->name)] = key_schema(*k);
  if (is_always_whole(name))
    for (const auto& key : required_keys(name)) required.push_back(key);
  if (!required.empty()) s["required"] = required;
  return s;
}

}  // namespace

std::string case_schema() {
  json s = table_schema("");
  json out{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
           {"title", "tripoint case file, format 1"},
           {"description", "Numbers are SI, or texts with a unit."}};
  out.update(s);
  out["if"] = {{"not", {{"required", {"extends"}}}}};
  out["then"] = rule_of_whole_cases();
  for (const auto& t : case_keys().tables())
    if (!t.name.empty()) {
      out["$defs"][std::string(t.name)] = table_schema(t.name);
      out["$defs"][std::string(t.name)]["description"] = t.meaning;
    }
  json modes{{"type", "object"}, {"additionalProperties", false}, {"properties", json::object()}};
  for (const DeclaredTerm& one : declared_terms())
    modes["properties"][std::string(one.term.name)] = {{"enum", {"corrected", "paper"}}};
  out["$defs"]["modes"] = modes;
  return out.dump(2) + "\n";
}

}  // namespace tripoint
