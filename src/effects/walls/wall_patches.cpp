// SPDX-License-Identifier: BSD-3-Clause
#include "effects/walls/wall_patches.hpp"

#include <algorithm>
#include <cmath>
#include <compare>

#include "liquids/fields.hpp"
#include "liquids/fixed_walls.hpp"

namespace tripoint::walls {
namespace {

constexpr int fixed_frame = -1;

/// Frame that each body moves with: all that is fixed moves as one, each driven body by itself.
std::vector<int> frames_of(const State& state) {
  std::vector<int> frames(state.bodies.size());
  for (std::size_t b = 0; b < frames.size(); ++b)
    frames[b] = state.bodies[field::body_motion][b] == static_cast<int>(Motion::fixed) ? fixed_frame
                                                                                       : static_cast<int>(b);
  return frames;
}

constexpr std::uint32_t none = ~std::uint32_t{0};

/// Part of a neighbour in the kernel sum of a wall particle, and the part that it would have from its place
/// on the lattice.
struct Share {
  int id;
  double as_it_is, from_lattice;
  auto operator<=>(const Share&) const = default;
};

}  // namespace

/// Copies take the owner's number, since the owner alone sees all neighbours. @param by_id a number for each
/// particle
template <class T>
void hand_to_copies(const State& state, std::vector<T>& by_id) {
  if (!state.halo) return;
  std::vector<double> numbers(state.particles.size());  // where nothing is jittered there are none
  std::ranges::copy(by_id, numbers.begin());
  state.halo->refresh(numbers, 1);
  for (std::size_t id = 0; id < by_id.size(); ++id) by_id[id] = static_cast<T>(numbers[id]);
}

/// Gives walls that were here before their known values, by id. @return of each id, 1 where something is
/// known
std::vector<char> WallPatches::recall_exposed(const State& state) {
  std::vector<char> known(state.particles.size(), 0);
  at_face_.resize(known.size());
  if (liquid::has_lattice_walls(state.scene)) excess_.assign(known.size(), 0.0);
  if (!state.halo || exposures_.empty()) return known;
  const std::span<const int> number = state.halo->numbers();
  for (std::size_t id = 0; id < known.size(); ++id) {
    const auto found = exposures_.find(number[id]);
    if (found == exposures_.end()) continue;
    known[id] = 1;
    at_face_[id] = found->second.at_face;
    if (!excess_.empty()) excess_[id] = found->second.excess;
  }
  return known;
}

/// Copies take what owners have found, and all is kept for when particles change hands.
void WallPatches::share_exposed(const State& state) {
  if (!state.halo) return;
  hand_to_copies(state, at_face_);
  hand_to_copies(state, excess_);
  const auto id = state.particles[field::id];
  const auto group = state.particles[field::group];
  const std::span<const int> number = state.halo->numbers();
  for (std::size_t i = 0; i < state.particles.size(); ++i) {
    const auto one = static_cast<std::size_t>(id[i]);
    if (group[i] == wall_group)
      exposures_[number[one]] = {at_face_[one], excess_.empty() ? 0.0 : excess_[one]};
  }
}

namespace {

/// Number density of a wall's particle over its own wall: at the places as they are, and as its lattice has
/// them [1/m3]
struct WallAround {
  double as_it_is, from_lattice;
};

/// @param frames of each body. The sum has one order on any number of processes.
WallAround wall_around(const State& state, const std::vector<int>& frames, const PairKernels& kernels,
                       std::size_t i) {
  const Particles& p = state.particles;
  const auto group = p[field::group];
  const auto body = p[field::body], source = p[field::source], id = p[field::id];
  const auto frame_of = [&](std::size_t row) { return frames[static_cast<std::size_t>(body[row])]; };
  const auto x = positions(p);
  const double dx = state.scene.spacing;
  std::vector<Share> shares;
  for (const Entry e : state.neighbours->of(i)) {
    const std::size_t j = e.row();
    if (j == i || group[j] != wall_group || frame_of(i) != frame_of(j)) continue;
    const Vec3 away = (x.at(j) - x.at(i)) + state.neighbours->shift(e.image());
    const double as_it_is = kernels.wendland.value(norm(away));
    if (as_it_is > 0.0)
      shares.push_back(
          {id[j], as_it_is,
           source[i] == source[j] ? kernels.wendland.value(dx * norm(liquid::laid(away / dx))) : as_it_is});
  }
  std::ranges::sort(shares);
  WallAround sum{kernels.wendland.value(0.0), kernels.wendland.value(0.0)};
  for (const Share& s : shares) {
    sum.as_it_is += s.as_it_is;
    sum.from_lattice += s.from_lattice;
  }
  return sum;
}

}  // namespace

/// Which particles lie at a face: those whose number density can in part be other than wall. And what jitter
/// adds to the part that is fixed wall. Behind the face, where no velocity is mirrored and nothing jittered,
/// no step reads the values of a wall.
void WallPatches::find_exposed(State& state, const liquid::SceneNumbers& n, const PairKernels& kernels) {
  const Particles& p = state.particles;
  const auto group = p[field::group];
  const auto body = p[field::body], id = p[field::id];
  const std::vector<int> frames = frames_of(state);
  const double full = n.lattice_density / std::pow(state.scene.spacing, number_of(state.scene.space()));
  const bool jittered = liquid::has_lattice_walls(state.scene);
  const std::vector<char> known = recall_exposed(state);
  state.unread.assign(jittered ? 0 : p.size(), 0);
  const auto stick = p[field::stick];
  const bool drags = liquid::all_drag(state.scene);
#pragma omp parallel for schedule(static) num_threads(state.threads)
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (group[i] != wall_group || known[static_cast<std::size_t>(id[i])] || !state.owns(i)) continue;
    const auto [wall, from_lattice] = wall_around(state, frames, kernels, i);
    const bool exposed = wall < (1.0 - n.least_exposure) * full;
    at_face_[static_cast<std::size_t>(id[i])] = exposed ? 1 : 0;
    if (jittered && frames[static_cast<std::size_t>(body[i])] == fixed_frame)
      excess_[static_cast<std::size_t>(id[i])] = liquid::to_a_millionth((wall - from_lattice) / full);
  }
  share_exposed(state);
  if (jittered) return;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (const auto one = static_cast<std::size_t>(id[i]); group[i] == wall_group)
      state.unread[one] = at_face_[one] == 0 && !drags && stick[i] == 0.0 ? 1 : 0;
}

