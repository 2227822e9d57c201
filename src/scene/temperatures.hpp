// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <optional>

#include "scene/scene.hpp"

/// The temperatures that a scene can ever have. All heat comes from entries of its file: temperatures of
/// bodies and inflows, and held temperatures.
namespace tripoint {

/// Least and greatest temperature [K] that anything in a scene can reach. A step of conduction within its
/// bound keeps to the range of its neighbours (model 8.10, a discrete maximum principle). No effect but a
/// change of phase turns other energy into heat.
struct TemperatureRange {
  double least = INFINITY, greatest = -INFINITY;
  [[nodiscard]] bool empty() const noexcept { return !(least <= greatest); }
};
[[nodiscard]] TemperatureRange temperatures_of(const Scene&);

/// Whether heat can flow in and out of a body: it has a temperature, and its material conducts.
[[nodiscard]] bool has_heat(const Body&, const Material&);

/// The one temperature [K] of a scene whose bodies, inflows and events all have the same: no heat flows, and
/// none ever will. Empty where they differ, a body has none or does not conduct, or something changes its
/// phase.
[[nodiscard]] std::optional<double> equal_temperature(const Scene&);

}  // namespace tripoint
