// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "validation/metrics/frame_error.hpp"

namespace tripoint {
namespace {

/// Means over layers one spacing thick, across the axis that the reference names.
struct Layer {
  double weight = 0.0, place = 0.0, run = 0.0, truth = 0.0, variance = 0.0, greatest_sigma = 0.0;
  double first = 0.0;     ///< temperature of its first particle
  bool one_count = true;  ///< all its particles show one count of walkers
};

std::optional<std::size_t> axis_of_profile(const MetricInput& in) { return in.reference.measuring().axis; }

std::map<long, Layer> layers(const FramePair& f, std::size_t axis) {
  std::map<long, Layer> list;
  const auto& start = f.in.initial.position;
  for (std::size_t i = 0; i < start.size(); ++i) {
    if (!takes(f.in, i)) continue;
    auto& layer = list[static_cast<long>(std::floor(start[i][axis] / f.in.job.scene.spacing + 1e-9))];
    const double w = rest_volume(f.in, i),
                 sigma = i < f.now.temperature_error.size() ? f.now.temperature_error[i] : 0.0;
    if (layer.weight == 0.0) layer.first = f.now.temperature[i];
    if (f.now.temperature[i] != layer.first) layer.one_count = false;
    layer.weight += w;
    layer.place += w * start[i][axis];
    layer.run += w * f.now.temperature[i];
    layer.truth += w * f.truth.temperature[i];
    layer.variance += w * w * sigma * sigma;
    layer.greatest_sigma = std::max(layer.greatest_sigma, sigma);
  }
  for (auto& [row, layer] : list) {
    layer.place /= layer.weight;
    layer.run /= layer.weight;
    layer.truth /= layer.weight;
    layer.variance = layer.one_count ? layer.greatest_sigma * layer.greatest_sigma
                                     : layer.variance / (layer.weight * layer.weight);
  }
  return list;
}

std::string missing(const FramePair& f) {
  const auto n = f.in.initial.size();
  if (!axis_of_profile(f.in)) return "the reference names no axis for a profile";
  if (f.truth.temperature.size() != n) return "the reference does not know the temperature";
  if (f.now.temperature.size() != n) return "the trajectory has no temperature";
  for (std::size_t i = 0; i < n; ++i)
    if (!std::isfinite(f.now.temperature[i]))
      return "temperature of particle " + std::to_string(i) + " is not finite";
  return {};
}

FrameError profile(const FramePair& f) {
  if (auto why = missing(f); !why.empty()) return problem(why);
  FrameError out;
  for (const auto& [row, layer] : layers(f, *axis_of_profile(f.in))) {
    out.add(layer.run - layer.truth, layer.weight, row);
    if (!f.now.temperature_error.empty()) out.sigma.push_back(std::sqrt(layer.variance));
  }
  return out;
}

/// First place where the layers cross a temperature, by linear interpolation [m].
std::optional<double> crossing(const std::map<long, Layer>& list, double level, double Layer::*value) {
  const Layer* before = nullptr;
  for (const auto& [row, layer] : list) {
    if (before && (before->*value - level) * (layer.*value - level) <= 0.0 &&
        before->*value != layer.*value) {
      const double s = (level - before->*value) / (layer.*value - before->*value);
      return before->place + s * (layer.place - before->place);
    }
    before = &layer;
  }
  return {};
}

FrameError front(const FramePair& f) {
  if (auto why = missing(f); !why.empty()) return problem(why);
  double low = INFINITY, high = -INFINITY;  // of what the metric takes: another body may be hotter
  for (std::size_t i = 0; i < f.in.initial.temperature.size(); ++i) {
    if (!takes(f.in, i)) continue;
    low = std::min(low, f.in.initial.temperature[i]);
    high = std::max(high, f.in.initial.temperature[i]);
  }
  if (!(high > low)) return problem("the start has one temperature: there is no isotherm to follow");
  const auto list = layers(f, *axis_of_profile(f.in));
  const double level = 0.5 * (low + high);
  const auto run = crossing(list, level, &Layer::run), truth = crossing(list, level, &Layer::truth);
  if (!truth) return problem("the reference has no place at the middle temperature");
  return run ? single(*run - *truth) : problem("no place of the run is at the middle temperature");
}

}  // namespace

const std::vector<Quantity>& profile_quantities() {
  static const std::vector<Quantity> list{
      {{"temperature_profile", "K",
        "difference of the mean temperatures of layers one spacing thick, across the reference's axis"},
       profile},
      {{"front", "m",
        "difference in place of the isotherm halfway between the first extremes, along the reference's axis"},
       front}};
  return list;
}

}  // namespace tripoint
