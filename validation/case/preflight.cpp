// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "sampling/shape_overlap.hpp"
#include "scene/effect_rule.hpp"
#include "scene/geometry.hpp"
#include "scene/joints.hpp"
#include "scene/phase_values.hpp"
#include "scene/shared_terms.hpp"
#include "validation/case/case.hpp"
#include "validation/case/dates.hpp"
#include "validation/case/overlap.hpp"
#include "validation/case/preflight.hpp"
#include "validation/case/shape_match.hpp"

/// Checks of a scene before anything runs.
namespace tripoint {
namespace {

class Preflight {
 public:
  Preflight(const Case& c, const Scene& s, const InitialState& state) : case_(c), scene_(s), state_(state) {}

  std::vector<Finding> run() {
    overlaps();
    gaps();
    pieces();
    for (std::size_t n = 0; n < scene_.bodies.size(); ++n) {
      resolution(n);
      keyframes(n);
    }
    for (auto& f : unlike_their_shapes(scene_, state_)) findings_.push_back(std::move(f));
    for (auto& f : weak_containers(scene_, state_)) findings_.push_back(std::move(f));
    for (auto& f : joint_findings(scene_)) findings_.push_back(std::move(f));
    outside();
    time_steps();
    dates();
    return std::move(findings_);
  }

 private:
  void error(const SourcePlace& place, std::string what) {
    findings_.push_back({true, std::move(what), place});
  }
  void warn(const SourcePlace& place, std::string what) {
    findings_.push_back({false, std::move(what), place});
  }

  /// A date silences a rule: that of a day to come would silence it now.
  void dates() {
    for (const auto& g : case_.gates)
      if (!g.date.empty() && is_in_the_future(g.date))
        error(g.place, fmt::format("the gate on \"{}\" is dated {}, which is in the future: write the day on "
                                   "which its limit was accepted",
                                   printable(g.metric), g.date));
  }

  void overlaps() {
    for (const auto& o : shared_spaces(scene_, state_)) {
      overlapping_.insert({o.a, o.b});
      const std::string &a = scene_.bodies[o.a].name, &b = scene_.bodies[o.b].name;
      if (has_joint(scene_, a, b)) {
        warn(
            scene_.bodies[o.b].place,
            fmt::format(
                "bodies \"{}\" and \"{}\" have a joint, so that they do not touch, but share space up to "
                "{:.3g} m thick, whose mass counts twice: draw them apart, and give mass, centre and inertia",
                a, b, o.thickness));
        continue;
      }
      error(scene_.bodies[o.b].place,
            fmt::format("bodies \"{}\" and \"{}\" overlap: their shapes share space "
                        "up to {:.3g} m thick, at ({:.4g}, {:.4g}, "
                        "{:.4g}) m; move them apart or cut one by a difference",
                        a, b, o.thickness, o.place.x, o.place.y, o.place.z));
    }
    const double near = least_distance(0.45) * scene_.spacing;
    if (!(near > 0.0)) return;
    for (const auto& o : find_overlaps(scene_, state_, near))
      if (!overlapping_.contains({o.a, o.b}) &&
          !has_joint(scene_, scene_.bodies[o.a].name, scene_.bodies[o.b].name))
        stand_too_near(o, near);
  }

  /// A share of the spacing, or less: neighbours of one lattice come as near as 1 - 2 jitter by themselves.
  [[nodiscard]] double least_distance(double share) const {
    return std::min(share, 0.99 * (1.0 - 2.0 * scene_.jitter));
  }

  /// Shapes that share no space, and particles that do: their lattices do not fit.
  void stand_too_near(const Overlap& o, double near) {
    const auto& a = scene_.bodies[o.a];
    const auto& b = scene_.bodies[o.b];
    error(b.place, fmt::format("the shapes of bodies \"{}\" and \"{}\" do not overlap, but {} pairs of their "
                               "particles are nearer "
                               "than {:.3g} m, the nearest {:.3g} m: {}",
                               a.name, b.name, o.pairs, near, o.nearest, shift_that_helps(a, b, o)));
  }

  /// How far the second body's lattice is from the first one's.
  [[nodiscard]] std::string shift_that_helps(const Body& a, const Body& b, const Overlap& o) const {
    Vec3 shift = o.difference;
    for (std::size_t k = 0; k < 3; ++k) {
      shift[k] -= scene_.spacing * std::round(shift[k] / scene_.spacing);
      if (std::abs(shift[k]) < 1e-6 * scene_.spacing) shift[k] = 0.0;
    }
    if (shift == Vec3{}) return "move them apart";
    return fmt::format(
        "move \"{}\", and what is cut out for it alike, by ({:.4g}, {:.4g}, {:.4g}) m, so that it shares the "
        "lattice of \"{}\"",
        b.name, shift.x, shift.y, shift.z, a.name);
  }

