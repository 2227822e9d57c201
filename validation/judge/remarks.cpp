// SPDX-License-Identifier: BSD-3-Clause
#include "validation/judge/remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/results/escaped_text.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace {

int code_of(Verdict verdict) {
  if (verdict == Verdict::fail) return exit_fail;
  if (verdict == Verdict::inconclusive) return exit_inconclusive;
  return verdict == Verdict::diverged ? exit_diverged : exit_missing;
}

Remark remark_on(const CaseResult& c, const EngineRow& e, const GateRow& row) {
  Remark remark;
  remark.code = code_of(row.verdict);
  remark.place = row.gate.place;
  remark.excess = std::isfinite(row.used) ? row.used : infinity;
  remark.title = fmt::format("{} {}{} {}{}", c.id, label_of(e.name, e.preset), after_blank(row.mode),
                             row.metric, row.level ? fmt::format(" at {:g}", *row.level) : "");
  remark.text = fmt::format("{}: {}; the limit is there because: {}", row.verdict, row.why, row.gate.reason);
  return remark;
}

std::string command(const Remark& r, std::size_t more) {
  std::string place;
  if (!r.place.file.empty())
    place = fmt::format(" file={},line={},", command_text(r.place.file, true), std::max(r.place.line, 1));
  else
    place = " ";
  const std::string rest = more > 0 ? fmt::format(" (and {} more, which results.json lists)", more) : "";
  return fmt::format("::{}{}title={}::{}\n", r.error ? "error" : "warning", place,
                     command_text(r.title, true), command_text(r.text + rest, false));
}

}  // namespace

std::vector<Remark> verdict_remarks(const Results& results) {
  std::vector<Remark> list;
  for (const auto& c : results.cases) {
    for (const auto& p : c.problems)
      list.push_back({true, c.exit_code, {c.file, 1, 0}, c.id, p, infinity, {}});
    for (const auto& e : c.engines)
      for (const auto& row : e.gates)
        if (row.verdict != Verdict::pass) list.push_back(remark_on(c, e, row));
  }
  for (const auto& p : results.problems)
    list.push_back({true, results.exit_code, {}, "the results", p, infinity, {}});
  std::stable_sort(list.begin(), list.end(),
                   [](const auto& a, const auto& b) { return a.excess > b.excess; });
  return list;
}

std::string verdict_word(int exit_code, const Results& results, const std::vector<Remark>& list) {
  std::string word;
  if (exit_code == exit_pass) return verdict_word(exit_code);
  if (results.exit_code == exit_code) return std::string(to_string(results.verdict));
  for (const auto& r : list) {
    if (!r.error || r.code != exit_code) continue;
    if (r.word.empty() || (!word.empty() && r.word != word)) return verdict_word(exit_code);
    word = r.word;
  }
  return word.empty() ? verdict_word(exit_code) : word;
}

std::string remarks_text(const std::vector<Remark>& list) {
  std::string text;
  for (const auto& r : list)
    text += one_line(fmt::format("{}: {}{}: {}", r.error ? "error" : "warning",
                                 r.place.file.empty() ? "" : to_string(r.place) + ": ", r.title, r.text)) +
            "\n";
  return text;
}

std::string annotations_text(const std::vector<Remark>& list, std::size_t most) {
  std::string text;
  for (const bool error : {true, false}) {
    std::vector<const Remark*> kind;
    for (const auto& r : list)
      if (r.error == error) kind.push_back(&r);
    for (std::size_t k = 0; k < std::min(most, kind.size()); ++k)
      text += command(*kind[k], k + 1 == most ? kind.size() - most : 0);
  }
  return text;
}

}  // namespace tripoint
