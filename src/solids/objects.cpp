// SPDX-License-Identifier: BSD-3-Clause
#include "solids/objects.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "state/body_table.hpp"

namespace tripoint {
namespace {

constexpr std::uint32_t no_node = ~std::uint32_t{0};

bool is_driven(const State& state, int body) {
  return body >= 0 &&
         state.bodies[field::body_motion][static_cast<std::size_t>(body)] != static_cast<int>(Motion::free);
}

/// A member of a changed body, or a particle that froze.
struct Node {
  std::uint32_t id;
  int body;    ///< before; -1: it froze
  bool rigid;  ///< moves as one with its body
  bool given;  ///< to its body by the scene
};

/// Disjoint sets of nodes, each with the driven body that it belongs to, or -1.
class Sets {
 public:
  explicit Sets(std::vector<int> driven) : parent_(driven.size()), driven_(std::move(driven)) {
    for (std::uint32_t n = 0; n < parent_.size(); ++n) parent_[n] = n;
  }
  std::uint32_t root(std::uint32_t n) {
    while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
    return n;
  }
  /// The lowest node is the root. Two driven bodies stay two.
  void unite(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    if (a == b || (driven_[a] >= 0 && driven_[b] >= 0 && driven_[a] != driven_[b])) return;
    if (b < a) std::swap(a, b);
    parent_[b] = a;
    driven_[a] = std::max(driven_[a], driven_[b]);
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<int> driven_;
};

class Grouping {
 public:
  Grouping(State& state, const ChangedBodies& changed) : state_(state), rows_(changed.bodies) {
    sort_once(rows_);
    collect(changed.frozen);
  }
  void run(const BeforeRelisting& before) {
    unite();
    assign_rows();
    end_pairs(before);
    record_change();
  }

 private:
  void collect(const std::vector<std::uint32_t>& frozen);
  void unite();
  void assign_rows();
  void end_pairs(const BeforeRelisting& before);
  void record_change();
  [[nodiscard]] bool same_body_or_new(const Node& a, const Node& b) const {
    return a.body == b.body || a.body < 0 || b.body < 0;
  }
  [[nodiscard]] std::map<std::pair<int, int>, std::uint32_t> blocks_that_never_melt() const;
  [[nodiscard]] int new_row(std::size_t component);
  /// Component that the particle with this id belongs to, or below -1 its unchanged body; -1 for liquids.
  [[nodiscard]] int holder(std::uint32_t id) const;

  State& state_;
  std::vector<std::size_t> rows_;
  std::vector<Node> nodes_;          ///< ascending by id
  std::vector<std::uint32_t> node_;  ///< by id
  /// Of a node; components are in order of their lowest id
  std::vector<std::uint32_t> component_;
  std::vector<std::vector<std::uint32_t>> members_;  ///< nodes of a component
  std::vector<int> row_;                             ///< body of a component
};

void Grouping::collect(const std::vector<std::uint32_t>& frozen) {
  const Particles& p = state_.particles;
  const auto body = p[field::body], source = p[field::source], phase = p[field::phase];
  std::vector<char> is_changed(state_.bodies.size(), 0);
  for (const std::size_t b : rows_) is_changed[b] = 1;
  std::vector<std::uint32_t> ids = frozen;
  for (std::size_t i = 0; i < body.size(); ++i)
    if (body[i] >= 0 && is_changed[static_cast<std::size_t>(body[i])])
      ids.push_back(static_cast<std::uint32_t>(p[field::id][i]));
  sort_once(ids);
  node_.assign(p.size(), no_node);
  for (const std::uint32_t id : ids) {
    const std::size_t i = p.row(id);
    const int b = body[i];
    const bool rigid =
        b >= 0 ? is_rigid(state_, static_cast<std::size_t>(b)) : phase[i] == static_cast<int>(Phase::rigid);
    node_[id] = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({id, b, rigid,
                      b >= 0 && state_.bodies[field::body_source][static_cast<std::size_t>(b)] == source[i]});
  }
}

/// First node of the members that each rigid body has of each source and that never melt.
std::map<std::pair<int, int>, std::uint32_t> Grouping::blocks_that_never_melt() const {
  std::map<std::pair<int, int>, std::uint32_t> first;
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
    const std::size_t i = state_.particles.row(nodes_[n].id);
    if (nodes_[n].body >= 0 && nodes_[n].rigid && !state_.material_of(i).t_melt)
      first.try_emplace({nodes_[n].body, state_.particles[field::source][i]}, n);
  }
  return first;
}

void Grouping::unite() {
  std::vector<int> driven;
  for (const Node& node : nodes_) driven.push_back(is_driven(state_, node.body) ? node.body : -1);
  Sets sets(std::move(driven));
  const double joins = joining_distance(state_.scene);
  const auto blocks = blocks_that_never_melt();
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
    const Node& node = nodes_[n];
    const std::size_t i = state_.particles.row(node.id);
    if (node.body >= 0 && node.rigid && !state_.material_of(i).t_melt)
      sets.unite(n, blocks.at({node.body, state_.particles[field::source][i]}));
    for (const Bond& bond : state_.bonds.of(node.id)) {
      const std::uint32_t m = node_[bond.other];
      if (m == no_node || norm(bond.x) >= joins) continue;
      if (node.rigid == nodes_[m].rigid && same_body_or_new(node, nodes_[m])) sets.unite(n, m);
    }
  }
  component_.resize(nodes_.size());
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
    const std::uint32_t root = sets.root(n);
    if (root == n) {
      component_[n] = static_cast<std::uint32_t>(members_.size());
      members_.emplace_back();
    }
    component_[n] = component_[root];
    members_[component_[n]].push_back(n);
  }
}