  [[nodiscard]] bool presses() const { return calls_for(scene_, &EffectRule::has_pressure); }

  /// Finds rows of two bodies that are nearer than rows of one body. Such matter is compressed from the
  /// start, and flies apart.
  void gaps() {
    const double overlap = least_distance(0.45), near = least_distance(0.8);
    if (!(near > overlap) || !presses()) return;
    const auto joined = [](const Body& a, const Body& b) {
      return std::find(a.joined_to.begin(), a.joined_to.end(), b.name) != a.joined_to.end();
    };
    for (const auto& o : find_overlaps(scene_, state_, near * scene_.spacing)) {
      const auto& a = scene_.bodies[o.a];
      const auto& b = scene_.bodies[o.b];
      const bool both_driven = a.motion != Motion::free && b.motion != Motion::free &&
                               a.phase != Phase::liquid && b.phase != Phase::liquid;
      if (o.nearest < overlap * scene_.spacing || both_driven || joined(a, b) || joined(b, a) ||
          overlapping_.contains({o.a, o.b}))
        continue;
      warn(
          b.place,
          fmt::format(
              "bodies \"{}\" and \"{}\": their nearest particles are {:.3g} m apart, {:.2g} of a spacing ({} "
              "pairs below {:.2g}): as if compressed, and they fly apart at the start; "
              "put the faces where they touch on multiples of scene.spacing = {:g} m (a wall's thickness "
              "too), "
              "so that rows are one spacing apart; or {}",
              a.name, b.name, o.nearest, o.nearest / scene_.spacing, o.pairs, near, scene_.spacing,
              shift_that_helps(a, b, o)));
    }
  }

  /// Nothing keeps the pieces of a broken body apart where nothing presses.
  void pieces() {
    if (presses() || !scene_.contact) return;
    for (const auto& b : scene_.bodies) {
      const Material& m = scene_.material(b.material);
      if (b.phase != Phase::elastic || b.motion == Motion::fixed ||
          !(m.fracture_stretch || m.fracture_distance))
        continue;
      warn(b.place,
           fmt::format(
               "body \"{}\" can break, and its pieces would pass through each other: give material \"{}\" a "
               "sound_speed, or say so by scene.contact = \"none\"",
               b.name, m.name));
    }
  }

  void resolution(std::size_t n) {
    const Body& b = scene_.bodies[n];
    Vec3 low{INFINITY, INFINITY, INFINITY}, high = -low;
    for (std::size_t i = 0; i < state_.size(); ++i) {
      if (state_.source[i] != static_cast<int>(n)) continue;
      for (std::size_t a = 0; a < 3; ++a) {
        low[a] = std::min(low[a], state_.position[i][a]);
        high[a] = std::max(high[a], state_.position[i][a]);
      }
    }
    for (std::size_t a = 0; a < 3; ++a) {
      if (a == 1 && scene_.is_planar()) continue;
      const long across = std::lround((high[a] - low[a]) / scene_.spacing) + 1;
      if (scene_.periodic[a] &&
          static_cast<double>(across) * scene_.spacing >= 0.999 * ((*scene_.max)[a] - (*scene_.min)[a]))
        continue;  // endless
      if (across < 3)
        warn(b.place,
             fmt::format(
                 "body \"{}\" is {} particle{} across along {}: at least 3 resolve it; refine scene.spacing",
                 b.name, across, across == 1 ? "" : "s", "xyz"[a]));
    }
  }

  void keyframes(std::size_t n) {
    const Body& b = scene_.bodies[n];
    if (b.keyframes.empty()) return;
    Vec3 centre;
    double count = 0.0;
    for (std::size_t i = 0; i < state_.size(); ++i)
      if (state_.source[i] == static_cast<int>(n)) {
        centre += state_.position[i];
        count += 1.0;
      }
    centre = centre / count;
    const double jump = norm(b.keyframes.front().position - centre);
    if (jump > 1e-6 * scene_.spacing) {
      auto what = fmt::format(
          "body \"{}\": its first keyframe is at ({}, {}, {}) m, its centre of mass at ({}, {}, {}) m: it "
          "jumps there at the "
          "start",
          b.name, b.keyframes.front().position.x, b.keyframes.front().position.y,
          b.keyframes.front().position.z, centre.x, centre.y, centre.z);
      findings_.push_back({jump > 0.5 * scene_.spacing, std::move(what), b.place});
    }
    if (const double turn = angle_between({}, b.keyframes.front().rotation); turn > 1e-9)
      error(
          b.place,
          fmt::format(
              "body \"{}\": its first keyframe is turned by {:.3g} rad, but its particles are laid unturned: "
              "begin with rotation = [1, 0, 0, 0], rotations count from the start",
              b.name, turn));
    for (std::size_t k = 1; k < b.keyframes.size(); ++k) {
      const auto& from = b.keyframes[k - 1].rotation;
      const auto& to = b.keyframes[k].rotation;
      if ((conjugate(from) * to).w > 1e-9) continue;
      error(
          b.place,
          fmt::format(
              "body \"{}\": keyframe {} is half a turn or more from the one before it, as written; the body "
              "takes the shorter way: add a keyframe between them (or flip the quaternion's sign)",
              b.name, k + 1));
    }
  }

