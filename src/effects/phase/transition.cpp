// SPDX-License-Identifier: BSD-3-Clause
#include "effects/phase/transition.hpp"

#include <algorithm>
#include <iterator>
#include <map>

#include "effects/phase/joining.hpp"
#include "scene/shared_terms.hpp"
#include "solids/fusion.hpp"
#include "solids/objects.hpp"
#include "solids/solid_particles.hpp"
#include "state/body_table.hpp"

namespace tripoint::phase {
namespace {

/// A solid nearer than the distance that joins.
struct Partner {
  std::uint32_t id;
  Vec3 r;  ///< r_i - r_j, the shortest of the periodic images [m]
};

/// In order of id, each once.
std::vector<Partner> partners_of(const State& state, std::uint32_t id) {
  const Particles& p = state.particles;
  const std::size_t i = p.row(id);
  const auto x = positions(p);
  const auto phase = p[field::phase];
  const double reach = joining_distance(state.scene);
  std::map<std::uint32_t, Vec3> nearest;
  for (const Entry e : state.neighbours->of(i)) {
    const std::size_t j = e.row();
    if (j == i || phase[j] == static_cast<int>(Phase::liquid) || !may_join(state, j)) continue;
    const Vec3 r = -1.0 * ((x.at(j) - x.at(i)) + state.neighbours->shift(e.image()));
    if (norm(r) >= reach) continue;
    const auto [at, first] = nearest.try_emplace(static_cast<std::uint32_t>(p[field::id][j]), r);
    if (!first && dot(r, r) < dot(at->second, at->second)) at->second = r;
  }
  std::vector<Partner> list;
  for (const auto& [other, r] : nearest) list.push_back({other, r});
  return list;
}

/// Whether a change of a list changes the volume of its particle, and with it the energies of all that list
/// it.
bool volumes_follow_lists(const State& state) { return state.scene.mode_of(term::elastic) == Mode::paper; }

/// Phase of a solid particle at this liquid fraction, of a material that may turn.
Phase solid_phase(const Scene& scene, const Material& m, double f) {
  if (m.solid != SolidKind::rigid) return Phase::elastic;
  return turns_elastic(scene, m) && f > 0.0 ? Phase::elastic : Phase::rigid;
}

class Transition {
 public:
  Transition(State& state, ReleasedEnergy& released) : state_(state), released_(released) {
    const auto body = state.particles[field::body];
    for (std::size_t id = 0; id < body.size(); ++id) body_before_.push_back(body[state.particles.row(id)]);
  }
  void melt(std::uint32_t id);
  void turn(const std::vector<std::uint32_t>& ids);
  void freeze(const std::vector<std::uint32_t>& ids);
  void regroup_bodies(const std::vector<std::uint32_t>& frozen);
  void record(const Events&);

 private:
  void touch_with_partners(std::uint32_t id, std::uint32_t event);
  void end_pairs_of_rigid(const std::vector<std::uint32_t>& ids);

