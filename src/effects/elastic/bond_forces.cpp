// SPDX-License-Identifier: BSD-3-Clause
#include "effects/elastic/bond_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "effects/elastic/fields.hpp"
#include "state/failure.hpp"

namespace tripoint::elastic {
namespace {

using solid::ElasticForms;

PeriodicWidths periodic_widths(const PeriodicBox& box) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const auto half = [&](std::size_t a) { return box.periodic[a] ? 0.5 * box.width[a] : never; };
  const auto width = [&](std::size_t a) { return box.periodic[a] ? box.width[a] : 0.0; };
  return {{half(0), half(1), half(2), never}, {width(0), width(1), width(2), 0.0}};
}

/// Sets T = (v F S + H) A, and the force of each particle's own energy on it.
class Stresses {
 public:
  Stresses(State& state, const ElasticForms& forms, Deformations& all)
      : forms_(forms),
        all_(all),
        constants_(forms.constants(state)),
        force_(triple(state.particles, field::elastic_force)) {}
  void none(std::size_t row) { force_.set(row, {}); }
  /// @param G F - I   @param elastic strain less what has flowed   @param A shape inverse   @param P
  /// projector on its range
  void set(std::size_t row, std::size_t id, const Matrix3& G, const Matrix3& H, const Symmetric& elastic,
           const Symmetric& A, const Symmetric& P, int rank) {
    const Symmetric S = forms_.stress(elastic, P, rank, constants_(row));
    const Matrix3 T = ((forms_.force_factor() * all_.places[id].volume) * ((identity3 + G) * S) + H) * A;
    all_.deformed[id].set_T(T);
    force_.set(row, T * all_.reference[id].gradient + all_.hourglass_force[id]);
  }

