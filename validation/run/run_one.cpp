// SPDX-License-Identifier: BSD-3-Clause
#include "validation/run/run_one.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "files/foreign_file.hpp"
#include "files/job.hpp"
#include "files/trajectory.hpp"
#include "scene/contact_law.hpp"
#include "validation/audit/audit.hpp"
#include "validation/case/case.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/metrics/metric.hpp"
#include "validation/references/reference.hpp"
#include "validation/run/finished_run.hpp"
#include "validation/run/instructions.hpp"
#include "validation/run/replies.hpp"
#include "validation/run/sandbox.hpp"
#include "validation/run/third_party_reader.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr double read_limit = 300.0;  // [s], for a foreign trajectory
constexpr double reply_limit = 10.0;  // [s], for what else an engine says
// [s]: --check runs nothing, but may set up the scene
constexpr double check_limit = 60.0, check_limit_a_particle = 1e-4;

Outcome failed(Outcome outcome, Status status, const std::string& reason) {
  outcome.status = status;
  outcome.reason = reason;
  outcome.trajectory.reset();
  return outcome;
}

Outcome refused(Outcome outcome, const Refusal& refusal) {
  outcome.explained = refusal.explained;
  return failed(std::move(outcome), Status::refused, refusal.reason);
}

/// Whether an engine has written into the shared file, or taken it away; the runs that follow find it as it
/// was.
bool particles_were_changed(const RunRequest& request) {
  if (!request.particles_hash) return false;
  const std::lock_guard lock(no_spawn_mutex());
  if (file_hash(request.particles) == *request.particles_hash) return false;
  std::error_code none;
  fs::remove_all(request.particles, none);
  fs::create_directories(fs::path(request.particles).parent_path(), none);
  write_particles(request.particles, *request.initial);
  *request.particles_hash = file_hash(request.particles);
  return true;
}

/// Job as it is written into the folder.
Job job_in_folder(const RunRequest& request) {
  Job job = *request.job;
  job.particles = fs::relative(request.particles, request.folder).string();
  job.output = ".";
  if (!is_exact(request.engine->name)) job.reference = {};  // the truth is for those who only state it
  return job;
}

/// Removes the files of an earlier run, except those that a run resumed from a checkpoint in this folder
/// still needs.
void prepare_folder(const RunRequest& request) {
  const fs::path folder(request.folder);
  fs::create_directories(folder);
  forget_finished(request);
  for (const char* stale :
       {"job.json", "result.json", "trajectory.csv", "gauges.csv", "trajectory.xdmf", "log.txt"})
    fs::remove(folder / stale);
  std::error_code ignored;
  const bool goes_on = !request.job->resume.empty() &&
                       fs::equivalent(fs::path(request.job->resume).parent_path(), folder, ignored);
  if (!goes_on) {
    fs::remove(folder / "trajectory.h5");
    for (const auto& checkpoint : checkpoints_in(request.folder)) fs::remove(checkpoint);
  }
  write_job((folder / "job.json").string(), job_in_folder(request));
}

/// Result that an engine states of its run. A copy of us first reads files that others wrote. @throws
/// InputError, EngineError
Result result_of(const RunRequest& request) {
  const std::string file = (fs::path(request.folder) / "result.json").string();
  if (!belongs_to_us(request.engine->executable))
    try_of_third_party([&] { static_cast<void>(read_result(file)); }, {"result.json", request.folder},
                       reply_limit);
  return read_result(file);
}

/// Last words of an engine that we stopped because we are.
std::string words_of_the_interrupted(const RunRequest& request) {
  if (is_no_own_file((fs::path(request.folder) / "result.json").string())) return " without a result";
  try {
    return "; " + result_of(request).message;
  } catch (const std::exception&) {
    return " without a result";
  }
}

ProcessSpec call(const RunRequest& request, const char* verb, double limit) {
  ProcessSpec spec;
  spec.argv = {request.engine->executable, verb, (fs::path(request.folder) / "job.json").string()};
  spec.folder = request.folder;
  spec.environment = request.environment;
  spec.environment["OMP_NUM_THREADS"] = std::to_string(request.job->threads);
  spec.wall_limit = limit;
  spec.most.files = most_files;
  return sandboxed(spec, {request.particles});
}

