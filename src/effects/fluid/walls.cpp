// SPDX-License-Identifier: BSD-3-Clause
#include "effects/fluid/walls.hpp"

#include <algorithm>
#include <cmath>

#include "core/defect.hpp"
#include "effects/fill.hpp"
#include "effects/fluid/wall_terms.hpp"
#include "effects/pair_passes.hpp"
#include "effects/run_pass.hpp"

namespace tripoint::fluid {
namespace {

constexpr double wall_group = 0.0, liquid_group = -1.0;

/// What each body moves with: all that is fixed moves as one, each driven body by itself.
std::vector<int> frames_of(const World& world) {
  std::vector<int> frames(world.bodies.size());
  for (std::size_t b = 0; b < frames.size(); ++b) frames[b] = world.bodies[field::body_motion][b] == static_cast<int>(Motion::fixed) ? -1 : static_cast<int>(b);
  return frames;
}

/// mean[k] over the patch of k of what was put to its members.
void take_mean(const std::vector<std::size_t>& start, const std::vector<std::uint32_t>& patch, const std::vector<double>& of, std::vector<double>& mean, int threads) {
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t k = 0; k < mean.size(); ++k) {
    double sum = 0.0;
    for (std::size_t e = start[k]; e < start[k + 1]; ++e) sum += of[patch[e]];
    mean[k] = sum / static_cast<double>(start[k + 1] - start[k]);
  }
}

/// The transpose: member k is given its part of the mean of each patch that it is in. Who is in my patch has me in its own.
void give_parts(const std::vector<std::size_t>& start, const std::vector<std::uint32_t>& patch, const std::vector<double>& of, std::vector<double>& part, std::vector<double>& shares, int threads) {
  shares.resize(of.size());
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t k = 0; k < of.size(); ++k) shares[k] = of[k] / static_cast<double>(start[k + 1] - start[k]);  // what each member of its patch is given
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t k = 0; k < part.size(); ++k) {
    double sum = 0.0;
    for (std::size_t e = start[k]; e < start[k + 1]; ++e) sum += shares[patch[e]];
    part[k] = sum;
  }
}

}  // namespace

void Walls::find(const World& world) {
  if (known_ == world.neighbours->rebuilds()) return;
  known_ = world.neighbours->rebuilds();
  wet_walls_.clear();
  const auto group = world.particles[field::group];
  const Clusters& c = world.neighbours->clusters();
  for (std::size_t k = 0; k < c.size(); ++k) {
    unsigned walls = 0, wet = 0;  // bits of members
    for (std::uint32_t i = c.first[k]; i < c.first[k + 1]; ++i) walls |= static_cast<unsigned>(group[i] == wall_group) << (i - c.first[k]);
    for (std::size_t e = c.start[k]; e < c.start[k + 1] && (walls & ~wet) != 0; ++e)
      if (group[Entry{c.entries[e]}.row()] == liquid_group) wet |= c.near[e];
    for (std::uint32_t i = c.first[k]; i < c.first[k + 1]; ++i)
      if ((walls & wet) >> (i - c.first[k]) & 1u) wet_walls_.push_back(i);
  }
  wet_ = clusters_of(c, wet_walls_);
}

