// SPDX-License-Identifier: BSD-3-Clause
#include "solids/body_forces.hpp"

#include <algorithm>
#include <limits>

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

/// Calls visit(row, body, arm from its centre [m]) for each member of asked bodies that is this process's own, in order of id.
template <class Visit>
void each_member(const World& world, const std::vector<char>& asked, Visit visit) {
  const Particles& p = world.particles;
  const auto body = p[field::body];
  const auto centre = world.bodies[field::body_centre];
  const auto x = positions(p);
  const bool wraps = world.box.any();
  for (std::size_t id = 0; id < p.size(); ++id) {
    const std::size_t i = p.row(id);
    if (body[i] < 0 || !world.owns(i) || !asked[static_cast<std::size_t>(body[i])]) continue;
    const auto b = static_cast<std::size_t>(body[i]);
    visit(i, b, (wraps ? world.unwrapped(i) : x.at(i)) - centre[b]);
  }
}

void sum_forces(const World& world, const std::vector<char>& asked, std::vector<BodyForces>& sums) {
  const std::vector<Felt> felt = felt_forces(world);
  sums.clear();
  if (felt.empty()) return;
  sums.assign(world.bodies.size(), {});
  for (BodyForces& sum : sums) sum.count = world.forces.size();
  each_member(world, asked, [&](std::size_t i, std::size_t b, const Vec3& arm) {
    for (const Felt& f : felt) {
      const Vec3 force = f.force.at(i);
      sums[b].forces[f.number] += force;
      sums[b].torques[f.number] += cross(arm, force);
    }
  });
}

void put(std::vector<double>& to, const Vec3& force, const Vec3& torque) {
  to.insert(to.end(), {force.x, force.y, force.z, torque.x, torque.y, torque.z});
}

/// Data that a process sends to the others for each own member that feels a force: number, body, and each force with its torque.
/// Above `most_told` members it sends only their sums by body.
constexpr std::size_t most_told = 1024;
constexpr double sum_of_process = std::numeric_limits<double>::max();  ///< in place of a number

std::vector<double> told_members(const World& world, const std::vector<char>& asked, const std::vector<BodyForces>& sums) {
  const Particles& p = world.particles;
  const std::vector<Felt> felt = felt_forces(world);
  const std::span<const int> number = world.halo->numbers();
  std::vector<double> told;
  std::size_t members = 0;
  each_member(world, asked, [&](std::size_t i, std::size_t b, const Vec3& arm) {
    if (std::ranges::all_of(felt, [&](const Felt& f) { return f.force.at(i) == Vec3{}; }) || ++members > most_told) return;
    told.insert(told.end(), {static_cast<double>(number[static_cast<std::size_t>(p[field::id][i])]), static_cast<double>(b)});
    for (const Felt& f : felt) put(told, f.force.at(i), cross(arm, f.force.at(i)));
  });
  if (members <= most_told) return told;
  told.clear();
  for (std::size_t b = 0; b < sums.size(); ++b) {
    if (!asked[b]) continue;
    told.insert(told.end(), {sum_of_process, static_cast<double>(b)});
    for (const Felt& f : felt) put(told, sums[b].forces[f.number], sums[b].torques[f.number]);
  }
  return told;
}

/// The sums of all processes, in the order of one: members by their numbers, and what feels nothing adds nothing.
void add_over_halo(const World& world, const std::vector<char>& asked, std::vector<BodyForces>& sums) {
  if (!world.halo || sums.empty()) return;
  const std::vector<double> told = world.halo->all_of(told_members(world, asked, sums));
  const std::vector<Felt> felt = felt_forces(world);
  for (BodyForces& sum : sums) {
    sum.forces = {};
    sum.torques = {};
  }
  for (const double* from : records_in_order(told, 2 + 6 * felt.size())) {
    BodyForces& sum = sums[static_cast<std::size_t>(from[1])];
    from += 2;
    for (const Felt& f : felt) {
      sum.forces[f.number] += Vec3{from[0], from[1], from[2]};
      sum.torques[f.number] += Vec3{from[3], from[4], from[5]};
      from += 6;
    }
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
  if (std::ranges::find(asked, 1) == asked.end()) return;
  sum_forces(world, asked, sums);
  add_over_halo(world, asked, sums);
}

}  // namespace tripoint
