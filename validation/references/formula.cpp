// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <map>

#include "tables/expression.hpp"
#include "validation/references/field_truth.hpp"
#include "validation/references/measuring.hpp"

namespace tripoint {
namespace {

/// Formulas that a case writes itself: a number in time, or fields of place and time.
class Formula : public Reference {
 public:
  Formula(Numbers numbers, Measuring measuring, std::map<std::string, Expression, std::less<>> formulas)
      : numbers_(std::move(numbers)), measuring_(std::move(measuring)), formulas_(std::move(formulas)) {}
  [[nodiscard]] Measuring measuring() const override { return measuring_; }
  [[nodiscard]] Snapshot at(double time) const override {
    Snapshot out;
    out.time = time;
    return out;
  }
  [[nodiscard]] Snapshot truth_for(const Snapshot& now) const override {
    return truth_of_fields(now, [&](const std::string& field) -> std::function<double(const Vec3&)> {
      const auto found = formulas_.find(field);
      if (found == formulas_.end()) return {};
      return [&formula = found->second, t = now.time](const Vec3& r) { return formula(r, t); };
    });
  }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "value") return number_at(quantity, 0.0);
    const auto found = numbers_.find(quantity);
    return found == numbers_.end() ? std::nullopt : std::optional(found->second);
  }
  [[nodiscard]] std::optional<double> number_at(std::string_view quantity, double time) const override {
    const auto field = quantity == "value" ? std::string(quantity) : field_of_probe(quantity, measuring_);
    const auto found = formulas_.find(field);
    return found == formulas_.end() ? number_of(quantity)
                                    : std::optional(found->second(measuring_.point.value_or(Vec3{}), time));
  }

 private:
  [[nodiscard]] std::optional<double> number_of(std::string_view quantity) const {
    const auto found = numbers_.find(quantity);
    return found == numbers_.end() ? std::nullopt : std::optional(found->second);
  }
  Numbers numbers_;
  Measuring measuring_;
  std::map<std::string, Expression, std::less<>> formulas_;
};

std::unique_ptr<Reference> make_formula(const ReferenceInput& in) {
  std::map<std::string, Expression, std::less<>> formulas;
  for (const auto& a : truth_fields()) {
    const auto text = in.args.word(a.name);
    if (!text) continue;
    try {
      formulas.emplace(a.name, Expression(*text, Expression::Time::known));
    } catch (const InputError& e) {
      throw InputError("argument `" + a.name + "` of reference function expression, " + e.what());
    }
  }
  if (formulas.empty())
    throw InputError(
        "reference function expression needs a formula: `value` of t for a single number, or `temperature`, "
        "`pressure`, "
        "`density`, `velocity_x` ... of x, y, z and t for a field");
  return std::make_unique<Formula>(stated_numbers(in, "expression"), stated_measuring(in, "expression"),
                                   std::move(formulas));
}

}  // namespace

ReferenceEntry expression_entry() {
  std::vector<ReferenceArgument> args = truth_fields();
  for (const auto& a : measuring_arguments()) args.push_back(a);
  return {{"expression", "analytic", "the case's own formula",
           "formulas of x, y, z and t as texts. `value` of t is for a single number, the others are for "
           "fields at the particle's "
           "position",
           args},
          make_formula};
}

}  // namespace tripoint
