// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "validation/campaign/suite.hpp"
#include "validation/case/case.hpp"
#include "validation/results/json_text.hpp"

namespace tripoint {
namespace {

constexpr const char* list_description =
    "Lists the cases beside the program: id, title, and what each one claims.\n"
    "  tripoint list heat             those of one subject\n"
    "  tripoint list --tag heat       only cases with this tag\n"
    "  tripoint list --profile commit those that a plain tripoint validate runs\n"
    "  tripoint list --profile acceptance   those with a limit that any engine must hold\n"
    "  tripoint list -k floating      those with this in their id\n"
    "  tripoint list --json           one JSON document";

int list(const CaseFilter& filter, bool json) {
  nlohmann::ordered_json document = nlohmann::ordered_json::array();
  for (const auto& c : select_cases(filter)) {
    if (!json) {
      print_line(fmt::format("{:28} {}", c.id, c.title));
      print_line(fmt::format("{:28} {}", "", c.claims));
    }
    document.push_back({{"id", c.id},
                        {"title", c.title},
                        {"claims", c.claims},
                        {"kind", c.kind},
                        {"requirement", c.requirement},
                        {"profiles", c.profiles},
                        {"tags", c.tags},
                        {"file", c.file}});
  }
  if (json) print(json_text(nlohmann::ordered_json{{"cases", document}}, 2));
  return 0;
}

}  // namespace

void add_list(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("list", list_description);
  auto filter = std::make_shared<CaseFilter>();
  auto json = std::make_shared<bool>(false);
  command->add_option("CASE", filter->what, "only these: case files, folders of them, subjects or ids")
      ->type_name("CASE|DIR");
  command->add_option("--tag", filter->tag, "only cases with this tag");
  command->add_option("--profile", filter->profile, "only cases of this profile")
      ->check(CLI::IsMember({"commit", "nightly", "release", "acceptance"}));
  command->add_option("-k", filter->substring, "only cases with this in their id")->type_name("SUBSTRING");
  command->add_flag("--json", *json, "print one JSON document");
  command->callback([=, &exit_code] { exit_code = guarded([&] { return list(*filter, *json); }); });
}

}  // namespace tripoint
