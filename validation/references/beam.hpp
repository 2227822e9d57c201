// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace tripoint {

/// A straight beam, clamped at x = 0 [Timoshenko 1921]: bending and shear, rotary inertia of its sections.
struct Beam {
  double length = 0.0;   ///< L [m]
  double bending = 0.0;  ///< E I [N m2]
  double shear = 0.0;    ///< kappa G A [N]
  double mass = 0.0;     ///< rho A [kg/m]
  double rotary = 0.0;   ///< rho I [kg m]
};

/// A rigid body at the beam's end x = L; mass 0 = a free end.
struct BeamTip {
  double mass = 0.0;     ///< [kg]
  double inertia = 0.0;  ///< about its centre, across the plane of bending [kg m2]
  double offset = 0.0;   ///< of its centre beyond the end [m]
};

/// Displacement [m] and rotation of the section [rad].
struct BeamPoint {
  double displacement = 0.0, rotation = 0.0;
};

/// Static sag at x under the weight of beam and tip: w' = psi + V/(kappa G A), psi' = M/(E I), both
/// integrated in closed form.
/// @param gravity [m/s2]   @param x from the clamp, 0 <= x <= L [m]
[[nodiscard]] BeamPoint beam_sag(const Beam&, const BeamTip&, double gravity, double x);

/// Lowest angular frequency [rad/s]: root of the determinant of the end conditions. The exponential of their
/// matrix carries the equations of motion from clamp to end.
[[nodiscard]] double beam_frequency(const Beam&, const BeamTip&);

/// Shear coefficient of a rectangular section [Cowper 1966]: 10 (1 + nu)/(12 + 11 nu); in plane strain with
/// nu/(1 - nu) for nu.
[[nodiscard]] double rectangular_shear_coefficient(double poisson_ratio, bool plane_strain);

/// A beam of rectangular section, `height` along the deflection, `depth` across it [m]. In plane strain E is
/// E/(1 - nu^2).
/// @param kappa shear coefficient
[[nodiscard]] Beam rectangular_beam(double length, double height, double depth, double density, double young,
                                    double poisson_ratio, bool plane_strain, double kappa);

}  // namespace tripoint
