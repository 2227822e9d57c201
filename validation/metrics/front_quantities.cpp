// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/metrics/frames.hpp"
#include "validation/metrics/members.hpp"

/// The front of a liquid that runs along an axis, against measured positions of it.
namespace tripoint {
namespace {

/// Two companions within 1.5 spacings: a drop that flies alone is not the front.
bool belongs_to_the_liquid(const MetricInput& in, const Snapshot& s, std::size_t particle) {
  int companions = 0;
  for (std::size_t j = 0; j < s.position.size() && companions < 2; ++j)
    companions +=
        j != particle && takes_liquid(in, s, j) &&
        norm(displacement(in.job.scene, s.position[j], s.position[particle])) < 1.5 * in.job.scene.spacing;
  return companions == 2;
}

/// Place of the foremost particle of the liquid that is no lone drop, half a spacing added [m]; NaN where
/// there is none.
double front_of(const MetricInput& in, const Snapshot& s, std::size_t axis) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < s.position.size(); ++i)
    if (takes_liquid(in, s, i) && finite(s.position[i])) order.push_back(i);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return s.position[a][axis] > s.position[b][axis]; });
  for (const auto i : order)
    if (belongs_to_the_liquid(in, s, i)) return s.position[i][axis] + 0.5 * in.job.scene.spacing;
  return std::numeric_limits<double>::quiet_NaN();
}

/// The run's front where the experiment saw its own.
struct Fronts {
  std::vector<double> time, run, measured, uncertainty;
  std::string problem;
};

bool has_several_liquids(const Job& job) {
  return std::ranges::count_if(job.bodies, [](const JobBody& b) {
           return b.phase == Phase::liquid && b.motion == Motion::free;
         }) > 1;
}

/// The front at a time, by a straight line between two frames; none beyond the first and the last.
std::optional<double> front_at(const MetricInput& in, const std::vector<double>& t,
                               const std::vector<double>& x, double time) {
  const auto next = std::lower_bound(t.begin(), t.end(), time - time_tolerance(in.job));
  if (next == t.end()) return {};
  const auto k = static_cast<std::size_t>(next - t.begin());
  if (std::abs(t[k] - time) <= time_tolerance(in.job)) return x[k];
  if (k == 0) return {};
  return x[k - 1] + (time - t[k - 1]) / (t[k] - t[k - 1]) * (x[k] - x[k - 1]);
}

/// Fronts at the measured times, by straight lines between output times; never beyond them.
Fronts fronts(const MetricInput& in, const std::vector<const Snapshot*>& frames) {
  const auto axis = in.reference.measuring().axis;
  const auto* curve = in.reference.measured("front");
  if (!axis || !curve)
    return {{}, {}, {}, {}, "the reference has no measured front, or names no axis along which it runs"};
  if (in.choice.body.empty() && has_several_liquids(in.job))  // the farthest is not the one that runs
    return {{}, {}, {}, {}, "the scene has several liquids: name the body whose front it is"};
  std::vector<double> t, x;
  for (const auto* s : frames) {
    t.push_back(s->time);
    x.push_back(front_of(in, *s, *axis));
  }
  Fronts f;
  for (std::size_t n = 0; n < curve->time.size(); ++n) {
    const auto run = front_at(in, t, x, curve->time[n]);
    if (!run)
      return {{},
              {},
              {},
              {},
              "a front was measured at t = " + std::to_string(curve->time[n]) +
                  " s, which the run's frames do not enclose"};
    f.time.push_back(curve->time[n]);
    f.run.push_back(*run);
    f.measured.push_back(curve->value[n]);
    f.uncertainty.push_back(curve->uncertainty[n]);
    if (!std::isfinite(f.run.back()))
      return {{},
              {},
              {},
              {},
              (in.choice.body.empty() ? std::string("no liquid")
                                      : "body `" + in.choice.body + "` has no liquid that") +
                  " has a front at t = " + std::to_string(f.time.back()) + " s"};
  }
  return f;
}

MetricValue front_lead(const MetricInput& in, const std::vector<const Snapshot*>& frames) {
  const auto f = fronts(in, frames);
  if (!f.problem.empty()) return unformed(f.problem);
  MetricValue v;
  std::size_t worst = 0;
  for (std::size_t n = 0; n < f.time.size(); ++n) {
    v.times.push_back(f.time[n]);
    v.series.push_back(f.run[n] - f.measured[n]);
    if (std::abs(v.series[n]) > std::abs(v.series[worst])) worst = n;
  }
  v.value = v.series[worst];
  v.uncertainty.data = f.uncertainty[worst];
  v.note = "at t = " + std::to_string(f.time[worst]) + " s";
  return v;
}

MetricValue front_speed(const MetricInput& in, const std::vector<const Snapshot*>& frames) {
  const auto f = fronts(in, frames);
  if (!f.problem.empty()) return unformed(f.problem);
  if (f.time.size() < 2) return unformed("a speed needs two measured fronts or more");
  const double way = f.measured.back() - f.measured.front(), span = f.time.back() - f.time.front(),
               own = f.run.back() - f.run.front();
  if (!(way > 0.0)) return unformed("the measured front does not advance");
  MetricValue v;
  v.value = own / way - 1.0;
  v.uncertainty.data = std::abs(own) / (way * way) * std::hypot(f.uncertainty.front(), f.uncertainty.back());
  v.note = std::to_string(own / span) + " m/s against " + std::to_string(way / span);
  return v;
}

}  // namespace

const std::vector<RunQuantity>& front_quantities() {
  static const std::vector<RunQuantity> list{
      {{"front_lead", "m",
        "front of the liquid (or body) minus the measured one, where the difference is largest; its "
        "uncertainty is the data's"},
       front_lead},
      {{"front_speed", "1",
        "mean speed of the front from the first measured place to the last over the measured one, minus 1"},
       front_speed}};
  return list;
}

}  // namespace tripoint
