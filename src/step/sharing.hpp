// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <vector>

#include "assembly/all_effects.hpp"
#include "core/errors.hpp"
#include "pairs/scene_passes.hpp"
#include "particles/rank_grid.hpp"

namespace tripoint {

/// Shares a scene's particles out among the processes that hold it, and brings them together again where
/// something is decided of the whole (decision 030). Without other processes it does nothing.
class Sharing {
 public:
  /// @param skin how far a particle may move before it is shared out again, twice over and in support radii
  /// @param halo those that hold the rest of the scene; null: there are none
  Sharing(double skin, Halo* halo) : skin_(skin), halo_(halo) {}
  /// Whether this process holds a part of the scene and others the rest.
  [[nodiscard]] bool is_part(const State&) const;
  /// The next whole is shared out as at the start.
  void begin_anew();
  /// Where the scene recovers, a failure that one process meets in `look` is thrown by all. Else, or where
  /// this process holds the whole, it is thrown where it is met. All call it. @throws Diverged
  template <class Look>
  void look_together(const State&, Look look) const;
  /// The failure of the lowest particle, of those that processes have met. @param here met by this process;
  /// none: nothing. All call it. @pre the scene is shared out
  [[nodiscard]] std::optional<Diverged> first_failure(const std::optional<Diverged>& here) const;
  /// Whether one of the processes says so. All call it. @pre the scene is shared out
  [[nodiscard]] bool any(bool here) const;
  /// Each process holds the whole scene, with the lists that a single process has. All then make the same
  /// changes and stay equal. EnergyAccounts made meanwhile stand with the first process alone. Nothing where
  /// this process holds all already.
  void gather(State&, const std::vector<Active>&);
  /// The scene as one process would hold it between two steps, with all that processes have accumulated.
  [[nodiscard]] State whole(const State&) const;
  /// Shares out what this process holds all of, with the lists that it has where they are not outdated. Else,
  /// where the lists of one process are outdated, particles go to the process that has their place now, and
  /// all make new lists. All call it. @pre there is a halo
  void follow(State&, const std::vector<Active>&, const Passes&);

 private:
  /// Sums of each process over its own part, of a scene that all hold for now.
  struct Accumulated {
    EnergyAccounts accounts;
    std::vector<std::vector<double>> body_sums;  ///< of each of State::body_sums, by body
  };
  [[nodiscard]] bool outdated(const State&) const;
  void share_out(State&, const Passes&);
  void share_particles(State&, const Passes&);
  /// What this process held before it held the whole.
  struct Part {
    Particles particles;
    Bonds bonds;
    ExcludedPairs own;
    std::optional<Neighbours> neighbours;  ///< none: they are not those of the whole
  };
  Part hold_whole(State&) const;
  [[nodiscard]] bool can_take_back(const State&) const;
  void take_back(State&);

  double skin_;
  Halo* halo_;
  std::size_t count_ = 0;                   ///< particles of the scene, as last shared out
  std::optional<Accumulated> accumulated_;  ///< none: nothing yet
  /// While this process holds the whole, after it held a part
  std::optional<Part> part_;
  /// Changes of the whole's bonds and excluded pairs, as it was gathered
  std::array<std::uint64_t, 2> gathered_{};
  long steps_ = 0;                                      ///< since particles changed hands
  double steps_a_list_ = ParticleCost::guess_of_steps;  ///< how often they do, of late
  /// By row: where particles were when last shared out [m]; of scenes without neighbour lists
  std::vector<Vec3> shared_at_;
};

template <class Look>
void Sharing::look_together(const State& state, Look look) const {
  if (!state.halo || !state.scene.recovers) return look();
  std::optional<Diverged> failure;
  try {
    look();
  } catch (const Diverged& e) {
    failure = e;
  }
  failure = first_failure(failure);
  if (failure) throw Diverged(*failure);
}

/// Tells of each row whether it is a copy of another process's particle.
void mark_copies(State&);

}  // namespace tripoint
