// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "validation/harness/discover.hpp"
#include "validation/harness/plan_runs.hpp"
#include "validation/harness/results.hpp"

/// Adopting an engine: its present results are measured, and gates are written that turn red where it drifts, to the worse or to
/// the better.
namespace tripoint {

struct AdoptOptions {
  double margin = 1.5;  ///< factor by which an error may grow or shrink
  int seeds = 4;        ///< other seeds, where chance has a hand in a run
  int jobs = 1;
  std::string work = "report-adopt";  ///< folder of the runs
  std::string date;                   ///< "2026-11-22", for the gates
};

/// One preset of the engine in one case: everything that was measured, by repeats and seeds.
struct AdoptedRow {
  std::string preset;
  Status status = Status::ok;  ///< of the case's own run
  std::string reason;
  std::vector<Gate> gates;
  std::vector<std::string> lost;   ///< metrics without a finite value: they are left out of the written case
  std::vector<std::string> notes;  ///< result of the repeat
};

struct AdoptedCase {
  std::string id, source;  ///< path of the case that was measured
  std::vector<AdoptedRow> rows;
  [[nodiscard]] bool judged() const;  ///< at least one gate was found
};

/// The values of one metric at the case's own resolution: the first run, its repeat, then other seeds.
/// @param uncertainty the largest statistical standard uncertainty that was stated
/// @param round_off below this an error is one of round-off, and may be anything smaller
/// @return a band by the margin and the noise, or a limit where the value is of round-off; its reason states the measurement
[[nodiscard]] Gate adopted_gate(const std::string& metric, const std::vector<double>& values, double uncertainty, double margin,
                                double round_off);

/// A band around a fitted order that holds its 95 % interval with room.
[[nodiscard]] Gate adopted_order_gate(const OrderRow&);

/// The case for one engine alone: studies that are for every engine, no gate, no other engine.
[[nodiscard]] Case case_to_adopt(Case, const EngineEntry&);

/// Runs the cases on the engine, repeats them, and forms the gates. @param say progress, one line a call
[[nodiscard]] std::vector<AdoptedCase> measure_to_adopt(const std::vector<Case>&, const EngineEntry&, const AdoptOptions&,
                                                        void (*say)(const std::string&));

/// Text of the adopted case: scene, reference, metrics and common studies of the source, word by word, with the engine and its
/// gates.
/// @throws InputError for a case that leans on files beside it, or declares a defect or a divergence
[[nodiscard]] std::string adopted_text(const std::string& source_text, const AdoptedCase&, const EngineEntry&);

}  // namespace tripoint
