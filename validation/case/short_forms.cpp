// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "tables/nearest.hpp"
#include "validation/case/case_document.hpp"
#include "validation/case/case_keys.hpp"
#include "validation/case/gated_metric.hpp"

/// The short forms of a case file, written out: gates within their metric, limits by level, invariants.
namespace tripoint {
namespace {

using Kind = TomlNode::Kind;

TomlNode text_node(std::string_view text, const SourcePlace& place) {
  TomlNode n;
  n.kind = Kind::text;
  n.text = text;
  n.place = n.key_place = place;
  return n;
}

std::optional<TomlNode> take(TomlNode& table, std::string_view key) {
  const auto at =
      std::find_if(table.members.begin(), table.members.end(), [&](const auto& m) { return m.first == key; });
  if (at == table.members.end()) return {};
  TomlNode value = std::move(at->second);
  table.members.erase(at);
  return value;
}

TomlNode& array_of(TomlNode& document, std::string_view key, const SourcePlace& place) {
  if (auto* there = document.find(key)) return *there;
  TomlNode fresh;
  fresh.kind = Kind::array;
  fresh.place = fresh.key_place = place;
  return document.members.emplace_back(key, std::move(fresh)).second;
}

/// The levels of `limits`, each with its limit. A bare 0.05 is a dotted key to TOML: { 0 = { 05 = ... } }.
void collect_levels(const TomlNode& limits, const std::string& head,
                    std::vector<std::pair<TomlNode, TomlNode>>& levels) {
  for (const auto& [key, value] : limits.members) {
    const std::string name = head.empty() ? key : head + "." + key;
    if (value.kind == Kind::table && head.empty()) {
      collect_levels(value, name, levels);
      continue;
    }
    TomlNode level;
    level.kind = Kind::real;
    level.place = level.key_place = value.key_place;
    const auto end = name.data() + name.size();
    if (const auto read = std::from_chars(name.data(), end, level.real);
        read.ec != std::errc() || read.ptr != end)
      throw InputError(value.key_place, fmt::format("`limits`: `{}` is no number: write {{ LEVEL = LIMIT, "
                                                    "... }}, LEVEL in the unit of the study's axis",
                                                    printable(name)));
    levels.emplace_back(std::move(level), value);
  }
}

/// A gate that has `limits` is one gate a level.
std::vector<TomlNode> by_level(TomlNode gate) {
  const auto limits = gate.kind == Kind::table ? take(gate, "limits") : std::nullopt;
  if (!limits) return {gate};
  if (limits->kind != Kind::table || limits->members.empty())
    throw InputError(limits->place,
                     "`limits`: write { LEVEL = LIMIT, ... }, LEVEL in the unit of the study's axis");
  for (const char* key : {"limit", "at_least", "band", "level"})
    if (const auto* other = gate.find(key))
      throw InputError(
          other->key_place,
          fmt::format("`{}` beside `limits`: each of its levels has a limit already; remove one of them",
                      key));
  std::vector<std::pair<TomlNode, TomlNode>> levels;
  collect_levels(*limits, "", levels);
  std::vector<TomlNode> gates;
  for (auto& [level, limit] : levels) {
    gates.push_back(gate);
    gates.back().members.emplace_back("level", level);
    gates.back().members.emplace_back("limit", limit);
  }
  return gates;
}

/// The metric that a gate within a metric judges: that one, or its order or statistical part.
void name_metric(TomlNode& gate, const std::string& metric, const SourcePlace& place) {
  if (gate.kind != Kind::table)
    throw InputError(
        gate.place,
        fmt::format(
            "a gate of metric \"{}\" must be a table, not {}: write {{ limit = 1e-3, reason = \"...\" }}",
            printable(metric), kind_name(gate.kind)));
  const auto* given = gate.find("metric");
  if (!given) {
    gate.members.insert(gate.members.begin(), {"metric", text_node(metric, place)});
    return;
  }
  if (given->kind != Kind::text || !judges_metric(given->text, metric))
    throw InputError(
        given->place,
        fmt::format("a gate within metric \"{0}\" judges \"{0}\", \"{0}.order\", \"{0}.limit\" or "
                    "\"{0}.statistical\": write one of these, or remove the key",
                    printable(metric)));
}

/// The gates that a metric carries, taken out of it.
std::vector<TomlNode> gates_of(TomlNode& metric) {
  std::vector<TomlNode> list;
  auto gates = take(metric, "gates");
  auto limits = take(metric, "limits");
  auto reason = take(metric, "reason");
  if (!gates && !limits && !reason) return list;
  const auto* name = metric.find("name");
  if (!name || name->kind != Kind::text)
    throw InputError(metric.place, "a metric with gates needs its `name` here: give it");
  if (gates && gates->kind != Kind::array)
    throw InputError(
        gates->place,
        fmt::format(
            "`gates` must be an array of tables, not {}: write [{{ limit = 1e-3, reason = \"...\" }}]",
            kind_name(gates->kind)));
  if (limits.has_value() != reason.has_value())
    throw InputError((limits ? limits : reason)->key_place,
                     limits ? "`limits` of a metric need its key `reason`: write where the numbers come from"
                            : "`reason` of a metric is that of its `limits`, and there are none: give "
                              "`limits`, or write the reason into a gate");
  if (limits) {
    TomlNode gate;
    gate.place = limits->place;
    gate.key_place = limits->key_place;
    gate.members.emplace_back("limits", std::move(*limits));
    gate.members.emplace_back("reason", std::move(*reason));
    name_metric(gate, name->text, gate.place);
    list = by_level(std::move(gate));
  }
  if (!gates) return list;
  for (auto& gate : gates->items) {
    name_metric(gate, name->text, gate.place);
    for (auto& one : by_level(std::move(gate))) list.push_back(std::move(one));
  }
  return list;
}

void append(TomlNode& document, std::vector<TomlNode> gates) {
  if (gates.empty()) return;
  TomlNode& list = array_of(document, "gate", gates.front().place);
  if (list.kind != Kind::array) return;  // the reader says what is wrong with it
  for (auto& gate : gates) list.items.push_back(std::move(gate));
}

/// `ledger = 1e-9` is `ledger = { limit = 1e-9 }`.
void spell_out(TomlNode& document) {
  auto* given = document.find("invariants");
  if (!given) return;
  if (given->kind != Kind::table)
    throw InputError(given->place,
                     "`invariants` is a table: write [invariants] with lines like ledger = 1e-9");
  for (auto& [name, value] : given->members) {
    if (value.kind == Kind::table) continue;
    TomlNode entry;
    entry.place = value.place;
    entry.key_place = value.key_place;
    entry.members.emplace_back("limit", std::move(value));
    value = std::move(entry);
  }
}

const Invariant& invariant_named(const std::string& name, const SourcePlace& place) {
  std::vector<std::string> known;
  for (const auto& one : invariants()) {
    if (one.name == name) return one;
    known.emplace_back(one.name);
  }
  throw InputError(place,
                   fmt::format("no invariant is named `{}`{}", printable(name), suggestion(name, known)));
}

/// { kind = "bound", function = "stated", args = { value = ... } }
TomlNode stated(TomlNode value) {
  const SourcePlace place = value.place;
  TomlNode args, reference;
  args.place = args.key_place = reference.place = reference.key_place = place;
  args.members.emplace_back("value", std::move(value));
  reference.members.emplace_back("kind", text_node("bound", place));
  reference.members.emplace_back("function", text_node("stated", place));
  reference.members.emplace_back("args", std::move(args));
  return reference;
}

void add_reference(TomlNode& metric, std::optional<TomlNode> value, const Invariant& what) {
  if (value && metric.find("reference"))
    throw InputError(value->key_place, "`value` beside `reference`: remove one of them");
  if (value && what.value.empty())
    throw InputError(
        value->key_place,
        fmt::format("`value`: `{}` is compared with the start of the run, not with a value: remove the key",
                    what.name));
  if (metric.find("reference") || what.value.empty()) return;
  if (!value && what.value == "!")
    throw InputError(metric.place,
                     fmt::format("`invariants.{}` lacks the key `value`: {}", what.name, what.meaning));
  if (!value) {
    value.emplace();
    value->kind = Kind::real;
    value->place = value->key_place = metric.place;
    value->real = std::stod(std::string(what.value));
  }
  metric.members.emplace_back("reference", stated(std::move(*value)));
}

/// An entry of `invariants` as a metric with its gates.
TomlNode metric_of(const std::string& name, TomlNode entry) {
  const Invariant& what = invariant_named(name, entry.key_place);
  const SourcePlace place = entry.place;
  const auto metric_keys = case_keys().names("metric"), gate_keys = case_keys().names("gate");
  const auto is_of = [](const auto& keys, const std::string& key) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
  };
  TomlNode metric, gate;
  metric.place = gate.place = place;
  metric.key_place = gate.key_place = entry.key_place;
  auto value = take(entry, "value");
  for (auto& [key, given] : entry.members) {
    const bool of_gate = is_of(gate_keys, key) && key != "metric";
    if (!of_gate && (key == "quantity" || !is_of(metric_keys, key))) {
      auto known = metric_keys;
      known.insert(known.end(), gate_keys.begin(), gate_keys.end());
      std::erase_if(known, [](const auto& k) { return k == "quantity" || k == "metric"; });
      throw InputError(given.key_place, fmt::format("unknown key `{}` in `invariants.{}`{}", printable(key),
                                                    name, suggestion(key, known)));
    }
    (of_gate ? gate : metric).members.emplace_back(key, std::move(given));
  }
  if (!metric.find("name"))
    metric.members.insert(metric.members.begin(), {"name", text_node(what.name, place)});
  metric.members.emplace_back("quantity", text_node(what.quantity, place));
  if (!metric.find("norm")) metric.members.emplace_back("norm", text_node(to_string(what.norm), place));
  add_reference(metric, std::move(value), what);
  auto* gates = metric.find("gates");
  if (gates && !gate.members.empty())
    throw InputError(
        gate.members.front().second.key_place,
        fmt::format("`{}` beside `gates`: write it into one of them", gate.members.front().first));
  if (!gates) {
    TomlNode one;
    one.kind = Kind::array;
    one.place = place;
    one.items.push_back(std::move(gate));
    gates = &metric.members.emplace_back("gates", std::move(one)).second;
  }
  if (gates->kind == Kind::array && !what.reason.empty())
    for (auto& g : gates->items)
      if (g.kind == Kind::table && !g.find("reason"))
        g.members.emplace_back("reason", text_node(what.reason, g.place));
  return metric;
}

/// The first value that a short form stands in; null where the document has none.
const TomlNode* first_short_form(const TomlNode& document) {
  for (const char* key : {"extends", "remove", "invariants"})
    if (const auto* found = document.find(key)) return found;
  for (const char* array : {"metric", "gate"}) {
    const auto* list = document.find(array);
    if (!list) continue;
    for (const auto& item : list->items)
      for (const char* key : {"gates", "limits"})
        if (const auto* found = item.find(key)) return found;
  }
  const auto* metrics = document.find("metric");
  if (!metrics) return nullptr;
  for (const auto& item : metrics->items)
    if (const auto* reason = item.find("reason")) return reason;
  return nullptr;
}

}  // namespace

