// SPDX-License-Identifier: BSD-3-Clause
#include "scene/defaults.hpp"
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint {

double default_merge_distance(const Scene& s) {
  return s.mode_of(term::phase) == Mode::paper ? bond_reach(s) : lattice_reach;
}

Scene scene_for(Scene s, const RunChoice& choice) {
  if (choice.mode) s.mode = *choice.mode;
  s.resolve_modes();
  if (choice.spacing) s.spacing = *choice.spacing;
  if (choice.time_step) s.time_step = *choice.time_step;
  if (choice.jitter) s.jitter = *choice.jitter;
  if (choice.seed) s.seed = *choice.seed;
  if (choice.support_ratio) {
    s.support_ratio = *choice.support_ratio;
    s.support_ratio_given = true;
  } else if (!s.support_ratio_given)
    s.support_ratio = s.default_support_ratio();
  if (!s.merge_distance_given) s.merge_distance = default_merge_distance(s);
  if (const auto stiffness = default_stiffness(s)) {
    for (Material& m : s.materials) m.stiffness = stiffness->value;
  }
  return s;
}

}  // namespace tripoint
