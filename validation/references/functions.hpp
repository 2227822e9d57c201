// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <vector>

#include "validation/references/arguments.hpp"
#include "validation/references/reference.hpp"

namespace tripoint {

/// Input of a reference function.
struct ReferenceInput {
  const Arguments& args;
  const Job& job;
  const InitialState& initial;
  std::string file = {};  ///< data beside the case; empty = none
};

/// A reference function: its description and its maker. One file each; `all_references()` is the one list.
struct ReferenceEntry {
  ReferenceFunction function;
  std::unique_ptr<Reference> (*make)(const ReferenceInput&);
};

[[nodiscard]] ReferenceEntry ballistic_entry();
[[nodiscard]] ReferenceEntry ballistic_semi_implicit_entry();
[[nodiscard]] ReferenceEntry torque_free_entry();
[[nodiscard]] ReferenceEntry flip_time_entry();
[[nodiscard]] ReferenceEntry merge_in_flight_entry();
[[nodiscard]] ReferenceEntry split_in_flight_entry();
[[nodiscard]] ReferenceEntry keyframes_entry();
[[nodiscard]] ReferenceEntry cosine_mode_entry();
[[nodiscard]] ReferenceEntry cosine_mode_lattice_entry();
[[nodiscard]] ReferenceEntry sine_held_ends_entry();
[[nodiscard]] ReferenceEntry step_insulated_entry();
[[nodiscard]] ReferenceEntry two_conductivities_entry();
[[nodiscard]] ReferenceEntry hydrostatic_entry();
[[nodiscard]] ReferenceEntry poiseuille_entry();
[[nodiscard]] ReferenceEntry couette_entry();
[[nodiscard]] ReferenceEntry sound_wave_entry();
[[nodiscard]] ReferenceEntry liquid_ball_entry();
[[nodiscard]] ReferenceEntry archimedes_entry();
[[nodiscard]] ReferenceEntry added_mass_entry();
[[nodiscard]] ReferenceEntry elastic_collision_entry();
[[nodiscard]] ReferenceEntry resting_entry();
[[nodiscard]] ReferenceEntry bouncing_entry();
[[nodiscard]] ReferenceEntry elliptic_drop_entry();
[[nodiscard]] ReferenceEntry collapsing_column_entry();
[[nodiscard]] ReferenceEntry taylor_green_entry();
[[nodiscard]] ReferenceEntry couette_cylinders_entry();
[[nodiscard]] ReferenceEntry cosine_carried_entry();
[[nodiscard]] ReferenceEntry cosine_sum_entry();
[[nodiscard]] ReferenceEntry cantilever_entry();
[[nodiscard]] ReferenceEntry tension_entry();
[[nodiscard]] ReferenceEntry spinning_rod_entry();
[[nodiscard]] ReferenceEntry pressed_block_entry();
[[nodiscard]] ReferenceEntry stefan_entry();
[[nodiscard]] ReferenceEntry hysteresis_entry();
[[nodiscard]] ReferenceEntry elastic_wave_entry();
[[nodiscard]] ReferenceEntry jointed_entry();
[[nodiscard]] ReferenceEntry stated_entry();
[[nodiscard]] ReferenceEntry self_entry();
[[nodiscard]] ReferenceEntry expression_entry();
[[nodiscard]] ReferenceEntry table_entry();
[[nodiscard]] ReferenceEntry experiment_entry();
[[nodiscard]] ReferenceEntry invariant_entry();

[[nodiscard]] const std::vector<ReferenceEntry>& all_references();

}  // namespace tripoint
