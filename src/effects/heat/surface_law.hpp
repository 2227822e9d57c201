// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "scene/scene.hpp"

namespace tripoint::heat {

/// Sources of heat of a scene that act through surfaces, and where each of them acts.
class SurfaceSources {
 public:
  explicit SurfaceSources(const Scene&);
  /// A bit for each source that acts at this place of the body's surface; 0 = none.
  [[nodiscard]] std::uint32_t acting(const Scene&, const Body&, const Vec3& place) const;

  /// Temperature of the surface, and how the heat through it changes with that temperature.
  struct Surface {
    double temperature = 0.0;  ///< [K]
    double slope = 0.0;        ///< heat that goes out per area and kelvin [W/m2/K]
  };
  /// Surface with the heat balance k (T_s - T)/d = q + h (T_a - T_s) + e s (T_a^4 - T_s^4), summed over the
  /// sources that act.
  /// @param k_over_d conductivity over the depth of a particle below the surface [W/m2/K] @param T of that
  /// particle [K]
  [[nodiscard]] Surface balance(std::uint32_t acting, double time, double k_over_d, double T) const;

 private:
  struct One {
    std::size_t number;  ///< in Scene::sources
    std::function<bool(const Vec3&)> inside;
    double flux, coefficient, radiation, ambient;  ///< [W/m2], [W/m2/K], [W/m2/K4], [K]
    double start, stop;
    [[nodiscard]] double share_at(double time) const;
  };
  std::vector<One> all_;
};

/// Whether a source acts on a body that it may act on.
[[nodiscard]] bool acts_on(const HeatSource&, const Body&);

}  // namespace tripoint::heat
