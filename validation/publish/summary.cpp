// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "tables/text_table.hpp"
#include "validation/judge/apply_gate.hpp"
#include "validation/judge/physics.hpp"
#include "validation/publish/report_files.hpp"
#include "validation/results/escaped_text.hpp"
#include "validation/results/rows.hpp"

namespace tripoint {
namespace {

constexpr std::size_t longest = 900'000;  // GitHub cuts a job's summary at 1 MiB

/// The engines' rows; those that are not here and need not be stand together at the end, each once.
std::string engines_of(const CaseResult& c) {
  std::string list;
  std::vector<std::string> absent;
  for (const auto& e : c.engines) {
    if (e.status == Status::missing && !e.required) {
      if (absent.empty() || absent.back() != e.name) absent.push_back(e.name);
      continue;
    }
    list += fmt::format("{}{}{}", list.empty() ? "" : ", ", label_of(e.name, e.preset),
                        e.status != Status::ok ? fmt::format(": {}", e.status)
                        : is_unjudged(e)       ? ": not judged"
                                               : "");
  }
  return absent.empty()
             ? list
             : fmt::format("{}{}not here: {}", list, list.empty() ? "" : "; ", fmt::join(absent, " "));
}

int green(const CaseResult& c, int& all) {
  int passed = 0;
  for (const auto& e : c.engines)
    for (const auto& g : e.gates) {
      ++all;
      passed += g.verdict == Verdict::pass;
    }
  return passed;
}

std::string table_of(const Results& r) {
  TextTable table({{"gate"}, {"physics"}, {"case"}, {"gates held"}, {"engines"}});
  for (const auto& c : r.cases) {
    int all = 0;
    const int passed = green(c, all);
    table.add({std::string(to_string(c.verdict)), markdown(physics_text(c)), markdown(c.id),
               fmt::format("{} of {}", passed, all), markdown(engines_of(c))});
  }
  return table.markdown();
}

std::string not_green(const CaseResult& c) {
  std::string text;
  for (const auto& p : c.problems) text += fmt::format("- **{}**: {}\n", markdown(c.id), markdown(p));
  for (const auto& e : c.engines) {
    for (const auto& g : e.gates)
      if (g.verdict != Verdict::pass)
        text += fmt::format(
            "- **{}** {}\n", markdown(c.id),
            markdown(fmt::format("{}{} {} {}: {} ({}; limit because: {})", e.name, after_blank(g.mode),
                                 g.metric, g.verdict, g.why, to_string(g.gate.place), g.gate.reason)));
    if (is_unjudged(e))
      text += fmt::format("- {} {} ran and is not judged: no gate of the case names it or every engine\n",
                          markdown(c.id), markdown(label_of(e.name, e.preset)));
    if (e.status != Status::ok)
      text += fmt::format("- {} {} {}: {}\n", markdown(c.id), markdown(e.name), markdown(to_string(e.status)),
                          markdown(e.reason));
  }
  return text;
}

}  // namespace

std::string case_line(const CaseResult& c) {
  int all = 0;
  const int passed = green(c, all);
  std::string line = fmt::format("{:13} {:40} {}/{} gates; physics {}; {}", c.verdict, one_line(c.id), passed,
                                 all, one_line(physics_text(c)), one_line(engines_of(c)));
  if (c.exit_code == 0) return line;
  for (const auto& p : c.problems) line += "\n              " + one_line(p);
  for (const auto& e : c.engines)
    for (const auto& g : e.gates)
      if (g.verdict != Verdict::pass)
        line +=
            "\n              " + one_line(fmt::format("{}: {}{} {}: {}: {}", to_string(g.gate.place), e.name,
                                                      after_blank(g.mode), g.metric, g.verdict, g.why));
  return line;
}

std::string summary_text(const Results& r) {
  std::string text =
      fmt::format("# tripoint: {} (exit {})\n\n{} case{}, {}, profile {}, commit {}, {}, {}\n\n", r.verdict,
                  r.exit_code, r.cases.size(), r.cases.size() == 1 ? "" : "s", physics_counts(r),
                  r.profile.empty() ? "any" : markdown(r.profile), markdown(r.tool.commit),
                  markdown(r.tool.compiler), markdown(r.tool.cpu));
  text += table_of(r);
  std::string rest;
  for (const auto& p : r.problems) rest += fmt::format("- {}\n", markdown(p));
  for (const auto& c : r.cases) rest += not_green(c);
  if (!rest.empty()) text += "\n## Not green\n\n" + rest;
  if (text.size() > longest)
    text = text.substr(0, text.rfind('\n', longest)) + "\n\n(cut; the rest is in results.json)\n";
  return text;
}

}  // namespace tripoint
