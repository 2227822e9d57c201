// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <type_traits>
#include <variant>

#include "scene/effect_rule.hpp"
#include "scene/value_reader.hpp"

/// The keys that effects bring, wherever a scene is read or written: the case file, and JSON in both
/// directions.
namespace tripoint {

/// Calls visit(row, value) for each key that effects have in this table and keep in an Owner, a Scene or a
/// Material. Numbers that have no member of their own are a double of Owner::values.
template <class Owner, class Visit>
void each_effect_key(Owner& owner, std::string_view table, Visit visit) {
  for (const EffectRule& rule : effect_rules()) {
    for (const EffectKey& key : rule.keys) {
      if (key.row.table != table) continue;
      const auto kept = [&](const auto& member) {
        using Member = std::decay_t<decltype(member)>;
        if constexpr (std::is_same_v<Member, std::monostate>) {
          if constexpr (std::is_const_v<Owner>)
            visit(key.row, kept_number(owner.values, key.row));
          else
            visit(key.row,
                  owner.values.try_emplace(std::string(key.row.name), kept_number(owner.values, key.row))
                      .first->second);
        } else if constexpr (requires { owner.*member; }) {
          visit(key.row, owner.*member);
        }
      };
      std::visit(kept, key.kept_in);
    }
  }
}

/// Reads the keys that effects have in a table; old ones where they are given. @throws InputError as
/// TableReader does
template <class Owner>
void read_effect_keys(TableReader& in, std::string_view table, Owner& owner, Reading& reading) {
  ValueReader read(in, reading);
  each_effect_key(owner, table, [&](const Key& key, auto& value) {
    if (!key.old || in.has(key.name)) read(key, value);
  });
}

}  // namespace tripoint
