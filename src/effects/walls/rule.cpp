// SPDX-License-Identifier: BSD-3-Clause
#include "liquids/fixed_walls.hpp"

namespace tripoint::walls {
namespace {

std::string called_for(const Scene& s) {
  return calls_for(s, "pressure") && liquid::averages_walls(s) && liquid::can_have_walls(s)
             ? "liquid alone touches what is held or driven"
             : "";
}

}  // namespace

EffectRule rule() { return {.name = "walls", .called_for = called_for, .over_processes = true}; }

}  // namespace tripoint::walls
