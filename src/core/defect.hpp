// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

/// Run-time defects: faults that the self-test injects to prove that the gate sees them. They exist in the test build only
/// (TRIPOINT_DEFECTS); in what users get, defect_size() is the constant 0 and costs nothing.
namespace tripoint {

/// What a physical term registers: the case that must turn red when it is broken.
struct DefectEntry {
  std::string name;     ///< e.g. heat.conductivity
  std::string what;     ///< what is broken, and what the size means
  std::string case_id;  ///< the case that must catch it
};

#ifdef TRIPOINT_DEFECTS
/// Size of the defect when TRIPOINT_DEFECT is "name=size", else 0.
inline double defect_size(std::string_view name) {
  static const std::string active = [] {
    const char* text = std::getenv("TRIPOINT_DEFECT");
    return std::string(text ? text : "");
  }();
  const auto equals = active.find('=');
  if (equals == std::string::npos || std::string_view(active).substr(0, equals) != name) return 0.0;
  return std::strtod(active.c_str() + equals + 1, nullptr);
}
#else
constexpr double defect_size(std::string_view) { return 0.0; }
#endif

}  // namespace tripoint
