// SPDX-License-Identifier: BSD-3-Clause
#include "effects/prescribed/inflow.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "scene/lattice.hpp"

namespace tripoint::prescribed {

Entrance::Entrance(const Scene& scene, std::size_t inflow)
    : start_(scene.inflows[inflow].start), stop_(scene.inflows[inflow].stop), spacing_(scene.spacing) {
  const Inflow& in = scene.inflows[inflow];
  const Vec3 v = in.velocity;
  std::size_t along = 0;
  for (std::size_t a = 0; a < 3; ++a)
    if (std::abs(v[a]) > std::abs(v[along])) along = a;
  if (std::abs(v[along]) < (1.0 - 1e-9) * norm(v))
    throw InputError("inflow " + std::to_string(inflow + 1) +
                     ": its layers lie on the lattice: let its velocity be along x, y or z");
  Body source;
  source.name = "inflow " + std::to_string(inflow + 1);
  source.material = in.material;
  source.shape = in.shape;
  const std::vector<Vec3> places = fill(scene, source);
  const double sign = v[along] > 0.0 ? 1.0 : -1.0;
  double first = INFINITY, last = -INFINITY;
  for (const Vec3& r : places) {
    first = std::min(first, sign * r[along]);
    last = std::max(last, sign * r[along]);
  }
  for (const Vec3& r : places)
    if (sign * r[along] < first + 0.5 * spacing_) section_.push_back(r);
  depth_ = last - first + spacing_;
  speed_ = in.rate ? *in.rate / (static_cast<double>(section_.size()) * spacing_ * spacing_) : norm(v);
  velocity_ = (speed_ / norm(v)) * v;
}

long Entrance::layers_until(double time) const {
  const double t = std::min(time, stop_);
  return t < start_ ? 0 : static_cast<long>(std::floor((t - start_) * speed_ / spacing_ + 1e-9)) + 1;
}

int inflow_of(const State& state, std::size_t row) {
  const int source = state.particles[field::source][row],
            bodies = static_cast<int>(state.scene.bodies.size());
  return source < bodies ? -1 : source - bodies;
}

namespace {

/// One particle more, in its first place moved on by what its layer has travelled.
void append(State& state, std::size_t inflow, const Vec3& place, const Vec3& velocity) {
  Particles& p = state.particles;
  const std::size_t row = p.append();
  const Inflow& in = state.scene.inflows[inflow];
  const auto material =
      std::ranges::find(state.scene.materials, in.material, &Material::name) - state.scene.materials.begin();
  positions(p).set(row, place);
  velocities(p).set(row, velocity);
  const double m =
      state.scene.materials[static_cast<std::size_t>(material)].density * std::pow(state.scene.spacing, 3);
  p[field::mass][row] = m;
  p[field::phase][row] = static_cast<int>(Phase::liquid);
  p[field::body][row] = -1;
  p[field::material][row] = static_cast<int>(material);
  p[field::source][row] = static_cast<int>(state.scene.bodies.size() + inflow);
  p[field::driven][row] = driven_in;
  const double potential = -m * dot(state.scene.gravity, place);
  state.accumulated[account::inflow] += 0.5 * m * dot(velocity, velocity) + potential;
  state.accumulated[account::driven_potential] += potential;
  state.change.born.push_back(static_cast<std::uint32_t>(p[field::id][row]));
}

}  // namespace

void let_in(State& state, const std::vector<Entrance>& entrances) {
  std::vector<long> there(entrances.size(), 0);
  for (std::size_t i = 0; i < state.particles.size(); ++i)
    if (const int from = inflow_of(state, i); from >= 0) ++there[static_cast<std::size_t>(from)];
  for (std::size_t n = 0; n < entrances.size(); ++n) {
    const Entrance& e = entrances[n];
    const long per_layer = static_cast<long>(e.section().size());
    for (long layer = there[n] / per_layer; layer < e.layers_until(state.time); ++layer) {
      const Vec3 travelled = (state.time - e.begin_of(layer)) * e.velocity();
      for (const Vec3& r : e.section()) append(state, n, r + travelled, e.velocity());
    }
  }
}

}  // namespace tripoint::prescribed
