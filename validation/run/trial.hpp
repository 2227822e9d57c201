// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "validation/case/preflight.hpp"

namespace tripoint {

struct Case;
struct InitialState;
struct Job;

/// Faults of a case that only the harness can tell before anything runs. They are words that nobody
/// evaluates, references that do not fit the scene, and metrics that no run could form. The metrics are tried
/// on particles that stay where they start. An engine that refuses a job of the case is a fault too; --check
/// asks it. tripoint is asked for every run of the case, the engines that the case names for its own
/// resolution. A refusal by an engine that the case requires is an error, by another a warning.
/// @throws InputError where the particles of a run cannot be sampled
[[nodiscard]] std::vector<Finding> trial(const Case&);

/// "file:line:column: what"; what alone where the place is not known.
[[nodiscard]] std::string with_place(const Finding&);

/// The part of it about metrics, on particles that stay where they start. It lists metrics that no run could
/// form, and as a warning those that find no particle where they look.
[[nodiscard]] std::vector<Finding> try_metrics(const Case&, const Job&, const InitialState&);

}  // namespace tripoint
