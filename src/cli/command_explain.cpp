// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/common.hpp"
#include "effects/plan.hpp"
#include "scene/read_case.hpp"

namespace tripoint {
namespace {

using json = nlohmann::ordered_json;

constexpr const char* description =
    "Says what a case means, and runs nothing: every key with its value in SI and the reason for it, the effects that the\n"
    "scene calls for and why, and the fields that its particles will carry.\n"
    "  tripoint explain rigid/ballistic\n"
    "  tripoint explain my.toml --set scene.spacing=\"2 mm\" --json | jq .effects";

std::string origin(const Decision& d) {
  if (!d.given) return "default: " + d.reason;
  return d.place.line > 0 ? fmt::format("given, line {}", d.place.line) : "given, " + d.place.file;
}

/// Keys that are not set are only counted: they would hide the others.
void print_decisions(const std::vector<Decision>& decisions) {
  std::size_t width = 0, unset = 0;
  for (const auto& d : decisions) width = std::max(width, std::min<std::size_t>(d.key.size(), 44));
  for (const auto& d : decisions) {
    if (d.value == "none" && !d.given) {
      ++unset;
      continue;
    }
    print(fmt::format("{:{}}  {:24}  # {}\n", d.key, width, d.value, origin(d)));
  }
  print(fmt::format("\n{} keys are not set (with --json: each with what that means).\n", unset));
}

void print_plan(const Plan& plan) {
  print("\nEffects\n");
  for (const auto& e : plan.effects) print(fmt::format("  {:10} {:10} {}\n", e.name, e.mode, e.why));
  print("\nFields\n");
  for (const auto& f : plan.fields) print(fmt::format("  {:24} {:8} {:8} of {:10} {} bytes\n", f.name, f.unit, f.per, f.owner, f.bytes));
  print(fmt::format("\n{} bytes a particle\n", plan.bytes_per_particle));
}

json as_json(const CaseReading& reading, const Plan& plan) {
  json decisions = json::array(), effects = json::array(), fields = json::array();
  for (const auto& d : reading.decisions) {
    json row{{"key", d.key}, {"value", d.value}, {"given", d.given}, {"reason", d.reason}};
    if (d.given && !d.place.file.empty()) row["file"] = d.place.file;
    if (d.given && d.place.line > 0) row["line"] = d.place.line;
    decisions.push_back(std::move(row));
  }
  for (const auto& e : plan.effects) effects.push_back({{"name", e.name}, {"mode", e.mode}, {"why", e.why}});
  for (const auto& f : plan.fields) fields.push_back({{"name", f.name}, {"unit", f.unit}, {"per", f.per}, {"owner", f.owner}, {"bytes", f.bytes}});
  return {{"format", 1},         {"case", reading.value.id}, {"file", reading.value.file}, {"decisions", decisions}, {"effects", effects},
          {"fields", fields}, {"bytes_per_particle", plan.bytes_per_particle}};
}

int explain(const std::string& file, const std::vector<std::string>& set, bool as_document) {
  const CaseReading reading = read_case(file, set);
  const Plan planned = plan_of(reading);
  if (as_document) {
    print(as_json(reading, planned).dump(2, ' ', false, json::error_handler_t::replace) + "\n");
    return 0;
  }
  print(fmt::format("{}: {}\n\n", reading.value.id, reading.value.title));
  print_decisions(reading.decisions);
  print_plan(planned);
  return 0;
}

}  // namespace

void add_explain(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("explain", description);
  auto file = std::make_shared<std::string>();
  auto set = std::make_shared<std::vector<std::string>>();
  auto as_document = std::make_shared<bool>(false);
  command->add_option("CASE", *file, "path of a case file, or the id of a case that is shipped")->required();
  command->add_option("--set", *set, "replace a key: scene.spacing=0.01, body.NAME.velocity=[1,0,0]; may be repeated")->take_all()->allow_extra_args(false);
  command->add_flag("--json", *as_document, "print one JSON document");
  command->callback([=, &exit_code] { exit_code = guarded([&] { return explain(case_path(*file), *set, *as_document); }); });
}

}  // namespace tripoint
