// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"

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

/// The limit of one form alone, where no run has that form.
std::vector<WrongKey> wrong_keys(const Material& m, std::span<const Scene> runs) {
  const auto runs_as = [&](Mode mode) {
    return std::ranges::any_of(runs, [&](const Scene& s) { return s.mode_of(term::elastic) == mode; });
  };
  if (m.fracture_distance && !m.fracture_stretch && !runs_as(Mode::paper))
    return {{"fracture_distance", fmt::format("fracture_distance is the limit of the printed form, and this "
                                              "case runs the corrected one, in which "
                                              "\"{}\" never breaks: give fracture_stretch",
                                              m.name)}};
  if (m.fracture_stretch && !m.fracture_distance && !runs_as(Mode::corrected))
    return {{"fracture_stretch", fmt::format("fracture_stretch is the limit of the corrected form, and this "
                                             "case runs the printed one, in which "
                                             "\"{}\" never breaks: give fracture_distance",
                                             m.name)}};
  return {};
}

}  // namespace

EffectRule rule() {
  return {.name = "fracture",
          .called_for = called_for,
          .left_out = left_out,
          .keys = keys(),
          .scene_keys_shared = {"merge_distance"},
          .wrong_keys = wrong_keys,
          .ledger_entries = {{"fracture", "what broken bonds held"}},
          .over_processes = true,
          .has_bonds = true};
}

}  // namespace tripoint::fracture
