// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace tripoint {

/// A value of a case file whose keys are free (function arguments, engine settings).
using Setting = std::variant<bool, double, std::string, std::vector<double>>;
using Settings = std::map<std::string, Setting>;

}  // namespace tripoint
