// SPDX-License-Identifier: BSD-3-Clause
#include "solids/solid_particles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "scene/effect_rule.hpp"
#include "scene/phase_values.hpp"
#include "scene/scene_keys.hpp"
#include "scene/shared_terms.hpp"
#include "sph/surface_gradient.hpp"

namespace tripoint::solid {
namespace {

/// Members of rigid bodies without energy: their lists need no special form
constexpr int no_energy_rank = 3;

double stiffness_of_joints(const Scene& scene, const Material& m) {
  const bool lets_go = m.t_melt || m.elastic_limit || m.fracture_stretch || m.fracture_distance;
  return lets_go || scene.mode_of(term::elastic) == Mode::paper ? soft_joint_stiffness : joint_stiffness;
}

/// Which material's constants a particle's energy has, and how many times. They are its own; a member of a
/// rigid body has those of the elastic partner with the lowest id.
void set_stiffness(State& state, const ElasticParticles& is_elastic, std::uint32_t id) {
  Particles& p = state.particles;
  const std::size_t i = p.row(id);
  p[field::solid_material][i] = p[field::material][i];
  p[field::solid_stiffness][i] = is_elastic(i) ? 1.0 : 0.0;
  if (is_elastic(i) || p[field::body][i] < 0) return;
  std::uint32_t lowest = std::numeric_limits<std::uint32_t>::max();
  for (const Bond& b : std::as_const(state.bonds).of(id))
    if (is_elastic(p.row(b.other))) lowest = std::min(lowest, b.other);
  if (lowest == std::numeric_limits<std::uint32_t>::max()) return;
  p[field::solid_material][i] = p[field::material][p.row(lowest)];
  const Material& partner = state.material_of(p.row(lowest));
  p[field::solid_stiffness][i] = stiffness_of_joints(state.scene, partner);
}

/// v_i [m3]: m/rho0; printed (11) m_i / sum_j m_j W(x_ij), for particles that have all their body neighbours
/// in the list.
double volume_of(const State& state, bool paper, bool owns, std::uint32_t id) {
  const std::size_t i = state.particles.row(id);
  const auto m = state.particles[field::mass];
  if (!paper || !owns) return m[i] / state.material_of(i).density;
  double sum = m[i] * bond_kernel(state.scene).value(0.0);
  for (const Bond& b : state.bonds.of(id)) sum += m[state.particles.row(b.other)] * b.weight;
  return m[i] / sum;
}

/// M_i = sum_j v_j gradW(x_ij)(x_j - x_i)^T; in plane strain 1 along y, where nothing strains
Symmetric moment_of(const State& state, std::uint32_t id) {
  const auto volume = state.particles[field::solid_volume];
  Symmetric M;
  if (state.scene.is_planar() && !state.scene.plane_stress && !state.bonds.of(id).empty()) M.yy = 1.0;
  for (const Bond& b : state.bonds.of(id))
    M = M + symmetric_part(-volume[state.particles.row(b.other)] * outer(b.gradient, b.x));
  return M;
}

/// Of a particle whose neighbours lie in every direction that counts.
int full_rank(const Scene& scene) { return scene.plane_stress ? 2 : 3; }

/// Sets the gradients of a list. @param to called as to(bond), its gradient [1/m4]
template <class To>
void set_gradients(State& state, std::uint32_t id, To to) {
  const auto list = std::as_const(state.bonds).of(id);
  if (std::ranges::all_of(list, [&](const Bond& b) { return b.gradient == to(b); }))
    return;  // the list counts as changed where it is
  for (Bond& b : state.bonds.edit(id)) b.gradient = to(b);
}

/// grad W(x_ij), whatever stood for it.
void set_kernel_gradients(State& state, const ElasticityKernel& kernel, std::uint32_t id) {
  set_gradients(state, id, [&](const Bond& b) { return bond_of(kernel, b.x).gradient; });
}

/// At a surface: grad W + M_i c_ij/v_j, so that d_ij = v_j A_i of it has the correction c_ij.
void correct_for_bending(State& state, std::uint32_t id, double share, const Symmetric& moment,
                         const Symmetric& A) {
  const auto list = std::as_const(state.bonds).of(id);
  const auto volume_of = [&](const Bond& b) {
    return state.particles[field::solid_volume][state.particles.row(b.other)];
  };
  std::vector<GradientPoint> points;
  for (const Bond& b : list) points.push_back({-b.x, -volume_of(b) * dot(b.gradient, b.x) / dot(b.x, b.x)});
  if (!at_surface(points)) return;
  const std::vector<Vec3> correction = curvature_correction(points, A);
  set_gradients(state, id, [&, first = list.data()](const Bond& b) {
    const Vec3& c = correction[static_cast<std::size_t>(&b - first)];
    return b.gradient + (share / volume_of(b)) * (moment * c);
  });
}

bool is_regular(const State& state, std::uint32_t id) {
  const auto rank = state.particles[field::shape_rank];
  if (rank[state.particles.row(id)] != 3) return false;
  return std::ranges::all_of(state.bonds.of(id),
                             [&](const Bond& b) { return rank[state.particles.row(b.other)] == 3; });
}

/// Part of one energy U_k in K_ii, with d = d_ki: v_k (mu |d|^2 + (lambda + mu) d d^T).
Symmetric stiffness(double volume, const ElasticConstants& c, const Vec3& d) {
  const double isotropic = volume * c.mu * dot(d, d);
  return (volume * (c.lambda + c.mu)) * square(d) + Symmetric{isotropic, isotropic, isotropic, 0.0, 0.0, 0.0};
}

/// lambda_max(K_ii)/m_i [1/s2]: how fast a particle swings while its neighbours stay, by its own energy and
/// those of its partners.
double frequency_of(const State& state, const ElasticForms& forms, std::uint32_t id) {
  const Particles& p = state.particles;
  const EnergyOwners owns(state);
  const auto volume = p[field::solid_volume];
  const std::size_t i = p.row(id);
  const Symmetric A = shape_inverse_of(p, i);
  Vec3 own;
  Symmetric K;
  double springs = 0.0;
  for (const Bond& b : state.bonds.of(id)) {
    const std::size_t j = p.row(b.other);
    const auto spring = [&](std::size_t k, const Bond& of) {
      return 0.5 * forms.hourglass() * forms.constants(state, k).young * volume[i] * volume[j] * of.weight /
             dot(of.x, of.x);
    };
    own += volume[j] * (A * b.gradient);
    if (owns(i)) springs += spring(i, b);
    if (!owns(j)) continue;
    const Bond& twin = state.bonds.of(b.other)[b.twin];
    springs += spring(j, twin);
    K = K +
        stiffness(volume[j], forms.constants(state, j), volume[i] * (shape_inverse_of(p, j) * twin.gradient));
  }
  if (owns(i)) K = K + stiffness(volume[i], forms.constants(state, i), own);
  return (largest_eigenvalue(K) + springs) / p[field::mass][i];
}

/// These ids and their partners, ascending, each once.
std::vector<std::uint32_t> with_partners(const State& state, std::span<const std::uint32_t> ids) {
  std::vector<std::uint32_t> all(ids.begin(), ids.end());
  for (const std::uint32_t id : ids)
    for (const Bond& b : state.bonds.of(id)) all.push_back(b.other);
  std::ranges::sort(all);
  all.erase(std::ranges::unique(all).begin(), all.end());
  return all;
}

}  // namespace

Symmetric shape_inverse_of(const Particles& p, std::size_t row) { return shape_inverses(p).at(row); }

Symmetric plastic_strain_of(const Particles& p, std::size_t row) {
  return p.has(field::plastic_strain) ? plastic_strains(p).at(row) : Symmetric{};
}

void set_plastic_strain(Particles& p, std::size_t row, const Symmetric& e) { plastic_strains(p).set(row, e); }

Symmetric strain_of(const Particles& p, std::size_t row) { return strains(p).at(row); }

bool softens(const Scene& scene, const Material& m) {
  if (turns_elastic(scene, m)) return true;
  return m.t_melt && m.solid == SolidKind::elastic && (m.softens || has_printed_stage(scene, m));
}

ElasticForms::ElasticForms(const Scene& scene)
    : paper_(scene.mode_of(term::elastic) == Mode::paper),
      hourglass_(scene.mode_of(term::hourglass) == Mode::paper
                     ? 0.0
                     : kept_number(scene.values, key_row("scene", "hourglass"))),
      bending_(paper_ ? 0.0 : kept_number(scene.values, key_row("scene", "bending"))),
      factor_(paper_ ? 2.0 : 1.0) {
  for (const Material& m : scene.materials) {
    constants_.push_back(m.young_modulus && m.poisson_ratio
                             ? elastic_constants(*m.young_modulus, *m.poisson_ratio)
                             : ElasticConstants{});
    softens_.push_back(softens(scene, m));
    squared_limits_.push_back(m.elastic_limit ? *m.elastic_limit * *m.elastic_limit
                                              : std::numeric_limits<double>::infinity());
  }
}

ElasticForms::Constants::Constants(const ElasticForms& forms, const State& state)
    : forms_(forms),
      stiffness_(state.particles[field::solid_stiffness]),
      material_(state.particles[field::solid_material]) {
  if (state.particles.has(field::stiffness_share.name)) share_ = state.particles[field::stiffness_share];
}

ElasticConstants ElasticForms::Constants::operator()(std::size_t row) const {
  const auto m = static_cast<std::size_t>(material_[row]);
  return (forms_.softens_[m] && !share_.empty() ? stiffness_[row] * share_[row] : stiffness_[row]) *
         forms_.constants_[m];
}

Symmetric ElasticForms::projector(const Symmetric& shape_inverse, int rank) const {
  return range_projector(shape_inverse, rank);
}

Symmetric ElasticForms::strain(const Matrix3& F, const Symmetric& P, int rank) const {
  const Symmetric eps = paper_ ? strain_paper(F) : green_strain(F);
  return rank == 3 ? eps : between(P, eps);
}

Symmetric ElasticForms::stress(const Symmetric& elastic_strain, const Symmetric& P, int rank,
                               const ElasticConstants& c) const {
  return solid::stress(elastic_strain, P, rank, c);
}

void refresh_shapes(State& state, std::span<const std::uint32_t> ids, bool first) {
  Particles& p = state.particles;
  const ElasticForms forms(state.scene);
  const ElasticParticles is_elastic(state);
  const EnergyOwners owns(state);
  const ElasticityKernel kernel = bond_kernel(state.scene);
  for (const std::uint32_t id : ids) set_stiffness(state, is_elastic, id);
  for (const std::uint32_t id : ids)
    p[field::solid_volume][p.row(id)] = volume_of(state, forms.paper(), owns(p.row(id)), id);
  for (const std::uint32_t id : ids) {
    const std::size_t i = p.row(id);
    ShapeInverse shape{{}, owns(i) || state.bonds.of(id).empty() ? 0 : no_energy_rank};
    if (owns(i) && forms.paper()) shape = {{1.0, 1.0, 1.0, 0.0, 0.0, 0.0}, 3};
    if (owns(i) && !forms.paper()) {
      if (forms.bending() != 0.0) set_kernel_gradients(state, kernel, id);
      const Symmetric moment = moment_of(state, id);
      shape = shape_inverse(moment);
      if (forms.bending() != 0.0 && shape.rank == full_rank(state.scene))
        correct_for_bending(state, id, forms.bending(), moment, shape.inverse);
    }
    shape_inverses(p).set(i, shape.inverse);
    p[field::shape_rank][i] = shape.rank;
  }
  const bool needs_frequency = !first && p.has(field::bond_frequency.name);
  for (const std::uint32_t id : with_partners(state, ids)) {
    const std::size_t i = p.row(id);
    p[field::regular_bonds][i] = is_regular(state, id);
    if (needs_frequency) p[field::bond_frequency][i] = frequency_of(state, forms, id);
  }
}

Deformation deformation_of(const State& state, const ElasticForms& forms, std::uint32_t id, double back) {
  const Particles& p = state.particles;
  const std::size_t i = p.row(id);
  Deformation d;
  d.rank = p[field::shape_rank][i];
  if (!EnergyOwners(state)(i)) return d;
  const auto volume = p[field::solid_volume];
  const Symmetric A = shape_inverse_of(p, i);
  Matrix3 sum;
  for (const Bond& b : state.bonds.of(id)) {
    const std::size_t j = p.row(b.other);
    sum = sum + outer(separation(state, i, j, back) + b.x, volume[j] * b.gradient);
  }
  d.F = deformation_gradient(sum, A);
  d.P = forms.projector(A, d.rank);
  d.strain = forms.strain(d.F, d.P, d.rank);
  return d;
}

Deformation deformation_of(const State& state, std::uint32_t id) {
  return deformation_of(state, ElasticForms(state.scene), id);
}

DeformationEnergy deformation_energy(const State& state, const ElasticForms& forms, std::uint32_t id,
                                     double back) {
  const Particles& p = state.particles;
  const std::size_t i = p.row(id);
  if (!EnergyOwners(state)(i)) return {};
  const Deformation d = deformation_of(state, forms, id, back);
  const auto volume = p[field::solid_volume];
  const ElasticConstants c = forms.constants(state, i);
  const Symmetric elastic = between(d.P, d.strain - plastic_strain_of(p, i));
  DeformationEnergy energy{0.5 * volume[i] * contraction(elastic, forms.stress(elastic, d.P, d.rank, c)),
                           0.0};
  if (forms.hourglass() == 0.0) return energy;
  for (const Bond& b : state.bonds.of(id)) {
    const std::size_t j = p.row(b.other);
    const Vec3 r = separation(state, i, j, back), x = -b.x;
    const Vec3 e = hourglass_residual(d.F, x, r);
    const double flat = hourglass_residual_flat(d.strain, x, r);
    energy.hourglass += 0.25 * forms.hourglass() * c.young * volume[i] * volume[j] * b.weight *
                        (d.rank == 3 ? dot(e, e) / dot(x, x) : flat * flat);
  }
  return energy;
}

DeformationEnergy deformation_energy(const State& state, std::uint32_t id) {
  return deformation_energy(state, ElasticForms(state.scene), id);
}

Quaternion orientation_of(const State& state, std::size_t body) {
  if (!state.particles.has(field::shape_rank.name)) return {};
  const ElasticForms forms(state.scene);
  std::vector<double> parts;  // of each member its number and nine of a matrix
  for (const std::size_t i : members(state, body)) {
    if (!state.owns(i)) continue;
    const int id = state.particles[field::id][i];
    const Deformation d = deformation_of(state, forms, static_cast<std::uint32_t>(id));
    const Matrix3 m = state.particles[field::mass][i] * rotation_of(d.F, d.P, d.rank);
    const int number = state.halo ? state.halo->numbers()[static_cast<std::size_t>(id)] : id;
    parts.insert(parts.end(),
                 {static_cast<double>(number), m.xx, m.xy, m.xz, m.yx, m.yy, m.yz, m.zx, m.zy, m.zz});
  }
  if (state.halo) parts = state.halo->all_of(parts);
  Matrix3 sum;
  for (const double* n : records_in_order(parts, 10))
    sum = sum + Matrix3{n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8], n[9]};
  return quaternion_of(rotation_of(sum, {1.0, 1.0, 1.0, 0.0, 0.0, 0.0}, 3));
}

}  // namespace tripoint::solid
