// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "files/job.hpp"
#include "files/result.hpp"
#include "tables/record.hpp"

/// The keys of JOB.json and result.json, each beside the member that keeps it: the reader, the writer and the
/// schemas go by these. A key without a member has a rule in job.cpp or scene_json.cpp.
namespace tripoint::records {
using enum ValueType;
using enum Range;

inline constexpr auto of_job = std::make_tuple(
    Key{"job", "contract", integer, "", any, "!", "", "", "version of this protocol: 1"},
    kept(&Job::case_id, {"job", "case", text, "", any, "!", "", "", "name of the case, for messages"}),
    Key{"job", "scene", table, "", any, "!", "", "scene",
        "the scene as it is to be simulated, every default filled in"},
    kept(&Job::particles, {"job", "particles", text, "", any, "!", "", "",
                           "path of particles.h5: the start of every particle, for reading"}),
    Key{"job", "resolution", table, "", any, "!", "", "resolution", "how finely it is to be simulated"},
    kept(&Job::preset,
         {"job", "preset", text, "", any, "\"default\"", "", "", "one of the presets that --info lists"}),
    kept(&Job::settings,
         {"job", "settings", settings, "", any, "{}", "", "",
          "settings that the case hands to the engine, by the engine's own keys; friction and restitution of "
          "every pair of bodies"}),
    Key{"job", "reference", settings, "", any, "{}", "", "",
        "the truth, for the engine `exact` alone; empty for others"},
    kept(&Job::seed, {"job", "seed", integer, "", not_negative, "!", "", "", "seed of random numbers"}),
    kept(&Job::threads,
         {"job", "threads", integer, "", positive, "1", "", "", "threads that the engine may use"},
         {.later = true}),
    kept(&Job::ranks, {"job", "ranks", integer, "", positive, "1", "", "", "processes that share the scene"},
         {.later = true}),
    Key{"job", "gauges", tables, "", any, "[]", "", "gauge",
        "numbers that the case asks for at a point, or of a body or region"},
    kept(&Job::times,
         {"job", "times", numbers, "s", any, "!", "", "", "output times, rising; the first is the start"}),
    kept(&Job::output, {"job", "output", text, "", any, "!", "", "", "folder that the engine writes to"}),
    Key{"job", "resume", text, "", any, "", "", "", "checkpoint to go on from; null = none"});

inline constexpr auto of_resolution = std::make_tuple(
    kept(&Resolution::spacing,
         {"resolution", "spacing", number, "m", positive, "!", "", "", "distance of the particles"}),
    kept(&Resolution::support_ratio, {"resolution", "support_ratio", number, "", positive, "!", "", "",
                                      "support radius of the kernel over the spacing"}),
    kept(&Resolution::time_step, {"resolution", "time_step", number, "s", positive, "", "", "",
                                  "time step; null = the engine's own choice"}),
    kept(&Resolution::walkers,
         {"resolution", "walkers", number, "", positive, "", "", "", "random walkers; null = none asked"}),
    kept(&Resolution::iterations, {"resolution", "iterations", number, "", positive, "", "", "",
                                   "iterations of a solver; null = the engine's own choice"}));

inline constexpr auto of_job_body = std::make_tuple(
    kept(&JobBody::index, {"body", "index", integer, "", any, "!", "", "",
                           "row of the body in what the engine writes; -1 of a liquid"}),
    kept(&JobBody::orientation, {"body", "orientation", numbers, "", any, "!", "", "",
                                 "(w, x, y, z), which is (1, 0, 0, 0) at the start"}),
    kept(&JobBody::velocity, {"body", "velocity", vector, "m/s", any, "!", "", "", "of the centre of mass"}));

inline constexpr auto of_mass = std::make_tuple(
    kept(&MassProperties::mass,
         {"body", "mass", number, "kg", positive, "!", "", "", "sum over its particles"}),
    kept(&MassProperties::centre,
         {"body", "centre", vector, "m", any, "!", "", "", "centre of mass of its particles"}),
    kept(&MassProperties::principal_inertia, {"body", "principal_inertia", vector, "kg m2", any, "!", "", "",
                                              "principal moments of its particles, ascending"}),
    kept(&MassProperties::principal_axes,
         {"body", "principal_axes", numbers, "", any, "!", "", "",
          "rotation (w, x, y, z) from the principal frame to that of the body"}));

inline constexpr auto of_gauge = std::make_tuple(
    kept(&JobGauge::metric, {"gauge", "metric", text, "", any, "!", "", "", "name of the case's metric"}),
    kept(&JobGauge::quantity,
         {"gauge", "quantity", text, "", any, "!", "", "", "displacement, temperature_at, ..."}),
    kept(&JobGauge::body,
         {"gauge", "body", text, "", any, "\"\"", "", "", "body that it is asked of; empty = all"}),
    kept(&JobGauge::where,
         {"gauge", "where", settings, "", any, "{}", "", "",
          "of point, axis, min, max, outside and phase those that the case states, never the value"}));

inline constexpr auto of_result = std::make_tuple(
    Key{"result", "contract", integer, "", any, "1", "", "", "version of this protocol: 1"},
    Key{"result", "status", word, "", any, "!", "", "ok refused diverged error", "how the run ended"},
    kept(&Result::message,
         {"result", "message", text, "", any, "\"\"", "", "", "reason, in words, where it is not ok"}),
    kept(&Result::time_reached,
         {"result", "time_reached", number, "s", any, "0", "", "", "time of the last frame"},
         {.later = true}),
    kept(&Result::steps, {"result", "steps", integer, "", not_negative, "0", "", "", "time steps made"},
         {.later = true}),
    Key{"result", "counters", table, "", any, "{}", "", "counters", "work done"},
    Key{"result", "seconds", table, "", any, "{}", "", "seconds", "times that the engine measures of itself"},
    kept(&Result::state_hash, {"result", "state_hash", text, "", any, "\"\"", "", "",
                               "hash of the last state: equal for equal bits"}),
    kept(&Result::time_step_bound,
         {"result", "time_step_bound", text, "", any, "\"\"", "", "", "what set the time step"}),
    Key{"result", "readback", table, "", any, "{}", "", "readback",
        "the scene as the engine itself holds it; compared with the job"},
    Key{"result", "divergence", table, "", any, "", "", "divergence",
        "where the run went wrong; null = nowhere"},
    Key{"result", "extra", settings, "", any, "{}", "", "", "further numbers by name"});

inline constexpr auto of_counters = std::make_tuple(
    kept(&Result::pairs, {"counters", "pairs", number, "", any, "0", "", "", "pairs of particles looked at"},
         {.later = true}),
    kept(&Result::iterations,
         {"counters", "iterations", number, "", any, "0", "", "", "iterations of a solver"},
         {.later = true}));

inline constexpr auto of_seconds = std::make_tuple(
    kept(&Result::setup_wall,
         {"seconds", "setup_wall", number, "s", any, "0", "", "", "wall time of the set-up"},
         {.later = true}),
    kept(&Result::setup_cpu,
         {"seconds", "setup_cpu", number, "s", any, "0", "", "", "processor time of the set-up"},
         {.later = true}),
    kept(&Result::stepping_wall,
         {"seconds", "stepping_wall", number, "s", any, "0", "", "", "wall time of the steps"},
         {.later = true}),
    kept(&Result::stepping_cpu,
         {"seconds", "stepping_cpu", number, "s", any, "0", "", "", "processor time of the steps"},
         {.later = true}));

inline constexpr auto of_readback = std::make_tuple(
    kept(&Readback::gravity,
         {"readback", "gravity", vector, "m/s2", any, "[0, 0, 0]", "", "", "acceleration of every body"},
         {.later = true}),
    kept(&Readback::time_step,
         {"readback", "time_step", number, "s", any, "0", "", "", "time step; 0 = none"}, {.later = true}),
    kept(&Readback::precision, {"readback", "precision", text, "", any, "\"double\"", "", "",
                                "double or single: how near the values must be"}),
    Key{"readback", "bodies", tables, "", any, "[]", "", "readback.body", "the solid bodies"},
    Key{"readback", "joints", tables, "", any, "[]", "", "readback.joint", "laws of the joints"});

inline constexpr auto of_readback_joint = std::make_tuple(
    kept(&ReadbackJoint::name,
         {"readback.joint", "name", text, "", any, "!", "", "", "name of the joint in the job"}),
    kept(&ReadbackJoint::damping,
         {"readback.joint", "damping", number, "N m s/rad or N s/m", any, "0", "", "",
          "that the engine holds"},
         {.later = true}),
    kept(&ReadbackJoint::friction,
         {"readback.joint", "friction", number, "N m or N", any, "0", "", "", "that the engine holds"},
         {.later = true}),
    kept(&ReadbackJoint::stiffness,
         {"readback.joint", "stiffness", number, "N m/rad or N/m", any, "0", "", "",
          "of a spring that it holds"},
         {.later = true}),
    kept(&ReadbackJoint::armature,
         {"readback.joint", "armature", number, "kg m2 or kg", any, "0", "", "",
          "inertia that the job does not have"},
         {.later = true}));

inline constexpr auto of_readback_body = std::make_tuple(
    kept(&ReadbackBody::name,
         {"readback.body", "name", text, "", any, "!", "", "", "name of the body in the job"}),
    kept(&ReadbackBody::mass, {"readback.body", "mass", number, "kg", any, "!", "", "", "mass"}),
    kept(&ReadbackBody::centre,
         {"readback.body", "centre", vector, "m", any, "!", "", "", "centre of mass at the start"}),
    kept(&ReadbackBody::principal_inertia, {"readback.body", "principal_inertia", vector, "kg m2", any, "!",
                                            "", "", "principal moments, ascending"}),
    kept(&ReadbackBody::friction,
         {"readback.body", "friction", number, "", any, "", "", "",
          "of a pair of such bodies; null = it has no such number"},
         {.later = true}),
    kept(&ReadbackBody::restitution,
         {"readback.body", "restitution", number, "", any, "", "", "",
          "of a pair of such bodies; null = it has no such number"},
         {.later = true}),
    kept(&ReadbackBody::linear_damping,
         {"readback.body", "linear_damping", number, "1/s", any, "0", "", "",
          "damping that the job does not have"},
         {.later = true}),
    kept(&ReadbackBody::angular_damping,
         {"readback.body", "angular_damping", number, "1/s", any, "0", "", "",
          "damping that the job does not have"},
         {.later = true}));

inline constexpr auto of_divergence = std::make_tuple(
    kept(&Divergence::particle,
         {"divergence", "particle", integer, "", any, "-1", "", "", "its number; -1 = none"},
         {.later = true}),
    kept(&Divergence::body, {"divergence", "body", integer, "", any, "-1", "", "", "its row; -1 = none"},
         {.later = true}),
    kept(&Divergence::field, {"divergence", "field", text, "", any, "\"\"", "", "", "field that went wrong"}),
    kept(&Divergence::stage, {"divergence", "stage", text, "", any, "\"\"", "", "", "stage of the step"}),
    kept(&Divergence::time, {"divergence", "time", number, "s", any, "0", "", "", "time"}, {.later = true}),
    kept(&Divergence::guard,
         {"divergence", "guard", text, "", any, "\"\"", "", "", "guard that tripped; empty = none"}),
    kept(&Divergence::file, {"divergence", "file", text, "", any, "\"\"", "", "",
                             "file in the run's folder that shows it; empty = none"}),
    kept(&Divergence::checkpoint,
         {"divergence", "checkpoint", text, "", any, "\"\"", "", "", "last good checkpoint; empty = none"}));

}  // namespace tripoint::records