void Walls::find_faces(const World& world, const SceneNumbers& n, const PairKernels& kernels) {
  if (known_faces_ == world.neighbours->rebuilds()) return;
  known_faces_ = world.neighbours->rebuilds();
  const Particles& p = world.particles;
  const auto group = p[field::group];
  const auto body = p[field::body];
  const auto x = positions(p);
  const std::vector<int> frames = frames_of(world);
  const auto frame_of = [&](std::size_t row) { return frames[static_cast<std::size_t>(body[row])]; };
  const double patch = 1.75 * world.scene.spacing, full = n.lattice_density / std::pow(world.scene.spacing, 3);
  face_.clear(), hidden_.clear();
  constexpr std::uint32_t none = ~std::uint32_t{0};
  const auto id = p[field::id];
  if (at_face_.empty()) {
    at_face_.resize(p.size());
#pragma omp parallel for schedule(static) num_threads(world.threads)
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (group[i] != wall_group) continue;
      double wall = kernels.wendland.value(0.0);
      for (const Entry e : world.neighbours->of(i)) {
        const std::size_t j = e.row();
        if (j != i && group[j] == wall_group && frame_of(i) == frame_of(j)) wall += kernels.wendland.value(norm((x.at(j) - x.at(i)) + world.neighbours->shift(e.image())));
      }
      at_face_[static_cast<std::size_t>(id[i])] = wall < (1.0 - n.least_exposure) * full ? 1 : 0;
    }
  }
  std::vector<std::uint32_t> place(p.size(), none);
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (group[i] != wall_group) continue;
    const bool at_face = at_face_[static_cast<std::size_t>(id[i])] != 0;
    if (at_face) place[i] = static_cast<std::uint32_t>(face_.size());
    (at_face ? face_ : hidden_).push_back(static_cast<std::uint32_t>(i));
  }
  start_.assign(1, 0), patch_.clear();
  for (const std::uint32_t i : face_) {
    patch_.push_back(place[i]);
    for (const Entry e : world.neighbours->of(i)) {
      const std::size_t j = e.row();
      if (place[j] == none || j == i || frame_of(i) != frame_of(j)) continue;
      if (norm((x.at(j) - x.at(i)) + world.neighbours->shift(e.image())) < patch) patch_.push_back(place[j]);
    }
    start_.push_back(patch_.size());
  }
  first_.resize(face_.size()), second_.resize(face_.size());
}

void Walls::average_density(World& world, const SceneNumbers& n, const PairKernels& kernels) {
  find_faces(world, n, kernels);
  Particles& p = world.particles;
  const auto rho = p[field::density], rest = p[field::rest_density], m = p[field::mass], V = p[field::volume];
  for (const std::uint32_t i : hidden_) rho[i] = rest[i], V[i] = m[i] / rest[i];
  for (std::size_t k = 0; k < face_.size(); ++k) first_[k] = rho[face_[k]] / rest[face_[k]];
  take_mean(start_, patch_, first_, second_, world.threads);
  take_mean(start_, patch_, second_, first_, world.threads);
  for (std::size_t k = 0; k < face_.size(); ++k) {
    const std::size_t i = face_[k];
    rho[i] = first_[k] * rest[i];
    V[i] = m[i] / rho[i];
  }
}

void Walls::hand_down_shares(World& world) {
  const auto share = world.particles[field::pressure_share];
  static const double weaker = 1.0 - defect_size("walls.pressure");
  for (std::size_t k = 0; k < face_.size(); ++k) first_[k] = weaker * share[face_[k]];
  give_parts(start_, patch_, first_, second_, parts_, world.threads);
  give_parts(start_, patch_, second_, first_, parts_, world.threads);
  for (std::size_t k = 0; k < face_.size(); ++k) share[face_[k]] = first_[k];
}

void Walls::mirror_velocities(World& world, const PairKernels& kernels) {
  find(world);
  if (wet_walls_.empty()) return;
  Particles& p = world.particles;
  for (const Field<double>* f : WallExtrapolation::adds::list) fill(p[*f], 0.0, world.threads);
  run_pass_over(pair_passes(world.neighbours->clusters().lanes).wall_extrapolation, p, *world.neighbours, kernels, world.threads, wet_);

  const auto weight = p[field::wall_weight];
  const auto moved = triple(p, field::wall_velocity_x, field::wall_velocity_y, field::wall_velocity_z);
  const auto seen = triple(p, field::viscous_velocity_x, field::viscous_velocity_y, field::viscous_velocity_z);
  const auto v = velocities(p);
  static const double slip = 1.0 - defect_size("walls.velocity");
#pragma omp parallel for schedule(static) num_threads(world.threads)
  for (std::size_t k = 0; k < wet_walls_.size(); ++k) {
    const std::size_t i = wet_walls_[k];
    if (weight[i] > 0.0) seen.set(i, v.at(i) + slip * (v.at(i) - moved.at(i) / weight[i]));
  }
}

}  // namespace tripoint::fluid
