// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// How calls that change a file at a place answer in this program, libhdf5's too: death_in_a_write_test.cpp
/// stands in their way.
namespace tripoint::test {

inline int write_error = 0;            ///< errno with which they fail; 0 = they do not
inline bool only_first_bytes = false;  ///< only those that write the beginning of a file
/// That many pass before one fails, and all that follow it pass; negative: each fails
inline int calls_until_failure = -1;

}  // namespace tripoint::test
