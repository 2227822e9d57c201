// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene/term.hpp"

namespace tripoint::term {

inline constexpr Term rotation{"rotation"};  ///< (19) and (20)

}  // namespace tripoint::term
