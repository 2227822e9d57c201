// SPDX-License-Identifier: BSD-3-Clause
#include "effects/carried_liquid/phase_density.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "effects/carried_liquid/fields.hpp"
#include "liquids/pressing_gravity.hpp"
#include "solids/solid_particles.hpp"
#include "sph/kernels.hpp"

namespace tripoint::carried_liquid {

double CarriedState::pressure(double rho, double rest) const {
  const double p = modulus * (rho / rest - 1.0);
  return clamp ? std::max(p, 0.0) : p;
}

double CarriedState::energy(double mass, double rho, double rest) const {
  const double s = rho / rest;
  return clamp && s <= 1.0 ? 0.0 : modulus * mass / rest * (std::log(s) + 1.0 / s - 1.0);
}

double CarriedState::added(double mass, double rest, const DensityStep& rho) const {
  const double p_moved = pressure(rho.moved, rest), p_next = pressure(rho.next, rest);
  const double of_mean = p_moved / (rho.moved * rho.moved) + p_next / (rho.next * rho.next);
  return 0.5 * mass *
         (of_mean * (rho.next - rho.moved) -
          (p_next - p_moved) / (rho.moved * rho.moved) * (rho.moved - rho.before));
}

double CarriedState::wall_energy(double mass, double rest, double share) const {
  const double inside = std::max(share - inside_wall, 0.0);
  return 0.5 * modulus * mass / rest * inside * inside;
}

namespace {

/// Calls visit(j, d) for each row j in reach of row i, d = r_j - r_i at the time `back` ago. Where particles
/// have been born the rows of the lists are no longer those of the particles, and all are looked at.
template <class Visit>
void each_near(const State& state, std::size_t i, double back, Visit visit) {
  const auto x = positions(state.particles), v = velocities(state.particles);
  const auto past = [&](std::size_t j, const Vec3& d) { visit(j, d - back * (v.at(j) - v.at(i))); };
  if (state.change.born.empty()) {
    for (const Entry e : state.neighbours->of(i))
      past(e.row(), (x.at(e.row()) - x.at(i)) + state.neighbours->shift(e.image()));
    return;
  }
  const double reach = 1.2 * state.support();
  for (std::size_t j = 0; j < state.particles.size(); ++j) {
    const Vec3 d = solid::nearest_image(state.box, x.at(j) - x.at(i));
    if (j != i && dot(d, d) < reach * reach) past(j, d);
  }
}

}  // namespace

std::vector<std::size_t> touched_rows(const State& state, const std::vector<std::uint32_t>& ids) {
  const Particles& p = state.particles;
  const auto id = p[field::id];
  std::vector<std::uint32_t> all = ids;
  for (const std::uint32_t one : ids)
    each_near(state, p.row(one), 0.0,
              [&](std::size_t j, const Vec3&) { all.push_back(static_cast<std::uint32_t>(id[j])); });
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  std::vector<std::size_t> rows;
  for (const std::uint32_t one : all) rows.push_back(p.row(one));
  return rows;
}

CompressionEnergy::CompressionEnergy(const State& state, const CarriedState& equation)
    : equation_(equation),
      impedance_(state.particles[field::impedance]),
      mass_(state.particles[field::mass]),
      density_(state.particles[field::density]),
      rest_(state.particles[field::liquid_rest_density]) {}

double CompressionEnergy::operator()(std::size_t i) const {
  return impedance_[i] != 0.0 ? equation_.energy(mass_[i], density_[i], rest_[i]) : 0.0;
}

std::vector<double> densities_of_liquids(const State& state) {
  const auto z = state.particles[field::impedance], rest = state.particles[field::liquid_rest_density];
  std::vector<double> density(z.size());
  for (std::size_t i = 0; i < z.size(); ++i) density[i] = z[i] != 0.0 ? rest[i] : 0.0;
  return density;
}

double energy_of(const State& state, const CarriedState& equation, const liquid::InterfaceWeight& interfaces,
                 const PairKernels& kernels, const std::vector<std::size_t>& rows, double back) {
  const Particles& p = state.particles;
  const auto z = p[field::impedance], m = p[field::mass], rest = p[field::liquid_rest_density];
  const CompressionEnergy energy(state, equation);
  std::vector<char> is_among(p.size(), 0);
  for (const std::size_t i : rows) is_among[i] = 1;
  double sum = 0.0;
  for (const std::size_t i : rows) {
    sum += energy(i);
    if (z[i] == 0.0) continue;
    double share = 0.0;
    each_near(state, i, back, [&](std::size_t j, const Vec3& d) {
      if (z[j] == 0.0)
        share += m[j] / rest[j] * kernels.wendland.value(norm(d));
      else
        sum += (is_among[j] ? 0.5 : 1.0) * interfaces.energy(kernels, d, rest[i], rest[j]);
    });
    sum += equation.wall_energy(m[i], rest[i], share);
  }
  return sum;
}

namespace {

/// Rows of liquids that were so before.
std::vector<std::size_t> settled_liquids(const State& state, const std::vector<std::uint32_t>& fresh) {
  const Particles& p = state.particles;
  std::vector<char> is_fresh(p.size(), 0);
  for (const std::uint32_t one : fresh) is_fresh[p.row(one)] = 1;
  const auto z = p[field::impedance];
  std::vector<std::size_t> rows;
  for (std::uint32_t id = 0; id < p.size(); ++id)
    if (const std::size_t row = p.row(id); z[row] != 0.0 && !is_fresh[row]) rows.push_back(row);
  return rows;
}

}  // namespace

void take_pressure_around(State& state, const CarriedState& equation, const PairKernels& kernels,
                          const std::vector<std::uint32_t>& ids) {
  if (ids.empty()) return;
  Particles& p = state.particles;
  const std::vector<std::size_t> others = settled_liquids(state, ids);
  const auto x = positions(std::as_const(p));
  const auto rho = p[field::density], rest = p[field::liquid_rest_density], m = p[field::mass];
  const Vec3 g = liquid::pressing_gravity(state.scene);
  const double support2 = state.support() * state.support();
  for (const std::uint32_t id : ids) {
    const std::size_t i = p.row(id);
    double weight = 0.0, pressure = 0.0;
    for (const std::size_t j : others) {
      const Vec3 d = solid::nearest_image(state.box, x.at(i) - x.at(j));
      if (!(dot(d, d) < support2)) continue;
      const double w = m[j] / rho[j] * kernels.wendland.value(norm(d));
      weight += w;
      pressure += w * (equation.pressure(rho[j], rest[j]) + rho[j] * dot(g, d));
    }
    rho[i] = rest[i] * (1.0 + (weight > 0.0 ? std::max(pressure / weight, 0.0) / equation.modulus : 0.0));
  }
}

}  // namespace tripoint::carried_liquid
