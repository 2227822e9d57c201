// SPDX-License-Identifier: BSD-3-Clause
#include "scene/value_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/scene_keys.hpp"
#include "scene/scene_records.hpp"

namespace tripoint {
namespace {

template <class T>
bool keep(T& value, const std::optional<T>& given) {
  if (given) value = *given;
  return !given;
}

}  // namespace

bool ValueReader::operator()(const Key& key, double& value) {
  if (key.fallback == "=") return keep(value, in_.maybe_number(key.name));
  value = in_.number(key.name);
  return false;
}

bool ValueReader::operator()(const Key& key, std::optional<double>& value) {
  value = in_.maybe_number(key.name);
  return !value;
}

bool ValueReader::operator()(const Key& key, std::uint64_t& value) {
  value = static_cast<std::uint64_t>(in_.integer(key.name));
  return false;
}

bool ValueReader::operator()(const Key& key, bool& value, std::string_view yes) {
  if (yes.empty()) return keep(value, in_.maybe_flag(key.name));
  value = in_.text(key.name) == yes;
  return false;
}

bool ValueReader::operator()(const Key& key, std::string& value) {
  return keep(value, in_.maybe_text(key.name));
}

bool ValueReader::operator()(const Key& key, Vec3& value) {
  value = in_.vector(key.name);
  return false;
}

bool ValueReader::operator()(const Key& key, std::optional<Vec3>& value) {
  value = in_.maybe_vector(key.name);
  return !value;
}

Quaternion unit_quaternion(const TableReader& in, std::string_view key, const std::vector<double>& q) {
  if (q.size() != 4) in.refuse(key, "write the quaternion [w, x, y, z]");
  const Quaternion given{q[0], q[1], q[2], q[3]};
  if (!(std::abs(norm(given) - 1.0) < 1e-3))
    in.refuse(key, fmt::format("the quaternion has length {}: write one of length 1 (w = cos(angle/2))",
                               norm(given)));
  return normalised(given);
}

bool ValueReader::operator()(const Key& key, Quaternion& value) {
  const auto q = in_.maybe_numbers(key.name);
  if (q) value = unit_quaternion(in_, key.name, *q);
  return !q;
}

bool ValueReader::operator()(const Key& key, std::vector<std::string>& value) {
  value = in_.texts(key.name);
  return false;
}

bool ValueReader::operator()(const Key& key, Settings& value) {
  value = in_.settings(key.name);
  return false;
}

bool ValueReader::operator()(const Key& key, std::array<bool, 3>& value) {
  for (const auto& word : in_.texts(key.name)) value[static_cast<std::size_t>(word[0] - 'x')] = true;
  return false;
}

bool ValueReader::operator()(const Key& key, std::array<std::string, 3>& value) {
  const auto texts = in_.texts(key.name, Repeats::allowed);
  if (texts.size() != 3) in_.refuse(key.name, "write three expressions, one a component");
  std::copy(texts.begin(), texts.end(), value.begin());
  return false;
}

bool ValueReader::operator()(const Key& key, std::array<Vec3, 3>& value) {
  const auto rows = in_.tables(key.name);
  if (rows.size() != 3)
    in_.refuse(key.name, "write three rows of three numbers: [[0, 0, 0], [0, 0, 0], [0, 0, 0]]");
  for (std::size_t i = 0; i < 3; ++i)
    value[i] = vector_of(*rows[i], key, fmt::format("{}.{}", path_of(key), i + 1));
  in_.given(key.name, to_toml(*in_.composite(key.name)));
  return false;
}

bool ValueReader::operator()(const Key& key, Shape& value) {
  value = read_shape(*in_.composite(key.name), path_of(key), reading_);
  return false;
}

bool ValueReader::operator()(const Key& key, std::optional<Shape>& value) {
  if (const auto* node = in_.composite(key.name)) value = read_shape(*node, path_of(key), reading_);
  return !value;
}

bool ValueReader::operator()(const Key& key, std::optional<TemperatureField>& value) {
  if (const auto* node = in_.composite(key.name))
    value = read_temperature(*node, path_of(key), reading_);
  else
    in_.ruled(key.name, "none", std::string(key.note));
  return false;
}

bool ValueReader::operator()(const Key& key, VelocityField& value) {
  if (const auto* node = in_.composite(key.name))
    value = read_velocity(*node, path_of(key), reading_);
  else
    in_.ruled(key.name, std::string(key.fallback), std::string(key.note));
  return false;
}

bool ValueReader::operator()(const Key& key, std::vector<Keyframe>& value) {
  value = read_keyframes(in_, key, reading_);
  return false;
}

bool ValueReader::operator()(const Key& key, std::optional<std::array<double, 2>>& value) {
  const auto pair = in_.maybe_numbers(key.name);
  if (!pair) return true;
  if (pair->size() != 2) in_.refuse(key.name, "write two numbers: [low, high]");
  value = {(*pair)[0], (*pair)[1]};
  return false;
}

bool ValueReader::operator()(const Key& key, std::optional<JointSpring>& value) {
  return sub_table(key, value);
}
bool ValueReader::operator()(const Key& key, std::optional<JointMotor>& value) {
  return sub_table(key, value);
}

template <class T>
bool ValueReader::sub_table(const Key& key, std::optional<T>& value) {
  const auto* node = in_.composite(key.name);
  if (!node) return true;
  TableReader in(*node, key.words, path_of(key), reading_.decisions, scene_keys());
  RecordReader(in, value.emplace(), reading_).all();
  return false;
}

std::optional<std::size_t> ValueReader::word_number(const Key& key) {
  const auto word = in_.maybe_text(key.name);
  if (!word) return {};
  const auto words = split_words(key.words);
  return static_cast<std::size_t>(std::find(words.begin(), words.end(), *word) - words.begin());
}

std::vector<std::size_t> ValueReader::word_numbers(const Key& key) {
  const auto words = split_words(key.words);
  std::vector<std::size_t> numbers;
  for (const auto& word : in_.texts(key.name))
    numbers.push_back(static_cast<std::size_t>(std::find(words.begin(), words.end(), word) - words.begin()));
  return numbers;
}

}  // namespace tripoint
