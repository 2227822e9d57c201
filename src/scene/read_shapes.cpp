// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "scene/expression.hpp"
#include "scene/library.hpp"
#include "scene/nearest.hpp"
#include "scene/readers.hpp"

namespace tripoint {
namespace {

namespace fs = std::filesystem;
using Kind = TomlNode::Kind;

/// The `kind` of an inline table, one of the tables "<family>.<kind>" of the key table.
std::string read_kind(const TomlNode& node, std::string_view family, const std::string& path) {
  std::vector<std::string> kinds;
  for (const auto& t : scene_keys().tables())
    if (t.name.starts_with(family) && t.name.size() > family.size() && t.name[family.size()] == '.')
      kinds.emplace_back(t.name.substr(family.size() + 1));
  if (node.kind != Kind::table)
    throw InputError(node.place, fmt::format("`{}` must be a table {{kind = \"{}\", ...}}, not {} ({})", path, kinds.front(),
                                             kind_name(node.kind), printable(to_toml(node))));
  const auto* kind = node.find("kind");
  if (!kind) throw InputError(node.place, fmt::format("`{}` lacks the key `kind` (one of: {})", path, fmt::join(kinds, ", ")));
  for (const auto& k : kinds)
    if (kind->kind == Kind::text && kind->text == k) return k;
  throw InputError(
      kind->place,
      fmt::format("`{}.kind` = {} is none of: {}{}", path, printable(to_toml(*kind)), fmt::join(kinds, ", "),
                  kind->kind == Kind::text && !nearest(kind->text, kinds).empty() ? suggestion(kind->text, kinds) : ""));
}

Vec3 direction(TableReader& in, std::string_view key) {
  const Vec3 v = in.vector(key);
  const double length = norm(v);
  if (!(length > 0.0) || !std::isfinite(length))
    in.refuse(key, "the direction has no finite length: write for example [0, 0, 1]");
  return v / length;
}

std::string mesh_path(TableReader& in, const Reading& reading) {
  const fs::path given = in.text("file");
  for (const auto& base : {fs::path(reading.folder), fs::path(share_folder())}) {
    std::error_code error;
    const auto full = given.is_absolute() ? given : base / given;
    if (fs::is_regular_file(full, error)) return fs::absolute(full).lexically_normal().string();
  }
  in.refuse("file", fmt::format("no file `{}` beside the case: give a path from the case's folder", printable(given.string())));
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
  if (depth > 8) throw InputError(node.place, fmt::format("`{}` is nested deeper than 8 shapes: use one union", path));
  const auto kind = read_kind(node, "shape", path);
  TableReader in(node, "shape." + kind, path, reading.decisions, {"kind"});
  in.given("kind", "\"" + kind + "\"");
  Shape s;
  if (kind == "box") {
    s.kind = Shape::Kind::box, s.min = in.vector("min"), s.max = in.vector("max");
    for (std::size_t a = 0; a < 3; ++a)
      if (!(s.max[a] > s.min[a]))
        in.refuse("max", fmt::format("the box has no extent along {}: max must be greater than min", "xyz"[a]));
  } else if (kind == "sphere") {
    s.kind = Shape::Kind::sphere, s.centre = in.vector("centre"), s.radius = in.number("radius");
  } else if (kind == "cylinder") {
    s.kind = Shape::Kind::cylinder, s.base = in.vector("base"), s.axis = direction(in, "axis");
    s.length = in.number("length"), s.radius = in.number("radius");
  } else if (kind == "half_space") {
    s.kind = Shape::Kind::half_space, s.point = in.vector("point"), s.normal = direction(in, "normal");
  } else if (kind == "union") {
    s.kind = Shape::Kind::unite;
    const auto parts = in.tables("of");
    if (parts.empty()) in.refuse("of", "a union has at least one shape");
    for (std::size_t i = 0; i < parts.size(); ++i)
      s.of.push_back(read_shape(*parts[i], fmt::format("{}.of.{}", path, i + 1), reading, depth + 1));
  } else if (kind == "difference") {
    s.kind = Shape::Kind::difference;
    s.of.push_back(read_shape(*in.composite("from"), path + ".from", reading, depth + 1));
    s.of.push_back(read_shape(*in.composite("minus"), path + ".minus", reading, depth + 1));
  } else {
    s.kind = Shape::Kind::mesh, s.file = mesh_path(in, reading), s.scale = in.number("scale");
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
  const auto kind = read_kind(node, "temperature", path);
  TableReader in(node, "temperature." + kind, path, reading.decisions, {"kind"});
  in.given("kind", "\"" + kind + "\"");
  if (kind == "cosine") {
    f.kind = TemperatureField::Kind::cosine;
    f.mean = in.number("mean"), f.amplitude = in.number("amplitude"), f.wave_vector = in.vector("wave_vector"),
    f.phase = in.number("phase");
    if (f.mean - std::abs(f.amplitude) <= 0.0)
      in.refuse("amplitude", "the wave falls below 0 K: raise the mean or lower the amplitude");
  } else if (kind == "step") {
    f.kind = TemperatureField::Kind::step;
    f.point = in.vector("point"), f.normal = direction(in, "normal"), f.behind = in.number("behind"),
    f.ahead = in.number("ahead");
  } else {
    f.kind = TemperatureField::Kind::expression, f.expression = in.text("value");
    expression_is_sound(*node.find("value"), f.expression, path + ".value");
  }
  return f;
}

VelocityField read_velocity(const TomlNode& node, const std::string& path, Reading& reading) {
  VelocityField f;
  if (node.kind == Kind::array) {
    f.value = vector_of(node, key_row("body", "velocity"), path);
    reading.decisions.push_back({path, show(f.value), "given", true, node.place});
    return f;
  }
  const auto kind = read_kind(node, "velocity", path);
  TableReader in(node, "velocity." + kind, path, reading.decisions, {"kind"});
  in.given("kind", "\"" + kind + "\"");
  if (kind == "cosine") {
    f.kind = VelocityField::Kind::cosine;
    f.mean = in.vector("mean"), f.amplitude = in.vector("amplitude"), f.wave_vector = in.vector("wave_vector"),
    f.phase = in.number("phase");
  } else if (kind == "linear") {
    f.kind = VelocityField::Kind::linear, f.centre = in.vector("centre");
    const auto rows = in.tables("gradient");
    if (rows.size() != 3) in.refuse("gradient", "write three rows of three numbers: [[0, 0, 0], [0, 0, 0], [0, 0, 0]]");
    for (std::size_t i = 0; i < 3; ++i)
      f.gradient[i] = vector_of(*rows[i], key_row("velocity.linear", "gradient"), fmt::format("{}.gradient.{}", path, i + 1));
    in.given("gradient", to_toml(*in.composite("gradient")));
  } else if (kind == "taylor_green") {
    f.kind = VelocityField::Kind::taylor_green, f.speed = in.number("speed"), f.wavelength = in.number("wavelength");
  } else {
    f.kind = VelocityField::Kind::expression;
    const auto texts = in.texts("value", Repeats::allowed);
    if (texts.size() != 3) in.refuse("value", "write three expressions, one a component");
    for (std::size_t i = 0; i < 3; ++i) expression_is_sound(*node.find("value"), f.expression[i] = texts[i], path + ".value");
  }
  return f;
}

}  // namespace tripoint
