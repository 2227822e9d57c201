// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/rigid_flight.hpp"

#include <algorithm>

#include "tables/nearest.hpp"
#include "validation/references/prescribed.hpp"
#include "validation/references/region.hpp"

namespace tripoint {
namespace {

BodyState no_body() {
  const Vec3 none{not_a_number, not_a_number, not_a_number};
  return {none,         none, none, {not_a_number, not_a_number, not_a_number, not_a_number},
          not_a_number, none, none};
}

std::vector<std::size_t> members_of(const InitialState& initial, std::size_t body) {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < initial.size(); ++i)
    if (initial.source[i] == static_cast<int>(body)) list.push_back(i);
  return list;
}

void refuse_what_is_not_free(const Job& job) {
  for (const auto& body : job.bodies)
    if (body.phase != Phase::rigid)
      throw InputError("body `" + body.name + "` is not rigid: free flight is exact for rigid bodies only");
  for (const auto& body : job.scene.bodies)
    if (!body.joined_to.empty()) throw InputError(body.place, "a joined body has no exact free flight");
  for (const auto& event : job.scene.events)
    if (event.kind != Event::Kind::merge && event.kind != Event::Kind::split)
      throw InputError(event.place, "free flight is exact with merge and split events only");
  if (!job.scene.inflows.empty()) throw InputError("a scene with an inflow has no exact free flight");
  for (const auto& force : job.scene.forces) {
    if (force.has_no_potential())
      throw InputError(force.place,
                       "free flight is exact with constant forces only: leave torque, start and stop out");
    if (force.point)
      throw InputError(force.place,
                       "free flight is exact with forces at the centre of mass only: leave `place` out");
  }
}

}  // namespace

RigidFlight::RigidFlight(const Job& job, const InitialState& initial) : job_(job), initial_(initial) {
  refuse_what_is_not_free(job_);
  start();
  auto events = job_.scene.events;
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.time < b.time; });
  if (events.empty()) return;
  const double before = kinetic_energy_at(events.front().time);
  for (const auto& event : events) event.kind == Event::Kind::merge ? merge(event) : split(event);
  energy_ratio_ = kinetic_energy_at(events.back().time) / before;
}

void RigidFlight::start() {
  Snapshot now;
  now.position = initial_.position;
  now.velocity.resize(initial_.size());
  for (std::size_t b = 0; b < job_.bodies.size(); ++b) {
    const auto& body = job_.bodies[b];
    row_names_.push_back(body.name);
    row_birth_.push_back(0.0);
    const auto members = members_of(initial_, b);
    if (members.empty()) throw InputError("body `" + body.name + "` has no particles");
    if (body.motion != Motion::free) continue;
    const Vec3 centre = rigid_body(members, now.position, now.velocity, initial_.mass).centre;
    for (const auto i : members)
      now.velocity[i] = body.velocity + cross(body.angular_velocity, initial_.position[i] - centre);
    launch(members, now, body.index, {});
  }
}

void RigidFlight::launch(const std::vector<std::size_t>& members, const Snapshot& now, int row,
                         const Quaternion& orientation) {
  auto body = rigid_body(members, now.position, now.velocity, initial_.mass);
  TorqueFree spin(body.inertia, body.axes, body.angular_velocity);
  flights_.push_back({std::move(body), spin, orientation, row, now.time});
}

RigidFlight::Flight& RigidFlight::alive(const std::string& name) {
  const auto row = std::find(row_names_.begin(), row_names_.end(), name) - row_names_.begin();
  for (auto& flight : flights_)
    if (flight.row == row && flight.death == std::numeric_limits<double>::infinity()) return flight;
  throw InputError("an event names body `" + printable(name) + "`, which is not in free flight then" +
                   suggestion(name, row_names_));
}

void RigidFlight::merge(const Event& event) {
  const Snapshot now = at(event.time);
  if (event.bodies.size() < 2) throw InputError(event.place, "a merge needs two bodies or more");
  const int row = alive(event.bodies.front()).row;
  const Quaternion orientation = now.bodies[static_cast<std::size_t>(row)].orientation;
  std::vector<std::size_t> members;
  for (const auto& name : event.bodies) {
    auto& flight = alive(name);
    members.insert(members.end(), flight.body.members.begin(), flight.body.members.end());
    flight.death = event.time;
  }
  std::sort(members.begin(), members.end());
  launch(members, now, row, orientation);
}

