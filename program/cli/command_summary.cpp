// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>

#include "core/durable_file.hpp"
#include "core/errors.hpp"
#include "program/cli/common.hpp"
#include "program/cli/gate_judge.hpp"
#include "validation/publish/comment.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace {

constexpr const char* summary_description =
    "Writes the text of a comment on a change: the verdict and the ten most changed metrics. Each has\n"
    "base -> head in units of the limit, with the noise. It runs nothing. `tripoint gate` blocks merges,\n"
    "this command does not.\n"
    "Exit: 0 whatever the verdict, 2 bad input.\n"
    "  tripoint summary report                                          the ten metrics that use "
    "most of their limits\n"
    "  tripoint summary report --markdown --against base/results.json   the text of a comment\n"
    "  tripoint summary report --data data.json --badge badge.svg       files for a dashboard and a "
    "badge";

struct SummaryOptions {
  std::string results, against, again, baselines, data, shares, badge, sarif;
  bool markdown = false, require_baselines = false;
  CommentOptions comment;
};

/// Where the case files are not here, as in a job that reads the results of another, stored values and limits
/// are judged. The comment says so.
GateVerdict verdict_of(const Results& results, SummaryOptions& o) {
  const bool here = std::all_of(results.cases.begin(), results.cases.end(),
                                [](const auto& c) { return std::filesystem::exists(c.file); });
  if (here) return gate_verdict(results, o.baselines, o.require_baselines);
  o.comment.note =
      "Judged by the stored values and limits: the case files are not here, so neither they nor baselines "
      "were compared.";
  GateVerdict verdict;
  add_remarks(verdict, results, verdict_remarks(results));
  return verdict;
}

/// Where a runner says which commit of which project this is.
std::string default_links() {
  const char *server = std::getenv("GITHUB_SERVER_URL"), *project = std::getenv("GITHUB_REPOSITORY"),
             *commit = std::getenv("GITHUB_SHA");
  return server && project && commit ? fmt::format("{}/{}/blob/{}", server, project, commit) : std::string();
}

void write_file(const std::string& file, const std::string& text) {
  if (file.empty()) return;
  if (const auto folder = std::filesystem::path(file).parent_path(); !folder.empty())
    std::filesystem::create_directories(folder);
  write_durably(file, text);
}

int summarise(SummaryOptions o) {
  const auto results = judged_results(o.results);
  auto verdict = verdict_of(results, o);
  std::optional<Comparison> comparison;
  if (!o.against.empty()) {
    const auto base = judged_results(o.against);
    const auto again = o.again.empty() ? std::optional<Results>() : judged_results(o.again);
    comparison = compare_results(base, results, o.comment.base.empty() ? o.against : o.comment.base,
                                 again ? &*again : nullptr);
    add_remarks(verdict, results, change_remarks(*comparison, false));
  }
  if (o.comment.links.empty()) o.comment.links = default_links();
  const auto* against = comparison ? &*comparison : nullptr;
  write_file(o.data, dashboard_json(results, false));
  write_file(o.shares, dashboard_json(results, true));
  write_file(o.badge, badge_text(results, verdict, o.badge.ends_with(".json")));
  write_file(o.sarif, sarif_text(verdict));
  print(o.markdown ? comment_markdown(results, verdict, against, o.comment)
                   : comment_text(results, verdict, against, o.comment));
  return exit_pass;
}

}  // namespace

void add_summary(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("summary", summary_description);
  auto o = std::make_shared<SummaryOptions>();
  command->add_option("RESULTS", o->results, "a results.json, or the folder of one")->required();
  command->add_flag(
      "--markdown", o->markdown,
      "Markdown for a comment; its first line marks it, so that it can be found and written anew");
  command->add_option("--against", o->against, "results of the base that the change is compared with")
      ->type_name("BASE.json");
  command
      ->add_option("--again", o->again,
                   "results of the base once more (A/A); what differs between the two counts as noise")
      ->type_name("BASE2.json");
  command->add_option("--baselines", o->baselines, "judge by the baselines in this folder")->type_name("DIR");
  command->add_flag("--require-baselines", o->require_baselines, "as in `tripoint gate`");
  command->add_option("--head", o->comment.head, "name of the judged branch or commit, for people");
  command->add_option("--base", o->comment.base, "name of the base, for people");
  command
      ->add_option("--links", o->comment.links,
                   "URL that the path of a case file is appended to (default: that of the commit, where a "
                   "runner of GitHub says it)")
      ->type_name("URL");
  command->add_option("--most", o->comment.most, "metrics in the table")->capture_default_str();
  command->add_flag("--informational", o->comment.informational, "say that the verdict blocks nothing");
  command
      ->add_option("--data", o->data,
                   "also write [{name, unit, value, range, extra}], a judged metric each, in its own unit")
      ->type_name("FILE");
  command
      ->add_option("--shares", o->shares,
                   "the same in units of the limit, where less is better for every metric")
      ->type_name("FILE");
  command->add_option("--badge", o->badge, "also write a badge: .svg, or .json as an endpoint answers")
      ->type_name("FILE");
  command->add_option("--sarif", o->sarif, "also write red gates as SARIF 2.1.0")->type_name("FILE");
  command->callback([o, &exit_code] { exit_code = guarded([&] { return summarise(*o); }); });
}

}  // namespace tripoint
