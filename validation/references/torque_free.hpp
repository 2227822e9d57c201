// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "core/quaternion.hpp"
#include "core/vec3.hpp"

namespace tripoint {

/// Free rotation of a rigid body about its centre of mass [Landau & Lifshitz, Mechanics, section 37].
/// The angular velocity in the principal frame is (a1 cn, a2 sn, a3 dn)(rate t + start; modulus), Jacobi's
/// elliptic functions. The precession about the constant angular momentum is the integral of a periodic
/// function of time. It is stored per panel of one period, so that a late time costs no more than an early
/// one. Everything is formed in long double. Its checks: an eighth-order ODE in
/// tests/references/torque_free_test.cpp, scipy's in torque_free.py.
class TorqueFree {
 public:
  /// @param inertia principal moments [kg m2], each >= 0 (0: a line's own axis, about which it cannot spin)
  /// @param axes principal frame to world at time 0   @param spin angular velocity at time 0, world [rad/s]
  /// @throws InputError on the separatrix, where the motion tends to the middle axis and never flips again
  TorqueFree(const Vec3& inertia, const Quaternion& axes, const Vec3& spin);

  /// Rotation of the body since time 0, world frame.
  [[nodiscard]] Quaternion rotation(double time) const;
  /// Angular velocity at a time, world frame [rad/s].
  [[nodiscard]] Vec3 angular_velocity(double time) const;
  /// Times in (0, end] at which the component along the middle principal axis changes sign [s].
  [[nodiscard]] std::vector<double> flips(double end) const;
  /// Time between two flips [s]; empty for a steady spin.
  [[nodiscard]] std::optional<double> flip_interval() const;
  /// A spin of constant axis: about a principal axis, or of a symmetric inertia.
  [[nodiscard]] bool steady() const { return steady_; }

 private:
  using Real = long double;
  using Triple = std::array<Real, 3>;
  using Matrix = std::array<Triple, 3>;  // rows

  void choose_axes(const Vec3& inertia, const Quaternion& axes, const Vec3& spin);
  void solve(const Triple& omega);
  void store_panels();
  [[nodiscard]] Triple omega(Real time) const;  // principal frame
  // Principal to world, but for the constant factor start_
  [[nodiscard]] Matrix attitude(Real time) const;
  [[nodiscard]] Real precession_rate(Real time) const;  // about L [rad/s]
  [[nodiscard]] Real precession(Real time) const;       // [rad]
  [[nodiscard]] Real integral(Real from, Real to) const;

  bool steady_ = false;
  Vec3 spin_;           // steady: the constant angular velocity, world
  Matrix principal_{};  // principal to world at time 0, axes ordered for the elliptic solution
  Triple inertia_{}, amplitude_{};
  Real modulus_ = 0, rate_ = 0, start_phase_ = 0, quarter_ = 0, momentum_ = 0;
  Matrix start_{};            // world from intermediate frame
  std::vector<Real> panels_;  // precession at the panel ends of one period
  Real panel_ = 0;            // length of a panel [s]
};

}  // namespace tripoint
