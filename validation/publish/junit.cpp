// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "validation/case/engine_names.hpp"
#include "validation/judge/apply_gate.hpp"
#include "validation/judge/physics.hpp"
#include "validation/publish/report_files.hpp"
#include "validation/results/escaped_text.hpp"
#include "validation/results/rows.hpp"

namespace tripoint {
namespace {

/// One <testcase>; `body` holds its failure or skip.
struct TestCase {
  std::string class_name, name, body;
  bool failed = false, skipped = false;
};

std::string name_of(const GateRow& g, const EngineRow& e) {
  std::string name = is_default_preset(e.preset) ? e.name : e.name + "(" + e.preset + ")";
  name += after_blank(g.mode) + " " + g.metric;
  if (g.expect) name += fmt::format(" is {}", *g.expect);
  if (g.level) name += fmt::format(" at {:g}", *g.level);
  return name;
}

TestCase test_of(const CaseResult& c, const EngineRow& e, const GateRow& g) {
  TestCase t{c.id, name_of(g, e), {}, g.verdict != Verdict::pass, false};
  t.body = fmt::format(
      "<properties><property name=\"value\" value=\"{:g}\"/><property name=\"uncertainty\" "
      "value=\"{:g}\"/><property "
      "name=\"limit\" value=\"{}\"/><property name=\"gate\" value=\"{}\"/><property name=\"physics\" "
      "value=\"{}\"/>"
      "</properties>",
      g.value, g.uncertainty, xml(describe(g.gate)), g.verdict, xml(physics_text(g)));
  if (t.failed)
    t.body +=
        fmt::format("<failure type=\"{}\" message=\"{}\">{}\nlimit set at {} because: {}</failure>",
                    g.verdict, xml(g.why), xml(g.why), xml(to_string(g.gate.place)), xml(g.gate.reason));
  return t;
}

std::vector<TestCase> tests_of(const CaseResult& c) {
  std::vector<TestCase> tests;
  for (const auto& e : c.engines) {
    if (e.status != Status::ok) {
      const bool broke_off =
          std::any_of(e.runs.begin(), e.runs.end(), [](const auto& r) { return crashed(r); });
      const bool counts = e.required || e.status == Status::diverged || broke_off;
      tests.push_back(
          {c.id, e.name + " runs",
           counts
               ? fmt::format("<failure type=\"{}\" message=\"{}\"/>", xml(to_string(e.status)), xml(e.reason))
               : fmt::format("<skipped message=\"{}: {}\"/>", xml(to_string(e.status)), xml(e.reason)),
           counts, !counts});
    }
    if (is_unjudged(e))
      tests.push_back({c.id, e.name + " is judged",
                       "<skipped message=\"not judged: no gate of the case names it or every engine\"/>",
                       false, true});
    for (const auto& g : e.gates) tests.push_back(test_of(c, e, g));
  }
  for (const auto& p : c.problems)
    tests.push_back({c.id, "the case can be judged",
                     fmt::format("<failure type=\"problem\" message=\"{}\"/>", xml(p)), true, false});
  return tests;
}

std::string suite_text(const std::string& name, const std::vector<TestCase>& tests) {
  std::string body;
  int failures = 0, skipped = 0;
  for (const auto& t : tests) {
    failures += t.failed;
    skipped += t.skipped;
    body += fmt::format("    <testcase classname=\"{}\" name=\"{}\">{}</testcase>\n", xml(t.class_name),
                        xml(t.name), t.body);
  }
  return fmt::format(
      "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" skipped=\"{}\">\n{}  </testsuite>\n", xml(name),
      tests.size(), failures, skipped, body);
}

}  // namespace

std::string junit_text(const Results& results) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"tripoint\">\n";
  for (const auto& c : results.cases) text += suite_text(c.id, tests_of(c));
  std::vector<TestCase> whole;
  for (const auto& p : results.problems)
    whole.push_back({"tripoint", "the results are whole",
                     fmt::format("<failure type=\"problem\" message=\"{}\"/>", xml(p)), true, false});
  if (!whole.empty()) text += suite_text("tripoint", whole);
  return text + "</testsuites>\n";
}

}  // namespace tripoint
