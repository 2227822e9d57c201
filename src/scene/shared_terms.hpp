// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene/term.hpp"

/// Terms that several rooms read, each written once for all of them. Their effects declare them; one that an
/// effect alone reads stands in its folder. Code that goes over all terms asks declared_terms(), and needs no
/// name.
namespace tripoint::term {

inline constexpr Term kernel{"kernel"};        ///< (1) to (3), brought by each term in its form
inline constexpr Term pressure{"pressure"};    ///< (7)
inline constexpr Term density{"density"};      ///< (4)
inline constexpr Term state{"state"};          ///< (9)
inline constexpr Term clamp{"clamp"};          ///< no pressure below zero: the paper prints none
inline constexpr Term viscosity{"viscosity"};  ///< (8)
/// How liquid sees the velocity and the pressure of walls (model 8.4)
inline constexpr Term walls{"walls"};
inline constexpr Term elastic{"elastic"};      ///< (10) to (17)
inline constexpr Term hourglass{"hourglass"};  ///< energy against modes without energy: the paper prints none
inline constexpr Term heat{"heat"};            ///< (21)
inline constexpr Term phase{"phase"};          ///< Fig. 5
inline constexpr Term time{"time"};            ///< leapfrog

}  // namespace tripoint::term
