// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <map>

#include "validation/metrics/frames.hpp"
#include "validation/metrics/members.hpp"

namespace tripoint {
namespace {

/// Heat of all whose temperature is not held, above 0 K [J].
std::optional<double> heat_of_free(const MetricInput& in, const Snapshot& s) {
  if (s.temperature.size() < in.initial.size()) return {};
  long double sum = 0;
  for (std::size_t i = 0; i < in.initial.size(); ++i) {
    const auto source = static_cast<std::size_t>(in.initial.source[i]);
    if (!is_alive(s, i) || (source < in.job.bodies.size() && in.job.bodies[source].temperature_held))
      continue;
    const auto& m = in.job.scene.materials.at(static_cast<std::size_t>(in.initial.material[i]));
    if (!m.heat_capacity) return {};
    sum += particle_mass(in, s, i) * heat_per_mass(m, s, i);
  }
  return double(sum);
}

/// Heat given so far by the source that holds the body's temperature. It is as the engine counts it, else the
/// gain of the other bodies, where nothing else brings heat.
std::optional<double> heat_given(const MetricInput& in, const Snapshot& s, std::string& why) {
  if (const auto counted = s.heat_given.find(in.choice.body); counted != s.heat_given.end())
    return counted->second;
  const auto held = std::count_if(in.job.bodies.begin(), in.job.bodies.end(),
                                  [](const JobBody& b) { return b.temperature_held; });
  if (held != 1 || !in.job.bodies[job_body(in)].temperature_held || !in.job.scene.events.empty() ||
      !in.job.scene.inflows.empty()) {
    why = "the trajectory does not count the heat of `" + in.choice.body +
          "` (heat_given), and it is not the only one that brings heat";
    return {};
  }
  const auto gained = heat_of_free(in, s);
  if (!gained) why = "the trajectory has no temperature";
  return gained;
}

/// Mean of the stated power over the window, by Simpson's rule between frames.
std::optional<double> true_mean(const MetricInput& in, double from, double to) {
  constexpr int parts = 64;
  double sum = 0.0;
  for (int n = 0; n <= parts; ++n) {
    const auto value = truth_of(in, "heat_power", from + (to - from) * n / parts);
    if (!value) return {};
    sum += (n == 0 || n == parts ? 1.0 : n % 2 == 1 ? 4.0 : 2.0) * *value;
  }
  return sum / (3.0 * parts);
}

MetricValue heat_power(const MetricInput& in, const Frames& frames) {
  (void)job_body(in);
  if (frames.size() < 2) return not_formed("a power needs two output times or more");
  std::string why;
  const auto first = heat_given(in, *frames.front(), why), last = heat_given(in, *frames.back(), why);
  if (!first || !last) return not_formed(why);
  const double from = frames.front()->time, to = frames.back()->time, power = (*last - *first) / (to - from);
  const auto truth = true_mean(in, from, to);
  if (!truth)
    return not_formed("the reference does not know the heat_power and states no value for all of the window");
  MetricValue v;
  v.value = power - *truth;
  v.uncertainty.data = in.reference.uncertainty("heat_power", to).value_or(0.0);
  v.note =
      std::to_string(power) + " W from t = " + std::to_string(from) + " s to " + std::to_string(to) + " s";
  return v;
}

// --- diffusivity

/// Mean square distance of the heat above the coldest place from its centre, along an axis, and its standard
/// error [m2].
struct Spread {
  double square = 0.0, error = 0.0;
};

std::optional<Spread> spread_of(const MetricInput& in, const Snapshot& s, std::size_t axis, double base) {
  const bool states_error = s.temperature_error.size() == s.temperature.size();
  std::map<double, std::vector<std::size_t>> layers;  // particles by their place along the axis
  for (std::size_t i = 0; i < s.temperature.size(); ++i)
    if (takes(in, i) && is_alive(s, i)) layers[s.position[i][axis]].push_back(i);
  double heat = 0.0, first = 0.0, square = 0.0, variance = 0.0;
  for (const auto& [x, list] : layers)
    for (const auto i : list) {
      heat += s.temperature[i] - base;
      first += x * (s.temperature[i] - base);
    }
  if (!(heat > 0.0)) return {};
  for (const auto& [x, list] : layers)
    for (const auto i : list) square += std::pow(x - first / heat, 2) * (s.temperature[i] - base);
  square /= heat;
  for (const auto& [x, list] : layers) {
    if (!states_error) break;
    const bool one_count = std::ranges::all_of(
        list, [&](std::size_t i) { return s.temperature[i] == s.temperature[list.front()]; });
    double sum = 0.0, squares = 0.0;
    for (const auto i : list) {
      sum += s.temperature_error[i];
      squares += std::pow(s.temperature_error[i], 2);
    }
    variance +=
        std::pow((std::pow(x - first / heat, 2) - square) / heat, 2) * (one_count ? sum * sum : squares);
  }
  return Spread{square, std::sqrt(variance)};
}

/// Half of the growth of the mean square distance a second, as long as no heat has come to a wall [Einstein
/// 1905].
MetricValue diffusivity_by_spread(const MetricInput& in, const Frames& frames) {
  const auto axis = in.reference.measuring().axis;
  const auto base = in.reference.number("value");
  if (!axis || !in.reference.number("diffusivity"))
    return not_formed(
        "a diffusivity needs its axis and its true value: reference = {function = \"stated\", args = {axis = "
        "\"x\", value = "
        "BASE_TEMPERATURE, diffusivity = ...}}");
  if (frames.size() < 2) return not_formed("a diffusivity needs two output times or more");
  const Snapshot &begin = *frames.front(), &end = *frames.back();
  for (const auto* s : {&begin, &end})
    if (s->temperature.size() != s->position.size()) return not_formed("the trajectory has no temperature");
  const auto a = spread_of(in, begin, *axis, *base), b = spread_of(in, end, *axis, *base);
  if (!a || !b) return not_formed("no heat lies above the stated base");
  const double D = 0.5 * (b->square - a->square) / (end.time - begin.time),
               truth = *in.reference.number("diffusivity");
  MetricValue v;
  v.value = D - truth;
  v.uncertainty.statistical = 0.5 * std::hypot(a->error, b->error) / (end.time - begin.time);
  v.note = std::to_string(D / truth) + " of the true diffusivity, from t = " + std::to_string(begin.time) +
           " s to " + std::to_string(end.time) + " s";
  return v;
}

}  // namespace

const std::vector<RunQuantity>& heat_run_quantities() {
  static const std::vector<RunQuantity> list{{{"heat_power", "W",
                                               "mean heat per second that the held body gives to its "
                                               "neighbours over the window, minus the true mean"},
                                              heat_power},
                                             {{"diffusivity", "m2/s",
                                               "half the growth per second of the mean square spread of the "
                                               "heat above `value` along the stated axis, minus the true "
                                               "`diffusivity`"},
                                              diffusivity_by_spread}};
  return list;
}

}  // namespace tripoint
