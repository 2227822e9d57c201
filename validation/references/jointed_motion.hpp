// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <vector>

#include <Eigen/Dense>

#include "files/job.hpp"
#include "files/trajectory.hpp"

namespace tripoint {

/// Motion of rigid bodies with joints, from the equations of Newton and Euler with the joints as constraints
/// on accelerations: M a = f + G' lambda, G a = -dG/dt v [Hairer & Wanner 1996, VII.1]. Redundant rows are
/// taken by the solution of least norm. Steps of extrapolation [Hairer, Norsett & Wanner 1993, II.9] keep
/// each an error of 1e-11; after each, places and velocities return to the constraints. Friction of joints
/// and limits change the equations at events, whose times are found: a joint starts, stops, hits its limit
/// and leaves it. It shares no code with any engine. tests/references/jointed_test.cpp compares it with
/// published digits.
class JointedMotion {
 public:
  /// @throws InputError for bodies that are not rigid, that are driven, and for limits of a hinge of half a
  /// turn or more
  explicit JointedMotion(const Job&);
  /// States of all solid bodies by their rows [SI], the world's frame.
  [[nodiscard]] std::vector<BodyState> at(double time) const;

 private:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;

  /// A free body: numbers 7 n to 7 n + 6 of a place are its centre and quaternion (w, x, y, z), numbers 6 n
  /// to 6 n + 5 of a motion its velocity and its angular velocity in the world.
  struct Free {
    std::size_t job_row;
    double mass;
    Vec3 inertia;  ///< principal moments [kg m2]
    Quaternion axes;
  };
  struct State {
    Vector place, motion;
  };
  /// Something that moves with a body, or stays: a point, or a direction.
  struct Mark {
    Vec3 value, rate, bias;  ///< bias: of its second derivative, what no acceleration makes
    Vec3 arm;                ///< it turns by cross(angular acceleration, arm)
    int body = -1;           ///< number of the free body; -1 = the world
    bool moves = false;      ///< with the centre of the body too
  };
  using Sum = std::vector<std::pair<double, Mark>>;
  /// Constraints: values, G, and dG/dt v.
  struct Rows {
    std::vector<double> value, bias;
    std::vector<Vector> gradient;
    std::vector<int> joint;  ///< number of the joint whose coordinate a row holds; -1: a constraint
  };
  struct Ends;
  static constexpr double event_error = 1e-11;  ///< of a margin, in its unit
  /// What a joint does between two events.
  struct Mode {
    int slides = 0;  ///< direction of its rate where it has friction; 0: it is held
    int limit = 0;   ///< it rests on the lower (-1) or upper (1) limit
  };
  using Modes = std::vector<Mode>;
  struct Coordinate {
    double value = 0.0, rate = 0.0;  ///< [rad], [rad/s] or [m], [m/s]
  };
  struct Moment {
    State state;
    Modes modes;
  };

  [[nodiscard]] int number_of(const std::string& body) const;
  [[nodiscard]] Quaternion turn(const State&, int body) const;
  [[nodiscard]] Mark direction(const State&, int body, const Vec3& at_start) const;
  [[nodiscard]] Mark point(const State&, int body, const Vec3& at_start) const;
  [[nodiscard]] Ends ends(const State&, const Joint&) const;
  void add_row(Rows&, const Sum&, const Sum&, double target) const;
  void add_joint(Rows&, const State&, const Joint&) const;
  [[nodiscard]] Coordinate coordinate(const State&, const Joint&) const;
  void add_coordinate(Rows&, const State&, std::size_t joint, double speed) const;
  /// @param speeds also the rows of motors of a given speed, and of joints that friction or a limit holds:
  /// they hold rates alone
  [[nodiscard]] Rows rows(const State&, bool speeds) const;
  [[nodiscard]] Vector inverse_mass_times(const State&, const Vector&) const;
  [[nodiscard]] Vector forces(const State&) const;
  void push(Vector& force, const State&, int body, const Vec3& value, const Vec3& at) const;
  void joint_forces(Vector&, const State&, std::size_t joint) const;
  void spring_force(Vector&, const State&, const Spring&) const;
  /// lambda of least norm with G M^-1 G' lambda = right.
  [[nodiscard]] Vector correction(const State&, const Rows&, const Vector& right,
                                  Vector* lambda = nullptr) const;
  [[nodiscard]] State rate(const State&) const;
  [[nodiscard]] State midpoint(const State&, const State& rate, double interval, int steps) const;
  void project(State&) const;
  /// One step of at most H, as the last two columns agree. @return its size; s moves on
  double step(State& s, double H) const;
  void advance(State&, double interval) const;

  [[nodiscard]] bool has_events() const;
  /// Least of what must not be negative until the next event, in its own unit.
  [[nodiscard]] double margin(const State&) const;
  /// Impulses of limits that are touched.
  void hit(State&) const;
  /// Modes by the forces that hold joints, one change after another.
  void settle(const State&) const;
  [[nodiscard]] std::vector<double> reactions(const State&) const;  ///< of held coordinates, by joint
  double to_event(State&, double H) const;  ///< moves to the first event. @return its time [s]
  void pass_event(State&) const;

  Job job_;
  std::vector<Free> free_;
  mutable std::map<double, Moment> known_;  ///< by time
  mutable Modes modes_;                     ///< of the state that moves on
  mutable double step_ = 0.0;               ///< that the last error allowed [s]
};

}  // namespace tripoint
