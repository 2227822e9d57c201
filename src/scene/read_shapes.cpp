// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "scene/place_records.hpp"
#include "scene/scene_keys.hpp"
#include "scene/value_reader.hpp"
#include "tables/expression.hpp"
#include "tables/library.hpp"
#include "tables/nearest.hpp"

namespace tripoint {
namespace {

namespace fs = std::filesystem;
using Kind = TomlNode::Kind;

/// The `kind` of an inline table, one of those of the Owner that have a table "FAMILY.KIND" in the key table.
template <class Owner>
std::string read_kind(const TomlNode& node, std::string_view family, const std::string& path, Owner& owner) {
  std::vector<std::string> words;
  const auto add = [&](const auto& kind) {
    if (!scene_keys().of(fmt::format("{}.{}", family, kind.word)).empty()) words.emplace_back(kind.word);
  };
  std::apply([&](const auto&... all) { (add(all), ...); }, kinds<Owner>);
  if (node.kind != Kind::table)
    throw InputError(node.place, fmt::format("`{}` must be a table {{kind = \"{}\", ...}}, not {} ({})", path,
                                             words.front(), kind_name(node.kind), printable(to_toml(node))));
  const auto* given = node.find("kind");
  if (!given)
    throw InputError(node.place,
                     fmt::format("`{}` lacks the key `kind` (one of: {})", path, fmt::join(words, ", ")));
  const bool is_text = given->kind == Kind::text;
  if (!is_text || std::find(words.begin(), words.end(), given->text) == words.end())
    throw InputError(
        given->place,
        fmt::format("`{}.kind` = {} is none of: {}{}", path, printable(to_toml(*given)),
                    fmt::join(words, ", "),
                    is_text && !nearest(given->text, words).empty() ? suggestion(given->text, words) : ""));
  const auto take = [&](const auto& kind) {
    if (kind.word == given->text) owner.kind = kind.kind;
  };
  std::apply([&](const auto&... all) { (take(all), ...); }, kinds<Owner>);
  return given->text;
}

/// The table of one kind: all of its keys that a member keeps.
template <class Owner>
class KindReader : public TableReader {
 public:
  KindReader(const TomlNode& node, std::string_view family, const std::string& path, Owner& owner,
             Reading& reading)
      : KindReader(node, fmt::format("{}.{}", family, read_kind(node, family, path, owner)), path, reading) {
    given("kind", to_toml(*node.find("kind")));
    RecordReader<Owner>(*this, owner, reading).all();
  }

 private:
  KindReader(const TomlNode& node, const std::string& table, const std::string& path, Reading& reading)
      : TableReader(node, table, path, reading.decisions, scene_keys(), {"kind"}) {}
};

/// A direction of any length, with length 1.
Vec3 direction(const TableReader& in, std::string_view key, const Vec3& v) {
  const double length = norm(v);
  if (!(length > 0.0) || !std::isfinite(length))
    in.refuse(key, "the direction has no finite length: write for example [0, 0, 1]");
  return v / length;
}

std::string mesh_path(const TableReader& in, const fs::path& given, const Reading& reading) {
  for (const auto& base : {fs::path(reading.folder), fs::path(share_folder())}) {
    std::error_code error;
    const auto full = given.is_absolute() ? given : base / given;
    if (fs::is_regular_file(full, error)) return fs::absolute(full).lexically_normal().string();
  }
  in.refuse("file", fmt::format("no file `{}` beside the case: give a path from the case's folder",
                                printable(given.string())));
}

void expression_is_sound(const TomlNode& place, const std::string& text, const std::string& path) {
  try {
    static_cast<void>(Expression(text));
  } catch (const InputError& e) {
    throw InputError(place.place, fmt::format("`{}`: {}", path, e.what()));
  }
}

}  // namespace

Shape read_shape(const TomlNode& node, const std::string& path, Reading& reading, int depth) {
  if (depth > 8)
    throw InputError(node.place, fmt::format("`{}` is nested deeper than 8 shapes: use one union", path));
  Shape s;
  KindReader in(node, "shape", path, s, reading);
  switch (s.kind) {
    case Shape::Kind::box:
      for (std::size_t a = 0; a < 3; ++a)
        if (!(s.max[a] > s.min[a]))
          in.refuse("max",
                    fmt::format("the box has no extent along {}: max must be greater than min", "xyz"[a]));
      break;
    case Shape::Kind::sphere:
      break;
    case Shape::Kind::cylinder:
      s.axis = direction(in, "axis", s.axis);
      break;
    case Shape::Kind::half_space:
      s.normal = direction(in, "normal", s.normal);
      break;
    case Shape::Kind::unite: {
      const auto parts = in.tables("of");
      if (parts.empty()) in.refuse("of", "a union has at least one shape");
      for (std::size_t i = 0; i < parts.size(); ++i)
        s.of.push_back(read_shape(*parts[i], fmt::format("{}.of.{}", path, i + 1), reading, depth + 1));
      break;
    }
    case Shape::Kind::difference:
      s.of.push_back(read_shape(*in.composite("from"), path + ".from", reading, depth + 1));
      s.of.push_back(read_shape(*in.composite("minus"), path + ".minus", reading, depth + 1));
      break;
    case Shape::Kind::mesh:
      s.file = mesh_path(in, s.file, reading);
  }
  return s;
}

TemperatureField read_temperature(const TomlNode& node, const std::string& path, Reading& reading) {
  TemperatureField f;
  if (node.kind != Kind::table) {
    f.value = number_of(node, key_row("body", "temperature"), path);
    reading.decisions.push_back({path, show(f.value), "given", true, node.place});
    return f;
  }
  KindReader in(node, "temperature", path, f, reading);
  if (f.kind == TemperatureField::Kind::cosine && f.mean - std::abs(f.amplitude) <= 0.0)
    in.refuse("amplitude", "the wave falls below 0 K: raise the mean or lower the amplitude");
  if (f.kind == TemperatureField::Kind::step) f.normal = direction(in, "normal", f.normal);
  if (f.kind == TemperatureField::Kind::expression)
    expression_is_sound(*node.find("value"), f.expression, path + ".value");
  return f;
}

VelocityField read_velocity(const TomlNode& node, const std::string& path, Reading& reading) {
  VelocityField f;
  if (node.kind == Kind::array) {
    f.value = vector_of(node, key_row("body", "velocity"), path);
    reading.decisions.push_back({path, show(f.value), "given", true, node.place});
    return f;
  }
  KindReader in(node, "velocity", path, f, reading);
  if (f.kind == VelocityField::Kind::expression)
    for (const std::string& text : f.expression)
      expression_is_sound(*node.find("value"), text, path + ".value");
  return f;
}

}  // namespace tripoint
