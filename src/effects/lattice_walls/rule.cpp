// SPDX-License-Identifier: BSD-3-Clause
#include "liquids/fixed_walls.hpp"

namespace tripoint::lattice_walls {
namespace {

std::string called_for(const Scene& s) {
  return calls_for(s, "pressure") && liquid::averages_walls(s) && liquid::can_have_walls(s) &&
                 liquid::has_lattice_walls(s)
             ? "fixed walls jitter, and liquid lies on their lattice"
             : "";
}

}  // namespace

EffectRule rule() { return {.name = "lattice_walls", .called_for = called_for, .over_processes = true}; }

}  // namespace tripoint::lattice_walls
