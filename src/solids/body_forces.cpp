// SPDX-License-Identifier: BSD-3-Clause
#include "solids/body_forces.hpp"

#include <algorithm>

#include "world/body_table.hpp"

namespace tripoint {
namespace {

bool moves(const World& world, std::size_t b) {
  const Columns& t = world.bodies;
  if (!is_rigid(world, b)) return false;
  const bool free = t[field::body_alive][b] != 0 && t[field::body_motion][b] == static_cast<int>(Motion::free);
  return free || t[field::body_velocity][b] != Vec3{} || t[field::body_angular_velocity][b] != Vec3{};
}

/// A force that bodies feel: its place among World::forces, and its columns.
struct Felt {
  std::size_t number;
  Triple<const double> force;
};

std::vector<Felt> felt_forces(const World& world) {
  std::vector<Felt> list;
  for (std::size_t k = 0; k < world.forces.size(); ++k) {
    const Force& f = world.forces[k];
    if (f.feels != Feels::all) continue;
    list.push_back({k, triple(world.particles, f.x, f.y, f.z)});
  }
  return list;
}

void sum_forces(const World& world, const std::vector<char>& asked, std::vector<BodyForces>& sums) {
  const Particles& p = world.particles;
  const std::vector<Felt> felt = felt_forces(world);
  sums.clear();
  if (felt.empty()) return;
  sums.assign(world.bodies.size(), {});
  for (BodyForces& sum : sums) sum.count = world.forces.size();
  const auto body = p[field::body];
  const auto centre = world.bodies[field::body_centre];
  const auto x = positions(p);
  const bool wraps = world.box.any();
  for (std::size_t id = 0; id < p.size(); ++id) {
    const std::size_t i = p.row(id);
    if (body[i] < 0 || !world.owns(i) || !asked[static_cast<std::size_t>(body[i])]) continue;
    const auto b = static_cast<std::size_t>(body[i]);
    const Vec3 arm = (wraps ? world.unwrapped(i) : x.at(i)) - centre[b];
    for (const Felt& f : felt) {
      const Vec3 force = f.force.at(i);
      sums[b].forces[f.number] += force;
      sums[b].torques[f.number] += cross(arm, force);
    }
  }
}

/// Every process has the members that are its own.
void add_over_halo(const World& world, std::vector<BodyForces>& sums) {
  if (!world.halo || sums.empty()) return;
  std::vector<double> numbers;
  const auto each = [&](auto visit) {
    for (BodyForces& sum : sums)
      for (std::size_t k = 0; k < sum.count; ++k)
        for (Vec3* v : {&sum.forces[k], &sum.torques[k]}) visit(*v);
  };
  each([&](const Vec3& v) { numbers.insert(numbers.end(), {v.x, v.y, v.z}); });
  world.halo->add(numbers);
  const double* from = numbers.data();
  each([&](Vec3& v) { v = {from[0], from[1], from[2]}, from += 3; });
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
  if (std::ranges::find(asked, 1) == asked.end()) return;
  sum_forces(world, asked, sums);
  add_over_halo(world, sums);
}

}  // namespace tripoint
