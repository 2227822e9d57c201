// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>

#include "validation/references/reference.hpp"

namespace tripoint {

enum class Phase : int;

/// A conducting scene along one axis: its ends, and whether it closes on itself.
struct BarAxis {
  std::size_t axis = 0;          ///< 0, 1, 2 for x, y, z
  double low = 0.0, high = 0.0;  ///< ends [m]
  bool periodic = false;
  [[nodiscard]] double length() const { return high - low; }
};

/// The ends of all bodies along an axis: of the domain where it is periodic, else of the bodies' boxes.
/// Without boxes: of their particles and half a spacing.
[[nodiscard]] BarAxis bar_along(std::size_t axis, const Job&, const InitialState&);
/// Likewise of one body.
[[nodiscard]] BarAxis body_along(std::size_t axis, std::size_t body, const Job&, const InitialState&);

/// The axis that a direction points along. @throws InputError when it points along none
std::size_t axis_of(const Vec3& direction, const std::string& what);

/// Conductivity and heat per volume of a phase of a body's material.
struct PhaseValues {
  double conductivity = 0.0, heat_per_volume = 0.0;  ///< k [W/m/K], rho c_p [J/m3/K]
  [[nodiscard]] double diffusivity() const { return conductivity / heat_per_volume; }
};
/// @throws InputError when the material has no conductivity or heat capacity
[[nodiscard]] PhaseValues phase_values(const Job&, std::size_t body, Phase);

/// Diffusivity k/(rho c_p) [m2/s] and effusivity sqrt(k rho c_p) [W s^0.5/m2/K] of a body's material, in the
/// phase in which the body begins.
/// @throws InputError when its material has no conductivity or heat capacity
[[nodiscard]] double diffusivity(const Job&, std::size_t body);
[[nodiscard]] double effusivity(const Job&, std::size_t body);
/// The one diffusivity of a scene. @throws InputError when its bodies differ
[[nodiscard]] double common_diffusivity(const Job&);

/// Base of the references of heat: a medium at rest of which only the temperature changes. Snapshots hold
/// everything else as it was.
class HeatReference : public Reference {
 public:
  enum class HeldEnds { refused, allowed };
  /// @throws InputError when a body moves, melts by event, or (unless allowed) holds its temperature
  HeatReference(const Job&, const InitialState&, HeldEnds = HeldEnds::refused);
  [[nodiscard]] Snapshot at(double time) const final;

 protected:
  [[nodiscard]] virtual double temperature(const Vec3& place, double time) const = 0;  ///< [K]
  InitialState initial_;

 private:
  Snapshot rest_;
};

}  // namespace tripoint
