// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "files/job.hpp"
#include "validation/references/heat_scene.hpp"
#include "validation/references/neumann.hpp"
#include "validation/references/solid_scene.hpp"

namespace tripoint {
namespace {

/// Where the front runs: from the wall's face into the bar.
struct Course {
  std::size_t wall = 0, bar = 0, axis = 0;
  double face = 0.0, side = 1.0, length = 0.0, area = 0.0;  // side: the bar lies at face + side x, x > 0
  bool melts = true;
};

/// A bar at rest that changes phase from a held wall. Numbers: bar, axis, area [m2], melts (1 or 0), lambda,
/// stefan_number; in time: front_position from the wall's face [m].
class Stefan : public Reference {
 public:
  Stefan(const ReferenceInput& in, const NeumannFront& front, const Course& course)
      : initial_(in.initial),
        dx_(in.job.scene.spacing),
        front_(front),
        course_(course),
        lambda_(front.lambda()) {
    solid_ = in.job.scene.material(in.job.bodies[course.bar].material).solid == SolidKind::rigid
                 ? Phase::rigid
                 : Phase::elastic;
  }
  [[nodiscard]] Snapshot at(double time) const override {
    Snapshot out;
    out.time = time;
    out.position = initial_.position;
    out.velocity.assign(initial_.size(), Vec3{});
    out.phase = initial_.phase;
    out.temperature.assign(initial_.size(), front_.surface);
    out.liquid_fraction.assign(initial_.size(), 0.0);
    const double X = place(time);
    for (std::size_t i = 0; i < initial_.size(); ++i) {
      if (initial_.source[i] != static_cast<int>(course_.bar)) continue;
      const double x = course_.side * (initial_.position[i][course_.axis] - course_.face);
      // Share of the particle's cell that the front has passed
      const double changed = std::clamp((X - x) / dx_ + 0.5, 0.0, 1.0);
      out.temperature[i] = time > 0.0 ? front_.temperature(x, time) : front_.far;
      out.liquid_fraction[i] = course_.melts ? changed : 1.0 - changed;
      out.phase[i] = static_cast<int>((changed >= 1.0) == course_.melts ? Phase::liquid : solid_);
    }
    return out;
  }
  [[nodiscard]] Measuring measuring() const override {
    return {.axis = course_.axis, .bar = course_.bar, .melts = course_.melts};
  }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "area") return course_.area;
    if (quantity == "lambda") return lambda_;
    if (quantity == "stefan_number") return front_.stefan_number();
    return {};
  }
  [[nodiscard]] std::optional<double> number_at(std::string_view quantity, double time) const override {
    return quantity == "front_position" ? std::optional(place(time)) : number(quantity);
  }

 private:
  [[nodiscard]] double place(double time) const { return front_.front(time); }
  InitialState initial_;
  double dx_;
  NeumannFront front_;
  Course course_;
  double lambda_;
  Phase solid_ = Phase::rigid;
};

std::size_t held_wall(const ReferenceInput& in) {
  if (const auto given = named_body(in, "wall")) return *given;
  std::optional<std::size_t> found;
  for (std::size_t b = 0; b < in.job.bodies.size(); ++b) {
    if (!in.job.bodies[b].temperature_held) continue;
    if (found)
      throw InputError(
          "stefan: name the wall that the change starts from by the argument `wall`: several bodies hold "
          "their temperature");
    found = b;
  }
  if (!found) throw InputError("stefan needs a wall with temperature_held = true");
  return *found;
}

std::size_t melting_bar(const ReferenceInput& in, std::size_t wall) {
  if (const auto given = named_body(in, "body")) return *given;
  std::optional<std::size_t> found;
  for (std::size_t b = 0; b < in.job.bodies.size(); ++b) {
    if (b == wall || in.job.bodies[b].temperature_held ||
        !in.job.scene.material(in.job.bodies[b].material).t_melt)
      continue;
    if (found) throw InputError("stefan: name the bar by the argument `body`: several bodies can melt");
    found = b;
  }
  if (!found) throw InputError("stefan needs a body of a material with t_melt");
  return *found;
}

double constant_temperature(const Job& job, std::size_t body) {
  const auto& field = job.scene.bodies.at(body).temperature;
  if (!field || field->kind != TemperatureField::Kind::constant)
    throw InputError("stefan: body `" + job.bodies[body].name + "` needs one temperature");
  return field->value;
}

