// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "scene/table_reader.hpp"

/// The parts of the case reader, one function a table. All throw InputError with the place and what to write instead.
namespace tripoint {

/// Of one run: years on any machine, and far below what a counter holds.
inline constexpr double most_steps = 1e12;

/// What the parts share.
struct Reading {
  std::string folder;  ///< of the case, where meshes and data lie
  std::vector<Decision> decisions;
};

[[nodiscard]] Shape read_shape(const TomlNode&, const std::string& path, Reading&, int depth = 0);
[[nodiscard]] TemperatureField read_temperature(const TomlNode&, const std::string& path, Reading&);
[[nodiscard]] VelocityField read_velocity(const TomlNode&, const std::string& path, Reading&);
[[nodiscard]] std::vector<Keyframe> read_keyframes(TableReader& owner, std::string_view key, Reading&);

[[nodiscard]] Material read_material(const TomlNode&, Reading&);
[[nodiscard]] Body read_body(const TomlNode&, const std::vector<Material>&, Reading&);
[[nodiscard]] Event read_event(const TomlNode&, std::size_t number, Reading&);
[[nodiscard]] Inflow read_inflow(const TomlNode&, std::size_t number, double end_time, Reading&);

[[nodiscard]] EngineChoice read_engine(const TomlNode&, const std::string& name, Reading&);
[[nodiscard]] ReferenceChoice read_reference(const TomlNode&, const std::string& path, Reading&);
[[nodiscard]] MetricChoice read_metric(const TomlNode&, Reading&);
[[nodiscard]] Study read_study(const TomlNode&, std::size_t number, double end_time, Reading&);
[[nodiscard]] Gate read_gate(const TomlNode&, std::size_t number, Reading&);
[[nodiscard]] UncertainInput read_input(const TomlNode&, std::size_t number, Reading&);
[[nodiscard]] Defect read_defect(const TomlNode&, std::size_t number, Reading&);

/// Names that become folders, columns and command line arguments: refuses any but letters, digits, blanks, _ - .
void plain_name(TableReader&, std::string_view key, const std::string& name);

/// Names that refer to each other, and rules between keys: after everything is read.
void check_references(const Case&, const Reading&);

/// Puts "a.b=VALUE" into the document. Tables of an array are found by their `name`, or by their number from 1.
void apply_override(TomlNode& document, const std::string& set);

/// Path of a text for the list of a material library, "" when the library has none of that name.
[[nodiscard]] std::string library_file(const std::string& material);
[[nodiscard]] std::vector<std::string> library_names();

/// The name of a table of an array for paths and messages: its `name` key if that is a text, else its number from 1.
[[nodiscard]] std::string entry_name(const TomlNode&, std::size_t number);

}  // namespace tripoint
