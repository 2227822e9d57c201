// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "validation/case/case_document.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/publish/adopt.hpp"
#include "validation/results/escaped_text.hpp"

/// The adopted case as a document: what is of its source stays, and what judged other engines gives place to
/// the new gates.
namespace tripoint {
namespace {

using Kind = TomlNode::Kind;

TomlNode text_node(const std::string& text) {
  TomlNode n;
  n.kind = Kind::text;
  n.text = text;
  return n;
}

TomlNode flag_node(bool flag) {
  TomlNode n;
  n.kind = Kind::boolean;
  n.flag = flag;
  return n;
}

TomlNode real_node(double value) {
  TomlNode n;
  n.kind = Kind::real;
  n.real = value;
  return n;
}

TomlNode list_node(std::vector<TomlNode> items) {
  TomlNode n;
  n.kind = Kind::array;
  n.items = std::move(items);
  return n;
}

/// A number for people to read, of as many digits as the measurement supports.
double rounded(double value) { return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr); }

void put(TomlNode& table, const std::string& key, TomlNode value) {
  table.members.emplace_back(key, std::move(value));
}

void remove(TomlNode& table, const std::string& key) {
  std::erase_if(table.members, [&](const auto& m) { return m.first == key; });
}

/// [case] without the words that are of the source's suite: profiles, tags, and what its own engines prove.
void write_head(TomlNode& document, const AdoptedCase& c, const EngineEntry& engine,
                const std::string& despite) {
  TomlNode head;
  if (auto* given = document.find("case")) head = std::move(*given);
  remove(document, "case");
  for (const char* key : {"id", "profiles", "tags", "modes", "claims", "expect"}) remove(head, key);
  head.members.insert(head.members.begin(), {"id", text_node(c.id)});
  std::string claims =
      one_line(fmt::format("{} {} is as accurate as when it was adopted", engine.name, engine.version));
  if (!despite.empty()) claims += "; adopted despite what it fails: " + one_line(despite);
  put(head, "claims", text_node(claims));
  put(head, "profiles", list_node({text_node("commit")}));
  const auto after_format = std::find_if(document.members.begin(), document.members.end(), [](const auto& m) {
    return m.second.kind == Kind::table || m.second.kind == Kind::array;
  });
  document.members.insert(after_format, {"case", std::move(head)});
}

/// Settings of every engine belong to the scene (friction, restitution), and so do those of this one.
void write_engines(TomlNode& document, const AdoptedCase& c, const EngineEntry& engine) {
  TomlNode engines, own;
  if (auto* given = document.find("engines")) engines = std::move(*given);
  remove(document, "engines");
  if (auto* given = engines.find(engine.name)) own = std::move(*given);
  std::erase_if(engines.members, [](const auto& m) { return m.first != "all"; });
  for (const char* key : {"required", "adopted", "refuses", "preset"}) remove(own, key);
  std::vector<TomlNode> presets;
  for (const auto& row : c.rows)
    if (!row.gates.empty()) presets.push_back(text_node(row.preset));
  own.members.insert(own.members.begin(), {{"required", flag_node(true)}, {"adopted", flag_node(true)}});
  if (presets.size() > 1 || (presets.size() == 1 && !is_default_preset(presets.front().text)))
    put(own, "preset", list_node(std::move(presets)));
  put(engines, engine.name, std::move(own));
  if (!is_own_solver(engine.name)) {  // it may run beside, and no gate judges it
    TomlNode solver;
    put(solver, "required", flag_node(false));
    put(engines, engine_name::solver, std::move(solver));
  }
  put(document, "engines", std::move(engines));
}

std::string word(const TomlNode& table, const char* key) {
  const auto* v = table.find(key);
  return v && v->kind == Kind::text ? v->text : std::string();
}

/// Studies of this engine and of all; a declared class that it fails goes with --despite.
void write_studies(TomlNode& document, const EngineEntry& engine, bool excused) {
  auto* studies = document.find("study");
  if (!studies) return;
  std::erase_if(studies->items, [&](const TomlNode& s) {
    const auto of = word(s, "engine"), mode = word(s, "mode");
    return (!of.empty() && of != engine.name) || mode == "paper" ||
           (mode == "corrected" && !is_own_solver(engine.name));
  });
  for (auto& s : studies->items) {
    remove(s, "mode");
    if (excused) remove(s, "expect");
  }
  if (studies->items.empty()) remove(document, "study");
}

TomlNode gate_node(const Gate& g) {
  TomlNode n;
  put(n, "metric", text_node(g.metric));
  put(n, "engine", text_node(g.engine));
  if (!g.preset.empty()) put(n, "preset", text_node(g.preset));
  if (g.level) put(n, "level", real_node(*g.level));
  if (g.limit) put(n, "limit", real_node(rounded(*g.limit)));
  if (g.at_least) put(n, "at_least", real_node(rounded(*g.at_least)));
  if (g.band) put(n, "band", list_node({real_node(rounded((*g.band)[0])), real_node(rounded((*g.band)[1]))}));
  put(n, "reason", text_node(one_line(g.reason)));
  put(n, "date", text_node(g.date));
  return n;
}

void collect_files(const TomlNode& node, std::set<std::string>& files) {
  for (const auto& item : node.items) collect_files(item, files);
  for (const auto& [key, value] : node.members)
    if (key == "file" && value.kind == Kind::text && !value.text.empty())
      files.insert(value.text);
    else
      collect_files(value, files);
}

}  // namespace

std::set<std::string> files_named_in(const TomlNode& document) {
  std::set<std::string> files;
  collect_files(document, files);
  return files;
}

std::string adopted_text(TomlNode source, const std::string& comment, const AdoptedCase& adopted,
                         const EngineEntry& engine, const std::string& despite) {
  const auto findings = adopted.all_findings();
  const bool excused = !findings.empty();
  for (const char* key : {"gate", "defect", "harmless"}) remove(source, key);
  write_head(source, adopted, engine, excused ? despite : std::string());
  write_engines(source, adopted, engine);
  write_studies(source, engine, excused);
  std::vector<TomlNode> gates;
  for (const auto& row : adopted.rows)
    for (const auto& gate : row.gates) gates.push_back(gate_node(gate));
  put(source, "gate", list_node(std::move(gates)));
  std::string text = comment;
  text += one_line(fmt::format(
              "# Adopted: `tripoint gate adopt` measured {} {} on this scene. The gates turn red where it "
              "drifts, to the worse or to the better.",
              engine.name, engine.version)) +
          "\n";
  for (const auto& f : findings) text += "# Despite: " + one_line(f.text) + "\n";
  return text + document_text(source);
}

}  // namespace tripoint
