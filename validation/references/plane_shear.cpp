// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/plane_shear.hpp"
#include "files/job.hpp"
#include "scene/geometry.hpp"

#include <cmath>
#include <numbers>

namespace tripoint {
namespace {

using std::numbers::pi;

class PlaneShear : public LiquidReference {
 public:
  PlaneShear(const ReferenceInput& in, const ShearFlow& flow, std::size_t across, double low,
             const Vec3& along)
      : LiquidReference(in.job, in.initial), flow_(flow), across_(across), low_(low), along_(along) {}

 protected:
  [[nodiscard]] LiquidState state(const Vec3& place, double time, std::size_t) const override {
    LiquidState s;
    s.velocity = flow_.speed(place[across_] - low_, time) * along_;
    return s;
  }

 private:
  ShearFlow flow_;
  std::size_t across_;
  double low_;
  Vec3 along_;
};

std::size_t open_axis(const Job& job, const char* function) {
  std::size_t axis = 0, count = 0;
  for (std::size_t k = 0; k < 3; ++k)
    if (!is_endless(job.scene, k)) {
      axis = k;
      ++count;
    }
  if (count != 1)
    throw InputError(std::string(function) +
                     " holds between two plates: every direction but the one across them must be periodic");
  return axis;
}

/// Velocities of the plates below and above the liquid.
std::pair<Vec3, Vec3> plate_velocities(const ReferenceInput& in, std::size_t across, double middle,
                                       const char* function) {
  std::optional<Vec3> low, high;
  for (const auto& body : in.job.bodies)
    if (body.phase != Phase::liquid)
      (body.properties.centre[across] < middle ? low : high) =
          body.motion == Motion::fixed ? Vec3{} : body.velocity;
  if (!low || !high) throw InputError(std::string(function) + " needs a plate on either side of the liquid");
  return {*low, *high};
}

}  // namespace

double ShearFlow::speed(double distance, double time) const {
  const double s = distance / width;
  if (time <= 0.0) return s <= 0.0 ? low_speed : s >= 1.0 ? high_speed : 0.0;
  const double pushed = drive * width * width / kinematic_viscosity;  // the body force's scale of speed
  double u = 0.5 * pushed * s * (1.0 - s) + low_speed + (high_speed - low_speed) * s;
  for (int n = 1; n < 100000; ++n) {
    const double a = n * pi, exponent = a * a * kinematic_viscosity * time / (width * width);
    if (exponent > 40.0) break;  // the rest is below round-off
    const double odd = n % 2 == 1 ? 1.0 : 0.0, sign = n % 2 == 1 ? -1.0 : 1.0;
    const double steady = 4.0 * pushed * odd / (a * a * a) + 2.0 / a * (low_speed - sign * high_speed);
    u -= steady * std::sin(a * s) * std::exp(-exponent);
  }
  return u;
}

std::vector<ReferenceArgument> plane_shear_arguments() {
  return {{"kinematic_viscosity", "m2/s", "default of the liquid"},
          {"width", "m", "between the plates; default the extent of the liquid"}};
}

std::unique_ptr<Reference> make_plane_shear(const ReferenceInput& in, const char* function, bool by_walls) {
  const auto liquid = only_liquid(in.job, function);
  const auto across = open_axis(in.job, function);
  const auto extent = body_along(across, liquid, in.job, in.initial);
  const auto [low, high] = plate_velocities(in, across, 0.5 * (extent.low + extent.high), function);
  const Vec3 drive = by_walls ? high - low : in.job.scene.gravity;
  if (norm(drive) == 0.0)
    throw InputError(std::string(function) +
                     (by_walls ? ": no plate moves" : ": the scene has no gravity to drive it"));
  if (by_walls == (norm(in.job.scene.gravity) > 0.0))
    throw InputError("couette is driven by its plates alone");
  const Vec3 along = (1.0 / norm(drive)) * drive;
  if (std::abs(along[across]) > 1e-12 || (!by_walls && norm(low) + norm(high) > 0.0))
    throw InputError(std::string(function) +
                     ": the drive must be along the plates, and plates beside a body force at rest");
  ShearFlow flow;
  flow.width = in.args.number("width").value_or(extent.length());
  flow.kinematic_viscosity = in.args.number("kinematic_viscosity") ? *in.args.number("kinematic_viscosity")
                                                                   : kinematic_viscosity(in.job, liquid);
  flow.drive = by_walls ? 0.0 : norm(drive);
  flow.low_speed = dot(low, along);
  flow.high_speed = dot(high, along);
  return std::make_unique<PlaneShear>(in, flow, across, extent.low, along);
}

}  // namespace tripoint