void RigidFlight::split(const Event& event) {
  const Snapshot now = at(event.time);
  if (!event.region) throw InputError(event.place, "a split needs a region");
  std::vector<int> rows;
  for (const auto& name : event.bodies) rows.push_back(alive(name).row);
  std::vector<std::size_t> leaving;
  const auto count = flights_.size();
  for (std::size_t f = 0; f < count; ++f) {
    if (flights_[f].death < std::numeric_limits<double>::infinity()) continue;
    const int row = flights_[f].row;
    if (!rows.empty() && std::find(rows.begin(), rows.end(), row) == rows.end()) continue;
    std::vector<std::size_t> staying;
    for (const auto i : flights_[f].body.members)
      (inside(*event.region, now.position[i]) ? leaving : staying).push_back(i);
    if (staying.size() == flights_[f].body.members.size()) continue;
    flights_[f].death = event.time;
    if (!staying.empty()) launch(staying, now, row, now.bodies[static_cast<std::size_t>(row)].orientation);
  }
  if (leaving.empty()) throw InputError(event.place, "no particle is inside the region of the split");
  std::sort(leaving.begin(), leaving.end());
  launch(leaving, now, static_cast<int>(row_names_.size()), {});
  row_names_.push_back(event.name);
  row_birth_.push_back(event.time);
}

Vec3 RigidFlight::acceleration(const Flight& flight) const {
  Vec3 a = job_.scene.gravity;
  for (const AppliedForce& force : job_.scene.forces)
    if (force.body == row_names_.at(static_cast<std::size_t>(flight.row)))
      a += force.value / flight.body.mass;
  return a;
}

Vec3 RigidFlight::fall(const Flight& flight, double t) const {
  return t * flight.body.velocity + (0.5 * t * t) * acceleration(flight);
}

void RigidFlight::set_flight(const Flight& flight, double time, Snapshot& out) const {
  const double t = time - flight.birth;
  const Quaternion turn = flight.spin.rotation(t);
  BodyState state;
  state.position = flight.body.centre + fall(flight, t);
  state.velocity = flight.body.velocity + t * acceleration(flight);
  state.angular_velocity = flight.spin.angular_velocity(t);
  state.orientation = normalised(turn * flight.orientation);
  state.mass = flight.body.mass;
  out.bodies[static_cast<std::size_t>(flight.row)] = state;
  for (std::size_t n = 0; n < flight.body.members.size(); ++n) {
    const Vec3 arm = rotate(turn, flight.body.offset[n]);
    const auto i = flight.body.members[n];
    out.position[i] = state.position + arm;
    out.velocity[i] = state.velocity + cross(state.angular_velocity, arm);
    out.body[i] = flight.row;
  }
}

void RigidFlight::set_prescribed(const JobBody& body, double time, Snapshot& out) const {
  const BodyState state = prescribed_motion(body, time);
  out.bodies[static_cast<std::size_t>(body.index)] = state;
  for (const auto i : members_of(initial_, static_cast<std::size_t>(&body - job_.bodies.data()))) {
    const Vec3 arm = rotate(state.orientation, initial_.position[i] - body.properties.centre);
    out.position[i] = state.position + arm;
    out.velocity[i] = state.velocity + cross(state.angular_velocity, arm);
  }
}

Snapshot RigidFlight::at(double time) const {
  Snapshot out;
  out.time = time;
  out.position = initial_.position;
  out.velocity.resize(initial_.size());
  out.body = initial_.body;
  out.phase = initial_.phase;
  const auto rows =
      std::count_if(row_birth_.begin(), row_birth_.end(), [&](double birth) { return birth <= time; });
  out.bodies.assign(static_cast<std::size_t>(rows), no_body());
  for (const auto& body : job_.bodies)
    if (body.motion != Motion::free) set_prescribed(body, time, out);
  for (const auto& flight : flights_)
    if (flight.birth <= time && time < flight.death) set_flight(flight, time, out);
  return out;
}

double RigidFlight::kinetic_energy_at(double time) const {
  return kinetic_energy(at(time).velocity, initial_.mass);
}

std::optional<double> RigidFlight::number(std::string_view quantity) const {
  if (job_.scene.events.empty()) return {};
  if (quantity == "energy_ratio") return energy_ratio_;
  if (quantity == "event_time") {
    const auto& events = job_.scene.events;
    return std::min_element(events.begin(), events.end(),
                            [](const Event& a, const Event& b) { return a.time < b.time; })
        ->time;
  }
  return {};
}

}  // namespace tripoint
