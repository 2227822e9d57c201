// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/common.hpp"
#include "validation/harness/suite.hpp"

namespace tripoint {
namespace {

constexpr const char* description =
    "Lists the cases beside the program: id, title, and what each one claims.\n"
    "  tripoint list --tag heat       only cases with this tag\n"
    "  tripoint list --json           one JSON document";

int list(const std::string& tag, bool json) {
  CaseFilter filter;
  filter.tag = tag;
  nlohmann::ordered_json document = nlohmann::ordered_json::array();
  for (const auto& c : select_cases(filter)) {
    if (!json) print(fmt::format("{:28} {}\n{:28} {}\n", c.id, c.title, "", c.claims));
    document.push_back({{"id", c.id}, {"title", c.title}, {"claims", c.claims}, {"kind", c.kind}, {"requirement", c.requirement}, {"profiles", c.profiles}, {"tags", c.tags}, {"file", c.file}});
  }
  if (json) print(nlohmann::ordered_json{{"cases", document}}.dump(2) + "\n");
  return 0;
}

}  // namespace

void add_list(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("list", description);
  auto tag = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  command->add_option("--tag", *tag, "only cases with this tag");
  command->add_flag("--json", *json, "print one JSON document");
  command->callback([=, &exit_code] { exit_code = guarded([&] { return list(*tag, *json); }); });
}

}  // namespace tripoint
