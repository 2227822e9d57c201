// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene/term.hpp"

namespace tripoint::term {

inline constexpr Term drag{"drag"};

}  // namespace tripoint::term
