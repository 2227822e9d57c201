// SPDX-License-Identifier: GPL-2.0-only
// Lengths are scaled to spacings, time stays in seconds; kT = D / dx2 and unit friction.
//
// A face of held temperature is a mirror that turns signs. The temperature less the steady profile vanishes
// there, so it goes on as an odd field beyond the face. Walkers cross the face freely and count with the
// opposite sign on the other side. Between two held faces the box of twice the length is periodic; beside
// one, its ends are insulated walls. Both are exact.
//
// Langevin walkers (v' = -v/tau + noise, kT/m = D/tau) spread as 2 D (t - tau (1 - exp(-t/tau))), late by
// tau. Their steps form a Gaussian process that mirror walls reflect exactly, so there is no other error than
// the lag. With the ratio step/tau below, the lag of LAMMPS's discrete scheme is exactly two steps, and the
// clock is started two steps early. A remainder of exp(-t/tau) stays.
#include "adapters/lammps/walkers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "adapters/lammps/heat_scene.hpp"
#include "adapters/lammps/walker_start.hpp"

namespace tripoint::lammps {
namespace {

constexpr int lag_steps = 2;
/// h = step/tau whose lag tau (1 - h)/(1 - h/2) is lag_steps steps: h2 - 3 h + 1 = 0.
constexpr double step_over_tau = 0.3819660112501051;
constexpr double steps_an_interval = 24.0;  // 9 relaxation times: exp(-t/tau) = 1e-4
/// Eight standard deviations of a step stay below the box: LAMMPS wraps and reflects once a step.
constexpr double box_over_step = 8.0;

/// The first body whose temperature is free; cell_box() has seen that there is one.
const Body& free_body(const Scene& scene) {
  return *std::find_if(scene.bodies.begin(), scene.bodies.end(),
                       [](const Body& b) { return !b.temperature_held; });
}

class Walkers final : public Model {
 public:
  Walkers(const Job& job, const InitialState& state, const CellBox& box, bool brownian)
      : job_(job),
        state_(state),
        choice_(choice_for(job)),
        box_(box),
        brownian_(brownian),
        start_(job_, state_, box),
        library_(job.output + "/log.lammps"),
        time_(job.times.front()) {
    axis_ = choice_.pool ? start_.only_axis() : -1;
    D_ = diffusivity(job.scene, free_body(job.scene)) / (job.scene.spacing * job.scene.spacing);
    choose_box();
    choose_step();
    make_box();
    make_walkers();
    make_fixes();
    library_.run(choice_.commands);
  }

  void advance_to(double time) override {
    Steps steps = steps_in(time - time_, limit_);
    if (!brownian_ && clock_.total() == 0) steps.count += lag_steps;
    clock_.run(library_, steps);
    time_ = time;
    for (std::size_t i = 0; i < job_.gauges.size(); ++i)
      if (const auto [D, error] = gauged(job_.gauges[i]); error > 0.0)
        gauges_ += fmt::format("{:.17g},{},{:.17g},{:.17g}\n", time_, i, D, error);
  }

  [[nodiscard]] Snapshot observe() const override;
  [[nodiscard]] Readback readback() const override { return rest_readback(job_, limit_); }

  void account(Result& result) const override {
    result.steps = clock_.total();
    result.time_step_bound = brownian_ ? "none: exact at any step within the box" : "relaxation time, box";
    result.extra["walkers"] = choice_.walkers;
    result.extra["kelvin_a_walker"] = kelvin_a_walker();
    const auto [msd, error] = diffusivity_by_displacement({0, 1, 2});
    if (error > 0.0) {
      result.extra["diffusivity"] = msd;
      result.extra["diffusivity_error"] = error;
    }
    result.message = fmt::format(
        "{:.0f} {} walkers {}; {}; cell means lie (k dx)^2/24 below the values at the centres",
        choice_.walkers, brownian_ ? "Brownian" : "Langevin",
        box_.held_axis >= 0 ? "beside the steady profile, with their signs"
                            : fmt::format("above {} K", start_.base({})),
        axis_ >= 0
            ? fmt::format("counted in whole layers along {}, as the start depends on it alone", "xyz"[axis_])
            : "counted in single cells");
    if (!brownian_) result.message += fmt::format("; relaxation time {:.3g} s, its lag taken off", tau_);
    if (gauges_.empty()) return;
    std::ofstream file(job_.output + "/gauges.csv");
    file << "time,gauge,value,standard_error\n" << gauges_;
    if (!file.flush()) throw EngineError(job_.output + "/gauges.csv: cannot be written");
  }

