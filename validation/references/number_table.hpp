// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <utility>

#include "validation/references/reference.hpp"

namespace tripoint {

using Numbers = std::map<std::string, double, std::less<>>;

/// A reference that knows numbers by name and no states: its snapshots hold their time alone.
class NumberTable : public Reference {
 public:
  explicit NumberTable(Numbers numbers, Measuring measuring = {})
      : numbers_(std::move(numbers)), measuring_(std::move(measuring)) {}
  [[nodiscard]] Snapshot at(double time) const override {
    Snapshot out;
    out.time = time;
    return out;
  }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    const auto found = numbers_.find(quantity);
    return found == numbers_.end() ? std::nullopt : std::optional(found->second);
  }
  [[nodiscard]] Measuring measuring() const override { return measuring_; }

 private:
  Numbers numbers_;
  Measuring measuring_;
};

}  // namespace tripoint
