// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "validation/references/reference.hpp"

/// Truths that a case states as fields of place, by the names of their columns: temperature, pressure,
/// density, velocity_x, velocity_y, velocity_z.
namespace tripoint {

/// Arguments of a case: the fields, and `value`, a number in time.
[[nodiscard]] std::vector<ReferenceArgument> truth_fields();

/// Column of the field that a probe reads ("temperature_at", "velocity_at" along the stated axis); empty for
/// any other quantity.
[[nodiscard]] std::string field_of_probe(std::string_view quantity, const Measuring&);

/// The truth of a frame where its particles are. @param field gives a column's function of place, or nothing
/// where it is not known
using FieldOf = std::function<std::function<double(const Vec3&)>(const std::string& column)>;
[[nodiscard]] Snapshot truth_of_fields(const Snapshot& now, const FieldOf& field);

}  // namespace tripoint