 private:
  /// Sides of the walkers' box in cells. Where the start depends on one axis alone, walkers are free across
  /// it and their section is of no account.
  void choose_box() {
    for (std::size_t k = 0; k < 3; ++k) {
      const bool across = axis_ >= 0 && static_cast<int>(k) != axis_;
      sides_[k] = across ? box_.cells[static_cast<std::size_t>(axis_)] : box_.cells[k];
      wraps_[k] = across || box_.periodic[k];
    }
    if (box_.held_axis < 0) return;
    sides_[static_cast<std::size_t>(box_.held_axis)] *= 2;
    wraps_[static_cast<std::size_t>(box_.held_axis)] = box_.held_low && box_.held_high;
  }

  void choose_step() {
    const double least_side = *std::min_element(sides_.begin(), sides_.end());
    limit_ = least_side * least_side / (2.0 * box_over_step * box_over_step * D_);
    double shortest = job_.times.back() - job_.times.front();
    for (std::size_t i = 1; i < job_.times.size(); ++i)
      shortest = std::min(shortest, job_.times[i] - job_.times[i - 1]);
    if (!brownian_) limit_ = std::min(limit_, shortest / steps_an_interval);
    // The job's own step is the particle solver's: walkers do not need it
    const auto set = job_.settings.find("time_step");
    if (set != job_.settings.end()) limit_ = std::min(limit_, *wanted_time_step(job_));
    if (job_.times.size() > 1) tau_ = steps_in(job_.times[1] - job_.times[0], limit_).size / step_over_tau;
  }

  void make_box() {
    library_.run(fmt::format("units lj\natom_style atomic\natom_modify sort 0 0.0\nboundary {} {} {}\n",
                             wraps_[0] ? 'p' : 'f', wraps_[1] ? 'p' : 'f', wraps_[2] ? 'p' : 'f'));
    library_.run(
        fmt::format("region box block 0 {} 0 {} 0 {}\ncreate_box 2 box\nmass * 1.0\npair_style none\n",
                    sides_[0], sides_[1], sides_[2]));
    library_.run(
        "comm_modify cutoff 0.05\nneighbor 0.0 bin\nneigh_modify every 1 delay 0 check no\nthermo 0\n");
  }

  void make_walkers() {
    Random random(job_.seed);
    const auto n = static_cast<std::size_t>(choice_.walkers);
    std::vector<Vec3> position(n), velocity(brownian_ ? 0 : n);
    std::vector<int> type(n, plus);
    for (std::size_t i = 0; i < n; ++i) {
      Vec3& x = position[i];
      x = start_.draw(random);
      if (box_.held_axis >= 0 && start_.sign(x) < 0) type[i] = minus;
      if (held_low_alone())
        x[static_cast<std::size_t>(box_.held_axis)] += box_.cells[static_cast<std::size_t>(box_.held_axis)];
      for (std::size_t k = 0; k < 3; ++k)
        if (axis_ >= 0 && static_cast<int>(k) != axis_) x[k] = random.uniform() * sides_[k];
    }
    const double sigma = brownian_ ? 0.0 : start_speed();
    for (Vec3& v : velocity) v = sigma * Vec3{random.gaussian(), random.gaussian(), random.gaussian()};
    library_.create_atoms(type, position, velocity);
    drawn_ = std::move(position);
    drawn_type_ = std::move(type);
    library_.run("compute way all msd");
  }

