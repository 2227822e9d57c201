// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/not_a_number.hpp"
#include "tables/nearest.hpp"
#include "validation/references/experiment.hpp"
#include "validation/references/field_truth.hpp"
#include "validation/references/measuring.hpp"

namespace tripoint {
namespace {

/// Between two rows by a straight line; beyond the table nothing is known.
double between(const std::vector<double>& x, const std::vector<double>& y, double at) {
  if (!(at >= x.front() && at <= x.back())) return not_a_number;
  const auto next = std::max<std::ptrdiff_t>(1, std::lower_bound(x.begin(), x.end(), at) - x.begin());
  if (x.size() == 1) return y.front();
  const auto k = static_cast<std::size_t>(next);
  return y[k - 1] + (at - x[k - 1]) / (x[k] - x[k - 1]) * (y[k] - y[k - 1]);
}

/// A table beside the case: a number in time, or fields along an axis that do not change.
class Table : public Reference {
 public:
  Table(Numbers numbers, Measuring measuring, ExperimentFile file, std::string column)
      : numbers_(std::move(numbers)),
        measuring_(std::move(measuring)),
        file_(std::move(file)),
        column_(std::move(column)) {}
  [[nodiscard]] Measuring measuring() const override { return measuring_; }
  [[nodiscard]] Snapshot at(double time) const override {
    Snapshot out;
    out.time = time;
    return out;
  }
  [[nodiscard]] Snapshot truth_for(const Snapshot& now) const override {
    if (in_time()) return at(now.time);
    const auto axis = static_cast<std::size_t>(file_.first[0] - 'x');
    return truth_of_fields(now, [&](const std::string& field) -> std::function<double(const Vec3&)> {
      const auto found = file_.curves.find(field);
      if (found == file_.curves.end()) return {};
      return
          [&curve = found->second, axis](const Vec3& r) { return between(curve.time, curve.value, r[axis]); };
    });
  }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    const auto found = numbers_.find(quantity);
    return found == numbers_.end() ? std::nullopt : std::optional(found->second);
  }
  [[nodiscard]] std::optional<double> number_at(std::string_view quantity, double time) const override {
    if (quantity == "value" && in_time()) return known(between(curve().time, curve().value, time));
    const auto field =
        in_time() ? file_.curves.end() : file_.curves.find(field_of_probe(quantity, measuring_));
    if (field == file_.curves.end()) return number(quantity);
    const auto& point = measuring_.point;
    return point ? known(between(field->second.time, field->second.value,
                                 (*point)[static_cast<std::size_t>(file_.first[0] - 'x')]))
                 : std::nullopt;
  }
  [[nodiscard]] std::optional<double> uncertainty(std::string_view quantity, double time) const override {
    if (in_time()) return known(between(curve().time, curve().uncertainty, time));
    double most = 0.0;
    for (const auto& [name, curve] : file_.curves) {
      if (!quantity.starts_with(name.substr(0, name.find('_'))) && quantity.find(name) == quantity.npos)
        continue;
      most = std::max(most, *std::max_element(curve.uncertainty.begin(), curve.uncertainty.end()));
    }
    return most;
  }
  [[nodiscard]] const MeasuredCurve* measured(std::string_view column) const override {
    const auto found = file_.curves.find(std::string(column));
    return found == file_.curves.end() ? nullptr : &found->second;
  }

 private:
  [[nodiscard]] bool in_time() const { return file_.first == "time"; }
  [[nodiscard]] const MeasuredCurve& curve() const { return file_.curves.at(column_); }
  [[nodiscard]] static std::optional<double> known(double value) {
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
  }
  Numbers numbers_;
  Measuring measuring_;
  ExperimentFile file_;
  std::string column_;
};

/// The column that a number in time is read from: as the case says, else the only one.
std::string column_of(const ReferenceInput& in, const ExperimentFile& file) {
  std::vector<std::string> known;
  for (const auto& [name, curve] : file.curves) known.push_back(name);
  const auto named = in.args.word("column");
  if (named && !file.curves.count(*named))
    throw InputError(in.file + ": argument `column` of reference function table: the table has no column `" +
                     printable(*named) + "`" + suggestion(*named, known));
  if (named || known.size() == 1) return named.value_or(known.front());
  throw InputError(
      in.file +
      ": the table has several columns: name one by the argument `column` of reference function table");
}

std::unique_ptr<Reference> make_table(const ReferenceInput& in) {
  if (in.file.empty())
    throw InputError("reference function table needs the key `file`: the table beside the case");
  ExperimentFile file = read_table(in.file);
  if (file.first == "time") {
    auto column = column_of(in, file);
    return std::make_unique<Table>(stated_numbers(in, "table"), stated_measuring(in, "table"),
                                   std::move(file), std::move(column));
  }
  if (in.args.word("column"))
    throw InputError("argument `column` of reference function table is of a table in time: a table along " +
                     file.first + " names its fields itself");
  std::vector<std::string> fields;
  for (const auto& f : truth_fields())
    if (f.name != "value") fields.push_back(f.name);
  for (const auto& [name, curve] : file.curves)
    if (std::find(fields.begin(), fields.end(), name) == fields.end())
      throw InputError(in.file + ": no field is named `" + printable(name) + "`" + suggestion(name, fields));
  return std::make_unique<Table>(stated_numbers(in, "table"), stated_measuring(in, "table"), std::move(file),
                                 "");
}

}  // namespace

ReferenceEntry table_entry() {
  std::vector<ReferenceArgument> args{
      {"column", "",
       "of a table in time: the column that the quantity is compared with; default the only one",
       ArgumentType::word}};
  for (const auto& a : measuring_arguments()) args.push_back(a);
  return {{"table", "analytic", "the source that the file states",
           "values from the csv file beside the case (key `file`), with straight lines between rows. Its "
           "first column is time, "
           "x, y or z. It states source, units, uncertainty and hash",
           args},
          make_table};
}

}  // namespace tripoint
