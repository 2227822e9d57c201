// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/field.hpp"

/// Numbers that a step needs of those before it, beside the columns. Each is a typed key, as a field is: an
/// effect declares its own in its folder, and a checkpoint keeps them all.
namespace tripoint {

struct StepNumber {
  std::string_view name;
  double at_start;  ///< in the unit that its declaration says
  /// Where processes share a scene, each has its own, and the least is that of the whole
  bool least_of_processes = false;
  std::uint64_t key = key_of(name);
  bool operator==(const StepNumber& other) const noexcept { return key == other.key; }
};

/// The step numbers of a scene and their present values.
class StepNumbers {
 public:
  /// Adds a number at its value of the start. @throws std::logic_error where it is there already
  void declare(const StepNumber& n) {
    if (std::ranges::find(declared_, n) != declared_.end())
      throw std::logic_error("the step number " + std::string(n.name) + " is declared twice");
    declared_.push_back(n);
    values_.push_back(n.at_start);
  }
  /// @throws std::logic_error where no effect of the scene has declared it
  [[nodiscard]] double& operator[](const StepNumber& n) { return values_[place(n)]; }
  [[nodiscard]] double operator[](const StepNumber& n) const { return values_[place(n)]; }

  /// In the order in which they were declared, as their values.
  [[nodiscard]] std::span<const StepNumber> declared() const noexcept { return declared_; }
  [[nodiscard]] std::span<const double> values() const noexcept { return values_; }
  [[nodiscard]] std::span<double> values() noexcept { return values_; }

 private:
  [[nodiscard]] std::size_t place(const StepNumber& n) const {
    const auto at = std::ranges::find(declared_, n);
    if (at == declared_.end())
      throw std::logic_error("no effect of this scene has declared the step number " + std::string(n.name));
    return static_cast<std::size_t>(at - declared_.begin());
  }

  std::vector<StepNumber> declared_;
  std::vector<double> values_;
};

}  // namespace tripoint
