// SPDX-License-Identifier: BSD-3-Clause
#include "effects/fracture/fracture.hpp"

#include <map>
#include <optional>
#include <utility>

#include "effects/fracture/bond_limit.hpp"
#include "effects/fracture/unbroken_proof.hpp"
#include "scene/shared_terms.hpp"
#include "solids/objects.hpp"
#include "solids/solid_particles.hpp"

namespace tripoint::fracture {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// Energy that broken bonds have let go [J].
constexpr EnergyAccount let_go_by_bonds{"fracture"};

class Fracture : public Effect {
 public:
  explicit Fracture(const Scene& scene) : limits_(scene) {}
  void load(State&, const InitialState&) override { unbroken_.clear(); }
  void drift(State&, double dt) override { drifted_ = dt; }
  [[nodiscard]] bool wants_change(State&) override;
  void change(State&) override;
  void adopt(State&) override { unbroken_.clear(); }
  void renumber(State&) override {
    unbroken_.clear();
    found_.reset();
  }
  void happen(State&, const Happening&) override { unbroken_.clear(); }
  void add_to(const State& state, Ledger& ledger) const override {
    ledger.energy["fracture"] += state.accumulated[let_go_by_bonds];
    // Torn faces may let go pressure too: an entry that begins within a run would have no first frame.
    for (const Force& f : state.forces)
      if (f.stored && !f.stored->released_to.empty())
        ledger.energy[std::string(f.stored->released_to)] += 0.0;
  }

 private:
  [[nodiscard]] std::vector<Pair> broken(const State&);
  bool find(const State&);

  BondLimits limits_;
  double drifted_ = 0.0;  ///< since the last forces, within a step [s]
  double back_ = 0.0;     ///< half of that, when bonds were last looked at [s]
  UnbrokenProof unbroken_;
  std::optional<std::vector<Pair>> found_;  ///< by wants_change(), where ids are still the same
  std::vector<char> has_broken_;            ///< memory that is used again, by id
};

/// Bonds that are beyond their limit, as lower and higher id, in order. Members of rigid bodies cannot move
/// apart.
std::vector<Pair> Fracture::broken(const State& state) {
  const Particles& p = state.particles;
  const solid::ElasticParticles is_elastic(state);
  const auto material = p[field::material];
  const auto x = positions(p);
  struct Ends {
    Vec3 r;
    std::size_t a, b;  ///< materials
  };
  const auto ends_of = [&](std::size_t i, const Bond& bond) {
    const std::size_t j = p.row(bond.other);
    return Ends{solid::nearest_image(state.box, x.at(i) - x.at(j)), static_cast<std::size_t>(material[i]),
                static_cast<std::size_t>(material[j])};
  };
  has_broken_.assign(p.size(), 0);
  double least = std::numeric_limits<double>::infinity();
#pragma omp parallel for schedule(static) num_threads(state.threads) reduction(min : least)
  for (std::size_t id = 0; id < p.size(); ++id) {
    const std::size_t i = p.row(id);
    if (!is_elastic(i)) continue;
    for (const Bond& b : state.bonds.of(id)) {
      const Ends e = ends_of(i, b);
      if (limits_.breaks(e.r, b, e.a, e.b)) has_broken_[id] = 1;
      least = std::min(least, limits_.headroom(e.r, b, e.a, e.b));
    }
  }
  unbroken_.set(state, least);
  std::vector<Pair> pairs;
  for (std::uint32_t id = 0; id < p.size(); ++id) {
    if (!has_broken_[id]) continue;
    for (const Bond& b : state.bonds.of(id)) {
      const Ends e = ends_of(p.row(id), b);
      if (limits_.breaks(e.r, b, e.a, e.b)) pairs.push_back(std::minmax(id, b.other));
    }
  }
  sort_once(pairs);
  return pairs;
}

/// Stored energy and elastic strain from before bonds broke, and the use of both afterwards.
class Release {
 public:
  /// @param back time before now at which energies and strains are taken [s]
  Release(State& state, double back) : state_(state), forms_(state.scene), back_(back) {}

