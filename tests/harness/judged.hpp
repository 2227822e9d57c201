// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "validation/judge/judge.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {

inline MetricValue value(double v, double statistical = 0.0) {
  return {v, {0.0, statistical, 0.0, 0.0}, {}, {}, {}};
}

inline Gate limit(const std::string& metric, double most) {
  Gate g;
  g.metric = metric;
  g.limit = most;
  g.reason = "a test";
  return g;
}

inline RunRow run_with(const std::map<std::string, MetricValue>& metrics) {
  RunRow r;
  r.base = true;
  r.group = "base";
  r.metrics = metrics;
  return r;
}

/// One engine, one run, one metric `error` below its limit of 0.1: green as it stands.
inline Results green() {
  CaseResult c;
  c.id = "test/one";
  c.title = "One";
  c.kind = CaseKind::verification;
  c.gates = {limit("error", 0.1)};
  c.metrics.resize(1);
  c.metrics[0].name = "error";
  EngineRow e;
  e.name = "tripoint";
  e.required = true;
  e.runs = {run_with({{"error", value(0.05)}})};
  c.engines = {e};
  Results r;
  r.cases = {c};
  r.planned = {"test/one"};
  return r;
}

inline EngineRow& engine(Results& r) { return r.cases[0].engines[0]; }
inline MetricValue& error(Results& r) { return engine(r).runs[0].metrics.at("error"); }

inline int exit_of(Results r) {
  judge(r);
  return r.exit_code;
}

/// A study over spacing with these errors, refined by 2 from 0.1.
inline Results study_of(const std::vector<double>& errors) {
  auto r = green();
  Study s;
  s.axes = {Axis::spacing};
  s.metric = "error";
  engine(r).runs.clear();
  double spacing = 0.1;
  for (const double e : errors) {
    auto run = run_with({{"error", value(e)}});
    run.base = false;
    run.knobs.spacing = spacing;
    run.levels = {{{Axis::spacing}, spacing}};
    run.group = "spacing=" + std::to_string(spacing);
    engine(r).runs.push_back(run);
    s.levels.push_back(spacing);
    spacing /= 2.0;
  }
  r.cases[0].studies = {s};
  Gate g;
  g.metric = "error.order";
  g.at_least = 1.5;
  g.reason = "second order";
  r.cases[0].gates = {g};
  return r;
}

}  // namespace tripoint
