// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_keys.hpp"

#include <algorithm>
#include <array>

#include "scene/effect_rule.hpp"
#include "scene/model.hpp"
#include "scene/place_records.hpp"
#include "scene/scene_records.hpp"

namespace tripoint {
namespace {

using enum ValueType;
using enum Range;

constexpr auto top_keys = std::to_array<Key>({
    {"", "scene", table, "", any, "!", "", "scene", "the simulated scene"},
    {"", "model", table, "", any, "=", "the forms that scene.mode and the defaults say", "model",
     "form of each term of the model"},
    {"", "material", tables, "", any, "=", "materials of the library serve by name", "material", "matter"},
    {"", "body", tables, "", any, "!", "", "body", "bodies, in the order of their rows"},
    {"", "event", tables, "", any, "=", "nothing happens on the way", "event", "what happens at a time"},
    {"", "inflow", tables, "", any, "=", "nothing flows in", "inflow", "liquid that flows in"},
    {"", "outflow", tables, "", any, "=", "nothing flows out", "outflow", "where liquid flows out"},
    {"", "contact", tables, "", any, "=", "no friction; restitution as each engine's preset has it",
     "contact", "friction and restitution by pairs of materials"},
    {"", "force", tables, "", any, "=", "gravity alone", "force", "forces and torques on rigid bodies"},
    {"", "spring", tables, "", any, "=", "nothing holds bodies together", "spring",
     "springs and dampers between points of rigid bodies"},
    {"", "joint", tables, "", any, "=", "bodies are free of each other", "joint", "joints of rigid bodies"},
    {"", "source", tables, "", any, "=", "no heat comes from outside", "source", "heat from outside"},
});

constexpr auto tables_of_scene = std::to_array<TableInfo>({
    {"scene", "[scene]", "The simulated scene."},
    {"model", "[model]",
     "The form of each term of the model, by a word that holds in every mode: `viscosity = \"morris\"`; "
     "paper: as the paper prints it. `scene.mode` says the form of a term of the paper that is not named "
     "here."},
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
    {"outflow", "[[outflow]]", "Where liquid flows out: what comes in is dropped and counted (model 8.14)."},
    {"contact", "[[contact]]", "Friction and restitution of a pair of materials."},
    {"force", "[[force]]", "A force or a torque on a rigid body, constant from its start to its stop."},
    {"spring", "[[spring]]",
     "A spring and a damper between points of two rigid bodies, or of one and the world (model 8.16)."},
    {"joint", "[[joint]]",
     "A joint of two rigid bodies, or of one and the world; loops are allowed. Engines take it that name the "
     "capability `joint`."},
    {"joint.spring", "spring = {stiffness, rest}", "A spring along the coordinate of a hinge or slider."},
    {"joint.motor", "motor = {effort} or {speed}", "A motor along it."},
    {"source", "[[source]]",
     "Heat from outside: into the volume of bodies, or through outer surfaces of fixed ones, where they "
     "touch no body. Several "
     "sources of one surface add up."},
});

void add_rows(std::vector<Key>& list, const auto& record) {
  std::apply([&](const auto&... entries) { (list.push_back(row_of(entries)), ...); }, record);
}

void add_rows_of_kinds(std::vector<Key>& list, const auto& kinds) {
  std::apply([&](const auto&... all) { (add_rows(list, all.record), ...); }, kinds);
}

/// Keys that every scene reads; in each table behind them the keys that effects bring.
std::vector<Key> all_keys() {
  std::vector<Key> list(top_keys.begin(), top_keys.end());
  add_rows(list, record<Scene>);
  for (const Key& row : model_keys()) list.push_back(row);
  add_rows(list, record<Material>);
  add_rows(list, record<Body>);
  add_rows(list, record<Keyframe>);
  add_rows_of_kinds(list, kinds<Shape>);
  add_rows_of_kinds(list, kinds<TemperatureField>);
  add_rows_of_kinds(list, kinds<VelocityField>);
  add_rows(list, record<Event>);
  add_rows(list, record<Inflow>);
  add_rows(list, record<Outflow>);
  add_rows(list, record<ContactLaw>);
  add_rows(list, record<AppliedForce>);
  add_rows(list, record<Spring>);
  add_rows(list, record<Joint>);
  add_rows(list, record<JointSpring>);
  add_rows(list, record<JointMotor>);
  add_rows(list, record<HeatSource>);
  for (const EffectRule& rule : effect_rules()) {
    for (const EffectKey& key : rule.keys) {
      const auto last =
          std::find_if(list.rbegin(), list.rend(), [&](const Key& k) { return k.table == key.row.table; });
      list.insert(last.base(), key.row);
    }
  }
  return list;
}

}  // namespace

const KeyTable& scene_keys() {
  static const KeyTable keys(all_keys(), {tables_of_scene.begin(), tables_of_scene.end()});
  return keys;
}

const Key& key_row(std::string_view table, std::string_view name) { return scene_keys().row(table, name); }

}  // namespace tripoint