void take_cost(Outcome& outcome, const ProcessEnd& end) {
  const auto& r = outcome.result;
  outcome.cost = {end.cpu_s,    end.wall_s,
                  r.setup_cpu,  end.peak_bytes,
                  r.pairs,      static_cast<double>(r.steps),
                  r.iterations, r.time_reached,
                  0.0,          end.instructions,
                  {},           end.instructions > 0.0 ? "counter" : ""};
}

/// A second run in a folder of its own, of which nothing but the count is kept.
void count_instructions(const RunRequest& request, ProcessSpec spec, Outcome& outcome) {
  if (is_exact(request.engine->name) || outcome.status != Status::ok || outcome.cost.instructions > 0.0 ||
      !(outcome.cost.cpu_s < request.count_below))
    return;
  const fs::path folder = fs::path(request.folder) / "callgrind";
  std::error_code ignored;
  fs::remove_all(folder, ignored);  // also a link that the engine has left there
  if (!fs::create_directory(folder, ignored)) return;
  auto second = request;
  second.folder = folder.string();
  write_job((folder / "job.json").string(), job_in_folder(second));
  spec.argv.back() = (folder / "job.json").string();
  spec.folder = second.folder;
  spec.log.clear();
  if (const auto count = callgrind_instructions(spec)) {
    outcome.cost.instructions = *count;
    outcome.cost.counted_by = "callgrind";
  }
  fs::remove_all(folder, ignored);
}

/// Bytes that a trajectory can need: inflowing liquid, doubled again and again, stays far below the gibibyte.
std::uintmax_t greatest_trajectory(const RunRequest& request) {
  constexpr std::uintmax_t a_row = 4096, at_least = std::uintmax_t{1} << 30;
  return at_least +
         a_row * request.job->times.size() * (request.initial->size() + request.job->bodies.size());
}

/// A link would lead to files of another engine, or of another run. A pipe would keep its reader waiting. At
/// the time of this check no engine writes any more. @throws EngineError
void expect_own_files(const fs::path& folder) {
  for (const char* name : {"job.json", "result.json", "trajectory.h5", "trajectory.csv", "gauges.csv"})
    if (is_no_own_file((folder / name).string()))
      throw EngineError(fmt::format(
          "{} is a link to another file, or no regular file; refused: an engine writes its own", name));
}

/// Frames that a trajectory may have: a small one may show each step of its engine, a large one little more
/// than the output times.
std::size_t most_frames(const RunRequest& request) {
  constexpr std::size_t rows = 1'000'000;
  return std::max(2 * request.job->times.size() + 16,
                  rows / std::max<std::size_t>(1, request.initial->size()));
}

Trajectory read_particle_trajectory(const RunRequest& request) {
  const fs::path folder(request.folder);
  if (const std::string file = (folder / "trajectory.h5").string(); fs::exists(file))
    return read_trajectory(file, most_frames(request));
  const auto& bodies = request.job->bodies;
  const auto solids = std::count_if(bodies.begin(), bodies.end(), [](const auto& b) { return b.index >= 0; });
  return read_trajectory_csv((folder / "trajectory.csv").string(), *request.initial,
                             static_cast<std::size_t>(solids), most_frames(request));
}

/// Particles, gauges or both: an engine that writes gauges need show no particles.
Trajectory read_files(const RunRequest& request) {
  const fs::path folder(request.folder), gauges = folder / "gauges.csv";
  const bool shows_particles = fs::exists(folder / "trajectory.h5") || fs::exists(folder / "trajectory.csv");
  Trajectory trajectory;
  if (shows_particles || !fs::exists(gauges)) trajectory = read_particle_trajectory(request);
  if (!fs::exists(gauges)) return trajectory;
  std::vector<std::string> names;
  for (const JobGauge& gauge : request.job->gauges) names.push_back(gauge.metric);
  read_gauges_csv(gauges.string(), names, trajectory, most_frames(request));
  return trajectory;
}

/// No library is sure to survive every file. So a confined copy of us reads the files of foreign engines.
std::shared_ptr<const Trajectory> read_any_trajectory(const RunRequest& request) {
  const std::lock_guard lock(no_spawn_mutex());  // Debian's HDF5 is not thread-safe either
  const fs::path folder(request.folder);
  std::string there;
  for (const char* name : {"trajectory.h5", "trajectory.csv", "gauges.csv"}) {
    if (!fs::exists(folder / name)) continue;
    expect_regular_file((folder / name).string(), greatest_trajectory(request));
    if (there.empty()) there = name;
  }
  if (there.empty() || belongs_to_us(request.engine->executable))
    return std::make_shared<Trajectory>(read_files(request));
  const auto bytes =
      read_of_third_party([&] { return packed(read_files(request)); }, {there, request.folder}, read_limit);
  return std::make_shared<Trajectory>(unpacked(bytes, most_frames(request)));
}

