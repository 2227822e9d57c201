// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>

#include "validation/metrics/members.hpp"

namespace tripoint {
namespace {

std::string no_pressure(const FramePair& f) {
  if (f.now.pressure.size() < f.in.initial.size()) return "the trajectory has no pressure";
  if (f.truth.pressure.size() < f.in.initial.size()) return "the reference does not know the pressure";
  return {};
}

/// Least-squares factor of the run's pressures on the true ones, minus 1: deep particles count most, noise
/// about zero cancels.
FrameError pressure_factor(const FramePair& f) {
  if (auto why = no_pressure(f); !why.empty()) return problem(why);
  long double product = 0, square = 0;
  for (std::size_t i = 0; i < f.in.initial.size(); ++i) {
    if (!takes(f.in, i) || std::isnan(f.truth.pressure[i])) continue;
    const double w = rest_volume(f.in, i);
    product += static_cast<long double>(w) * f.now.pressure[i] * f.truth.pressure[i];
    square += static_cast<long double>(w) * f.truth.pressure[i] * f.truth.pressure[i];
  }
  return square > 0 ? single(double(product / square) - 1.0)
                    : problem("the true pressure is zero everywhere");
}

/// Mean error of a column over the particles that began within one spacing of the interface.
FrameError at_interface(const FramePair& f, std::vector<double> Snapshot::*column, const char* what) {
  const auto &run = f.now.*column, &truth = f.truth.*column;
  if (run.size() < f.in.initial.size()) return problem(std::string("the trajectory has no ") + what);
  if (truth.size() < f.in.initial.size())
    return problem(std::string("the reference does not know the ") + what);
  const auto axis = f.in.reference.measuring().axis;
  const auto place = f.in.reference.number("interface");
  if (!axis || !place) return problem("the reference knows no interface");
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < f.in.initial.size(); ++i) {
    const double away = std::abs(f.in.initial.position[i][*axis] - *place);
    if (!takes(f.in, i) || std::isnan(truth[i]) || away > f.in.job.scene.spacing) continue;
    sum += run[i] - truth[i];
    count += 1.0;
  }
  return count > 0.0 ? single(sum / count)
                     : problem("no particle of the metric's body begins at the interface");
}
FrameError interface_pressure(const FramePair& f) { return at_interface(f, &Snapshot::pressure, "pressure"); }
FrameError interface_density(const FramePair& f) { return at_interface(f, &Snapshot::density, "density"); }

/// Depth of a floating body's keel below the level that the liquid's volume gives: volume = pool (level -
/// floor) - block (level - keel). (The top layer of particles is no measure: it lies up to 0.2 dx low.)
FrameError draught(const FramePair& f) {
  const auto number = [&](const char* name) { return f.in.reference.number(name); };
  const auto axis = f.in.reference.measuring().axis;
  const auto truth = number("draught"), up = number("up"), floor = number("floor"),
             pool = number("pool_area"), block = number("block_area"), volume = number("liquid_volume"),
             below = number("keel");
  if (!truth || !axis || !up || !floor || !pool || !block || !volume || !below)
    return problem("the reference knows no draught");
  const long row = body_row(f.in);
  if (row < 0 || static_cast<std::size_t>(row) >= f.now.bodies.size())
    return problem("draught: the metric must name the floating body");
  const auto& body = f.now.bodies[static_cast<std::size_t>(row)];
  if (!finite(body.position)) return problem("the floating body is not finite");
  const double keel = *up * body.position[*axis] - *below;
  const double level = (*volume + *pool * *floor - *block * keel) / (*pool - *block);
  return single(level - keel - *truth);
}

/// Torque on a body about the reference's axis minus the true one, with its sign.
FrameError axial_torque(const FramePair& f) {
  const auto truth = number_or_value(f.in, "torque");
  const auto axis = f.in.reference.measuring().axis;
  if (!truth || !axis) return problem("the reference knows no torque");
  const long row = body_row(f.in);
  if (row < 0 || static_cast<std::size_t>(row) >= f.now.bodies.size())
    return problem("axial_torque: the metric must name a solid body");
  const double torque = f.now.bodies[static_cast<std::size_t>(row)].torque[*axis];
  return std::isfinite(torque) ? single(torque - *truth) : problem("the engine shows no torque on the body");
}

/// Half the extent of the liquid along the axis, half a spacing included at each end, minus the true half
/// length.
FrameError half_length(const FramePair& f) {
  const auto truth = number_or_value(f.in, "half_length");
  const auto axis = f.in.reference.measuring().axis;
  if (!truth || !axis) return problem("the reference knows no half length");
  const std::size_t k = *axis;
  double low = 1e300, high = -1e300;
  for (std::size_t i = 0; i < f.now.position.size(); ++i) {
    if (!(f.in.choice.body.empty() ? takes_liquid(f.in, f.now, i) : takes(f.in, i))) continue;
    const double x = f.now.position[i][k];
    low = std::min(low, x);
    high = std::max(high, x);
  }
  return high >= low ? single(0.5 * (high - low) + 0.5 * f.in.job.scene.spacing - *truth)
                     : problem("the metric takes no particle");
}

}  // namespace

const std::vector<Quantity>& liquid_quantities() {
  static const std::vector<Quantity> list{
      {{"pressure_factor", "1", "least-squares factor of the pressures on the true ones, minus 1"},
       pressure_factor},
      {{"interface_pressure", "Pa",
        "mean error of pressure of the particles that began within a spacing of the reference's interface"},
       interface_pressure},
      {{"interface_density", "kg/m3", "mean error of density of the same particles"}, interface_density},
      {{"draught", "m",
        "depth of the floating body's keel below the level by volume, minus the true draught"},
       draught},
      {{"axial_torque", "N m", "torque on the body about the reference's axis minus the true one"},
       axial_torque},
      {{"half_length", "m",
        "half the extent of the liquid (or of the body) along the reference's axis minus the true one"},
       half_length}};
  return list;
}

}  // namespace tripoint
