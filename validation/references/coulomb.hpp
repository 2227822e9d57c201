// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace tripoint {

/// Motion of a block or a ball on a plane with Coulomb's friction, along one line, in the plane's frame. The
/// contact point slips at c = v - w r. While it slips, friction is mu times the normal force against it. When
/// c reaches 0 it sticks (the ball rolls) if the friction needed is within mu times the normal force.
/// Otherwise it slips on, downhill. While it slips, dv/dt = pull - grip sign(c) and dc/dt = pull - (1 +
/// share) grip sign(c).
class CoulombMotion {
 public:
  struct Plane {
    double pull = 0.0;  ///< acceleration along the plane, of gravity [m/s2]
    double grip = 0.0;  ///< mu times the acceleration into the plane [m/s2]
  };
  struct Contact {
    double share = 0.0;   ///< m r^2/I of a ball, 0 of a block that cannot turn [1]
    double radius = 1.0;  ///< of the ball [m]
  };
  struct State {
    double way = 0.0, speed = 0.0;   ///< of the centre [m], [m/s]
    double angle = 0.0, spin = 0.0;  ///< w = v/r where it rolls [rad], [rad/s]
  };
  CoulombMotion(const Plane&, const Contact&, double speed, double spin);
  [[nodiscard]] State at(double time) const;
  /// When slip ends, first [s]; infinite where it never does, 0 where it does not begin.
  [[nodiscard]] double slip_ends() const { return end_; }

 private:
  struct Phase {
    double acceleration = 0.0, spin_rate = 0.0;  ///< [m/s2], [rad/s2]
  };
  [[nodiscard]] Phase slipping(double direction) const;
  [[nodiscard]] Phase after() const;
  Plane plane_;
  Contact contact_;
  State start_;
  Phase first_;
  double end_ = 0.0;
};

}  // namespace tripoint
