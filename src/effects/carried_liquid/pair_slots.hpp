// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/carried_liquid/sound_terms.hpp"
#include "pairs/pair_slots.hpp"

namespace tripoint::carried_liquid {

struct PairSlots : NoPairTerms {
  using density = OneTermOf<Moments>;
  using alone =
      OneTermOf<WallRate, WallPressure, FaceRate, FaceLoad, SoundRate, SoundForce, Gradients<Pair::own>,
                Gradients<Pair::mean>, Gradients<Pair::reverse>, Gradients<Pair::reverse_plain>,
                Forces<Pair::own, Damping::residue>, Forces<Pair::own, Damping::limited_residue>,
                Forces<Pair::mean, Damping::residue>, Forces<Pair::reverse, Damping::limited_residue>,
                Forces<Pair::reverse_plain, Damping::limited>>;
};

}  // namespace tripoint::carried_liquid
