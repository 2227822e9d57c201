// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "job/job.hpp"
#include "validation/case/preflight.hpp"
#include "validation/case/read_case.hpp"

namespace tripoint {

/// What only the harness can tell of a case before anything runs: words that nobody evaluates; references that do not fit the
/// scene; metrics that no run could form, seen on particles that stay where they start; and engines that refuse a job of the
/// case, asked by --check. tripoint is asked for every run of the case, the engines that the case names for its own resolution.
/// A refusal by an engine that the case requires is an error, by another a warning.
/// @throws InputError where the particles of a run cannot be sampled
[[nodiscard]] std::vector<Finding> trial(const Case&);

/// "file:line:column: what"; what alone where the place is not known.
[[nodiscard]] std::string with_place(const Finding&);

/// The part of it that tells of metrics, on particles that stay where they start: those that no run could form, and as a warning
/// those that take no particle where they look.
[[nodiscard]] std::vector<Finding> try_metrics(const Case&, const Job&, const InitialState&);

}  // namespace tripoint
