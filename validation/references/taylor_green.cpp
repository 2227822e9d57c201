// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include "files/job.hpp"
#include "validation/references/liquid_scene.hpp"

namespace tripoint {
namespace {

/// The vortices at the start: greatest speed U, wave number k, where their pattern begins and how fast it is
/// carried along.
struct Vortices {
  double speed = 0.0, k = 0.0;
  Vec3 origin, carried;
};

/// u = U (-cos kx sin ky, sin kx cos ky) exp(-2 nu k^2 t), x and y from the origin, which moves along. In two
/// dimensions z has the place of y.
/// Numbers: velocity_rate, at which it decays [1/s].
class TaylorGreen : public LiquidReference {
 public:
  TaylorGreen(const ReferenceInput& in, const Vortices& v, double viscosity, double density)
      : LiquidReference(in.job, in.initial),
        vortices_(v),
        rate_(2.0 * viscosity * v.k * v.k),
        density_(density),
        planar_(in.job.scene.is_planar()) {}
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "velocity_rate") return rate_;
    return {};
  }

 protected:
  [[nodiscard]] LiquidState state(const Vec3& place, double time, std::size_t) const override {
    const double U = vortices_.speed * std::exp(-rate_ * time), k = vortices_.k;
    const Vec3 r = place - vortices_.origin - time * vortices_.carried;
    LiquidState s;
    const double second = planar_ ? r.z : r.y;
    const double along = -U * std::cos(k * r.x) * std::sin(k * second),
                 across = U * std::sin(k * r.x) * std::cos(k * second);
    s.velocity = vortices_.carried + (planar_ ? Vec3{along, 0.0, across} : Vec3{along, across, 0.0});
    s.pressure = -0.25 * density_ * U * U * (std::cos(2.0 * k * r.x) + std::cos(2.0 * k * second));
    return s;
  }

 private:
  Vortices vortices_;
  double rate_, density_;
  bool planar_;
};

Vortices vortices_of(const ReferenceInput& in, const VelocityField& v) {
  const bool known = v.kind == VelocityField::Kind::taylor_green;
  const auto speed = in.args.number("speed"), wavelength = in.args.number("wavelength");
  if (!known && (!speed || !wavelength))
    throw InputError(
        "taylor_green needs a liquid with velocity = {kind = \"taylor_green\", ...}, or the arguments speed "
        "and wavelength");
  return {speed.value_or(v.speed), 2.0 * std::numbers::pi / wavelength.value_or(v.wavelength),
          in.args.vector("origin").value_or(Vec3{}), in.args.vector("carried").value_or(Vec3{})};
}

std::unique_ptr<Reference> make_vortices(const ReferenceInput& in) {
  const auto liquid = only_liquid(in.job, "taylor_green");
  const bool planar = in.job.scene.is_planar();
  if (!in.job.scene.periodic[0] || !in.job.scene.periodic[planar ? 2 : 1])
    throw InputError(planar ? "taylor_green is periodic in x and z" : "taylor_green is periodic in x and y");
  const auto v = vortices_of(in, in.job.scene.bodies.at(liquid).velocity);
  auto flow = std::make_unique<TaylorGreen>(in, v, kinematic_viscosity(in.job, liquid),
                                            material_of_body(in.job, liquid).density);
  // Formula and arguments are written apart: they must say the same
  const auto start = flow->at(0.0).velocity;
  for (std::size_t i = 0; i < in.initial.size(); ++i)
    if (in.initial.phase[i] == static_cast<int>(Phase::liquid) &&
        !(norm(start[i] - in.initial.velocity[i]) <= 1e-9 * v.speed))
      throw InputError("taylor_green: the liquid does not start with these vortices");
  return flow;
}

}  // namespace

ReferenceEntry taylor_green_entry() {
  return {{"taylor_green",
           "analytic",
           "Taylor & Green 1937: vortices that decay as exp(-2 nu k^2 t)",
           "a square of periodic vortices, at rest or carried along",
           {{"speed", "m/s", "greatest speed of the vortices; default of the liquid's velocity"},
            {"wavelength", "m", "side of their cell; default of the liquid's velocity"},
            {"origin", "m", "where their pattern begins; default 0", ArgumentType::vector},
            {"carried", "m/s", "velocity that carries all of it along; default 0", ArgumentType::vector}}},
          make_vortices};
}

}  // namespace tripoint
