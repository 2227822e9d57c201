// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "validation/results/results.hpp"
#include "validation/run/discover.hpp"

/// An engine judged by the limits that any engine must hold: a row a case, totals, and its place among the
/// engines that ran.
namespace tripoint {

struct Case;

/// Score of an engine in a case by the limits that any engine must hold.
enum class Score { pass, fail, known_defect, inconclusive, diverged, crashed, not_judged, refused, missing };
constexpr WordTable<9> word_table(Score) {
  return {"score",
          {"pass", "fail", "known defect", "inconclusive", "diverged", "crashed", "not judged", "refused",
           "missing"}};
}

/// The acceptance limit that an engine uses most of, excused or not. Empty where it has no value for any.
struct WorstLimit {
  std::string metric, unit, allowed;
  double value = not_a_number, share = not_a_number;
};

/// One case of one engine and preset. Missing values are NaN, 0 or empty.
struct ScoreRow {
  std::string case_id, title;
  Score verdict = Score::missing;
  /// Of a verdict that is not pass: the failed gate, the reason of a refusal, or the name of a known defect
  std::string reason;
  std::string defect;  ///< name of the known defect
  /// Of a failed limit: whose known defect, or which registered one, makes such an error
  std::string cause;
  std::string metric, unit;     ///< the metric by which engines are ranked: that of ranking_gate
  double error = not_a_number;  ///< its value at the case's own resolution, scaled
  std::string allowed;          ///< "limit 0.05": the acceptance limit on it
  double share = not_a_number;  ///< of that limit that is used
  WorstLimit worst;
  double order = not_a_number;  ///< observed, of a study of the case
  std::string order_metric;
  std::optional<FitClass> order_class;
  double drift = not_a_number;  ///< the largest of the case's laws of conservation, scaled
  std::string drift_metric;
  double cpu_s = not_a_number;  ///< of the run at the case's own resolution [CPU s]
  double cost = not_a_number;   ///< cpu_s over that of tripoint in the same case
  /// 1 = the smallest error of the `of` engines that hold every limit; equal errors share a place. 0 = it
  /// holds not all, or some by a known defect only
  int rank = 0, of = 0;
};

/// An engine and preset over all cases.
struct EngineScore {
  std::string engine, preset, version;
  std::vector<ScoreRow> rows;
  [[nodiscard]] std::string label() const { return label_of(engine, preset); }
  [[nodiscard]] int count(Score) const;
};

/// An engine of a case in which engines disagree: how far it is off the truth, and with which setting.
struct Witness {
  std::string label;
  Score verdict = Score::missing;
  double error = not_a_number;
  /// The vendor's own on preset and settings, with their source; empty = the engine gives none
  std::string words;
};

/// A case in which two engines differ by more than half of the acceptance limit. At most one of them uses
/// less than a quarter of the limit.
struct Disagreement {
  std::string case_id, metric, unit, allowed;
  std::string a, b;                ///< the two that differ most
  double difference = 0.0;         ///< of these two, in the metric
  std::vector<Witness> witnesses;  ///< every engine that ran, the nearest to the truth first
};

struct Scorecard {
  std::string command, date, commit;
  CaseVerdict verdict = CaseVerdict::missing;
  int exit_code = 0;
  std::vector<EngineScore> engines;
  std::vector<Disagreement> disagreements;
};

/// @param cases as they were run: settings and limits  @param engines for the vendors' words; `exact` and our
/// printed form have no score
[[nodiscard]] Scorecard scorecard_of(const Results&, const std::vector<Case>& cases,
                                     const std::vector<EngineEntry>& engines);

/// Whether a gate is a limit that any engine must hold.
[[nodiscard]] bool is_acceptance(const Gate&);
/// The gate whose metric ranks the engines of a case: of its acceptance limits that are of no order the first
/// on a value that has a truth, else on a momentum, else on an energy; nullptr where it has none.
[[nodiscard]] const Gate* ranking_gate(const CaseResult&);

/// For the terminal: each engine's totals, and the rows of the engines that were asked for.
[[nodiscard]] std::string scorecard_text(const Scorecard&, const std::vector<std::string>& asked);
/// The whole as Markdown.
[[nodiscard]] std::string scorecard_markdown(const Scorecard&);
/// scorecard.json, format 1: the data of the page.
[[nodiscard]] std::string scorecard_json(const Scorecard&);
/// Writes scorecard.json, scorecard.md and, where the report program can, scorecard.html. @return why there
/// is no page; empty where it is there
[[nodiscard]] std::string write_scorecard(const Scorecard&, const std::string& folder);

}  // namespace tripoint
