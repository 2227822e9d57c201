// SPDX-License-Identifier: BSD-3-Clause
#include "solids/body_forces.hpp"

#include <algorithm>
#include <limits>

#include "state/body_table.hpp"

namespace tripoint {
namespace {

bool moves(const State& state, std::size_t b) {
  const Columns& t = state.bodies;
  if (!is_rigid(state, b)) return false;
  const bool free =
      t[field::body_alive][b] != 0 && t[field::body_motion][b] == static_cast<int>(Motion::free);
  return free || t[field::body_velocity][b] != Vec3{} || t[field::body_angular_velocity][b] != Vec3{};
}

/// A force that bodies feel: its place among State::forces, and its columns.
struct Felt {
  std::size_t number;
  Triple<const double> force;
  std::optional<Triple<const double>> couple;

  /// Moment about a member, beside that of the force on its centre.
  [[nodiscard]] Vec3 couple_at(std::size_t row) const { return couple ? couple->at(row) : Vec3{}; }
};

std::vector<Felt> felt_forces(const State& state) {
  std::vector<Felt> list;
  for (std::size_t k = 0; k < state.forces.size(); ++k) {
    const Force& f = state.forces[k];
    if (f.feels != Feels::all) continue;
    list.push_back({k, triple(state.particles, f.field.get()), {}});
    if (f.couple) list.back().couple = triple(state.particles, f.couple->get());
  }
  return list;
}

/// Numbers of a record that reported_members() makes.
std::ptrdiff_t width_of(const std::vector<Felt>& felt) { return 2 + 6 * std::ssize(felt); }

BodyForces no_forces(const State& state) {
  BodyForces none;
  none.count = state.forces.size();
  return none;
}

/// Calls visit(row, body, arm from its centre [m]) for each member of asked bodies that is this process's
/// own.
/// @param ids of those that may be members, in this order; empty: of all particles
template <class Visit>
void each_member(const State& state, const std::vector<char>& asked, std::span<const std::uint32_t> ids,
                 Visit visit) {
  const Particles& p = state.particles;
  const auto body = p[field::body];
  const auto centre = state.bodies[field::body_centre];
  const auto x = positions(p);
  const bool wraps = state.box.any();
  const auto look_at = [&](std::size_t id) {
    const std::size_t i = p.row(id);
    if (body[i] < 0 || !state.owns(i) || !asked[static_cast<std::size_t>(body[i])]) return;
    const auto b = static_cast<std::size_t>(body[i]);
    visit(i, b, (wraps ? state.unwrapped(i) : x.at(i)) - centre[b]);
  };
  for (const std::uint32_t id : ids) look_at(id);
  for (std::size_t id = 0; ids.empty() && id < p.size(); ++id) look_at(id);
}

void sum_forces(const State& state, const std::vector<char>& asked, std::span<const std::uint32_t> ids,
                std::vector<BodyForces>& sums) {
  const std::vector<Felt> felt = felt_forces(state);
  if (felt.empty()) return sums.clear();
  sums.resize(state.bodies.size());  // those of bodies that are not kept here stay, and nobody reads them
  each_kept_body(state, [&](std::size_t b) { sums[b] = no_forces(state); });
  each_member(state, asked, ids, [&](std::size_t i, std::size_t b, const Vec3& arm) {
    for (const Felt& f : felt) {
      const Vec3 force = f.force.at(i);
      sums[b].forces[f.number] += force;
      sums[b].torques[f.number] += cross(arm, force) + f.couple_at(i);
    }
  });
}

void put(std::vector<double>& to, const Vec3& force, const Vec3& torque) {
  to.insert(to.end(), {force.x, force.y, force.z, torque.x, torque.y, torque.z});
}

/// Records of the bodies that are wanted. @param width of a record, of which the second number is the body
std::vector<double> records_of(const std::vector<double>& records, const std::vector<char>& wanted,
                               std::ptrdiff_t width) {
  std::vector<double> some;
  for (auto record = records.begin(); record != records.end(); record += width)
    if (wanted[static_cast<std::size_t>(record[1])]) some.insert(some.end(), record, record + width);
  return some;
}

/// Data that a process sends to others for each own member that feels a force: number, body, and each force
/// with its torque. It sends only their sums by body above `most_reported` members. Where bodies have owners
/// these are members of one body, and the sum is told of a body that no other process has members of, too: it
/// has the order of one process.
constexpr std::size_t most_reported = 1024;
constexpr double sum_of_process = std::numeric_limits<double>::max();  ///< in place of a number

void put_sum(const std::vector<Felt>& felt, std::size_t b, const BodyForces& sum,
             std::vector<double>& reported) {
  const auto is_zero = [&](const Felt& f) {
    return sum.forces[f.number] == Vec3{} && sum.torques[f.number] == Vec3{};
  };
  if (std::ranges::all_of(felt, is_zero)) return;
  reported.insert(reported.end(), {sum_of_process, static_cast<double>(b)});
  for (const Felt& f : felt) put(reported, sum.forces[f.number], sum.torques[f.number]);
}

std::vector<double> reported_members(const State& state, const std::vector<char>& asked,
                                     const std::vector<BodyForces>& sums) {
  const Particles& p = state.particles;
  const BodyOwners& owners = state.body_owners;
  const std::vector<Felt> felt = felt_forces(state);
  const std::span<const int> number = state.halo->numbers();
  std::vector<char> one_by_one = asked;  // bodies whose members are told
  std::vector<std::size_t> counts(owners.any() ? sums.size() : 1);
  const auto count_of = [&](std::size_t b) -> std::size_t& { return counts[owners.any() ? b : 0]; };
  for (const std::size_t b : owners.kept())
    if (owners.is_alone(b)) one_by_one[b] = 0;

  std::vector<double> reported;
  each_member(state, one_by_one, owners.members(), [&](std::size_t i, std::size_t b, const Vec3& arm) {
    if (std::ranges::all_of(felt, [&](const Felt& f) { return f.force.at(i) == Vec3{}; }) ||
        ++count_of(b) > most_reported)
      return;
    reported.insert(reported.end(), {static_cast<double>(number[static_cast<std::size_t>(p[field::id][i])]),
                                     static_cast<double>(b)});
    for (const Felt& f : felt) put(reported, f.force.at(i), cross(arm, f.force.at(i)) + f.couple_at(i));
  });
  if (std::ranges::any_of(counts, [](std::size_t count) { return count > most_reported; })) {
    each_kept_body(state,
                   [&](std::size_t b) { one_by_one[b] = one_by_one[b] && count_of(b) <= most_reported; });
    reported = records_of(reported, one_by_one, width_of(felt));
  }
  each_kept_body(state, [&](std::size_t b) {
    if (asked[b] && !one_by_one[b]) put_sum(felt, b, sums[b], reported);
  });
  return reported;
}

/// What is told, where it is added up: by every process or, of each body, by its owner.
std::vector<double> brought(const State& state, const std::vector<double>& reported, std::size_t width) {
  return state.body_owners.any() ? state.body_owners.to_owners(state, reported, width)
                                 : state.halo->all_of(reported);
}

void take_sum(const std::vector<Felt>& felt, BodyForces& sum, const double* from) {
  for (const Felt& f : felt) {
    sum.forces[f.number] += Vec3{from[0], from[1], from[2]};
    sum.torques[f.number] += Vec3{from[3], from[4], from[5]};
    from += 6;
  }
}

/// The sums of all processes, in the order of one: members by their numbers, and what feels nothing adds
/// nothing.
void add_over_halo(const State& state, const std::vector<char>& asked, std::vector<BodyForces>& sums) {
  if (!state.halo || sums.empty()) return;
  const std::vector<Felt> felt = felt_forces(state);
  const auto width = static_cast<std::size_t>(width_of(felt));
  const std::vector<double> reported = brought(state, reported_members(state, asked, sums), width);
  each_kept_body(state, [&](std::size_t b) { sums[b] = no_forces(state); });
  for (const double* from : records_in_order(reported, width))
    take_sum(felt, sums[static_cast<std::size_t>(from[1])], from + 2);
  if (!state.body_owners.any()) return;
  state.body_owners.to_subscribers(
      state, width - 2,
      [&](std::size_t b, std::vector<double>& to) {
        for (const Felt& f : felt) put(to, sums[b].forces[f.number], sums[b].torques[f.number]);
      },
      [&](std::size_t b, const double* from) {
        sums[b] = no_forces(state);
        take_sum(felt, sums[b], from);
      });
}

}  // namespace

std::vector<BodyForces> forces_on_bodies(const State& state) {
  std::vector<BodyForces> sums(state.bodies.size(), no_forces(state));
  if (!sums.empty()) sum_forces(state, std::vector<char>(state.bodies.size(), 1), {}, sums);
  return sums;
}

void forces_on_moving_bodies(const State& state, std::vector<BodyForces>& sums) {
  if (state.bodies.size() == 0) return sums.clear();
  std::vector<char> asked(state.bodies.size());
  each_kept_body(state, [&](std::size_t b) { asked[b] = moves(state, b); });
  if (!state.body_owners.any() && std::ranges::find(asked, 1) == asked.end()) return sums.clear();
  sum_forces(state, asked, state.body_owners.members(), sums);
  add_over_halo(state, asked, sums);
}

}  // namespace tripoint
