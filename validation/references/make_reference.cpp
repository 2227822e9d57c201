// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>

#include "files/job.hpp"
#include "tables/nearest.hpp"
#include "validation/references/contact_entries.hpp"

namespace tripoint {

const std::vector<ReferenceEntry>& all_references() {
  static const std::vector<ReferenceEntry> entries{ballistic_entry(),
                                                   ballistic_semi_implicit_entry(),
                                                   torque_free_entry(),
                                                   flip_time_entry(),
                                                   merge_in_flight_entry(),
                                                   split_in_flight_entry(),
                                                   keyframes_entry(),
                                                   cosine_mode_entry(),
                                                   cosine_mode_lattice_entry(),
                                                   sine_held_ends_entry(),
                                                   step_insulated_entry(),
                                                   two_conductivities_entry(),
                                                   hydrostatic_entry(),
                                                   poiseuille_entry(),
                                                   couette_entry(),
                                                   sound_wave_entry(),
                                                   liquid_ball_entry(),
                                                   archimedes_entry(),
                                                   added_mass_entry(),
                                                   elastic_collision_entry(),
                                                   resting_entry(),
                                                   bouncing_entry(),
                                                   sliding_entry(),
                                                   rolling_entry(),
                                                   landing_entry(),
                                                   ball_hits_entry(),
                                                   elliptic_drop_entry(),
                                                   collapsing_column_entry(),
                                                   taylor_green_entry(),
                                                   couette_cylinders_entry(),
                                                   cosine_carried_entry(),
                                                   cosine_sum_entry(),
                                                   cantilever_entry(),
                                                   tension_entry(),
                                                   spinning_rod_entry(),
                                                   pressed_block_entry(),
                                                   elastic_wave_entry(),
                                                   stefan_entry(),
                                                   hysteresis_entry(),
                                                   jointed_entry(),
                                                   stated_entry(),
                                                   self_entry(),
                                                   expression_entry(),
                                                   table_entry(),
                                                   experiment_entry(),
                                                   invariant_entry()};
  return entries;
}

const std::vector<ReferenceFunction>& reference_functions() {
  static const std::vector<ReferenceFunction> functions = [] {
    std::vector<ReferenceFunction> list;
    for (const auto& e : all_references()) list.push_back(e.function);
    return list;
  }();
  return functions;
}

namespace {

/// An exact solution that leaves a force out would be no truth. What a case states itself may hold with one.
void refuse_forces(const std::string& function, const Scene& scene) {
  static constexpr std::array knows{"ballistic", "ballistic_semi_implicit",
                                    "jointed",   "stated",
                                    "self",      "expression",
                                    "table",     "experiment",
                                    "invariant"};
  const auto at = std::ranges::find(knows, function);
  const bool knows_ties = at != knows.end() && at - knows.begin() >= 2;
  if (!scene.springs.empty() && !knows_ties)
    throw InputError(scene.springs.front().place,
                     function + " does not know springs: use jointed, or a reference that you state");
  if (!scene.joints.empty() && !knows_ties)
    throw InputError(scene.joints.front().place,
                     function + " does not know joints: use jointed, or a reference that you state");
  if (scene.forces.empty() || at != knows.end()) return;
  throw InputError(scene.forces.front().place,
                   function + " does not know forces: use ballistic, or a reference that you state");
}

}  // namespace

std::unique_ptr<Reference> make_reference(const ReferenceChoice& choice, const Job& job,
                                          const InitialState& initial) {
  const bool by_kind = choice.kind == ReferenceKind::invariant || choice.kind == ReferenceKind::experiment;
  const std::string kind(to_string(choice.kind)),
      name = choice.function.empty() && by_kind ? kind : choice.function;
  if (name.empty())
    throw InputError("the reference of kind " + kind + " names no function: no truth to compare with");
  const auto& entries = all_references();
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const auto& e) { return e.function.name == name; });
  if (found == entries.end()) {
    std::vector<std::string> known;
    for (const auto& e : entries) known.push_back(e.function.name);
    throw InputError("unknown reference function `" + printable(name) + "`" + suggestion(name, known));
  }
  refuse_forces(name, job.scene);
  const Arguments args(choice, found->function);
  return found->make({args, job, initial, choice.file});
}

}  // namespace tripoint
