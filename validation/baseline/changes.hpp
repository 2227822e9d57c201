// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "validation/judge/remarks.hpp"
#include "validation/results/results.hpp"

/// Results beside those of a base, metric by metric. They show the effect of a change to an engine, in units
/// of each limit, and whether noise can explain it.
namespace tripoint {

/// A change of less than this share of its limit is none, however small the noise: another compiler or
/// processor does as much.
inline constexpr double least_change = 1e-3;

enum class Trend { better, worse, same, appeared, gone };

/// One metric in one of the two results.
struct MetricStanding {
  double value = 0.0;   ///< in the metric's unit; NaN where there is none
  double used = 0.0;    ///< in units of the limit, share_of_limit(); NaN where no gate judges the metric
  double noise = 0.0;   ///< standard uncertainty that seeds or the fit show, in the metric's unit
  double stated = 0.0;  ///< that the run states of itself, in the same unit
  int seeds = 1;        ///< runs that the value is the mean of
  std::string allows;   ///< "limit 0.01"; empty = no gate
  Verdict verdict = Verdict::missing;
  std::optional<FitClass> fit_class;
};

/// One metric of one engine in one case, judged (a row for each gate) or not.
struct MetricChange {
  std::string case_id, engine, metric, unit;  ///< engine with its preset
  JudgedMode mode = JudgedMode::none;
  std::optional<double> level;
  SourcePlace place;  ///< of the limit; of the case file where there is none
  std::optional<MetricStanding> base, head;
  /// Head less base in units of the limit, above 0 = worse; without a limit as a share of the base, of no
  /// sign
  double change = 0.0;
  /// Of that difference, in the same unit: of the base's seeds and of A/A, never by the word of a run
  double noise = 0.0;
  /// "5 seeds", "A/A", "round-off", "interval of the fit", "none known"
  std::string noise_from;
  Trend trend = Trend::same;
  bool limit_changed = false, looser = false;
};

struct Comparison {
  std::string base_name;
  std::vector<MetricChange> changes;  ///< most changed first, then new and lost ones
  /// Why the two may not be comparable: another profile, other seeds, another version of the program
  std::vector<std::string> remarks;
  [[nodiscard]] int count(Trend) const;
};

/// @param repeat the base once more (A/A): the difference between the two is noise of its own, the larger one
/// counts, and bears out what the base states of its uncertainty @pre both are judged
[[nodiscard]] Comparison compare_results(const Results& base, const Results& head,
                                         const std::string& base_name, const Results* repeat = nullptr);

/// Warnings for values that got worse by more than their noise and are within their limit, for values that
/// are gone, and for changed limits.
/// @param no_worse errors instead: worse is exit 1, gone or looser exit 4
[[nodiscard]] std::vector<Remark> change_remarks(const Comparison&, bool no_worse);

/// "2 better, 1 worse, 9 unchanged, 1 new, 0 gone"
[[nodiscard]] std::string counts_text(const Comparison&);
/// "0.0049 -> 0.0025 m", "0.82 -> 0.41", "0.004, 5 seeds": base beside head, the same in units of the limit,
/// and the noise in that unit.
[[nodiscard]] std::string values_text(const MetricChange&);
[[nodiscard]] std::string used_text(const MetricChange&);
[[nodiscard]] std::string noise_text(const MetricChange&);
[[nodiscard]] std::string change_text(const MetricChange&);
/// "verlet corrected position at 0.1"
[[nodiscard]] std::string name_of(const MetricChange&);
[[nodiscard]] std::string word_of(Trend);

/// Every metric of both, a line each, for a terminal.
[[nodiscard]] std::string changes_table(const Comparison&);

}  // namespace tripoint
