// SPDX-License-Identifier: BSD-3-Clause
#include "scene/key_table.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "scene/effect_rule.hpp"

namespace tripoint {
namespace {

using enum ValueType;
using enum Range;

constexpr auto common_keys = std::to_array<Key>({
    // top
    {"", "scene", table, "", any, "!", "", "scene", "what is simulated"},
    {"", "material", tables, "", any, "=", "materials of the library serve by name", "material", "matter"},
    {"", "body", tables, "", any, "!", "", "body", "bodies, in the order of their rows"},
    {"", "event", tables, "", any, "=", "nothing happens on the way", "event", "what happens at a time"},
    {"", "inflow", tables, "", any, "=", "nothing flows in", "inflow", "liquid that flows in"},
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
});

constexpr auto tables_of_scene = std::to_array<TableInfo>({
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

/// Those that every scene reads; in each table behind them those that effects bring.
std::vector<Key> all_keys() {
  std::vector<Key> list(common_keys.begin(), common_keys.end());
  for (const EffectRule& rule : effect_rules()) {
    for (const EffectKey& key : rule.keys) {
      const auto last = std::find_if(list.rbegin(), list.rend(), [&](const Key& k) { return k.table == key.row.table; });
      list.insert(last.base(), key.row);
    }
  }
  return list;
}

}  // namespace

std::vector<const Key*> KeyTable::of(std::string_view table) const {
  std::vector<const Key*> rows;
  for (const auto& k : rows_)
    if (k.table == table) rows.push_back(&k);
  return rows;
}

std::vector<std::string> KeyTable::names(std::string_view table) const {
  std::vector<std::string> names;
  for (const auto* k : of(table)) names.emplace_back(k->name);
  return names;
}

const Key& KeyTable::row(std::string_view table, std::string_view name) const {
  const auto found = std::find_if(rows_.begin(), rows_.end(), [&](const Key& k) { return k.table == table && k.name == name; });
  assert(found != rows_.end());
  return *found;
}

const KeyTable& scene_keys() {
  static const KeyTable keys(all_keys(), {tables_of_scene.begin(), tables_of_scene.end()});
  return keys;
}

const Key& key_row(std::string_view table, std::string_view name) { return scene_keys().row(table, name); }

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
