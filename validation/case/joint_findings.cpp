// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <numeric>

#include <Eigen/Dense>

#include "scene/joints.hpp"
#include "scene/meeting.hpp"
#include "validation/case/preflight.hpp"

/// What joints hold at the start, counted by their rows on the motions of the bodies.
namespace tripoint {
namespace {

using Kind = Joint::Kind;
using Row = Eigen::Matrix<double, 6, 1>;  // of the velocity at the origin, and the spin

constexpr double rank = 1e-9;  ///< of the largest pivot, below which a row says what others say

Eigen::Vector3d eigen(const Vec3& v) { return {v.x, v.y, v.z}; }

/// A point does not move along a direction.
Row at_point(const Vec3& place, const Vec3& along) {
  Row row;
  row << eigen(along), eigen(cross(place, along));
  return row;
}
Row of_turn(const Vec3& axis) {
  Row row;
  row << Eigen::Vector3d::Zero(), eigen(axis);
  return row;
}

constexpr std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

/// Relative motions that a joint does not allow.
std::vector<Row> held_by(const Joint& j) {
  std::vector<Row> rows;
  if (j.kind == Kind::distance) return {at_point(j.point, j.point - *j.other_point)};
  const auto across = [&](const Vec3& v) { return cross(*j.axis, v); };
  for (const Vec3& u : axes) rows.push_back(at_point(j.point, j.kind == Kind::slider ? across(u) : u));
  for (const Vec3& u : axes) {
    if (j.kind == Kind::hinge) rows.push_back(of_turn(across(u)));
    if (j.kind == Kind::slider || j.kind == Kind::fixed) rows.push_back(of_turn(u));
  }
  if (j.kind == Kind::universal) rows.push_back(of_turn(across(*j.other_axis)));
  return rows;
}

/// The free bodies that joints connect, and those joints.
struct Chain {
  std::vector<std::string> bodies;
  std::vector<const Joint*> joints;
};

class Joined {
 public:
  explicit Joined(const Scene& scene) : scene_(scene), chain_(scene.bodies.size()) {
    std::iota(chain_.begin(), chain_.end(), 0u);
    for (const Joint& j : scene.joints) {
      const long a = free_body(j.bodies[0]), b = free_body(j.bodies[1]);
      if (a < 0 || b < 0) continue;
      const std::size_t from = chain_[static_cast<std::size_t>(b)], to = chain_[static_cast<std::size_t>(a)];
      std::ranges::replace(chain_, from, to);
    }
  }
  [[nodiscard]] long free_body(const std::string& name) const {
    const auto found = std::ranges::find(scene_.bodies, name, &Body::name);
    return found == scene_.bodies.end() || found->motion != Motion::free ? -1 : found - scene_.bodies.begin();
  }
  [[nodiscard]] std::vector<Chain> chains() const {
    std::map<std::size_t, Chain> found;
    for (const Joint& j : scene_.joints) {
      const long some = std::max(free_body(j.bodies[0]), free_body(j.bodies[1]));
      Chain& c = found[chain_[static_cast<std::size_t>(some)]];
      c.joints.push_back(&j);
      for (const std::string& name : j.bodies)
        if (free_body(name) >= 0 && std::ranges::find(c.bodies, name) == c.bodies.end())
          c.bodies.push_back(name);
    }
    std::vector<Chain> out;
    for (auto& [number, c] : found) out.push_back(std::move(c));
    return out;
  }

 private:
  const Scene& scene_;
  std::vector<std::size_t> chain_;  ///< number of each body's
};

/// Rows of a chain on the motions of its bodies; the last column is the rate that a motor keeps.
class Rows {
 public:
  explicit Rows(const Chain& c) : chain_(c) {
    for (const Joint* j : c.joints)
      for (const Row& row : held_by(*j)) add(*j, row, 0.0);
  }
  void add_speed(const Joint& j) {
    add(j, j.kind == Kind::slider ? at_point(j.point, *j.axis) : of_turn(*j.axis), *j.motor->speed);
  }
  [[nodiscard]] Eigen::Index rank_of(bool with_speeds) const {
    const Eigen::Index wide = 6 * std::ssize(chain_.bodies) + (with_speeds ? 1 : 0);
    Eigen::MatrixXd A(std::ssize(rows_), wide);
    for (Eigen::Index k = 0; k < A.rows(); ++k)
      A.row(k) = rows_[static_cast<std::size_t>(k)].head(wide).transpose();
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
    qr.setThreshold(rank);
    return qr.compute(A).rank();
  }

 private:
  void add(const Joint& j, const Row& row, double speed) {
    Eigen::VectorXd whole = Eigen::VectorXd::Zero(6 * std::ssize(chain_.bodies) + 1);
    for (std::size_t side = 0; side < 2; ++side) {
      const auto at = std::ranges::find(chain_.bodies, j.bodies[side]);
      if (at != chain_.bodies.end())
        whole.segment<6>(6 * (at - chain_.bodies.begin())) += (side == 0 ? 1.0 : -1.0) * row;
    }
    whole.tail<1>()[0] = speed;
    rows_.push_back(whole);
  }

  const Chain& chain_;
  std::vector<Eigen::VectorXd> rows_;
};

std::string names(const std::vector<const Joint*>& joints) {
  std::vector<std::string> out;
  for (const Joint* j : joints) out.push_back(fmt::format("\"{}\"", j->name));
  return fmt::format("{}", fmt::join(out, ", "));
}

void judge(const Chain& c, std::vector<Finding>& out) {
  Rows rows(c);
  const Eigen::Index free = 6 * std::ssize(c.bodies) - rows.rank_of(false);
  if (free == 0) {
    out.push_back(
        {false,
         fmt::format("joints {} leave no freedom to {}: nothing of these moves; if it should, turn "
                     "an axis, or write another kind",
                     names(c.joints), c.bodies.size() == 1 ? "body \"" + c.bodies[0] + "\"" : "their bodies"),
         c.joints.front()->place});
    return;
  }
  std::vector<const Joint*> led;
  for (const Joint* j : c.joints)
    if (j->motor && j->motor->speed) {
      led.push_back(j);
      rows.add_speed(*j);
    }
  if (rows.rank_of(true) > rows.rank_of(false))
    out.push_back({false,
                   fmt::format("the motors of joints {} turn against each other or against joints: no motion "
                               "has all their speeds; give one of them an effort",
                               names(led)),
                   led.front()->place});
}

}  // namespace

std::vector<Finding> joint_findings(const Scene& scene) {
  std::vector<Finding> out;
  if (scene.joints.empty()) return out;
  for (const Chain& c : Joined(scene).chains()) judge(c, out);
  const std::vector<Meeting> met = scene.contact ? meetings(scene) : std::vector<Meeting>{};
  for (std::size_t n = 0; n < scene.bodies.size(); ++n) {
    const Body& b = scene.bodies[n];
    const auto names_it = [&](const Joint& j) { return j.bodies[0] == b.name || j.bodies[1] == b.name; };
    const auto pulls_it = [&](const Spring& s) { return s.body == b.name || s.other == b.name; };
    const auto meets_it = [&](const Meeting& m) { return m.a == n || m.b == n; };
    if (b.phase != Phase::rigid || b.motion != Motion::free || std::ranges::any_of(scene.joints, names_it) ||
        std::ranges::any_of(scene.springs, pulls_it) || std::ranges::any_of(met, meets_it))
      continue;
    out.push_back({false,
                   fmt::format("no joint, spring or contact holds body \"{}\": name it in a [[joint]], or "
                               "write motion = \"fixed\"",
                               b.name),
                   b.place});
  }
  return out;
}

}  // namespace tripoint
