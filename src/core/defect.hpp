// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

/// Run-time defects: faults that the self-test injects to prove that the gate sees them. No source of the
/// solver knows one. The defects.toml of a folder says what can be broken there and how.
/// tools/break_sources.py writes broken copies of the files, and the self-test's engines are made of these.
namespace tripoint {

/// Registration of a physical term: the case that must turn red when the term is broken.
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

/// All that the defects.toml of solver and engine register. Its source is written by tools/break_sources.py.
[[nodiscard]] std::vector<DefectEntry> registered_defects();

/// A name as an argument of a template.
template <std::size_t length>
struct DefectName {
  char text[length];
  constexpr DefectName(
      const char (&name)[length]) {  // NOLINT(google-explicit-constructor): a literal stands for it
    for (std::size_t k = 0; k < length; ++k) text[k] = name[k];
  }
};

/// The same, looked up once: for formulas.
template <DefectName name>
double defect() {
  static const double size = defect_size(name.text);
  return size;
}
#endif

}  // namespace tripoint
