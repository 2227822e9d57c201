// SPDX-License-Identifier: BSD-3-Clause
#include "effects/phase/released_energy.hpp"

#include <algorithm>
#include <set>

#include "solids/fusion.hpp"

namespace tripoint::phase {
namespace {

/// Divides energy equally among particles. @param ids at least one
void share(State& state, const std::vector<std::uint32_t>& ids, double joules) {
  for (const std::uint32_t id : ids)
    give_heat(state, state.particles.row(id), joules / static_cast<double>(ids.size()));
}

/// Particles that melted from, or froze to, the body in this step; all events where none did.
std::vector<std::uint32_t> events_of_body(const State& state, std::size_t body) {
  const Change& change = state.change;
  const auto now = state.particles[field::body];
  std::vector<std::uint32_t> ids;
  for (const std::uint32_t id : change.frozen)
    if (now[state.particles.row(id)] == static_cast<int>(body)) ids.push_back(id);
  if (!ids.empty()) return ids;
  std::set<int> parents{static_cast<int>(body)};
  for (const auto& [id, from] : change.came_from)
    if (now[state.particles.row(id)] == static_cast<int>(body)) parents.insert(from);
  for (const std::uint32_t id : change.melted)
    if (parents.contains(change.came_from.at(id))) ids.push_back(id);
  if (!ids.empty()) return ids;
  ids = change.melted;
  ids.insert(ids.end(), change.frozen.begin(), change.frozen.end());
  return ids;
}

}  // namespace

void ReleasedEnergy::touch(std::uint32_t id) {
  if (entries_.contains(id)) return;
  entries_[id].before = energy_(id);
}

void ReleasedEnergy::touch(std::uint32_t id, std::uint32_t event) {
  touch(id);
  std::vector<std::uint32_t>& events = entries_.at(id).events;
  if (std::ranges::find(events, event) == events.end()) events.push_back(event);
}

void ReleasedEnergy::settle(State& state) const {
  settle_deformation(state);
  settle_joining(state);
}

void ReleasedEnergy::settle_deformation(State& state) const {
  std::map<std::uint32_t, double> difference;
  for (const auto& [id, entry] : entries_) difference[id] = entry.before - energy_(id);
  for (const auto& [id, entry] : entries_) {
    if (difference.at(id) == 0.0) continue;
    state.accumulated[account::deformation_released] += difference.at(id);
    std::vector<std::uint32_t> events = entry.events;
    std::ranges::sort(events);
    share(state, events.empty() ? std::vector{id} : events, difference.at(id));
  }
}

void ReleasedEnergy::settle_joining(State& state) const {
  for (const auto& [body, lost] : state.change.kinetic_lost)
    if (lost != 0.0) share(state, events_of_body(state, body), lost);
}

}  // namespace tripoint::phase
