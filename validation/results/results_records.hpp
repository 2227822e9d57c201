// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>

#include "validation/case/preflight.hpp"
#include "validation/results/record_entries.hpp"
#include "validation/results/results.hpp"
#include "validation/results/rows.hpp"
#include "validation/results/timing_pairs.hpp"

/// The entries of every record of results.json: keys, members and meanings.
namespace tripoint {

/// Declared in the case file's own record too, with other keys: those of results.json.
template <>
inline constexpr auto record<SourcePlace> =
    std::make_tuple(held(&SourcePlace::file, "file", "where it is declared"),
                    held(&SourcePlace::line, "line", "where it is declared"));

template <>
inline constexpr auto record<Uncertainty> =
    std::make_tuple(reached(
                        "numerical", [](auto& u) { return Stated{u.numerical}; }, "standard, each"),
                    reached(
                        "statistical", [](auto& u) { return Stated{u.statistical}; }, "standard, each"),
                    reached(
                        "input", [](auto& u) { return Stated{u.input}; }, "standard, each"),
                    reached(
                        "data", [](auto& u) { return Stated{u.data}; }, "standard, each"));

template <>
inline constexpr auto record<MetricValue> = std::make_tuple(
    reached(
        "value", [](auto& m) { return Judged{m.value}; }, "in the metric's unit"),
    held(&MetricValue::uncertainty, "uncertainty", "its parts"),
    reached(
        "note", [](auto& m) { return IfAny{m.note}; }, "why there is no value, or where the worst place is"),
    reached(
        "times", [](auto& m) { return IfAny{m.times}; }, "the error in time"),
    reached(
        "series", [](auto& m) { return IfAny{m.series}; }, "the error in time"));

template <>
inline constexpr auto record<Knobs> = std::make_tuple(
    held(&Knobs::spacing, "spacing", "distance of particles", "m"),
    reached(
        "time_step", [](auto& k) { return OrNull{k.time_step}; }, "as the engine says", "s"),
    held(&Knobs::support_ratio, "support_ratio", "h/dx"), held(&Knobs::walkers, "walkers", "counts"),
    held(&Knobs::iterations, "iterations", "counts"),
    reached(
        "mode", [](auto& k) { return OrNull{k.mode}; }, "corrected or paper; null for other engines"),
    held(&Knobs::threads, "threads", "of the run"), held(&Knobs::seed, "seed", "of the run"),
    held(&Knobs::jitter, "jitter", "of the particles", "spacings"));

inline constexpr auto of_timed = std::make_tuple(
    held(&Cost::repeats, "cpu_s", "of each round", "s"),
    formed(
        "min", [](auto& c) { return *std::min_element(c.repeats.begin(), c.repeats.end()); }, "of the rounds",
        "s"),
    formed(
        "median", [](auto& c) { return median(c.repeats); }, "of the rounds", "s"),
    formed(
        "median_deviation", [](auto& c) { return median_deviation(c.repeats); }, "of the rounds", "s"));

template <>
inline constexpr auto record<Cost> = std::make_tuple(
    held(&Cost::cpu_s, "cpu_s", "user and system, of the whole process group", "s"),
    held(&Cost::wall_s, "wall_s", "time on the clock", "s"),
    held(&Cost::setup_cpu_s, "setup_cpu_s", "before the first step, as the engine says", "s"),
    held(&Cost::peak_bytes, "peak_bytes",
         "upper bound of the greatest resident size; Linux includes the size of the program that started the "
         "engine"),
    held(&Cost::pairs, "pairs", "counted by the engine"),
    held(&Cost::steps, "steps", "counted by the engine"),
    held(&Cost::iterations, "iterations", "counted by the engine"),
    held(&Cost::simulated_s, "simulated_s", "time of the scene", "s"),
    held(&Cost::particles, "particles", "at the end"),
    reached(
        "instructions", [](auto& c) { return OrNull{c.instructions}; }, "in user space"),
    replaced(
        &Cost::counted_by, "counted_by",
        [](auto& c) -> std::string { return c.instructions > 0.0 ? c.counted_by : "not measured"; },
        "counter, callgrind, or not measured"),
    part(
        "timed", [](auto& c) { return !c.repeats.empty(); }, of_timed, "of `--timing`"));

template <>
inline constexpr auto record<RunRow> = std::make_tuple(
    held(&RunRow::knobs, "knobs", "settings of the run"),
    held(&RunRow::levels, "levels", "studies that this run belongs to, with its level of each"),
    held(&RunRow::base, "base", "the case's own resolution"),
    held(&RunRow::group, "group", "runs of one group differ by seed only"),
    held(&RunRow::input, "input", "`key=VALUE` where the run is one end of an uncertain input"),
    ended("", "why it is not ok, or the message of the engine"),
    held(&RunRow::comparable, "comparable", "false: the engine holds another scene than it was given"),
    held(&RunRow::metrics, "metrics", "by the metric's name"), held(&RunRow::cost, "cost", "of the run"),
    held(&RunRow::state_hash, "state_hash", "FNV-1a of the last state: equal bits have equal hashes"),
    held(&RunRow::time_step_bound, "time_step_bound", "the effect whose bound set the step"),
    held(&RunRow::folder, "folder", "of job, trajectory and log, relative to results.json; empty: none"));

inline constexpr auto of_limit = std::make_tuple(
    reached(
        "value", [](auto& o) { return NumberOrNull{o.limit.value}; },
        "signed as the errors; null: the levels do not tell it"),
    reached(
        "uncertainty", [](auto& o) { return NumberOrNull{o.limit.uncertainty}; }, "standard"));

template <>
inline constexpr auto record<OrderRow> = std::make_tuple(
    held(&OrderRow::metric, "metric", "metric of the fit"), held(&OrderRow::axes, "axis", "axis of the fit"),
    reached(
        "mode", [](auto& o) { return OrNull{o.mode}; }, "mode of the fit; null for engines without modes"),
    reached(
        "value", [](auto& o) -> auto& { return o.order.value; }, "the order"),
    reached(
        "low", [](auto& o) -> auto& { return o.order.low; }, "its 95 % interval"),
    reached(
        "high", [](auto& o) -> auto& { return o.order.high; }, "its 95 % interval"),
    reached(
        "class", [](auto& o) -> auto& { return o.order.fit_class; }),
    reached(
        "formal", [](auto& o) { return OrNull{o.formal}; }, "the order that the scheme should have"),
    reached(
        "coefficient", [](auto& o) { return NumberOrNull{o.order.coefficient}; },
        "error = floor + coefficient step^value"),
    reached(
        "floor", [](auto& o) { return NumberOrNull{o.order.floor}; },
        "error = floor + coefficient step^value"),
    part(
        "limit", [](auto&) { return true; }, of_limit, "the error extrapolated to step 0"),
    held(&OrderRow::step, "step", "refined quantity, coarse to fine"),
    held(&OrderRow::error, "error", "error at each"),
    held(&OrderRow::uncertainty, "uncertainty", "of each error"),
    held(&OrderRow::numerical, "numerical", "of each level, estimated from the grids alone"));

/// Limits of a gate and their reason: the part that a gate and its row share. `gate` reaches it.
template <class Get>
[[nodiscard]] constexpr auto allowed_by(Get gate) {
  return std::make_tuple(
      reached(
          "limit", [gate](auto& r) -> auto& { return gate(r).limit; }, "abs(value) + 2 u is at most this"),
      reached(
          "band", [gate](auto& r) -> auto& { return gate(r).band; }, "lowest and highest value"),
      reached(
          "at_least", [gate](auto& r) -> auto& { return gate(r).at_least; }, "value - 2 u is at least this"),
      reached(
          "drift", [gate](auto& r) -> auto& { return gate(r).drift; },
          "fraction by which the value may move from its baseline"),
      reached(
          "reason", [gate](auto& r) -> auto& { return gate(r).reason; },
          "reason of the limit, its author and its day"),
      reached(
          "by", [gate](auto& r) -> auto& { return gate(r).by; },
          "reason of the limit, its author and its day"),
      reached(
          "date", [gate](auto& r) -> auto& { return gate(r).date; },
          "reason of the limit, its author and its day"),
      reached(
          "file", [gate](auto& r) -> auto& { return gate(r).place.file; }, "where it is declared"),
      reached(
          "line", [gate](auto& r) -> auto& { return gate(r).place.line; }, "where it is declared"));
}

inline constexpr auto gate_in_results = std::tuple_cat(
    std::make_tuple(held(&Gate::metric, "metric", "a metric, or NAME.order, NAME.limit, NAME.statistical"),
                    held(&Gate::engine, "engine", "judged engine, mode and preset; empty: all"),
                    held(&Gate::mode, "mode", "judged engine, mode and preset; empty: all"),
                    held(&Gate::preset, "preset", "judged engine, mode and preset; empty: all"),
                    held(&Gate::level, "level", "of the study's axis; null: every run"),
                    held(&Gate::expect, "expect",
                         "class of convergence that an order must have; empty: any that falls to the truth")),
    allowed_by([](auto& g) -> auto& { return g; }));
template <>
inline constexpr const auto& entries_of<Gate> = gate_in_results;

template <>
inline constexpr auto record<GateRow> = std::tuple_cat(
    std::make_tuple(reached(
                        "metric", [](auto& r) -> auto& { return r.gate.metric; },
                        "as declared, and of the judged run"),
                    reached(
                        "mode", [](auto& r) { return OrNull{r.mode}; }, "as declared, and of the judged run"),
                    held(&GateRow::level, "level", "as declared, and of the judged run")),
    allowed_by([](auto& r) -> auto& { return r.gate; }),
    std::make_tuple(
        reached(
            "value", [](auto& r) { return Judged{r.value}; }, "measured"),
        reached(
            "uncertainty", [](auto& r) { return NumberOrNull{r.uncertainty}; }, "of the value"),
        held(&GateRow::budget, "budget", "parts of the uncertainty"),
        reached(
            "low", [](auto& r) { return IfAny{r.low}; }, "95 % interval of an order"),
        reached(
            "high", [](auto& r) { return IfAny{r.high}; }, "95 % interval of an order"),
        reached(
            "class", [](auto& r) { return IfAny{r.fit_class}; }, "class of convergence, as fitted"),
        reached(
            "expect", [](auto& r) { return IfAny{r.expect}; }, "class of convergence, as asked"),
        held(&GateRow::verdict, "verdict"), held(&GateRow::physics, "physics"),
        reached(
            "defect", [](auto& r) { return IfAny{r.defect}; }, "name of the defect that the gate declares"),
        reached(
            "used", [](auto& r) { return NumberOrNull{r.used}; },
            "fraction of its limit: 0 is best, 1 the edge"),
        held(&GateRow::why, "why", "one sentence where it is not pass")));

/// Orders that say something: value and interval are numbers.
[[nodiscard]] inline std::vector<OrderRow> known_orders(const EngineRow& e) {
  std::vector<OrderRow> rows;
  for (const auto& o : e.order)
    if (std::isfinite(o.order.value) && std::isfinite(o.order.low) && std::isfinite(o.order.high))
      rows.push_back(o);
  return rows;
}

inline constexpr auto of_library =
    std::make_tuple(held(&EngineRow::library_path, "path", "where it lies, and FNV-1a of its bytes"),
                    held(&EngineRow::library_hash, "hash", "where it lies, and FNV-1a of its bytes"));
inline constexpr auto of_executable =
    std::make_tuple(held(&EngineRow::executable, "path", "where it lies, and FNV-1a of its bytes"),
                    held(&EngineRow::executable_hash, "hash", "where it lies, and FNV-1a of its bytes"));

template <>
inline constexpr auto record<EngineRow> = std::make_tuple(
    held(&EngineRow::name, "name", "of the engine"), held(&EngineRow::version, "version", "as it says"),
    held(&EngineRow::preset, "preset", "`default`, or the vendor's own word"),
    held(&EngineRow::required, "required", "the case needs it"), ended("", "why it is not ok"),
    formed(
        "judged", [](auto& e) { return !is_unjudged(e); }, "a gate looked at it"),
    formed(
        "physics", [](auto& e) { return e.physics; }, "the worst of its gates"),
    formed(
        "defects", [](auto& e) { return e.defects; }, "names of the known defects that were measured"),
    reached(
        "refuses", [](auto& e) { return IfAny{e.refuses}; },
        "words of the refusal that the case expects of it"),
    part(
        "library", [](auto& e) { return !e.library_path.empty(); }, of_library, "the engine's own library"),
    part(
        "executable", [](auto& e) { return !e.executable.empty(); }, of_executable, "its program"),
    held(&EngineRow::deterministic, "deterministic", "as it says of itself"),
    held(&EngineRow::runs, "runs", "see `cases[].engines[].runs[]`"),
    formed("order", known_orders, "fitted orders of convergence"),
    formed(
        "gates", [](auto& e) -> auto& { return e.gates; }, "gates as applied to this engine"));

/// The case's own words, or those of the reference function.
[[nodiscard]] std::string source_of(const ReferenceChoice&);

inline constexpr auto reference_in_results =
    std::make_tuple(held(&ReferenceChoice::kind, "kind"),
                    held(&ReferenceChoice::function, "function", "name of the function, or empty"),
                    held(&ReferenceChoice::file, "file", "data file, or empty"),
                    replaced(&ReferenceChoice::source, "source", source_of, "where it is from"),
                    held(&ReferenceChoice::args, "args", "arguments by name"),
                    held(&ReferenceChoice::uncertainty, "uncertainty", "standard, of the reference"));
template <>
inline constexpr const auto& entries_of<ReferenceChoice> = reference_in_results;

inline constexpr auto metric_in_results =
    std::make_tuple(held(&MetricChoice::name, "name", "its name"),
                    held(&MetricChoice::quantity, "quantity", "see [case-file.md](case-file.md)"),
                    held(&MetricChoice::norm, "norm", "see [case-file.md](case-file.md)"),
                    held(&MetricChoice::body, "body", "of one body; empty: all"),
                    held(&MetricChoice::at, "at", "end, a time, or all"),
                    held(&MetricChoice::window, "window", "times between which it is formed", "s"),
                    held(&MetricChoice::scale, "scale", "the value is divided by this"),
                    held(&MetricChoice::unit, "unit", "after the scale"),
                    held(&MetricChoice::reference, "reference", "its own truth, where it has one"));
template <>
inline constexpr const auto& entries_of<MetricChoice> = metric_in_results;

inline constexpr auto study_in_results = std::make_tuple(
    held(&Study::axes, "axis", "spacing, time_step, support_ratio, walkers, iterations"),
    held(&Study::levels, "levels", "coarse to fine"),
    held(&Study::jitter, "jitter", "of the particles", "spacings"),
    held(&Study::seeds, "seeds", "runs a level"),
    held(&Study::engine, "engine", "studied engine and mode; empty: all"),
    held(&Study::mode, "mode", "studied engine and mode; empty: all"),
    held(&Study::expect, "expect", "class of convergence that is asked; empty: none"),
    held(&Study::order, "order", "the formal order"), held(&Study::metric, "metric", "empty: all"),
    reached(
        "file", [](auto& s) -> auto& { return s.place.file; }, "where it is declared"),
    reached(
        "line", [](auto& s) -> auto& { return s.place.line; }, "where it is declared"));
template <>
inline constexpr const auto& entries_of<Study> = study_in_results;

template <>
inline constexpr auto record<EquivalenceRow> = std::make_tuple(
    held(&EquivalenceRow::a, "a", "the two, with their presets"),
    held(&EquivalenceRow::b, "b", "the two, with their presets"),
    held(&EquivalenceRow::metric, "metric", "in which they are compared"),
    reached(
        "difference", [](auto& q) { return NumberOrNull{q.difference}; }, "of the two"),
    reached(
        "uncertainty", [](auto& q) { return NumberOrNull{q.uncertainty}; }, "of the difference"),
    held(&EquivalenceRow::margin, "margin", "limit of the case for this metric"),
    reached(
        "error_a", [](auto& q) { return NumberOrNull{q.error_a}; }, "each one's error to the truth"),
    reached(
        "error_b", [](auto& q) { return NumberOrNull{q.error_b}; }, "each one's error to the truth"),
    held(&EquivalenceRow::verdict, "verdict"));

template <>
inline constexpr auto record<CaseHashes> =
    std::make_tuple(held(&CaseHashes::scene, "scene", "of these parts"),
                    held(&CaseHashes::reference, "reference", "of these parts"),
                    held(&CaseHashes::metrics, "metrics", "by the metric's name"));

/// "not resolved" is said here, so that no reader has to know how.
template <>
inline constexpr auto record<TimingPair> = std::make_tuple(
    held(&TimingPair::a, "a", "the two"), held(&TimingPair::b, "b", "the two"),
    held(&TimingPair::ratio, "ratio", "CPU seconds of a over those of b, medians"),
    formed(
        "verdict", [](auto& p) { return std::string(p.resolved ? "resolved" : "not resolved"); },
        "resolved or not resolved"));

inline constexpr auto of_timing =
    std::make_tuple(held(&CaseResult::timing_rounds, "rounds", "interleaved rounds"),
                    reached(
                        "noise_floor", [](auto& c) { return NumberOrNull{c.timing_floor}; },
                        "factor by which an engine differed from itself"),
                    formed(
                        "pairs", [](auto& c) { return timing_pairs(c); }, "engines by two"));

template <>
inline constexpr auto record<CaseResult> = std::make_tuple(
    held(&CaseResult::id, "id", "subject/name"), held(&CaseResult::title, "title", "of the case file"),
    held(&CaseResult::kind, "kind",
         "verification (an exact solution), validation (an experiment) or comparison (engines)"),
    held(&CaseResult::requirement, "requirement", "its number"),
    held(&CaseResult::claims, "claims", "statement that the case shows"),
    held(&CaseResult::tags, "tags", "of the case file"), held(&CaseResult::file, "file", "the case file"),
    held(&CaseResult::expect, "expect"),
    formed(
        "verdict", [](auto& c) { return c.verdict; }, "as of the whole"),
    formed(
        "physics", [](auto& c) { return c.physics; }, "the worst of its engines"),
    formed(
        "exit_code", [](auto& c) { return c.exit_code; }, "of this case alone"),
    formed(
        "problems", [](auto& c) -> auto& { return c.problems; }, "why it is not PASS, beyond the gates"),
    held(&CaseResult::reference, "reference", "the truth"),
    held(&CaseResult::metrics, "metrics", "measured numbers, as declared"),
    held(&CaseResult::studies, "studies", "refinements, as declared"),
    held(&CaseResult::gates, "gates", "limits, as declared"),
    reached(
        "adopted", [](auto& c) { return IfAny{c.adopted}; }, "engines that `gate adopt` wrote the case for"),
    held(&CaseResult::engines, "engines", "see `cases[].engines[]`"),
    held(&CaseResult::equivalence, "equivalence", "engine against engine"),
    formed(
        "unjudged", [](auto& c) { return unjudged_metrics(c.metrics, c.gates, c.studies); },
        "metrics that no gate judges"),
    held(&CaseResult::ledger, "ledger",
         "change of each energy of our solver over the run, and `residual` ([trajectory.md](trajectory.md), "
         "observables)",
         "J"),
    held(&CaseResult::repeat, "repeat", "the command that runs this case again"),
    held(&CaseResult::hashes, "hashes", "of the case that was run"),
    part(
        "timing", [](auto& c) { return c.timing_rounds > 0; }, of_timing, "of `--timing`"));

template <>
inline constexpr auto record<Tool> = std::make_tuple(
    held(&Tool::version, "version", "version of tripoint"),
    held(&Tool::commit, "commit", "of the sources; with `-dirty` where they were changed"),
    held(&Tool::compiler, "compiler", "name and version"), held(&Tool::flags, "flags", "of the compiler"),
    held(&Tool::cpu, "cpu", "the processor's name"), held(&Tool::cores, "cores", "how many"));

template <>
inline constexpr auto record<Results> = std::make_tuple(
    held(&Results::format, "format", "1"), held(&Results::tool, "tool", "the measuring program and machine"),
    held(&Results::command, "command", "the command line"), held(&Results::date, "date", "UTC, at the start"),
    held(&Results::profile, "profile", "commit, nightly, release, acceptance, or empty: named cases"),
    held(&Results::seed, "seed", "of `--seed`, else 1"),
    held(&Results::shard, "shard", "`i/n`, or empty: the whole"),
    held(&Results::interrupted, "interrupted", "Ctrl-C ended it"),
    held(&Results::history, "history", "file of the history, relative to this one; empty: none"),
    held(&Results::planned, "planned", "ids of the cases that had to be run"),
    held(&Results::what, "what", "cases and folders that were named; empty: those beside the program"),
    held(&Results::tag, "tag", "of `--tag`"),
    held(&Results::filter_known, "whole", "these are all cases of `what`, `tag` and `profile`"),
    held(&Results::seed_given, "seed_given", "`--seed` replaced the cases' own"),
    held(&Results::only_engines, "only_engines", "of `--engines`; empty: all"),
    held(&Results::asked, "asked", "engines that the command line named"), held(&Results::verdict, "verdict"),
    held(&Results::exit_code, "exit_code", "exit code of the command ([harness.md](harness.md))"),
    formed(
        "problems", [](auto& r) -> auto& { return r.problems; }, "faults of the whole"),
    held(&Results::cases, "cases", "see `cases[]`"));

}  // namespace tripoint
