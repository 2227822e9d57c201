// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/nesting.hpp"
#include "core/whole_number.hpp"
#include "io/foreign_file.hpp"
#include "validation/harness/results.hpp"

namespace tripoint {
namespace {

using Json = nlohmann::json;
constexpr std::uintmax_t largest_file = 512u << 20;

const Json& member(const Json& from, const char* key) {
  static const Json nothing;
  if (!from.is_object()) return nothing;
  const auto at = from.find(key);
  return at == from.end() ? nothing : *at;
}

std::string text(const Json& from, const char* key) {
  const auto& v = member(from, key);
  return v.is_string() ? v.get<std::string>() : std::string();
}

/// What is no number is no value: NaN, which never passes.
double number(const Json& v) { return v.is_number() ? v.get<double>() : not_a_number; }
double number(const Json& from, const char* key) { return number(member(from, key)); }
double number_or(const Json& from, const char* key, double otherwise) {
  const auto& v = member(from, key);
  return v.is_number() ? v.get<double>() : otherwise;
}

std::optional<double> optional_number(const Json& from, const char* key) {
  const auto& v = member(from, key);
  if (!v.is_number()) return {};
  return v.get<double>();
}

bool flag(const Json& from, const char* key, bool otherwise) {
  const auto& v = member(from, key);
  return v.is_boolean() ? v.get<bool>() : otherwise;
}

std::vector<double> numbers(const Json& from, const char* key) {
  std::vector<double> list;
  if (const auto& v = member(from, key); v.is_array())
    for (const auto& x : v) list.push_back(number(x));
  return list;
}

std::vector<std::string> strings(const Json& from, const char* key) {
  std::vector<std::string> list;
  if (const auto& v = member(from, key); v.is_array())
    for (const auto& x : v)
      if (x.is_string()) list.push_back(x.get<std::string>());
  return list;
}

template <class T, class Read>
std::vector<T> rows(const Json& from, const char* key, Read read) {
  std::vector<T> list;
  if (const auto& v = member(from, key); v.is_array())
    for (const auto& x : v) list.push_back(read(x));
  return list;
}

SourcePlace place(const Json& from) { return {text(from, "file"), whole_number<int>(number_or(from, "line", 0.0)), 0}; }

MetricValue metric_value(const Json& from) {
  MetricValue m;
  m.value = flag(from, "finite", true) ? number(from, "value") : not_a_number;
  const auto& u = member(from, "uncertainty");
  const auto part = [&](const char* key) {  // absent = none was stated; null = it was not finite
    return u.is_object() && u.contains(key) ? number(u, key) : 0.0;
  };
  m.uncertainty = {part("numerical"), part("statistical"), part("input"), part("data")};
  m.note = text(from, "note");
  m.times = numbers(from, "times");
  m.series = numbers(from, "series");
  return m;
}

Knobs knobs(const Json& from) {
  Knobs k;
  k.spacing = number_or(from, "spacing", 0.0), k.time_step = number_or(from, "time_step", 0.0),
  k.support_ratio = number_or(from, "support_ratio", 0.0);
  k.walkers = optional_number(from, "walkers"), k.iterations = optional_number(from, "iterations");
  k.mode = text(from, "mode"), k.threads = whole_number<int>(number_or(from, "threads", 1.0));
  k.seed = whole_number<std::uint64_t>(number_or(from, "seed", 1.0)), k.jitter = number_or(from, "jitter", 0.0);
  return k;
}

Cost cost(const Json& from) {
  return {number_or(from, "cpu_s", 0.0),        number_or(from, "wall_s", 0.0),          number_or(from, "setup_cpu_s", 0.0),
          number_or(from, "peak_bytes", 0.0),   number_or(from, "pairs", 0.0),           number_or(from, "steps", 0.0),
          number_or(from, "iterations", 0.0),   number_or(from, "simulated_s", 0.0),     number_or(from, "particles", 0.0),
          number_or(from, "instructions", 0.0), numbers(member(from, "timed"), "cpu_s"), text(from, "counted_by")};
}

RunRow run_row(const Json& from) {
  RunRow r;
  r.knobs = knobs(member(from, "knobs"));
  r.base = flag(from, "base", false), r.group = text(from, "group"), r.input = text(from, "input");
  r.status = text(from, "status"), r.reason = text(from, "reason"), r.comparable = flag(from, "comparable", true);
  if (r.status.empty()) r.status = "error", r.reason = "the results give no status";
  if (const auto& levels = member(from, "levels"); levels.is_object())
    for (const auto& [axis, level] : levels.items()) r.levels[axis] = number(level);
  if (const auto& metrics = member(from, "metrics"); metrics.is_object())
    for (const auto& [name, value] : metrics.items()) r.metrics[name] = metric_value(value);
  r.cost = cost(member(from, "cost"));
  r.state_hash = text(from, "state_hash"), r.time_step_bound = text(from, "time_step_bound"), r.folder = text(from, "folder");
  return r;
}

Gate gate(const Json& from) {
  Gate g;
  g.metric = text(from, "metric"), g.engine = text(from, "engine"), g.mode = text(from, "mode"), g.preset = text(from, "preset");
  g.limit = optional_number(from, "limit"), g.at_least = optional_number(from, "at_least"),
  g.level = optional_number(from, "level"), g.drift = optional_number(from, "drift");
  if (const auto band = numbers(from, "band"); band.size() == 2) g.band = {band[0], band[1]};
  g.reason = text(from, "reason"), g.by = text(from, "by"), g.date = text(from, "date"), g.place = place(from);
  return g;
}

EngineRow engine_row(const Json& from) {
  EngineRow e;
  e.name = text(from, "name"), e.version = text(from, "version"), e.preset = text(from, "preset");
  e.library_path = text(member(from, "library"), "path"), e.library_hash = text(member(from, "library"), "hash");
  e.required = flag(from, "required", false), e.refuses = text(from, "refuses");
  e.status = text(from, "status"), e.reason = text(from, "reason");
  if (e.status.empty()) e.status = "error", e.reason = "the results give no status";
  e.runs = rows<RunRow>(from, "runs", run_row);
  return e;
}

Setting setting(const Json& v) {
  if (v.is_boolean()) return v.get<bool>();
  if (v.is_number()) return v.get<double>();
  if (v.is_array()) {
    std::vector<double> list;
    for (const auto& x : v) list.push_back(number(x));
    return list;
  }
  return v.is_string() ? v.get<std::string>() : v.dump();
}

ReferenceChoice reference(const Json& from) {
  ReferenceChoice r;
  r.kind = text(from, "kind"), r.function = text(from, "function"), r.file = text(from, "file"), r.source = text(from, "source");
  r.uncertainty = number_or(from, "uncertainty", 0.0);
  if (const auto& args = member(from, "args"); args.is_object())
    for (const auto& [key, value] : args.items()) r.args[key] = setting(value);
  return r;
}

MetricChoice metric_choice(const Json& from) {
  MetricChoice m;
  m.name = text(from, "name"), m.quantity = text(from, "quantity"), m.norm = text(from, "norm"), m.body = text(from, "body"),
  m.at = text(from, "at");
  m.scale = number_or(from, "scale", 1.0), m.unit = text(from, "unit");
  if (const auto window = numbers(from, "window"); window.size() == 2) m.window = {window[0], window[1]};
  return m;
}

Study study(const Json& from) {
  Study s;
  s.axis = text(from, "axis"), s.levels = numbers(from, "levels"), s.jitter = number_or(from, "jitter", 0.0);
  s.seeds = whole_number<int>(number_or(from, "seeds", 1.0)), s.engine = text(from, "engine"), s.mode = text(from, "mode");
  s.expect = text(from, "expect"), s.order = optional_number(from, "order"), s.metric = text(from, "metric"),
  s.place = place(from);
  return s;
}

EquivalenceRow equivalence_row(const Json& from) {
  return {text(from, "a"),
          text(from, "b"),
          text(from, "metric"),
          number(from, "difference"),
          number(from, "uncertainty"),
          optional_number(from, "margin"),
          number(from, "error_a"),
          number(from, "error_b"),
          text(from, "verdict")};
}

CaseResult case_result(const Json& from) {
  CaseResult c;
  c.id = text(from, "id"), c.title = text(from, "title"), c.kind = text(from, "kind"), c.requirement = text(from, "requirement");
  c.claims = text(from, "claims"), c.file = text(from, "file"), c.repeat = text(from, "repeat");
  c.expect = text(from, "expect").empty() ? "pass" : text(from, "expect");
  c.tags = strings(from, "tags");
  c.reference = reference(member(from, "reference"));
  c.metrics = rows<MetricChoice>(from, "metrics", metric_choice);
  c.studies = rows<Study>(from, "studies", study);
  c.gates = rows<Gate>(from, "gates", gate);
  c.engines = rows<EngineRow>(from, "engines", engine_row);
  if (const auto& timing = member(from, "timing"); timing.is_object())
    c.timing_rounds = whole_number<int>(number_or(timing, "rounds", 0.0)), c.timing_floor = number(timing, "noise_floor");
  if (const auto& hashes = member(from, "hashes"); hashes.is_object()) {
    c.hashes = CaseHashes{text(hashes, "scene"), text(hashes, "reference"), {}, {}, {}};
    for (const auto& [name, hash] : member(hashes, "metrics").items())
      c.hashes->metrics[name] = hash.is_string() ? hash.get<std::string>() : "";
  }
  c.equivalence = rows<EquivalenceRow>(from, "equivalence", equivalence_row);
  if (const auto& ledger = member(from, "ledger"); ledger.is_object())
    for (const auto& [term, value] : ledger.items()) c.ledger[term] = number(value);
  return c;
}

Tool tool(const Json& from) {
  return {text(from, "version"), text(from, "commit"), text(from, "compiler"),
          text(from, "flags"),   text(from, "cpu"),    whole_number<int>(number_or(from, "cores", 0.0))};
}

}  // namespace

RunRow read_run_row(const std::string& text_of_row, const std::string& place_of_row) {
  const auto document = nests_too_deep(text_of_row) ? Json() : Json::parse(text_of_row, nullptr, false);
  if (!document.is_object()) throw InputError(place_of_row + ": holds no run of a results.json");
  return run_row(document);
}

Results read_results(const std::string& path) {
  const std::string text_of_file = text_of_regular_file(path, largest_file);
  if (nests_too_deep(text_of_file))
    throw InputError(fmt::format("{}: nests deeper than {} levels, which no results file does", path, most_levels));
  const auto document = Json::parse(text_of_file, nullptr, false);
  if (!document.is_object()) throw InputError(path + ": is not a JSON object (a results.json of tripoint validate is wanted)");
  if (number(document, "format") != 1.0) throw InputError(path + ": has not \"format\": 1");
  if (!member(document, "cases").is_array()) throw InputError(path + ": has no list \"cases\"");
  Results r;
  r.tool = tool(member(document, "tool"));
  r.command = text(document, "command"), r.profile = text(document, "profile"), r.date = text(document, "date"),
  r.shard = text(document, "shard"), r.history = text(document, "history");
  r.seed = whole_number<std::uint64_t>(number_or(document, "seed", 1.0));
  r.verdict = text(document, "verdict"), r.exit_code = whole_number<int>(number_or(document, "exit_code", 4.0));
  r.interrupted = member(document, "interrupted") == Json(true);
  r.planned = strings(document, "planned"), r.only_engines = strings(document, "only_engines");
  r.filter_known = flag(document, "whole", false), r.what = strings(document, "what"), r.tag = text(document, "tag"),
  r.seed_given = flag(document, "seed_given", false);
  r.asked = document.contains("asked") ? strings(document, "asked") : r.only_engines;
  r.cases = rows<CaseResult>(document, "cases", case_result);
  return r;
}

}  // namespace tripoint
