// SPDX-License-Identifier: BSD-3-Clause
#include "scene/key_table.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "scene/case_document.hpp"
#include "scene/effect_rule.hpp"

namespace tripoint {
namespace {

using enum ValueType;
using enum Range;
constexpr std::string_view axes = "spacing time_step support_ratio walkers iterations";
constexpr std::string_view references = "analytic discrete_exact mms self engine experiment invariant bound";
constexpr std::string_view orders = "asymptotic preasymptotic plateau roundoff oscillating diverging noise-limited too-few";

constexpr auto common_keys = std::to_array<Key>({
    // format
    {"", "format", integer, "", positive, "1", "the first version", "", "version of the case file"},
    {"", "extends", text, "", any, "", "the case stands on its own", "",
     "case whose keys hold where this file says nothing: a file of this folder, \"other.toml\", or a case's name"},
    {"", "remove", texts, "", any, "", "all of it holds", "",
     "what of the extended case does not hold: \"scene.jitter\", \"engines.lammps\", \"metric.overlap\" (and the gates on it), "
     "\"study\""},
    {"", "case", table, "", any, "=", "id from the file's place", "case", "what is shown, and how it is judged"},
    {"", "scene", table, "", any, "!", "", "scene", "what is simulated"},
    {"", "material", tables, "", any, "=", "materials of the library serve by name", "material", "matter"},
    {"", "body", tables, "", any, "!", "", "body", "bodies, in the order of their rows"},
    {"", "event", tables, "", any, "=", "nothing happens on the way", "event", "what happens at a time"},
    {"", "inflow", tables, "", any, "=", "nothing flows in", "inflow", "liquid that flows in"},
    {"", "engines", table, "", any, "=", "every engine that can", "engines",
     "engines of this case, one table for each: [engines.NAME]"},
    {"", "reference", table, "", any, "=", "only the invariants are known", "reference", "the truth, where it is known"},
    {"", "metric", tables, "", any, "=", "nothing is measured", "metric", "numbers computed from each run"},
    {"", "invariants", table, "", any, "", "nothing but the metrics", "invariants",
     "quantities that every run must keep: a metric and its gate on one line"},
    {"", "study", tables, "", any, "=", "one run an engine", "study", "convergence studies"},
    {"", "gate", tables, "", any, "=", "nothing is judged", "gate", "limits"},
    {"", "input", tables, "", any, "=", "every number counts as exact", "input", "uncertain numbers"},
    {"", "defect", tables, "", any, "=", "none", "defect", "faults that this case must catch"},
    {"", "harmless", tables, "", any, "=", "none", "harmless", "changes that must not change any metric"},
    // [case]
    {"case", "id", text, "", any, "=", "folder and name of the file", "", "name of the case: subject/case"},
    {"case", "title", text, "", any, "=", "the id", "", "title in one line"},
    {"case", "requirement", text, "", any, "\"\"", "none is stated", "", "label of the requirement that the case shows"},
    {"case", "claims", text, "", any, "\"\"", "none is stated", "", "statement that the gates prove"},
    {"case", "kind", word, "", any, "\"verification\"", "against an exact solution", "verification validation comparison",
     "kind of truth: verification: exact solution; validation: experiment; comparison: another engine"},
    {"case", "profiles", words, "", any, "[\"commit\"]", "runs with every change", "commit nightly release acceptance",
     "suites that the case belongs to; acceptance: it has a limit that any engine must hold"},
    {"case", "tags", texts, "", any, "[]", "none", "", "words to select cases by"},
    {"case", "expect", word, "", any, "\"pass\"", "a case is meant to pass", "pass diverges paper-diverges defect",
     "what must be measured for the case to pass; paper-diverges: the printed form does, the corrected one does not"},
    {"case", "modes", words, "", any, "=", "the scene's mode", "corrected paper",
     "forms of the model that are run, one set of runs each"},
    // [scene]
    {"scene", "end_time", number, "s", positive, "!", "", "", "simulated time"},
    {"scene", "gravity", vector, "m/s2", any, "[0, 0, 0]", "free space: a case says when bodies fall", "",
     "acceleration of every free particle"},
    {"scene", "spacing", number, "m", positive, "=", "a tenth of the smallest extent of a body", "",
     "distance dx of the particles, the same in the whole scene"},
    {"scene", "support_ratio", number, "", above_one, "=",
     "2.12 where every term is paper, else 2.6 (about 40 and 74 neighbours)", "",
     "support radius of the kernel divided by the spacing, h/dx"},
    {"scene", "mode", word, "", any, "\"corrected\"", "the best known form of each term", "corrected paper",
     "form of every term of the model"},
    {"scene", "modes", table, "", any, "=", "every term as `mode` says", "modes", "form of single terms of the model"},
    {"scene", "clamp", flag, "", any, "=",
     "modes.clamp: true where it is corrected, since negative pressure would glue bodies together; the paper prints none", "",
     "no negative pressure"},
    {"scene", "time_step", number_or_auto, "s", positive, "\"auto\"", "the least bound of the effects that are on", "",
     "time step, or \"auto\""},
    {"scene", "seed", integer, "", not_negative, "1", "any number serves; kept so that runs repeat", "",
     "seed of jitter and walkers"},
    {"scene", "jitter", number, "", fraction, "0", "an undisturbed lattice", "",
     "random shift of each particle, uniform in +-jitter in each direction, in spacings"},
    {"scene", "min", vector, "m", any, "", "no bounds: no direction is periodic", "", "lower corner of the domain"},
    {"scene", "max", vector, "m", any, "", "no bounds: no direction is periodic", "", "upper corner of the domain"},
    {"scene", "periodic", words, "", any, "[]", "open in every direction", "x y z", "periodic directions of the domain"},
    {"scene", "output_interval", number, "s", positive, "=", "a twentieth of end_time", "", "time between frames"},
    {"scene", "settle", flag, "", any, "false", "liquids start on a lattice, which falls by a tenth of a spacing and breaks up",
     "", "let the liquids down into equilibrium under gravity before time 0, between solids that stand where they start"},
    {"scene", "merge_distance", number, "", positive, "=",
     "1.5, nearest and diagonal neighbours of the lattice; where phase is paper 2.12, the reach of its bonds", "",
     "how near a freezing particle joins, in spacings"},
    {"scene", "contact", word, "", any, "\"auto\"", "solids meet wherever their paths can cross", "auto none",
     "none: solids pass through each other, and nothing is paid for it; not in a scene that flows"},
    {"scene", "on_failure", word, "", any, "\"stop\"", "a run that has gone wrong is no result", "stop recover",
     "what a guard does that trips: stop with exit code 7; or go back to the last good state and on with half the step, counted "
     "in the results"},
    {"scene", "unguarded", words, "", any, "[]", "every guard is on", "inversion overlap escape ledger time_step",
     "guards that are off: det F <= 0; a solid or liquid pressed to more than two coinciding layers; a particle leaving "
     "min..max; energy made or lost by the scheme; a time step that collapses"},
    // [[material]]
    {"material", "name", text, "", any, "!", "", "",
     "its name; a name of the library brings the library's values, which keys here replace"},
    {"material", "density", number, "kg/m3", positive, "!", "", "", "rest density, one for both phases"},
    {"material", "stiffness", number, "m2/s2", positive, "",
     "taken from the speeds of the scene, or from elastic moduli, where something flows or solids can meet", "",
     "k of p = k (rho - rho0), the square of the sound speed"},
    {"material", "sound_speed", number, "m/s", positive, "", "see stiffness", "", "instead of stiffness: k is its square"},
    {"material", "solid_conductivity", number, "W/m/K", positive, "", "conductivity is that of both phases", "",
     "conductivity of the solid; `conductivity` is then that of the liquid; not as printed"},
    {"material", "solid_heat_capacity", number, "J/kg/K", positive, "", "heat_capacity is that of both phases", "",
     "specific heat of the solid; `heat_capacity` is then that of the liquid, and `latent_heat` that at t_melt; not as printed"},
    {"material", "solid", word, "", any, "=", "elastic where young_modulus is given, else rigid", "elastic rigid",
     "what it is when solid"},
    {"material", "source", text, "", any, "", "the case's own values", "", "where the values come from"},
    // [[body]]
    {"body", "name", text, "", any, "!", "", "", "name of the body"},
    {"body", "material", text, "", any, "!", "", "", "name of a [[material]], or of one of the library"},
    {"body", "phase", word, "", any, "=", "from the material and the temperature", "liquid elastic rigid", "phase at the start"},
    {"body", "shape", shape, "", any, "!", "", "", "region that the body fills"},
    {"body", "velocity", velocity, "m/s", any, "[0, 0, 0]", "at rest", "",
     "velocity at the start; of a prescribed body constant for ever"},
    {"body", "angular_velocity", vector, "rad/s", any, "[0, 0, 0]", "no spin", "",
     "angular velocity at the start about the centre of mass, in the world frame; for liquids too"},
    {"body", "temperature", temperature, "K", positive, "", "its heat is not followed", "", "temperature at the start"},
    {"body", "temperature_held", flag, "", any, "false", "free to warm and cool", "",
     "true: the temperature of the body never changes"},
    {"body", "motion", word, "", any, "\"free\"", "bodies move by their forces", "free fixed prescribed",
     "free: moved by forces; fixed: at rest; prescribed: moved by keyframes or constant velocities"},
    {"body", "keyframes", tables, "", any, "[]", "prescribed: constant velocity and angular_velocity", "keyframe",
     "motion of a prescribed body"},
    {"body", "slip", word, "", any, "\"no\"", "liquid sticks to solids", "no free",
     "no: liquid sticks to the body; free: liquid glides along it"},
    {"body", "joins", flag, "", any, "=", "true where the material melts", "",
     "true: matter that freezes in contact with the body joins it"},
    {"body", "joined_to", texts, "", any, "[]", "bonded to nothing", "", "bodies that the body is bonded to from the start"},
    // keyframes
    {"keyframe", "time", number, "s", not_negative, "!", "", "", "time of the keyframe; keyframes are in rising order"},
    {"keyframe", "position", vector, "m", any, "!", "", "", "position of the centre of mass; linear between keyframes"},
    {"keyframe", "rotation", numbers, "", any, "[1, 0, 0, 0]", "not turned", "",
     "rotation (w, x, y, z) since the start; slerp, less than half a turn between keyframes"},
    // shapes
    {"shape.box", "min", vector, "m", any, "!", "", "", "lower corner"},
    {"shape.box", "max", vector, "m", any, "!", "", "", "upper corner"},
    {"shape.sphere", "centre", vector, "m", any, "!", "", "", "centre"},
    {"shape.sphere", "radius", number, "m", positive, "!", "", "", "radius"},
    {"shape.cylinder", "base", vector, "m", any, "!", "", "", "centre of the base"},
    {"shape.cylinder", "axis", vector, "", any, "[0, 0, 1]", "upright", "",
     "direction of the axis, from the base on, of any length"},
    {"shape.cylinder", "length", number, "m", positive, "!", "", "", "length along the axis"},
    {"shape.cylinder", "radius", number, "m", positive, "!", "", "", "radius"},
    {"shape.half_space", "point", vector, "m", any, "!", "", "", "a point of the plane"},
    {"shape.half_space", "normal", vector, "", any, "!", "", "", "outward normal of the plane, of any length"},
    {"shape.union", "of", tables, "", any, "!", "", "shape", "shapes to unite, at least one"},
    {"shape.difference", "from", shape, "", any, "!", "", "", "shape that is cut"},
    {"shape.difference", "minus", shape, "", any, "!", "", "", "shape that is removed"},
    {"shape.mesh", "file", text, "", any, "!", "", "", "closed triangle mesh, .obj or .stl, beside the case"},
    {"shape.mesh", "scale", number, "", positive, "1", "the mesh is in metres", "", "factor to metres"},
    // temperature fields
    {"temperature.cosine", "mean", number, "K", any, "!", "", "", "mean"},
    {"temperature.cosine", "amplitude", number, "K", any, "!", "", "", "amplitude"},
    {"temperature.cosine", "wave_vector", vector, "rad/m", any, "!", "", "", "2 pi over wavelength, by direction"},
    {"temperature.cosine", "phase", number, "rad", any, "0", "greatest at the origin", "", "mean + amplitude cos(k.r + phase)"},
    {"temperature.step", "point", vector, "m", any, "!", "", "", "a point of the plane of the step"},
    {"temperature.step", "normal", vector, "", any, "!", "", "", "normal of the plane, from behind to ahead, of any length"},
    {"temperature.step", "behind", number, "K", positive, "!", "", "", "temperature where (r - point).normal < 0"},
    {"temperature.step", "ahead", number, "K", positive, "!", "", "", "elsewhere"},
    {"temperature.expression", "value", text, "", any, "!", "", "",
     "of x, y, z in m; + - * / ^ ( ) sin cos tan exp log sqrt abs erf erfc sinh cosh tanh min max pi, and sum(n, 1, 40, f) of f "
     "over n"},
    // velocity fields
    {"velocity.cosine", "mean", vector, "m/s", any, "[0, 0, 0]", "a wave alone", "", "mean"},
    {"velocity.cosine", "amplitude", vector, "m/s", any, "!", "", "", "amplitude"},
    {"velocity.cosine", "wave_vector", vector, "rad/m", any, "!", "", "", "2 pi over wavelength, by direction"},
    {"velocity.cosine", "phase", number, "rad", any, "0", "greatest at the origin", "", "mean + amplitude cos(k.r + phase)"},
    {"velocity.linear", "centre", vector, "m", any, "[0, 0, 0]", "the origin", "", "point where the velocity is zero"},
    {"velocity.linear", "gradient", tables, "1/s", any, "!", "", "", "three rows of three: row i gives component i"},
    {"velocity.taylor_green", "speed", number, "m/s", positive, "!", "", "", "greatest speed"},
    {"velocity.taylor_green", "wavelength", number, "m", positive, "!", "", "", "side of the periodic cell in x and y"},
    {"velocity.expression", "value", texts, "", any, "!", "", "", "three expressions of x, y, z in m"},
    // [[event]]
    {"event", "time", number, "s", not_negative, "!", "", "", "time at which the event begins"},
    {"event", "kind", word, "", any, "!", "", "merge split release heat hold grip",
     "merge: bodies[0] absorbs the rest; split: members in region become body `name`; heat: holds `temperature` in region or "
     "bodies until `until`; hold: pauses bodies; grip: moves solids in region by keyframes until release"},
    {"event", "name", text, "", any, "=", "none", "", "name of the new body, or of the grip"},
    {"event", "bodies", texts, "", any, "[]", "all in the region", "", "bodies that the event acts on"},
    {"event", "region", shape, "", any, "", "everywhere", "", "region that the event acts in"},
    {"event", "temperature", number, "K", positive, "", "none", "", "temperature that is held"},
    {"event", "until", number, "s", positive, "", "to the end", "", "time at which the event ends"},
    {"event", "keyframes", tables, "", any, "[]", "none", "keyframe", "motion of the grip"},
    // [[inflow]]
    {"inflow", "material", text, "", any, "!", "", "", "name of the material that flows in"},
    {"inflow", "shape", shape, "", any, "!", "", "", "region through which it enters"},
    {"inflow", "velocity", vector, "m/s", any, "!", "", "", "velocity of what enters, along an axis"},
    {"inflow", "temperature", number, "K", positive, "", "its heat is not followed", "", "temperature of what enters"},
    {"inflow", "start", number, "s", not_negative, "0", "from the start", "", "time at which the inflow begins"},
    {"inflow", "stop", number, "s", positive, "=", "end_time", "", "time at which the inflow ends"},
    {"inflow", "rate", number, "m3/s", positive, "", "by the speed", "", "volume per second; replaces the magnitude of velocity"},
    // [engines.NAME]
    {"engines", "required", flag, "", any, "false", "its absence is a row of the report and no failure (tripoint: true)", "",
     "true: the case fails where the engine is missing"},
    {"engines", "preset", text_or_texts, "", any, "[]", "the engine's default", "",
     "presets of the engine, one row of the results each"},
    {"engines", "refuses", text, "", any, "", "it may take the case or refuse it", "",
     "words of the refusal that is expected of the engine: it fails the case when it takes it, or refuses it for another reason"},
    {"engines", "settings", settings, "", any, "{}", "the preset's own", "", "settings of the engine, by its own keys"},
    // [reference]
    {"reference", "kind", word, "", any, "\"analytic\"", "an exact solution", references, "kind of truth"},
    {"reference", "function", text, "", any, "=", "none", "", "name of the exact solution"},
    {"reference", "args", settings, "", any, "{}", "from the scene", "", "arguments of the function"},
    {"reference", "file", text, "", any, "\"\"", "no data", "", "data beside the case: <case>.ref.*"},
    {"reference", "source", text, "", any, "\"\"", "the function's own", "", "source of the truth: book, paper or derivation"},
    {"reference", "uncertainty", number, "", not_negative, "0", "exact", "",
     "standard uncertainty of the reference, in the metric's unit"},
    // [[metric]]
    {"metric", "name", text, "", any, "!", "", "", "name of the metric"},
    {"metric", "quantity", text, "", any, "!", "", "",
     "position orientation velocity angular_velocity temperature pressure density force torque phase_count body_count event_time "
     "ledger.TERM"},
    {"metric", "norm", text, "", any, "\"max\"", "the worst counts", "", "norm over samples and time: L1 L2 Linf max final ..."},
    {"metric", "body", text, "", any, "\"\"", "all", "", "body whose samples count"},
    {"metric", "at", text, "", any, "\"end\"", "where errors have grown", "", "time at which the metric is taken"},
    {"metric", "window", numbers, "s", any, "[0, 0]", "all frames", "", "first and last time that count"},
    {"metric", "scale", number, "", positive, "1", "in the quantity's own unit", "", "number that the error is divided by"},
    {"metric", "unit", text, "", any, "\"\"", "the quantity's own", "", "unit of the scaled value, as the report prints it"},
    {"metric", "reference", table, "", any, "=", "the case's", "reference", "reference of this metric alone"},
    {"metric", "gates", tables, "", any, "", "gates stand in [[gate]]", "gates",
     "gates of this metric, each without the key metric"},
    {"metric", "limits", settings, "", any, "", "no limit by level", "",
     "one gate for each level of the study, for all engines: { LEVEL = LIMIT, ... }"},
    {"metric", "reason", text, "", any, "", "gates bring their own", "", "reason of `limits`"},
    // [[study]]
    {"study", "axis", word, "", any, "!", "", axes, "axis that is refined"},
    {"study", "levels", numbers, "", any, "!", "", "", "values in the axis's own unit, coarse to fine"},
    {"study", "support_ratios", numbers, "", any, "", "the case's own", "",
     "support ratios that are refined together with the levels, one for each"},
    {"study", "time_steps", numbers, "s", any, "", "the case's own", "",
     "time steps that are refined together with the levels, one for each"},
    {"study", "jitter", number, "", fraction, "0", "an undisturbed lattice", "", "jitter of the runs, in spacings"},
    {"study", "seeds", integer, "", positive, "1", "one run a level", "",
     "number of runs for each level, each with its own seed"},
    {"study", "engine", text, "", any, "\"\"", "all", "", "engine that is refined"},
    {"study", "mode", text, "", any, "\"\"", "all", "",
     "form of our solver that is refined: corrected, paper; \"not paper\": every engine, and ours but in its printed form"},
    {"study", "expect", word, "", any, "\"\"", "not judged", orders, "expected class of the convergence"},
    {"study", "order", number, "", any, "", "not judged", "", "formal order"},
    {"study", "metric", text, "", any, "\"\"", "every metric", "", "metric that is fitted"},
    // [[gate]]
    {"gate", "metric", text, "", any, "!", "", "", "a metric's name, NAME.order or NAME.statistical"},
    {"gate", "engine", text, "", any, "\"\"", "all", "", "engine that the gate judges"},
    {"gate", "mode", text, "", any, "\"\"", "all", "",
     "form of our solver that is judged: corrected, paper; \"not paper\": every engine's runs but those of our printed form"},
    {"gate", "preset", text, "", any, "\"\"", "all", "", "preset that the gate judges"},
    {"gate", "limit", number, "", any, "", "none", "", "greatest magnitude of the value"},
    {"gate", "at_least", number, "", any, "", "none", "", "least value"},
    {"gate", "band", numbers, "", any, "", "none", "", "least and greatest value"},
    {"gate", "level", number, "", any, "", "every run", "", "level of the study's axis that the gate judges"},
    {"gate", "limits", settings, "", any, "", "none", "",
     "instead of level and limit, one gate for each: { LEVEL = LIMIT, ... }"},
    {"gate", "drift", number, "", positive, "", "a tenth, and it warns only", "",
     "share by which the value may move from its accepted baseline; beyond it the gate is red"},
    {"gate", "reason", text, "", any, "!", "", "",
     "reason of the limit; \"known defect NAME: ...\" of a named engine's band excuses it from the acceptance limit on the "
     "metric, which it must then exceed"},
    {"gate", "by", text, "", any, "\"\"", "unsigned", "", "name of who set the limit"},
    {"gate", "date", text, "", any, "\"\"", "undated", "", "date on which the limit was accepted"},
    // [[input]], [[defect]], [[harmless]]
    {"input", "key", text, "", any, "!", "", "", "key of the uncertain number, as --set names it: material.water.viscosity"},
    {"input", "low", text, "", any, "!", "", "", "value less one standard uncertainty, as text: \"0.99e-3 Pa s\""},
    {"input", "high", text, "", any, "!", "", "", "value plus one standard uncertainty"},
    {"defect", "name", text, "", any, "!", "", "", "name of a registered defect: heat.conductivity ..."},
    {"defect", "size", number, "", any, "!", "", "", "size of the defect"},
    {"defect", "smallest", number, "", positive, "", "it is not sought", "",
     "least size that the gates catch: the self-test finds it by bisection and fails where it has grown by more than a quarter"},
    {"defect", "killed_by", text_or_texts, "", any, "[]", "any gate", "", "metrics whose gates must fail"},
    {"harmless", "name", word, "", any, "!", "", "threads order ulp boost mirror rotation units",
     "threads: 2 instead of 1; order: of the particles; ulp: of each coordinate; boost: a velocity added to all of a closed "
     "scene; mirror: in x; rotation: x to y to z to x; units: powers of 2"},
});

constexpr auto tables_of_case = std::to_array<TableInfo>({
    {"", "(top)", "The file. Numbers are SI, or texts with a unit: \"3 mm\", \"1.2 g/cm3\", \"20 degC\"."},
    {"case", "[case]", "What the case shows, and how it is judged."},
    {"scene", "[scene]", "What is simulated."},
    {"material", "[[material]]", "A material. Names of the library bring the library's values."},
    {"body", "[[body]]", "A body."},
    {"keyframe", "keyframes = [{time, position, rotation}]", "Position and rotation at a time."},
    {"shape.box", "shape = {kind = \"box\", ...}", "A box along the axes."},
    {"shape.sphere", "shape = {kind = \"sphere\", ...}", "A sphere."},
    {"shape.cylinder", "shape = {kind = \"cylinder\", ...}", "A cylinder."},
    {"shape.half_space", "shape = {kind = \"half_space\", ...}",
     "All that lies behind a plane; for regions, or cut by a difference."},
    {"shape.union", "shape = {kind = \"union\", ...}", "All of several shapes."},
    {"shape.difference", "shape = {kind = \"difference\", ...}", "A shape less another."},
    {"shape.mesh", "shape = {kind = \"mesh\", ...}", "The inside of a closed triangle mesh."},
    {"temperature.cosine", "temperature = {kind = \"cosine\", ...}", "A wave. A plain number is constant."},
    {"temperature.step", "temperature = {kind = \"step\", ...}", "Two values, on either side of a plane."},
    {"temperature.expression", "temperature = {kind = \"expression\", ...}", "A formula."},
    {"velocity.cosine", "velocity = {kind = \"cosine\", ...}", "A wave. A plain vector is constant."},
    {"velocity.linear", "velocity = {kind = \"linear\", ...}", "gradient (r - centre)."},
    {"velocity.taylor_green", "velocity = {kind = \"taylor_green\", ...}", "Vortices in x and y."},
    {"velocity.expression", "velocity = {kind = \"expression\", ...}", "Formulas."},
    {"event", "[[event]]", "An event at a time."},
    {"inflow", "[[inflow]]", "Liquid that flows in."},
    {"engines", "[engines.NAME]",
     "Each engine and preset is one row of the results. [engines.all] is no engine: its settings go to every engine, of which an "
     "engine's own go before: `friction` (Coulomb's coefficient) and `restitution` of every pair of bodies."},
    {"reference", "[reference]", "The truth that metrics are compared with."},
    {"metric", "[[metric]]", "A number computed from each run."},
    {"gates", "[[metric]] gates = [{...}]",
     "A gate within its metric: what [[gate]] has, less `metric`, which only says NAME.order or NAME.statistical."},
    {"invariants", "[invariants]", "Quantities that a run must keep, each by its name: `ledger = 1e-9`, or a table."},
    {"invariant", "[invariants.NAME]",
     "A quantity that a run must keep: keys of its metric, and those of its gate or `gates`. quantity and norm are the name's."},
    {"study", "[[study]]", "Runs at several levels of one axis: a convergence study."},
    {"gate", "[[gate]]", "A limit that decides between pass and fail."},
    {"input", "[[input]]",
     "An uncertain number. The case's own run is repeated with the number at both ends; half the difference of a metric is its "
     "input uncertainty."},
    {"defect", "[[defect]]", "A fault that this case must catch."},
    {"harmless", "[[harmless]]",
     "A change without physical effect. `tripoint gate selftest` runs the changed scene; no verdict and no metric may change."},
});

constexpr std::array type_texts{"number",
                                "integer",
                                "true or false",
                                "text",
                                "word",
                                "[x, y, z]",
                                "array of numbers",
                                "array of texts",
                                "number or \"auto\"",
                                "text or array of texts",
                                "array of words",
                                "table",
                                "array of tables",
                                "table of free keys",
                                "shape",
                                "number or table",
                                "[x, y, z] or table",
                                "limit, or table"};
constexpr std::array range_texts{
    "", "greater than 0", "0 or greater", "from 0 to 1", "greater than -1 and less than 0.5", "greater than 1"};

/// A gate within its metric has the keys of a gate, an invariant those of a metric and of a gate.
void add_short_forms(std::vector<Key>& list) {
  std::vector<Key> more;
  for (Key key : list) {
    if (key.table != "gate") continue;
    key.table = "gates";
    if (key.name == "metric") key.fallback = "=", key.note = "the metric that holds it";
    more.push_back(key);
  }
  for (const Invariant& one : invariants())
    more.push_back({"invariants", one.name, invariant, "", any, "", "it is not measured", "", one.meaning});
  more.push_back({"invariant", "value", number, "", any, "=", "0; required by body_count", "",
                  "what the quantity is compared with; only of overlap, body_count and toggles"});
  for (Key key : list) {
    const bool of_metric = key.table == "metric" && key.name != "quantity" && key.name != "limits",
               of_gate = key.table == "gate" && key.name != "metric";
    if (!of_gate && (!of_metric || key.name == "reason")) continue;
    key.table = "invariant";
    if (key.name == "name") key.fallback = "=", key.note = "the invariant's";
    if (key.name == "norm") key.fallback = "=", key.note = "the invariant's";
    if (key.name == "reason")
      key.fallback = "=", key.note = "round-off, of mass, momentum, angular_momentum and ledger; required by the others";
    more.push_back(key);
  }
  list.insert(list.end(), more.begin(), more.end());
}

/// Those that every scene reads; in each table behind them those that effects bring.
std::vector<Key> all_keys() {
  std::vector<Key> list(common_keys.begin(), common_keys.end());
  for (const EffectRule& rule : effect_rules()) {
    for (const EffectKey& key : rule.keys) {
      const auto last = std::find_if(list.rbegin(), list.rend(), [&](const Key& k) { return k.table == key.row.table; });
      list.insert(last.base(), key.row);
    }
  }
  add_short_forms(list);
  return list;
}

}  // namespace

std::span<const Key> key_table() {
  static const std::vector<Key> keys = all_keys();
  return keys;
}
std::span<const TableInfo> table_infos() { return tables_of_case; }

std::vector<const Key*> keys_of(std::string_view name) {
  std::vector<const Key*> rows;
  for (const auto& k : key_table())
    if (k.table == name) rows.push_back(&k);
  return rows;
}

std::vector<std::string> key_names(std::string_view name) {
  std::vector<std::string> names;
  for (const auto* k : keys_of(name)) names.emplace_back(k->name);
  return names;
}

const Key& key_row(std::string_view table_name, std::string_view name) {
  const auto found =
      std::find_if(key_table().begin(), key_table().end(), [&](const Key& k) { return k.table == table_name && k.name == name; });
  assert(found != key_table().end());
  return *found;
}

std::vector<std::string> split_words(std::string_view list) {
  std::vector<std::string> out;
  while (!list.empty()) {
    const auto end = std::min(list.find(' '), list.size());
    if (end > 0) out.emplace_back(list.substr(0, end));
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return out;
}

std::string_view type_text(ValueType t) { return type_texts[static_cast<std::size_t>(t)]; }
std::string_view range_text(Range r) { return range_texts[static_cast<std::size_t>(r)]; }

bool in_range(Range r, double v) {
  switch (r) {
    case any:
      return true;
    case positive:
      return v > 0.0;
    case not_negative:
      return v >= 0.0;
    case fraction:
      return v >= 0.0 && v <= 1.0;
    case poisson:
      return v > -1.0 && v < 0.5;
    case above_one:
      return v > 1.0;
  }
  return false;
}

}  // namespace tripoint
