// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "scene/key_table.hpp"
#include "scene/read_case.hpp"
#include "scene/units.hpp"

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
    for (const auto& w : split_words(k.words)) text += fmt::format("{}`{}`", first ? "" : " ", w), first = false;
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
  std::string out = fmt::format("## `{}`\n\n{}\n\n| key | value | default, and why | meaning |\n|---|---|---|---|\n", t.written, t.meaning);
  for (const auto* k : keys_of(t.name)) out += fmt::format("| `{}` | {} | {} | {} |\n", k->name, type_cell(*k), default_cell(*k), cell(k->meaning));
  return out + "\n";
}

}  // namespace

std::string case_reference_page() {
  std::string out = fmt::format(
      "# The case file\n\nWritten by `tripoint schema --page` from the table that the reader checks by. TOML, format 1: `cases/<subject>/<case>.toml`. An unknown key, a wrong unit or a number out of range is refused with file, line, "
      "column and the nearest known key.\n\nUnits known by name: {} (with the prefixes n u m c d h k M G where that is usual), combined as `kg/m3`, `W/m/K`, `J/(kg K)`, `m s^-2`.\n\n"
      "On the command line `--set a.b=VALUE` replaces any key: `scene.spacing=0.01`, `body.NAME.velocity=[1,0,0]`, `material.NAME.density=900`, `study.1.levels=[0.1,0.05]`; tables without a name count from 1.\n\n",
      known_units());
  for (const auto& t : table_infos()) {
    out += table_page(t);
    if (t.name == "scene") {
      out += "`modes.TERM` sets one term: `modes.heat = \"paper\"`. TERM: ";
      for (std::size_t i = 0; i < term_count; ++i) out += fmt::format("{}`{}`", i ? " " : "", to_string(static_cast<Term>(i)));
      out += ".\n`kernel` can only say what `mode` says: each term brings the kernel of its form.\n\n";
    }
  }
  return out;
}

}  // namespace tripoint
