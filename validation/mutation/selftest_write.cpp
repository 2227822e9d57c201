// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "validation/mutation/selftest.hpp"
#include "validation/mutation/smallest.hpp"
#include "validation/results/escaped_text.hpp"
#include "validation/results/json_text.hpp"

namespace tripoint {
namespace {

using Json = nlohmann::ordered_json;

std::string smallest_table(const std::vector<SmallestOutcome>& rows) {
  if (rows.empty()) return {};
  std::string text = fmt::format(
      "\nSmallest visible defects: the gate is red at `size`, of either sign, and green at `hidden`, of one; "
      "red here where size "
      "is above {:g} times the stored one\n",
      smallest_growth);
  text += fmt::format("{:11} {:24} {:>9} {:>9} {:>9}  {:26} {}\n", "", "defect", "size", "hidden", "stored",
                      "case", "metric; what the size is of");
  for (const auto& s : rows)
    text += fmt::format("{:11} {:24} {:9.3g} {:9.3g} {:9.3g}  {:26} {}; {}{}\n", s.verdict, s.defect, s.size,
                        s.hidden, s.stored, s.case_id, s.metric, s.what,
                        s.holds() ? "" : "  (" + to_string(s.place) + ")");
  return text + "\n";
}

}  // namespace

std::string selftest_table(const SelftestOutcome& outcome) {
  std::string text;
  for (const auto& d : outcome.defects)
    text += one_line(fmt::format("{:9} {:24} {:<9g} {:26} {}{}",
                                 !d.tried   ? "not tried"
                                 : d.killed ? "killed"
                                            : "SURVIVES",
                                 d.defect, d.size, d.case_id, d.found,
                                 d.killed ? "" : "  (" + to_string(d.place) + ")")) +
            "\n";
  for (const auto& p : outcome.problems) text += "PROBLEM   " + one_line(p) + "\n";
  for (const auto& h : outcome.harmless)
    text += one_line(fmt::format("{:9} {:24} {:<9.2g} {:26} {}", h.borne ? "borne" : "FELT", h.change,
                                 h.greatest, h.case_id, h.found)) +
            "\n";
  text += smallest_table(outcome.smallest);
  const auto borne =
      std::count_if(outcome.harmless.begin(), outcome.harmless.end(), [](const auto& h) { return h.borne; });
  const auto killed =
      std::count_if(outcome.defects.begin(), outcome.defects.end(), [](const auto& d) { return d.killed; });
  const auto held = std::count_if(outcome.smallest.begin(), outcome.smallest.end(),
                                  [](const auto& s) { return s.holds(); });
  return text + fmt::format(
                    "{} of {} defects killed, {} of {} invariance tests passed, {} of {} smallest visible "
                    "sizes held, exit {}\n",
                    killed, outcome.defects.size(), borne, outcome.harmless.size(), held,
                    outcome.smallest.size(), outcome.exit_code);
}

std::string selftest_json(const SelftestOutcome& outcome) {
  Json defects = Json::array(), harmless = Json::array(), smallest = Json::array();
  for (const auto& d : outcome.defects)
    defects.push_back({{"defect", d.defect},
                       {"case", d.case_id},
                       {"size", d.size},
                       {"killed", d.killed},
                       {"tried", d.tried},
                       {"found", d.found},
                       {"file", d.place.file},
                       {"line", d.place.line}});
  for (const auto& h : outcome.harmless)
    harmless.push_back({{"change", h.change},
                        {"case", h.case_id},
                        {"borne", h.borne},
                        {"greatest", json_number(h.greatest)},
                        {"tolerance", h.tolerance},
                        {"found", h.found}});
  for (const auto& s : outcome.smallest)
    smallest.push_back({{"defect", s.defect},
                        {"what", s.what},
                        {"case", s.case_id},
                        {"metric", s.metric},
                        {"size", json_number(s.size)},
                        {"hidden", json_number(s.hidden)},
                        {"stored", s.stored},
                        {"verdict", s.verdict},
                        {"holds", s.holds()},
                        {"runs", s.runs},
                        {"file", s.place.file},
                        {"line", s.place.line}});
  const Json document{{"format", 1},
                      {"exit_code", outcome.exit_code},
                      {"defects", defects},
                      {"harmless", harmless},
                      {"smallest", smallest},
                      {"smallest_growth", smallest_growth},
                      {"problems", outcome.problems}};
  return json_text(document);
}

}  // namespace tripoint