  State& state_;
  ReleasedEnergy& released_;
  ChangedBodies changed_;
  std::vector<int> body_before_;  ///< by id
};

void Transition::touch_with_partners(std::uint32_t id, std::uint32_t event) {
  released_.touch(id, event);
  for (const Bond& bond : std::as_const(state_.bonds).of(id)) {
    released_.touch(bond.other, event);
    if (!volumes_follow_lists(state_)) continue;
    for (const Bond& next : std::as_const(state_.bonds).of(bond.other)) released_.touch(next.other, event);
  }
}

void Transition::melt(std::uint32_t id) {
  const std::size_t i = state_.particles.row(id);
  Change& change = state_.change;
  touch_with_partners(id, id);
  const std::vector<std::uint32_t> lost = disconnect(state_.bonds, id, [](const Bond&) { return true; });
  change.relisted.insert(change.relisted.end(), lost.begin(), lost.end());
  const auto own = std::as_const(state_.own).of(id);
  const std::vector<ExcludedPair> pairs(own.begin(), own.end());
  for (const ExcludedPair& pair : pairs) {
    end_own(state_.own, id, pair.other);
    change.relisted.push_back(pair.other);
  }
  change.relisted.push_back(id);
  change.regrouped.push_back(id);
  const auto body = static_cast<std::size_t>(state_.particles[field::body][i]);
  changed_.bodies.push_back(body);
  change.bodies.push_back(body);
  state_.particles[field::body][i] = -1;
  state_.particles[field::phase][i] = static_cast<int>(Phase::liquid);
}

/// Bonds stay, so that a particle that turns elastic is joined to its mates and to nothing that it touches. A
/// particle that was rigid is not strained, and one that becomes rigid lets its strain go: both have the
/// present vectors. At a joint the list of a rigid member is strained with its partners, and stays so.
void Transition::turn(const std::vector<std::uint32_t>& ids) {
  if (ids.empty()) return;
  Particles& p = state_.particles;
  const ElasticityKernel kernel = solid::bond_kernel(state_.scene);
  const solid::EnergyOwners owns(state_);
  const auto f = p[field::liquid_fraction];
  std::vector<std::uint32_t> unstrained;
  for (const std::uint32_t id : ids) {
    const std::size_t i = p.row(id);
    touch_with_partners(id, id);
    p[field::phase][i] = static_cast<int>(solid_phase(state_.scene, state_.material_of(i), f[i]));
    if (p[field::phase][i] == static_cast<int>(Phase::rigid) || !owns(i)) unstrained.push_back(id);
    for (const Bond& bond : std::as_const(state_.bonds).of(id)) {
      if (!owns(p.row(bond.other))) unstrained.push_back(bond.other);
      state_.change.relisted.push_back(bond.other);
    }
    if (p.has(field::plastic_strain)) solid::set_plastic_strain(p, i, {});
    changed_.bodies.push_back(static_cast<std::size_t>(p[field::body][i]));
    state_.change.bodies.push_back(static_cast<std::size_t>(p[field::body][i]));
    state_.change.relisted.push_back(id);
    state_.change.regrouped.push_back(id);
    p[field::body][i] = -1;
  }
  sort_once(unstrained);
  for (const std::uint32_t id : unstrained) take_present_vectors(state_, kernel, id);
  end_pairs_of_rigid(ids);
}

/// Members of one rigid body exert nothing on each other as it is.
void Transition::end_pairs_of_rigid(const std::vector<std::uint32_t>& ids) {
  const auto phase = state_.particles[field::phase];
  const auto is_rigid = [&](std::uint32_t id) {
    return phase[state_.particles.row(id)] == static_cast<int>(Phase::rigid);
  };
  for (const std::uint32_t id : ids) {
    if (!is_rigid(id)) continue;
    const auto own = std::as_const(state_.own).of(id);
    for (const ExcludedPair& pair : std::vector<ExcludedPair>(own.begin(), own.end())) {
      if (!is_rigid(pair.other)) continue;
      end_own(state_.own, id, pair.other);
      state_.change.relisted.push_back(pair.other);
    }
  }
}

/// All become solid at first, so that two that freeze at once are partners.
void Transition::freeze(const std::vector<std::uint32_t>& ids) {
  Particles& p = state_.particles;
  for (const std::uint32_t id : ids) {
    const std::size_t i = p.row(id);
    p[field::phase][i] =
        static_cast<int>(solid_phase(state_.scene, state_.material_of(i), p[field::liquid_fraction][i]));
    if (p.has(field::plastic_strain)) solid::set_plastic_strain(p, i, {});
    state_.change.relisted.push_back(id);
    state_.change.regrouped.push_back(id);
  }
  std::vector<Joint> joints;
  for (const std::uint32_t id : ids) {
    released_.touch(id, id);
    for (const Partner& partner : partners_of(state_, id)) {
      const bool both_freeze = std::ranges::binary_search(ids, partner.id);
      if (both_freeze && partner.id < id) continue;
      joints.push_back({id, partner.id, partner.r, both_freeze});
      volumes_follow_lists(state_) ? touch_with_partners(partner.id, id) : released_.touch(partner.id, id);
      state_.change.relisted.push_back(partner.id);
      if (const int body = p[field::body][p.row(partner.id)]; body >= 0)
        changed_.bodies.push_back(static_cast<std::size_t>(body));
    }
  }
  bond(state_, joints);
}

void Transition::regroup_bodies(const std::vector<std::uint32_t>& frozen) {  // and turned
  changed_.frozen = frozen;
  regroup(state_, changed_, [&](std::uint32_t id) { released_.touch(id); });
  make_excluded_pairs(state_, frozen);
}

void Transition::record(const Events& events) {
  Change& change = state_.change;
  change.melted.insert(change.melted.end(), events.melted.begin(), events.melted.end());
  change.frozen.insert(change.frozen.end(), events.frozen.begin(), events.frozen.end());
  change.frozen.insert(change.frozen.end(), events.turned.begin(), events.turned.end());
  sort_once(change.regrouped);
  sort_once(change.relisted);
  sort_once(change.bodies);
  for (const std::uint32_t id : change.regrouped) change.came_from[id] = body_before_[id];
}

/// Tells of rows whether they are solid and of the wrong kind for their temperature, as printed (Fig. 5).
class Turns {
 public:
  explicit Turns(const State& state) : state_(state) {
    for (const Material& m : state.scene.materials) may_.push_back(turns_elastic(state.scene, m));
    any_ = std::ranges::find(may_, 1) != may_.end();
  }
  [[nodiscard]] bool operator()(std::size_t row) const {
    const Particles& p = state_.particles;
    if (!any_ || !may_[static_cast<std::size_t>(p[field::material][row])] || p[field::body][row] < 0)
      return false;
    const double f = p[field::liquid_fraction][row];
    if (f >= 1.0 || is_given_to_driven(row)) return false;
    return p[field::phase][row] != static_cast<int>(solid_phase(state_.scene, state_.material_of(row), f));
  }

