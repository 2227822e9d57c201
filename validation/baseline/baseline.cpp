// SPDX-License-Identifier: BSD-3-Clause
#include "validation/baseline/baseline.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/errors.hpp"
#include "core/whole_number.hpp"
#include "files/job.hpp"
#include "tables/toml_node.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/judge/apply_gate.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

std::string quoted(const std::string& text) {
  TomlNode node;
  node.kind = TomlNode::Kind::text;
  node.text = text;
  return to_toml(node);
}

/// A number as TOML: it always holds a point or an exponent.
std::string number(double value) {
  if (!std::isfinite(value)) return std::isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf";
  std::string text = fmt::format("{}", value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string text(const TomlNode& from, std::string_view key) {
  const auto* v = from.find(key);
  return v && v->kind == TomlNode::Kind::text ? v->text : std::string();
}

std::optional<double> maybe_number(const TomlNode& from, std::string_view key) {
  const auto* v = from.find(key);
  if (!v) return {};
  if (v->kind == TomlNode::Kind::integer) return static_cast<double>(v->integer);
  if (v->kind != TomlNode::Kind::real) throw InputError(v->place, fmt::format("{} is no number", key));
  return v->real;
}

std::vector<std::string> texts(const TomlNode& from, std::string_view key) {
  std::vector<std::string> list;
  if (const auto* v = from.find(key); v && v->kind == TomlNode::Kind::array)
    for (const auto& item : v->items) list.push_back(item.text);
  return list;
}

std::string quoted(const std::vector<std::string>& words) {
  std::string list;
  for (const auto& word : words) list += (list.empty() ? "" : ", ") + quoted(word);
  return "[" + list + "]";
}

std::optional<std::array<double, 2>> maybe_band(const TomlNode& from) {
  const auto* v = from.find("band");
  if (!v) return {};
  if (v->kind != TomlNode::Kind::array || v->items.size() != 2) throw InputError(v->place, "band is not [low, high]");
  const auto edge = [](const TomlNode& n) { return n.kind == TomlNode::Kind::integer ? static_cast<double>(n.integer) : n.real; };
  return std::array<double, 2>{edge(v->items[0]), edge(v->items[1])};
}

double number(const TomlNode& from, std::string_view key) { return maybe_number(from, key).value_or(0.0); }

template <class T, class Read>
std::vector<T> tables(const TomlNode& from, std::string_view key, Read read) {
  std::vector<T> list;
  if (const auto* v = from.find(key); v && v->kind == TomlNode::Kind::array)
    for (const auto& item : v->items) list.push_back(read(item));
  return list;
}

/// The edges that were accepted, as the gate of a case.
Gate accepted_gate(const AcceptedGate& accepted) {
  Gate gate;
  gate.limit = accepted.limit;
  gate.at_least = accepted.at_least;
  gate.band = accepted.band;
  return gate;
}

std::optional<FitClass> fit_class(const TomlNode& from) {
  const auto word = text(from, "class");
  if (word.empty()) return {};
  if (const auto found = find_word<FitClass>(word)) return found;
  throw InputError(from.place, "class: `" + printable(word) + "` is no class of convergence");
}

JudgedMode mode(const TomlNode& from) {
  const auto word = text(from, "mode");
  if (const auto found = find_word<JudgedMode>(word)) return *found;
  throw InputError(from.place, "mode: `" + printable(word) + "` is no mode of a gate");
}

/// Fields that a row leaves out follow from the rest of it. The words and the room follow from the edges, the first baseline's
/// figures from today's.
AcceptedGate read_gate(const TomlNode& from) {
  AcceptedGate g;
  g.metric = text(from, "metric");
  g.engine = text(from, "engine");
  g.preset = text(from, "preset");
  g.mode = mode(from);
  g.level = maybe_number(from, "level");
  g.limit = maybe_number(from, "limit");
  g.at_least = maybe_number(from, "at_least");
  g.drift = maybe_number(from, "drift");
  g.band = maybe_band(from);
  g.value = number(from, "value");
  g.uncertainty = number(from, "uncertainty");
  g.measures = text(from, "measures");
  g.fit_class = fit_class(from);
  g.allows = from.find("allows") ? text(from, "allows") : describe(accepted_gate(g));
  g.room = maybe_number(from, "room").value_or(room_of(accepted_gate(g)));
  g.first_room = maybe_number(from, "first_room").value_or(g.room);
  g.first_value = maybe_number(from, "first_value").value_or(g.value);
  g.loosened = number(from, "loosened");
  return g;
}

}  // namespace

namespace {

struct Place {
  fs::path baselines, below, cases;  ///< the folder of the suite's baselines, the file below it, the folder of its cases
};

Place place_of(const std::string& case_file) {
  std::error_code none;
  auto file = fs::weakly_canonical(fs::path(case_file), none);
  if (none) file = case_file;
  fs::path below = file.filename();
  for (auto folder = file.parent_path(); folder.has_relative_path(); folder = folder.parent_path()) {
    if (folder.filename() == "cases") return {folder.parent_path() / "baselines", below, folder};
    below = folder.filename() / below;
  }
  return {file.parent_path() / "baselines", file.filename(), file.parent_path()};
}

}  // namespace

std::string baseline_file(const std::string& case_file, const std::string& root) {
  const auto place = place_of(case_file);
  return ((root.empty() ? place.baselines : fs::path(root)) / place.below).string();
}

std::string baseline_folder(const std::string& case_file) { return place_of(case_file).baselines.string(); }
std::string folder_of_cases(const std::string& case_file) { return place_of(case_file).cases.string(); }

bool keeps_baselines(const std::string& case_file) {
  std::error_code none;
  return fs::is_directory(place_of(case_file).baselines, none);
}

namespace {

constexpr std::string_view seal_key = "seal = \"";

/// The text without its line `seal`, which holds the hash of the rest.
std::string unsealed(const std::string& text) {
  const auto before = text.find(fmt::format("\n{}", seal_key));  // of a line: a name may hold these words
  if (before == std::string::npos) return text;
  const auto end = text.find('\n', before + 1);
  return text.substr(0, before + 1) + (end == std::string::npos ? "" : text.substr(end + 1));
}

}  // namespace

std::string text_of_file(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Baseline read_baseline(const std::string& file) {
  const auto top = read_toml(file);
  if (number(top, "format") != 1.0) throw InputError(file + ": has not format = 1");
  Baseline b;
  b.id = text(top, "case");
  b.case_hash = text(top, "case_hash");
  b.seed = whole_number<std::uint64_t>(number(top, "seed"));
  b.accepted = tables<Acceptance>(top, "accepted", [](const TomlNode& n) {
    return Acceptance{text(n, "date"), text(n, "commit"), text(n, "reason")};
  });
  b.gates = tables<AcceptedGate>(top, "gate", read_gate);
  b.cost = tables<AcceptedCost>(top, "cost", [](const TomlNode& n) {
    return AcceptedCost{text(n, "run"), number(n, "pairs"), number(n, "steps"), number(n, "instructions"), text(n, "counted_on")};
  });
  b.engines = tables<AcceptedEngine>(top, "engines", [](const TomlNode& n) {
    return AcceptedEngine{text(n, "name"), text(n, "version"), text(n, "executable")};
  });
  b.scene = text(top, "scene");
  b.reference = text(top, "reference");
  b.profiles = texts(top, "profiles");
  b.required = texts(top, "required");
  const auto seal = text(top, "seal");  // older versions wrote neither hashes nor seal
  b.sealed = seal.empty() ? b.scene.empty() : seal == text_hash(unsealed(text_of_file(file)));
  b.removed = whole_number<int>(number(top, "removed"));
  return b;
}

namespace {

/// An inline table of TOML: one row of a list, whose empty parts are left out.
class Row {
 public:
  void say(std::string_view key, const std::string& words) {
    if (!words.empty()) add(key, quoted(words));
  }
  void say(std::string_view key, std::optional<double> value) {
    if (value) add(key, number(*value));
  }
  void say_unless(double known, std::string_view key, double value) {
    if (value != known) add(key, number(value));
  }
  void add(std::string_view key, const std::string& value) {
    text_ += fmt::format("{}{} = {}", text_.empty() ? "" : ", ", key, value);
  }
  [[nodiscard]] std::string text() const { return "  { " + text_ + " },\n"; }

 private:
  std::string text_;
};

std::string row_of(const AcceptedGate& g) {
  Row row;
  row.say("metric", g.metric);
  row.say("engine", g.engine);
  row.say("preset", preset_unless_default(g.preset));
  row.say("mode", std::string(to_string(g.mode)));
  row.say("level", g.level);
  row.say("limit", g.limit);
  row.say("at_least", g.at_least);
  if (g.band) row.add("band", fmt::format("[{}, {}]", number((*g.band)[0]), number((*g.band)[1])));
  row.say("drift", g.drift);
  if (g.allows != describe(accepted_gate(g))) row.say("allows", g.allows);
  row.say_unless(room_of(accepted_gate(g)), "room", g.room);
  row.say("value", g.value);
  row.say_unless(0.0, "uncertainty", g.uncertainty);
  if (g.fit_class) row.say("class", std::string(to_string(*g.fit_class)));
  row.say_unless(g.room, "first_room", g.first_room);
  row.say_unless(g.value, "first_value", g.first_value);
  row.say_unless(0.0, "loosened", g.loosened);
  row.say("measures", g.measures);
  return row.text();
}

std::string row_of(const Acceptance& a) {
  Row row;
  row.say("date", a.date);
  row.say("commit", a.commit);
  row.say("reason", a.reason);
  return row.text();
}

std::string row_of(const AcceptedCost& c) {
  Row row;
  row.say("run", c.run);
  row.say("pairs", c.pairs);
  row.say("steps", c.steps);
  row.say_unless(0.0, "instructions", c.instructions);
  row.say("counted_on", c.counted_on);
  return row.text();
}

std::string row_of(const AcceptedEngine& e) {
  Row row;
  row.say("name", e.name);
  row.say("version", e.version);
  row.say("executable", e.executable);
  return row.text();
}

template <class T>
std::string list_of(std::string_view key, const std::vector<T>& items) {
  if (items.empty()) return {};
  std::string out = fmt::format("\n{} = [\n", key);
  for (const auto& item : items) out += row_of(item);
  return out + "]\n";
}

}  // namespace

std::string baseline_text(const Baseline& b) {
  std::string out = "# Accepted figures. `tripoint gate accept --reason TEXT` writes this file; nothing else does.\nformat = 1\n";
  out += fmt::format("case = {}\ncase_hash = {}\nseed = {}\n", quoted(b.id), quoted(b.case_hash), b.seed);
  if (!b.scene.empty())
    out += fmt::format("scene = {}\nreference = {}\nprofiles = {}\nrequired = {}\n", quoted(b.scene), quoted(b.reference),
                       quoted(b.profiles), quoted(b.required));
  if (b.removed > 0) out += fmt::format("removed = {}\n", b.removed);
  out += list_of("accepted", b.accepted) + list_of("engines", b.engines) + list_of("gate", b.gates) + list_of("cost", b.cost);
  const auto after = out.find("\nseed = ") + 1;
  return out.substr(0, after) + fmt::format("seal = {}\n", quoted(text_hash(out))) + out.substr(after);
}

}  // namespace tripoint
