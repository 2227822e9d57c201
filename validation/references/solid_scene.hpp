// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>

#include "validation/references/bar_law.hpp"
#include "validation/references/functions.hpp"

namespace tripoint {

/// Young's modulus and Poisson's ratio of a body's material. @throws InputError when it has none
struct ElasticConstants {
  double young = 0.0, poisson_ratio = 0.0;
  [[nodiscard]] double shear() const { return 0.5 * young / (1.0 + poisson_ratio); }
  [[nodiscard]] double bulk() const { return young / (3.0 * (1.0 - 2.0 * poisson_ratio)); }
};
[[nodiscard]] ElasticConstants elastic_constants(const Job&, std::size_t body);

/// Row in Job::bodies of the argument `body`, else of the scene's only free elastic body. @throws InputError
[[nodiscard]] std::size_t elastic_body(const ReferenceInput&, const char* function);

/// Row of the body that an argument names; empty when it is not given. @throws InputError for a name that the
/// job does not have
[[nodiscard]] std::optional<std::size_t> named_body(const ReferenceInput&, const char* argument);

/// A body's extents [m]: the domain's where it is periodic.
[[nodiscard]] std::array<double, 3> extents(const ReferenceInput&, std::size_t body);

/// The longest direction of a body that is not periodic.
[[nodiscard]] std::size_t long_axis(const ReferenceInput&, std::size_t body);

/// Support of the sides of a bar along an axis: the argument `sides`, else by how many of the other
/// directions are periodic.
[[nodiscard]] BarSides bar_sides(const ReferenceInput&, std::size_t axis);
/// The law of a bar of the body's material, in the form of the argument `form` or of the run's elastic term.
/// The printed law has the factors of the lattice at the argument `support_ratio` or the run's.
[[nodiscard]] BarLaw bar_law(const ReferenceInput&, std::size_t bar, std::size_t axis);

}  // namespace tripoint
