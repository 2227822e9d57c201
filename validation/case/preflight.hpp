// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/errors.hpp"

namespace tripoint {

struct Case;
struct CaseReading;
struct Gate;
struct InitialState;
struct MetricChoice;
struct Scene;
struct Study;

/// One finding of the pre-flight check.
struct Finding {
  bool error = false;  ///< else a warning
  std::string what;    ///< with what to do
  SourcePlace place;
};
/// Overlaps and gaps, bodies under-resolved or of wrong mass, spins that move nothing, a time step above a
/// bound: without running anything.
[[nodiscard]] std::vector<Finding> preflight(const Case&, const Scene&, const InitialState&);

/// One warning for each [[material]] of the case that bears the name of one of the library and takes values
/// from it.
[[nodiscard]] std::vector<Finding> library_values(const CaseReading&);

/// One note for each given key of [scene] that is old, with the word of [model] that says the same.
[[nodiscard]] std::vector<Finding> old_keys(const CaseReading&);

/// Warnings of what the case's gates leave open. Nothing judges the case, so that `validate` would pass it
/// unjudged; no gate looks at a metric; a known defect has a floor and no ceiling; a ladder for every engine
/// whose limit is not judged.
[[nodiscard]] std::vector<Finding> unjudged(const Case&);

/// Names of metrics that no gate and no expected class of a study looks at.
[[nodiscard]] std::vector<std::string> unjudged_metrics(const std::vector<MetricChoice>&,
                                                        const std::vector<Gate>&, const std::vector<Study>&);

/// Warnings of walls that leak, as they are thinner than the support, and of liquid too soft for its own
/// weight.
[[nodiscard]] std::vector<Finding> weak_containers(const Scene&, const InitialState&);

/// Warnings of joints: none of their bodies can move, motors that turn against each other, a free body that
/// no joint, spring or contact holds beside others that joints hold.
[[nodiscard]] std::vector<Finding> joint_findings(const Scene&);

/// Notes of what a run will not show: friction on a slope, heat and melting that need longer than end_time.
[[nodiscard]] std::vector<Finding> foreseen(const Scene&);

/// CPU seconds of a run by the particle solver, within a factor of three; empty where nothing bounds its
/// step.
[[nodiscard]] std::optional<double> cpu_seconds(const Scene&, const InitialState&);

}  // namespace tripoint
