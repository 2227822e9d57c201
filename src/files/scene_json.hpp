// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>

#include <nlohmann/json_fwd.hpp>

#include "files/job.hpp"

/// The scene of a job as JSON, keys as in the case file; every value SI.
namespace tripoint {

[[nodiscard]] nlohmann::ordered_json scene_to_json(const Scene&, const std::vector<JobBody>&);
/// @throws InputError naming the key
void scene_from_json(const nlohmann::ordered_json&, Scene&, std::vector<JobBody>&);

[[nodiscard]] nlohmann::ordered_json to_json(const Vec3&);
[[nodiscard]] nlohmann::ordered_json to_json(const Quaternion&);
[[nodiscard]] nlohmann::ordered_json to_json(const Settings&);

/// A JSON object whose members are asked for by name: an error says which one, and where.
class JsonObject {
 public:
  JsonObject(const nlohmann::ordered_json& value, std::string path);
  [[nodiscard]] bool has(const std::string& key) const;  ///< there and not null
  [[nodiscard]] double number(const std::string& key) const;
  [[nodiscard]] long integer(const std::string& key) const;
  [[nodiscard]] bool flag(const std::string& key) const;
  [[nodiscard]] std::string text(const std::string& key) const;
  [[nodiscard]] Vec3 vector(const std::string& key) const;
  [[nodiscard]] Quaternion quaternion(const std::string& key) const;
  [[nodiscard]] std::array<Vec3, 3> rows(const std::string& key) const;
  [[nodiscard]] std::vector<double> numbers(const std::string& key) const;
  [[nodiscard]] std::vector<std::string> texts(const std::string& key) const;
  [[nodiscard]] Settings settings(const std::string& key) const;
  [[nodiscard]] JsonObject object(const std::string& key) const;
  [[nodiscard]] std::vector<JsonObject> objects(const std::string& key) const;
  [[nodiscard]] std::optional<double> maybe_number(const std::string& key) const;
  [[nodiscard]] double number_or(const std::string& key, double other) const {
    return maybe_number(key).value_or(other);
  }
  [[nodiscard]] std::string text_or(const std::string& key, const std::string& other) const {
    return has(key) ? text(key) : other;
  }
  [[nodiscard]] bool flag_or(const std::string& key, bool other) const {
    return has(key) ? flag(key) : other;
  }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  [[nodiscard]] const nlohmann::ordered_json& at(const std::string& key) const;
  [[noreturn]] void wrong(const std::string& key, const std::string& expected) const;
  const nlohmann::ordered_json* value_;
  std::string path_;
};

}  // namespace tripoint
