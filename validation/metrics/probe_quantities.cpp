// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <Eigen/Dense>

#include "validation/metrics/members.hpp"
#include "validation/references/measuring.hpp"

/// Numbers at a point and means over a region, from the particles that any engine shows.
namespace tripoint {
namespace {

constexpr double probe_reach = 2.5;  ///< particles that a probe sees [spacings]

/// A scalar of every particle in a frame, or why there is none.
struct Column {
  std::vector<double> value;
  std::string problem;
};

enum class Of { temperature, pressure, density, velocity };

Column column_of(const MetricInput& in, const Snapshot& s, Of what) {
  const auto given = [&](const std::vector<double>& column, const char* name) {
    return column.size() == s.position.size() ? Column{column, ""}
                                              : Column{{}, std::string("the trajectory has no ") + name};
  };
  if (what == Of::temperature) return given(s.temperature, "temperature");
  if (what == Of::pressure) return given(s.pressure, "pressure");
  if (what == Of::density) return given(s.density, "density");
  const auto axis = in.reference.measuring().axis;
  if (!axis)
    return {{},
            "a component of velocity needs its axis: reference = {function = \"stated\", args = {axis = "
            "\"x\", ...}}"};
  if (s.velocity.size() != s.position.size()) return {{}, "the trajectory has no velocity"};
  Column out;
  for (const Vec3& v : s.velocity) out.value.push_back(v[*axis]);
  return out;
}

bool counts(const MetricInput& in, const Snapshot& s, std::size_t i) {
  return takes(in, i) && is_alive(s, i) && (s.phase.empty() || of_stated_phase(in, s, i));
}

/// Value and slope of a scalar at a point, by least squares over the particles near it. They are exact where
/// the scalar is linear, also beside a surface.
Column at_point(const MetricInput& in, const std::vector<Vec3>& place,
                const std::vector<std::size_t>& particles, const std::vector<double>& value,
                const Vec3& point) {
  const double reach = probe_reach * in.job.scene.spacing;
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  std::size_t seen = 0;
  for (const auto i : particles) {
    const Vec3 d = (1.0 / in.job.scene.spacing) * displacement(in.job.scene, place[i], point);
    const double q = norm(d) / probe_reach;
    if (!(q < 1.0)) continue;
    if (!std::isfinite(value[i]))
      return {{}, "particle " + std::to_string(i) + " beside the probe has no finite value"};
    const double w = (1.0 - q) * (1.0 - q) * (1.0 + 2.0 * q);
    const Eigen::Vector4d basis(1.0, d.x, d.y, d.z);
    A += w * basis * basis.transpose();
    b += w * value[i] * basis;
    ++seen;
  }
  if (seen == 0)
    return {
        {},
        "no particle that the metric takes lies within " + std::to_string(reach) + " m of the probe's point"};
  // directions in which all that is seen lies in one layer have no slope: the least solution leaves it out
  const Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix4d> solver(A);
  return {{solver.solve(b)[0]}, ""};
}

/// A number read off the run, less the value of the reference. Without such a value, less the same number
/// read off the true field at the run's places.
template <class Read>
FrameError against_stated_or_field(const FramePair& f, const char* quantity, Read read) {
  const Column measured = read(f.now);
  if (!measured.problem.empty()) return problem(measured.problem);
  if (truth_of(f.in, quantity, f.now.time)) return against_truth(f, quantity, measured.value[0]);
  Snapshot truth = f.truth;
  truth.position = f.now.position;
  const Column known = read(truth);
  return known.problem.empty()
             ? single(measured.value[0] - known.value[0])
             : problem(std::string("the reference does not know the ") + quantity + " and states no value");
}

FrameError probe(const FramePair& f, Of what, const char* quantity) {
  const auto point = f.in.reference.measuring().point;
  if (!point)
    return problem(std::string(quantity) +
                   " needs the probe's place: reference = {function = \"stated\", args = {point = [x, y, z], "
                   "value = ...}}");
  std::vector<std::size_t> particles;
  for (std::size_t i = 0; i < f.now.position.size(); ++i)
    if (counts(f.in, f.now, i)) particles.push_back(i);
  const auto read = [&](const Snapshot& s) {
    const Column column = column_of(f.in, s, what);
    return column.problem.empty() ? at_point(f.in, f.now.position, particles, column.value, *point) : column;
  };
  return against_stated_or_field(f, quantity, read);
}

// --- means

/// Whether a place is in the stated box; everywhere is where none is stated.
bool in_region(const MetricInput& in, const Vec3& r) {
  const auto measuring = in.reference.measuring();
  if (!measuring.box) return true;
  return in_box(in.job.scene, r, measuring.box->low, measuring.box->high) != measuring.outside;
}

FrameError mean(const FramePair& f, Of what, const char* quantity) {
  std::vector<std::size_t> particles;
  for (std::size_t i = 0; i < f.now.position.size(); ++i)
    if (counts(f.in, f.now, i) && in_region(f.in, f.now.position[i])) particles.push_back(i);
  if (particles.empty())
    return problem(std::string("no particle that the metric takes lies in the region of ") + quantity);
  const auto read = [&](const Snapshot& s) -> Column {
    Column column = column_of(f.in, s, what);
    if (!column.problem.empty()) return column;
    long double sum = 0, volume = 0;
    for (const auto i : particles) {
      if (!std::isfinite(column.value[i]))
        return {{}, "particle " + std::to_string(i) + " of the region has no finite value"};
      const long double v = i < f.in.initial.size() ? rest_volume(f.in, i) : particle_mass(f.in, f.now, i);
      sum += v * column.value[i];
      volume += v;
    }
    return {{double(sum / volume)}, ""};
  };
  return against_stated_or_field(f, quantity, read);
}

/// The greatest value there times `sign`, as it is: -1 finds the least one.
FrameError extreme(const FramePair& f, Of what, const char* quantity, double sign) {
  const auto read = [&](const Snapshot& s) -> Column {
    Column column = column_of(f.in, s, what);
    if (!column.problem.empty()) return column;
    double most = -INFINITY;
    for (std::size_t i = 0; i < f.now.position.size(); ++i) {
      if (!counts(f.in, f.now, i) || !in_region(f.in, f.now.position[i])) continue;
      if (!std::isfinite(column.value[i]))
        return {{}, "particle " + std::to_string(i) + " of the region has no finite value"};
      most = std::max(most, sign * column.value[i]);
    }
    if (!std::isfinite(most))
      return {{}, std::string("no particle that the metric takes lies in the region of ") + quantity};
    return {{sign * most}, ""};
  };
  return against_stated_or_field(f, quantity, read);
}

/// Depth of liquid in an upright column at the stated point: volume by area. The column's weight falls to 0
/// at two spacings to each side, so that a lattice has its own depth wherever the point lies. In two
/// dimensions the column is as deep along y as the layer.
FrameError depth_at(const FramePair& f) {
  const auto point = f.in.reference.measuring().point;
  if (!point)
    return problem(
        "depth_at needs the place of its gauge: reference = {function = \"stated\", args = {point = "
        "[x, y, z], value = ...}}");
  const double reach = 2.0 * f.in.job.scene.spacing;
  const bool plane = f.in.job.scene.space() == Dimensions::two;
  long double volume = 0;
  for (std::size_t i = 0; i < f.now.position.size(); ++i) {
    if (!takes(f.in, i) || !is_alive(f.now, i) || f.now.phase[i] != static_cast<int>(Phase::liquid)) continue;
    const Vec3 d = displacement(f.in.job.scene, f.now.position[i], *point);
    const double weight = std::max(0.0, 1.0 - std::abs(d.x) / reach) *
                          (plane ? 1.0 : std::max(0.0, 1.0 - std::abs(d.y) / reach));
    if (weight > 0.0) volume += weight * (i < f.in.initial.size() ? rest_volume(f.in, i) : 0.0);
  }
  return against_truth(f, "depth_at", double(volume) / (reach * (plane ? layer_depth : reach)));
}

// --- places

/// Way of a point of matter since the start, along the stated axis: read from the particles that began around
/// it.
FrameError displacement_of_point(const FramePair& f) {
  const auto point = f.in.reference.measuring().point;
  const auto axis = f.in.reference.measuring().axis;
  if (!point || !axis)
    return problem(
        "displacement needs a place at the start and an axis: reference = {function = \"stated\", args = "
        "{point = [x, y, z], "
        "axis = \"x\", value = ...}}");
  const std::size_t along = *axis;
  std::vector<std::size_t> particles;
  std::vector<double> way(f.in.initial.size(), 0.0);
  for (std::size_t i = 0; i < f.in.initial.size(); ++i) {
    if (!counts(f.in, f.now, i)) continue;
    particles.push_back(i);
    way[i] = displacement(f.in.job.scene, f.now.position[i], f.in.initial.position[i])[along];
  }
  const Column measured = at_point(f.in, f.in.initial.position, particles, way, *point);
  return measured.problem.empty() ? against_truth(f, "displacement", measured.value[0])
                                  : problem(measured.problem);
}

FrameError centre(const FramePair& f) {
  const auto axis = f.in.reference.measuring().axis;
  if (!axis)
    return problem(
        "centre needs an axis: reference = {function = \"stated\", args = {axis = \"z\", value = ...}}");
  long double sum = 0, mass = 0;
  for (std::size_t i = 0; i < f.now.position.size(); ++i) {
    if (!counts(f.in, f.now, i)) continue;
    const long double m = particle_mass(f.in, f.now, i);
    sum += m * f.now.position[i][*axis];
    mass += m;
  }
  if (!(mass > 0)) return problem("the metric takes no particle that is alive");
  return against_truth(f, "centre", double(sum / mass));
}

}  // namespace

const std::vector<Quantity>& probe_quantities() {
  const auto at = [](const char* name, const char* unit, const char* meaning, Of what) {
    return Quantity{{name, unit, meaning}, [=](const FramePair& f) { return probe(f, what, name); }};
  };
  const auto over = [](const char* name, const char* unit, const char* meaning, Of what) {
    return Quantity{{name, unit, meaning}, [=](const FramePair& f) { return mean(f, what, name); }};
  };
  const auto end = [](const char* name, const char* unit, const char* meaning, Of what, double sign) {
    return Quantity{{name, unit, meaning}, [=](const FramePair& f) { return extreme(f, what, name, sign); }};
  };
  static const std::vector<Quantity> list{
      at("temperature_at", "K",
         "temperature at the stated point, by a linear fit to particles within 2.5 spacings, minus the true "
         "one",
         Of::temperature),
      at("pressure_at", "Pa", "pressure at the stated point, by the same fit, minus the true one",
         Of::pressure),
      at("density_at", "kg/m3", "density at the stated point, by the same fit, minus the true one",
         Of::density),
      at("velocity_at", "m/s",
         "component of velocity along the stated axis at the stated point, by the same fit, minus the true "
         "one",
         Of::velocity),
      over("mean_temperature", "K",
           "mean temperature by volume (of the body, phase or box), minus the stated value or the true mean",
           Of::temperature),
      over("mean_pressure", "Pa", "mean pressure there, minus the true one", Of::pressure),
      over("mean_density", "kg/m3", "mean density there, minus the true one", Of::density),
      over("mean_velocity", "m/s",
           "mean component of velocity along the stated axis there, minus the true one", Of::velocity),
      end("greatest_temperature", "K", "greatest temperature there, minus the true one", Of::temperature,
          1.0),
      end("least_temperature", "K", "least temperature there, minus the true one", Of::temperature, -1.0),
      end("greatest_pressure", "Pa", "greatest pressure there, minus the true one", Of::pressure, 1.0),
      end("least_pressure", "Pa", "least pressure there, minus the true one", Of::pressure, -1.0),
      {{"depth_at", "m",
        "depth of liquid at x and y of the stated point: volume over area of an upright column, minus the "
        "true "
        "one"},
       depth_at},
      {{"displacement", "m",
        "displacement along the stated axis of the matter that began at the stated point, minus the true "
        "one"},
       displacement_of_point},
      {{"centre", "m",
        "place of the centre of mass of the body (or all, or a phase) along the stated axis, minus the true "
        "one"},
       centre}};
  return list;
}

}  // namespace tripoint
