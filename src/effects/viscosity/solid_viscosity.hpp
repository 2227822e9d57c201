// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "solids/fusion.hpp"

/// mu of a solid in (8) and in contacts. The paper gives every particle a mu and interpolates it linearly
/// between t_solid and t_melt (Fig. 5).
namespace tripoint::viscosity {

/// mu of matter with this mu as a solid and as a liquid, at liquid fraction f: linear, as Fig. 5 has it [Pa
/// s].
[[nodiscard]] inline double viscosity_between(double solid, double liquid, double f) noexcept {
  return solid + f * (liquid - solid);
}

/// Viscosity of the solids of a scene: `material.solid_viscosity` where (8) is as printed and the key is
/// given, else `scene.contact_viscosity` [Pa s].
class SolidViscosity {
 public:
  explicit SolidViscosity(const Scene&);
  /// Value for a solid particle [Pa s].
  [[nodiscard]] double operator()(const State&, std::size_t row) const;
  /// Whether that of any solid changes with its temperature.
  [[nodiscard]] bool follows_temperature() const noexcept { return follows_; }

 private:
  struct OfMaterial {
    double solid, liquid;  ///< [Pa s]
    bool stage;            ///< elastic between t_solid and t_melt, as printed
  };
  std::vector<OfMaterial> of_;
  bool follows_ = false;
};

}  // namespace tripoint::viscosity
