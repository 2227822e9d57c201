// SPDX-License-Identifier: BSD-3-Clause
#include "effects/fluid/walls.hpp"

#include <algorithm>

#include "effects/fill.hpp"
#include "effects/fluid/wall_terms.hpp"
#include "effects/pair_passes.hpp"
#include "effects/run_pass.hpp"

namespace tripoint::fluid {
namespace {

constexpr double wall_group = 0.0;

bool has_near(const World& world, std::span<const double> group, std::size_t i, bool liquid) {
  return std::ranges::any_of(world.neighbours->of(i), [&](Entry e) { return liquid ? group[e.row()] == -1.0 : group[e.row()] == wall_group; });
}

}  // namespace

Vec3 wall_acceleration(const World& world, std::size_t row) {
  const auto b = static_cast<std::size_t>(world.particles[field::body][row]);
  const Vec3 omega = world.bodies[field::body_angular_velocity][b];
  if (omega == Vec3{}) return {};
  return cross(omega, cross(omega, world.unwrapped(row) - world.bodies[field::body_centre][b]));
}

void Walls::find(const World& world) {
  if (known_ == world.neighbours->rebuilds()) return;
  known_ = world.neighbours->rebuilds();
  wet_walls_.clear(), border_.clear();
  const auto group = world.particles[field::group];
  for (std::size_t i = 0; i < group.size(); ++i) {
    const bool wall = group[i] == wall_group, liquid = group[i] == -1.0;
    if (!(wall && has_near(world, group, i, true)) && !(liquid && has_near(world, group, i, false))) continue;
    border_.push_back(static_cast<std::uint32_t>(i));
    if (wall) wet_walls_.push_back(static_cast<std::uint32_t>(i));
  }
}

void Walls::extrapolate(World& world, const SceneNumbers& n, const PairKernels& kernels) {
  find(world);
  if (wet_walls_.empty()) return;
  Particles& p = world.particles;
  for (const Field<double>* f : WallExtrapolation::adds::list) fill(p[*f], 0.0, world.threads);
  run_pass(pair_passes(world.neighbours->clusters().lanes).wall_extrapolation, p, *world.neighbours, kernels, world.threads, wet_walls_);

  const auto weight = p[field::wall_weight], sum = p[field::wall_pressure], pressure = p[field::pressure];
  const auto lever = triple(p, field::wall_lever_x, field::wall_lever_y, field::wall_lever_z);
  const auto moved = triple(p, field::wall_velocity_x, field::wall_velocity_y, field::wall_velocity_z);
  const auto seen = triple(p, field::viscous_velocity_x, field::viscous_velocity_y, field::viscous_velocity_z);
  const auto v = velocities(p);
  static const double weaker = 1.0 - defect_size("walls.pressure"), slip = 1.0 - defect_size("walls.velocity");
#pragma omp parallel for schedule(static) num_threads(world.threads)
  for (std::size_t k = 0; k < wet_walls_.size(); ++k) {
    const std::size_t i = wet_walls_[k];
    if (!(weight[i] > 0.0)) continue;
    seen.set(i, v.at(i) + slip * (v.at(i) - moved.at(i) / weight[i]));
    if (!n.extrapolates) continue;
    const double p_w = weaker * (sum[i] + dot(world.scene.gravity - wall_acceleration(world, i), lever.at(i))) / weight[i];
    pressure[i] = world.scene.clamp ? std::max(p_w, 0.0) : p_w;
  }
}

void Walls::split_forces(World& world, const PairKernels& kernels) {
  find(world);
  if (border_.empty()) return;
  for (const Field<double>* f : WallPressureForce::adds::list) fill(world.particles[*f], 0.0, world.threads);
  run_pass(pair_passes(world.neighbours->clusters().lanes).wall_force, world.particles, *world.neighbours, kernels, world.threads, border_);
}

}  // namespace tripoint::fluid
