// SPDX-License-Identifier: BSD-3-Clause
#include "state/drop_particles.hpp"

#include <numeric>
#include <vector>

#include "state/state.hpp"

namespace tripoint {
namespace {

/// Lists follow their particles to new ids.
template <class Pair>
void renumber(PairLists<Pair>& lists, std::span<const std::uint32_t> new_id) {
  for (std::size_t id = 0; id < lists.particles(); ++id) {
    if (lists.of(id).empty() || new_id[id] == id) continue;
    std::vector<Pair> list(lists.of(id).begin(), lists.of(id).end());
    lists.replace(id, {});
    lists.replace(new_id[id], list);  // its own new id is below those that follow
  }
  for (std::size_t id = 0; id < lists.particles(); ++id) {
    if (lists.of(id).empty()) continue;
    for (Pair& pair : lists.edit(id)) pair.other = new_id[pair.other];
  }
}

}  // namespace

void drop_particles(State& state, std::span<const std::uint32_t> ids) {
  Particles& p = state.particles;
  constexpr std::uint32_t gone = Columns::none;
  std::vector<std::uint32_t> new_id(p.size(), 0), kept;
  for (const std::uint32_t id : ids) new_id[id] = gone;
  for (std::uint32_t id = 0; id < p.size(); ++id) {
    if (new_id[id] == gone) continue;
    new_id[id] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(static_cast<std::uint32_t>(p.row(id)));
  }
  renumber(state.bonds, new_id);
  renumber(state.own, new_id);
  p.make_of(kept);
  p.number();
  state.unread.clear();
  state.fixed_formed = false;
  if (state.neighbours) state.neighbours->drop_lists({});
}

void keep_particles(State& state, std::size_t count) {
  std::vector<std::uint32_t> ids(state.particles.size() - count);
  std::iota(ids.begin(), ids.end(), static_cast<std::uint32_t>(count));
  state.bonds = {};
  state.own = {};
  drop_particles(state, ids);
}

}  // namespace tripoint