void Grouping::assign_rows() {
  struct Claim {
    bool driven = false;
    std::size_t share = 0;
  };
  std::vector<std::map<int, Claim>> has(members_.size());  // component -> body before -> its part in it
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
    const Node& node = nodes_[n];
    if (node.body < 0) continue;
    Claim& claim = has[component_[n]][node.body];
    claim.driven = is_driven(state_, node.body);
    claim.share += claim.driven && !node.given ? 0 : 1;
  }
  std::map<int, std::pair<std::size_t, std::size_t>> keeper;  // body -> share, component that has most of it
  for (std::size_t c = 0; c < has.size(); ++c) {
    for (const auto& [body, claim] : has[c]) {
      const auto [at, first] = keeper.try_emplace(body, claim.share, c);
      if (!first && claim.share > at->second.first) at->second = {claim.share, c};
    }
  }
  row_.assign(members_.size(), -1);
  std::vector<Claim> best(members_.size());
  for (const auto& [body, kept] : keeper) {
    const std::size_t c = kept.second;
    const Claim& claim = has[c].at(body);
    if (row_[c] >= 0 && std::pair(claim.driven, claim.share) <= std::pair(best[c].driven, best[c].share))
      continue;
    row_[c] = body;
    best[c] = claim;
  }
  for (std::size_t c = 0; c < row_.size(); ++c)
    if (row_[c] < 0) row_[c] = new_row(c);
}

int Grouping::new_row(std::size_t component) {
  const std::vector<std::uint32_t>& group = members_[component];
  const std::size_t first = state_.particles.row(nodes_[group.front()].id);
  const auto phase = state_.particles[field::phase];
  const bool deformable = std::ranges::all_of(group, [&](std::uint32_t n) {
    return phase[state_.particles.row(nodes_[n].id)] == static_cast<int>(Phase::elastic);
  });
  std::map<int, std::size_t> parts;
  for (const std::uint32_t n : group)
    if (nodes_[n].body >= 0) ++parts[nodes_[n].body];
  const auto most = std::ranges::max_element(parts, {}, [](const auto& part) { return part.second; });
  const std::string parent = most != parts.end() ? state_.body_names[static_cast<std::size_t>(most->first)]
                                                 : state_.material_of(first).name;
  std::size_t n = 1;
  while (std::ranges::find(state_.body_names, parent + "." + std::to_string(n)) != state_.body_names.end())
    ++n;
  return static_cast<int>(
      add_body(state_, parent + "." + std::to_string(n), deformable ? Phase::elastic : Phase::rigid));
}

int Grouping::holder(std::uint32_t id) const {
  if (node_[id] != no_node) return static_cast<int>(component_[node_[id]]);
  const int body = state_.particles[field::body][state_.particles.row(id)];
  return body >= 0 ? -2 - body : -1;
}

