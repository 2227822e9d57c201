// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "validation/results/results.hpp"
#include "validation/run/discover.hpp"

/// Accuracy by release: one case on several releases of an engine, oldest first.
namespace tripoint {

struct Case;

struct Release {
  EngineEntry engine;
  CaseResult result;
};

/// A metric at the case's own resolution in two releases: the error, and the observed order where one was
/// fitted (else NaN).
struct ReleaseChange {
  std::string preset, metric, from, to;
  double before = 0.0, after = 0.0;
  double order_before = 0.0, order_after = 0.0;
  /// Of the greater error to the lesser one, or to round-off where that is more; NaN where one is not finite
  double ratio = 0.0;
  bool round_off = false;  ///< the lesser error is one of round-off
  bool worse = false;
};

/// The case with one engine, in these presets (empty = those of the case, else all of the engine). Its time
/// step is refined over these levels. Empty = those of the case's study of this engine, else 2, 1, 1/2 and
/// 1/4 of the case's own step.
[[nodiscard]] Case case_for_releases(Case, const EngineEntry&, const std::vector<std::string>& presets,
                                     const std::vector<double>& levels);

/// Where an error grew or shrank by more than `margin` times. Errors of round-off are equal: 1e-11, or 1e-5
/// in single precision.
[[nodiscard]] std::vector<ReleaseChange> changes_between(const Release& from, const Release& to,
                                                         double margin);

/// The run at the case's own resolution; nullptr where none was made.
[[nodiscard]] const RunRow* base_run(const EngineRow&);
/// The fit of a metric over the time step; nullptr where there is none.
[[nodiscard]] const OrderRow* ladder_in_time(const EngineRow&, const std::string& metric);
/// Its order; NaN where none was fitted.
[[nodiscard]] double observed_order(const EngineRow&, const std::string& metric);
/// Gates that pass in the one and not in the other, described.
[[nodiscard]] std::vector<std::string> gates_turned_red(const Release& from, const Release& to);

struct ReleaseTable {
  std::string case_id, title, command;
  double margin = 1.5;
  std::vector<Release> releases;
};

/// releases.json, format 1.
[[nodiscard]] std::string releases_text(const ReleaseTable&);
/// The same as Markdown: a table for each metric, the changes from each release to the next, and the verdicts
/// of the gates.
[[nodiscard]] std::string releases_markdown(const ReleaseTable&);
/// One line: whether the last release may take the place of the first.
[[nodiscard]] std::string upgrade_line(const ReleaseTable&);
/// Whether the last release is worse: a greater error beyond the margin, a failed gate that the first passes,
/// or only the first ran.
[[nodiscard]] bool is_worse(const ReleaseTable&);

}  // namespace tripoint
