// SPDX-License-Identifier: BSD-3-Clause
#include "validation/case/read_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "scene/readers.hpp"
#include "scene/value_reader.hpp"
#include "tables/library.hpp"
#include "validation/case/case_document.hpp"
#include "validation/case/case_records.hpp"
#include "validation/case/judge_readers.hpp"

namespace tripoint {
namespace {

const TomlNode empty_table;

/// "subject/name" of ".../subject/name.toml".
std::string id_from(const std::string& file) {
  std::error_code error;
  const auto path = std::filesystem::absolute(file, error);
  return path.parent_path().filename().string() + "/" + path.stem().string();
}

void read_head(const TomlNode& node, Case& c, Reading& reading) {
  TableReader in = case_table(node, "case", "case", reading);
  if (const auto id = in.maybe_text("id"))
    c.id = *id;
  else
    in.ruled("id", "\"" + (c.id = id_from(c.file)) + "\"", "folder and name of the file");
  const bool plain = !c.id.empty() && c.id.size() <= 128 && c.id.front() != '/' &&
                     c.id.find("..") == std::string::npos &&
                     c.id.find_first_of("\\\"\n\r\t:*?<>|") == std::string::npos;
  if (!plain)
    in.refuse("id",
              "an id is a path like subject/case without .. or any of \\ \" : * ? < > |: it names folders of "
              "the report");
  if (const auto title = in.maybe_text("title"))
    c.title = *title;
  else
    in.ruled("title", "\"" + (c.title = c.id) + "\"", "the id");
  RecordReader read(in, c, reading);
  read.each({"requirement", "claims", "kind", "profiles", "tags", "expect"});
  if (!in.has("modes")) return;
  read("modes");
  if (c.modes.empty()) in.refuse("modes", "name at least one of corrected, paper");
}

void read_judgement(TableReader& top, Case& c, Reading& reading) {
  if (const auto* engines = top.composite("engines")) {
    if (engines->kind != TomlNode::Kind::table)
      top.refuse("engines", "write one table an engine: [engines.NAME]");
    for (const auto& [name, node] : engines->members) c.engines.push_back(read_engine(node, name, reading));
  }
  if (const auto* reference = top.composite("reference")) {
    c.reference = read_reference(*reference, "reference", reading);
  } else {
    c.reference.kind = ReferenceKind::invariant;
    top.ruled("reference.kind", "\"invariant\"", "no [reference]: only what every run must keep is known");
  }
  for (const auto* node : top.tables("metric")) c.metrics.push_back(read_metric(*node, reading));
  std::size_t n = 0;
  for (const auto* node : top.tables("study"))
    c.studies.push_back(read_study(*node, ++n, c.scene.end_time, reading));
  n = 0;
  for (const auto* node : top.tables("gate")) c.gates.push_back(read_gate(*node, ++n, reading));
  n = 0;
  for (const auto* node : top.tables("input")) c.inputs.push_back(read_input(*node, ++n, reading));
  n = 0;
  for (const auto* node : top.tables("defect")) c.defects.push_back(read_defect(*node, ++n, reading));
  n = 0;
  for (const auto* node : top.tables("harmless"))
    c.harmless.push_back(
        case_table(*node, "harmless", fmt::format("harmless.{}", ++n), reading).text("name"));
}

/// In the order of the reference page, whatever order the rules asked for.
void sort_by_table(std::vector<Decision>& decisions) {
  const auto tables = case_keys().names("");
  const auto rank = [&](const Decision& d) {
    return std::find(tables.begin(), tables.end(), d.key.substr(0, d.key.find('.'))) - tables.begin();
  };
  std::stable_sort(decisions.begin(), decisions.end(),
                   [&](const Decision& a, const Decision& b) { return rank(a) < rank(b); });
}

/// The case as one document, with the replacements of --set.
TomlNode whole_document(const std::string& path, const std::vector<std::string>& set) {
  TomlNode document = read_case_document(path);
  for (const auto& s : set) apply_override(document, s);
  if (!set.empty()) check_written_out(document);
  return document;
}

}  // namespace

std::string resolved_case(const CaseReading& reading, const std::vector<std::string>& set) {
  TomlNode document = whole_document(reading.value.file, set), head, id;
  if (auto* given = document.find("case")) head = std::move(*given);
  std::erase_if(document.members, [](const auto& m) { return m.first == "case"; });
  std::erase_if(head.members, [](const auto& m) { return m.first == "id"; });
  id.kind = TomlNode::Kind::text;
  id.text = reading.value.id;
  head.members.insert(head.members.begin(), {"id", std::move(id)});
  document.members.insert(document.members.begin(), {"case", std::move(head)});
  return document_text(document);
}

std::string case_path(const std::string& path_or_id) {
  std::error_code error;
  if (std::filesystem::exists(path_or_id, error)) return path_or_id;
  const auto shipped = std::filesystem::path(share_folder()) / "cases" / (path_or_id + ".toml");
  return std::filesystem::is_regular_file(shipped, error) ? shipped.string() : path_or_id;
}

CaseReading read_case(const std::string& path, const std::vector<std::string>& set) {
  Reading reading;
  reading.file = path;
  std::error_code error;
  reading.folder = std::filesystem::absolute(path, error).parent_path().string();
  const TomlNode document = whole_document(path, set);

  CaseReading out;
  Case& c = out.value;
  c.file = path;
  TableReader top = case_table(document, "", "", reading);
  if (const long format = top.integer("format"); format != 1)
    top.refuse("format", fmt::format("format {} is not known: write 1", format));
  const auto* head = top.composite("case");
  read_head(head ? *head : empty_table, c, reading);
  c.scene = read_scene(top, reading);
  if (!(head && head->find("modes"))) {
    c.modes = {c.scene.mode};
    reading.decisions.push_back(
        {"case.modes", fmt::format("[\"{}\"]", to_string(c.scene.mode)), "the scene's mode", false, {}});
  }
  read_judgement(top, c, reading);
  check_scene(c.scene, c.modes, reading);
  check_judgement(c, reading);
  out.decisions = std::move(reading.decisions);
  sort_by_table(out.decisions);
  return out;
}

}  // namespace tripoint
