// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/quaternion.hpp"
#include "files/job.hpp"
#include "validation/references/contact_entries.hpp"
#include "validation/references/on_plane.hpp"

namespace tripoint {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();  // [s]
// Share of a size or a speed that is no rounding
constexpr double smallest = 1e-12;
constexpr std::size_t most_hits = 1000;

/// A free ball, or a fixed box: then of no inverse mass and inertia.
struct Thing {
  BodyState state;
  double radius = 0.0;                               ///< of a ball [m]
  double inverse_mass = 0.0, inverse_inertia = 0.0;  ///< [1/kg], [1/(kg m2)]
  Vec3 low, high;                                    ///< of a box [m]
  [[nodiscard]] bool ball() const { return radius > 0.0; }
};
struct Law {
  double friction = 0.0, restitution = 1.0;
};
/// Two things that touch after a time, and the unit vector from the first to the second.
struct Touch {
  double after = never;
  std::size_t a = 0, b = 0;
  Vec3 normal;
};

/// Time until two balls touch that approach each other by more than a speed [s].
double until_balls_touch(const Thing& a, const Thing& b, double slowest) {
  const Vec3 x = b.state.position - a.state.position, v = b.state.velocity - a.state.velocity;
  const double closing = -dot(x, v), reach = a.radius + b.radius, speed2 = dot(v, v);
  if (!(closing > slowest * norm(x))) return never;
  const double beside2 = dot(x, x) - closing * closing / speed2, under = reach * reach - beside2;
  return under > 0.0 ? std::max(0.0, (closing - std::sqrt(under * speed2)) / speed2) : never;
}

/// First touch of a ball with a face of a box; edges and corners are not known here.
Touch ball_on_box(const Thing& ball, const Thing& box, double slowest) {
  Touch first;
  for (std::size_t k = 0; k < 3; ++k)
    for (const double side : {-1.0, 1.0}) {
      const double closing = -side * ball.state.velocity[k], face = side > 0.0 ? box.high[k] : box.low[k];
      const double gap = side * (ball.state.position[k] - face) - ball.radius;
      if (!(closing > slowest) || gap < -smallest * ball.radius) continue;
      const double t = std::max(0.0, gap / closing);
      const Vec3 at = ball.state.position + t * ball.state.velocity;
      bool beside = false;
      for (std::size_t j = 0; j < 3; ++j)
        beside = beside || (j != k && (at[j] < box.low[j] || at[j] > box.high[j]));
      if (beside || t >= first.after) continue;
      first.after = t;
      first.normal = {};
      first.normal[k] = -side;
    }
  return first;
}

Touch next_touch(const std::vector<Thing>& things, double slowest) {
  Touch first;
  for (std::size_t a = 0; a < things.size(); ++a)
    for (std::size_t b = 0; b < things.size(); ++b) {
      if (a == b || !things[a].ball() || (things[b].ball() && b < a)) continue;
      Touch t;
      if (things[b].ball()) {
        t.after = until_balls_touch(things[a], things[b], slowest);
        const double span = t.after < never ? t.after : 0.0;
        const Vec3 x = things[b].state.position - things[a].state.position +
                       span * (things[b].state.velocity - things[a].state.velocity);
        t.normal = x / norm(x);
      } else {
        t = ball_on_box(things[a], things[b], slowest);
      }
      t.a = a;
      t.b = b;
      if (t.after < first.after) first = t;
    }
  return first;
}

void push(Thing& t, const Vec3& impulse, const Vec3& arm) {
  t.state.velocity += t.inverse_mass * impulse;
  t.state.angular_velocity += t.inverse_inertia * cross(arm, impulse);
}

/// Newton's restitution along the normal. Coulomb's friction across it: it ends the slip, or is mu times the
/// normal impulse.
void hit(Thing& a, Thing& b, const Vec3& normal, const Law& law) {
  const Vec3 arm_a = a.radius * normal, arm_b = -b.radius * normal;
  const Vec3 approach = a.state.velocity + cross(a.state.angular_velocity, arm_a) - b.state.velocity -
                        cross(b.state.angular_velocity, arm_b);
  const double closing = dot(approach, normal), inverse = a.inverse_mass + b.inverse_mass;
  const Vec3 slip = approach - closing * normal;
  const double normal_impulse = (1.0 + law.restitution) * closing / inverse;
  // Of a tangential impulse
  const double across =
      inverse + a.radius * a.radius * a.inverse_inertia + b.radius * b.radius * b.inverse_inertia;
  const double grip = std::min(norm(slip) / across, law.friction * normal_impulse);
  const Vec3 impulse = normal_impulse * normal + (norm(slip) > 0.0 ? grip / norm(slip) : 0.0) * slip;
  push(a, -impulse, arm_a);
  push(b, impulse, arm_b);
}

void fly(Thing& t, double span) {
  t.state.position += span * t.state.velocity;
  t.state.orientation =
      normalised(from_rotation_vector(span * t.state.angular_velocity) * t.state.orientation);
}

/// Straight flight of balls without gravity, from hit to hit. Numbers: touch_time, of the first hit [s].
class BallHits : public Reference {
 public:
  BallHits(std::vector<Thing> start, const Law& law, double end) {
    double fastest = 0.0;
    for (const auto& t : start) fastest = std::max(fastest, norm(t.state.velocity));
    paths_.push_back({0.0, std::move(start)});
    while (true) {
      const auto touch = next_touch(paths_.back().things, smallest * fastest);
      Path next{paths_.back().since + touch.after, paths_.back().things};
      if (!(next.since <= end)) return;
      if (paths_.size() > most_hits)
        throw InputError("ball_hits: more than " + std::to_string(most_hits) + " hits");
      for (auto& t : next.things) fly(t, touch.after);
      hit(next.things[touch.a], next.things[touch.b], touch.normal, law);
      paths_.push_back(std::move(next));
    }
  }
  [[nodiscard]] Snapshot at(double time) const override {
    const auto after =
        std::find_if(paths_.begin() + 1, paths_.end(), [&](const Path& p) { return p.since >= time; });
    const Path& path = *(after - 1);
    Snapshot out;
    out.time = time;
    for (Thing t : path.things) {
      fly(t, time - path.since);
      out.bodies.push_back(t.state);
    }
    return out;
  }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "touch_time" && paths_.size() > 1) return paths_[1].since;
    return {};
  }

 private:
  struct Path {
    double since = 0.0;  ///< [s]
    std::vector<Thing> things;
  };
  std::vector<Path> paths_;
};

