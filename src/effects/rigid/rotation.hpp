// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>

#include "core/quaternion.hpp"
#include "core/vec3.hpp"

/// Free rotation of a rigid body. L, its angular momentum in the world frame, is the state and is kept
/// exactly.
namespace tripoint {

/// Angular velocity in the world frame, I^-1 L (19) [rad/s]; an axis with moment 0 (truncated) does not turn.
/// @param to_world principal frame to world frame   @param moments principal [kg m2]
[[nodiscard]] Vec3 angular_velocity(const Quaternion& to_world, const Vec3& moments, const Vec3& L) noexcept;

/// Kinetic energy of rotation, 1/2 sum_k L_k^2/I_k over the axes that are not truncated [J].
[[nodiscard]] double rotation_energy(const Quaternion& to_world, const Vec3& moments, const Vec3& L) noexcept;

/// (19)-(20) as printed: omega = I^-1 L, then the orientation turns by omega dt. First order; over a long
/// spin the energy drifts to the axis of least inertia, by +152 % in a prototype. (The members are placed by
/// the orientation; moving each by dt omega x r, as a literal reading would, stretches the body.)
[[nodiscard]] Quaternion rotated_paper(const Quaternion& to_world, const Vec3& moments, const Vec3& L,
                                       double dt) noexcept;

/// Splitting into a symmetric top and one axis [Fasso 2003, J. Comput. Phys. 189, 527]. With 1/I_k = 1/I_mid
/// + d_k the isotropic part turns the body about L at |L|/I_mid, exactly and commuting with all else. Two
/// axes with the small d_k remain, in a symmetric sequence. Symplectic, second order, energy bounded for
/// ever; exact for bodies with two or three equal moments. The error is 10 to 20 times less than that of
/// NO_SQUISH at the same step: tests/effects/rotation_test.cpp.
[[nodiscard]] Quaternion rotated_corrected(const Quaternion& to_world, const Vec3& moments, const Vec3& L,
                                           double dt) noexcept;

/// Order of the principal axes in the splitting below, outer to inner; 0, 1, 2 = ascending moment.
using AxisOrder = std::array<std::size_t, 3>;

/// NO_SQUISH splitting [Miller et al. 2002, J. Chem. Phys. 116, 8649], the usual choice, kept to compare with
/// (presets of the engine): exact rotations about the three principal axes in a symmetric sequence. The two
/// monotone orders are the best.
[[nodiscard]] Quaternion rotated_no_squish(const Quaternion& to_world, const Vec3& moments, const Vec3& L,
                                           double dt, const AxisOrder& order) noexcept;

/// Moments of inertia by size: one below 2e-3 M spacing^2, a body thinner than about 4.5 % of a spacing,
/// becomes 0.
[[nodiscard]] Vec3 truncated(const Vec3& moments, double mass, double spacing) noexcept;

}  // namespace tripoint
