// SPDX-License-Identifier: BSD-3-Clause
#include "effects/body_forces.hpp"

#include <algorithm>

#include "core/defect.hpp"
#include "effects/body_table.hpp"

namespace tripoint {
namespace {

bool moves(const World& world, std::size_t b) {
  const Columns& t = world.bodies;
  if (!is_rigid(world, b)) return false;
  const bool free = t[field::body_alive][b] != 0 && t[field::body_motion][b] == static_cast<int>(Motion::free);
  return free || t[field::body_velocity][b] != Vec3{} || t[field::body_angular_velocity][b] != Vec3{};
}

/// The columns of one force, or none where the scene does not have it.
class MaybeForce {
 public:
  MaybeForce(const Particles& p, const Field<double>& x, const Field<double>& y, const Field<double>& z) : there_(p.has(x.name)) {
    if (there_) force_ = triple(p, x, y, z);
  }
  [[nodiscard]] Vec3 at(std::size_t row) const { return there_ ? force_.at(row) : Vec3{}; }
  [[nodiscard]] bool there() const { return there_; }

 private:
  bool there_;
  Triple<const double> force_{};
};

void sum_forces(const World& world, const std::vector<char>& asked, std::vector<BodyForces>& sums) {
  const Particles& p = world.particles;
  static const double weaker = 1.0 - defect_size("bodies.force"), turned = 1.0 - defect_size("bodies.torque"), looser = 1.0 - defect_size("bodies.bonds");
  const MaybeForce F(p, field::force_x, field::force_y, field::force_z), D(p, field::viscous_force_x, field::viscous_force_y, field::viscous_force_z);
  const MaybeForce E(p, field::elastic_force_x, field::elastic_force_y, field::elastic_force_z);
  sums.clear();
  if (!F.there() && !E.there()) return;
  sums.assign(world.bodies.size(), {});
  const auto body = p[field::body];
  const auto centre = world.bodies[field::body_centre];
  const auto x = positions(p);
  static const bool wrapped_arms = defect_size("bodies.arm") > 0.0;
  const bool wraps = world.box.any() && !wrapped_arms;
  for (std::size_t id = 0; id < p.size(); ++id) {
    const std::size_t i = p.row(id);
    if (body[i] < 0 || !asked[static_cast<std::size_t>(body[i])]) continue;
    const auto b = static_cast<std::size_t>(body[i]);
    const Vec3 arm = (wraps ? world.unwrapped(i) : x.at(i)) - centre[b];
    const Vec3 pressure = weaker * F.at(i), viscous = weaker * D.at(i), elastic = looser * E.at(i);
    sums[b].pressure += pressure;
    sums[b].viscous += viscous;
    sums[b].elastic += elastic;
    sums[b].pressure_torque += turned * cross(arm, pressure);
    sums[b].viscous_torque += turned * cross(arm, viscous);
    sums[b].elastic_torque += cross(arm, elastic);
  }
}

}  // namespace

std::vector<BodyForces> forces_on_bodies(const World& world) {
  std::vector<BodyForces> sums;
  if (world.bodies.size() > 0) sum_forces(world, std::vector<char>(world.bodies.size(), 1), sums);
  return sums;
}

void forces_on_moving_bodies(const World& world, std::vector<BodyForces>& sums) {
  sums.clear();
  if (world.bodies.size() == 0) return;
  std::vector<char> asked(world.bodies.size());
  for (std::size_t b = 0; b < asked.size(); ++b) asked[b] = moves(world, b);
  if (std::ranges::find(asked, 1) != asked.end()) sum_forces(world, asked, sums);
}

}  // namespace tripoint
