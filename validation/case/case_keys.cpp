// SPDX-License-Identifier: BSD-3-Clause
#include "validation/case/case_keys.hpp"

#include <array>
#include <span>

#include "files/reference_choice.hpp"
#include "scene/scene_keys.hpp"
#include "validation/case/case_document.hpp"
#include "validation/case/case_words.hpp"

namespace tripoint {
namespace {

using enum ValueType;
using enum Range;

/// Before the scene's keys.
constexpr auto keys_before = std::to_array<Key>({
    {"", "format", integer, "", positive, "1", "the first version", "", "version of the case file"},
    {"", "extends", text, "", any, "", "the case stands on its own", "",
     "case that supplies the keys missing here: a file of this folder, \"other.toml\", or a case's name"},
    {"", "remove", texts, "", any, "", "all of it holds", "",
     "keys and tables of the extended case that are removed: \"scene.jitter\", \"metric.overlap\" (and its gates), \"study\""},
    {"", "case", table, "", any, "=", "id from the file's place", "case", "claim and judgement"},
});

/// Behind the scene's keys.
constexpr auto keys_behind = std::to_array<Key>({
    {"", "engines", table, "", any, "=", "every engine that can", "engines",
     "engines of this case, one table for each: [engines.NAME]"},
    {"", "reference", table, "", any, "=", "only the invariants are known", "reference", "the truth, where it is known"},
    {"", "metric", tables, "", any, "=", "nothing is measured", "metric", "numbers computed from each run"},
    {"", "invariants", table, "", any, "", "nothing but the metrics", "invariants",
     "quantities that every run must keep: a metric and its gate on one line"},
    {"", "study", tables, "", any, "=", "one run an engine", "study", "convergence studies"},
    {"", "gate", tables, "", any, "=", "nothing is judged", "gate", "limits"},
    {"", "input", tables, "", any, "=", "every number counts as exact", "input", "uncertain numbers"},
    {"", "defect", tables, "", any, "=", "none", "defect", "faults that this case must catch"},
    {"", "harmless", tables, "", any, "=", "none", "harmless", "changes that must not change any metric"},
    // [case]
    {"case", "id", text, "", any, "=", "folder and name of the file", "", "name of the case: subject/case"},
    {"case", "title", text, "", any, "=", "the id", "", "title in one line"},
    {"case", "requirement", text, "", any, "\"\"", "none is stated", "", "label of the requirement that the case shows"},
    {"case", "claims", text, "", any, "\"\"", "none is stated", "", "statement that the gates prove"},
    {"case", "kind", word, "", any, "\"verification\"", "against an exact solution", word_line<CaseKind>,
     "kind of truth: verification: exact solution; validation: experiment; comparison: another engine"},
    {"case", "profiles", words, "", any, "[\"commit\"]", "runs with every change", "commit nightly release acceptance",
     "suites that the case belongs to; acceptance: it has a limit that any engine must hold"},
    {"case", "tags", texts, "", any, "[]", "none", "", "words to select cases by"},
    {"case", "expect", word, "", any, "\"pass\"", "a case is meant to pass", word_line<Expect>,
     "outcome with which the case passes; paper-diverges: only the printed form diverges"},
    {"case", "modes", words, "", any, "=", "the scene's mode", "corrected paper",
     "forms of the model that are run, one set of runs each"},
    // [engines.NAME]
    {"engines", "required", flag, "", any, "false", "its absence is a row of the report and no failure (tripoint: true)", "",
     "true: the case fails where the engine is missing"},
    {"engines", "preset", text_or_texts, "", any, "[]", "the engine's default", "",
     "presets of the engine, one row of the results each"},
    {"engines", "adopted", flag, "", any, "false", "it may be left out by --engines", "",
     "`tripoint gate adopt` wrote its gates; leaving the engine out by --engines is exit 4"},
    {"engines", "refuses", text, "", any, "", "it may take the case or refuse it", "",
     "words of the expected refusal; the case fails if the engine takes it or refuses for another reason"},
    {"engines", "settings", settings, "", any, "{}", "the preset's own", "", "settings of the engine, by its own keys"},
    // [reference]
    {"reference", "kind", word, "", any, "\"analytic\"", "an exact solution", word_line<ReferenceKind>, "kind of truth"},
    {"reference", "function", text, "", any, "=", "none", "", "name of the exact solution"},
    {"reference", "args", settings, "", any, "{}", "from the scene", "", "arguments of the function"},
    {"reference", "file", text, "", any, "\"\"", "no data", "", "data beside the case: <case>.ref.*"},
    {"reference", "source", text, "", any, "\"\"", "the function's own", "", "source of the truth: book, paper or derivation"},
    {"reference", "uncertainty", number, "", not_negative, "0", "exact", "",
     "standard uncertainty of the reference, in the metric's unit"},
    // [[metric]]
    {"metric", "name", text, "", any, "!", "", "", "name of the metric"},
    {"metric", "quantity", text, "", any, "!", "", "",
     "position orientation velocity angular_velocity temperature pressure density force torque phase_count body_count event_time "
     "ledger.TERM"},
    {"metric", "norm", word, "", any, "\"max\"", "the worst counts", word_line<Norm>, "norm over samples and time"},
    {"metric", "body", text, "", any, "\"\"", "all", "", "body whose samples count"},
    {"metric", "at", text, "", any, "\"end\"", "where errors have grown", "", "time at which the metric is taken"},
    {"metric", "window", numbers, "s", any, "[0, 0]", "all frames", "", "first and last time that count"},
    {"metric", "scale", number, "", positive, "1", "in the quantity's own unit", "", "number that the error is divided by"},
    {"metric", "unit", text, "", any, "\"\"", "the quantity's own, where scale is 1", "",
     "unit of the scaled value, as the report prints it"},
    {"metric", "reference", table, "", any, "=", "the case's", "reference", "reference of this metric alone"},
    {"metric", "gates", tables, "", any, "", "gates stand in [[gate]]", "gates",
     "gates of this metric, each without the key metric"},
    {"metric", "limits", settings, "", any, "", "no limit by level", "",
     "one gate for each level of the study, for all engines: { LEVEL = LIMIT, ... }"},
    {"metric", "reason", text, "", any, "", "gates bring their own", "", "reason of `limits`"},
    // [[study]]
    {"study", "axis", word, "", any, "!", "", word_line<Axis>, "axis that is refined"},
    {"study", "levels", numbers, "", any, "!", "", "", "values in the axis's own unit, coarse to fine"},
    {"study", "support_ratios", numbers, "", any, "", "the case's own", "",
     "support ratios that are refined together with the levels, one for each"},
    {"study", "time_steps", numbers, "s", any, "", "the case's own", "",
     "time steps that are refined together with the levels, one for each"},
    {"study", "jitter", number, "", fraction, "0", "an undisturbed lattice", "", "jitter of the runs, in spacings"},
    {"study", "seeds", integer, "", positive, "1", "one run a level", "",
     "number of runs for each level, each with its own seed"},
    {"study", "engine", text, "", any, "\"\"", "all", "", "engine that is refined"},
    {"study", "mode", text, "", any, "\"\"", "all", "",
     "form that is refined: corrected, paper; \"not paper\": all runs except tripoint's paper-mode runs"},
    {"study", "expect", word, "", any, "\"\"", "not judged", word_line<FitClass>, "expected class of the convergence"},
    {"study", "order", number, "", any, "", "not judged", "", "formal order"},
    {"study", "metric", text, "", any, "\"\"", "every metric", "", "metric that is fitted"},
    // [[gate]]
    {"gate", "metric", text, "", any, "!", "", "", "a metric's name, NAME.order, NAME.limit or NAME.statistical"},
    {"gate", "engine", text, "", any, "\"\"", "all", "", "engine that the gate judges"},
    {"gate", "mode", text, "", any, "\"\"", "all", "",
     "form that is judged: corrected, paper; \"not paper\": all runs except tripoint's paper-mode runs"},
    {"gate", "preset", text, "", any, "\"\"", "all", "", "preset that the gate judges"},
    {"gate", "limit", number, "", any, "", "none", "", "greatest magnitude of the value"},
    {"gate", "at_least", number, "", any, "", "none", "", "least value"},
    {"gate", "band", numbers, "", any, "", "none", "", "least and greatest value"},
    {"gate", "expect", word, "", any, "\"\"", "any that falls to the truth", word_line<FitClass>,
     "of NAME.order: the class of convergence that is due; plateau declares an error that ends on a floor"},
    {"gate", "level", number, "", any, "", "every run", "", "level of the study's axis that the gate judges"},
    {"gate", "limits", settings, "", any, "", "none", "",
     "instead of level and limit, one gate for each: { LEVEL = LIMIT, ... }"},
    {"gate", "drift", number, "", positive, "", "a tenth, and it warns only", "",
     "share by which the value may move from its baseline before the gate is red"},
    {"gate", "reason", text, "", any, "!", "", "",
     "reason of the limit. \"known defect NAME: ...\" in a band of a named engine excuses it from the acceptance limit, which it "
     "must then exceed"},
    {"gate", "by", text, "", any, "\"\"", "unsigned", "", "name of who set the limit"},
    {"gate", "date", text, "", any, "\"\"", "undated", "", "date on which the limit was accepted"},
    // [[input]], [[defect]], [[harmless]]
    {"input", "key", text, "", any, "!", "", "", "key of the uncertain number, as --set names it: material.water.viscosity"},
    {"input", "low", text, "", any, "!", "", "", "value less one standard uncertainty, as text: \"0.99e-3 Pa s\""},
    {"input", "high", text, "", any, "!", "", "", "value plus one standard uncertainty"},
    {"defect", "name", text, "", any, "!", "", "", "name of a registered defect: heat.conductivity ..."},
    {"defect", "size", number, "", any, "!", "", "", "size of the defect"},
    {"defect", "smallest", number, "", positive, "", "it is not sought", "",
     "least size that the gates catch; the self-test finds it by bisection and fails if it grew by a quarter"},
    {"defect", "killed_by", text_or_texts, "", any, "[]", "any gate", "", "metrics whose gates must fail, all of them"},
    {"harmless", "name", word, "", any, "!", "", "threads order ulp boost mirror rotation units",
     "`threads`: 2 instead of 1. `order`: of the particles. `ulp`: of each coordinate. `boost`: a velocity added to all. "
     "`mirror`: in x. `rotation`: x to y to z to x. `units`: powers of 2"},
});

constexpr auto tables_before = std::to_array<TableInfo>({
    {"", "(top)", "The file. Numbers are SI, or texts with a unit: \"3 mm\", \"1.2 g/cm3\", \"20 degC\"."},
    {"case", "[case]", "The claim of the case, and its judgement."},
});
constexpr auto tables_behind = std::to_array<TableInfo>({
    {"engines", "[engines.NAME]",
     "Each engine and preset is one row of the results. Settings of [engines.all] go to every engine: `friction` (Coulomb's "
     "coefficient) and `restitution` of every pair of bodies. An engine's own settings go before them."},
    {"reference", "[reference]", "The truth that metrics are compared with."},
    {"metric", "[[metric]]", "A number computed from each run."},
    {"gates", "[[metric]] gates = [{...}]",
     "A gate within its metric, with the keys of [[gate]]. `metric` only says NAME.order, NAME.limit or NAME.statistical."},
    {"invariants", "[invariants]", "Quantities that a run must keep, each by its name: `ledger = 1e-9`, or a table."},
    {"invariant", "[invariants.NAME]",
     "A quantity that a run must keep. It has the keys of [[metric]], without quantity and limits, and those of [[gate]]. reason "
     "is required where the limit is not round-off."},
    {"study", "[[study]]", "Runs at several levels of one axis: a convergence study."},
    {"gate", "[[gate]]", "A limit that decides between pass and fail."},
    {"input", "[[input]]",
     "An uncertain number. The run is repeated with the number at both ends; half the difference of a metric is its input "
     "uncertainty."},
    {"defect", "[[defect]]", "A fault that this case must catch."},
    {"harmless", "[[harmless]]",
     "An invariance test: a change without physical effect. `tripoint gate selftest` runs the changed scene; no verdict or "
     "metric may change."},
});

/// A gate within its metric has the keys of a gate, an invariant those of a metric and of a gate.
void add_short_forms(std::vector<Key>& list) {
  std::vector<Key> more;
  for (Key key : list) {
    if (key.table != "gate") continue;
    key.table = "gates";
    if (key.name == "metric") {
      key.fallback = "=";
      key.note = "the metric that holds it";
    }
    more.push_back(key);
  }
  for (const Invariant& one : invariants())
    more.push_back({"invariants", one.name, invariant, "", any, "", "it is not measured", "", one.meaning});
  more.push_back({"invariant", "value", number, "", any, "=", "0; required by body_count", "",
                  "stated value of the quantity; only of overlap, body_count and toggles"});
  for (Key key : list) {
    const bool of_metric = key.table == "metric" && key.name != "quantity" && key.name != "limits",
               of_gate = key.table == "gate" && key.name != "metric";
    if (!of_gate && (!of_metric || key.name == "reason")) continue;
    key.table = "invariant";
    if (key.name == "name") {
      key.fallback = "=";
      key.note = "the invariant's";
    }
    if (key.name == "norm") {
      key.fallback = "=";
      key.note = "the invariant's";
    }
    if (key.name == "reason") {
      key.fallback = "=";
      key.note = "round-off, of mass, momentum, angular_momentum and ledger; required by the others";
    }
    more.push_back(key);
  }
  list.insert(list.end(), more.begin(), more.end());
}

template <class T>
std::vector<T> around(std::span<const T> before, const std::vector<T>& scene, std::span<const T> behind) {
  std::vector<T> list(before.begin(), before.end());
  list.insert(list.end(), scene.begin(), scene.end());
  list.insert(list.end(), behind.begin(), behind.end());
  return list;
}

KeyTable all_keys() {
  std::vector<Key> keys = around<Key>(keys_before, scene_keys().rows(), keys_behind);
  add_short_forms(keys);
  return {std::move(keys), around<TableInfo>(tables_before, scene_keys().tables(), tables_behind)};
}

}  // namespace

const KeyTable& case_keys() {
  static const KeyTable keys = all_keys();
  return keys;
}

}  // namespace tripoint