/// The faces of fixed walls, or of driven ones, with their patches.
void WallPatches::add_faces(const State& state, bool fixed) {
  const Particles& p = state.particles;
  const auto group = p[field::group];
  const auto body = p[field::body], id = p[field::id];
  const auto x = positions(p);
  const std::vector<int> frames = frames_of(state);
  const auto frame_of = [&](std::size_t row) { return frames[static_cast<std::size_t>(body[row])]; };
  const double radius = patch_radius * state.scene.spacing;
  place_.resize(p.size(), none);
  const std::size_t old = face_.size();
  for (std::size_t i = 0; i < p.awake(); ++i) {
    if (group[i] != wall_group || (frame_of(i) == fixed_frame) != fixed ||
        at_face_[static_cast<std::size_t>(id[i])] == 0)
      continue;
    place_[static_cast<std::size_t>(id[i])] = static_cast<std::uint32_t>(face_.size());
    face_.push_back(static_cast<std::uint32_t>(id[i]));
  }
  for (std::size_t k = old; k < face_.size(); ++k) {
    const std::size_t i = p.row(face_[k]);
    patch_.push_back(static_cast<std::uint32_t>(k));
    for (const Entry e : state.neighbours->of(i)) {
      const std::size_t j = e.row();
      if (group[j] != wall_group || j == i || frame_of(i) != frame_of(j) ||
          at_face_[static_cast<std::size_t>(id[j])] == 0)
        continue;
      if (norm((x.at(j) - x.at(i)) + state.neighbours->shift(e.image())) < radius)
        patch_.push_back(place_[static_cast<std::size_t>(id[j])]);
    }
    start_.push_back(patch_.size());
  }
}

void WallPatches::find_rows(const State& state) {
  const Particles& p = state.particles;
  const auto group = p[field::group];
  const auto id = p[field::id];
  hidden_.clear();
  awake_.clear();
  row_.clear();
  for (std::uint32_t i = 0; i < p.awake(); ++i) {
    if (group[i] != wall_group) continue;
    const auto one = static_cast<std::size_t>(id[i]);
    if (at_face_[one] == 0)
      hidden_.push_back(i);
    else {
      awake_.push_back(place_[one]);
      row_.push_back(i);
    }
  }
}

