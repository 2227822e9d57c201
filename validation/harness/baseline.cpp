// SPDX-License-Identifier: BSD-3-Clause
#include "validation/harness/baseline.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "adapters/job.hpp"
#include "core/errors.hpp"
#include "scene/toml_node.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

std::string quoted(const std::string& text) {
  TomlNode node;
  node.kind = TomlNode::Kind::text, node.text = text;
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

AcceptedGate read_gate(const TomlNode& from) {
  return {text(from, "metric"), text(from, "engine"), text(from, "preset"), text(from, "mode"), text(from, "allows"), maybe_number(from, "level"), number(from, "room"),
          number(from, "value"), number(from, "uncertainty"), text(from, "class"), number(from, "first_room"), number(from, "first_value"), number(from, "loosened"),
          maybe_number(from, "limit"), maybe_number(from, "at_least"), maybe_number(from, "drift"), maybe_band(from), text(from, "measures")};
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
  const auto at = text.find(seal_key);
  if (at == std::string::npos) return text;
  const auto end = text.find('\n', at);
  return text.substr(0, at) + (end == std::string::npos ? "" : text.substr(end + 1));
}

std::string text_of_file(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

Baseline read_baseline(const std::string& file) {
  const auto top = read_toml(file);
  if (number(top, "format") != 1.0) throw InputError(file + ": has not format = 1");
  Baseline b;
  b.id = text(top, "case"), b.case_hash = text(top, "case_hash"), b.seed = static_cast<std::uint64_t>(std::max(0.0, number(top, "seed")));
  b.accepted = tables<Acceptance>(top, "accepted", [](const TomlNode& n) { return Acceptance{text(n, "date"), text(n, "commit"), text(n, "reason")}; });
  b.gates = tables<AcceptedGate>(top, "gate", read_gate);
  b.cost = tables<AcceptedCost>(top, "cost", [](const TomlNode& n) { return AcceptedCost{text(n, "run"), number(n, "pairs"), number(n, "steps"), number(n, "instructions"), text(n, "counted_on")}; });
  b.scene = text(top, "scene"), b.reference = text(top, "reference");
  b.profiles = texts(top, "profiles"), b.required = texts(top, "required");
  const auto seal = text(top, "seal");  // older versions wrote neither hashes nor seal
  b.sealed = seal.empty() ? b.scene.empty() : seal == text_hash(unsealed(text_of_file(file)));
  b.removed = static_cast<int>(number(top, "removed"));
  return b;
}

std::string baseline_text(const Baseline& b) {
  std::string out = "# Accepted figures. `tripoint gate accept --reason TEXT` writes this file; nothing else does.\nformat = 1\n";
  out += fmt::format("case = {}\ncase_hash = {}\nseed = {}\n", quoted(b.id), quoted(b.case_hash), b.seed);
  if (!b.scene.empty())
    out += fmt::format("scene = {}\nreference = {}\nprofiles = {}\nrequired = {}\n", quoted(b.scene), quoted(b.reference), quoted(b.profiles), quoted(b.required));
  if (b.removed > 0) out += fmt::format("removed = {}\n", b.removed);
  for (const auto& a : b.accepted) out += fmt::format("\n[[accepted]]\ndate = {}\ncommit = {}\nreason = {}\n", quoted(a.date), quoted(a.commit), quoted(a.reason));
  for (const auto& g : b.gates) {
    out += fmt::format("\n[[gate]]\nmetric = {}\nengine = {}\n", quoted(g.metric), quoted(g.engine));
    if (!g.preset.empty() && g.preset != "default") out += fmt::format("preset = {}\n", quoted(g.preset));
    if (!g.mode.empty()) out += fmt::format("mode = {}\n", quoted(g.mode));
    if (g.level) out += fmt::format("level = {}\n", number(*g.level));
    out += fmt::format("allows = {}\nroom = {}\nvalue = {}\nuncertainty = {}\n", quoted(g.allows), number(g.room), number(g.value), number(g.uncertainty));
    if (g.limit) out += fmt::format("limit = {}\n", number(*g.limit));
    if (g.at_least) out += fmt::format("at_least = {}\n", number(*g.at_least));
    if (g.band) out += fmt::format("band = [{}, {}]\n", number((*g.band)[0]), number((*g.band)[1]));
    if (g.drift) out += fmt::format("drift = {}\n", number(*g.drift));
    if (!g.measures.empty()) out += fmt::format("measures = {}\n", quoted(g.measures));
    if (!g.fit_class.empty()) out += fmt::format("class = {}\n", quoted(g.fit_class));
    out += fmt::format("first_room = {}\nfirst_value = {}\nloosened = {}\n", number(g.first_room), number(g.first_value), number(g.loosened));
  }
  for (const auto& c : b.cost) {
    out += fmt::format("\n[[cost]]\nrun = {}\npairs = {}\nsteps = {}\n", quoted(c.run), number(c.pairs), number(c.steps));
    if (c.instructions > 0.0) out += fmt::format("instructions = {}\ncounted_on = {}\n", number(c.instructions), quoted(c.counted_on));
  }
  const auto after = out.find("seed = ");
  return out.substr(0, after) + fmt::format("seal = {}\n", quoted(text_hash(out))) + out.substr(after);
}

}  // namespace tripoint
