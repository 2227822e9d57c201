// SPDX-License-Identifier: BSD-3-Clause
#include "effects/prescribed/inflow.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "sampling/lattice.hpp"
#include "scene/geometry.hpp"
#include "tables/expression.hpp"

namespace tripoint::prescribed {

Entrance::Entrance(const Scene& scene, std::size_t inflow)
    : start_(scene.inflows[inflow].start),
      stop_(scene.inflows[inflow].stop),
      ramp_(scene.inflows[inflow].ramp),
      spacing_(scene.spacing) {
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
  across_ = {(along + 1) % 3, (along + 2) % 3};
  set_speeds(in, cell_depth(scene));
  index_columns();
}

/// Full velocity of each column; those that the profile stops are left out.
void Entrance::set_speeds(const Inflow& in, double depth) {
  std::vector<double> share(section_.size(), 1.0);
  if (!in.profile.empty()) {
    const Expression formula(in.profile);
    for (std::size_t k = 0; k < section_.size(); ++k) {
      share[k] = formula(section_[k]);
      if (!(share[k] >= 0.0 && share[k] <= 1.0 + 1e-9))
        throw InputError("the profile of an inflow is " + std::to_string(share[k]) +
                         " somewhere: it goes from 0 to 1, and velocity is the greatest");
    }
  }
  double sum = 0.0;
  for (const double one : share) sum += one;
  const double v = norm(in.velocity), full = in.rate ? *in.rate / (sum * spacing_ * depth) : v;
  std::vector<Vec3> moving;
  for (std::size_t k = 0; k < section_.size(); ++k) {
    if (!(share[k] > 0.0)) continue;
    moving.push_back(section_[k]);
    speed_.push_back(share[k] * full);
    velocity_.push_back((speed_.back() / v) * in.velocity);
  }
  if (moving.empty()) throw InputError("an inflow lets nothing in: its profile is 0 everywhere");
  section_ = std::move(moving);
}

void Entrance::index_columns() {
  std::array<long, 2> last{};
  const auto number = [&](const Vec3& r, std::size_t a) {
    return std::lround((r[across_[a]] - section_.front()[across_[a]]) / spacing_);
  };
  for (const Vec3& r : section_)
    for (std::size_t a = 0; a < 2; ++a) {
      first_[a] = std::min(first_[a], number(r, a));
      last[a] = std::max(last[a], number(r, a));
    }
  for (std::size_t a = 0; a < 2; ++a) count_[a] = last[a] - first_[a] + 1;
  column_.assign(static_cast<std::size_t>(count_[0] * count_[1]), 0);
  for (std::size_t k = 0; k < section_.size(); ++k)
    column_[static_cast<std::size_t>((number(section_[k], 0) - first_[0]) * count_[1] +
                                     number(section_[k], 1) - first_[1])] = k;
}

std::size_t Entrance::column_of(const Vec3& place) const {
  std::array<long, 2> n{};
  for (std::size_t a = 0; a < 2; ++a) {
    const double away = place[across_[a]] - section_.front()[across_[a]];
    n[a] = std::clamp(std::lround(away / spacing_) - first_[a], 0L, count_[a] - 1);
  }
  return column_[static_cast<std::size_t>(n[0] * count_[1] + n[1])];
}

double Entrance::clock(double time) const {
  if (ramp_ == 0.0) return time;
  const double t = std::max(time - start_, 0.0);
  return start_ + (t < ramp_ ? 0.5 * t * t / ramp_ : t - 0.5 * ramp_);
}

double Entrance::opening(double time) const {
  return ramp_ == 0.0 ? 1.0 : std::clamp((time - start_) / ramp_, 0.0, 1.0);
}

long Entrance::layers_until(double time, std::size_t column) const {
  const double t = std::min(time, stop_);
  if (t < start_) return 0;
  return static_cast<long>(std::floor((clock(t) - start_) * speed_[column] / spacing_ + 1e-9)) + 1;
}

long Entrance::particles_until(double time) const {
  long sum = 0;
  for (std::size_t k = 0; k < section_.size(); ++k) sum += layers_until(time, k);
  return sum;
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
  const double m = state.scene.materials[static_cast<std::size_t>(material)].density *
                   std::pow(state.scene.spacing, number_of(state.scene.space()));
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
  double& until = state.step_numbers[let_in_until];
  for (std::size_t n = 0; n < entrances.size(); ++n) {
    const Entrance& e = entrances[n];
    const std::size_t columns = e.section().size();
    std::vector<long> there(columns), now(columns);
    for (std::size_t k = 0; k < columns; ++k) {
      there[k] = e.layers_until(until, k);
      now[k] = e.layers_until(state.time, k);
    }
    const double opening = e.opening(state.time);
    for (long layer = *std::ranges::min_element(there); layer < *std::ranges::max_element(now); ++layer) {
      for (std::size_t k = 0; k < columns; ++k) {
        if (layer < there[k] || layer >= now[k]) continue;
        const Vec3 travelled = (e.clock(state.time) - e.begin_of(layer, k)) * e.velocity(k);
        append(state, n, e.section()[k] + travelled, opening * e.velocity(k));
      }
    }
  }
  until = state.time;
}

}  // namespace tripoint::prescribed
