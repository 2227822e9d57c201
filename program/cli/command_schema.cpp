// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "files/job_schema.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "tables/text_table.hpp"
#include "validation/case/schema.hpp"
#include "validation/metrics/metric.hpp"
#include "validation/references/measuring.hpp"
#include "validation/references/reference.hpp"
#include "validation/results/json_text.hpp"
#include "validation/results/results_schema.hpp"

namespace tripoint {
namespace {

using json = nlohmann::ordered_json;

constexpr const char* schema_description =
    "Prints the JSON Schema of the case file, for editors that complete and check while you type. With\n"
    "--page it prints the reference page of all keys, reference functions, quantities and norms in\n"
    "Markdown. All come from the tables that the program reads by.\n"
    "  tripoint schema > case.schema.json      # in the case file: #:schema ./case.schema.json\n"
    "  tripoint schema --job                   # of JOB.json, the job of an engine\n"
    "  tripoint schema --result                # of result.json, the engine's answer\n"
    "  tripoint schema --results               # of results.json, the numbers of a report\n"
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
    for (const auto& a : f.args)
      args.push_back({{"name", a.name}, {"type", a.type}, {"unit", a.unit}, {"meaning", a.meaning}});
    names.push_back(f.name);
    functions.push_back(
        {{"name", f.name}, {"kind", f.kind}, {"meaning", f.meaning}, {"source", f.source}, {"args", args}});
  }
  auto& function = document["$defs"]["reference"]["properties"]["function"];
  function.erase("type");
  function["enum"] = names;
  document["x-reference-functions"] = functions;
  document["x-quantities"] = words_of(metric_quantities());
  document["x-norms"] = words_of(metric_norms());
  return json_text(document, 2);
}

std::string word_list(const char* title, const std::vector<MetricWord>& words) {
  std::string out = fmt::format("## {}\n\n", title);
  for (const auto& w : words)
    out +=
        fmt::format("- `{}`{}: {}.\n", w.name, w.unit.empty() ? "" : fmt::format(" ({})", w.unit), w.meaning);
  return out + "\n";
}

/// A line for each argument; those of one meaning that follow each other have one line.
std::string argument_list(const std::vector<ReferenceArgument>& args) {
  std::string out;
  for (std::size_t n = 0; n < args.size(); ++n) {
    const std::string name =
        fmt::format("`{}`{}", args[n].name, args[n].unit.empty() ? "" : fmt::format(" ({})", args[n].unit));
    out += n > 0 && args[n].meaning == args[n - 1].meaning ? ", " : "- ";
    out += name;
    if (n + 1 == args.size() || args[n + 1].meaning != args[n].meaning)
      out += fmt::format(": {}.\n", args[n].meaning);
  }
  return out.empty() ? "" : out + "\n";
}

bool is_measuring(const ReferenceArgument& one) {
  static const std::vector<ReferenceArgument> known = measuring_arguments();
  return std::ranges::find(known, one.name, &ReferenceArgument::name) != known.end();
}

/// A function whose reference is stated takes the measuring arguments, which the page lists once.
std::string function_page(const ReferenceFunction& f) {
  std::vector<ReferenceArgument> own, measuring;
  for (const auto& a : f.args) (is_measuring(a) ? measuring : own).push_back(a);
  const bool all = measuring.size() == measuring_arguments().size();
  std::string meaning = f.meaning;
  meaning[0] = static_cast<char>(std::toupper(meaning[0]));
  const std::string kind = f.kind == "analytic" ? "" : fmt::format(" ({})", f.kind);
  std::string out = fmt::format("### `{}`\n\n{}. Source: {}{}.\n\n", f.name, meaning, f.source, kind);
  out += argument_list(all ? own : f.args);
  if (all) out += "It also takes the [measuring arguments](#measuring-arguments).\n\n";
  return out;
}

std::string page() {
  std::string out =
      case_reference_page() + "## Reference functions\n\nAnalytic, where no other kind is named.\n\n";
  for (const auto& f : reference_functions()) out += function_page(f);
  out += "### Measuring arguments\n\n" + argument_list(measuring_arguments());
  return out + word_list("Quantities", metric_quantities()) + word_list("Norms", metric_norms());
}

/// The value of a key in words: "number", "list of 3 number", "[shape](#shape)", "corrected or paper".
std::string value_words(const json& value) {
  if (value.contains("anyOf")) return value_words(value["anyOf"][0]) + " or null";
  if (value.contains("$ref")) return "`" + value["$ref"].get<std::string>().substr(8) + "`";
  if (value.contains("enum"))
    return fmt::format("{}", fmt::join(value["enum"].get<std::vector<std::string>>(), ", "));
  const auto type = value.value("type", "object");
  if (type != "array") return type;
  return (value.contains("minItems") ? fmt::format("{} of ", value["minItems"].get<int>()) : "list of ") +
         value_words(value["items"]);
}

std::string key_table(const std::string& title, const json& table) {
  TextTable text({{title}, {"value"}, {"meaning"}});
  for (const auto& [name, value] : table["properties"].items())
    text.add({fmt::format("`{}`", name), value_words(value), value.value("description", "")});
  return text.markdown() + "\n";
}

/// The tables of a schema that an engine's author looks up. Scene, materials and shapes have the keys of the
/// case file.
std::string key_tables(const json& schema, const std::string& title) {
  std::string out = key_table(title, schema);
  for (const char* name : {"resolution", "body", "gauge", "counters", "seconds", "readback", "readback.body",
                           "readback.joint", "divergence"})
    if (schema["$defs"].contains(name)) out += key_table(fmt::format("`{}`", name), schema["$defs"][name]);
  return out;
}

struct Wanted {
  bool page = false, job = false, result = false, results = false;
};

std::string wanted_text(const Wanted& wanted) {
  if (wanted.results) return wanted.page ? results_page() : json_text(results_schema(), 2);
  if (!wanted.job && !wanted.result) return wanted.page ? page() : schema();
  const json chosen = wanted.job ? job_schema() : result_schema();
  return wanted.page ? key_tables(chosen, wanted.job ? "JOB.json" : "result.json") : json_text(chosen, 2);
}

}  // namespace

void add_schema(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("schema", schema_description);
  auto wanted = std::make_shared<Wanted>();
  command->add_flag("--page", wanted->page, "print the reference page in Markdown");
  auto* job = command->add_flag("--job", wanted->job, "the schema of JOB.json, an engine's job");
  command->add_flag("--result", wanted->result, "the schema of result.json, an engine's answer")
      ->excludes(job);
  command->add_flag("--results", wanted->results, "the schema of results.json, the numbers of a report")
      ->excludes("--job", "--result");
  command->callback([=, &exit_code] {
    exit_code = guarded([&] {
      print(wanted_text(*wanted));
      return 0;
    });
  });
}

}  // namespace tripoint
