// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "tables/table_reader.hpp"

/// The parts of the reader of scenes, one function a table. All throw InputError with the place and what to
/// write instead.
namespace tripoint {

/// Data that the parts share.
struct Reading {
  std::string file;    ///< of the case
  std::string folder;  ///< of the file, where meshes and data lie
  std::vector<Decision> decisions;
};

[[nodiscard]] Shape read_shape(const TomlNode&, const std::string& path, Reading&, int depth = 0);
[[nodiscard]] TemperatureField read_temperature(const TomlNode&, const std::string& path, Reading&);
[[nodiscard]] VelocityField read_velocity(const TomlNode&, const std::string& path, Reading&);
[[nodiscard]] std::vector<Keyframe> read_keyframes(TableReader& owner, const Key& key, Reading&);

[[nodiscard]] Material read_material(const TomlNode&, Reading&);
[[nodiscard]] Body read_body(const TomlNode&, const std::vector<Material>&, Reading&);
[[nodiscard]] Event read_event(const TomlNode&, std::size_t number, Reading&);
[[nodiscard]] Inflow read_inflow(const TomlNode&, std::size_t number, double end_time, Reading&);

[[nodiscard]] ContactLaw read_contact_law(const TomlNode&, std::size_t number, Reading&);
[[nodiscard]] AppliedForce read_force(const TomlNode&, std::size_t number, Reading&);
[[nodiscard]] Outflow read_outflow(const TomlNode&, std::size_t number, Reading&);
[[nodiscard]] Joint read_joint(const TomlNode&, Reading&);
[[nodiscard]] Spring read_spring(const TomlNode&, std::size_t number, Reading&);
[[nodiscard]] HeatSource read_source(const TomlNode&, std::size_t number, double end_time, Reading&);

/// Everything that is simulated: [scene], materials, bodies, events, inflows, laws of contact, forces,
/// sources of heat.
[[nodiscard]] Scene read_scene(TableReader& top, Reading&);

/// Names that become folders, columns and command line arguments: refuses any but letters, digits, blanks, _
/// - .
void plain_name(TableReader&, std::string_view key, const std::string& name);

/// Names that refer to each other, and rules between keys: after everything is read.
/// @param runs the forms that the scene is run in
void check_scene(const Scene&, const std::vector<Mode>& runs, const Reading&);

/// The name of a table of an array for paths and messages: its `name` key if that is a text, else its number
/// from 1.
[[nodiscard]] std::string entry_name(const TomlNode&, std::size_t number);

}  // namespace tripoint
