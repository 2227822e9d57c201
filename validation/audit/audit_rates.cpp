// SPDX-License-Identifier: BSD-3-Clause
#include "validation/audit/audit_rates.hpp"

#include <algorithm>
#include <cmath>

namespace tripoint {
namespace {

constexpr Vec3 no_value{not_a_number, not_a_number, not_a_number};
/// A smooth rate asks for 1/12 of its second difference, a jump within the interval for 1/2 of it. Contact
/// jumps several times.
constexpr double rough_share = 0.75, rough_share_in_contact = 4.0;
constexpr double five_digits = 1e-5;

}  // namespace

double Rates::greatest() const { return std::max(norm(first), norm(last)); }

double Rates::roughness() const {
  const double bends[] = {norm(before - 2.0 * first + last), norm(first - 2.0 * last + after)};
  double most = std::isfinite(bends[0]) || std::isfinite(bends[1]) ? 0.0 : norm(last - first);
  for (const double bend : bends)
    if (std::isfinite(bend)) most = std::max(most, bend);
  return most;
}

Rates rates_at(const std::vector<Vec3>& in_time, std::size_t interval) {
  return {interval > 0 ? in_time[interval - 1] : no_value, in_time[interval], in_time[interval + 1],
          interval + 2 < in_time.size() ? in_time[interval + 2] : no_value};
}

bool is_interrupted(const Job& job, const Snapshot& a, const Snapshot& b) {
  const auto takes_hold = [&](const Event& e) {
    const bool is_over = e.kind != Event::Kind::grip && e.until.value_or(e.time) < a.time;
    return e.kind != Event::Kind::heat && e.time <= b.time && !is_over;
  };
  return std::any_of(job.scene.events.begin(), job.scene.events.end(), takes_hold);
}

double allowed_difference(const Rates& rates, bool touches) {
  return (touches ? rough_share_in_contact : rough_share) * rates.roughness() +
         five_digits * rates.greatest();
}

Vec3 largest_lag(const Audited& run, const Rates& rates, double interval) {
  return (0.51 * run.step(interval) / interval) * rates.change();
}

double rounding_rate(const Audited& run, double size, double output, double interval) {
  const double step = run.step(interval), steps = 2.0 + (step > 0.0 ? interval / step : 1.0);
  // Engines of single precision have four substeps a step
  const double last_digit = run.is_single() ? 4.8e-7 : 2.3e-16;
  return (steps * last_digit * size + output) / interval;
}

}  // namespace tripoint
