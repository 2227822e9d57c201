// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "state/state.hpp"

/// Joints as rows: what each holds, and how an impulse along it moves the bodies (model 8.17).
namespace tripoint::rigid {

/// Where a body is, in place of its row: the end of a drift.
struct Pose {
  Vec3 centre;
  Quaternion turn;
};
using Poses = std::vector<Pose>;

/// One constraint: its value, and what changes it by velocity and spin of at most two free bodies. Its
/// impulse lies in a range, and makes its rate `target` less `compliance` times it.
struct JointRow {
  struct End {
    long body = -1;
    Vec3 linear, angular;
  };
  double value = 0.0;
  std::array<End, 2> ends;
  double target = 0.0;      ///< rate that it has [m/s] or [rad/s]
  double compliance = 0.0;  ///< of a damper: 1/(c dt) [1/kg] or [1/(kg m2)]
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  long joint = -1;  ///< number of the joint whose coordinate it is, so that it may do work; -1: a constraint
};
using JointRows = std::vector<JointRow>;

[[nodiscard]] Poses present_poses(const State&);
/// The constraints of all joints.
[[nodiscard]] JointRows rows_of(const State&, const Poses&);
[[nodiscard]] JointRows rows_of(const State&, const Poses&, const Joint&);
/// The coordinate of a hinge or slider, an angle [rad], -pi to pi, or a way [m], and the row along it.
/// @param origin that the value of the row counts from
[[nodiscard]] JointRow coordinate_row(const State&, const Poses&, std::size_t joint, double origin = 0.0);

/// left M^-1 right', with the inertia of the present places.
[[nodiscard]] Eigen::MatrixXd mobility(const State&, const JointRows& left, const JointRows& right);
[[nodiscard]] Eigen::VectorXd rates(const State&, const JointRows&);
/// Solution of least norm: rows that say the same share it.
[[nodiscard]] Eigen::VectorXd least(const Eigen::MatrixXd& A, const Eigen::VectorXd& right);
/// Impulses after which each row has its target rate, within its range: principal pivoting [Murty 1974].
[[nodiscard]] Eigen::VectorXd ranged(const Eigen::MatrixXd& A, const Eigen::VectorXd& rate,
                                     const JointRows& rows);
/// Adds impulses; a row's multiplier is theirs along it.
void give(State&, const JointRows&, const Eigen::VectorXd& impulse);

}  // namespace tripoint::rigid
