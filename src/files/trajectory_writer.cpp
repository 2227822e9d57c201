// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "core/errors.hpp"
#include "files/h5md_file.hpp"
#include "files/trajectory.hpp"

namespace tripoint {
namespace {

constexpr std::size_t scalar = std::numeric_limits<std::size_t>::max();  // a dataset of frames only

void write_h5md_group(hid_t file) {
  h5::write_whole_attribute(h5::make_group(file, "h5md").get(), "version", {1, 1});
  h5::write_text_attribute(h5::make_group(file, "h5md/author").get(), "name", "tripoint");
  const h5::Handle creator = h5::make_group(file, "h5md/creator");
  h5::write_text_attribute(creator.get(), "name", "tripoint");
  h5::write_text_attribute(creator.get(), "version", "1");
  const h5::Handle units = h5::make_group(file, "h5md/modules/units");
  h5::write_whole_attribute(units.get(), "version", {1, 0});
  h5::write_text_attribute(units.get(), "system", "SI");
}

void write_box(hid_t file, const Domain& domain) {
  const h5::Handle box = h5::make_group(file, "particles/all/box");
  const int dimension = 3;
  const h5::Handle one(H5Screate(H5S_SCALAR), H5Sclose, "box");
  const h5::Handle attribute(
      H5Acreate2(box.get(), "dimension", H5T_NATIVE_INT, one.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
      "box");
  h5::check(H5Awrite(attribute.get(), H5T_NATIVE_INT, &dimension), "box");
  std::vector<std::string> boundary;
  for (const bool periodic : domain.periodic) boundary.emplace_back(periodic ? "periodic" : "none");
  h5::write_text_attribute(box.get(), "boundary", boundary);
}

/// Lengths of the domain's edges [m]; along a direction without bounds, those of all that is alive.
Vec3 edges_of(const Domain& domain, const std::vector<Vec3>& places) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Vec3 low{far, far, far}, high{-far, -far, -far};
  for (const Vec3& r : places) {
    if (!std::isfinite(r.x + r.y + r.z)) continue;
    low = {std::min(low.x, r.x), std::min(low.y, r.y), std::min(low.z, r.z)};
    high = {std::max(high.x, r.x), std::max(high.y, r.y), std::max(high.z, r.z)};
  }
  const Vec3 own = domain.max - domain.min, around = high - low;
  const auto edge = [](double bounded, double occupied) {
    return std::isfinite(bounded) ? bounded : std::max(occupied, 0.0);
  };
  return {edge(own.x, around.x), edge(own.y, around.y), edge(own.z, around.z)};
}

std::size_t expect(std::size_t rows, std::size_t n, const char* name) {
  if (rows != n)
    throw EngineError(std::string(name) + " has " + std::to_string(rows) + " rows for " + std::to_string(n) +
                      " particles");
  return n;
}

}  // namespace

/// One H5MD file being written: elements of shape value/step/time that share one step and one time dataset.
struct TrajectoryWriter::Impl {
  Impl(const std::string& name, const Domain& domain_of_scene)
      : path(name), file(h5::create_file(name)), domain(domain_of_scene) {
    write_h5md_group(file.get());
    write_box(file.get(), domain);
  }

  void put(const std::string& element, h5::Type type, std::size_t rows, std::size_t width,
           const std::string& unit, const void* data) {
    auto at = columns.find(element);
    if (at == columns.end()) {
      if (frames > 0) throw EngineError(path + ": " + element + " appears after the first frame");
      const h5::Handle group = h5::make_group(file.get(), element);
      link_time(group.get());  // before the column: the object that is made first is written last
      at = columns.emplace(element, h5::Column(group.get(), "value", type, rows, width, unit)).first;
    }
    at->second.append(static_cast<std::size_t>(frames), rows == scalar ? 1 : rows, data);
  }

  void link_time(hid_t group) {
    if (!time) {
      step.emplace(group, "step", h5::Type::int64, scalar, 0, "");
      time.emplace(group, "time", h5::Type::float64, scalar, 0, "s");
      return;
    }
    h5::check(H5Olink(step->id(), group, "step", H5P_DEFAULT, H5P_DEFAULT), "step");
    h5::check(H5Olink(time->id(), group, "time", H5P_DEFAULT, H5P_DEFAULT), "time");
  }

  void put_particles(const Snapshot& s);
  void put_bodies(const Snapshot& s);
  void put_observables(const Snapshot& s);

