// SPDX-License-Identifier: BSD-3-Clause
#include "core/errors.hpp"
#include "files/h5md_file.hpp"
#include "files/trajectory.hpp"

namespace tripoint {

void write_particles(const std::string& path, const InitialState& s) {
  Snapshot frame;
  const std::size_t n = s.size();
  frame.position = s.position;
  frame.velocity = s.velocity;
  frame.temperature = s.temperature;
  frame.mass = s.mass;
  frame.phase = s.phase;
  frame.body = s.body;
  frame.material = s.material;
  for (std::size_t i = 0; i < n; ++i) {
    frame.id.push_back(static_cast<int>(i));
    frame.total_mass += s.mass[i];
    frame.momentum += s.mass[i] * s.velocity[i];
    frame.angular_momentum += s.mass[i] * cross(s.position[i], s.velocity[i]);
  }
  TrajectoryWriter writer(path);
  writer.append(frame);
  writer.close();

  h5::Handle file = h5::open_for_change(path);
  {  // a file closes after the objects in it
    const h5::Handle group = h5::make_group(file.get(), "particles/all/source");
    h5::Column column(group.get(), "value", h5::Type::int32, n, 0, "");
    column.append(0, n, s.source.data());
    h5::check(H5Fflush(file.get(), H5F_SCOPE_LOCAL), path);
  }
  file.close(path);
}

InitialState read_particles(const std::string& path) {
  Trajectory trajectory = read_trajectory(path);
  if (trajectory.frames.size() != 1) throw InputError(path + ": expected one frame, the particles at time 0");
  Snapshot& frame = trajectory.frames.front();
  for (std::size_t i = 0; i < frame.id.size(); ++i)
    if (frame.id[i] != static_cast<int>(i))
      throw InputError(path + ": row " + std::to_string(i) + " holds id " + std::to_string(frame.id[i]) +
                       "; rows must be ids");
  InitialState s;
  s.position = std::move(frame.position);
  s.velocity = std::move(frame.velocity);
  s.mass = std::move(frame.mass);
  s.temperature = std::move(frame.temperature);
  s.phase = std::move(frame.phase);
  s.body = std::move(frame.body);
  s.material = std::move(frame.material);
  const h5::Handle file = h5::open_for_reading(path);
  if (h5::has(file.get(), "/particles/all/source/value"))
    s.source = h5::read_whole(file.get(), "/particles/all/source/value", path).whole;
  const std::size_t n = s.position.size();
  if (s.velocity.size() != n || s.mass.size() != n || s.phase.size() != n || s.body.size() != n ||
      s.material.size() != n || s.source.size() != n)
    throw InputError(path + ": a column of mass, velocity, phase, body, material or source is missing");
  return s;
}

}  // namespace tripoint
