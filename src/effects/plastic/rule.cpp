// SPDX-License-Identifier: BSD-3-Clause
#include "scene/effect_rule.hpp"
#include "tables/table_reader.hpp"

namespace tripoint::plastic {
namespace {

bool has_limit(const Material& m) { return m.elastic_limit.has_value(); }

std::string called_for(const Scene& s) { return limit_called_for(s, has_limit, "an elastic_limit", "yield"); }

std::string left_out(const Scene& s) { return limit_left_out(s, has_limit, "an elastic_limit"); }

/// Keys of the case file.
std::vector<EffectKey> keys() {
  using enum ValueType;
  using enum Range;
  return {
      {.row = {"material", "elastic_limit", number, "", positive, "", "never yields", "",
               "deviatoric strain where plastic flow begins"},
       .kept_in = &Material::elastic_limit,
       .limit = true},
      {.row = {"material", "plastic_limit", number, "", positive, "", "flows without end", "",
               "largest plastic strain"},
       .kept_in = &Material::plastic_limit,
       .limit = true},
  };
}

void settle_material(TableReader& in, Material& m) {
  if (m.plastic_limit && !m.elastic_limit)
    in.refuse("plastic_limit", "without elastic_limit nothing flows: give elastic_limit too");
}

}  // namespace

EffectRule rule() {
  return {.name = "plastic",
          .called_for = called_for,
          .left_out = left_out,
          .keys = keys(),
          .settle_material = settle_material,
          .ledger_entries = {{"plastic", "work that plastic flow took"}},
          .over_processes = true};
}

}  // namespace tripoint::plastic