double alive_at_the_end(const Trajectory& trajectory) {
  const auto& id = trajectory.frames.back().id;
  return static_cast<double>(std::ranges::count_if(id, [](int i) { return i >= 0; }));
}

std::string describe(const Divergence& d) {
  return fmt::format("{}{}{} in stage {} at t = {:g} s", d.field,
                     d.particle >= 0 ? fmt::format(" of particle {}", d.particle) : "",
                     d.body >= 0 ? fmt::format(" of body {}", d.body) : "", d.stage, d.time);
}

Outcome read_trajectory_of(const RunRequest& request, Outcome outcome) {
  const auto& job = *request.job;
  const double end = job.times.back();
  if (!(std::abs(outcome.result.time_reached - end) <= 1e-9 * end))
    return failed(outcome, Status::error,
                  fmt::format("time not reached: {:g} s of {:g} s", outcome.result.time_reached, end));
  outcome.trajectory = read_any_trajectory(request);
  if (outcome.trajectory->frames.empty())
    return failed(outcome, Status::error, "the trajectory has no frame");
  outcome.cost.particles = alive_at_the_end(*outcome.trajectory);
  if (const auto wrong = audit(job, *request.initial, *outcome.trajectory, outcome.result.readback);
      !wrong.empty())
    return failed(outcome, Status::error, wrong);
  if (const auto other = audit_scene(job, outcome.result.readback); !other.empty()) {
    outcome.comparable = false;
    return failed(outcome, Status::error, "not comparable: " + other);
  }
  return outcome;
}

}  // namespace

Outcome read_back(const RunRequest& request, const ProcessEnd& end) {
  Outcome outcome;
  take_cost(outcome, end);
  using How = ProcessEnd::How;
  if (end.how == How::not_started) return failed(outcome, Status::error, describe(end));
  if (end.how == How::timed_out)
    return failed(outcome, Status::timeout, describe(end) + last_words(end.log_tail));
  const fs::path file = fs::path(request.folder) / "result.json";
  if (end.how == How::interrupted)
    return failed(outcome, Status::killed, describe(end) + words_of_the_interrupted(request));
  if (std::error_code none; !fs::exists(fs::symlink_status(file, none)))
    return failed(outcome, Status::killed, describe(end) + " without a result" + last_words(end.log_tail));
  try {
    expect_own_files(request.folder);
    outcome.result = result_of(request);
    take_cost(outcome, end);
    const auto& r = outcome.result;
    if (r.status == Status::refused) return refused(outcome, refusal_for(r.message));
    if (r.status == Status::diverged)
      return failed(outcome, Status::diverged,
                    r.divergence ? describe(*r.divergence) + (r.message.empty() ? "" : ": " + r.message)
                    : r.message.empty() ? "it gives no place"
                                        : r.message);
    if (r.status != Status::ok)
      return failed(outcome, Status::error,
                    (r.message.empty() ? "status error" : r.message) + last_words(end.log_tail));
    if (end.how != How::exited || end.code != 0)
      return failed(outcome, Status::error, "says ok but " + describe(end) + last_words(end.log_tail));
    if (r.extra.contains("recoveries") || r.extra.contains("left")) outcome.reason = r.message;
    return read_trajectory_of(request, outcome);
  } catch (const std::exception& e) {
    return failed(outcome, Status::error, e.what());
  }
}

