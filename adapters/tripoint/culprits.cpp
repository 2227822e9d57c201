// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <type_traits>

#include "adapters/tripoint/tripoint_engine.hpp"

namespace tripoint {
namespace {

/// Where a particle is, or was when it was listed last, or nowhere: then at the origin.
Vec3 place_of(const State& state, std::size_t row) {
  const Vec3 now = state.particles.position(row);
  if (finite(now)) return now;
  if (state.neighbours && row < state.neighbours->build_positions().size()) {
    const Vec3 then = state.neighbours->build_positions()[row];
    if (finite(then)) return then;
  }
  return {};
}

Vec3 between(const State& state, Vec3 d) {
  for (std::size_t a = 0; a < 3; ++a)
    if (state.box.periodic[a]) d[a] -= state.box.width[a] * std::round(d[a] / state.box.width[a]);
  return d;
}

/// The culprit first, then those around it in order of id.
std::vector<std::size_t> rows_around(const State& state, long culprit) {
  const Particles& p = state.particles;
  std::vector<std::size_t> rows;
  const bool any = culprit < 0 || static_cast<std::size_t>(culprit) >= p.size();
  const std::size_t centre = any ? 0 : p.row(static_cast<std::size_t>(culprit));
  if (!any) rows.push_back(centre);
  for (std::size_t id = 0; id < p.size(); ++id) {
    const std::size_t row = p.row(id);
    if (any || (row != centre &&
                norm(between(state, place_of(state, row) - place_of(state, centre))) < 2.0 * state.support()))
      rows.push_back(row);
  }
  return rows;
}

}  // namespace

PointCloud culprits_of(const State& state, const Diverged& failure) {
  const std::vector<std::size_t> rows = rows_around(state, failure.particle);
  PointCloud cloud;
  cloud.numbers = {{"time [s]", failure.time},
                   {"particle", static_cast<double>(failure.particle)},
                   {"body", static_cast<double>(failure.body)}};
  PointCloud::Array culprit{"culprit", 1, {}}, listed{"place is where it was listed last", 1, {}};
  for (const std::size_t row : rows) {
    cloud.place.push_back(place_of(state, row));
    culprit.values.push_back(state.particles[field::id][row] == failure.particle ? 1.0 : 0.0);
    listed.values.push_back(finite(state.particles.position(row)) ? 0.0 : 1.0);
  }
  cloud.arrays = {culprit, listed};
  const auto v = velocities(state.particles);
  PointCloud::Array velocity{"velocity [m/s]", 3, {}};
  for (const std::size_t row : rows)
    for (std::size_t a = 0; a < 3; ++a) velocity.values.push_back(v.at(row)[a]);
  cloud.arrays.push_back(std::move(velocity));
  state.particles.for_each([&]<class T>(const FieldInfo& field, std::span<const T> values) {
    if constexpr (std::is_arithmetic_v<T>) {
      PointCloud::Array column{std::string(field.name) + " [" + std::string(field.unit) + "]", 1, {}};
      for (const std::size_t row : rows) column.values.push_back(static_cast<double>(values[row]));
      cloud.arrays.push_back(std::move(column));
    }
  });
  return cloud;
}

}  // namespace tripoint
