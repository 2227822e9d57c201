// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "validation/case/schema.hpp"
#include "validation/metrics/metric.hpp"
#include "validation/references/reference.hpp"

namespace tripoint {
namespace {

using json = nlohmann::ordered_json;

constexpr const char* schema_description =
    "Prints the JSON Schema of the case file, for editors that complete and check while you type; with --page the reference\n"
    "page of all keys, reference functions, quantities and norms in Markdown. Both come from the tables the program reads by.\n"
    "  tripoint schema > case.schema.json      # in the case file: #:schema ./case.schema.json\n"
    "  tripoint schema --page | less";

json words_of(const std::vector<MetricWord>& words) {
  json list = json::array();
  for (const auto& w : words) list.push_back({{"name", w.name}, {"unit", w.unit}, {"meaning", w.meaning}});
  return list;
}

/// The scene's schema, with the words of the judge, which the scene does not know.
std::string schema() {
  json document = json::parse(case_schema());
  json names = json::array(), functions = json::array();
  for (const auto& f : reference_functions()) {
    json args = json::array();
    for (const auto& a : f.args) args.push_back({{"name", a.name}, {"type", a.type}, {"unit", a.unit}, {"meaning", a.meaning}});
    names.push_back(f.name);
    functions.push_back({{"name", f.name}, {"kind", f.kind}, {"meaning", f.meaning}, {"source", f.source}, {"args", args}});
  }
  auto& function = document["$defs"]["reference"]["properties"]["function"];
  function.erase("type");
  function["enum"] = names;
  document["x-reference-functions"] = functions;
  document["x-quantities"] = words_of(metric_quantities());
  document["x-norms"] = words_of(metric_norms());
  return document.dump(2) + "\n";
}

std::string word_table(const char* title, const std::vector<MetricWord>& words) {
  std::string out = fmt::format("## {}\n\n| name | unit | meaning |\n|---|---|---|\n", title);
  for (const auto& w : words) out += fmt::format("| `{}` | {} | {} |\n", w.name, w.unit, w.meaning);
  return out + "\n";
}

std::string page() {
  std::string out = case_reference_page() + "## Reference functions\n\n";
  for (const auto& f : reference_functions()) {
    out += fmt::format("### `{}`\n\n{}. Source: {} ({}).\n\n", f.name, f.meaning, f.source, f.kind);
    if (!f.args.empty()) out += "| argument | unit | meaning and default |\n|---|---|---|\n";
    for (const auto& a : f.args) out += fmt::format("| `{}` | {} | {} |\n", a.name, a.unit, a.meaning);
    if (!f.args.empty()) out += "\n";
  }
  return out + word_table("Quantities", metric_quantities()) + word_table("Norms", metric_norms());
}

}  // namespace

void add_schema(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("schema", schema_description);
  auto as_page = std::make_shared<bool>(false);
  command->add_flag("--page", *as_page, "print the reference page in Markdown");
  command->callback([=, &exit_code] {
    exit_code = guarded([&] {
      print(*as_page ? page() : schema());
      return 0;
    });
  });
}

}  // namespace tripoint