void write_out_gates(TomlNode& document) {
  spell_out(document);
  if (auto* gates = document.find("gate"); gates && gates->kind == Kind::array) {
    std::vector<TomlNode> all;
    for (auto& gate : gates->items)
      for (auto& one : by_level(std::move(gate))) all.push_back(std::move(one));
    gates->items = std::move(all);
  }
  auto* metrics = document.find("metric");
  if (!metrics || metrics->kind != Kind::array) return;
  std::vector<TomlNode> found;
  for (auto& metric : metrics->items)
    for (auto& gate : gates_of(metric)) found.push_back(std::move(gate));
  append(document, std::move(found));
}

void write_out_invariants(TomlNode& document) {
  auto given = take(document, "invariants");
  if (!given) return;
  for (auto& [name, entry] : given->members) {
    TomlNode metric = metric_of(name, std::move(entry));
    auto gates = gates_of(metric);
    TomlNode& metrics = array_of(document, "metric", given->place);
    if (metrics.kind == Kind::array) metrics.items.push_back(std::move(metric));
    append(document, std::move(gates));
  }
}

bool has_short_forms(const TomlNode& document) { return first_short_form(document) != nullptr; }

void check_written_out(const TomlNode& document) {
  if (const auto* found = first_short_form(document))
    throw InputError(found->place,
                     "that is a short form, and --set changes the whole case, in which it is written out: "
                     "give metric.NAME or "
                     "gate.NUMBER, as `tripoint explain --resolved` prints them");
}

const std::vector<Invariant>& invariants() {
  static const std::vector<Invariant> list{
      {"mass", "mass", Norm::drift, "", "round-off", "no mass is made or lost"},
      {"momentum", "momentum", Norm::drift, "", "round-off", "forces come in pairs that sum to zero"},
      {"angular_momentum", "angular_momentum", Norm::drift, "", "round-off", "forces of pairs turn nothing"},
      {"ledger", "ledger.residual", Norm::drift, "", "round-off",
       "all entries of the ledger of energy sum to zero"},
      {"time_integration", "ledger.time_integration", Norm::drift, "", "",
       "energy that the time step alone makes"},
      {"energy_gain", "energy_gain", Norm::max, "", "", "free bodies only lose kinetic and potential energy"},
      {"overlap", "overlap", Norm::max, "0", "", "depth of a solid in another [spacings], above `value`"},
      {"body_count", "body_count", Norm::final, "!", "",
       "number of solid bodies alive at the end, from `value`"},
      {"toggles", "toggles", Norm::final, "0", "",
       "returns of a particle to a phase that it had left, above `value`"},
  };
  return list;
}

}  // namespace tripoint
