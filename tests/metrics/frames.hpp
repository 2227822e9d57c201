// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "metrics/fakes.hpp"
#include "references/liquids.hpp"

namespace tripoint::test {

/// A run that shows the job's start in every frame, for tests to change.
struct Still {
  Prepared s;
  Trajectory run;
  explicit Still(Prepared prepared) : s(std::move(prepared)) {
    for (const double t : s.job.times) {
      Snapshot frame;
      frame.time = t;
      frame.position = s.initial.position;
      frame.velocity = s.initial.velocity;
      frame.mass = s.initial.mass;
      frame.phase = s.initial.phase;
      frame.body = s.initial.body;
      for (std::size_t i = 0; i < s.initial.size(); ++i) frame.id.push_back(static_cast<int>(i));
      for (const auto& b : s.job.bodies)
        if (b.index >= 0) {
          frame.bodies.emplace_back();
          frame.bodies.back().position = b.properties.centre;
          frame.bodies.back().mass = b.properties.mass;
        }
      run.frames.push_back(frame);
    }
  }
  [[nodiscard]] MetricValue of(const MetricChoice& choice, const std::string& name,
                               const Settings& args = {}) const {
    return evaluate(choice, s.job, s.initial, run, *make_reference(function(name, args), s.job, s.initial));
  }
  [[nodiscard]] double stated(const MetricChoice& choice, const Settings& args = {}) const {
    return of(choice, "stated", args).value;
  }
  /// Moves a body's particles in a frame.
  void shift(Snapshot& frame, int body, const Vec3& by) const {
    for (std::size_t i = 0; i < s.initial.size(); ++i)
      if (s.initial.source[i] == body) frame.position[i] += by;
  }
};

/// Two elastic blocks of 4 x 4 x 4 at a spacing of 0.1 m, their nearest layers one spacing apart, and a
/// liquid one far away.
inline Prepared blocks() {
  Prepared s;
  s.job.scene.spacing = 0.1;
  add_matter(s, "left", Phase::elastic, {{4, 4, 4}, 0.1, {-0.4, 0, 0}, 1.0}, {}, 1000.0);
  add_matter(s, "right", Phase::elastic, {{4, 4, 4}, 0.1, {0, 0, 0}, 1.0}, {}, 1000.0);
  add_matter(s, "pool", Phase::liquid, {{2, 2, 2}, 0.1, {0, 0, 5}, 1.0}, {}, 1000.0);
  set_times(s, 1.0, 4);
  return s;
}

}  // namespace tripoint::test
