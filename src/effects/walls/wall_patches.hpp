// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "liquids/scene_numbers.hpp"
#include "state/state.hpp"

namespace tripoint::walls {

/// Radius of a patch at the face of a wall [spacings] (model 8.4). It takes in the neighbours on the lattice
/// that are 1, sqrt(2) and sqrt(3) away, and not the next, which are 2 away. Wider patches reach the back of
/// thin walls (decision 13).
inline constexpr double patch_radius = 1.75;
/// How far a wall particle is from those whose density tells on its share of the pressure [spacings]: two
/// means, and two back.
inline constexpr double reach_of_patches = 4.0 * patch_radius;

/// Action of fixed and driven walls on liquids (model 8.4). Their pressure is the gradient of an energy, as
/// that of all particles is, so that walls do no net work. In a scene where liquid alone touches them it
/// follows from the mean number density of a patch of the wall's face. The arrangement of single wall
/// particles then matters little.
class WallPatches {
 public:
  /// Gives each particle at the face of a wall the mean density of its patch, and those behind it the rest
  /// density. The mean is A A rho. A averages over the particles of the face within 1.75 spacings that move
  /// as one with it. Where the scene jitters fixed walls, the part of rho that is wall is first put back to
  /// that of the wall's lattice.
  void average_density(State&, const liquid::SceneNumbers&, const PairKernels&);
  /// Hands the pressure shares of the patches to their particles, by the transpose of average_density(). The
  /// force is the gradient of the energy of compression at the mean density.
  void hand_down_shares(State&);
  /// Groups have changed: look again which particles are walls.
  void clear() {
    renumber();
    exposures_.clear();
  }
  /// Rows and ids stand for other particles.
  void renumber() {
    known_faces_ = known_whole_ = -1;
    at_face_.clear();
    excess_.clear();
  }

 private:
  /// Data that a wall particle keeps while groups stay.
  struct Exposure {
    char at_face;
    double excess;
  };
  void find_faces(State&, const liquid::SceneNumbers&, const PairKernels&);
  void find_exposed(State&, const liquid::SceneNumbers&, const PairKernels&);
  [[nodiscard]] std::vector<char> recall_exposed(const State&);
  void share_exposed(const State&);
  void add_faces(const State&, bool fixed);
  void find_rows(const State&);
  void hand_to_copied_faces(const State&, std::vector<double>& of);
  template <class Give>
  void sum_patches(const std::vector<double>& of, int threads, Give give) const;

  std::vector<std::uint32_t> hidden_;  ///< rows of walls that are not at a face, and awake
  /// Ids of those that are: fixed ones, whose patches stay, then driven ones
  std::vector<std::uint32_t> face_;
  std::vector<std::size_t> start_;    ///< first entry of each patch, and one past the last
  std::vector<std::uint32_t> patch_;  ///< places in face_, the particle itself first
  std::vector<double> members_;       ///< of each patch; a ghost's are reported by its owner
  std::size_t fixed_faces_ = 0;
  std::vector<std::uint32_t> awake_, row_;  ///< places in face_ of those that are awake, and their rows
  std::vector<std::uint32_t> place_;        ///< by id, the place in face_
  /// By id, whether it is a wall's and at its face: a body that moves as one keeps its faces
  std::vector<char> at_face_;
  /// By id, part of jitter in the density of a wall particle over its rest density; empty where nothing is
  /// jittered
  std::vector<double> excess_;
  /// Of a scene that is shared out, by number: of walls that have been here
  std::unordered_map<int, Exposure> exposures_;
  /// By place in face_: density over the rest density, its mean and the mean of this mean. Then the part of
  /// its share of the pressure for each member of its patch, the same part of these parts, and their sum.
  /// Sleeping particles keep their values.
  std::vector<double> density_, mean_, mean_of_mean_, part_, part_again_, share_;
  std::vector<double> handed_;  ///< memory that is used again: by id
  long known_faces_ = -1;       ///< the rebuild that the rows are of
  long known_whole_ = -1;       ///< the whole lists that fixed faces are of
};

}  // namespace tripoint::walls
