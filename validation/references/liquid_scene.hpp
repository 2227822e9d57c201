// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

#include "core/not_a_number.hpp"
#include "scene/scene.hpp"
#include "validation/references/functions.hpp"
#include "validation/references/heat_scene.hpp"

namespace tripoint {

/// State of an exact flow at one place and time; not-a-number is a value that it does not know.
struct LiquidState {
  Vec3 velocity{not_a_number, not_a_number, not_a_number};  ///< [m/s]
  double pressure = not_a_number;                           ///< [Pa]
  double density = not_a_number;                            ///< [kg/m3]
};

/// Base of the exact flows: fields of place and time. A particle is compared with the field where it is.
class LiquidReference : public Reference {
 public:
  /// @throws InputError when the scene has no liquid
  LiquidReference(const Job&, const InitialState&);
  [[nodiscard]] Snapshot at(double time) const final { return fields(initial_.position, time); }
  [[nodiscard]] Snapshot truth_for(const Snapshot& now) const final { return fields(now.position, now.time); }

 protected:
  [[nodiscard]] virtual LiquidState state(const Vec3& place, double time, std::size_t particle) const = 0;
  /// States of bodies, one row each; none unless overridden.
  [[nodiscard]] virtual std::vector<BodyState> bodies(double) const { return {}; }
  [[nodiscard]] bool is_liquid(std::size_t particle) const {
    return initial_.phase[particle] == static_cast<int>(Phase::liquid);
  }
  InitialState initial_;

 private:
  [[nodiscard]] Snapshot fields(const std::vector<Vec3>& places, double time) const;
};

[[nodiscard]] const Material& material_of_body(const Job&, std::size_t body);
/// Rows in Job::bodies that are liquid.
[[nodiscard]] std::vector<std::size_t> liquid_bodies(const Job&);
/// The scene's one liquid. @throws InputError when there are more, or none
[[nodiscard]] std::size_t only_liquid(const Job&, const char* function);
/// Dynamic over rest density [m2/s]. @throws InputError when the liquid is inviscid
[[nodiscard]] double kinematic_viscosity(const Job&, std::size_t body);
/// Speed of sound of the equation of state, sqrt(k rho_ref/rho0) corrected, sqrt(k) as printed [m/s]; one k a
/// scene.
[[nodiscard]] double state_sound_speed(const Job&, std::size_t body);
/// Row in Job::bodies of the only body of this motion that is not liquid, or of the one named. @throws
/// InputError
[[nodiscard]] std::size_t solid_body(const ReferenceInput&, Motion, const char* function);

}  // namespace tripoint
