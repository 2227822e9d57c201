// SPDX-License-Identifier: BSD-3-Clause
#include "effects/heat/heat.hpp"

#include <algorithm>

#include "effects/heat/fields.hpp"
#include "effects/heat/heat_corrected.hpp"
#include "effects/heat/heat_equal.hpp"
#include "effects/heat/heat_paper.hpp"
#include "effects/heat/held_surface.hpp"
#include "scene/phase_values.hpp"
#include "scene/shared_terms.hpp"
#include "scene/temperatures.hpp"
#include "state/body_table.hpp"

namespace tripoint::heat {
namespace {

/// (21) and Fig. 5 as printed know one conductivity and one heat capacity of a material.
void refuse_printed(const Scene& scene) {
  if (scene.mode_of(term::heat) != Mode::paper && scene.mode_of(term::phase) != Mode::paper) return;
  for (const Body& b : scene.bodies) {
    if (!b.temperature || !has_two_phases(scene.material(b.material))) continue;
    throw InputError("heat as printed knows one conductivity and one heat capacity of a material, and " +
                     b.material +
                     " has others when solid: let both be corrected (model.heat, model.phase, case.modes)");
  }
}

/// Whether heat that is given to solids from outside is counted body by body.
bool accumulates_bodies(const Scene& scene) {
  if (!can_have_bodies(scene)) return false;
  return has_held_surfaces(scene) ||
         std::ranges::any_of(scene.bodies,
                             [](const Body& b) { return b.temperature_held && b.phase != Phase::liquid; }) ||
         std::ranges::any_of(scene.events, [](const Event& e) { return e.kind == Event::Kind::heat; });
}

const std::vector<GuardedEntry> guarded_entries{{"thermal", EntryRole::apart}, {"latent", EntryRole::apart}};

std::vector<FieldInfo> read_by_both() {
  return fields::joined(
      {fields::position(),
       {field::id, field::mass, field::body, field::material, field::phase, field::source}});
}

EffectSpec spec_of_form(const Scene& scene) {
  if (scene.mode_of(term::heat) == Mode::paper) {
    return {"heat",
            Mode::paper,
            {field::temperature, field::temperature_rate, field::exchange, field::heat_capacity,
             field::diffusivity, field::held},
            fields::joined({read_by_both(), {field::density, field::volume}})};
  }
  return {"heat",
          Mode::corrected,
          {field::temperature, field::enthalpy, field::heat_rate, field::heat_rate_before, field::conductance,
           field::heat_capacity, field::conductivity, field::rest_volume, field::held, field::moment_inverse,
           field::spread, field::spread_rest, field::lean},
          read_by_both()};
}

}  // namespace

EffectSpec spec(const Scene& scene) {
  if (equal_temperature(scene)) {
    EffectSpec idle{"heat", scene.mode_of(term::heat), {}, {field::mass, field::material, field::phase}};
    idle.skips_sleeping = true;
    idle.guarded_entries = guarded_entries;
    return idle;
  }
  EffectSpec s = spec_of_form(scene);
  if (has_held_surfaces(scene)) s.owns.emplace_back(field::surface_flow_before);
  s.guarded_entries = guarded_entries;
  s.guards = {{field::temperature, "temperature", Written::drift, "K, below absolute zero"}};
  s.positive = {field::heat_capacity};
  if (s.mode == Mode::corrected) {
    s.step_numbers = {b_held_for};
    s.own_sums.state = columns_of_all(field::moment_inverse);
  }
  if (s.mode == Mode::paper)
    s.guards.push_back({field::temperature_rate, "temperature_rate", Written::rates});
  else
    s.guards.push_back({field::heat_rate, "heat_rate", Written::rates});
  if (accumulates_bodies(scene)) {
    s.owns.emplace_back(field::body_heat);
    s.body_sums = {field::body_heat};
  }
  s.reads_if_there = fields::joined({fields::image(), {field::liquid_fraction}});
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) {
  if (const auto temperature = equal_temperature(scene)) return std::make_unique<EqualHeat>(*temperature);
  refuse_printed(scene);
  refuse_held_surfaces(scene);
  if (scene.mode_of(term::heat) == Mode::paper) return std::make_unique<PaperHeat>();
  return std::make_unique<CorrectedHeat>();
}

}  // namespace tripoint::heat
