// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "scene/effect_rule.hpp"
#include "scene/scene.hpp"
#include "tables/units.hpp"
#include "validation/case/case_document.hpp"
#include "validation/case/case_keys.hpp"
#include "validation/case/schema.hpp"

/// The reference page of the case file in Markdown, from the key table.
namespace tripoint {
namespace {

std::string cell(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

std::string type_cell(const Key& k) {
  std::string text(k.type == ValueType::tables && k.words.empty() ? "three rows of three numbers" : type_text(k.type));
  if (!k.unit.empty()) text += fmt::format(", {}", k.unit);
  if (k.range != Range::any) text += fmt::format(", {}", range_text(k.range));
  if (!k.words.empty() && (k.type == ValueType::word || k.type == ValueType::words)) {
    text += ": ";
    bool first = true;
    for (const auto& w : split_words(k.words)) {
      text += fmt::format("{}`{}`", first ? "" : " ", w);
      first = false;
    }
  }
  return cell(text);
}

std::string default_cell(const Key& k) {
  if (k.required()) return "**required**";
  if (k.fallback.empty()) return cell(fmt::format("not set: {}", k.note));
  if (k.fallback == "=") return cell(k.note);
  return cell(fmt::format("`{}`: {}", k.fallback, k.note));
}

std::string table_page(const TableInfo& t) {
  std::string out =
      fmt::format("## `{}`\n\n{}\n\n| key | value | default, and why | meaning |\n|---|---|---|---|\n", t.written, t.meaning);
  for (const auto* k : case_keys().of(t.name))
    out += fmt::format("| `{}` | {} | {} | {} |\n", k->name, type_cell(*k), default_cell(*k), cell(k->meaning));
  return out + "\n";
}

constexpr std::string_view short_forms = R"(## A case that says less

**`extends`.** A variant of a case names it at its top and says only what differs:

```toml
extends = "tower-10.toml"
remove = ["metric.top", "study"]

[case]
title = "A tower of four"

[scene]
end_time = "2 s"
```

- The name is that of a file in the same folder (`"tower-10.toml"`), a path that ends below the folder `cases` around the file (`"../heat/cosine-mode.toml"`), or the name of a case there or of a shipped one (`"heat/cosine-mode"`). No other file is read. The other case may extend a third; at most 8 files are in such a chain, and none is in it twice.
- Tables are merged key by key: `[scene]`, `[case]`, `[reference]`, `[engines.NAME]`, `[invariants]`. A table that gives `kind` or `function` anew (a shape, a velocity, a reference) replaces the whole of the old one. `[case]` is merged all the same, and `id` is not handed on.
- Tables of an array are merged key by key with the one that has the same name: `[[material]]`, `[[body]]`, `[[metric]]`, `[[defect]]` and `[[harmless]]` by `name`; `[[input]]` by `key`; `[[gate]]` by `metric`, `engine`, `mode`, `preset` and `level`; `[[study]]` by `axis`, `engine`, `mode` and `metric`. One that meets none comes after those of the other case. Bodies keep the other case's order.
- `[[event]]`, `[[inflow]]` and every other array have no name to go by: the file's own replace all of the other case's.
- A gate that gives `limit`, `at_least` or `band` replaces the bound of the gate that it meets, of whatever kind that was.
- `remove` takes keys and tables out of the other case first: `"scene.jitter"`, `"engines.lammps"`, `"body.lid"`, `"body.lid.velocity"`, `"metric.overlap"` and the gates on it, `"gate.overlap"` (all gates on that metric), or all of a kind: `"study"`, `"gate"`, `"metric"` with all gates.
- Data and meshes that the other case names are found beside that case. Errors and gates name the file and the line where the key stands.
- What is added to the other case later, a gate too, holds in its variants: run them as well.

**Gates within their metric.** `gates` of a `[[metric]]` holds its gates, one a line, without the key `metric`; `limits` is one limit a level of a study. The last gate below judges the metric's order.

```toml
[[metric]]
name = "front"
quantity = "front_ratio"
limits = { 1e-3 = 0.05, 5e-4 = 0.025 }
reason = "first order in the spacing"
gates = [
  { engine = "tripoint", mode = "paper", band = [0.2, 0.4], reason = "predicted defect: 0.3 measured" },
  { metric = "front.order", engine = "tripoint", at_least = 0.9, reason = "first order" },
]
```

**Invariants.** `[invariants]` names what each run must keep; each line is a metric and its gate. A plain number is the limit of every engine.

```toml
[invariants]
ledger = 1e-11
momentum = { scale = 12.5, unit = "of that of the fall", engine = "tripoint", limit = 1e-13 }
body_count = { value = 2, limit = 0, reason = "nothing breaks" }
```

`tripoint explain CASE --resolved` prints the whole case, with nothing extended and every gate in a table of its own. `--set` names keys as they are there.

)";

/// Table of the names of [invariants].
std::string invariants_page() {
  std::string out = "| name | quantity | norm | meaning |\n|---|---|---|---|\n";
  for (const Invariant& one : invariants())
    out += fmt::format("| `{}` | `{}` | `{}` | {} |\n", one.name, one.quantity, one.norm, cell(one.meaning));
  return out + "\n";
}

/// Table of the terms that the ledger can have.
std::string ledger_page() {
  std::string out =
      "Terms of the ledger of energy, of `ledger.TERM` and of `/observables/energy_TERM` in `trajectory.h5`:\n\n| TERM | holds "
      "|\n|---|---|\n";
  for (const LedgerEntry& one : ledger_entries()) out += fmt::format("| `{}` | {} |\n", one.name, cell(one.holds));
  return out + "\n";
}

}  // namespace

std::string case_reference_page() {
  std::string out = fmt::format(
      "# The case file\n\nWritten by `tripoint schema --page` from the table that the reader checks by. TOML, format 1: "
      "`cases/<subject>/<case>.toml`. An unknown key, a wrong unit or a number out of range is refused with file, line, "
      "column and the nearest known key.\n\nUnits known by name: {} (with the prefixes n u m c d h k M G where that is usual), "
      "combined as `kg/m3`, `W/m/K`, `J/(kg K)`, `m s^-2`.\n\n"
      "`run`, `check`, `explain` and `predict` take `--set a.b=VALUE`, which replaces any key: `scene.spacing=0.01`, "
      "`body.NAME.velocity=[1,0,0]`, "
      "`material.NAME.density=900`, `study.1.levels=[0.1,0.05]`; tables without a name count from 1.\n\n",
      known_units());
  out += short_forms;
  for (const auto& t : case_keys().tables()) {
    out += table_page(t);
    if (t.name == "invariants") out += invariants_page() + ledger_page();
    if (t.name == "scene") {
      out += "`modes.TERM` sets one term: `modes.heat = \"paper\"`. TERM: ";
      for (const char* between = ""; const DeclaredTerm& one : declared_terms()) {
        out += fmt::format("{}`{}`", between, one.term.name);
        between = " ";
      }
      out += ".\n`kernel` can only say what `mode` says: each term brings the kernel of its form.\n\n";
    }
  }
  return out;
}

}  // namespace tripoint
