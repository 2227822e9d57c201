// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene/effect_rule.hpp"
#include "scene/model.hpp"
#include "scene/scene.hpp"
#include "tables/text_table.hpp"
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

std::string code(std::string_view name) { return fmt::format("`{}`", name); }

/// The range of a number in the signs of mathematics.
std::string_view range_signs(Range range) {
  constexpr std::array signs{"", "> 0", ">= 0", "0 to 1", "-1 to 0.5", "> 1"};
  return signs.at(static_cast<std::size_t>(range));
}

std::string type_words(const Key& k) {
  std::string text(k.type == ValueType::tables && k.words.empty() ? "three rows of three numbers"
                                                                  : type_text(k.type));
  if (!k.unit.empty()) text += fmt::format(", {}", k.unit);
  if (k.range != Range::any) text += fmt::format(", {}", range_signs(k.range));
  if (k.required()) text += ", **required**";
  if (k.words.empty() || (k.type != ValueType::word && k.type != ValueType::words)) return text;
  return fmt::format("{}: `{}`", text, fmt::join(split_words(k.words), "` `"));
}

/// None of a term that follows scene.mode: the lines above its list say it of all.
std::string default_words(const Key& k) {
  if (k.required() || k.note == "as scene.mode says") return "";
  if (k.fallback.empty()) return fmt::format(" Not set: {}.", k.note);
  if (k.fallback == "=") return fmt::format(" Default: {}.", k.note);
  return fmt::format(" Default `{}`: {}.", k.fallback, k.note);
}

/// As a sentence begins, but for a symbol or a word of the file.
std::string begun(std::string_view meaning) {
  std::string text(meaning);
  const auto end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz");
  if (end != std::string::npos && end > 1 && (text[end] == ' ' || text[end] == ','))
    text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

/// Keys that are not printed: tables of the file, which have a part of their own; names and keys that another
/// part lists.
bool is_elsewhere(const Key& k) {
  if (k.old) return true;
  if (k.table.empty()) return k.type == ValueType::table || k.type == ValueType::tables;
  return k.table == "invariants" || k.table == "gates" || (k.table == "invariant" && k.name != "value");
}

std::string table_page(const TableInfo& t) {
  std::string out = fmt::format("## `{}`\n\n{}\n\n", t.written, t.meaning), rows;
  for (const auto* k : case_keys().of(t.name))
    if (!is_elsewhere(*k))
      rows +=
          fmt::format("- `{}`: {}. {}.{}\n", k->name, type_words(*k), begun(k->meaning), default_words(*k));
  return out + (rows.empty() ? "" : rows + "\n");
}

constexpr std::string_view short_forms = R"(## A case that says less

**`extends`.** A variant of a case names the other case at its top and says only what differs:

```toml
extends = "tower-10.toml"
remove = ["metric.top", "study"]

[case]
title = "A tower of four"

[scene]
end_time = "2 s"
```

- The name is a file of the same folder, a path below the folder `cases`
  (`"../heat/cosine-mode.toml"`), or the name of a case (`"heat/cosine-mode"`). A chain has at most
  8 files.
- Tables are merged key by key. A table that gives `kind` or `function` anew (a shape, a velocity, a
  reference) replaces the old one. `id` is not handed on.
- Tables of an array are merged by `name`, or `[[input]]` by `key`. `[[gate]]` goes by `metric`,
  `engine`, `mode`, `preset` and `level`, `[[study]]` by `axis`, `engine`, `mode` and `metric`.
  Others are added at the end.
- `[[event]]`, `[[inflow]]` and other arrays without names replace all of the other case's.
- A gate that gives `limit`, `at_least` or `band` replaces any bound of the gate that it meets.
- `remove` first takes out keys and tables: `"scene.jitter"`, `"engines.lammps"`,
  `"body.lid.velocity"`, `"metric.overlap"` with its gates, `"gate.overlap"`, or all of a kind:
  `"study"`, `"gate"`, `"metric"`.
- Data and meshes of the other case are found beside that case. Errors and gates name the file and
  line where the key stands. A gate added to the other case later holds in its variants too.

**Gates within their metric.** `gates` of a `[[metric]]` holds its gates, one a line, without the
key `metric`. `limits` is one limit a level of a study. The last gate below judges the metric's
order.

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

**Invariants.** `[invariants]` names quantities that each run must keep; each line is a metric and
its gate. A plain number is the limit of every engine.

```toml
[invariants]
ledger = 1e-11
momentum = { scale = 12.5, unit = "of that of the fall", engine = "tripoint", limit = 1e-13 }
body_count = { value = 2, limit = 0, reason = "nothing breaks" }
```

`tripoint explain CASE --resolved` prints the whole case, with nothing extended and every gate in a
table of its own. `--set` uses the names printed there.

)";

/// Table of the names of [invariants].
std::string invariants_page() {
  TextTable table({{"name"}, {"quantity"}, {"norm"}, {"meaning"}});
  for (const Invariant& one : invariants())
    table.add({code(one.name), code(one.quantity), code(to_string(one.norm)), cell(one.meaning)});
  return table.markdown() + "\n";
}

/// Table of the terms that the ledger can have.
std::string ledger_page() {
  TextTable table({{"TERM"}, {"holds"}});
  for (const LedgerEntry& one : ledger_entries()) table.add({code(one.name), cell(one.holds)});
  return "Terms of the ledger of energy, of `ledger.TERM` and of `/observables/energy_TERM` in "
         "`trajectory.h5`:\n\n" +
         table.markdown() + "\n";
}

/// What keys of [scene] of old files are now.
std::string old_keys_page() {
  std::string out =
      "`kernel` can only say what `scene.mode` says: each term brings the kernel of its form.\n\n"
      "**Old keys of `[scene]`** act as they did, and a note says the word to write. They are now:\n\n"
      "- `modes.TERM`: the word of TERM\n";
  for (const Key* k : case_keys().of("scene")) {
    if (!k->old || k->name == "modes") continue;
    const ModelTerm* t = term_of_old_key(k->name);
    out += fmt::format("- `{}`: {}\n", k->name, t ? code(t->name) : "no word");
  }
  return out + "\n";
}

}  // namespace

std::string case_reference_page() {
  std::string out = fmt::format(
      "# The case file\n\nWritten by `tripoint schema --page` from the table that the reader checks by. "
      "TOML, format 1: "
      "`cases/<subject>/<case>.toml`. The reader refuses an unknown key, a wrong unit or a number out of "
      "range with file, line, "
      "column and the nearest known key.\n\nUnits: `{}`. Prefixes: n u m c d h k M G. "
      "They combine as `kg/m3`, `W/m/K`, `J/(kg K)` and `m s^-2`.\n\n"
      "`run`, `check`, `explain` and `predict` take `--set a.b=VALUE` for any key: `scene.spacing=0.01`, "
      "`body.NAME.velocity=[1,0,0]`, `study.1.levels=[0.1,0.05]`. Tables without a name count from 1.\n\n"
      "Each key has its type, unit, range, meaning and default. `[scene]` and `[[body]]` are required; other "
      "tables may be left "
      "out.\n\n",
      known_units());
  out += short_forms;
  for (const auto& t : case_keys().tables()) {
    out += table_page(t);
    if (t.name == "invariants") out += invariants_page() + ledger_page();
    if (t.name == "model") out += old_keys_page();
  }
  return out;
}

}  // namespace tripoint
