// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tables/text_table.hpp"
#include "validation/publish/releases.hpp"
#include "validation/results/escaped_text.hpp"
#include "validation/results/json_text.hpp"

namespace tripoint {
namespace {

using Json = nlohmann::ordered_json;

Json json(const EngineRow& e) {
  Json metrics = Json::object(), gates = Json::array();
  const auto* base = base_run(e);
  if (base)
    for (const auto& [name, value] : base->metrics)
      metrics[name] = {{"value", json_number(value.value)}, {"order", json_number(observed_order(e, name))}};
  for (const auto& o : e.order)
    if (metrics.contains(o.metric))
      metrics[o.metric].update(
          {{"step", json_numbers(o.step)}, {"error", json_numbers(o.error)}, {"class", o.order.fit_class}});
  for (const auto& g : e.gates)
    gates.push_back({{"metric", g.metric},
                     {"level", json_number(g.level)},
                     {"value", json_number(g.value)},
                     {"verdict", g.verdict},
                     {"why", g.why}});
  return {{"preset", e.preset}, {"status", e.status},
          {"reason", e.reason}, {"metrics", metrics},
          {"gates", gates},     {"cpu_s", base ? Json(base->cost.cpu_s) : Json(nullptr)}};
}

Json json(const ReleaseChange& c) {
  return {{"preset", c.preset},
          {"metric", c.metric},
          {"from", c.from},
          {"to", c.to},
          {"before", json_number(c.before)},
          {"after", json_number(c.after)},
          {"order_before", json_number(c.order_before)},
          {"order_after", json_number(c.order_after)},
          {"ratio", json_number(c.ratio)},
          {"round_off", c.round_off},
          {"worse", c.worse}};
}

std::string cell(const Release& r, const std::string& preset, const std::string& metric) {
  for (const auto& e : r.result.engines) {
    if (e.preset != preset) continue;
    const auto* base = base_run(e);
    if (e.status != Status::ok || !base || !base->metrics.contains(metric))
      return std::string(to_string(e.status));
    const auto* ladder = ladder_in_time(e, metric);
    return fmt::format("{:.3g}", base->metrics.at(metric).value) +
           (ladder && std::isfinite(ladder->order.value)
                ? fmt::format(" ({:.1f} {})", ladder->order.value, ladder->order.fit_class)
                : "");
  }
  return "no such preset";
}

std::string name_of(const Release& r) { return markdown(r.engine.name) + " " + markdown(r.engine.version); }

std::string table_of(const ReleaseTable& t, const MetricChoice& metric) {
  std::string text =
      fmt::format("\n**{}**{}: error at the case's own time step (observed order)\n\n", markdown(metric.name),
                  metric.unit.empty() ? "" : " [" + markdown(metric.unit) + "]");
  std::vector<std::string> presets;
  for (const auto& r : t.releases)
    for (const auto& e : r.result.engines)
      if (std::find(presets.begin(), presets.end(), e.preset) == presets.end()) presets.push_back(e.preset);
  std::vector<Column> columns{{"release"}};
  for (const auto& preset : presets) columns.push_back({markdown(preset)});
  TextTable table(columns);
  for (const auto& r : t.releases) {
    TextTable::Cells cells{name_of(r)};
    for (const auto& preset : presets) cells.push_back(markdown(cell(r, preset, metric.name)));
    table.add(cells);
  }
  return text + table.markdown();
}

std::string change_line(const ReleaseChange& c) {
  std::string text = fmt::format("- {} -> {}, {} {}: {:.3g} -> {:.3g}", markdown(c.from), markdown(c.to),
                                 markdown(c.preset), markdown(c.metric), c.before, c.after);
  if (c.round_off)
    text += c.worse ? ", worse: it was round-off" : ", better: it is round-off";
  else
    text += std::isfinite(c.ratio) ? fmt::format(", {:.3g} times {}", c.ratio, c.worse ? "worse" : "better")
            : c.worse              ? ", worse"
                                   : ", better";
  if (std::abs(c.order_after - c.order_before) > 0.5)
    text += fmt::format("; order {:.1f} -> {:.1f}", c.order_before, c.order_after);
  return text + "\n";
}

/// Results of each release by the case's own gates.
std::string gates_of(const ReleaseTable& t) {
  TextTable table({{"release"}, {"gates of the case that pass"}, {"those that do not"}});
  bool any = false;
  for (const auto& r : t.releases) {
    std::size_t all = 0, good = 0;
    std::string red;
    for (const auto& e : r.result.engines)
      for (const auto& g : e.gates) {
        ++all;
        good += g.verdict == Verdict::pass;
        if (g.verdict != Verdict::pass)
          red += fmt::format("{}{} {}: {}", red.empty() ? "" : "; ", e.preset, g.metric, g.why);
      }
    any = any || all > 0;
    table.add({name_of(r), fmt::format("{} of {}", good, all), markdown(red)});
  }
  return any ? "\n" + table.markdown() : "\nThe case has no gate for this engine.\n";
}

}  // namespace

std::string releases_text(const ReleaseTable& t) {
  Json releases = Json::array(), changes = Json::array(), metrics = Json::array();
  for (const auto& r : t.releases) {
    Json rows = Json::array();
    for (const auto& e : r.result.engines) rows.push_back(json(e));
    releases.push_back({{"engine", r.engine.name},
                        {"version", r.engine.version},
                        {"build", r.engine.build},
                        {"library", r.engine.library_hash},
                        {"rows", rows}});
  }
  for (std::size_t k = 1; k < t.releases.size(); ++k) {
    for (const auto& c : changes_between(t.releases[k - 1], t.releases[k], t.margin))
      changes.push_back(json(c));
  }
  if (!t.releases.empty())
    for (const auto& m : t.releases.front().result.metrics)
      metrics.push_back({{"name", m.name}, {"unit", m.unit}});
  return json_text(Json{{"format", 1},
                        {"case", t.case_id},
                        {"title", t.title},
                        {"command", t.command},
                        {"margin", t.margin},
                        {"metrics", metrics},
                        {"releases", releases},
                        {"changes", changes},
                        {"worse", is_worse(t)},
                        {"line", upgrade_line(t)}},
                   2);
}

std::string releases_markdown(const ReleaseTable& t) {
  std::string text =
      fmt::format("# {}: {}\n\n{}.\n", markdown(t.case_id), markdown(t.title), markdown(upgrade_line(t)));
  if (t.releases.empty()) return text;
  for (const auto& metric : t.releases.front().result.metrics) text += table_of(t, metric);
  text += fmt::format("\nFrom one release to the next, errors that differ by more than {:g} times:\n\n",
                      t.margin);
  std::string changes;
  for (std::size_t k = 1; k < t.releases.size(); ++k)
    for (const auto& c : changes_between(t.releases[k - 1], t.releases[k], t.margin))
      changes += change_line(c);
  text += (changes.empty() ? "- none\n" : changes) + gates_of(t);
  text += fmt::format("\nRun again: {}\n", markdown(t.command));
  return text;
}

}  // namespace tripoint
