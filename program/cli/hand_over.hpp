// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace tripoint {

/// Becomes a program of the reports, which also takes Ctrl-C then.
/// @param program  its file in the folder of the reports, for example "view.py"
/// @param options  its options, each with its value: --out=FILE
/// @param operands its operands, each a word of its own even where it begins with a hyphen
/// @return never
/// @throws EngineError where there is no such program, or no Python that starts it
[[noreturn]] void hand_over(const std::string& program, const std::vector<std::string>& options,
                            const std::vector<std::string>& operands);

}  // namespace tripoint
