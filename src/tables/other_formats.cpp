// SPDX-License-Identifier: BSD-3-Clause
#include "tables/other_formats.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace tripoint {
namespace {

struct Format {
  std::string_view begins;  ///< of the first characters that are no blanks; empty: any
  std::string_view holds;   ///< of the text
  std::string_view name;
};

constexpr auto formats = std::to_array<Format>({
    {"<", "<mujoco", "a MuJoCo model (MJCF)"},
    {"<", "<robot", "a robot description (URDF)"},
    {"<", "<casedef", "a case of DualSPHysics (XML)"},
    {"<", "<sdf", "a simulation description (SDF)"},
    {"{", "\"Configuration\"", "a scene of SPlisHSPlasH (JSON)"},
    {"{", "\"RigidBodies\"", "a scene of SPlisHSPlasH (JSON)"},
    {"<", "", "an XML file"},
    {"{", "", "a JSON file"},
    {"", "atom_style", "an input script of LAMMPS"},
    {"", "pair_style", "an input script of LAMMPS"},
    {"", "\nlattice ", "an input script of LAMMPS"},
    {"", "\nread_data ", "an input script of LAMMPS"},
    {"*", "*NODE", "a model of CalculiX or Abaqus"},
});

/// Beginnings suffice: long files are not searched to their end.
constexpr std::size_t searched = 100'000;

}  // namespace

std::string other_format(std::string_view text) {
  const auto first = std::ranges::find_if(text, [](unsigned char c) { return std::isspace(c) == 0; });
  text.remove_prefix(static_cast<std::size_t>(first - text.begin()));
  text = text.substr(0, searched);
  for (const Format& f : formats)
    if (text.starts_with(f.begins) && text.find(f.holds) != text.npos) return std::string(f.name);
  return {};
}

}  // namespace tripoint
