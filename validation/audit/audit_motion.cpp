// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "scene/shared_terms.hpp"
#include "validation/audit/audit_rates.hpp"

namespace tripoint {
namespace {

constexpr Vec3 nowhere{not_a_number, not_a_number, not_a_number};

/// Places and velocities of one thing in all frames, NaN where it is not there.
struct Track {
  std::vector<Vec3> position, velocity;
};

/// How far an interval's way is from what the velocities say, and how far it may be [m/s].
struct WayDifference {
  double found = 0.0, allowed = 0.0;
};

/// What is left of a difference when as much of a lag is taken off as fits.
Vec3 without_lag(const Vec3& off, const Vec3& lag) {
  const double square = dot(lag, lag);
  return square > 0.0 ? off - std::clamp(dot(off, lag) / square, -1.0, 1.0) * lag : off;
}

WayDifference way_difference(const Audited& run, const Track& track, std::size_t n, const Contact& contact) {
  const Rates v = rates_at(track.velocity, n);
  const Vec3 &from = track.position[n], &to = track.position[n + 1];
  if (!v.known() || !finite(from) || !finite(to)) return {};
  const double time = run.frames[n + 1]->time - run.frames[n]->time, size = std::max(norm(from), norm(to));
  const Vec3 off = (1.0 / time) * displacement(run.job.scene, to, from + time * v.mean());
  return {norm(without_lag(off, largest_lag(run, v, time))),
          allowed_difference(v, contact.touches) +
              rounding_rate(run, size, 1e-6 * run.job.scene.spacing, time) + contact.hidden_speed};
}

std::string reported(const Audited& run, const std::string& name, std::size_t n, const WayDifference& d) {
  return "contradicts itself: " + name + " moves otherwise than its velocity says" +
         between(*run.frames[n], *run.frames[n + 1]) + ": by " + figure(d.found) + " m/s, where " +
         figure(d.allowed) + " m/s may be";
}

/// Whether the particle is of a rigid body whose row is looked at in its place.
bool has_row(const Audited& run, std::size_t particle) {
  const auto* body = body_of(run, particle);
  return body && body->phase == Phase::rigid && body->index >= 0 && !run.frames.front()->bodies.empty() &&
         keeps_bodies(run.job);
}

/// The transport velocity, or the shift of liquid that carries its density, moves liquid otherwise than its
/// velocity.
bool is_carried(const Audited& run, std::size_t particle) {
  const auto* body = body_of(run, particle);
  const Scene& scene = run.job.scene;
  return (scene.transport_velocity || scene.has_brought_form(term::pressure)) &&
         (!body || body->phase == Phase::liquid);
}

Track track_of_particle(const Audited& run, std::size_t i) {
  Track track;
  for (const auto* s : run.frames) {
    const bool there = i < s->position.size() && i < s->velocity.size() && !dead(*s, i);
    track.position.push_back(there ? s->position[i] : nowhere);
    track.velocity.push_back(there ? s->velocity[i] : nowhere);
  }
  return track;
}

double fastest(const Snapshot& s) {
  double most = 0.0;
  for (std::size_t i = 0; i < s.velocity.size(); ++i)
    if (!dead(s, i)) most = std::max(most, norm(s.velocity[i]));
  for (const BodyState& b : s.bodies)
    if (is_there(b)) most = std::max(most, norm(b.velocity));
  return most;
}

/// What the particles of all bodies share.
struct Intervals {
  std::vector<char> interrupted;  ///< by an event
  std::vector<double> fastest;    ///< largest speed at their ends [m/s]
  double hidden_speed = 0.0;      ///< that gravity gives and walls take again, in the longest of them [m/s]
};

/// What freezes or melts may change its velocity at once.
bool is_heated(const Job& job, const Snapshot& a, const Snapshot& b) {
  return std::any_of(job.scene.events.begin(), job.scene.events.end(), [&](const Event& e) {
    return e.kind == Event::Kind::heat && e.time <= b.time && e.until.value_or(job.scene.end_time) >= a.time;
  });
}

Intervals intervals_of(const Audited& run) {
  Intervals all;
  for (std::size_t n = 0; n + 1 < run.frames.size(); ++n) {
    const Snapshot &a = *run.frames[n], &b = *run.frames[n + 1];
    all.interrupted.push_back(is_interrupted(run.job, a, b) || is_heated(run.job, a, b) ? 1 : 0);
    all.fastest.push_back(std::max(fastest(a), fastest(b)));
    all.hidden_speed = std::max(all.hidden_speed, 0.25 * norm(run.job.scene.gravity) * (b.time - a.time));
  }
  return all;
}

double greatest_speed(const Track& track) {
  double most = 0.0;
  for (const Vec3& v : track.velocity)
    if (finite(v)) most = std::max(most, norm(v));
  return most;
}

/// Sums of squares over the particles of one body in each interval.
struct Squares {
  std::vector<double> found, allowed;
  double speed = 0.0;  ///< of each particle's largest in the run
};

/// Elastic matter vibrates faster than frames show: as a share of its speed.
constexpr double vibrates = 1e-2;

/// One particle among many may be thrown between two frames; all of a body together may not. So one has three
/// times the tolerance, and the largest speed of all.
std::string particle_contradicts(const Audited& run, std::size_t i, const Intervals& intervals,
                                 Squares& sums) {
  const Track track = track_of_particle(run, i);
  sums.speed += greatest_speed(track) * greatest_speed(track);
  for (std::size_t n = 0; n + 1 < run.frames.size(); ++n) {
    if (intervals.interrupted[n] != 0) continue;
    WayDifference d = way_difference(run, track, n, {true, intervals.hidden_speed});
    sums.found[n] += d.found * d.found;
    sums.allowed[n] += d.allowed * d.allowed;
    d.allowed = 3.0 * d.allowed + intervals.fastest[n];
    if (d.found > d.allowed) return reported(run, "particle " + std::to_string(i), n, d);
  }
  return {};
}

/// Matter may vibrate faster than frames show. What it is allowed in its roughest interval it is allowed in
/// all.
std::string mean_contradicts(const Audited& run, const JobBody& body, const Squares& sums) {
  const std::string& name = body.name;
  const double vibration = body.phase == Phase::elastic ? vibrates * vibrates * sums.speed : 0.0;
  const double allowed = vibration + *std::max_element(sums.allowed.begin(), sums.allowed.end());
  for (std::size_t n = 0; n < sums.found.size(); ++n)
    if (sums.found[n] > allowed)
      return reported(run, "the matter of `" + name + "`", n, {std::sqrt(sums.found[n]), std::sqrt(allowed)});
  return {};
}

std::string particles_contradict(const Audited& run) {
  const Intervals intervals = intervals_of(run);
  const std::vector<double> none(run.frames.size() - 1);
  std::vector<Squares> sums(run.job.bodies.size() + 1, {none, none, 0.0});
  for (std::size_t i = 0; i < run.frames.back()->velocity.size(); ++i) {
    if (has_row(run, i) || is_carried(run, i)) continue;
    const auto* body = body_of(run, i);
    const auto row = body ? static_cast<std::size_t>(body - run.job.bodies.data()) : run.job.bodies.size();
    if (auto why = particle_contradicts(run, i, intervals, sums[row]); !why.empty()) return why;
  }
  for (std::size_t b = 0; b < run.job.bodies.size(); ++b)
    if (auto why = mean_contradicts(run, run.job.bodies[b], sums[b]); !why.empty()) return why;
  return {};
}

/// A frame in which a body is another one than before has no track: it has united, parted, or was not born.
Track track_of_row(const Audited& run, std::size_t row) {
  Track track;
  for (const auto* s : run.frames) {
    const bool there = row < s->bodies.size() && is_there(s->bodies[row]);
    track.position.push_back(there ? s->bodies[row].position : nowhere);
    track.velocity.push_back(there ? s->bodies[row].velocity : nowhere);
  }
  return track;
}

bool same_mass(const Audited& run, std::size_t row, std::size_t n) {
  const auto &a = run.frames[n]->bodies, &b = run.frames[n + 1]->bodies;
  return row < a.size() && row < b.size() && std::abs(a[row].mass - b[row].mass) <= 1e-9 * a[row].mass;
}

/// Contact of a row. One that is no body of the start has come of others, which may be near it.
Contact contact_of_row(const Audited& run, std::size_t row, std::size_t n) {
  for (std::size_t b = 0; b < run.job.bodies.size(); ++b)
    if (run.job.bodies[b].index == static_cast<int>(row) && keeps_bodies(run.job))
      return contact_of(run, b, n);
  return {true, fastest(*run.frames[n]) + fastest(*run.frames[n + 1])};
}

/// Whether a keyframe within the interval gives the body another velocity, which no frame shows.
bool is_led_otherwise(const Audited& run, std::size_t row, std::size_t n) {
  return std::any_of(run.job.bodies.begin(), run.job.bodies.end(), [&](const JobBody& b) {
    return b.index == static_cast<int>(row) &&
           std::any_of(b.keyframes.begin(), b.keyframes.end(), [&](const Keyframe& k) {
             return k.time >= run.frames[n]->time && k.time <= run.frames[n + 1]->time;
           });
  });
}

/// An engine may push a body out of another by places alone, which no velocity shows: as a share of its speed
/// before a hit.
constexpr double pushed_out = 1e-3;

/// A body may bounce between two frames, to and fro at the speed that it has about them.
double speed_about(const Track& track, std::size_t n) {
  double most = 0.0;
  for (std::size_t k = n > 0 ? n - 1 : n; k < std::min(n + 3, track.velocity.size()); ++k)
    if (finite(track.velocity[k])) most = std::max(most, norm(track.velocity[k]));
  return most;
}

/// What slides, rolls or lies has the speed that its frames show. A body that came of others is not followed.
bool is_hit_about(const Audited& run, std::size_t row, std::size_t n) {
  const auto& bodies = run.job.bodies;
  const auto body = std::ranges::find(bodies, static_cast<int>(row), &JobBody::index);
  if (body == bodies.end() || !is_followed(run, *body)) return true;
  for (std::size_t k = n > 0 ? n - 1 : n; k < std::min(n + 2, run.frames.size() - 1); ++k)
    if (is_hit(run, *body, k)) return true;
  return false;
}

/// What pushes the body of a row out of others; none of a row that is not followed.
std::optional<PushOut> push_out_of(const Audited& run, std::size_t row) {
  const auto& bodies = run.job.bodies;
  const auto body = std::ranges::find(bodies, static_cast<int>(row), &JobBody::index);
  if (body == bodies.end() || !keeps_bodies(run.job) || !is_followed(run, *body)) return {};
  return PushOut(run, static_cast<std::size_t>(body - bodies.begin()));
}

std::string bodies_contradict(const Audited& run) {
  for (std::size_t row = 0; row < run.frames.back()->bodies.size(); ++row) {
    const Track track = track_of_row(run, row);
    auto push_out = push_out_of(run, row);
    for (std::size_t n = 0; n + 1 < run.frames.size(); ++n) {
      if (push_out) push_out->enter(n);
      if (is_interrupted(run.job, *run.frames[n], *run.frames[n + 1]) || is_led_otherwise(run, row, n) ||
          !same_mass(run, row, n))
        continue;
      if (const auto free = way_difference(run, track, n, {}); free.found <= free.allowed) continue;
      const Contact contact = contact_of_row(run, row, n);
      auto d = way_difference(run, track, n, contact);
      if (contact.touches)
        d.allowed +=
            pushed_out * greatest_speed(track) + (is_hit_about(run, row, n) ? speed_about(track, n) : 0.0);
      const double time = run.frames[n + 1]->time - run.frames[n]->time;
      if (d.found > d.allowed && !(push_out && push_out->allows(n, (d.found - d.allowed) * time)))
        return reported(run, row_name(run, row), n, d);
    }
  }
  return {};
}

}  // namespace

std::string moves_against_its_velocity(const Audited& run) {
  if (run.frames.size() < 2) return {};
  if (auto why = bodies_contradict(run); !why.empty()) return why;
  return particles_contradict(run);
}

}  // namespace tripoint