 private:
  const ElasticForms& forms_;
  Deformations& all_;
  ElasticForms::Constants constants_;
  Triple<double> force_;
};

/// det F of a solid. @param G F - I
double volume_ratio(const Matrix3& G) { return determinant(identity3 + G); }

bool flows(const State& state) { return state.particles.has(field::may_flow.name); }

/// Strain less what has flowed, within the range of P.
inline Symmetric elastic_strain(const Symmetric& strain, const Symmetric& plastic, const Symmetric& P,
                                int rank) {
  const Symmetric e = strain - plastic;
  return rank == 3 ? e : between(P, e);
}

/// Of the hourglass energy of a solid: its modulus and the force of its own energy on it. @return H [N m]
Matrix3 resist_hourglass(Deformations& all, std::uint32_t id, double stiff, const Matrix3& G,
                         const ListSums& sums) {
  const double volume = all.places[id].volume;
  const ReferenceSums& reference = all.reference[id];
  all.deformed[id].set_moduli(stiff, 0.0, volume);
  all.hourglass_force[id] = (volume * stiff) * (G * reference.hourglass + sums.residual);
  return (stiff * volume) * (G * reference.moment + sums.swept);
}

/// Of a sheet or chain, where no force acts on it itself.
/// @return H = -F sum_j kappa_ij y y^T, y = P x_ji, kappa_ij = (a E/2) v_i v_j W g_ij/|x_ij|^2 [N m]
Matrix3 resist_flat_hourglass(const State& state, Deformations& all, std::uint32_t id, double stiff,
                              const Symmetric& strain, const Symmetric& P, const Matrix3& F) {
  Symmetric sum;
  const Place& i = all.places[id];
  all.deformed[id].set_moduli(0.0, stiff, i.volume);
  all.hourglass_force[id] = {};
  for (const Bond& b : state.bonds.of(id)) {
    const Place& j = all.places[b.other];
    const Vec3 r = solid::nearest_image(state.box, j.r - i.r);
    const double kappa = stiff * i.volume * j.volume * b.weight / dot(b.x, b.x) *
                         solid::hourglass_residual_flat(strain, -b.x, r);
    sum = sum + kappa * square(P * b.x);
  }
  return -1.0 * (F * sum);
}

Matrix3 without_hourglass(Deformations& all, std::uint32_t id) {
  all.deformed[id].set_moduli(0.0, 0.0, 0.0);
  all.hourglass_force[id] = {};
  return {};
}

/// @param changed whether bonds or volumes have since `reference` was summed
void deform_all(State& state, const ElasticForms& forms, Deformations& all, bool changed) {
  Particles& p = state.particles;
  const auto id_of = p[field::id], rank_of = p[field::shape_rank];
  const solid::EnergyOwners owns(state);
  const auto constants = forms.constants(state);
  const auto shape = solid::shape_inverses(std::as_const(p));
  const auto strain_of = solid::strains(p);
  const PeriodicWidths box = periodic_widths(state.box);
  const bool hourglass = forms.hourglass() != 0.0;
  std::optional<SymmetricColumns<const double>> plastic_of;
  if (flows(state)) plastic_of = solid::plastic_strains(std::as_const(p));
  const auto may_flow = flows(state) ? p[field::may_flow] : std::span<int>{};
  const BondSums sum = bond_sums({state.box.any(), hourglass, forms.bending() != 0.0});
  Stresses stresses(state, forms, all);
  double least = 1.0;
#pragma omp parallel for schedule(static) num_threads(state.threads) reduction(min : least)
  for (std::size_t row = 0; row < p.size(); ++row) {
    if (!state.owns(row)) continue;  // its list is not whole here: it is handed over
    const auto id = static_cast<std::uint32_t>(id_of[row]);
    const BondLists::List list = all.lists.of(state.bonds, id);
    if (!owns(row)) {
      stresses.none(row);
      if (list.count > 0) all.deformed[id] = {};
      continue;
    }
    if (changed) sum.reference(list, all.lists.shapes(), all.places.data(), all.reference[id]);
    ListSums sums;
    sum.list(list, all.lists.shapes(), all.places.data(), all.places[id], box, sums);
    const int rank = rank_of[row];
    const Symmetric A = shape.at(row), P = forms.projector(A, rank);
    const Matrix3 F = solid::deformation_gradient(sums.displacement, A), G = F - identity3;
    const Symmetric strain = forms.strain(F, P, rank);
    strain_of.set(row, strain);
    all.deformed[id].set_measure(rank == 3 ? G : full(strain));
    if (rank == 3) least = std::min(least, volume_ratio(G));
    const double stiff = 0.5 * forms.hourglass() * constants(row).young;
    const Matrix3 H = !hourglass  ? without_hourglass(all, id)
                      : rank == 3 ? resist_hourglass(all, id, stiff, G, sums)
                                  : resist_flat_hourglass(state, all, id, stiff, strain, P, F);
    Symmetric elastic = strain;
    if (plastic_of) {
      const Symmetric plastic = plastic_of->at(row);
      elastic = elastic_strain(strain, plastic, P, rank);
      if (constants.may_flow(row, rank, elastic)) {
        may_flow[row] = 1;
        all.before_flow[id] = {G, H, plastic};
      }
    }
    stresses.set(row, id, G, H, elastic, A, P, rank);
  }
  all.least_volume_ratio = least;
}

/// Stresses anew of what has flowed since they were formed.
void follow_flow(State& state, const ElasticForms& forms, Deformations& all) {
  const Particles& p = state.particles;
  const auto id_of = p[field::id], rank_of = p[field::shape_rank], may_flow = p[field::may_flow];
  const auto shape = solid::shape_inverses(p), strain_of = solid::strains(p),
             plastic_of = solid::plastic_strains(p);
  Stresses stresses(state, forms, all);
#pragma omp parallel for schedule(static) num_threads(state.threads)
  for (std::size_t row = 0; row < p.size(); ++row) {
    if (may_flow[row] == 0) continue;
    const auto id = static_cast<std::size_t>(id_of[row]);
    const Symmetric plastic = plastic_of.at(row);
    if (plastic == all.before_flow[id].plastic) continue;
    const int rank = rank_of[row];
    const Symmetric A = shape.at(row), P = forms.projector(A, rank);
    const BeforeFlow& before = all.before_flow[id];
    stresses.set(row, id, before.G, before.H, elastic_strain(strain_of.at(row), plastic, P, rank), A, P,
                 rank);
  }
}

/// The force of the energy of k on its partner l, by the bond of k; the opposite acts on k.
Vec3 force_of(const Deformations& all, std::uint32_t k, std::uint32_t l, const Bond& of_k, const Vec3& r_lk) {
  const Deformed& d = all.deformed[k];
  const double volume = all.places[l].volume;
  Vec3 f = -volume * (d.T() * of_k.gradient);
  const double w = all.places[k].volume * volume * of_k.weight / dot(of_k.x, of_k.x);
  const Matrix3 measure = d.measure();
  if (d.solid_hourglass != 0.0)
    f += (d.solid_hourglass * w) * solid::hourglass_residual(identity3 + measure, -of_k.x, r_lk);
  if (d.flat_hourglass != 0.0)
    f -= (d.flat_hourglass * w * solid::hourglass_residual_flat(symmetric_part(measure), -of_k.x, r_lk)) *
         r_lk;
  return f;
}

/// Where sheets or chains take part, bond by bond.
Vec3 general_force(const State& state, const Deformations& all, std::uint32_t i) {
  Vec3 f;
  for (const Bond& b : state.bonds.of(i)) {
    const Vec3 r = solid::nearest_image(state.box, all.places[b.other].r - all.places[i].r);
    f += force_of(all, b.other, i, state.bonds.of(b.other)[b.twin], -r) - force_of(all, i, b.other, b, r);
  }
  return f;
}

/// Members of a rigid body that can melt have bonds too, and most are far from all that can deform.
bool feels_energy(const BondLists::List& list, const Deformations& all, std::uint32_t id) {
  return all.owns[id] != 0 ||
         std::any_of(list.other, list.other + list.count, [&](std::uint32_t j) { return all.owns[j] != 0; });
}

/// f = own + v_i sum_j (what the energies of the partners do).
void add_all(State& state, const ElasticForms& forms, const Deformations& all) {
  Particles& p = state.particles;
  const auto id_of = p[field::id], regular = p[field::regular_bonds];
  const auto f = triple(p, field::elastic_force);
  const PeriodicWidths box = periodic_widths(state.box);
  const BondSums sum = bond_sums({state.box.any(), forms.hourglass() != 0.0, forms.bending() != 0.0});
#pragma omp parallel for schedule(static) num_threads(state.threads)
  for (std::size_t row = 0; row < p.size(); ++row) {
    if (!state.owns(row)) continue;
    const auto id = static_cast<std::uint32_t>(id_of[row]);
    const BondLists::List list = all.lists.of(state.bonds, id);
    if (list.count == 0 || !feels_energy(list, all, id)) continue;
    if (!regular[row]) {
      f.set(row, general_force(state, all, id));
      continue;
    }
    PartnerForces of_partners;
    sum.partners(list, all.lists.shapes(), all.places.data(), all.deformed.data(), all.places[id], box,
                 of_partners);
    f.set(row, f.at(row) + all.places[id].volume * (Vec3(of_partners.stress) + of_partners.hourglass));
  }
}

/// @return whether a volume has changed, or who owns strain energy
bool set_places(State& state, Deformations& all) {
  Particles& p = state.particles;
  const auto x = positions(std::as_const(p));
  const auto id_of = std::as_const(p)[field::id];
  const auto volume = std::as_const(p)[field::solid_volume];
  all.places.resize(p.size());
  all.deformed.resize(p.size());
  all.hourglass_force.resize(p.size());
  if (flows(state)) {
    all.before_flow.resize(p.size());
    std::ranges::fill(p[field::may_flow], 0);
  }
  all.reference.resize(p.size());
  all.owns.resize(p.size());
  const solid::EnergyOwners owns(state);
  bool changed = false;
#pragma omp parallel for schedule(static) num_threads(state.threads) reduction(|| : changed)
  for (std::size_t row = 0; row < p.size(); ++row) {
    const auto id = static_cast<std::size_t>(id_of[row]);
    const char owner = owns(row);
    changed = changed || all.places[id].volume != volume[row] || all.owns[id] != owner;
    all.places[id] = {x.at(row), volume[row]};
    all.owns[id] = owner;
  }
  return changed;
}

}  // namespace

