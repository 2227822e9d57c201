// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <vector>

#include "core/vec3.hpp"
#include "particles/rank_grid.hpp"

/// Particles that each rank would hold of a scene, were it shared out as the engine tripoint-mpi does it
/// (decision 021). No rank runs for it.
namespace tripoint::predict {

/// The particles of a scene as far as sharing them out depends on them.
struct Cloud {
  std::vector<Vec3> position;  ///< [m]
  double spacing = 0.0;        ///< [m]
  double reach = 0.0;          ///< of copies beyond a rank's part of the box [m]
  double pair_reach = 0.0;     ///< of a neighbour list [m]
  std::array<bool, 3> periodic{};
  Vec3 min, max;  ///< the domain, used in periodic directions only [m]
  /// Of each, 1 where it is fixed and pairs of fixed particles have no work; empty: all have
  std::vector<char> idle;
  [[nodiscard]] bool is_idle(std::size_t i) const { return !idle.empty() && idle[i] != 0; }
};

struct Share {
  double own = 0.0, copies = 0.0;
  double pairs = 0.0;   ///< directed, within pair_reach, of its own particles: a rank has them in its lists
  double worked = 0.0;  ///< those of which not both are idle: a rank sums over them
};

struct Shares {
  std::array<int, 3> grid{1, 1, 1};  ///< ranks along each direction
  double messages = 0.0;             ///< that a rank in the middle sends in one exchange
  std::vector<Share> ranks;          ///< of each, z slowest
};

/// Counts particles one by one. The cuts are those of LAMMPS's `balance 1.02 shift xyz 20 1.02`, each
/// particle weighed by its cost at the start (ParticleCost). Own particles lie between the cuts, copies in
/// the box around them by `reach`. Pairs are counted among both.
/// @param ranks > 0   @throws InputError for an empty cloud
[[nodiscard]] Shares share_out(const Cloud&, int ranks);

/// The same scene with another number of particles, by volume. Each particle of the cloud stands for a cube
/// of matter, and reaches shrink with the spacing.
/// @param particles of the scene that is meant, > 0
[[nodiscard]] Shares share_volume(const Cloud&, int ranks, double particles);

/// As LAMMPS makes them, in the grid that rank_grid() chooses. @throws InputError for an empty cloud
[[nodiscard]] Cuts cuts_of(const Cloud&, int ranks);

/// Messages of a rank in the middle: two a cut direction, more where a reach goes beyond the next rank.
[[nodiscard]] double messages_of(const Cuts&, double reach);

struct Point {
  Vec3 at;  ///< [m]
  bool idle = false;
};
struct NeighbourCount {
  double all = 0.0, worked = 0.0;  ///< of all, and those of which not both are idle
};
/// For each member, how many members and images are within `reach`, itself left out.
[[nodiscard]] std::vector<NeighbourCount> count_neighbours(const std::vector<Point>& members,
                                                           const std::vector<Point>& images, double reach);
[[nodiscard]] std::vector<Point> points_of(const Cloud&);

}  // namespace tripoint::predict