  void outside() {
    if (!(scene_.min && scene_.max)) return;
    std::map<int, long> lost;
    for (std::size_t i = 0; i < state_.size(); ++i)
      for (std::size_t a = 0; a < 3; ++a)
        if (!scene_.periodic[a] &&
            (state_.position[i][a] < (*scene_.min)[a] || state_.position[i][a] > (*scene_.max)[a])) {
          ++lost[state_.source[i]];
          break;
        }
    for (const auto& [source, count] : lost)
      warn(scene_.bodies[static_cast<std::size_t>(source)].place,
           fmt::format("{} particles of body \"{}\" lie outside scene.min and scene.max: enlarge the domain",
                       count, scene_.bodies[static_cast<std::size_t>(source)].name));
  }

  /// Stability bound of explicit conduction on the lattice [s]: 0.075 h^2/a corrected, 0.130 h^2/a paper, a =
  /// k/(rho c). The factors follow from the largest eigenvalue measured on the lattice at h/dx = 2.6
  /// and 2.12. Matter held at a temperature bounds no step.
  [[nodiscard]] double heat_bound(std::string& which) const {
    double least = INFINITY;
    const double h = scene_.support_ratio * scene_.spacing,
                 c = scene_.mode_of(term::heat) == Mode::paper ? 0.130 : 0.075;
    for (const auto& b : scene_.bodies) {
      const Material& m = scene_.material(b.material);
      if (!b.temperature || b.temperature_held || !m.conductivity || !m.heat_capacity) continue;
      const double capacity = std::min(heat_capacity_of(m, Phase::rigid), heat_capacity_of(m, Phase::liquid)),
                   conductivity =
                       std::max(conductivity_of(m, Phase::rigid), conductivity_of(m, Phase::liquid));
      const double bound = c * h * h * m.density * capacity / conductivity;
      if (bound < least) {
        least = bound;
        which = fmt::format("heat in body \"{}\"", b.name);
      }
    }
    return least;
  }

  void time_steps() {
    std::string which;
    double bound = heat_bound(which);
    for (const auto& b : scene_.bodies) {
      if (b.phase != Phase::rigid || b.motion != Motion::free || !(norm(b.angular_velocity) > 0.0)) continue;
      const double turning = 0.5 / norm(b.angular_velocity);
      if (turning < bound) {
        bound = turning;
        which = fmt::format("rotation of body \"{}\", |angular_velocity| dt <= 0.5,", b.name);
      }
    }
    if (scene_.time_step && *scene_.time_step > bound) {
      auto what =
          fmt::format("time_step = {} s is above the bound of {} {:.4g} s: shorten it, or write \"auto\"",
                      *scene_.time_step, which, bound);
      findings_.push_back({case_.expect != Expect::diverges, std::move(what), {case_.file, 0, 0}});
    }
    for (const auto& study : case_.studies)
      if (study.axes.axis == Axis::time_step && study.levels.front() > bound)
        warn(study.place,
             fmt::format("the study's first time step {} s is above the bound of {} {:.4g} s: leave it out",
                         study.levels.front(), which, bound));
    if (scene_.time_step && scene_.end_time / *scene_.time_step > 1e8)
      warn({case_.file, 0, 0}, fmt::format("{:.3g} steps to end_time: lengthen scene.time_step",
                                           scene_.end_time / *scene_.time_step));
  }

  const Case& case_;
  const Scene& scene_;
  const InitialState& state_;
  std::vector<Finding> findings_;
  std::set<std::pair<std::size_t, std::size_t>> overlapping_;  ///< rows of bodies whose shapes share space
};

}  // namespace

std::vector<Finding> preflight(const Case& c, const Scene& s, const InitialState& state) {
  return Preflight(c, s, state).run();
}

}  // namespace tripoint