namespace {

/// What the scene has and only an engine that names the capability takes; empty = nothing.
std::string not_handed_over(const RunRequest& request) {
  const Scene& scene = request.job->scene;
  const auto lacks = [&](std::string_view capability) {
    return std::ranges::find(request.engine->capabilities, capability) == request.engine->capabilities.end();
  };
  if (common_contact(scene).differs && lacks("contact-pairs"))
    return "one friction and one restitution serve all pairs of it, and the [[contact]] tables of the scene "
           "differ (capability "
           "contact-pairs)";
  if (!scene.forces.empty() && lacks("force")) return "no [[force]] is handed to it (capability force)";
  if (std::ranges::any_of(scene.forces, [](const AppliedForce& f) { return f.has_no_potential(); }) &&
      lacks("torque"))
    return "no torque, and no [[force]] that begins or ends, is handed to it (capability torque)";
  if (!scene.springs.empty() && lacks("spring")) return "no [[spring]] is handed to it (capability spring)";
  if (!scene.joints.empty() && lacks("joint")) return "no [[joint]] is handed to it (capability joint)";
  if ((scene.removes_escaped || !scene.outflows.empty()) && lacks("outflow"))
    return "it removes no particles: no [[outflow]] and no on_escape = \"remove\" (capability outflow)";
  if (!scene.sources.empty() && lacks("source"))
    return "no [[source]] of heat is handed to it (capability source)";
  if (scene.is_planar() && lacks("plane")) return "not comparable in two dimensions (capability plane)";
  return {};
}

}  // namespace

Outcome ask(const RunRequest& request) {
  if (const auto why = not_handed_over(request); !why.empty()) return refused({}, Refusal{why});
  try {
    prepare_folder(request);
  } catch (const std::exception& e) {
    return failed({}, Status::error, std::string("the job could not be written: ") + e.what());
  }
  const auto check =
      run_process(call(request, "--check",
                       check_limit + check_limit_a_particle * static_cast<double>(request.initial->size())));
  if (check.how == ProcessEnd::How::interrupted) return failed({}, Status::killed, describe(check));
  if (check.how == ProcessEnd::How::timed_out)
    return failed({}, Status::timeout, "--check " + describe(check));
  if (check.how != ProcessEnd::How::exited || check.code != 0)
    return failed({}, Status::error, "--check " + describe(check) + last_words(check.log_tail));
  try {
    if (!belongs_to_us(request.engine->executable))
      try_of_third_party([&] { static_cast<void>(refusal_in(check.output)); }, {"what --check printed"},
                         reply_limit);
    if (const auto refusal = refusal_in(check.output)) return refused({}, *refusal);
  } catch (const std::exception& e) {
    return failed({}, Status::error, e.what());
  }
  return {};
}

std::string hash_of(const RunRequest& request) { return run_hash(request, job_text(job_in_folder(request))); }

Outcome run_one(const RunRequest& request) {
  const std::string hash = hash_of(request);
  if (request.keep_finished) {
    if (auto kept = finished_run(request, hash)) return std::move(*kept);
  }
  if (request.before_third_party && !belongs_to_us(request.engine->executable)) request.before_third_party();
  if (auto answer = ask(request); answer.status != Status::ok) return answer;
  auto spec = call(request, "--run", request.wall_limit);
  spec.log = (fs::path(request.folder) / "log.txt").string();
  spec.progress = request.progress;
  spec.status = request.status;
  const auto end = run_process(spec);
  auto outcome = read_back(request, end);
  if (particles_were_changed(request))
    return failed(
        outcome, Status::error,
        "the particles that all engines start from were changed while it ran: they are for reading");
  count_instructions(request, spec, outcome);
  record_finished(request, hash, end, outcome);
  return outcome;
}

MetricValue metric_of(const Case& value, const MetricChoice& choice, const Job& job,
                      const InitialState& initial, const Trajectory& trajectory) {
  const auto& truth = choice.reference.value_or(value.reference);
  std::unique_ptr<Reference> reference;
  try {
    reference = make_reference(truth, job, initial);
  } catch (const InputError&) {
    if (choice.norm != Norm::drift || choice.reference) throw;
    ReferenceChoice none;
    none.kind = ReferenceKind::invariant;
    reference = make_reference(none, job, initial);
  }
  return evaluate(choice, job, initial, trajectory, *reference);
}

std::map<std::string, MetricValue> evaluate_all(const Case& value, const Job& job,
                                                const InitialState& initial, const Trajectory& trajectory) {
  std::map<std::string, MetricValue> metrics;
  for (const auto& choice : value.metrics) {
    try {
      metrics[choice.name] = metric_of(value, choice, job, initial, trajectory);
    } catch (const std::exception& e) {
      metrics[choice.name] = {not_a_number, {}, e.what(), {}, {}};
    }
  }
  return metrics;
}

}  // namespace tripoint