/// Fixed walls keep their faces and patches from one whole list to the next.
void WallPatches::find_faces(State& state, const liquid::SceneNumbers& n, const PairKernels& kernels) {
  if (known_faces_ == state.neighbours->rebuilds()) return;
  known_faces_ = state.neighbours->rebuilds();
  if (at_face_.empty()) find_exposed(state, n, kernels);
  if (known_whole_ != state.neighbours->whole_lists()) {
    known_whole_ = state.neighbours->whole_lists();
    face_.clear();
    start_.assign(1, 0);
    patch_.clear();
    place_.clear();
    add_faces(state, true);
    fixed_faces_ = face_.size();
  } else {
    face_.resize(fixed_faces_);
    start_.resize(fixed_faces_ + 1);
    patch_.resize(start_.back());
  }
  add_faces(state, false);
  for (auto* column : {&density_, &mean_, &mean_of_mean_, &part_, &part_again_, &share_})
    column->resize(face_.size());
  members_.clear();
  for (std::size_t k = 0; k < face_.size(); ++k)
    members_.push_back(static_cast<double>(start_[k + 1] - start_[k]));
  hand_to_copied_faces(state, members_);
  find_rows(state);
}

/// The same for one number a face.
void WallPatches::hand_to_copied_faces(const State& state, std::vector<double>& of) {
  if (!state.halo) return;
  handed_.resize(state.particles.size());  // values off the faces are handed on too, and nobody reads them
  for (std::size_t k = 0; k < face_.size(); ++k) handed_[face_[k]] = of[k];
  state.halo->refresh(handed_, 1);
  for (std::size_t k = 0; k < face_.size(); ++k) of[k] = handed_[face_[k]];
}

/// Calls give(k, sum) for the faces that are awake. The sum is over the patch of k, of the values that its
/// members were given.
template <class Give>
void WallPatches::sum_patches(const std::vector<double>& of, int threads, Give give) const {
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t n = 0; n < awake_.size(); ++n) {
    const std::size_t k = awake_[n];
    double sum = 0.0;
    for (std::size_t e = start_[k]; e < start_[k + 1]; ++e) sum += of[patch_[e]];
    give(k, sum);
  }
}

void WallPatches::average_density(State& state, const liquid::SceneNumbers& n, const PairKernels& kernels) {
  find_faces(state, n, kernels);
  Particles& p = state.particles;
  const auto rho = p[field::density], rest = p[field::rest_density], m = p[field::mass], V = p[field::volume];
  for (const std::uint32_t i : hidden_) {
    rho[i] = rest[i];
    V[i] = m[i] / rest[i];
  }
  for (std::size_t a = 0; a < awake_.size(); ++a)
    density_[awake_[a]] = rho[row_[a]] / rest[row_[a]] - (excess_.empty() ? 0.0 : excess_[face_[awake_[a]]]);
  sum_patches(density_, state.threads, [&](std::size_t k, double sum) { mean_[k] = sum / members_[k]; });
  hand_to_copied_faces(state, mean_);
  sum_patches(mean_, state.threads, [&](std::size_t k, double sum) { mean_of_mean_[k] = sum / members_[k]; });
  hand_to_copied_faces(state, mean_of_mean_);
  for (std::size_t a = 0; a < awake_.size(); ++a) {
    const std::size_t i = row_[a];
    rho[i] = mean_of_mean_[awake_[a]] * rest[i];
    V[i] = m[i] / rho[i];
  }
}

/// The transpose of the mean, twice: a particle in my patch has me in its own.
void WallPatches::hand_down_shares(State& state) {
  const auto share = state.particles[field::pressure_share];
  for (std::size_t a = 0; a < awake_.size(); ++a) {
    const std::size_t k = awake_[a];
    part_[k] = share[row_[a]] / members_[k];
  }
  sum_patches(part_, state.threads, [&](std::size_t k, double sum) { part_again_[k] = sum / members_[k]; });
  hand_to_copied_faces(state, part_again_);
  sum_patches(part_again_, state.threads, [&](std::size_t k, double sum) { share_[k] = sum; });
  hand_to_copied_faces(state, share_);
  for (std::size_t a = 0; a < awake_.size(); ++a) share[row_[a]] = share_[awake_[a]];
}

}  // namespace tripoint::walls