  /// Deviation of the first velocities for which the first half step is already stationary. [spacings/s]
  [[nodiscard]] double start_speed() const {
    const double h = step_over_tau, kT = D_ / tau_;  // m = 1
    return std::sqrt((kT / (1.0 - 0.5 * h) - 0.5 * h * kT)) / (1.0 - 0.5 * h);
  }

  void make_fixes() {
    const unsigned seed = 1 + static_cast<unsigned>((job_.seed * 2654435761ULL) % 900000000ULL);
    if (brownian_)
      library_.run(fmt::format("fix move all brownian {:.17g} {} gamma_t 1.0 rng gaussian", D_, seed));
    else
      library_.run(fmt::format("fix move all nve\nfix bath all langevin {0:.17g} {0:.17g} {1:.17g} {2}\n",
                               D_ / tau_, tau_, seed));
    std::string walls;
    for (std::size_t k = 0; k < 3; ++k)
      if (!wraps_[k]) walls += fmt::format(" {0}lo EDGE {0}hi EDGE", "xyz"[k]);
    if (!walls.empty()) library_.run("fix walls all wall/reflect" + walls);
  }

  /// Whether the box begins with the mirrored half.
  [[nodiscard]] bool held_low_alone() const { return box_.held_low && !box_.held_high; }

  /// The diffusivity that a gauge asks for, along its axis or, without one, along all. {} where walkers do
  /// not go on for ever there.
  [[nodiscard]] std::pair<double, double> gauged(const JobGauge& gauge) const {
    if (gauge.quantity != "diffusivity") return {};
    const auto axis = gauge.where.find("axis");
    if (axis == gauge.where.end()) return diffusivity_by_displacement({0, 1, 2});
    const auto* word = std::get_if<std::string>(&axis->second);
    if (!word || word->size() != 1 || (*word)[0] < 'x' || (*word)[0] > 'z') return {};
    return diffusivity_by_displacement({(*word)[0] - 'x'});
  }

  /// Half the mean squared displacement a second, of those of the axes along which walkers go on for ever,
  /// and its standard error. [m2/s]
  [[nodiscard]] std::pair<double, double> diffusivity_by_displacement(const std::vector<int>& axes) const {
    const double dx2 = job_.scene.spacing * job_.scene.spacing, time = time_ - job_.times.front();
    double sum = 0.0;
    int free = 0;
    for (const int k : axes)
      if (wraps_[static_cast<std::size_t>(k)]) {
        sum += library_.compute_value("way", k);
        ++free;
      }
    if (free == 0 || !(time > 0.0)) return {};
    const double D = dx2 * sum / (2.0 * free * time);
    return {D, D * std::sqrt(2.0 / (free * choice_.walkers))};
  }

  [[nodiscard]] double kelvin_a_walker() const { return start_.content() / choice_.walkers; }
  /// Number of cells that are counted together.
  [[nodiscard]] int pooled() const {
    return axis_ < 0
               ? 1
               : box_.cells[0] * box_.cells[1] * box_.cells[2] / box_.cells[static_cast<std::size_t>(axis_)];
  }
  [[nodiscard]] int bin_of(int cell) const {
    if (axis_ < 0) return cell;
    const auto& n = box_.cells;
    const std::array<int, 3> c{cell % n[0], cell / n[0] % n[1], cell / n[0] / n[1]};
    return c[static_cast<std::size_t>(axis_)];
  }
  /// Counts of the cells, or of the layers that are counted together: walkers with their signs, and all.
  struct Counts {
    std::vector<double> net, all;
  };
  [[nodiscard]] Counts counts() const;

  static constexpr int plus = 1, minus = 2;  ///< types

