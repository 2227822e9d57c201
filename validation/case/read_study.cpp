// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "scene/value_reader.hpp"
#include "tables/expression.hpp"
#include "tables/nearest.hpp"
#include "validation/case/case_records.hpp"
#include "validation/case/dates.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/case/gated_metric.hpp"
#include "validation/case/judge_readers.hpp"

/// How a case is judged: engines, reference, metrics, studies, gates, defects.
namespace tripoint {

EngineChoice read_engine(const TomlNode& node, const std::string& name, Reading& reading) {
  TableReader in = case_table(node, "engines", "engines." + printable(name), reading);
  plain_name(in, "", name);
  EngineChoice e;
  e.name = name;
  RecordReader(in, e, reading).each({"required", "adopted", "preset", "settings"});
  // Ours is required where a case says nothing else
  if (is_own_solver(name) && !in.has("required")) e.required = true;
  if (const auto refuses = in.maybe_text("refuses")) {
    if (refuses->empty()) in.refuse("refuses", "write words of the engine's own reason");
    if (e.required)
      in.refuse("refuses",
                "an engine that the case requires cannot be expected to refuse it: write required = false");
    e.settings["refuses"] = *refuses;  // stays with the harness, as wall_limit does
  }
  if (const auto limit = e.settings.find("wall_limit"); limit != e.settings.end()) {
    const auto* seconds = std::get_if<double>(&limit->second);
    if (!seconds || !(*seconds > 0.0))
      in.refuse("settings",
                "wall_limit must be a number of seconds above 0: a run that takes longer is stopped");
  }
  return e;
}

/// The texts of an expression, but for those that are words.
static void check_formulas(const TableReader& in, const Settings& args) {
  for (const auto& [name, value] : args) {
    const auto* text = std::get_if<std::string>(&value);
    if (!text || name == "axis" || name == "phase" || name == "other") continue;
    try {
      static_cast<void>(Expression(*text, Expression::Time::known));
    } catch (const InputError& e) {
      in.refuse("args", fmt::format("`{}`: {}", printable(name), e.what()));
    }
  }
}

ReferenceChoice read_reference(const TomlNode& node, const std::string& path, Reading& reading) {
  TableReader in = case_table(node, "reference", path, reading);
  ReferenceChoice r;
  RecordReader read(in, r, reading);
  read.each({"kind", "function"});
  const bool formula = r.kind == ReferenceKind::analytic || r.kind == ReferenceKind::discrete_exact ||
                       r.kind == ReferenceKind::mms;
  if (formula && r.function.empty())
    in.refuse(in.has("function") ? "function" : "kind",
              fmt::format("a reference of kind \"{}\" needs the key `function`: the exact solution's name",
                          r.kind));
  read("args");
  if (r.function == "expression") check_formulas(in, r.args);
  read("file");
  if (r.kind == ReferenceKind::experiment && r.file.empty())
    in.refuse("kind", "a reference of kind \"experiment\" needs the key `file`: the data beside the case");
  if (r.function == "table" && r.file.empty())
    in.refuse("function", "a reference by `table` needs the key `file`: the table beside the case");
  if (!r.file.empty() && r.kind != ReferenceKind::experiment && r.function != "table")
    in.refuse("file",
              "data are read by kind = \"experiment\" and by function = \"table\": write one of them, or "
              "remove the file");
  if (!r.file.empty()) {
    const auto full = std::filesystem::path(reading.folder) / r.file;
    std::error_code error;
    if (!std::filesystem::is_regular_file(full, error))
      in.refuse("file", fmt::format("no file `{}` beside the case", printable(r.file)));
    r.file = std::filesystem::absolute(full).lexically_normal().string();
  }
  read.each({"source", "uncertainty"});
  return r;
}

MetricChoice read_metric(const TomlNode& node, Reading& reading) {
  TableReader in = case_table(node, "metric", "metric." + entry_name(node, 1), reading);
  MetricChoice m;
  m.place = node.place;
  RecordReader read(in, m, reading);
  read("name");
  plain_name(in, "name", m.name);
  read.each({"quantity", "norm", "body", "at"});
  const auto window = in.numbers("window");
  if (window.size() != 2 || (in.has("window") && !(window[1] > window[0] && window[0] >= 0.0)))
    in.refuse("window", "write [from, to] in s, 0 <= from < to");
  m.window = {window[0], window[1]};
  read.each({"scale", "unit"});
  if (const auto* r = in.composite("reference"))
    m.reference = read_reference(*r, in.path() + ".reference", reading);
  return m;
}

JudgedMode read_mode(TableReader& in) {
  const auto word = in.text("mode");
  if (const auto mode = find_word<JudgedMode>(word)) return *mode;
  in.refuse("mode",
            fmt::format("unknown mode \"{}\": write corrected, paper or \"not paper\"", printable(word)));
}

/// Values that are refined together with the levels of a study: one positive number for each level.
std::vector<double> read_together(TableReader& in, std::string_view key, const Study& study) {
  const auto values = in.maybe_numbers(key);
  if (!values) return {};
  if (values->size() != study.levels.size() ||
      std::any_of(values->begin(), values->end(), [](double v) { return !(v > 0.0); }))
    in.refuse(key,
              fmt::format("write one number greater than 0 for each of the {} levels", study.levels.size()));
  if (const Axis axis = study.axes.axis; key.starts_with(to_string(axis)))
    in.refuse(key, fmt::format("{} is the axis of this study already", axis));
  return *values;
}

Study read_study(const TomlNode& node, std::size_t number, double end_time, Reading& reading) {
  TableReader in = case_table(node, "study", fmt::format("study.{}", number), reading);
  Study s;
  s.place = node.place;
  const auto axis = from_word<Axis>(in.text("axis"));
  s.axes.axis = axis;
  s.levels = in.numbers_in(axis == Axis::spacing ? "m" : axis == Axis::time_step ? "s" : "", "levels");
  if (s.levels.size() < 2)
    in.refuse("levels", "a study has at least two levels, and at least three for an order with its interval");
  const bool upward = refines_upward(axis);
  for (std::size_t i = 0; i < s.levels.size(); ++i) {
    if (!(s.levels[i] > 0.0))
      in.refuse("levels", fmt::format("level {} is {}: write numbers greater than 0, in the axis's own unit",
                                      i + 1, s.levels[i]));
    if (i > 0 && (upward ? s.levels[i] <= s.levels[i - 1] : s.levels[i] >= s.levels[i - 1]))
      in.refuse("levels", fmt::format("write the levels from coarse to fine: for {} that is {}", axis,
                                      upward ? "rising" : "falling"));
  }
  constexpr std::size_t most_levels = 100;
  if (s.levels.size() > most_levels)
    in.refuse("levels", fmt::format("{} levels: write at most {}", s.levels.size(), most_levels));
  if (axis == Axis::time_step && end_time > most_steps * s.levels.back())
    in.refuse("levels",
              fmt::format("{} s would need {:.3g} steps to end_time = {} s: at most {:.0e} can be made",
                          s.levels.back(), end_time / s.levels.back(), end_time, most_steps));
  s.support_ratios = read_together(in, "support_ratios", s);
  s.time_steps = read_together(in, "time_steps", s);
  s.axes.support_ratio = !s.support_ratios.empty();
  s.axes.time_step = !s.time_steps.empty();
  RecordReader read(in, s, reading);
  read("jitter");
  constexpr long most_seeds = 1000;
  const long seeds = in.integer("seeds");
  if (seeds > most_seeds)
    in.refuse("seeds", fmt::format("{} runs for each level are more than the {} that can be planned", seeds,
                                   most_seeds));
  s.seeds = static_cast<int>(seeds);
  read("engine");
  s.mode = read_mode(in);
  read.each({"order", "metric"});
  if (const auto word = in.text("expect"); !word.empty()) s.expect = from_word<FitClass>(word);
  return s;
}

Gate read_gate(const TomlNode& node, std::size_t number, Reading& reading) {
  TableReader in = case_table(node, "gate", fmt::format("gate.{}", number), reading);
  Gate g;
  g.place = node.place;
  RecordReader read(in, g, reading);
  read.each({"metric", "engine"});
  g.mode = read_mode(in);
  read.each({"preset", "limit", "at_least"});
  if (const auto band = in.maybe_numbers("band")) {
    if (band->size() != 2 || !((*band)[0] <= (*band)[1]))
      in.refuse("band", "write [low, high] with low <= high");
    g.band = std::array<double, 2>{(*band)[0], (*band)[1]};
  }
  if (const auto word = in.text("expect"); !word.empty()) g.expect = from_word<FitClass>(word);
  if (g.expect && !is_order(g.metric))
    in.refuse("expect", "a class of convergence is that of NAME.order: judge that, or remove the key");
  if (!g.limit && !g.at_least && !g.band && !g.expect)
    in.refuse("", fmt::format(
                      "the gate on \"{}\" has no limit and would pass anything: give limit, at_least or band",
                      printable(g.metric)));
  g.place = in.place(g.limit      ? "limit"
                     : g.at_least ? "at_least"
                     : g.band     ? "band"
                                  : "expect");  // the line that a red gate points at
  read.each({"level", "drift", "reason"});
  if (g.reason.find_first_not_of(" \t\n") == std::string::npos)
    in.refuse("reason", "a limit needs a reason: say where the number comes from");
  read.each({"by", "date"});
  if (!g.date.empty() && !is_date(g.date))
    in.refuse("date", "write a day that has been, as 2026-11-29, or no date");
  return g;
}

UncertainInput read_input(const TomlNode& node, std::size_t number, Reading& reading) {
  TableReader in = case_table(node, "input", fmt::format("input.{}", number), reading);
  UncertainInput u;
  u.place = node.place;
  RecordReader(in, u, reading).each({"key", "low", "high"});
  if (u.key.find('.') == std::string::npos || u.key.find('=') != std::string::npos)
    in.refuse("key", "write a key as --set takes it: model.viscosity, material.water.viscosity");
  if (u.low == u.high) in.refuse("high", "low and high are the same: that is an exact input");
  return u;
}

Defect read_defect(const TomlNode& node, std::size_t number, Reading& reading) {
  TableReader in = case_table(node, "defect", fmt::format("defect.{}", number), reading);
  Defect d;
  d.place = node.place;
  RecordReader(in, d, reading).each({"name", "size", "smallest", "killed_by"});
  return d;
}

}  // namespace tripoint