  /// To be called ahead of a change to the list of a particle. As printed its partners change with it: its
  /// volume is a sum over the list.
  void touch(std::uint32_t id) {
    remember(id);
    if (!forms_.paper()) return;
    for (const Bond& b : std::as_const(state_.bonds).of(id)) remember(b.other);
  }
  /// Shapes and plastic strain by the lists of now; the energy let go is accumulated.
  void settle() {
    std::vector<std::uint32_t> ids;
    for (const auto& [id, before] : before_) ids.push_back(id);
    solid::refresh_shapes(state_, ids);
    if (state_.particles.has(field::plastic_strain))
      for (const std::uint32_t id : ids) keep_elastic_strain(id);
    double let_go = 0.0;
    for (const auto& [id, before] : before_)
      let_go += before.energy - solid::deformation_energy(state_, forms_, id, back_).total();
    state_.accumulated[let_go_by_bonds] += let_go;
    state_.accumulated[account::deformation_released] += let_go;
  }

 private:
  struct Before {
    double energy = 0.0;         ///< [J]
    Symmetric elastic, plastic;  ///< strains
  };
  void remember(std::uint32_t id) {
    if (before_.contains(id)) return;
    const solid::Deformation d = solid::deformation_of(state_, forms_, id, back_);
    const Symmetric plastic = solid::plastic_strain_of(state_.particles, state_.particles.row(id));
    before_[id] = {solid::deformation_energy(state_, forms_, id, back_).total(),
                   between(d.P, d.strain - plastic), plastic};
  }
  /// A particle that has flowed and loses bonds sees another strain at once. eps_p changes with it, so that P
  /// (eps - eps_p) P does not jump. Without this the tear of a plastic bar creates energy.
  void keep_elastic_strain(std::uint32_t id) {
    const Before& before = before_.at(id);
    if (before.plastic == Symmetric{}) return;
    const solid::Deformation d = solid::deformation_of(state_, forms_, id, back_);
    solid::set_plastic_strain(state_.particles, state_.particles.row(id),
                              between(d.P, d.strain - before.elastic));
  }

  State& state_;
  solid::ElasticForms forms_;
  double back_;
  std::map<std::uint32_t, Before> before_;
};

/// Rows of the deformable bodies that these particles are of.
std::vector<std::size_t> bodies_of(const State& state, const std::vector<Pair>& pairs) {
  std::vector<std::size_t> rows;
  const auto body = state.particles[field::body];
  for (const Pair& pair : pairs)
    for (const std::uint32_t id : {pair.first, pair.second})
      if (const std::size_t i = state.particles.row(id); solid::ElasticParticles(state)(i))
        rows.push_back(static_cast<std::size_t>(body[i]));
  sort_once(rows);
  return rows;
}

/// Looks at all bonds, where one can have broken. @return whether one has
bool Fracture::find(const State& state) {
  found_.reset();
  if (unbroken_.holds(state)) return false;
  found_ = broken(state);
  return !found_->empty();
}

/// A bond is in the lists of both its particles: the owner of either of them sees it break.
bool Fracture::wants_change(State& state) {
  back_ = 0.5 * std::exchange(drifted_, 0.0);
  return find(state);
}

void Fracture::change(State& state) {
  if (!found_ && !find(state)) return;
  const std::vector<Pair> pairs = *std::exchange(found_, {});
  // Only the first of the two kicks around a drift has the force of a bond, so the bond broke half way. It
  // lets go the energy that it stored there, to second order in the step.
  Release release(state, back_);
  for (const auto& [i, j] : pairs) {
    release.touch(i);
    release.touch(j);
  }
  for (const auto& [i, j] : pairs) {
    disconnect(state.bonds, i, [&, j = j](const Bond& b) { return b.other == j; });
    end_own(state.own, i, j);
    state.change.relisted.insert(state.change.relisted.end(), {i, j});
  }
  regroup(state, {bodies_of(state, pairs), {}}, [&](std::uint32_t id) { release.touch(id); });
  release.settle();
}

}  // namespace

EffectSpec spec(const Scene& scene) {
  EffectSpec s{"fracture",
               scene.mode_of(term::elastic),
               {},
               fields::joined({fields::position(),
                               fields::velocity(),
                               {field::mass},
                               fields::deformation(),
                               fields::shapes(),
                               fields::grouping()}),
               {},
               {let_go_by_bonds}};
  s.changes = true;
  s.reads_if_there = fields::joined({fields::deformation_if_there(), fields::shapes_if_there()});
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<Fracture>(scene); }

}  // namespace tripoint::fracture
