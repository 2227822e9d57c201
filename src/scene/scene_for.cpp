// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "scene/defaults.hpp"
#include "scene/effect_rule.hpp"
#include "scene/sample.hpp"

namespace tripoint {

bool Scene::all_printed() const {
  for (std::size_t t = 0; t < term_count; ++t)
    if (static_cast<Term>(t) != Term::clamp && modes[t] != Mode::paper) return false;
  return true;
}

double default_merge_distance(const Scene& s) { return s.mode_of(Term::phase) == Mode::paper ? bond_reach(s) : lattice_reach; }

Scene scene_for(Scene s, const RunChoice& choice) {
  if (choice.mode) s.mode = *choice.mode;
  for (std::size_t t = 0; t < term_count; ++t) s.modes[t] = s.modes_given[t].value_or(s.mode);
  if (choice.spacing) s.spacing = *choice.spacing;
  if (choice.time_step) s.time_step = *choice.time_step;
  if (choice.jitter) s.jitter = *choice.jitter;
  if (choice.seed) s.seed = *choice.seed;
  if (choice.support_ratio)
    s.support_ratio = *choice.support_ratio, s.support_ratio_given = true;
  else if (!s.support_ratio_given)
    s.support_ratio = s.default_support_ratio();
  if (!s.merge_distance_given) s.merge_distance = default_merge_distance(s);
  if (const auto stiffness = default_stiffness(s)) {
    for (Material& m : s.materials) m.stiffness = stiffness->value;
  }
  return s;
}

std::vector<int> body_rows(const Scene& s) {
  std::vector<int> rows;
  int next = 0;
  for (const auto& b : s.bodies) rows.push_back(b.phase == Phase::liquid ? -1 : next++);
  return rows;
}

}  // namespace tripoint