Thing thing_of(const JobBody& body, const Shape& shape) {
  Thing t;
  t.state.position = body.properties.centre;
  t.state.mass = body.properties.mass;
  if (body.motion == Motion::fixed && shape.kind == Shape::Kind::box) {
    t.low = shape.min;
    t.high = shape.max;
    return t;
  }
  const Vec3 moments = body.properties.principal_inertia;
  if (body.motion != Motion::free || body.phase != Phase::rigid || shape.kind != Shape::Kind::sphere)
    throw InputError("ball_hits holds for free rigid balls and fixed boxes, and body `" + body.name +
                     "` is neither");
  if (std::abs(moments[2] - moments[0]) > 1e-9 * moments[2])
    throw InputError("ball_hits: the principal moments of the ball `" + body.name + "` differ");
  t.radius = shape.radius;
  t.inverse_mass = 1.0 / body.properties.mass;
  t.inverse_inertia = 1.0 / moments[0];
  t.state.velocity = body.velocity;
  t.state.angular_velocity = body.angular_velocity;
  return t;
}

std::unique_ptr<Reference> make_ball_hits(const ReferenceInput& in) {
  if (norm(in.job.scene.gravity) > 0.0) throw InputError("ball_hits holds without gravity");
  std::vector<Thing> things;
  for (const auto& body : in.job.bodies) things.push_back(thing_of(body, in.job.scene.body(body.name).shape));
  const auto law = [&](const char* name, double otherwise) {
    return in.args.number(name).value_or(law_of_contact(in.job, name).value_or(otherwise));
  };
  const Law laws{law("friction", 0.0), law("restitution", 1.0)};
  if (laws.friction < 0.0 || laws.restitution < 0.0 || laws.restitution > 1.0)
    throw InputError("ball_hits: friction is 0 or more, and the restitution lies from 0 to 1");
  return std::make_unique<BallHits>(std::move(things), laws, in.job.scene.end_time);
}

}  // namespace

ReferenceEntry ball_hits_entry() {
  return {{"ball_hits",
           "analytic",
           "Newton's law of impact and Coulomb's law for the impulses of each hit; momentum and angular "
           "momentum between them",
           "balls without gravity that hit each other and the faces of fixed boxes, with the moment of their "
           "own particles",
           {{"friction", "1",
             "coefficient of Coulomb's friction; default that of all engines' settings, none where they say "
             "none"},
            {"restitution", "1",
             "normal speed after a hit over that before it; default that of all engines' settings, 1 where "
             "they say none"}}},
          make_ball_hits};
}

}  // namespace tripoint
