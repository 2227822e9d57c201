// SPDX-License-Identifier: BSD-3-Clause
#include "effects/carried_liquid/owned_columns.hpp"

#include <algorithm>

#include "effects/carried_liquid/fields.hpp"
#include "effects/carried_liquid/sound_terms.hpp"

namespace tripoint::carried_liquid {

fields::List shared() {
  return {field::density, field::volume, field::pressure, field::group, field::force, field::viscous_force};
}

fields::List owned(bool solids_meet) {
  fields::List list{field::shift, field::compression_at_start};
  const auto add = [&](std::span<const Field<double>* const> some) {
    for (const Field<double>* f : some)
      if (std::ranges::find(list, FieldInfo(*f)) == list.end()) list.emplace_back(*f);
  };
  using AllGradients = Gradients<Pair::own>;
  using AllForces = Forces<Pair::own, Damping::residue>;
  add(WallRate::adds::list);
  add(WallPressure::adds::list);
  add(Moments::adds::list);
  add(AllGradients::adds::list);
  add(AllForces::adds::list);
  const auto add_read = [&](std::span<const Field<double>* const> some) {
    for (const Field<double>* f : some)
      if (f != &field::velocity.x && f != &field::velocity.y && f != &field::velocity.z) add({{f}});
  };
  add_read(AllForces::reads::list);
  add_read(WallRate::reads::list);
  add_read(WallPressure::reads::list);
  add({{&field::exposed}});
  add_read(AllGradients::reads::list);
  add(SoundForce::reads::list);
  const fields::List both = shared();
  std::erase_if(list, [&](const FieldInfo& f) { return std::ranges::find(both, f) != both.end(); });
  if (!solids_meet) list.insert(list.end(), both.begin(), both.end());
  return list;
}

}  // namespace tripoint::carried_liquid
