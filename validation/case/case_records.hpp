// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "tables/record.hpp"
#include "validation/case/case.hpp"

/// The keys that say how a scene is judged, each beside the member that keeps it. A key without a member has
/// a rule in the reader.
namespace tripoint {
namespace records {
using enum ValueType;
using enum Range;

inline constexpr auto of_case = std::make_tuple(
    Key{"case", "id", text, "", any, "=", "folder and name of the file", "",
        "name of the case: subject/case"},
    Key{"case", "title", text, "", any, "=", "the id", "", "title in one line"},
    kept(&Case::requirement, {"case", "requirement", text, "", any, "\"\"", "none is stated", "",
                              "label of the requirement that the case shows"}),
    kept(&Case::claims,
         {"case", "claims", text, "", any, "\"\"", "none is stated", "", "statement that the gates prove"}),
    kept(&Case::kind,
         {"case", "kind", word, "", any, "\"verification\"", "against an exact solution", word_line<CaseKind>,
          "kind of truth: verification: exact solution; validation: experiment; comparison: another engine"}),
    kept(&Case::profiles,
         {"case", "profiles", words, "", any, "[\"commit\"]", "runs with every change",
          "commit nightly release acceptance",
          "suites that the case belongs to; acceptance: it has a limit that any engine must hold"}),
    kept(&Case::tags, {"case", "tags", texts, "", any, "[]", "none", "", "words to select cases by"}),
    kept(&Case::expect,
         {"case", "expect", word, "", any, "\"pass\"", "a case is meant to pass", word_line<Expect>,
          "outcome with which the case passes; paper-diverges: only the printed form diverges"}),
    kept(&Case::modes, {"case", "modes", words, "", any, "=", "the scene's mode", "corrected paper",
                        "forms of the model that are run, one set of runs each"}));

inline constexpr auto of_engine = std::make_tuple(
    kept(&EngineChoice::required, {"engines", "required", flag, "", any, "false",
                                   "its absence is a row of the report and no failure (tripoint: true)", "",
                                   "true: the case fails where the engine is missing"}),
    kept(&EngineChoice::presets, {"engines", "preset", text_or_texts, "", any, "[]", "the engine's default",
                                  "", "presets of the engine, one row of the results each"}),
    kept(&EngineChoice::adopted,
         {"engines", "adopted", flag, "", any, "false", "it may be left out by --engines", "",
          "`tripoint gate adopt` wrote its gates; leaving the engine out by --engines is exit 4"}),
    Key{"engines", "refuses", text, "", any, "", "it may take the case or refuse it", "",
        "words of the expected refusal; the case fails if the engine takes it or refuses for another reason"},
    kept(&EngineChoice::settings, {"engines", "settings", settings, "", any, "{}", "the preset's own", "",
                                   "settings of the engine, by its own keys"}));

inline constexpr auto of_reference = std::make_tuple(
    kept(&ReferenceChoice::kind, {"reference", "kind", word, "", any, "\"analytic\"", "an exact solution",
                                  word_line<ReferenceKind>, "kind of truth"}),
    kept(&ReferenceChoice::function,
         {"reference", "function", text, "", any, "=", "none", "", "name of the exact solution"}),
    kept(&ReferenceChoice::args,
         {"reference", "args", settings, "", any, "{}", "from the scene", "", "arguments of the function"}),
    kept(&ReferenceChoice::file,
         {"reference", "file", text, "", any, "\"\"", "no data", "", "data beside the case: <case>.ref.*"}),
    kept(&ReferenceChoice::source, {"reference", "source", text, "", any, "\"\"", "the function's own", "",
                                    "source of the truth: book, paper or derivation"}),
    kept(&ReferenceChoice::uncertainty, {"reference", "uncertainty", number, "", not_negative, "0", "exact",
                                         "", "standard uncertainty of the reference, in the metric's unit"}));

inline constexpr auto of_metric = std::make_tuple(
    kept(&MetricChoice::name, {"metric", "name", text, "", any, "!", "", "", "name of the metric"}),
    kept(&MetricChoice::quantity,
         {"metric", "quantity", text, "", any, "!", "", "",
          "position orientation velocity angular_velocity temperature pressure density force torque "
          "phase_count body_count event_time "
          "ledger.TERM"}),
    kept(&MetricChoice::norm, {"metric", "norm", word, "", any, "\"max\"", "the worst counts",
                               word_line<Norm>, "norm over samples and time"}),
    kept(&MetricChoice::body,
         {"metric", "body", text, "", any, "\"\"", "all", "", "body whose samples count"}),
    kept(&MetricChoice::at, {"metric", "at", text, "", any, "\"end\"", "where errors have grown", "",
                             "time at which the metric is taken"}),
    Key{"metric", "window", numbers, "s", any, "[0, 0]", "all frames", "", "first and last time that count"},
    kept(&MetricChoice::average,
         {"metric", "average", number, "s", not_negative, "0", "each output time alone", "",
          "time around each output time over which a single number is averaged"}),
    kept(&MetricChoice::scale, {"metric", "scale", number, "", positive, "1", "in the quantity's own unit",
                                "", "number that the error is divided by"}),
    kept(&MetricChoice::unit,
         {"metric", "unit", text, "", any, "\"\"", "the quantity's own, where scale is 1", "",
          "unit of the scaled value, as the report prints it"}),
    Key{"metric", "reference", table, "", any, "=", "the case's", "reference",
        "reference of this metric alone"},
    Key{"metric", "gates", tables, "", any, "", "gates stand in [[gate]]", "gates",
        "gates of this metric, each without the key metric"},
    Key{"metric", "limits", settings, "", any, "", "no limit by level", "",
        "one gate for each level of the study, for all engines: { LEVEL = LIMIT, ... }"},
    Key{"metric", "reason", text, "", any, "", "gates bring their own", "", "reason of `limits`"});

inline constexpr auto of_study = std::make_tuple(
    Key{"study", "axis", word, "", any, "!", "", word_line<Axis>, "axis that is refined"},
    Key{"study", "levels", numbers, "", any, "!", "", "", "values in the axis's own unit, coarse to fine"},
    Key{"study", "support_ratios", numbers, "", any, "", "the case's own", "",
        "support ratios that are refined together with the levels, one for each"},
    Key{"study", "time_steps", numbers, "s", any, "", "the case's own", "",
        "time steps that are refined together with the levels, one for each"},
    kept(&Study::jitter, {"study", "jitter", number, "", fraction, "0", "an undisturbed lattice", "",
                          "jitter of the runs, in spacings"}),
    Key{"study", "seeds", integer, "", positive, "1", "one run a level", "",
        "number of runs for each level, each with its own seed"},
    kept(&Study::engine, {"study", "engine", text, "", any, "\"\"", "all", "", "engine that is refined"}),
    Key{"study", "mode", text, "", any, "\"\"", "all", "",
        "form that is refined: corrected, paper; \"not paper\": all runs except tripoint's paper-mode runs"},
    Key{"study", "expect", word, "", any, "\"\"", "not judged", word_line<FitClass>,
        "expected class of the convergence"},
    kept(&Study::order, {"study", "order", number, "", any, "", "not judged", "", "formal order"}),
    kept(&Study::metric,
         {"study", "metric", text, "", any, "\"\"", "every metric", "", "metric that is fitted"}));

inline constexpr auto of_gate = std::make_tuple(
    kept(&Gate::metric, {"gate", "metric", text, "", any, "!", "", "",
                         "a metric's name, NAME.order, NAME.limit or NAME.statistical"}),
    kept(&Gate::engine, {"gate", "engine", text, "", any, "\"\"", "all", "", "engine that the gate judges"}),
    Key{"gate", "mode", text, "", any, "\"\"", "all", "",
        "form that is judged: corrected, paper; \"not paper\": all runs except tripoint's paper-mode runs"},
    kept(&Gate::preset, {"gate", "preset", text, "", any, "\"\"", "all", "", "preset that the gate judges"}),
    kept(&Gate::limit, {"gate", "limit", number, "", any, "", "none", "", "greatest magnitude of the value"}),
    kept(&Gate::at_least, {"gate", "at_least", number, "", any, "", "none", "", "least value"}),
    Key{"gate", "band", numbers, "", any, "", "none", "", "least and greatest value"},
    Key{"gate", "expect", word, "", any, "\"\"", "any that falls to the truth", word_line<FitClass>,
        "of NAME.order: the class of convergence that is due; plateau declares an error that ends on a "
        "floor"},
    kept(&Gate::level, {"gate", "level", number, "", any, "", "every run", "",
                        "level of the study's axis that the gate judges"}),
    Key{"gate", "limits", settings, "", any, "", "none", "",
        "instead of level and limit, one gate for each: { LEVEL = LIMIT, ... }"},
    kept(&Gate::drift, {"gate", "drift", number, "", positive, "", "a tenth, and it warns only", "",
                        "fraction by which the value may move from its baseline before the gate is red"}),
    kept(&Gate::reason,
         {"gate", "reason", text, "", any, "!", "", "",
          "reason of the limit. \"known defect NAME: ...\" in a band of a named engine excuses it from the "
          "acceptance limit, which it must exceed"}),
    kept(&Gate::by, {"gate", "by", text, "", any, "\"\"", "unsigned", "", "name of who set the limit"}),
    kept(&Gate::date,
         {"gate", "date", text, "", any, "\"\"", "undated", "", "date on which the limit was accepted"}));

inline constexpr auto of_input = std::make_tuple(
    kept(&UncertainInput::key, {"input", "key", text, "", any, "!", "", "",
                                "key of the uncertain number, as --set names it: material.water.viscosity"}),
    kept(&UncertainInput::low, {"input", "low", text, "", any, "!", "", "",
                                "value less one standard uncertainty, as text: \"0.99e-3 Pa s\""}),
    kept(&UncertainInput::high,
         {"input", "high", text, "", any, "!", "", "", "value plus one standard uncertainty"}));

inline constexpr auto of_defect = std::make_tuple(
    kept(&Defect::name, {"defect", "name", text, "", any, "!", "", "",
                         "name of a registered defect: heat.conductivity ..."}),
    kept(&Defect::size, {"defect", "size", number, "", any, "!", "", "", "size of the defect"}),
    kept(&Defect::smallest, {"defect", "smallest", number, "", positive, "", "it is not sought", "",
                             "least size that the gates catch; the self-test finds it by bisection and fails "
                             "if it grew by a quarter"}),
    kept(&Defect::killed_by, {"defect", "killed_by", text_or_texts, "", any, "[]", "any gate", "",
                              "metrics whose gates must fail, all of them"}));

}  // namespace records

template <>
inline constexpr auto record<Case> = records::of_case;
template <>
inline constexpr auto record<EngineChoice> = records::of_engine;
template <>
inline constexpr auto record<ReferenceChoice> = records::of_reference;
template <>
inline constexpr auto record<MetricChoice> = records::of_metric;
template <>
inline constexpr auto record<Study> = records::of_study;
template <>
inline constexpr auto record<Gate> = records::of_gate;
template <>
inline constexpr auto record<UncertainInput> = records::of_input;
template <>
inline constexpr auto record<Defect> = records::of_defect;

}  // namespace tripoint
