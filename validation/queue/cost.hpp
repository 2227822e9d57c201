// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>

/// Cost of a run before it is made: good enough to share work out, never shown as a measurement.
namespace tripoint {

struct Job;
struct Results;

/// CPU seconds that earlier runs cost, by their folder ("runs/CASE/ENGINE/LABEL").
[[nodiscard]] std::map<std::string, double> measured_costs(const Results&);

/// CPU seconds of one run by particles times steps, with a cost a particle and step for each kind of engine.
/// [CPU s] Where the scene gives no step, it is the lesser of 0.2 h/c and dx^2/(5 alpha): the order of the
/// solver's bounds. c is the fastest sound of matter that flows or bends, alpha the greatest diffusivity of
/// matter that conducts.
[[nodiscard]] double predicted_cost(const Job&, const std::string& engine, std::size_t particles);

}  // namespace tripoint
