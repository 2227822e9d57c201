// SPDX-License-Identifier: BSD-3-Clause
#include "validation/case/case_keys.hpp"

#include <array>
#include <span>

#include "scene/scene_keys.hpp"
#include "validation/case/case_document.hpp"
#include "validation/case/case_records.hpp"

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
     "keys and tables of the extended case that are removed: \"scene.jitter\", \"metric.overlap\" (and its "
     "gates), \"study\""},
    {"", "case", table, "", any, "=", "id from the file's place", "case", "claim and judgement"},
});

constexpr auto tables_of_judgement = std::to_array<Key>({
    {"", "engines", table, "", any, "=", "every engine that can", "engines",
     "engines of this case, one table for each: [engines.NAME]"},
    {"", "reference", table, "", any, "=", "only the invariants are known", "reference",
     "the truth, where it is known"},
    {"", "metric", tables, "", any, "=", "nothing is measured", "metric", "numbers computed from each run"},
    {"", "invariants", table, "", any, "", "nothing but the metrics", "invariants",
     "quantities that every run must keep: a metric and its gate on one line"},
    {"", "study", tables, "", any, "=", "one run an engine", "study", "convergence studies"},
    {"", "gate", tables, "", any, "=", "nothing is judged", "gate", "limits"},
    {"", "input", tables, "", any, "=", "every number counts as exact", "input", "uncertain numbers"},
    {"", "defect", tables, "", any, "=", "none", "defect", "faults that this case must catch"},
    {"", "harmless", tables, "", any, "=", "none", "harmless", "changes that must not change any metric"},
});

constexpr Key harmless_name{"harmless",
                            "name",
                            word,
                            "",
                            any,
                            "!",
                            "",
                            "threads order ulp boost mirror rotation units",
                            "`threads`: 2 instead of 1. `order`: of the particles. `ulp`: of each "
                            "coordinate. `boost`: a velocity added to all. "
                            "`mirror`: in x. `rotation`: x to y to z to x. `units`: powers of 2"};

constexpr auto tables_before = std::to_array<TableInfo>({
    {"", "(top)", "The file. Numbers are SI, or texts with a unit: \"3 mm\", \"1.2 g/cm3\", \"20 degC\"."},
    {"case", "[case]", "The claim of the case, and its judgement."},
});
constexpr auto tables_behind = std::to_array<TableInfo>({
    {"engines", "[engines.NAME]",
     "Each engine and preset is one row of the results. Settings of [engines.all] go to every engine: "
     "`friction` (Coulomb's "
     "coefficient) and `restitution` of every pair of bodies. An engine's own settings go before them."},
    {"reference", "[reference]", "The truth that metrics are compared with."},
    {"metric", "[[metric]]", "A number computed from each run."},
    {"gates", "[[metric]] gates = [{...}]",
     "A gate within its metric, with the keys of [[gate]]. `metric` only says NAME.order, NAME.limit or "
     "NAME.statistical."},
    {"invariants", "[invariants]",
     "Quantities that a run must keep, each by its name: `ledger = 1e-9`, or a table."},
    {"invariant", "[invariants.NAME]",
     "A quantity that a run must keep. It has the keys of [[metric]], without quantity and limits, and those "
     "of [[gate]]. reason "
     "is required where the limit is not round-off."},
    {"study", "[[study]]", "Runs at several levels of one axis: a convergence study."},
    {"gate", "[[gate]]", "A limit that decides between pass and fail."},
    {"input", "[[input]]",
     "An uncertain number. The run is repeated with the number at both ends; half the difference of a metric "
     "is its input "
     "uncertainty."},
    {"defect", "[[defect]]", "A fault that this case must catch."},
    {"harmless", "[[harmless]]",
     "An invariance test: a change without physical effect. `tripoint gate selftest` runs the changed scene; "
     "no verdict or "
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

void add_rows(std::vector<Key>& list, const auto&... records) {
  const auto one = [&](const auto&... entries) { (list.push_back(row_of(entries)), ...); };
  (std::apply(one, records), ...);
}

/// Behind the scene's keys.
std::vector<Key> keys_behind() {
  std::vector<Key> list(tables_of_judgement.begin(), tables_of_judgement.end());
  add_rows(list, record<Case>, record<EngineChoice>, record<ReferenceChoice>, record<MetricChoice>,
           record<Study>, record<Gate>, record<UncertainInput>, record<Defect>);
  list.push_back(harmless_name);
  return list;
}

template <class T>
std::vector<T> around(std::span<const T> before, const std::vector<T>& scene, std::span<const T> behind) {
  std::vector<T> list(before.begin(), before.end());
  list.insert(list.end(), scene.begin(), scene.end());
  list.insert(list.end(), behind.begin(), behind.end());
  return list;
}

KeyTable all_keys() {
  std::vector<Key> keys = around<Key>(keys_before, scene_keys().rows(), keys_behind());
  add_short_forms(keys);
  return {std::move(keys), around<TableInfo>(tables_before, scene_keys().tables(), tables_behind)};
}

}  // namespace

const KeyTable& case_keys() {
  static const KeyTable keys = all_keys();
  return keys;
}

}  // namespace tripoint