 private:
  [[nodiscard]] bool is_given_to_driven(std::size_t row) const {
    const auto body = static_cast<std::size_t>(state_.particles[field::body][row]);
    const bool driven = state_.bodies[field::body_motion][body] != static_cast<int>(Motion::free);
    return driven && state_.bodies[field::body_source][body] == state_.particles[field::source][row];
  }

  const State& state_;
  std::vector<char> may_;  ///< of each material
  bool any_ = false;
};

}  // namespace

Events events_of(const State& state) {
  const Particles& p = state.particles;
  const auto f = p[field::liquid_fraction];
  const auto body = p[field::body];
  const auto material = p[field::material];
  const bool guided = p.has(field::driven.name);
  const auto driven = guided ? p[field::driven] : std::span<const int>{};
  const std::vector<Fusion> fusions = fusions_of(state.scene);
  const Turns turns(state);
  Events events;
  for (std::uint32_t id = 0; id < p.size(); ++id) {
    const std::size_t i = p.row(id);
    if (turns(i)) events.turned.push_back(id);
    if (!changes_phase(fusions[static_cast<std::size_t>(material[i])], body[i] >= 0, f[i])) continue;
    if (body[i] < 0 && guided && driven[i] != 0) continue;  // while the scene moves it, it flows
    (body[i] >= 0 ? events.melted : events.frozen).push_back(id);
  }
  return events;
}

bool may_join(const State& state, std::size_t row) {
  if (state.material_of(row).t_melt) return true;
  const auto source = static_cast<std::size_t>(state.particles[field::source][row]);
  return source < state.scene.bodies.size() && state.scene.bodies[source].joins;
}

void carry_out(State& state, const Events& events, ReleasedEnergy& released) {
  Transition transition(state, released);
  for (const std::uint32_t id : events.melted) transition.melt(id);
  transition.turn(events.turned);
  transition.freeze(events.frozen);
  std::vector<std::uint32_t> of_no_body;
  std::ranges::merge(events.frozen, events.turned, std::back_inserter(of_no_body));
  transition.regroup_bodies(of_no_body);
  transition.record(events);
}

void connect_rigid_bodies(State& state) {
  const Particles& p = state.particles;
  const RigidMembers is_member(state);
  const auto x = positions(p);
  const auto body = p[field::body];
  std::vector<Joint> joints;
  for (std::uint32_t id = 0; id < p.size(); ++id) {
    const std::size_t i = p.row(id);
    if (!is_member(i)) continue;
    std::map<std::uint32_t, Vec3> nearest;
    const auto bonds = std::as_const(state.bonds).of(id);
    for (const Entry e : state.neighbours->of(i)) {
      const std::size_t j = e.row();
      const auto other = static_cast<std::uint32_t>(p[field::id][j]);
      if (body[j] != body[i] || other <= id || !(state.material_of(i).t_melt || state.material_of(j).t_melt))
        continue;
      if (std::ranges::find(bonds, other, &Bond::other) != bonds.end()) continue;  // near an elastic joint
      const Vec3 r = -1.0 * ((x.at(j) - x.at(i)) + state.neighbours->shift(e.image()));
      if (norm(r) < joining_distance(state.scene)) nearest.try_emplace(other, r);
    }
    for (const auto& [other, r] : nearest) joints.push_back({id, other, r, true});
  }
  bond(state, joints);
}

}  // namespace tripoint::phase