void deform(State& state, const ElasticForms& forms, Deformations& all) {
  const bool relisted = all.lists.follow(state.bonds), changed = set_places(state, all);
  deform_all(state, forms, all, relisted || changed);
}

void refuse_inversion(const State& state, const ElasticForms& forms, const Deformations& all) {
  const Particles& p = state.particles;
  if (forms.paper() || all.deformed.size() != p.size() || is_off(state.scene, GuardName::inversion)) return;
  const double least = all.least_volume_ratio;
  if (least > 0.0) return;
  const solid::EnergyOwners owns(state);
  const auto rank_of = p[field::shape_rank], id_of = p[field::id];
  const auto is_worst = [&](std::size_t row) {
    return rank_of[row] == 3 && owns(row) && state.owns(row) &&
           volume_ratio(all.deformed[static_cast<std::size_t>(id_of[row])].measure()) == least;
  };
  for (std::size_t row = 0; row < p.size(); ++row) {
    if (is_worst(row))
      fail(
          state, GuardName::inversion, row, "deformation", "state",
          fmt::format(
              "is turned inside out: det F = {:.3g}; a stiffer or finer solid, a slower load, or unguarded = "
              "[\"inversion\"] to go on",
              least));
  }
}

void add_forces(State& state, const ElasticForms& forms, Deformations& all) {
  if (flows(state)) follow_flow(state, forms, all);
  state.hand_to_ghosts(all.deformed);  // only the owner of a particle has all of its list
  add_all(state, forms, all);
}

}  // namespace tripoint::elastic
