// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>

#include "validation/case/preflight.hpp"
#include "validation/results/fields.hpp"
#include "validation/results/results.hpp"
#include "validation/results/rows.hpp"
#include "validation/results/timing_pairs.hpp"

/// The fields of every record of results.json.
namespace tripoint {

template <class V>
void fields(V& v, RecordOf<SourcePlace> auto& place) {
  v("file", place.file);
  v("line", place.line);
}

template <class V>
void fields(V& v, RecordOf<Uncertainty> auto& u) {
  v("numerical", Stated{u.numerical});
  v("statistical", Stated{u.statistical});
  v("input", Stated{u.input});
  v("data", Stated{u.data});
}

template <class V>
void fields(V& v, RecordOf<MetricValue> auto& m) {
  v("value", Judged{m.value});
  v("uncertainty", m.uncertainty);
  v("note", IfAny{m.note});
  v("times", IfAny{m.times});
  v("series", IfAny{m.series});
}

template <class V>
void fields(V& v, RecordOf<Knobs> auto& k) {
  v("spacing", k.spacing);
  v("time_step", OrNull{k.time_step});
  v("support_ratio", k.support_ratio);
  v("walkers", k.walkers);
  v("iterations", k.iterations);
  v("mode", OrNull{k.mode});
  v("threads", k.threads);
  v("seed", k.seed);
  v("jitter", k.jitter);
}

template <class V>
void fields(V& v, RecordOf<Cost> auto& c) {
  v("cpu_s", c.cpu_s);
  v("wall_s", c.wall_s);
  v("setup_cpu_s", c.setup_cpu_s);
  v("peak_bytes", c.peak_bytes);
  v("pairs", c.pairs);
  v("steps", c.steps);
  v("iterations", c.iterations);
  v("simulated_s", c.simulated_s);
  v("particles", c.particles);
  v("instructions", OrNull{c.instructions});
  v("counted_by", c.counted_by, c.instructions > 0.0 ? c.counted_by : "not measured");
  v.part("timed", !c.repeats.empty(), [&](auto& timed) {
    timed("cpu_s", c.repeats);
    timed.written("min", [&] { return *std::min_element(c.repeats.begin(), c.repeats.end()); });
    timed.written("median", [&] { return median(c.repeats); });
    timed.written("median_deviation", [&] { return median_deviation(c.repeats); });
  });
}

template <class V>
void fields(V& v, RecordOf<RunRow> auto& r) {
  v("knobs", r.knobs);
  v("levels", r.levels);
  v("base", r.base);
  v("group", r.group);
  v("input", r.input);
  v.end(r.status, r.reason);
  v("comparable", r.comparable);
  v("metrics", r.metrics);
  v("cost", r.cost);
  v("state_hash", r.state_hash);
  v("time_step_bound", r.time_step_bound);
  v("folder", r.folder);
}

template <class V>
void fields(V& v, RecordOf<OrderRow> auto& o) {
  v("metric", o.metric);
  v("axis", o.axes);
  v("mode", OrNull{o.mode});
  v("value", o.order.value);
  v("low", o.order.low);
  v("high", o.order.high);
  v("class", o.order.fit_class);
  v("formal", OrNull{o.formal});
  v("coefficient", NumberOrNull{o.order.coefficient});
  v("floor", NumberOrNull{o.order.floor});
  v.part("limit", true, [&](auto& limit) {
    limit("value", NumberOrNull{o.limit.value});
    limit("uncertainty", NumberOrNull{o.limit.uncertainty});
  });
  v("step", o.step);
  v("error", o.error);
  v("uncertainty", o.uncertainty);
  v("numerical", o.numerical);
}

/// Limits of a gate and their reason: the part that a gate and its row share.
template <class V>
void allowed(V& v, RecordOf<Gate> auto& g) {
  v("limit", g.limit);
  v("band", g.band);
  v("at_least", g.at_least);
  v("drift", g.drift);
  v("reason", g.reason);
  v("by", g.by);
  v("date", g.date);
  fields(v, g.place);
}

template <class V>
void fields(V& v, RecordOf<Gate> auto& g) {
  v("metric", g.metric);
  v("engine", g.engine);
  v("mode", g.mode);
  v("preset", g.preset);
  v("level", g.level);
  v("expect", g.expect);
  allowed(v, g);
}

template <class V>
void fields(V& v, RecordOf<GateRow> auto& r) {
  v("metric", r.gate.metric);
  v("mode", OrNull{r.mode});
  v("level", r.level);
  allowed(v, r.gate);
  v("value", Judged{r.value});
  v("uncertainty", NumberOrNull{r.uncertainty});
  v("budget", r.budget);
  v("low", IfAny{r.low});
  v("high", IfAny{r.high});
  v("class", IfAny{r.fit_class});
  v("expect", IfAny{r.expect});
  v("verdict", r.verdict);
  v("physics", r.physics);
  v("defect", IfAny{r.defect});
  v("used", NumberOrNull{r.used});
  v("why", r.why);
}

/// Orders that say something: value and interval are numbers.
[[nodiscard]] inline std::vector<OrderRow> known_orders(const EngineRow& e) {
  std::vector<OrderRow> rows;
  for (const auto& o : e.order)
    if (std::isfinite(o.order.value) && std::isfinite(o.order.low) && std::isfinite(o.order.high))
      rows.push_back(o);
  return rows;
}

template <class V>
void fields(V& v, RecordOf<EngineRow> auto& e) {
  v("name", e.name);
  v("version", e.version);
  v("preset", e.preset);
  v("required", e.required);
  v.end(e.status, e.reason);
  v.written("judged", [&] { return !is_unjudged(e); });
  v.written("physics", [&] { return e.physics; });
  v.written("defects", [&] { return e.defects; });
  v("refuses", IfAny{e.refuses});
  v.part("library", !e.library_path.empty(), [&](auto& library) {
    library("path", e.library_path);
    library("hash", e.library_hash);
  });
  v.part("executable", !e.executable.empty(), [&](auto& program) {
    program("path", e.executable);
    program("hash", e.executable_hash);
  });
  v("deterministic", e.deterministic);
  v("runs", e.runs);
  v.written("order", [&] { return known_orders(e); });
  v.written(
      "gates", [&]() -> auto& { return e.gates; });
}

/// The case's own words, or those of the reference function.
[[nodiscard]] std::string source_of(const ReferenceChoice&);

template <class V>
void fields(V& v, RecordOf<ReferenceChoice> auto& r) {
  v("kind", r.kind);
  v("function", r.function);
  v("file", r.file);
  v("source", r.source, source_of(r));
  v("args", r.args);
  v("uncertainty", r.uncertainty);
}

template <class V>
void fields(V& v, RecordOf<MetricChoice> auto& m) {
  v("name", m.name);
  v("quantity", m.quantity);
  v("norm", m.norm);
  v("body", m.body);
  v("at", m.at);
  v("window", m.window);
  v("scale", m.scale);
  v("unit", m.unit);
  v("reference", m.reference);
}

template <class V>
void fields(V& v, RecordOf<Study> auto& s) {
  v("axis", s.axes);
  v("levels", s.levels);
  v("jitter", s.jitter);
  v("seeds", s.seeds);
  v("engine", s.engine);
  v("mode", s.mode);
  v("expect", s.expect);
  v("order", s.order);
  v("metric", s.metric);
  fields(v, s.place);
}

template <class V>
void fields(V& v, RecordOf<EquivalenceRow> auto& q) {
  v("a", q.a);
  v("b", q.b);
  v("metric", q.metric);
  v("difference", NumberOrNull{q.difference});
  v("uncertainty", NumberOrNull{q.uncertainty});
  v("margin", q.margin);
  v("error_a", NumberOrNull{q.error_a});
  v("error_b", NumberOrNull{q.error_b});
  v("verdict", q.verdict);
}

template <class V>
void fields(V& v, RecordOf<CaseHashes> auto& h) {
  v("scene", h.scene);
  v("reference", h.reference);
  v("metrics", h.metrics);
}

/// "not resolved" is said here, so that no reader has to know how.
template <class V>
void fields(V& v, RecordOf<TimingPair> auto& p) {
  v("a", p.a);
  v("b", p.b);
  v("ratio", p.ratio);
  v.written("verdict", [&] { return std::string(p.resolved ? "resolved" : "not resolved"); });
}

template <class V>
void fields(V& v, RecordOf<CaseResult> auto& c) {
  v("id", c.id);
  v("title", c.title);
  v("kind", c.kind);
  v("requirement", c.requirement);
  v("claims", c.claims);
  v("tags", c.tags);
  v("file", c.file);
  v("expect", c.expect);
  v.written("verdict", [&] { return c.verdict; });
  v.written("physics", [&] { return c.physics; });
  v.written("exit_code", [&] { return c.exit_code; });
  v.written(
      "problems", [&]() -> auto& { return c.problems; });
  v("reference", c.reference);
  v("metrics", c.metrics);
  v("studies", c.studies);
  v("gates", c.gates);
  v("adopted", IfAny{c.adopted});
  v("engines", c.engines);
  v("equivalence", c.equivalence);
  v.written("unjudged", [&] { return unjudged_metrics(c.metrics, c.gates, c.studies); });
  v("ledger", c.ledger);
  v("repeat", c.repeat);
  v("hashes", c.hashes);
  v.part("timing", c.timing_rounds > 0, [&](auto& timing) {
    timing("rounds", c.timing_rounds);
    timing("noise_floor", NumberOrNull{c.timing_floor});
    timing.written("pairs", [&] { return timing_pairs(c); });
  });
}

template <class V>
void fields(V& v, RecordOf<Tool> auto& t) {
  v("version", t.version);
  v("commit", t.commit);
  v("compiler", t.compiler);
  v("flags", t.flags);
  v("cpu", t.cpu);
  v("cores", t.cores);
}

template <class V>
void fields(V& v, RecordOf<Results> auto& r) {
  v("format", r.format);
  v("tool", r.tool);
  v("command", r.command);
  v("date", r.date);
  v("profile", r.profile);
  v("seed", r.seed);
  v("shard", r.shard);
  v("interrupted", r.interrupted);
  v("history", r.history);
  v("planned", r.planned);
  v("what", r.what);
  v("tag", r.tag);
  v("whole", r.filter_known);
  v("seed_given", r.seed_given);
  v("only_engines", r.only_engines);
  v("asked", r.asked);
  v("verdict", r.verdict);
  v("exit_code", r.exit_code);
  v.written(
      "problems", [&]() -> auto& { return r.problems; });
  v("cases", r.cases);
}

}  // namespace tripoint
