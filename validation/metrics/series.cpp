// SPDX-License-Identifier: BSD-3-Clause
#include "validation/metrics/series.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <tuple>

#include "validation/metrics/dominant_frequency.hpp"
#include "validation/metrics/statistics.hpp"

namespace tripoint {
namespace {

std::string seconds_text(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

double rms_over_time(const Series& s) {
  if (s.value.size() == 1) return std::abs(s.value[0]);
  double integral = 0.0;
  for (std::size_t n = 1; n < s.value.size(); ++n)
    integral +=
        0.5 * (s.times[n] - s.times[n - 1]) * (s.value[n] * s.value[n] + s.value[n - 1] * s.value[n - 1]);
  return std::sqrt(integral / (s.times.back() - s.times.front()));
}

double mean_over_time(const Series& s) {
  if (s.value.size() == 1) return s.value[0];
  double integral = 0.0;
  for (std::size_t n = 1; n < s.value.size(); ++n)
    integral += 0.5 * (s.times[n] - s.times[n - 1]) * (s.value[n] + s.value[n - 1]);
  return integral / (s.times.back() - s.times.front());
}

/// Trend of the error [unit/s] and its standard error.
std::pair<double, double> slope_over_time(const Series& s) {
  const double n = static_cast<double>(s.value.size());
  double t0 = 0.0, y0 = 0.0, tt = 0.0, ty = 0.0, rest = 0.0;
  for (std::size_t i = 0; i < s.value.size(); ++i) {
    t0 += s.times[i] / n;
    y0 += s.value[i] / n;
  }
  for (std::size_t i = 0; i < s.value.size(); ++i) {
    tt += (s.times[i] - t0) * (s.times[i] - t0);
    ty += (s.times[i] - t0) * (s.value[i] - y0);
  }
  for (std::size_t i = 0; i < s.value.size(); ++i)
    rest += std::pow(s.value[i] - y0 - ty / tt * (s.times[i] - t0), 2);
  return {ty / tt, n > 2.0 ? std::sqrt(rest / (n - 2.0) / tt) : not_a_number};
}

/// Mean after the burn-in with the error that blocks of it show; a series too short for a plateau has no
/// value.
MetricValue stationary(const Series& s, MetricValue v) {
  const auto m = stationary_mean(s.value);
  if (!std::isfinite(m.value))
    return unformed("a stationary mean needs eight finite output times or more in its window");
  v.value = m.value;
  v.uncertainty.statistical =
      std::max(m.uncertainty, *std::max_element(s.uncertainty.begin(), s.uncertainty.end()));
  v.note = std::to_string(m.burn_in) + " samples of burn-in cut, " +
           std::to_string(static_cast<long>(m.effective)) + " independent ones left" +
           (m.plateau ? "" : ", no plateau yet");
  return v;
}

}  // namespace

MetricValue frequency_of(const MetricInput& in, const Series& s) {
  MetricValue v;
  v.times = s.times;
  v.series = s.value;
  const auto truth = in.reference.number("stated_frequency");
  if (!truth)
    return unformed(
        "the norm frequency needs the true one in Hz: reference = {function = \"stated\", args = {frequency "
        "= ...}}");
  const auto found = dominant_frequency(s.times, s.value);
  if (!found.problem.empty()) return unformed(found.problem);
  v.value = found.frequency - *truth;
  v.uncertainty.numerical = found.uncertainty;
  v.note = std::to_string(found.frequency) + " Hz against " + std::to_string(*truth) + ", amplitude " +
           std::to_string(found.amplitude) + ", " + std::to_string(100.0 * found.share) +
           " % of the variance";
  return v;
}

MetricValue swing_of(const MetricInput& in, const Series& s) {
  MetricValue v;
  v.times = s.times;
  v.series = s.value;
  const auto truth = in.reference.number("stated_amplitude");
  if (!truth)
    return unformed(
        "the norm swing needs the true amplitude: reference = {function = \"stated\", args = {amplitude = "
        "...}}");
  const auto [low, high] = std::ranges::minmax_element(s.value);
  v.value = 0.5 * (*high - *low) - *truth;
  v.uncertainty.statistical = std::ranges::max(s.uncertainty);
  v.note = std::to_string(*low) + " to " + std::to_string(*high);
  return v;
}

std::string average_over(Series& s, double length, const std::vector<double>& kept, double tolerance) {
  Series out;
  for (const double t : kept) {
    double value = 0.0, uncertainty = 0.0, count = 0.0;
    for (std::size_t n = 0; n < s.times.size(); ++n) {
      if (std::abs(s.times[n] - t) > 0.5 * length + tolerance) continue;
      value += s.value[n];
      uncertainty = std::max(uncertainty, s.uncertainty[n]);
      count += 1.0;
    }
    if (count < 2.0)
      return "the average over " + seconds_text(length) + " s at t = " + seconds_text(t) +
             " s holds one output time: shorten scene.output_interval";
    out.times.push_back(t);
    out.value.push_back(value / count);
    out.uncertainty.push_back(uncertainty);
    out.worst.push_back(-1);
  }
  s = std::move(out);
  return {};
}

MetricValue over_time(Norm norm, const Series& s) {
  MetricValue v;
  v.times = s.times;
  v.series = s.value;
  std::size_t k = s.value.size() - 1;
  if (norm == Norm::rms) {
    v.value = rms_over_time(s);
    v.uncertainty.statistical = *std::max_element(s.uncertainty.begin(), s.uncertainty.end());
    return v;
  }
  if (norm == Norm::mean) {
    v.value = mean_over_time(s);
    v.uncertainty.statistical = *std::max_element(s.uncertainty.begin(), s.uncertainty.end());
    return v;
  }
  if (norm == Norm::stationary) return stationary(s, v);
  if (norm == Norm::slope) {
    if (s.value.size() < 2) return unformed("a slope needs two output times or more");
    std::tie(v.value, v.uncertainty.numerical) = slope_over_time(s);
    return v;
  }
  if (norm != Norm::final)  // the largest in time: max, drift, and a norm in space at all times
    for (std::size_t n = 0; n < s.value.size(); ++n) k = std::abs(s.value[n]) > std::abs(s.value[k]) ? n : k;
  v.value = norm == Norm::final ? s.value[k] : std::abs(s.value[k]);
  v.uncertainty.statistical = s.uncertainty[k];
  v.note = "at t = " + std::to_string(s.times[k]) + " s" +
           (s.worst[k] >= 0 ? ", row " + std::to_string(s.worst[k]) : "");
  return v;
}

}  // namespace tripoint
