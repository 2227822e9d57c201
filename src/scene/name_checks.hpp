// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "scene/readers.hpp"

/// Names of a case file that refer to each other.
namespace tripoint {

template <class T>
std::vector<std::string> names_of(const std::vector<T>& list) {
  std::vector<std::string> names;
  names.reserve(list.size());
  for (const auto& t : list) names.push_back(t.name);
  return names;
}

[[nodiscard]] bool holds(const std::vector<std::string>& list, const std::string& name);

/// Parts that every check of names needs. All throw InputError with the place of the name.
class NameChecks {
 public:
  explicit NameChecks(const Reading& reading) : reading_(reading) {}

  /// Place of a key that was given, else of its table.
  [[nodiscard]] SourcePlace place(const std::string& key, const SourcePlace& table) const;
  /// Two tables of an array have two names.
  template <class T>
  void unique(const std::vector<T>& list, const char* table) const {
    unique_names(names_of(list), table);
  }
  /// @param also names besides those of [[body]]: of bodies that events make
  void known_body(const Scene&, const std::string& name, const std::string& key, const SourcePlace& table,
                  const std::vector<std::string>& also = {}) const;

 private:
  void unique_names(const std::vector<std::string>& names, const char* table) const;
  [[nodiscard]] SourcePlace last_place(const std::string& key) const;

  const Reading& reading_;
};

}  // namespace tripoint
