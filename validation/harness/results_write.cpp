// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "validation/harness/json_number.hpp"
#include "validation/harness/judge.hpp"
#include "validation/harness/results.hpp"
#include "validation/harness/timing.hpp"
#include "validation/references/reference.hpp"

namespace tripoint {
namespace {

using Json = nlohmann::ordered_json;

/// The writer of a non-finite number is this one line: null, and "finite": false beside it (contracts).
void put(Json& to, const char* key, double value, bool say_finite = false) {
  if (std::isfinite(value))
    to[key] = value;
  else
    to[key] = nullptr;
  if (say_finite && !std::isfinite(value)) to["finite"] = false;
}

Json json(const Setting& setting) {
  return std::visit([](const auto& v) { return Json(v); }, setting);
}

Json json(const Knobs& k) {
  return {{"spacing", k.spacing},
          {"time_step", k.time_step > 0.0 ? Json(k.time_step) : Json(nullptr)},
          {"support_ratio", k.support_ratio},
          {"walkers", number(k.walkers)},
          {"iterations", number(k.iterations)},
          {"mode", k.mode.empty() ? Json(nullptr) : Json(k.mode)},
          {"threads", k.threads},
          {"seed", k.seed},
          {"jitter", k.jitter}};
}

Json json(const Uncertainty& parts) {
  Json u;
  put(u, "numerical", parts.numerical);
  put(u, "statistical", parts.statistical);
  put(u, "input", parts.input);
  put(u, "data", parts.data);
  return u;
}

Json json(const MetricValue& m) {
  Json out;
  put(out, "value", m.value, true);
  out["uncertainty"] = json(m.uncertainty);
  if (!m.note.empty()) out["note"] = m.note;
  if (!m.times.empty()) out["times"] = numbers(m.times), out["series"] = numbers(m.series);
  return out;
}

/// CPU seconds of the timed runs, and what is to be read off them.
Json timed(const std::vector<double>& seconds) {
  return {{"cpu_s", numbers(seconds)},
          {"min", *std::min_element(seconds.begin(), seconds.end())},
          {"median", median(seconds)},
          {"median_deviation", median_deviation(seconds)}};
}

Json json(const Cost& c) {
  Json out{{"cpu_s", c.cpu_s},
           {"wall_s", c.wall_s},
           {"setup_cpu_s", c.setup_cpu_s},
           {"peak_bytes", c.peak_bytes},
           {"pairs", c.pairs},
           {"steps", c.steps},
           {"iterations", c.iterations},
           {"simulated_s", c.simulated_s},
           {"particles", c.particles},
           {"instructions", c.instructions > 0.0 ? Json(c.instructions) : Json(nullptr)},
           {"counted_by", c.instructions > 0.0 ? c.counted_by : "not measured"}};
  if (!c.repeats.empty()) out["timed"] = timed(c.repeats);
  return out;
}

Json json(const RunRow& r) {
  Json metrics = Json::object(), levels = Json::object();
  for (const auto& [name, value] : r.metrics) metrics[name] = json(value);
  for (const auto& [axis, level] : r.levels) levels[axis] = level;
  return {{"knobs", json(r.knobs)}, {"levels", levels},           {"base", r.base},
          {"group", r.group},       {"input", r.input},           {"status", r.status},
          {"reason", r.reason},     {"comparable", r.comparable}, {"metrics", metrics},
          {"cost", json(r.cost)},   {"state_hash", r.state_hash}, {"time_step_bound", r.time_step_bound},
          {"folder", r.folder}};
}

Json json(const OrderRow& o) {
  return {{"metric", o.metric},
          {"axis", o.axis},
          {"mode", o.mode.empty() ? Json(nullptr) : Json(o.mode)},
          {"value", o.order.value},
          {"low", o.order.low},
          {"high", o.order.high},
          {"class", o.order.fit_class},
          {"formal", o.formal > 0.0 ? Json(o.formal) : Json(nullptr)},
          {"coefficient", number(o.order.coefficient)},
          {"floor", number(o.order.floor)},
          {"step", numbers(o.step)},
          {"error", numbers(o.error)},
          {"uncertainty", numbers(o.uncertainty)},
          {"numerical", numbers(o.numerical)}};
}

Json json(const Gate& g) {
  return {{"metric", g.metric},
          {"engine", g.engine},
          {"mode", g.mode},
          {"preset", g.preset},
          {"level", number(g.level)},
          {"limit", number(g.limit)},
          {"band", g.band ? Json(*g.band) : Json(nullptr)},
          {"at_least", number(g.at_least)},
          {"drift", number(g.drift)},
          {"reason", g.reason},
          {"by", g.by},
          {"date", g.date},
          {"file", g.place.file},
          {"line", g.place.line}};
}

Json json(const GateRow& r) {
  Json out = json(r.gate);
  out.erase("engine"), out.erase("preset");
  out["mode"] = r.mode.empty() ? Json(nullptr) : Json(r.mode);
  out["level"] = number(r.level);
  put(out, "value", r.value, true);
  put(out, "uncertainty", r.uncertainty);
  out["budget"] = json(r.budget);
  if (r.low) out["low"] = number(r.low), out["high"] = number(r.high);
  if (!r.fit_class.empty()) out["class"] = r.fit_class;
  if (!r.expect.empty()) out["expect"] = r.expect;
  out["verdict"] = r.verdict;
  out["why"] = r.why;
  return out;
}

Json json(const EngineRow& e) {
  Json runs = Json::array(), order = Json::array(), gates = Json::array();
  for (const auto& r : e.runs) runs.push_back(json(r));
  for (const auto& o : e.order)
    if (std::isfinite(o.order.value) && std::isfinite(o.order.low) && std::isfinite(o.order.high)) order.push_back(json(o));
  for (const auto& g : e.gates) gates.push_back(json(g));
  Json out{{"name", e.name},     {"version", e.version}, {"preset", e.preset},       {"required", e.required},
           {"status", e.status}, {"reason", e.reason},   {"judged", !is_unjudged(e)}};
  if (!e.refuses.empty()) out["refuses"] = e.refuses;
  if (!e.library_path.empty()) out["library"] = {{"path", e.library_path}, {"hash", e.library_hash}};
  out["runs"] = runs, out["order"] = order, out["gates"] = gates;
  return out;
}

/// The case's own words, or those of the reference function.
std::string source_of(const ReferenceChoice& r) {
  if (!r.source.empty()) return r.source;
  const auto& all = reference_functions();
  const std::string& name = r.function.empty() ? r.kind : r.function;
  const auto f = std::find_if(all.begin(), all.end(), [&](const ReferenceFunction& g) { return g.name == name; });
  return f == all.end() ? "" : f->source;
}

Json json(const ReferenceChoice& r) {
  Json args = Json::object();
  for (const auto& [key, value] : r.args) args[key] = json(value);
  return {{"kind", r.kind},         {"function", r.function}, {"file", r.file},
          {"source", source_of(r)}, {"args", args},           {"uncertainty", r.uncertainty}};
}

Json json(const Study& s) {
  return {{"axis", s.axis},     {"levels", s.levels},   {"jitter", s.jitter},  {"seeds", s.seeds},
          {"engine", s.engine}, {"mode", s.mode},       {"expect", s.expect},  {"order", number(s.order)},
          {"metric", s.metric}, {"file", s.place.file}, {"line", s.place.line}};
}

Json json(const EquivalenceRow& q) {
  Json out{{"a", q.a}, {"b", q.b}, {"metric", q.metric}};
  put(out, "difference", q.difference);
  put(out, "uncertainty", q.uncertainty);
  out["margin"] = number(q.margin);
  put(out, "error_a", q.error_a);
  put(out, "error_b", q.error_b);
  out["verdict"] = q.verdict;
  return out;
}

/// "not resolved" is said here, so that no reader has to know how.
Json timing(const CaseResult& c) {
  Json pairs = Json::array();
  for (const auto& p : timing_pairs(c))
    pairs.push_back({{"a", p.a}, {"b", p.b}, {"ratio", p.ratio}, {"verdict", p.resolved ? "resolved" : "not resolved"}});
  Json out{{"rounds", c.timing_rounds}};
  put(out, "noise_floor", c.timing_floor);
  out["pairs"] = pairs;
  return out;
}

Json json(const CaseResult& c) {
  Json metrics = Json::array(), studies = Json::array(), gates = Json::array(), engines = Json::array(),
       equivalence = Json::array(), ledger = Json::object();
  for (const auto& m : c.metrics)
    metrics.push_back({{"name", m.name},
                       {"quantity", m.quantity},
                       {"norm", m.norm},
                       {"body", m.body},
                       {"at", m.at},
                       {"window", m.window},
                       {"scale", m.scale},
                       {"unit", m.unit}});
  for (const auto& s : c.studies) studies.push_back(json(s));
  for (const auto& g : c.gates) gates.push_back(json(g));
  for (const auto& e : c.engines) engines.push_back(json(e));
  for (const auto& q : c.equivalence) equivalence.push_back(json(q));
  for (const auto& [term, value] : c.ledger) put(ledger, term.c_str(), value);
  Json out{{"id", c.id},
           {"title", c.title},
           {"kind", c.kind},
           {"requirement", c.requirement},
           {"claims", c.claims},
           {"tags", c.tags},
           {"file", c.file},
           {"expect", c.expect},
           {"verdict", c.verdict},
           {"exit_code", c.exit_code},
           {"problems", c.problems},
           {"reference", json(c.reference)},
           {"metrics", metrics},
           {"studies", studies},
           {"gates", gates},
           {"engines", engines},
           {"equivalence", equivalence},
           {"ledger", ledger},
           {"repeat", c.repeat}};
  if (c.hashes) out["hashes"] = {{"scene", c.hashes->scene}, {"reference", c.hashes->reference}, {"metrics", c.hashes->metrics}};
  if (c.timing_rounds > 0) out["timing"] = timing(c);
  return out;
}

}  // namespace

std::string run_row_text(const RunRow& row) { return json(row).dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }

std::string results_text(const Results& r) {
  Json cases = Json::array();
  for (const auto& c : r.cases) cases.push_back(json(c));
  const Json document{{"format", r.format},
                      {"tool",
                       {{"version", r.tool.version},
                        {"commit", r.tool.commit},
                        {"compiler", r.tool.compiler},
                        {"flags", r.tool.flags},
                        {"cpu", r.tool.cpu},
                        {"cores", r.tool.cores}}},
                      {"command", r.command},
                      {"date", r.date},
                      {"profile", r.profile},
                      {"seed", r.seed},
                      {"shard", r.shard},
                      {"interrupted", r.interrupted},
                      {"history", r.history},
                      {"planned", r.planned},
                      {"what", r.what},
                      {"tag", r.tag},
                      {"whole", r.filter_known},
                      {"seed_given", r.seed_given},
                      {"only_engines", r.only_engines},
                      {"asked", r.asked},
                      {"verdict", r.verdict},
                      {"exit_code", r.exit_code},
                      {"problems", r.problems},
                      {"cases", cases}};
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tripoint
