// SPDX-License-Identifier: BSD-3-Clause
#include "tables/table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tables/nearest.hpp"
#include "tables/units.hpp"

namespace tripoint {
namespace {

using Kind = TomlNode::Kind;

constexpr double most_of_any_unit = 1e30;  ///< squares of energies of such numbers are still finite

/// The row's fallback as a value; parsed once for each use, which costs nothing beside reading the file.
TomlNode fallback_value(const Key& row) {
  TomlNode n;
  const auto text = row.fallback;
  if (text == "true" || text == "false") {
    n.kind = Kind::boolean;
    n.flag = text == "true";
  } else if (text.starts_with('"')) {
    n.kind = Kind::text;
    n.text = text.substr(1, text.size() - 2);
  } else if (text.starts_with('[')) {
    n.kind = Kind::array;
    std::string plain(text.substr(1, text.size() - 2));
    std::replace(plain.begin(), plain.end(), ',', ' ');
    for (const auto& word : split_words(plain)) {
      TomlNode item;
      if (word.starts_with('"')) {
        item.kind = Kind::text;
        item.text = word.substr(1, word.size() - 2);
      } else {
        item.kind = Kind::real;
        item.real = std::stod(word);
      }
      n.items.push_back(item);
    }
  } else if (text == "{}") {
    n.kind = Kind::table;
  } else if (row.type == ValueType::integer) {
    n.kind = Kind::integer;
    n.integer = std::stol(std::string(text));
  } else {
    n.kind = Kind::real;
    n.real = std::stod(std::string(text));
  }
  return n;
}

struct Absent {
  std::vector<std::string_view> words;  ///< of a key or table that people bring
  std::string_view answer;
};
const std::vector<Absent> not_simulated{
    {{"surface_tension", "cohesion", "contact_angle", "wetting"}, "surface tension is not simulated"},
    {{"joint", "hinge", "slider", "constraint", "revolute", "prismatic", "ball_socket"},
     "a [[joint]] of kind hinge, ball, slider, fixed, distance or universal holds rigid bodies"},
    {{"springs", "damper", "tendon", "muscle"},
     "a [[spring]] holds two rigid bodies, or one and the world, by a spring and a damper"},
    {{"rope", "cable", "chain", "cloth", "shell"},
     "ropes and sheets are not simulated as such; an elastic body of three particles or more across is the "
     "thinnest"},
    {{"motor", "actuator", "controller"},
     "a [[joint]] has a motor with an effort or a speed; motion = \"prescribed\" with keyframes leads a "
     "body, an "
     "event of kind "
     "\"grip\" moves those in a "
     "region"},
    {{"external_force", "body_force", "thrust", "applied_force", "force", "applied_load", "torque"},
     "a [[force]] pushes a rigid body and turns it by a torque, and scene.gravity acts on all that "
     "is free; other "
     "forces from "
     "outside are not simulated; motion = \"prescribed\" leads a body"},
    {{"wind", "drag", "air_density", "atmosphere"},
     "air is not simulated; a liquid body of its density and viscosity is the nearest to it"},
    {{"turbulence", "k_epsilon", "smagorinsky"},
     "no model of turbulence is there: what the particles resolve is simulated"},
    {{"radiation", "emissivity", "convection", "heat_flux", "heat_source"},
     "a [[source]] gives heat: heat and heat_density within matter, flux, transfer_coefficient and "
     "emissivity through surfaces; "
     "temperature_held and events of kind \"heat\" hold a temperature"},
    {{"thermal_expansion", "buoyancy"},
     "thermal_expansion of a [[material]] makes its liquid rise and sink with temperature; solids do not "
     "expand"},
    {{"dimension", "plane_strain", "axisymmetric"},
     "scenes have three dimensions; a slab of five layers between periodic sides stands for a plane"},
    {{"outlet", "outflow", "on_escape"},
     "an [[outflow]] removes liquid in its shape, scene.on_escape = \"remove\" what leaves scene.min..max"},
    {{"mass", "inertia"},
     "a body weighs what its particles do, density times their volume: choose the density, and `tripoint "
     "check` says what "
     "they weigh"},
    {{"magnet", "electric", "charge"}, "electric and magnetic fields are not simulated"}};

/// For words that other programs have: why this one has not, and what serves.
std::string what_there_is_instead(std::string_view key) {
  const auto holds = [&](std::string_view word) { return key.find(word) != key.npos; };
  if (holds("friction") || holds("restitution"))
    return "friction and restitution belong to pairs of materials: write a [[contact]] with materials, "
           "friction and "
           "restitution; joined_to bonds bodies";
  if (holds("damping"))
    return "no term damps a motion; scene.contact_viscosity [Pa s] takes energy where solids touch, "
           "viscosity [Pa s] in a liquid";
  for (const auto& [words, answer] : not_simulated)
    if (std::ranges::any_of(words, holds)) return std::string(answer);
  return {};
}

std::string expected(const Key& row) {
  std::string what(type_text(row.type));
  if (!row.unit.empty()) what += fmt::format(" in {}", row.unit);
  if (!row.words.empty() && (row.type == ValueType::word || row.type == ValueType::words))
    what += fmt::format(" of: {}", row.words);
  return what;
}

}  // namespace

std::string show(double v) { return fmt::format("{}", v); }
std::string show(const Vec3& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }
std::string show(const std::vector<double>& v) { return fmt::format("[{}]", fmt::join(v, ", ")); }
std::string show(const std::vector<std::string>& v) {
  return v.empty() ? "[]" : fmt::format("[\"{}\"]", fmt::join(v, "\", \""));
}

TableReader::TableReader(const TomlNode& node, std::string_view table, std::string path,
                         std::vector<Decision>& decisions, const KeyTable& keys,
                         std::vector<std::string> extra)
    : node_(node),
      keys_(keys),
      table_(table),
      path_(std::move(path)),
      decisions_(decisions),
      first_(decisions.size()) {
  if (node.kind != Kind::table)
    throw InputError(node.place, fmt::format("`{}` must be a table, not {}", path_, kind_name(node.kind)));
  auto known = keys.names(table);
  known.insert(known.begin(), extra.begin(), extra.end());
  for (const auto& [key, value] : node.members)
    if (std::find(known.begin(), known.end(), key) == known.end() && !keys.has(table, key)) {
      const auto taught = what_there_is_instead(key);
      throw InputError(value.key_place,
                       fmt::format("unknown key `{}`{}{}", printable(key),
                                   path_.empty() ? "" : fmt::format(" in `{}`", printable(path_)),
                                   taught.empty() ? suggestion(key, known) : ": " + taught));
    }
}

void TableReader::fall_back_on(const TomlNode& library, std::string reason) {
  library_ = &library;
  library_reason_ = std::move(reason);
}

SourcePlace TableReader::place(std::string_view key) const {
  const auto* v = node_.find(key);
  return v ? v->place : node_.place;
}

void TableReader::refuse(std::string_view key, const std::string& what) const {
  throw InputError(place(key),
                   fmt::format("`{}`: {}", printable(key.empty() ? path_ : path_of(key), 120), what));
}

TableReader::Found TableReader::find(std::string_view key) const {
  Found f;
  f.row = &keys_.row(table_, key);
  f.value = node_.find(key);
  f.from_case = f.value != nullptr;
  if (!f.value && library_) f.value = library_->find(key);
  if (!f.value && f.row->required()) {
    const auto what =
        fmt::format("`{}` lacks the key `{}` ({}): {}", path_.empty() ? "the case" : printable(path_), key,
                    expected(*f.row), f.row->meaning);
    throw InputError(node_.place, what);
  }
  return f;
}

void TableReader::record(const Found& f, std::string value) {
  Decision d{path_of(f.row->name), std::move(value), "", f.from_case, {}};
  if (f.from_case) {
    d.reason = "given";
    d.place = f.value->place;
  } else if (f.value) {
    d.reason = library_reason_;
    d.place = f.value->place;
  } else
    d.reason = f.row->note;
  decisions_.push_back(std::move(d));
}

void TableReader::ruled(std::string_view key, std::string value, std::string reason) {
  Decision d{path_of(key), std::move(value), std::move(reason), false, {}};
  for (std::size_t i = first_; i < decisions_.size(); ++i)
    if (decisions_[i].key == d.key && !decisions_[i].given)
      return static_cast<void>(decisions_[i] = std::move(d));
  decisions_.push_back(std::move(d));
}

void TableReader::given(std::string_view key, std::string value) {
  decisions_.push_back({path_of(key), std::move(value), "given", true, place(key)});
}

namespace {

[[noreturn]] void wrong_type(const TomlNode& v, const Key& row, const std::string& path) {
  throw InputError(v.place, fmt::format("`{}` must be {}, not {} ({})", printable(path, 120), expected(row),
                                        kind_name(v.kind), printable(to_toml(v))));
}

double raw_number(const TomlNode& v, const Key& row, const std::string& path) {
  if (v.kind == Kind::integer) return static_cast<double>(v.integer);
  if (v.kind == Kind::real) return v.real;
  if (v.kind != Kind::text) wrong_type(v, row, path);
  try {
    return parse_quantity(v.text, row.unit);
  } catch (const std::invalid_argument& e) {
    throw InputError(v.place, fmt::format("`{}`: {}", printable(path, 120), e.what()));
  }
}

}  // namespace

double number_of(const TomlNode& v, const Key& row, const std::string& path) {
  const double value = raw_number(v, row, path);
  const auto refuse = [&](const std::string& why) {
    throw InputError(v.place, fmt::format("`{}` = {}{}", printable(path, 120), value, why));
  };
  if (!std::isfinite(value))
    refuse(fmt::format(": write a finite number{}{}", row.unit.empty() ? "" : " in ", row.unit));
  if (!row.unit.empty() && std::abs(value) > most_of_any_unit)
    refuse(fmt::format(" {}: products of such numbers are not finite; write a number of size up to {:.0e}",
                       row.unit, most_of_any_unit));
  if (row.range == Range::poisson && value >= 0.5)
    refuse(
        ": at 0.5 the solid is incompressible and its stiffness infinite, so no time step is short enough; "
        "write less than 0.5 "
        "(0.45 serves for rubber)");
  if (!in_range(row.range, value))
    refuse(fmt::format(" must be {}{}{}", range_text(row.range), row.unit.empty() ? "" : " ", row.unit));
  return value;
}

std::vector<double> numbers_of(const TomlNode& v, const Key& row, const std::string& path) {
  if (v.kind != Kind::array) wrong_type(v, row, path);
  std::vector<double> out;
  for (const auto& item : v.items) out.push_back(number_of(item, row, path));
  return out;
}

Vec3 vector_of(const TomlNode& v, const Key& row, const std::string& path) {
  const auto c = numbers_of(v, row, path);
  if (c.size() != 3)
    throw InputError(v.place,
                     fmt::format("`{}` has {} components: write [x, y, z]", printable(path, 120), c.size()));
  return {c[0], c[1], c[2]};
}

std::optional<double> TableReader::maybe_number(std::string_view key) {
  const Found f = find(key);
  if (!f.value) {
    if (f.row->fallback.empty())
      record(f, "none");
    else if (f.row->fallback == "\"auto\"")
      record(f, "\"auto\"");
    return {};
  }
  if (f.row->type == ValueType::number_or_auto && f.value->kind == Kind::text && f.value->text == "auto") {
    record(f, "\"auto\"");
    return {};
  }
  const double value = number_of(*f.value, *f.row, path_of(key));
  record(f, show(value));
  return value;
}

double TableReader::number(std::string_view key) {
  const Found f = find(key);
  const double value = f.value ? number_of(*f.value, *f.row, path_of(key))
                               : number_of(fallback_value(*f.row), *f.row, path_of(key));
  record(f, show(value));
  return value;
}

long TableReader::integer(std::string_view key) {
  const Found f = find(key);
  const TomlNode v = f.value ? *f.value : fallback_value(*f.row);
  if (v.kind != Kind::integer) wrong_type(v, *f.row, path_of(key));
  if (!in_range(f.row->range, static_cast<double>(v.integer)))
    throw InputError(v.place,
                     fmt::format("`{}` = {} must be {}", path_of(key), v.integer, range_text(f.row->range)));
  record(f, std::to_string(v.integer));
  return v.integer;
}

std::optional<bool> TableReader::maybe_flag(std::string_view key) {
  const Found f = find(key);
  if (!f.value && f.row->fallback == "=") return {};
  const TomlNode v = f.value ? *f.value : fallback_value(*f.row);
  if (v.kind != Kind::boolean) wrong_type(v, *f.row, path_of(key));
  record(f, v.flag ? "true" : "false");
  return v.flag;
}

bool TableReader::flag(std::string_view key) { return maybe_flag(key).value(); }

std::optional<std::string> TableReader::maybe_text(std::string_view key) {
  const Found f = find(key);
  if (!f.value && (f.row->fallback == "=" || f.row->fallback.empty())) {
    if (f.row->fallback.empty()) record(f, "none");
    return {};
  }
  const TomlNode v = f.value ? *f.value : fallback_value(*f.row);
  if (v.kind != Kind::text) wrong_type(v, *f.row, path_of(key));
  if (v.text.size() > 4096)
    throw InputError(v.place, fmt::format("`{}` is longer than 4096 bytes: shorten it", path_of(key)));
  if (f.value && f.row->type == ValueType::word) {
    const auto known = split_words(f.row->words);
    if (std::find(known.begin(), known.end(), v.text) == known.end())
      throw InputError(v.place, fmt::format("`{}` = \"{}\" is none of: {}{}", printable(path_of(key), 120),
                                            printable(v.text), fmt::join(known, ", "),
                                            nearest(v.text, known).empty() ? "" : suggestion(v.text, known)));
  }
  record(f, "\"" + v.text + "\"");
  return v.text;
}

std::string TableReader::text(std::string_view key) { return maybe_text(key).value(); }

std::optional<std::vector<double>> TableReader::maybe_numbers(std::string_view key) {
  const Found f = find(key);
  if (!f.value && f.row->fallback.empty()) {
    record(f, "none");
    return {};
  }
  const auto values = numbers_of(f.value ? *f.value : fallback_value(*f.row), *f.row, path_of(key));
  record(f, show(values));
  return values;
}

std::vector<double> TableReader::numbers(std::string_view key) { return maybe_numbers(key).value(); }

std::vector<double> TableReader::numbers_in(std::string_view unit, std::string_view key) {
  const Found f = find(key);
  Key row = *f.row;
  row.unit = unit;
  auto values = numbers_of(f.value ? *f.value : fallback_value(row), row, path_of(key));
  record(f, show(values));
  return values;
}

std::optional<Vec3> TableReader::maybe_vector(std::string_view key) {
  const Found f = find(key);
  if (!f.value && f.row->fallback.empty()) {
    record(f, "none");
    return {};
  }
  const TomlNode v = f.value ? *f.value : fallback_value(*f.row);
  const Vec3 value = vector_of(v, *f.row, path_of(key));
  record(f, show(value));
  return value;
}

Vec3 TableReader::vector(std::string_view key) { return maybe_vector(key).value(); }

std::vector<std::string> TableReader::texts(std::string_view key, Repeats repeats) {
  const Found f = find(key);
  const TomlNode v = f.value ? *f.value : fallback_value(*f.row);
  std::vector<std::string> out;
  if (v.kind == Kind::text && f.row->type == ValueType::text_or_texts) {
    out.push_back(v.text);
  } else {
    if (v.kind != Kind::array) wrong_type(v, *f.row, path_of(key));
    for (const auto& item : v.items) {
      if (item.kind != Kind::text) wrong_type(item, *f.row, path_of(key));
      if (f.row->type == ValueType::words) {
        const auto known = split_words(f.row->words);
        if (std::find(known.begin(), known.end(), item.text) == known.end())
          throw InputError(item.place, fmt::format("`{}`: \"{}\" is none of: {}", path_of(key),
                                                   printable(item.text), fmt::join(known, ", ")));
      }
      if (repeats == Repeats::refused && std::find(out.begin(), out.end(), item.text) != out.end())
        throw InputError(item.place, fmt::format("`{}` names \"{}\" twice: remove one", path_of(key),
                                                 printable(item.text)));
      out.push_back(item.text);
    }
  }
  record(f, show(out));
  return out;
}

Settings TableReader::settings(std::string_view key) {
  const Found f = find(key);
  Settings out;
  if (!f.value) {
    record(f, "{}");
    return out;
  }
  if (f.value->kind != Kind::table) wrong_type(*f.value, *f.row, path_of(key));
  const Key plain{table_, key, ValueType::number, "", Range::any, "", "", "", ""};
  for (const auto& [name, v] : f.value->members) {
    switch (v.kind) {
      case Kind::boolean:
        out[name] = v.flag;
        break;
      case Kind::text:
        out[name] = v.text;
        break;
      case Kind::integer:
      case Kind::real:
        out[name] = number_of(v, plain, path_of(key) + "." + name);
        break;
      case Kind::array:
        out[name] = numbers_of(v, plain, path_of(key) + "." + name);
        break;
      default:
        throw InputError(
            v.place,
            fmt::format("`{}.{}` must be a number, a text, true or false, or an array of numbers, not {}",
                        path_of(key), printable(name), kind_name(v.kind)));
    }
    decisions_.push_back({path_of(key) + "." + name, to_toml(v), "given", true, v.place});
  }
  return out;
}

const TomlNode* TableReader::composite(std::string_view key) const { return find(key).value; }

std::vector<const TomlNode*> TableReader::tables(std::string_view key) const {
  const Found f = find(key);
  std::vector<const TomlNode*> out;
  if (!f.value) return out;
  if (f.value->kind != Kind::array) wrong_type(*f.value, *f.row, path_of(key));
  if (f.value->items.size() > 10000)
    throw InputError(f.value->place,
                     fmt::format("`{}` has {} entries; at most 10000 are read", key, f.value->items.size()));
  for (const auto& item : f.value->items) out.push_back(&item);
  return out;
}

}  // namespace tripoint
