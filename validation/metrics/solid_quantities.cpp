// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "validation/metrics/frames.hpp"
#include "validation/metrics/solid_motion.hpp"

namespace tripoint {
namespace {

FrameError deflection_error(const FramePair& f) {
  const auto measured = deflection(f.in, f.now);
  if (!measured.problem.empty()) return problem(measured.problem);
  const auto truth = truth_of(f.in, measured.of_tip ? "tip_deflection" : "deflection", f.now.time);
  return truth ? single(measured.value - *truth) : problem("the reference does not know the deflection");
}

FrameError stretch_error(const FramePair& f) {
  const auto measured =
      stretch(f.in, f.now,
              f.in.reference.number("stretch_gauge").value_or(f.in.reference.number("gauge").value_or(1.0)));
  return measured.problem.empty() ? against_truth(f, "stretch", measured.value) : problem(measured.problem);
}

FrameError reaction_error(const FramePair& f) {
  const auto measured = reaction(f.in, f.now);
  return measured.problem.empty() ? against_truth(f, "reaction", measured.value) : problem(measured.problem);
}

/// Second Piola-Kirchhoff stress of the reaction over the Green strain of the gauge: the ends' hold on the
/// sides does not count.
FrameError modulus_error(const FramePair& f) {
  const auto truth = f.in.reference.number("modulus"), area = f.in.reference.number("area");
  if (!truth || !area) return problem("the reference does not know the modulus");
  const auto force = reaction(f.in, f.now),
             length = stretch(f.in, f.now, f.in.reference.number("gauge").value_or(0.5));
  for (const auto& m : {force, length})
    if (!m.problem.empty()) return problem(m.problem);
  const double strain = 0.5 * (length.value * length.value - 1.0);
  if (std::abs(strain) < 1e-12)
    return problem("the bar is not stretched at t = " + std::to_string(f.now.time) + " s: choose a window");
  return single(force.value / (*area * length.value * strain) / *truth - 1.0);
}

FrameError spin_ratio(const FramePair& f) {
  const auto members = sampled(f.in, job_body(f.in));
  const Vec3 start = motion_of(f.in, f.first, members).angular_momentum,
             now = motion_of(f.in, f.now, members).angular_momentum;
  if (!(norm(start) > 0.0)) return problem("the body does not spin at the start");
  return against_truth(f, "spin_ratio", dot(now, start) / dot(start, start));
}

// --- over a run

/// Times and deflections of the frames; the reason why there are none, or an empty text.
std::string deflections(const MetricInput& in, const Frames& frames, std::vector<double>& t,
                        std::vector<double>& w) {
  if (frames.size() < 8) return "a swing needs eight output times or more";
  for (const auto* s : frames) {
    const auto measured = deflection(in, *s);
    if (!measured.problem.empty()) return measured.problem;
    t.push_back(s->time);
    w.push_back(measured.value);
  }
  return {};
}

/// The swing of the deflections about their rest; `problem` says why there is none.
Swing swing_of(const MetricInput& in, const Frames& frames, double guess) {
  std::vector<double> t, w;
  if (auto why = deflections(in, frames, t, w); !why.empty()) return {.problem = why};
  return fit_swing(t, w, guess);
}

MetricValue frequency(const MetricInput& in, const Frames& frames) {
  const auto truth = in.reference.number("frequency");
  if (!truth) return not_formed("the reference does not know the frequency");
  const auto swing = swing_of(in, frames, *truth);
  if (!swing.problem.empty()) return not_formed(swing.problem);
  MetricValue v;
  v.value = swing.frequency / *truth - 1.0;
  v.note = "frequency " + std::to_string(swing.frequency) + " rad/s against " + std::to_string(*truth) +
           ", amplitude " + std::to_string(swing.amplitude) + " m";
  return v;
}

MetricValue sag(const MetricInput& in, const Frames& frames) {
  const auto guess = in.reference.number("frequency");
  if (!guess) return not_formed("the reference does not know the frequency");
  std::vector<double> t, w;
  if (auto why = deflections(in, frames, t, w); !why.empty()) return not_formed(why);
  const auto truth =
      in.reference.number(deflection(in, *frames.front()).of_tip ? "tip_deflection" : "deflection");
  if (!truth || *truth == 0.0)
    return not_formed("the reference knows no static deflection: the scene has no load");
  const auto swing = fit_swing(t, w, *guess);
  if (!swing.problem.empty()) return not_formed(swing.problem);
  MetricValue v;
  v.value = swing.offset / *truth - 1.0;
  v.note = "sag " + std::to_string(swing.offset) + " m against " + std::to_string(*truth);
  return v;
}

MetricValue swing_amplitude(const MetricInput& in, const Frames& frames) {
  const auto truth = in.reference.number("amplitude"), guess = in.reference.number("frequency");
  if (!truth || !guess)
    return not_formed(
        "the reference does not know the amplitude of a swing: it starts neither in its lowest mode nor with "
        "a stated one");
  const auto swing = swing_of(in, frames, *guess);
  if (!swing.problem.empty()) return not_formed(swing.problem);
  MetricValue v;
  v.value = swing.amplitude / *truth - 1.0;
  v.note = "amplitude " + std::to_string(swing.amplitude) + " m against " + std::to_string(*truth);
  return v;
}

/// Between frames by a straight line in (stretch, reaction), the first time that the reaction falls through
/// zero after the longest stretch.
MetricValue residual_stretch(const MetricInput& in, const Frames& frames) {
  const auto truth = in.reference.number("residual_stretch");
  if (!truth)
    return not_formed(
        "the reference does not know a residual stretch: the material does not yield, or the ends do not go "
        "back");
  std::vector<double> force, length;
  for (const auto* s : frames) {
    const auto f = reaction(in, *s), l = stretch(in, *s, in.reference.number("stretch_gauge").value_or(1.0));
    for (const auto& m : {f, l})
      if (!m.problem.empty()) return not_formed(m.problem);
    force.push_back(f.value);
    length.push_back(l.value);
  }
  const auto longest =
      static_cast<std::size_t>(std::max_element(length.begin(), length.end()) - length.begin());
  for (std::size_t n = longest + 1; n < force.size(); ++n) {
    if (force[n] > 0.0) continue;
    const double share = force[n - 1] / (force[n - 1] - force[n]);
    MetricValue v;
    v.value = length[n - 1] + share * (length[n] - length[n - 1]) - *truth;
    v.note = "residual stretch " + std::to_string(v.value + *truth) + " against " + std::to_string(*truth);
    return v;
  }
  return not_formed("the reaction does not fall to zero after the longest stretch");
}

}  // namespace

const std::vector<Quantity>& solid_quantities() {
  static const std::vector<Quantity> list{
      {{"deflection", "m",
        "displacement of the free end (mean of the last layer) or rigid tip along the reference's direction, "
        "minus the true one"},
       deflection_error},
      {{"stretch", "1", "length of the body along the axis over its length at the start, minus the true one"},
       stretch_error},
      {{"reaction", "N", "force on the named held body along the bar, tension positive, minus the true one"},
       reaction_error},
      {{"modulus", "1",
        "reaction over cross-section, stretch and Green strain of the bar's middle, over the true modulus, "
        "minus 1"},
       modulus_error},
      {{"spin_ratio", "1",
        "angular momentum of the body about its centre along that of the start, over it, minus the stated "
        "value"},
       spin_ratio}};
  return list;
}

const std::vector<RunQuantity>& solid_run_quantities() {
  static const std::vector<RunQuantity> list{
      {{"frequency", "1",
        "frequency of the deflection's swing, a sine about an offset by least squares, over the true one, "
        "minus 1"},
       frequency},
      {{"sag", "1", "offset about which the deflection swings over the true static deflection, minus 1"},
       sag},
      {{"swing_amplitude", "1", "amplitude of the deflection's swing over the true one, minus 1"},
       swing_amplitude},
      {{"residual_stretch", "1",
        "stretch at which the reaction on the named body falls to zero on the way back, minus the true one"},
       residual_stretch}};
  return list;
}

}  // namespace tripoint