  Job job_;
  InitialState state_;
  Choice choice_;
  CellBox box_;
  bool brownian_;
  WalkerStart start_;
  Library library_;
  Clock clock_;
  int axis_ = -1;
  double D_ = 0.0, tau_ = 0.0, limit_ = 0.0, time_;  ///< D in spacings^2/s
  std::array<int, 3> sides_{};
  std::array<bool, 3> wraps_{};
  std::vector<Vec3> drawn_;  ///< where the walkers start
  std::vector<int> drawn_type_;
  std::string gauges_;  ///< lines of gauges.csv so far
};

Walkers::Counts Walkers::counts() const {
  const auto bins = static_cast<std::size_t>(axis_ < 0 ? box_.cells[0] * box_.cells[1] * box_.cells[2]
                                                       : box_.cells[static_cast<std::size_t>(axis_)]);
  Counts count{std::vector<double>(bins), std::vector<double>(bins)};
  const bool moved = clock_.total() > 0;
  const std::vector<Vec3> position = moved ? library_.unordered_positions() : drawn_;
  const std::vector<int> type = moved ? library_.unordered_types() : drawn_type_;
  for (std::size_t i = 0; i < position.size(); ++i) {
    double sign = type[i] == minus ? -1.0 : 1.0;
    std::array<int, 3> c{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = position[i][k];
      double inside = wraps_[k] ? x - sides_[k] * std::floor(x / sides_[k]) : x;
      if (static_cast<int>(k) == box_.held_axis) {
        const double length = box_.cells[k];
        if (held_low_alone() ? inside < length : inside > length) sign = -sign;
        inside = held_low_alone() ? std::abs(inside - length) : std::min(inside, 2.0 * length - inside);
      }
      c[k] = std::clamp(static_cast<int>(std::floor(inside)), 0,
                        (static_cast<int>(k) == box_.held_axis ? box_.cells[k] : sides_[k]) - 1);
    }
    const auto bin = static_cast<std::size_t>(axis_ < 0 ? c[0] + box_.cells[0] * (c[1] + box_.cells[1] * c[2])
                                                        : c[static_cast<std::size_t>(axis_)]);
    count.net[bin] += sign;
    count.all[bin] += 1.0;
  }
  return count;
}

Snapshot Walkers::observe() const {
  const Counts count = counts();
  const double unit = kelvin_a_walker() / pooled(), N = choice_.walkers;
  std::vector<double> temperature, error;
  for (std::size_t i = 0; i < state_.size(); ++i) {
    const int cell = start_.cell_of_particle()[i];
    if (cell < 0) {
      temperature.push_back(state_.temperature[i]);
      error.push_back(0.0);
      continue;
    }
    const auto bin = static_cast<std::size_t>(bin_of(cell));
    const Vec3 place = (1.0 / job_.scene.spacing) * (state_.position[i] - box_.min);
    temperature.push_back(start_.base(place) + unit * count.net[bin]);
    const double n = count.all[bin];
    // multinomial; an empty cell counts as one
    error.push_back(unit * std::sqrt(std::max(n, 1.0) * std::max(1.0 - n / N, 0.0)));
  }
  Snapshot s = at_rest(job_, state_, time_, clock_.total(), std::move(temperature));
  s.temperature_error = std::move(error);
  return s;
}

}  // namespace

std::string why_no_walkers(const Job& job) {
  if (const std::string reason = why_no_conduction(job); !reason.empty()) return reason;
  const Scene& scene = job.scene;
  if (scene.jitter > 0.0) return "walkers are counted on the lattice, and the particles are jittered";
  std::string why;
  if (!cell_box(scene, why)) return why;
  const Body& first = free_body(scene);
  for (const Body& b : scene.bodies)
    if (!b.temperature_held &&
        (std::abs(diffusivity(scene, b) / diffusivity(scene, first) - 1.0) > 1e-9 ||
         std::abs(heat_per_volume(scene, b) / heat_per_volume(scene, first) - 1.0) > 1e-9))
      return fmt::format("walkers need one diffusivity, and that of {} differs from that of {}", b.name,
                         first.name);
  return {};
}

std::unique_ptr<Model> make_walkers(const Job& job, const InitialState& state, bool brownian) {
  std::string why;
  const auto box = cell_box(job.scene, why);
  if (!box) throw EngineError(why);
  return std::make_unique<Walkers>(job, state, *box, brownian);
}

}  // namespace tripoint::lammps