  std::string path;
  h5::Handle file;
  Domain domain;
  std::map<std::string, h5::Column> columns;
  std::optional<h5::Column> step, time;
  long frames = 0;
};

void TrajectoryWriter::Impl::put_particles(const Snapshot& s) {
  const std::size_t n = s.position.size();
  const auto real = [&](const char* name, const std::vector<double>& column, const char* unit) {
    if (!column.empty())
      put(std::string("particles/all/") + name, h5::Type::float64, expect(column.size(), n, name), 0, unit,
          column.data());
  };
  const auto whole = [&](const char* name, const std::vector<int>& column) {
    if (!column.empty())
      put(std::string("particles/all/") + name, h5::Type::int32, expect(column.size(), n, name), 0, "",
          column.data());
  };
  put("particles/all/position", h5::Type::float64, n, 3, "m", s.position.data());
  put("particles/all/velocity", h5::Type::float64, n, 3, "m s-1", s.velocity.data());
  real("mass", s.mass, "kg");
  real("temperature", s.temperature, "K");
  real("temperature_error", s.temperature_error, "K");
  real("density", s.density, "kg m-3");
  real("pressure", s.pressure, "Pa");
  real("liquid_fraction", s.liquid_fraction, "1");
  whole("id", s.id);
  whole("phase", s.phase);
  whole("body", s.body);
  whole("material", s.material);
  if (!domain.is_periodic()) return;
  const Vec3 edges = edges_of(domain, s.position);
  put("particles/all/box/edges", h5::Type::float64, 3, 0, "m", &edges);
}

void TrajectoryWriter::Impl::put_bodies(const Snapshot& s) {
  const std::size_t n = s.bodies.size();
  const auto vectors = [&](const char* name, const char* unit, Vec3 BodyState::*member) {
    std::vector<Vec3> column;
    for (const BodyState& b : s.bodies) column.push_back(b.*member);
    put(std::string("particles/bodies/") + name, h5::Type::float64, n, 3, unit, column.data());
  };
  vectors("position", "m", &BodyState::position);
  vectors("velocity", "m s-1", &BodyState::velocity);
  vectors("angular_velocity", "rad s-1", &BodyState::angular_velocity);
  vectors("force", "N", &BodyState::force);
  vectors("torque", "N m", &BodyState::torque);
  std::vector<Quaternion> orientation;
  std::vector<double> mass;
  for (const BodyState& b : s.bodies) {
    orientation.push_back(b.orientation);
    mass.push_back(b.mass);
  }
  static_assert(sizeof(Quaternion) == 4 * sizeof(double));
  put("particles/bodies/orientation", h5::Type::float64, n, 4, "1", orientation.data());
  put("particles/bodies/mass", h5::Type::float64, n, 0, "kg", mass.data());
}

void TrajectoryWriter::Impl::put_observables(const Snapshot& s) {
  put("observables/mass", h5::Type::float64, scalar, 0, "kg", &s.total_mass);
  put("observables/momentum", h5::Type::float64, 3, 0, "kg m s-1", &s.momentum);
  put("observables/angular_momentum", h5::Type::float64, 3, 0, "kg m2 s-1", &s.angular_momentum);
  for (const auto& [term, joule] : s.energy)
    put("observables/energy_" + term, h5::Type::float64, scalar, 0, "J", &joule);
  for (const auto& [body, joule] : s.heat_given)
    put("observables/heat_" + body, h5::Type::float64, scalar, 0, "J", &joule);
  for (const auto& [what, count] : s.counts)
    put("observables/count_" + what, h5::Type::float64, scalar, 0, "1", &count);
}

TrajectoryWriter::TrajectoryWriter(const std::string& path, const Domain& domain)
    : impl_(std::make_unique<Impl>(path, domain)) {}
TrajectoryWriter::~TrajectoryWriter() = default;

void TrajectoryWriter::append(const Snapshot& s) {
  impl_->put_particles(s);
  impl_->put_bodies(s);
  impl_->put_observables(s);
  const long long step = s.step;
  impl_->step->append(static_cast<std::size_t>(impl_->frames), 1, &step);
  // Last: a frame is there when its time is
  impl_->time->append(static_cast<std::size_t>(impl_->frames), 1, &s.time);
  h5::check(H5Fflush(impl_->file.get(), H5F_SCOPE_LOCAL), impl_->path);
  ++impl_->frames;
}

long TrajectoryWriter::frames() const { return impl_->frames; }

void TrajectoryWriter::close() {
  impl_->columns.clear();
  impl_->step.reset();
  impl_->time.reset();
  impl_->file.close(impl_->path);
}

}  // namespace tripoint
