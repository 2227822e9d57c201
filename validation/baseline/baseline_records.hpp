// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "validation/baseline/baseline.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/judge/apply_gate.hpp"
#include "validation/results/record_entries.hpp"

/// The entries of a baseline's file: keys, members and meanings.
namespace tripoint {

/// The edges that were accepted, as the gate of a case.
[[nodiscard]] inline Gate edges_of(const AcceptedGate& accepted) {
  Gate gate;
  gate.limit = accepted.limit;
  gate.at_least = accepted.at_least;
  gate.band = accepted.band;
  return gate;
}

inline constexpr auto nothing_counted = [](auto&) { return 0.0; };

template <>
inline constexpr auto record<AcceptedGate> = std::make_tuple(
    held(&AcceptedGate::metric, "metric", "judged metric"),
    held(&AcceptedGate::engine, "engine", "judged engine; empty: all"),
    replaced(
        &AcceptedGate::preset, "preset", [](auto& g) { return preset_unless_default(g.preset); },
        "judged preset; empty: all"),
    held(&AcceptedGate::mode, "mode", "judged mode; empty: all"),
    held(&AcceptedGate::level, "level", "of the study's axis"),
    held(&AcceptedGate::limit, "limit", "accepted edge"),
    held(&AcceptedGate::at_least, "at_least", "accepted edge"),
    held(&AcceptedGate::band, "band", "accepted edges"),
    held(&AcceptedGate::drift, "drift", "part by which the value may move"),
    unless(
        &AcceptedGate::allows, "allows", [](auto& g) { return describe(edges_of(g)); }, "the gate in words"),
    unless(
        &AcceptedGate::room, "room", [](auto& g) { return allowance_of(edges_of(g)); },
        "allowance, one number"),
    held(&AcceptedGate::value, "value", "measured, in the row that uses most of the limit"),
    unless(&AcceptedGate::uncertainty, "uncertainty", nothing_counted, "of the value"),
    held(&AcceptedGate::fit_class, "class", "of an order"),
    unless(
        &AcceptedGate::first_room, "first_room", [](auto& g) { return g.room; }, "of the first baseline"),
    unless(
        &AcceptedGate::first_value, "first_value", [](auto& g) { return g.value; }, "of the first baseline"),
    unless(&AcceptedGate::loosened, "loosened", nothing_counted,
           "sum of ln(new/old) of all loosenings since"),
    held(&AcceptedGate::measures, "measures", "hash of the metric"));

template <>
inline constexpr auto record<Acceptance> =
    std::make_tuple(held(&Acceptance::date, "date", "day of the acceptance"),
                    held(&Acceptance::commit, "commit", "of the sources"),
                    held(&Acceptance::reason, "reason", "of the acceptance"));

template <>
inline constexpr auto record<AcceptedCost> = std::make_tuple(
    held(&AcceptedCost::run, "run", "engine and folder"), held(&AcceptedCost::pairs, "pairs", "count"),
    held(&AcceptedCost::steps, "steps", "count"),
    unless(&AcceptedCost::instructions, "instructions", nothing_counted, "count"),
    held(&AcceptedCost::counted_on, "counted_on", "counter and machine of the instructions"));

template <>
inline constexpr auto record<AcceptedEngine> =
    std::make_tuple(held(&AcceptedEngine::name, "name", "of the engine"),
                    held(&AcceptedEngine::version, "version", "as it says"),
                    held(&AcceptedEngine::executable, "executable", "hash of a third party's program"));

inline constexpr auto of_hashed_case =
    std::make_tuple(held(&Baseline::scene, "scene", "hash"), held(&Baseline::reference, "reference", "hash"),
                    held(&Baseline::profiles, "profiles", "that the case belonged to"),
                    held(&Baseline::required, "required", "engines that the case required"));

template <>
inline constexpr auto record<Baseline> = std::make_tuple(
    held(&Baseline::id, "case", "id of the case"),
    held(&Baseline::case_hash, "case_hash", "of the case file's text"),
    held(&Baseline::seed, "seed", "of the results"),
    block([](auto& b) { return !b.scene.empty(); }, of_hashed_case),
    unless(
        &Baseline::removed, "removed", [](auto&) { return 0; }, "gates that an acceptance has let go"),
    held(&Baseline::accepted, "accepted", "acceptances, oldest first"),
    held(&Baseline::engines, "engines", "engines that the gates judge"),
    held(&Baseline::gates, "gate", "accepted gates"), held(&Baseline::cost, "cost", "counts of runs"));

}  // namespace tripoint