Course course_of(const ReferenceInput& in) {
  Course c;
  c.wall = held_wall(in);
  c.bar = melting_bar(in, c.wall);
  c.axis = long_axis(in, c.bar);
  const auto ends = body_along(c.axis, c.bar, in.job, in.initial);
  c.side = in.job.bodies[c.wall].properties.centre[c.axis] < in.job.bodies[c.bar].properties.centre[c.axis]
               ? 1.0
               : -1.0;
  c.face = in.args.number("place").value_or(c.side > 0.0 ? ends.low : ends.high);
  c.length = ends.length();
  const auto size = extents(in, c.bar);
  c.area = size[(c.axis + 1) % 3] * size[(c.axis + 2) % 3];
  return c;
}

/// Length of a bar whose far end is warmed by no more than `allowed` [K], and that the front does not reach
/// [m].
double least_length(const NeumannFront& front, double diffusivity, double end, double allowed) {
  const double reach = std::sqrt(diffusivity * end), far = std::abs(front.far - front.change);
  double low = 0.0, high = 20.0;  // of 2 sqrt(D t): erfc(20) is below any number
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    (far * std::erfc(middle) > allowed ? low : high) = middle;
  }
  return std::max(front.front(end), 2.0 * high * reach);
}

std::unique_ptr<Reference> make_stefan(const ReferenceInput& in) {
  auto course = course_of(in);
  const auto& material = in.job.scene.material(in.job.bodies[course.bar].material);
  const double latent = in.args.number("latent_heat").value_or(material.latent_heat.value_or(0.0));
  if (!material.t_melt || !material.heat_capacity || !(latent > 0.0))
    throw InputError("stefan: material `" + material.name + "` needs t_melt, heat_capacity and latent_heat");
  NeumannFront front;
  front.surface = constant_temperature(in.job, course.wall);
  front.far = constant_temperature(in.job, course.bar);
  course.melts = front.surface > front.far;
  front.change = course.melts ? *material.t_melt : material.t_solid.value_or(*material.t_melt);
  const Phase solid = Phase::rigid, liquid = Phase::liquid;
  const auto near = phase_values(in.job, course.bar, course.melts ? liquid : solid),
             left = phase_values(in.job, course.bar, course.melts ? solid : liquid);
  const double more = (phase_values(in.job, course.bar, liquid).heat_per_volume -
                       phase_values(in.job, course.bar, solid).heat_per_volume) /
                      material.density;
  front.diffusivity = near.diffusivity();
  front.far_diffusivity_ratio = left.diffusivity() / near.diffusivity();
  front.far_conductivity_ratio = left.conductivity / near.conductivity;
  front.latent_over_capacity = (latent + more * (front.change - *material.t_melt)) * material.density /
                               near.heat_per_volume;  // the heat of fusion at the front (Kirchhoff)
  if ((front.surface - front.change) * (front.change - front.far) < 0.0 || front.surface == front.change)
    throw InputError(
        "stefan: the temperature of the change must lie between that of the wall and that of the bar");
  const double end = in.job.scene.end_time,
               warmed = std::abs(front.far - front.change) *
                        std::erfc(0.5 * course.length / std::sqrt(left.diffusivity() * end));
  const double allowed = 1e-3 * std::abs(front.surface - front.change);
  if (front.front(end) > course.length || warmed > allowed)
    throw InputError("stefan holds for a half space: the bar is " + std::to_string(course.length) +
                     " m long, and until end_time = " + std::to_string(end) + " s it must be " +
                     std::to_string(least_length(front, left.diffusivity(), end, allowed)) +
                     " m or longer: lengthen it, or end sooner");
  return std::make_unique<Stefan>(in, front, course);
}

}  // namespace

ReferenceEntry stefan_entry() {
  return {{"stefan",
           "analytic",
           "Carslaw & Jaeger, Conduction of Heat in Solids, 1959, section 11.2: Neumann's solution "
           "X = 2 lambda sqrt(D t), by phases",
           "melting of a bar from a held hot wall, or freezing from a cold one: front, temperatures, liquid "
           "fractions and phases",
           {{"wall", "", "the held body; default the scene's only one", ArgumentType::word},
            {"body", "", "the bar; default the scene's only body that can melt", ArgumentType::word},
            {"place", "m", "of the surface along the bar; default the bar's face towards the wall"},
            {"latent_heat", "J/kg", "default the material's"}}},
          make_stefan};
}

}  // namespace tripoint
