// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scene/initial_state.hpp"
#include "scene/scene.hpp"

namespace tripoint {

/// One key of a case as it was resolved: from the file, or a default with its reason. Feeds `explain`.
struct Decision {
  std::string key, value, reason;
  bool given = false;  ///< the file says it
  SourcePlace place;
};

struct CaseReading {
  Case value;
  std::vector<Decision> decisions;
};

/// Reads and checks a case file; every default is filled in, every number is SI.
/// @param set "a.b=VALUE" replacements as of --set, applied before the checks
/// @throws InputError with file, line, column, what was wrong and the nearest known key or word
[[nodiscard]] CaseReading read_case(const std::string& path, const std::vector<std::string>& set = {});

/// What one run of a case changes of its scene.
struct RunChoice {
  std::optional<Mode> mode;
  std::optional<double> spacing, time_step, support_ratio, jitter;
  std::optional<std::uint64_t> seed;
};

/// The scene of one run: modes resolved for every term, support ratio by its default rule where the file gives none.
[[nodiscard]] Scene scene_for(const Case&, const RunChoice&);

/// Stiffness k [m2/s2] of a scene whose materials give none, and its rule in words.
struct DefaultStiffness {
  double value = 0.0;
  std::string rule;
};
/// What flows takes k = (10 v)^2: v the greatest of initial and prescribed speeds and sqrt(2 |g| depth of the liquids), so that
/// the speed of sound is ten times what is to be expected. Solids of which two can meet (meeting.hpp) take it from their speed of
/// approach and the height of the scene, and from the moduli of elastic bodies. Empty where a material gives one, nothing flows
/// or can meet, or no speed is known.
[[nodiscard]] std::optional<DefaultStiffness> default_stiffness(const Scene&);

/// How near a freezing particle joins where the scene does not say [spacings]: as the paper has it, whatever its bonds reach
/// (h = 2.12 dx); corrected, nearest and diagonal neighbours of the lattice, so that no bond bridges a molten layer.
[[nodiscard]] double default_merge_distance(const Scene&);

/// An effect that a scene calls for, and why.
struct CalledEffect {
  std::string name;  ///< fluid elastic plastic fracture rigid heat phase surface
  std::string why;
};
[[nodiscard]] std::vector<CalledEffect> called_effects(const Scene&);
/// The effects that a scene does without, and the proof that each can never act.
[[nodiscard]] std::vector<CalledEffect> idle_effects(const Scene&);

/// Particles of the scene, row = id, bodies in order: on its lattice, and then let down into equilibrium where the scene says
/// `settle`.
/// @throws InputError (no particles, mesh not closed, nothing to settle with, ...)
[[nodiscard]] InitialState sample(const Scene&);

/// How sample() lets liquids down. The program that has a solver sets it, once, before it samples: this room and the judge know
/// none.
using Settler = InitialState (*)(const Scene&, InitialState);
void set_settler(Settler) noexcept;

/// Row in /particles/bodies of each [[body]]; -1 for a liquid.
[[nodiscard]] std::vector<int> body_rows(const Scene&);

/// Mass, centre, principal moments (ascending) and axes of the given particles; moments at round-off become 0.
[[nodiscard]] MassProperties mass_properties(const std::vector<Vec3>& position, const std::vector<double>& mass);

/// One finding of the pre-flight check.
struct Finding {
  bool error = false;  ///< else a warning
  std::string what;    ///< with what to do
  SourcePlace place;
};
/// Overlaps and gaps, bodies under-resolved or of wrong mass, spins that move nothing, a time step above a bound: without running
/// anything.
[[nodiscard]] std::vector<Finding> preflight(const Case&, const Scene&, const InitialState&);

/// One warning for each [[material]] of the case that bears the name of one of the library and takes values from it.
[[nodiscard]] std::vector<Finding> library_values(const CaseReading&);

/// Motion of a fixed or prescribed body by its keyframes (position linear, rotation slerp), velocity their derivative.
struct PrescribedState {
  Vec3 position, velocity, angular_velocity;
  Quaternion rotation;
};
/// @param centre the body's centre of mass at time 0 [m]
[[nodiscard]] PrescribedState prescribed_state(const std::vector<Keyframe>&, const Vec3& centre, const Vec3& velocity,
                                               const Vec3& angular_velocity, double time);

/// JSON Schema of the case file, and its reference page in Markdown: both from the one key table.
[[nodiscard]] std::string case_schema();
[[nodiscard]] std::string case_reference_page();
/// Text of a new case file that runs on defaults.
[[nodiscard]] std::string new_case_text(const std::string& id);

/// Folder of cases, material library and assets: share/tripoint beside the executable's folder.
[[nodiscard]] std::string share_folder();

/// Path of a case that is given as a path or as the id of a shipped case ("heat/cosine"); a path that is no file comes back as it
/// is.
[[nodiscard]] std::string case_path(const std::string& path_or_id);

}  // namespace tripoint
