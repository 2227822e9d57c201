// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "validation/audit/audit_parts.hpp"

namespace tripoint {
namespace {

/// The gauge's quantity as the particles show it at each of the job's times; empty where they do not.
std::vector<double> shown_by_particles(const Audited& run, const JobGauge& gauge) {
  MetricChoice choice;
  choice.name = gauge.metric + " by particles";
  choice.quantity = gauge.quantity;
  choice.body = gauge.body;
  ReferenceChoice nothing;
  nothing.kind = ReferenceKind::bound;
  nothing.function = "stated";
  nothing.args = gauge.where;
  nothing.args["value"] = 0.0;
  try {
    const auto value = evaluate(choice, run.job, run.initial, run.trajectory,
                                *make_reference(nothing, run.job, run.initial));
    return value.times.size() == run.frames.size() ? value.series : std::vector<double>{};
  } catch (const InputError&) {
    return {};
  }
}

double largest(const Audited& run, double (*size)(const Snapshot&)) {
  double most = 0.0;
  for (const auto* s : run.frames) most = std::max(most, size(*s));
  return most;
}

double fastest_of_all(const Snapshot& s) {
  double most = 0.0;
  for (const Vec3& v : s.velocity) most = std::max(most, norm(v));
  return most;
}
double largest_pressure(const Snapshot& s) {
  double most = 0.0;
  for (const double p : s.pressure) most = std::max(most, std::abs(p));
  return most;
}
double spread_of_temperature(const Snapshot& s) {
  if (s.temperature.empty()) return 0.0;
  const auto [low, high] = std::minmax_element(s.temperature.begin(), s.temperature.end());
  return *high - *low;
}

/// A tenth of the range of the quantity: particles are one spacing apart, and a field's own value is
/// finer.
double tolerance_of_gauge(const Audited& run, const JobGauge& gauge, const std::vector<double>& shown) {
  const auto is_of = [&](const char* what) { return gauge.quantity.find(what) != std::string::npos; };
  double most = 0.0;
  for (const double value : shown) most = std::max(most, std::abs(value));
  if (is_of("temperature")) return 0.1 * largest(run, spread_of_temperature) + 1e-6 * most;
  if (is_of("velocity")) return 0.1 * largest(run, fastest_of_all);
  if (is_of("pressure")) return 0.1 * largest(run, largest_pressure);
  if (is_of("density")) return 0.1 * most;
  if (gauge.quantity == "centre") return 0.5 * run.job.scene.spacing;
  return 0.1 * most + 1e-3 * run.job.scene.spacing;  // displacement
}

std::string gauge_contradicts(const Audited& run, const JobGauge& gauge, const std::vector<double>& shown) {
  const double allowed = tolerance_of_gauge(run, gauge, shown);
  for (std::size_t n = 0; n < run.frames.size(); ++n) {
    const auto own = run.frames[n]->gauges.find(gauge.metric);
    if (own == run.frames[n]->gauges.end() || std::abs(own->second - shown[n]) <= allowed) continue;
    return "contradicts itself: the gauge `" + gauge.metric + "` says " + figure(own->second) +
           ", the particles " + figure(shown[n]) + at_time(*run.frames[n]) + ", where they may differ by " +
           figure(allowed);
  }
  return {};
}

bool is_answered(const Audited& run, const JobGauge& gauge) {
  return std::any_of(run.frames.begin(), run.frames.end(),
                     [&](const Snapshot* s) { return s->gauges.contains(gauge.metric); });
}

}  // namespace

std::string gauges_against_particles(const Audited& run) {
  for (const JobGauge& gauge : run.job.gauges) {
    if (!is_answered(run, gauge)) continue;
    const auto shown = shown_by_particles(run, gauge);
    if (shown.size() != run.frames.size()) continue;
    if (auto why = gauge_contradicts(run, gauge, shown); !why.empty()) return why;
  }
  return {};
}

}  // namespace tripoint
