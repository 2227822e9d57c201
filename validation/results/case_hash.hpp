// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

/// The question that a case asks, in a few hashes: a change of it is seen, also where its limits stay.
namespace tripoint {

/// Hashes of the keys that the file, its base and the library of materials give, resolved to SI. Units,
/// comments and the order of tables do not count, nor does text for people.
struct CaseHashes {
  /// Scene, materials, bodies, events, studies, modes, `expect`, settings of engines; with files that they
  /// name
  std::string scene;
  std::string reference;  ///< of the case, with its data
  /// By name: quantity, norm, body, place, window, scale, unit, own reference
  std::map<std::string, std::string> metrics;
  std::map<std::string, bool> required;  ///< by engine, as the case says
  std::vector<std::string> profiles;
};

/// Nothing where the file cannot be read as a case.
[[nodiscard]] std::optional<CaseHashes> case_hashes(const std::string& file);

}  // namespace tripoint
