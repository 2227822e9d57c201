// SPDX-License-Identifier: BSD-3-Clause
#include "files/scene_json.hpp"

#include <nlohmann/json.hpp>

namespace tripoint {

using json = nlohmann::ordered_json;

json to_json(const Vec3& v) { return json::array({v.x, v.y, v.z}); }
json to_json(const Quaternion& q) { return json::array({q.w, q.x, q.y, q.z}); }

json to_json(const Settings& settings) {
  json out = json::object();
  for (const auto& [key, value] : settings)
    std::visit([&, &name = key](const auto& v) { out[name] = v; }, value);
  return out;
}

JsonObject::JsonObject(const json& value, std::string path) : value_(&value), path_(std::move(path)) {
  if (!value.is_object()) throw InputError(path_ + ": expected a JSON object");
}

bool JsonObject::has(const std::string& key) const {
  const auto found = value_->find(key);
  return found != value_->end() && !found->is_null();
}

const json& JsonObject::at(const std::string& key) const {
  const auto found = value_->find(key);
  if (found == value_->end()) throw InputError(path_ + ": the key \"" + key + "\" is missing");
  return *found;
}

void JsonObject::wrong(const std::string& key, const std::string& expected) const {
  throw InputError(path_ + "." + key + ": expected " + expected);
}

double JsonObject::number(const std::string& key) const {
  const json& v = at(key);
  if (!v.is_number()) wrong(key, "a number");
  return v.get<double>();
}

std::optional<double> JsonObject::maybe_number(const std::string& key) const {
  if (!has(key)) return {};
  return number(key);
}

long JsonObject::integer(const std::string& key) const {
  const json& v = at(key);
  if (!v.is_number_integer()) wrong(key, "a whole number");
  return v.get<long>();
}

bool JsonObject::flag(const std::string& key) const {
  const json& v = at(key);
  if (!v.is_boolean()) wrong(key, "true or false");
  return v.get<bool>();
}

std::string JsonObject::text(const std::string& key) const {
  const json& v = at(key);
  if (!v.is_string()) wrong(key, "a string");
  return v.get<std::string>();
}

std::vector<double> JsonObject::numbers(const std::string& key) const {
  const json& v = at(key);
  if (!v.is_array()) wrong(key, "a list of numbers");
  std::vector<double> out;
  for (const json& e : v) {
    if (!e.is_number()) wrong(key, "numbers");
    out.push_back(e.get<double>());
  }
  return out;
}

std::vector<std::string> JsonObject::texts(const std::string& key) const {
  if (!has(key)) return {};
  const json& v = at(key);
  if (!v.is_array()) wrong(key, "a list of strings");
  std::vector<std::string> out;
  for (const json& e : v) {
    if (!e.is_string()) wrong(key, "strings");
    out.push_back(e.get<std::string>());
  }
  return out;
}

Vec3 JsonObject::vector(const std::string& key) const {
  const std::vector<double> v = numbers(key);
  if (v.size() != 3) wrong(key, "3 numbers");
  return {v[0], v[1], v[2]};
}

Quaternion JsonObject::quaternion(const std::string& key) const {
  const std::vector<double> v = numbers(key);
  if (v.size() != 4) wrong(key, "4 numbers w, x, y, z");
  return {v[0], v[1], v[2], v[3]};
}

std::array<Vec3, 3> JsonObject::rows(const std::string& key) const {
  const std::string path = path_ + "." + key;
  const auto found = value_->find(key);
  if (found == value_->end() || !found->is_array() || found->size() != 3)
    throw InputError(path + ": expected 3 rows of 3 numbers");
  std::array<Vec3, 3> rows{};
  for (std::size_t i = 0; i < 3; ++i) {
    const json wrapped{{"row", (*found)[i]}};
    rows[i] = JsonObject(wrapped, path).vector("row");
  }
  return rows;
}

Settings JsonObject::settings(const std::string& key) const {
  Settings out;
  if (!has(key)) return out;
  const json& all = at(key);
  if (!all.is_object()) wrong(key, "an object");
  for (const auto& [name, v] : all.items()) {
    if (v.is_boolean())
      out[name] = v.get<bool>();
    else if (v.is_number())
      out[name] = v.get<double>();
    else if (v.is_string())
      out[name] = v.get<std::string>();
    else if (v.is_array())
      out[name] = object(key).numbers(name);
    else
      wrong(key + "." + name, "true or false, a number, a string or a list of numbers");
  }
  return out;
}

JsonObject JsonObject::object(const std::string& key) const { return {at(key), path_ + "." + key}; }

std::vector<JsonObject> JsonObject::objects(const std::string& key) const {
  if (!has(key)) return {};
  const json& v = at(key);
  if (!v.is_array()) wrong(key, "a list of objects");
  std::vector<JsonObject> out;
  for (std::size_t k = 0; k < v.size(); ++k)
    out.emplace_back(v[k], path_ + "." + key + "[" + std::to_string(k) + "]");
  return out;
}

}  // namespace tripoint
