// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "particles/halo.hpp"
#include "particles/neighbours.hpp"
#include "particles/particles.hpp"
#include "scene/scene.hpp"
#include "state/body_owners.hpp"
#include "state/energy_account.hpp"
#include "state/force.hpp"
#include "state/guarded.hpp"
#include "state/ledger.hpp"
#include "state/rows_loop.hpp"
#include "state/step_numbers.hpp"

namespace tripoint {

/// Particles whose phase, body or lists changed in this step. Phase change and fracture write it, and all
/// effects follow it. Ids, each once, ascending; in a shared scene those of the whole scene.
struct Change {
  std::vector<std::uint32_t> born;  ///< flowed in: new particles, whose columns are still zero
  /// About to leave the scene; empty again where they have left
  std::vector<std::uint32_t> leaving;
  bool left = false;  ///< particles have left: rows and ids are others than before
  std::vector<std::uint32_t> melted, frozen;
  std::vector<std::uint32_t> regrouped;  ///< of another phase or body than before
  std::vector<std::uint32_t> relisted;   ///< with other bonds or excluded pairs than before
  /// Regrouped by phase change: row of the body before, -1 for liquid
  std::map<std::uint32_t, int> came_from;
  std::vector<std::size_t> bodies;  ///< rows of bodies that gained or lost members, ascending
  /// Body row -> kinetic energy that joining cost [J], as the rigid effect finds it
  std::map<std::size_t, double> kinetic_lost;
  [[nodiscard]] bool empty() const {
    return born.empty() && regrouped.empty() && relisted.empty() && bodies.empty() && !left;
  }
  /// Forgets all, and keeps the memory of the lists.
  void clear() {
    for (auto* list : {&born, &leaving, &melted, &frozen, &regrouped, &relisted}) list->clear();
    left = false;
    came_from.clear();
    bodies.clear();
    kinetic_lost.clear();
  }
};

/// All that a step changes, and the data that it works with.
struct State {
  Scene scene;
  Particles particles;
  Columns bodies;                       ///< one row for each solid body that ever existed
  std::vector<std::string> body_names;  ///< of each row
  PeriodicBox box;
  Bonds bonds;                           ///< body neighbours of the members of solids
  ExcludedPairs own;                     ///< members of deformable bodies that meet through their bonds alone
  Change change;                         ///< of this step
  std::optional<Neighbours> neighbours;  ///< none where no effect has pairs
  EnergyAccounts accumulated;
  /// That the effects make, in the order in which they are summed
  std::vector<Force> forces;
  /// Energy that numerical terms dissipate on purpose: not a time-integration error
  std::vector<EnergyAccount> numerical;
  /// Columns that are checked after every step, in the order in which it writes them
  std::vector<Guarded> guarded;
  std::vector<Bounded> bounded;         ///< columns whose whole numbers a checkpoint is held to
  std::vector<Field<double>> positive;  ///< columns whose values a checkpoint must have above 0
  /// Entries of the ledger that the guard of energy takes by a rule of their own
  std::vector<GuardedEntry> guarded_entries;
  /// Columns of bodies that are sums over this process's own particles
  std::vector<Field<double>> body_sums;
  StepNumbers step_numbers;  ///< that effects keep from step to step
  double time = 0.0;         ///< [s]
  /// End of the step that is being taken, exactly as the loop will set it [s]
  double next_time = 0.0;
  int threads = 1;
  /// Rotation by NO_SQUISH in this order, to compare with
  std::optional<std::array<std::size_t, 3>> axis_order;
  bool placed = false;  ///< members of all rigid bodies have been put to their places by the poses of these
  bool moved = true;    ///< positions differ from those of the last rates

  bool can_hold_sums = false;  ///< a pass of density may leave out what PairWork::held names
  bool holds_sums = false;     ///< the present one does

  /// By id, 1 where a step reads only the place of a fixed particle, as behind the face of a wall; empty: all
  /// is read.
  std::vector<char> unread;
  /// True when the values of fixed particles that no step needs (forces, densities behind walls) are up to
  /// date
  bool fixed_formed = true;
  bool forms_fixed = false;  ///< these values are being formed now, because somebody asks for them

  /// Those that hold the rest of the scene; null: this process holds all, if only for now
  Halo* halo = nullptr;
  BodyOwners body_owners;  ///< none where this process holds all
  /// Of each row, 1 where it is a copy of another's particle; empty where this process holds all
  std::vector<char> ghosts;

  [[nodiscard]] double support() const { return scene.support_ratio * scene.spacing; }
  /// Whether a row is this process's own: sums over particles are sums over these.
  [[nodiscard]] bool owns(std::size_t row) const { return ghosts.empty() || ghosts[row] == 0; }
  /// Whether this process reports values that all hold alike.
  [[nodiscard]] bool is_first() const { return !halo || halo->is_first(); }
  /// Whether this process, among those that keep the body, reports its energies.
  [[nodiscard]] bool reports(std::size_t body) const {
    return body_owners.any() ? body_owners.is_here(body) : is_first();
  }
  /// Rows that take part in a step.
  [[nodiscard]] Rows awake() const { return {0, particles.awake()}; }
  /// Rows whose forces are formed now: moving ones, or fixed ones where forms_fixed says so.
  [[nodiscard]] Rows formed() const {
    return forms_fixed ? Rows{particles.moving(), particles.size()} : Rows{0, particles.moving()};
  }
  /// Whether one of the processes says so. All call it.
  [[nodiscard]] bool anywhere(bool here) const {
    double some = here ? 1.0 : 0.0;
    add_up({&some, 1});
    return some > 0.0;
  }
  /// Each number becomes its sum over all processes. All call it.
  void add_up(std::span<double> numbers) const {
    if (halo) halo->add(numbers);
  }
  /// Ghosts take what their owners have. @param by_id records of doubles, one for each particle
  template <class Records>
  void hand_to_ghosts(Records& by_id) const;
  /// Copies take the sums of a pair pass from their owners.
  void refresh(std::span<const Field<double>* const> columns) {
    if (halo) halo->refresh(particles, columns);
  }
  /// Place of a particle that is not put back into a periodic box.
  [[nodiscard]] Vec3 unwrapped(std::size_t row) const;
  [[nodiscard]] const Material& material_of(std::size_t row) const {
    return scene.materials[static_cast<std::size_t>(particles[field::material][row])];
  }
};

template <class Records>
void State::hand_to_ghosts(Records& by_id) const {
  using Numbers = typename Records::value_type;
  static_assert(std::is_standard_layout_v<Numbers> && std::is_trivially_copyable_v<Numbers>);
  static_assert(sizeof(Numbers) % sizeof(double) == 0);
  if (!halo) return;
  constexpr std::size_t each = sizeof(Numbers) / sizeof(double);
  halo->refresh({reinterpret_cast<double*>(by_id.data()), by_id.size() * each}, each);
}

inline Vec3 State::unwrapped(std::size_t row) const {
  Vec3 r = particles.position(row);
  if (!box.any()) return r;
  const Vec3 n = images(particles).at(row);
  for (std::size_t a = 0; a < 3; ++a) {
    if (box.periodic[a]) r[a] += n[a] * box.width[a];
  }
  return r;
}

}  // namespace tripoint
