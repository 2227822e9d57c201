// SPDX-License-Identifier: BSD-3-Clause
#include "scene/effect_rule.hpp"

namespace tripoint::fracture {
namespace {

bool has_limit(const Material& m) { return m.fracture_stretch || m.fracture_distance; }

std::string called_for(const Scene& s) { return limit_called_for(s, has_limit, "a fracture limit", "break"); }

std::string left_out(const Scene& s) { return limit_left_out(s, has_limit, "a fracture limit"); }

/// Keys of the case file.
std::vector<EffectKey> keys() {
  using enum ValueType;
  using enum Range;
  return {
      {.row = {"material", "fracture_stretch", number, "", above_one, "", "never breaks", "",
               "corrected: stretch |r|/|x| that breaks a bond"},
       .kept_in = &Material::fracture_stretch,
       .limit = true},
      {.row = {"material", "fracture_distance", number, "", positive, "", "never breaks", "",
               "paper: distance that breaks a bond, in spacings"},
       .kept_in = &Material::fracture_distance,
       .limit = true},
  };
}

}  // namespace

EffectRule rule() {
  return {.name = "fracture",
          .called_for = called_for,
          .left_out = left_out,
          .keys = keys(),
          .ledger_entries = {"fracture"},
          .over_processes = true};
}

}  // namespace tripoint::fracture
