// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

/// Work that remains when this process is killed by a signal that it cannot catch.
namespace tripoint {

/// From the first call on, a process of its own waits for our end. Where we are killed, it kills every
/// process that carries this mark or one made of it (strays.hpp), and ends. At an ordinary exit it ends at
/// once. A machine that has no process to spare goes unwatched.
void watch_for_our_end(const std::string& mark);

}  // namespace tripoint