void Grouping::end_pairs(const BeforeRelisting& before) {
  const double joins = joining_distance(state_.scene);
  std::set<std::pair<int, int>> joints;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> across;
  for (const Node& node : nodes_) {
    const int own = holder(node.id);
    for (const Bond& bond : state_.bonds.of(node.id)) {
      const int other = holder(bond.other);
      if (other == own || other == -1) continue;
      if (norm(bond.x) < joins) {
        joints.insert({own, other});
        joints.insert({other, own});
      }
      across.emplace_back(node.id, bond.other);
    }
  }
  const auto holds = [&](std::uint32_t i, std::uint32_t j) {
    const int a = holder(i), b = holder(j);
    return a == b || b == -1 || joints.contains({a, b});
  };
  std::erase_if(across, [&](const auto& pair) { return holds(pair.first, pair.second); });
  std::vector<std::uint32_t> losers;
  for (const auto& [i, j] : across) losers.insert(losers.end(), {i, j});
  sort_once(losers);
  if (before) std::ranges::for_each(losers, before);
  for (const auto& [i, j] : across)
    disconnect(state_.bonds, i, [&, j = j](const Bond& b) { return b.other == j; });
  Change& change = state_.change;
  change.relisted.insert(change.relisted.end(), losers.begin(), losers.end());
  for (const Node& node : nodes_) {
    std::vector<std::uint32_t> ends;
    for (const ExcludedPair& pair : std::as_const(state_.own).of(node.id))
      if (!holds(node.id, pair.other)) ends.push_back(pair.other);
    for (const std::uint32_t j : ends) {
      end_own(state_.own, node.id, j);
      change.relisted.insert(change.relisted.end(), {node.id, j});
    }
  }
}

void Grouping::record_change() {
  Change& change = state_.change;
  const auto body = state_.particles[field::body];
  std::vector<char> lives(state_.bodies.size(), 0);
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
    const int row = row_[component_[n]];
    lives[static_cast<std::size_t>(row)] = 1;
    if (row == nodes_[n].body) continue;
    body[state_.particles.row(nodes_[n].id)] = row;
    change.regrouped.push_back(nodes_[n].id);
    change.bodies.push_back(static_cast<std::size_t>(row));
    if (nodes_[n].body >= 0) change.bodies.push_back(static_cast<std::size_t>(nodes_[n].body));
  }
  for (const std::size_t b : rows_) {
    if (lives[b] || !is_alive(state_, b)) continue;
    state_.bodies[field::body_alive][b] = 0;
    change.bodies.push_back(b);
  }
  sort_once(change.regrouped);
  sort_once(change.relisted);
  sort_once(change.bodies);
}

}  // namespace

void regroup(State& state, const ChangedBodies& changed, const BeforeRelisting& before) {
  Grouping(state, changed).run(before);
}

namespace {

/// Bodies that have members, and pairs of bodies, the lower row first, that bonds hold together.
struct Held {
  std::vector<char> lives;
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
};

Held held_here(const State& state) {
  Held held{std::vector<char>(state.bodies.size(), 0), {}};
  const auto body = state.particles[field::body];
  for (std::uint32_t id = 0; id < state.particles.size(); ++id) {
    const int b = body[state.particles.row(id)];
    if (b < 0) continue;
    held.lives[static_cast<std::size_t>(b)] = 1;
    for (const Bond& bond : state.bonds.of(id)) {
      const int other = body[state.particles.row(bond.other)];
      if (other >= 0 && other != b)
        held.pairs.insert(std::minmax(static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(other)));
    }
  }
  return held;
}

/// In a shared scene each process tells which bodies it has seen, and which of them hold together. For a
/// chain of bodies it does not tell each pair, but one less than there are bodies.
void add_over_halo(const State& state, Held& held) {
  if (!state.halo) return;
  Sets here(std::vector<int>(state.bodies.size(), -1));
  for (const auto& [a, b] : held.pairs) here.unite(a, b);
  std::vector<double> reported;
  for (std::uint32_t b = 0; b < held.lives.size(); ++b)
    if (held.lives[b])
      reported.insert(reported.end(), {static_cast<double>(b), static_cast<double>(here.root(b))});
  const std::vector<double> all = state.halo->all_of(reported);
  for (std::size_t k = 0; k < all.size(); k += 2) {
    const auto body = static_cast<std::uint32_t>(all[k]), root = static_cast<std::uint32_t>(all[k + 1]);
    held.lives[body] = 1;
    if (body != root) held.pairs.insert(std::minmax(body, root));
  }
}

}  // namespace

std::size_t count_objects(const State& state) {
  Held held = held_here(state);
  add_over_halo(state, held);
  Sets sets(std::vector<int>(state.bodies.size(), -1));
  for (const auto& [a, b] : held.pairs) sets.unite(a, b);
  std::size_t count = 0;
  for (std::uint32_t b = 0; b < held.lives.size(); ++b) count += held.lives[b] && sets.root(b) == b ? 1 : 0;
  return count;
}

}  // namespace tripoint
