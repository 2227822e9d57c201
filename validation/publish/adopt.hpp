// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <set>
#include <string>
#include <vector>

#include "tables/toml_node.hpp"
#include "validation/results/results.hpp"
#include "validation/run/discover.hpp"
#include "validation/run/plan_runs.hpp"

/// Adopting an engine: its present results are measured, and gates are written that turn red where it drifts,
/// to the worse or to the better. What fails a limit that holds for any engine is not adopted.
namespace tripoint {

struct AdoptOptions {
  double margin = 1.5;  ///< factor by which an error may grow or shrink
  int seeds = 4;        ///< other seeds or repeats, where chance has a hand in a run
  int jobs = 1;
  std::string work = "report-adopt";  ///< folder of the runs
  std::string date;                   ///< "2026-11-22", for the gates
  /// Why findings that a reason excuses are let pass; empty = they are not
  std::string despite;
};

/// Why a case is not adopted as it is.
struct AdoptFinding {
  int code = 0;  ///< of the contract
  std::string text;
  bool excusable = false;  ///< --despite REASON lets it pass
};

/// One preset of the engine in one case: everything that was measured, by repeats and seeds.
struct AdoptedRow {
  std::string preset;
  Status status = Status::ok;  ///< of the case's own run
  std::string reason;
  std::vector<Gate> gates;
  std::vector<AdoptFinding> findings;
};

struct AdoptedCase {
  std::string id, source;  ///< path of the case that was measured
  std::vector<AdoptedRow> rows;
  std::vector<AdoptFinding> findings;                            ///< of the case as a whole
  [[nodiscard]] bool judged() const;                             ///< at least one gate was found
  [[nodiscard]] std::vector<AdoptFinding> all_findings() const;  ///< those of the rows name their preset
  /// Exit codes of the findings that no reason excuses. @param despite the reason; empty = none was given
  [[nodiscard]] std::set<int> refused_by(const std::string& despite) const;
};

/// The values of one metric at the case's own resolution: the first run, its repeat, then other seeds.
struct Measured {
  std::vector<double> values;
  double uncertainty = 0.0;  ///< the largest statistical standard uncertainty that was stated
};

/// @param round_off below this an error is one of round-off, and may be anything smaller
/// @return a band by the margin and the noise, or a limit where the value is of round-off; its reason states
/// the measurement
[[nodiscard]] Gate adopted_gate(const std::string& metric, const Measured&, double margin, double round_off);

/// Noise must not become headroom: says so where the noise exceeds the value itself. Empty = it does not.
[[nodiscard]] std::string noise_exceeds_value(const std::string& metric, const Measured&, double round_off);

/// A band around a fitted order that holds its 95 % interval with headroom.
[[nodiscard]] Gate adopted_order_gate(const OrderRow&);

/// The case for one engine alone. It keeps its scene, every setting and study, and the limits that hold for
/// any engine.
[[nodiscard]] Case case_to_adopt(Case, const EngineEntry&);

/// Runs the cases on the engine, repeats them, and forms gates and findings. @param say progress, one line a
/// call
[[nodiscard]] std::vector<AdoptedCase> measure_to_adopt(const std::vector<Case>&, const EngineEntry&,
                                                        const AdoptOptions&, void (*say)(const std::string&));

/// Text of the adopted case: the whole document of its source, with this engine and its gates in the place of
/// all others.
/// @param source as read_case_document() gives it   @param comment first lines of the source   @param despite
/// see AdoptOptions
[[nodiscard]] std::string adopted_text(TomlNode source, const std::string& comment, const AdoptedCase&,
                                       const EngineEntry&, const std::string& despite);

/// Meshes and data that the document names, as it names them: they are copied beside the adopted case.
[[nodiscard]] std::set<std::string> files_named_in(const TomlNode&);

}  // namespace tripoint
