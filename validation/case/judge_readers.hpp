// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "scene/readers.hpp"
#include "validation/case/case_keys.hpp"
#include "validation/case/choices.hpp"

/// The parts of the case reader that say how a scene is judged, one function a table. All throw InputError
/// with the place and what to write instead.
namespace tripoint {

struct Case;

/// A table of the case file, be it the scene's or the judge's.
[[nodiscard]] inline TableReader case_table(const TomlNode& node, std::string_view table, std::string path,
                                            Reading& reading) {
  return {node, table, std::move(path), reading.decisions, case_keys()};
}

[[nodiscard]] EngineChoice read_engine(const TomlNode&, const std::string& name, Reading&);
[[nodiscard]] ReferenceChoice read_reference(const TomlNode&, const std::string& path, Reading&);
[[nodiscard]] MetricChoice read_metric(const TomlNode&, Reading&);
[[nodiscard]] Study read_study(const TomlNode&, std::size_t number, double end_time, Reading&);
[[nodiscard]] Gate read_gate(const TomlNode&, std::size_t number, Reading&);
[[nodiscard]] UncertainInput read_input(const TomlNode&, std::size_t number, Reading&);
[[nodiscard]] Defect read_defect(const TomlNode&, std::size_t number, Reading&);

/// Names that refer to each other, and rules between keys: after everything is read.
void check_judgement(const Case&, const Reading&);

}  // namespace tripoint
