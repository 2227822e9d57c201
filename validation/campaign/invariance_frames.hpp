// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>

#include "validation/campaign/invariance.hpp"

/// Action of the changes on vectors and numbers of scenes and frames.
namespace tripoint {

/// A turn or mirroring of space that only swaps axes and signs, so that no bit of a component is lost.
struct SignedAxes {
  std::array<std::size_t, 3> from;  ///< new component a is sign[a] times the old component from[a]
  std::array<double, 3> sign;
  double determinant;  ///< 1 a rotation, -1 a mirroring
  [[nodiscard]] Vec3 vector(const Vec3& v) const {
    return {sign[0] * v[from[0]], sign[1] * v[from[1]], sign[2] * v[from[2]]};
  }
  /// Axial vectors: spins, torques, angular momenta.
  [[nodiscard]] Vec3 axial(const Vec3& v) const { return determinant * vector(v); }
  [[nodiscard]] Quaternion rotation(const Quaternion& q) const;
  [[nodiscard]] SignedAxes inverse() const;
};

void turn(const SignedAxes&, ChangedScene&);
void turn(const SignedAxes&, Snapshot&);

/// New units of length, time and mass, as powers of 2. A number in the code that has a unit then shows;
/// round-off does not.
struct Units {
  double length, time, mass;
};

void measure_in(const Units&, ChangedScene&);
void measure_in(const Units&, Snapshot&);

/// Seen by an observer at rest whom the frame's own scene passes with this velocity [m/s].
void ride(const Vec3& velocity, Snapshot&);

}  // namespace tripoint
