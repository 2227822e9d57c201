// SPDX-License-Identifier: BSD-3-Clause
#include "effects/elastic/bond_forces.hpp"

#include <cmath>
#include <utility>

namespace tripoint::elastic {
namespace {

using solid::ElasticForms;

/// r_j - r_i of the nearest images.
template <bool periodic>
Vec3 nearest(const PeriodicBox& box, Vec3 d) {
  if constexpr (periodic) {
    for (std::size_t a = 0; a < 3; ++a)
      if (box.periodic[a]) d[a] -= box.width[a] * std::round(d[a] / box.width[a]);
  }
  return d;
}

/// What a list tells: sums over bonds with u = u_ji, x = x_ij, w = v_j W(x_ij)/|x_ij|^2.
struct ListSums {
  Matrix3 displacement;  ///< sum v_j u gradW^T
  Matrix3 swept;         ///< -sum w u x^T
  Symmetric moment;      ///< sum w x x^T
};

template <bool periodic, bool hourglass>
ListSums sums_of(const World& world, const Deformations& all, std::uint32_t id) {
  ListSums s;
  const Vec3 r = all.places[id].r;
  for (const Bond& b : world.bonds.of(id)) {
    const auto& j = all.places[b.other];
    const Vec3 u = nearest<periodic>(world.box, j.r - r) + b.x;
    s.displacement = s.displacement + outer(u, j.volume * b.gradient);
    if constexpr (hourglass) {
      const Vec3 wx = (j.volume * b.weight / dot(b.x, b.x)) * b.x;
      s.swept = s.swept - outer(u, wx);
      s.moment = s.moment + Symmetric{wx.x * b.x.x, wx.y * b.x.y, wx.z * b.x.z, wx.y * b.x.z, wx.x * b.x.z, wx.x * b.x.y};
    }
  }
  return s;
}

/// H of a sheet or chain: -F sum_j kappa_ij y y^T, y = P x_ji, kappa_ij = (a E/2) v_i v_j W g_ij/|x_ij|^2.
template <bool periodic>
Matrix3 flat_hourglass(const World& world, const Deformations& all, std::uint32_t id, const Deformed& i, const Symmetric& strain, const Symmetric& P, const Matrix3& F) {
  Symmetric sum;
  for (const Bond& b : world.bonds.of(id)) {
    const auto& j = all.places[b.other];
    const Vec3 r = nearest<periodic>(world.box, j.r - i.r);
    const double kappa = i.flat * i.volume * j.volume * b.weight / dot(b.x, b.x) * solid::hourglass_residual_flat(strain, -b.x, r);
    sum = sum + kappa * square(P * b.x);
  }
  return -1.0 * (F * sum);
}

template <bool periodic, bool hourglass>
void deform_all(World& world, const ElasticForms& forms, Deformations& all) {
  Particles& p = world.particles;
  const auto id_of = p[field::id], rank_of = p[field::shape_rank];
  const solid::EnergyOwners owns(world);
  const auto constants = forms.constants(world);
  const auto shape = solid::shape_inverses(std::as_const(p));
  const auto strain_of = solid::strains(p);
#pragma omp parallel for schedule(static) num_threads(world.threads)
  for (std::size_t row = 0; row < p.size(); ++row) {
    const auto id = static_cast<std::uint32_t>(id_of[row]);
    Deformed& i = all.deformed[id];
    i = {all.places[id].r, all.places[id].volume, {}, {}, 0.0, 0.0};
    if (!owns(row)) continue;
    const int rank = rank_of[row];
    const ListSums sums = sums_of<periodic, hourglass>(world, all, id);
    const Symmetric A = shape.at(row), P = forms.projector(A, rank);
    const Matrix3 F = solid::deformation_gradient(sums.displacement, A);
    const Symmetric strain = forms.strain(F, P, rank);
    strain_of.set(row, strain);
    i.strained = F - identity3;
    if constexpr (!hourglass) continue;
    const double stiff = 0.5 * forms.hourglass() * constants(row).young;
    (rank == 3 ? i.full : i.flat) = stiff;
    i.T = rank == 3 ? (stiff * i.volume) * (i.strained * sums.moment - sums.swept) : flat_hourglass<periodic>(world, all, id, i, strain, P, F);
  }
}

/// T = (v F S + H) A, S of the strain less what has flowed.
void set_stress(World& world, const ElasticForms& forms, Deformations& all) {
  const Particles& p = world.particles;
  const auto id_of = p[field::id], rank_of = p[field::shape_rank];
  const solid::EnergyOwners owns(world);
  const auto constants = forms.constants(world);
  const auto shape = solid::shape_inverses(p), strain_of = solid::strains(p);
  const bool flows = p.has(field::plastic_strain_xx.name);
  const auto plastic_of = flows ? solid::plastic_strains(p) : solid::SymmetricColumns<const double>{};
#pragma omp parallel for schedule(static) num_threads(world.threads)
  for (std::size_t row = 0; row < p.size(); ++row) {
    if (!owns(row)) continue;
    Deformed& i = all.deformed[static_cast<std::size_t>(id_of[row])];
    const Symmetric A = shape.at(row), P = forms.projector(A, rank_of[row]), total = strain_of.at(row);
    const Symmetric elastic = flows ? between(P, total - plastic_of.at(row)) : total;
    const Symmetric S = forms.stress(elastic, P, rank_of[row], constants(row));
    i.T = ((forms.force_factor() * i.volume) * ((identity3 + i.strained) * S) + i.T) * A;
    if (rank_of[row] != 3) i.strained = full(total);
  }
}

/// Force on i where all lists mirror each other and none is flat: f = sum_j (v_j T_i + v_i T_j) gradW
/// + w_ij [(k_i G_i + k_j G_j) x_ij + (k_i + k_j) u_ji], G = F - I, w = v_i v_j W/|x|^2, k = a E/2.
template <bool periodic, bool hourglass>
Vec3 regular_force(const World& world, const Deformations& all, std::uint32_t id) {
  const Deformed& i = all.deformed[id];
  Vec3 own, others, own_glass, glass;
  for (const Bond& b : world.bonds.of(id)) {
    const Deformed& j = all.deformed[b.other];
    own += j.volume * b.gradient;
    others += j.T * b.gradient;
    if constexpr (hourglass) {
      const Vec3 u = nearest<periodic>(world.box, j.r - i.r) + b.x;
      const double w = j.volume * b.weight / dot(b.x, b.x);
      own_glass += w * b.x;
      glass += w * (j.full * (j.strained * b.x) + (i.full + j.full) * u);
    }
  }
  Vec3 f = i.T * own + i.volume * others;
  if constexpr (hourglass) f += i.volume * (glass + i.full * (i.strained * own_glass));
  return f;
}

/// The force of the energy of k on its partner l, by the bond of k; the opposite acts on k.
Vec3 force_of(const Deformed& k, const Deformed& l, const Bond& of_k, const Vec3& r_lk) {
  Vec3 f = -l.volume * (k.T * of_k.gradient);
  const double w = k.volume * l.volume * of_k.weight / dot(of_k.x, of_k.x);
  if (k.full != 0.0) f += (k.full * w) * solid::hourglass_residual(identity3 + k.strained, -of_k.x, r_lk);
  if (k.flat != 0.0) f -= (k.flat * w * solid::hourglass_residual_flat(symmetric_part(k.strained), -of_k.x, r_lk)) * r_lk;
  return f;
}

template <bool periodic>
Vec3 general_force(const World& world, const Deformations& all, std::uint32_t id) {
  const Deformed& i = all.deformed[id];
  Vec3 f;
  for (const Bond& b : world.bonds.of(id)) {
    const Deformed& j = all.deformed[b.other];
    const Vec3 r = nearest<periodic>(world.box, j.r - i.r);
    f += force_of(j, i, world.bonds.of(b.other)[b.twin], -r) - force_of(i, j, b, r);
  }
  return f;
}

template <bool periodic, bool hourglass>
void add_all(World& world, const Deformations& all) {
  Particles& p = world.particles;
  const auto id_of = p[field::id], regular = p[field::regular_bonds];
  const auto f = triple(p, field::elastic_force_x, field::elastic_force_y, field::elastic_force_z);
#pragma omp parallel for schedule(static) num_threads(world.threads)
  for (std::size_t row = 0; row < p.size(); ++row) {
    const auto id = static_cast<std::uint32_t>(id_of[row]);
    f.set(row, regular[row] ? regular_force<periodic, hourglass>(world, all, id) : general_force<periodic>(world, all, id));
  }
}

void set_places(World& world, Deformations& all) {
  const Particles& p = world.particles;
  const auto x = positions(p);
  const auto id_of = p[field::id];
  const auto volume = p[field::solid_volume];
  all.places.resize(p.size());
  all.deformed.resize(p.size());
#pragma omp parallel for schedule(static) num_threads(world.threads)
  for (std::size_t row = 0; row < p.size(); ++row) all.places[static_cast<std::size_t>(id_of[row])] = {x.at(row), volume[row]};
}

}  // namespace

void deform(World& world, const ElasticForms& forms, Deformations& all) {
  set_places(world, all);
  const bool glass = forms.hourglass() != 0.0;
  if (world.box.any()) glass ? deform_all<true, true>(world, forms, all) : deform_all<true, false>(world, forms, all);
  else glass ? deform_all<false, true>(world, forms, all) : deform_all<false, false>(world, forms, all);
}

void add_forces(World& world, const ElasticForms& forms, Deformations& all) {
  set_stress(world, forms, all);
  const bool glass = forms.hourglass() != 0.0;
  if (world.box.any()) glass ? add_all<true, true>(world, all) : add_all<true, false>(world, all);
  else glass ? add_all<false, true>(world, all) : add_all<false, false>(world, all);
}

}  // namespace tripoint::elastic
