// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include "files/job.hpp"
#include "scene/geometry.hpp"
#include "validation/references/beam.hpp"
#include "validation/references/heat_scene.hpp"
#include "validation/references/number_table.hpp"
#include "validation/references/solid_scene.hpp"

namespace tripoint {
namespace {

/// Sag and lowest frequency of a clamped beam. Numbers: deflection [m] of the last layer of particles, half a
/// spacing inside the end, and tip_deflection of a rigid tip's centre. Both are there where the scene has
/// gravity. Also frequency [rad/s], period [s], and amplitude [m] of a beam that starts in its lowest mode.
/// Also bar, axis, end (+1 or -1: where the free end lies), direction.x, .y, .z.
using Cantilever = NumberTable;

/// Where the beam is free: away from the body that holds it.
double free_end(const ReferenceInput& in, std::size_t bar, std::size_t axis) {
  const double middle = in.job.bodies[bar].properties.centre[axis];
  double end = 0.0;
  for (const auto& b : in.job.bodies) {
    if (b.phase == Phase::liquid || b.motion == Motion::free) continue;
    const double side = b.properties.centre[axis] < middle ? 1.0 : -1.0;
    if (end != 0.0 && side != end) throw InputError("cantilever: the beam is held at both ends");
    end = side;
  }
  if (end == 0.0) throw InputError("cantilever: no fixed or prescribed solid body holds the beam");
  return end;
}

/// Direction of the deflection: as given, along gravity, else the thinner side of the beam.
std::size_t deflected_axis(const ReferenceInput& in, std::size_t bar, std::size_t axis) {
  if (const auto given = in.args.vector("direction")) return axis_of(*given, "cantilever: direction");
  if (norm(in.job.scene.gravity) > 0.0) return axis_of(in.job.scene.gravity, "cantilever: gravity");
  const auto size = extents(in, bar);
  const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
  const auto endless = [&](std::size_t k) { return is_endless(in.job.scene, k); };
  if (endless(a) != endless(b)) return endless(a) ? b : a;
  return size[a] < size[b] ? a : b;
}

BeamTip tip_of(const ReferenceInput& in, std::size_t tip, std::size_t axis, std::size_t across, double end,
               double face) {
  BeamTip t;
  const auto& body = in.job.bodies[tip];
  const Vec3 centre = body.properties.centre;
  t.mass = body.properties.mass;
  t.offset = end * (centre[axis] - face);
  if (!(t.offset > 0.0)) throw InputError("cantilever: body `" + body.name + "` is not at the free end");
  for (std::size_t i = 0; i < in.initial.size(); ++i) {
    if (in.initial.source[i] != static_cast<int>(tip)) continue;
    const Vec3 r = in.initial.position[i] - centre;
    t.inertia += in.initial.mass[i] * (r[axis] * r[axis] + r[across] * r[across]);
  }
  return t;
}

/// Mean velocity along a direction at the start of the last layer of particles [m/s].
double end_velocity(const ReferenceInput& in, std::size_t bar, std::size_t axis, double end,
                    const Vec3& direction, double face) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < in.initial.size(); ++i) {
    if (in.initial.source[i] != static_cast<int>(bar) ||
        end * (face - in.initial.position[i][axis]) > in.job.scene.spacing)
      continue;
    sum += dot(in.initial.velocity[i], direction);
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

/// Published results for this very plate go before the theory of beams. They read its end, a run its last
/// layer of particles.
/// @param inside displacement of that layer over that of the end
void take_published(const ReferenceInput& in, double inside, Numbers& n) {
  if (const auto f = in.args.number("frequency")) n["frequency"] = 2.0 * std::numbers::pi * *f;
  for (const char* name : {"deflection", "amplitude"})
    if (const auto value = in.args.number(name)) n[name] = inside * *value;
  n["period"] = 2.0 * std::numbers::pi / n["frequency"];
}

std::unique_ptr<Reference> make_cantilever(const ReferenceInput& in) {
  const auto bar = elastic_body(in, "cantilever");
  const auto axis = long_axis(in, bar), across = deflected_axis(in, bar, axis);
  if (across == axis) throw InputError("cantilever: the deflection must be across the beam");
  const auto third = 3 - axis - across;
  const auto size = extents(in, bar);
  const double end = free_end(in, bar, axis), length = in.args.number("length").value_or(size[axis]);
  const bool plane_strain = in.args.flag("plane_strain").value_or(is_held_across(in.job.scene, third));
  const auto material = elastic_constants(in.job, bar);
  const double kappa = in.args.number("shear_coefficient")
                           .value_or(rectangular_shear_coefficient(material.poisson_ratio, plane_strain));
  const double density = in.job.scene.material(in.job.bodies[bar].material).density;
  const auto beam = rectangular_beam(length, size[across], size[third], density, material.young,
                                     material.poisson_ratio, plane_strain, kappa);

  const auto ends = body_along(axis, bar, in.job, in.initial);
  const auto tip_row = named_body(in, "tip");
  const double face = end > 0.0 ? ends.high : ends.low;
  const auto tip = tip_row ? tip_of(in, *tip_row, axis, across, end, face) : BeamTip{};
  Vec3 direction;
  direction[across] = in.args.vector("direction") ? std::copysign(1.0, (*in.args.vector("direction"))[across])
                      : in.job.scene.gravity[across] < 0.0 ? -1.0
                                                           : 1.0;

  Numbers n;
  n["frequency"] = beam_frequency(beam, tip);
  if (const double load = dot(in.job.scene.gravity, direction); load != 0.0) {
    n["deflection"] = beam_sag(beam, tip, load, length - 0.5 * in.job.scene.spacing).displacement;
    const auto joint = beam_sag(beam, tip, load, length);
    if (tip_row) n["tip_deflection"] = joint.displacement + tip.offset * joint.rotation;
  } else if (const double v = end_velocity(in, bar, axis, end, direction, face); v != 0.0) {
    n["amplitude"] = std::abs(v) / n["frequency"];
  }
  take_published(in,
                 beam_sag(beam, tip, 1.0, length - 0.5 * in.job.scene.spacing).displacement /
                     beam_sag(beam, tip, 1.0, length).displacement,
                 n);
  return std::make_unique<Cantilever>(
      std::move(n),
      Measuring{.axis = axis, .bar = bar, .direction = direction, .free_end_is_high = end > 0.0});
}

}  // namespace

ReferenceEntry cantilever_entry() {
  return {{"cantilever",
           "analytic",
           "Timoshenko, Phil. Mag. 41, 1921: beam with shear and rotary inertia; shear coefficient of "
           "Cowper, J. Appl. Mech. 33, "
           "1966",
           "static sag and lowest frequency of an elastic box clamped at one end, at small deflections. It "
           "may have a rigid tip",
           {{"body", "", "the beam; default the scene's only free elastic body", ArgumentType::word},
            {"tip", "", "name of a rigid body at the free end; default none", ArgumentType::word},
            {"length", "m", "free length; default of the beam's box"},
            {"direction", "", "of the deflection; default gravity's, without gravity the thinner side",
             ArgumentType::vector},
            {"frequency", "Hz", "published, in the place of Timoshenko's"},
            {"deflection", "m",
             "published mean deflection of the free end, likewise; read half a spacing inside"},
            {"amplitude", "m",
             "published amplitude of its swing, likewise; default its speed at the start over the frequency, "
             "in the lowest mode"},
            {"plane_strain", "", "default true where the third direction is periodic", ArgumentType::flag},
            {"shear_coefficient", "",
             "default 10 (1 + nu)/(12 + 11 nu), in plane strain with nu/(1 - nu) for nu"}}},
          make_cantilever};
}

}  // namespace tripoint
