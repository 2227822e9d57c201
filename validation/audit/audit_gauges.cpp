// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "files/gauge_error.hpp"
#include "validation/audit/audit_parts.hpp"

namespace tripoint {
namespace {

/// A diffusivity is one number, of the whole run.
bool is_of_whole_run(const JobGauge& gauge) { return gauge.quantity == "diffusivity"; }

/// The gauge's quantity as the particles show it, its true value taken as 0.
MetricValue shown_by_particles(const Audited& run, const JobGauge& gauge) {
  MetricChoice choice;
  choice.name = gauge.metric + " by particles";
  choice.quantity = gauge.quantity;
  choice.body = gauge.body;
  ReferenceChoice nothing;
  nothing.kind = ReferenceKind::bound;
  nothing.function = "stated";
  nothing.args = gauge.where;
  nothing.args["value"] = 0.0;
  if (is_of_whole_run(gauge)) {  // the heat above the coldest place
    const auto& T = run.initial.temperature;
    nothing.args["value"] = T.empty() ? 0.0 : *std::min_element(T.begin(), T.end());
    nothing.args["diffusivity"] = 0.0;
    choice.norm = Norm::final;
  }
  try {
    return evaluate(choice, run.job, run.initial, run.trajectory,
                    *make_reference(nothing, run.job, run.initial));
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

bool is_rigid(const Audited& run, const std::string& name) {
  const auto body = std::ranges::find(run.job.bodies, name, &JobBody::name);
  return body != run.job.bodies.end() && body->phase == Phase::rigid;
}

/// A tenth of the range of a field at a point: particles are one spacing apart, and a field's own value is
/// finer. Means and places of matter are known to a hundredth, those of a rigid body to a thousandth of a
/// spacing.
double tolerance_of_gauge(const Audited& run, const JobGauge& gauge, const std::vector<double>& shown) {
  const auto is_of = [&](const char* what) { return gauge.quantity.find(what) != std::string::npos; };
  double most = 0.0;
  for (const double value : shown) most = std::max(most, std::abs(value));
  const double share = gauge.quantity.starts_with("mean_") ? 0.01 : 0.1;
  if (is_of("temperature")) return share * largest(run, spread_of_temperature) + 1e-6 * most;
  if (is_of("velocity")) return share * largest(run, fastest_of_all);
  if (is_of("pressure")) return share * largest(run, largest_pressure);
  if (is_of("density")) return share * most;
  if (gauge.quantity == "centre") return (is_rigid(run, gauge.body) ? 1e-3 : 0.1) * run.job.scene.spacing;
  return 0.02 * most + 1e-3 * run.job.scene.spacing;  // displacement
}

std::string stated(const JobGauge& gauge, double own, double shown) {
  return "contradicts itself: the gauge `" + gauge.metric + "` says " + figure(own) + ", the particles " +
         figure(shown);
}

std::string gauge_contradicts(const Audited& run, const JobGauge& gauge, const std::vector<double>& shown) {
  const double allowed = tolerance_of_gauge(run, gauge, shown);
  for (std::size_t n = 0; n < run.frames.size(); ++n) {
    const auto own = run.frames[n]->gauges.find(gauge.metric);
    if (own == run.frames[n]->gauges.end() || std::abs(own->second - shown[n]) <= allowed) continue;
    return stated(gauge, own->second, shown[n]) + at_time(*run.frames[n]) + ", where they may differ by " +
           figure(allowed);
  }
  return {};
}

/// Walkers and particles state how well they know it.
std::string whole_run_contradicts(const Audited& run, const JobGauge& gauge, const MetricValue& shown) {
  const auto& gauges = run.frames.back()->gauges;
  const auto own = gauges.find(gauge.metric), error = gauges.find(gauge_error_key(gauge.metric));
  if (own == gauges.end() || !std::isfinite(shown.value)) return {};
  const double sigma = std::hypot(error == gauges.end() ? 0.0 : error->second, shown.uncertainty.statistical);
  const double allowed = 0.02 * std::abs(shown.value) + 4.0 * sigma;
  return std::abs(own->second - shown.value) > allowed ? stated(gauge, own->second, shown.value) : "";
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
    const bool at_all_times = shown.times.size() == run.frames.size();
    const auto why = is_of_whole_run(gauge) ? whole_run_contradicts(run, gauge, shown)
                     : at_all_times         ? gauge_contradicts(run, gauge, shown.series)
                                            : std::string();
    if (!why.empty()) return why;
  }
  return {};
}

}  // namespace tripoint
