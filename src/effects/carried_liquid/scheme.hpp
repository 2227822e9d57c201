// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/pair_term.hpp"
#include "effects/carried_liquid/carried_terms.hpp"
#include "scene/scene.hpp"

/// The named forms, each with one setting for all scenes.
namespace tripoint::carried_liquid {

enum class Shift : int { none, by_sound, by_speed };
enum class Tie : int { none, relaxed, summed };

struct Scheme {
  PairTerm gradients, forces;
  Damping damping;
  double beta;   ///< of the viscosity of the residue [1]
  double delta;  ///< of the density diffusion; 1 where it is that of the Riemann pair [1]
  Shift shift;
  double strength;  ///< of the shift [1]
  Tie tie;          ///< of the density to the summed one
  double relax;     ///< rate of the relaxed tie over c/support [1]
  bool follows;     ///< density and velocity follow the shift
  int hold;         ///< steps of sound that take the same gradients
  double courant;   ///< share of support/(c + v) that a step takes [1]
};

/// @pre the scene names one
[[nodiscard]] Scheme scheme_of(const Scene&);

}  // namespace tripoint::carried_liquid
