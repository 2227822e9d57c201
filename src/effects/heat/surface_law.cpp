// SPDX-License-Identifier: BSD-3-Clause
#include "effects/heat/surface_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/geometry.hpp"

namespace tripoint::heat {
namespace {

constexpr double stefan_boltzmann = 5.670374419e-8;  ///< [W/m2/K4]

/// Newton's method on a convex balance gains all digits within a few rounds.
constexpr int most_rounds = 50;
constexpr double round_off = 1e-14;

}  // namespace

bool acts_on(const HeatSource& source, const Body& b) {
  if (!source.is_of_surfaces() || b.motion != Motion::fixed || b.phase == Phase::liquid) return false;
  return source.bodies.empty() || std::ranges::find(source.bodies, b.name) != source.bodies.end();
}

SurfaceSources::SurfaceSources(const Scene& scene) {
  constexpr double always = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < scene.sources.size(); ++n) {
    const HeatSource& s = scene.sources[n];
    if (!s.is_of_surfaces()) continue;
    One one{n,
            s.region ? inside_region(scene, *s.region) : [](const Vec3&) { return true; },
            s.flux.value_or(0.0),
            s.transfer_coefficient.value_or(0.0),
            stefan_boltzmann * s.emissivity.value_or(0.0),
            s.ambient.value_or(0.0),
            s.start > 0.0 ? s.start : -always,
            s.stop < scene.end_time ? s.stop : always};
    all_.push_back(std::move(one));
  }
  constexpr std::size_t most = std::numeric_limits<std::uint32_t>::digits;
  if (all_.size() > most)
    throw InputError(scene.sources[all_[most].number].place,
                     "at most 32 sources act through surfaces: join those that are alike");
}

std::uint32_t SurfaceSources::acting(const Scene& scene, const Body& b, const Vec3& place) const {
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < all_.size(); ++k)
    if (acts_on(scene.sources[all_[k].number], b) && all_[k].inside(place)) bits |= std::uint32_t{1} << k;
  return bits;
}

/// One evaluation serves the steps before and behind it: a source that begins or ends there counts half.
double SurfaceSources::One::share_at(double time) const {
  if (time == start || time == stop) return 0.5;
  return time > start && time < stop ? 1.0 : 0.0;
}

SurfaceSources::Surface SurfaceSources::balance(std::uint32_t acting, double time, double k_over_d,
                                                double T) const {
  Surface s{T, 0.0};
  for (int round = 0; round < most_rounds; ++round) {
    double in = k_over_d * (T - s.temperature);
    s.slope = 0.0;
    for (std::size_t n = 0; n < all_.size(); ++n) {
      if ((acting >> n & 1U) == 0) continue;
      const One& one = all_[n];
      const double share = one.share_at(time), Ts = s.temperature, Ta = one.ambient, Ts3 = Ts * Ts * Ts;
      in += share * (one.flux + one.coefficient * (Ta - Ts) + one.radiation * (Ta * Ta * Ta * Ta - Ts3 * Ts));
      s.slope += share * (one.coefficient + 4.0 * one.radiation * Ts3);
    }
    const double change = in / (k_over_d + s.slope);
    s.temperature += change;
    if (!(std::abs(change) > round_off * std::abs(s.temperature))) break;
  }
  return s;
}

}  // namespace tripoint::heat
