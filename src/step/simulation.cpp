// SPDX-License-Identifier: BSD-3-Clause
#include "step/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "scene/effect_rule.hpp"
#include "solids/solid_particles.hpp"
#include "step/guard.hpp"
#include "world/body_table.hpp"

namespace tripoint {
namespace {

constexpr double most_steps = 1e12;        ///< of a run: years on any machine, and still far below what a counter holds
constexpr long steps_between_bounds = 32;  ///< a step that changes more often would break the time symmetry of kick-drift-kick

PeriodicBox box_of(const Scene& scene) {
  PeriodicBox box;
  box.periodic = scene.periodic;
  if (!box.any()) return box;
  if (!scene.min || !scene.max) throw InputError("a periodic scene needs the domain's min and max");
  box.min = *scene.min;
  box.width = *scene.max - *scene.min;
  return box;
}

/// Whether no particle can ever move: then lists need no skin and are never built anew.
bool is_static(const Scene& scene, const InitialState& initial) {
  const auto at_rest = [](const Vec3& v) { return v == Vec3{}; };
  if (!scene.inflows.empty()) return false;
  if (std::ranges::any_of(scene.bodies, [](const Body& b) { return b.phase == Phase::liquid && b.motion != Motion::fixed; }))
    return false;
  if (calls_for(scene, "phase")) return false;
  const bool all_fixed = std::ranges::all_of(scene.bodies, [](const Body& b) { return b.motion == Motion::fixed; });
  if (all_fixed) return scene.events.empty();
  const bool none_prescribed = std::ranges::none_of(scene.bodies, [](const Body& b) { return b.motion == Motion::prescribed; });
  return none_prescribed && at_rest(scene.gravity) && std::ranges::all_of(initial.velocity, at_rest) && scene.events.empty();
}

/// Whether liquids and what is fixed are all that there is, laid at rest.
bool is_still(const Scene& scene, const InitialState& initial) {
  const auto rests = [](const Body& b) { return b.phase == Phase::liquid || b.motion == Motion::fixed; };
  return scene.inflows.empty() && scene.events.empty() && std::ranges::all_of(scene.bodies, rests) &&
         std::ranges::all_of(initial.velocity, [](const Vec3& v) { return v == Vec3{}; });
}

std::vector<FieldInfo> fields_of(const Scene& scene, const std::vector<Active>& effects) {
  std::vector<FieldInfo> fields = common_fields(scene.periodic[0] || scene.periodic[1] || scene.periodic[2]);
  if (can_have_bodies(scene)) {
    const std::vector<FieldInfo> table = body_table_fields();
    fields.insert(fields.end(), table.begin(), table.end());
  }
  for (const Active& a : effects) fields.insert(fields.end(), a.spec.owns.begin(), a.spec.owns.end());
  return fields;
}

}  // namespace

Simulation::Simulation(const Scene& scene, const InitialState& initial, const SimulationOptions& options)
    : options_(options), effects_(active_effects(scene)), passes_(scene, effects_, options.lanes, options.sums_all) {
  set_up(scene, initial);
  if (scene.recovers) start_ = initial;
  update_rates();
  check_finite(world_);
  bound_ = next_bound();
  refuse_large_step();
  if (const double first = scene.time_step.value_or(bound_.dt); scene.end_time > most_steps * first)
    throw InputError(
        fmt::format("the run would take {:.3g} steps: its first step is {:.3g} s, set by {}, and it ends at {:.3g} s; at most "
                    "{:.0e} can be made",
                    scene.end_time / first, first, scene.time_step ? "the scene" : bound_.name, scene.end_time, most_steps));
  book_start(world_, own_ledger());
  happen_until_now();
  keep_good_state();
}

Simulation::Simulation(const Scene& scene, const InitialState& initial, const SimulationOptions& options,
                       const Checkpoint& checkpoint)
    : options_(options), effects_(active_effects(scene)), passes_(scene, effects_, options.lanes, options.sums_all) {
  set_up(scene, initial);
  if (scene.recovers) start_ = initial, recovery_.restore(checkpoint);
  restore(checkpoint);
}

void Simulation::set_up(const Scene& scene, const InitialState& initial) {
  world_.scene = scene;
  world_.threads = options_.threads;
  world_.axis_order = options_.axis_order;
  world_.box = box_of(scene);
  world_.halo = options_.halo;
  declare(world_, effects_);
  guards_.still = is_still(scene, initial);
  load(initial);
  enclosure_ = enclosure_of(scene, initial);
  if (passes_.needed()) {
    PeriodicBox seen = world_.box;
    for (std::size_t a = 0; a < 3 && world_.halo; ++a) seen.periodic[a] = seen.periodic[a] && !world_.halo->splits()[a];
    world_.neighbours.emplace(world_.support(), is_static(scene, initial) ? 0.0 : options_.skin * world_.support(), seen,
                              options_.threads, passes_.lanes());
  }
  plan_events();
}

void Simulation::load(const InitialState& initial) {
  const std::vector<FieldInfo> fields = fields_of(world_.scene, effects_);
  world_.particles = Particles(initial.size(), fields);
  world_.bodies = Columns(0, Per::body, fields);
  Particles& p = world_.particles;
  const auto x = positions(p), v = velocities(p);
  for (std::size_t i = 0; i < initial.size(); ++i) {
    x.set(i, initial.position[i]);
    v.set(i, initial.velocity[i]);
    p[field::mass][i] = initial.mass[i];
    p[field::phase][i] = initial.phase[i];
    p[field::body][i] = initial.body[i];
    p[field::material][i] = initial.material[i];
    p[field::source][i] = initial.source[i];
  }
  add_scene_bodies(world_);
  solid::connect_solids(world_);
  for (const Active& a : effects_) {
    const DeclaredView view(world_, a);
    a.effect->load(world_, initial);
  }
}

void Simulation::plan_events() {
  const auto& events = world_.scene.events;
  for (std::size_t n = 0; n < events.size(); ++n) {
    moments_.push_back({events[n].time, n, true});
    if (events[n].until) moments_.push_back({*events[n].until, n, false});
  }
  std::ranges::stable_sort(moments_, {}, &Moment::time);
}

void Simulation::happen_until_now() {
  bool any = false;
  for (; next_moment_ < moments_.size() && moments_[next_moment_].time <= world_.time; ++next_moment_) {
    const Moment& m = moments_[next_moment_];
    for (const Active& a : effects_) {
      const DeclaredView view(world_, a);
      a.effect->happen(world_, {world_.scene.events[m.event], m.begins});
    }
    any = true;
  }
  if (!any) return;
  world_.moved = true;
  passes_.forget_clusters();
  update_rates();
  check_finite(world_);
}

bool Simulation::advance_to(double time, const std::function<bool()>& go_on) {
  while (world_.time < time) {
    const auto begin = std::chrono::steady_clock::now();
    try {
      move_on(time);
    } catch (const Diverged& failure) {
      if (!world_.scene.recovers) throw;
      go_back(failure);
    }
    if (options_.gives_way && options_.threads > 1) choose_threads(begin);
    if (go_on && !go_on()) return world_.time >= time;
  }
  return true;
}

void Simulation::use_threads(int threads) {
  world_.threads = threads;
  if (world_.neighbours) world_.neighbours->use_threads(threads);
}

void Simulation::choose_threads(std::chrono::steady_clock::time_point begin) {
  const long pushed = times_pushed_aside();
  threads_.took(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), pushed - pushed_aside_);
  pushed_aside_ = pushed;
  if (threads_.now() != world_.threads) use_threads(threads_.now());
}

void Simulation::move_on(double time) {
  const double stop = next_moment_ < moments_.size() ? std::min(time, moments_[next_moment_].time) : time;
  clock_.start();
  if (stretch_is_over(stop)) plan_stretch(stop);
  clock_.ends(Stage::bound);
  step(stretch_.next_end(dt_));
  ++stretch_.done;
  happen_until_now();
  if (world_.scene.recovers && steps_ % Recovery::steps_between_states == 0) keep_good_state();
}

void Simulation::keep_good_state() {
  if (world_.scene.recovers) recovery_.keep(state(), world_.time);
}

/// Everything as it was at a good state, but for the share of the step.
void Simulation::go_back(const Diverged& failure) {
  const Checkpoint& good = recovery_.go_back(failure);
  const Scene scene = std::move(world_.scene);
  world_ = World{};
  moments_.clear();
  set_up(scene, start_);
  restore(good);
  stretch_ = {};
}

bool Simulation::stretch_is_over(double stop) const {
  const Stretch& s = stretch_;
  if (s.done == s.count || s.end != stop || s.done % steps_between_bounds == 0) return true;
  return next_bound().dt < dt_;
}

void Simulation::plan_stretch(double stop) {
  bound_ = next_bound();
  refuse_large_step();
  check_step(world_, bound_, guards_);
  const long n = steps_to(stop);
  stretch_ = {world_.time, stop, n, 0};
  dt_ = (stop - world_.time) / static_cast<double>(n);
}

/// Equal steps, none longer than the scene's own or the bound.
long Simulation::steps_to(double time) const {
  const double length = time - world_.time, most = recovery_.share() * world_.scene.time_step.value_or(bound_.dt);
  if (length > most_steps * most) refuse_small_step(world_, most, length, world_.scene.time_step ? "scene" : bound_.name);
  return std::max(1L, static_cast<long>(std::ceil(length / most - 1e-9)));
}

/// Rates and dt_ hold for the time on entry, and again on exit, at `end`.
void Simulation::step(double end) {
  world_.next_time = end;
  clock_.start();
  const bool starts_late = steps_ == 0 && world_.scene.mode_of(Term::time) == Mode::paper;
  if (!starts_late) run(&Effect::kick, 0.5 * dt_);  // v of bodies; the paper's leapfrog starts without its half kick
  clock_.ends(Stage::kick);
  run(&Effect::drift, dt_);  // r; rotation (19)-(20); prescribed motion; T or H by its rate (21)
  clock_.ends(Stage::drift);
  world_.time = end;
  update_rates();
  bool again = false;
  for (const Active& a : effects_) {
    const DeclaredView view(world_, a);
    again = a.effect->correct(world_, dt_) || again;
  }
  if (again) pass(PassName::heat);  // second stage of two-stage schemes
  clock_.ends(Stage::correct);
  run(&Effect::kick, 0.5 * dt_);
  clock_.ends(Stage::kick);
  ++steps_;
  check();
  clock_.ends(Stage::check);
}

/// Guards, none of which changes anything; energy is summed over all particles and bonds, so only now and then.
void Simulation::check() {
  constexpr long steps_between_ledgers = 128, steps_between_looks = 32;
  check_finite(world_);
  if (enclosure_.given || steps_ % steps_between_looks == 0) check_escape(world_, enclosure_);
  for (const Active& a : effects_) {
    const DeclaredView view(world_, a);
    a.effect->check(world_);
  }
  if (steps_ % steps_between_ledgers != 0) return;
  double start_potential = world_.booked[account::start_potential];
  if (world_.halo) world_.halo->add({&start_potential, 1});
  check_energy(world_, ledger(), start_potential, dt_, guards_);
}

void Simulation::update_rates() {
  clock_.start();
  change();
  clock_.ends(Stage::change);
  if (world_.halo) follow_halo();
  if (world_.neighbours) update_lists();
  clock_.ends(Stage::search);
  if (world_.moved) pass(PassName::density);  // (4), moments: of places only
  clock_.ends(Stage::density);
  run(&Effect::state);
  world_.moved = false;
  clock_.ends(Stage::state);
  pass(PassName::rates);  // (7), (8), (21)
  clock_.ends(Stage::rates);
  run(&Effect::bonds);  // (12), hourglass
  clock_.ends(Stage::bonds);
}

void Simulation::update_lists() {
  world_.neighbours->update(world_.particles, world_.time, [this] { return resting(); });
  if (world_.halo && !world_.neighbours->marked()) mark_copies();
  if (world_.neighbours->marked() && world_.change.empty()) return;
  world_.neighbours->mark_own(world_.particles, world_.own);
  passes_.forget_clusters();
}

/// Whether particles are to be shared out anew: where there are no neighbour lists, as if there were.
bool Simulation::outdated() const {
  const Particles& p = world_.particles;
  if (world_.neighbours) return world_.neighbours->outdated(p);
  if (shared_at_.size() != p.size()) return true;
  const double limit = 0.5 * options_.skin * world_.support();
  const auto x = positions(p);
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!(norm(x.at(i) - shared_at_[i]) <= limit)) return true;
  return false;
}

/// Where one process's lists are outdated, particles go to who has their place now, and all make new lists.
void Simulation::follow_halo() {
  double any = outdated() ? -1.0 : 0.0;
  std::string unused;
  world_.halo->take_least(any, unused);
  if (any == 0.0) return;
  world_.halo->migrate(world_.particles, world_.bonds, world_.own, world_.box);
  for (const Active& a : effects_) a.effect->renumber(world_);
  if (world_.neighbours) return world_.neighbours->forget();
  mark_copies();
  const auto x = positions(world_.particles);
  shared_at_.clear();
  for (std::size_t i = 0; i < world_.particles.size(); ++i) shared_at_.push_back(x.at(i));
}

void Simulation::mark_copies() {
  const auto id = world_.particles[field::id];
  world_.copies.resize(id.size());
  for (std::size_t i = 0; i < id.size(); ++i) world_.copies[i] = static_cast<std::size_t>(id[i]) >= world_.halo->owned();
}

/// Members of fixed bodies, where nothing is to come that could move one.
Resting Simulation::resting() const {
  const std::optional<double> beyond = passes_.sleeps_beyond();
  if (!beyond || world_.halo || next_moment_ < moments_.size()) return {};
  Resting rest{std::vector<char>(world_.bodies.size()), *beyond};
  for (std::size_t b = 0; b < rest.bodies.size(); ++b) {
    if (!is_alive(world_, b) || !is_rigid(world_, b)) continue;
    rest.bodies[b] = world_.bodies[field::body_motion][b] == static_cast<int>(Motion::fixed);
    if (!rest.bodies[b] && !world_.placed) return {};  // as it moves for the first time, all are put to their places
  }
  if (std::ranges::find(rest.bodies, 1) == rest.bodies.end()) return {};
  return rest;
}

/// Fig. 5: melt, solidify, merge, split, fracture, before any rate of the new time.
void Simulation::change() {
  world_.change = {};
  run(&Effect::change);
  if (world_.change.empty()) return;
  run(&Effect::adopt);
  run(&Effect::settle);
  world_.moved = true;
}

void Simulation::pass(PassName name) {
  if (!passes_.needed()) return;
  run(&Effect::clear, name);
  passes_.run(name, world_);
  if (name != PassName::density) pairs_ += static_cast<double>(world_.neighbours->entries());
}

TimeStepBound Simulation::next_bound() const {
  TimeStepBound least;
  for (const Active& a : effects_) {
    const DeclaredView view(world_, a);
    const TimeStepBound b = a.effect->max_dt(world_);
    tighten(least, b.dt, b.name);
  }
  if (world_.halo) world_.halo->take_least(least.dt, least.name);
  return least;
}

void Simulation::refuse_large_step() const {
  const auto& given = world_.scene.time_step;
  if (!given || options_.force_time_step || recovery_.share() * *given <= bound_.dt * (1.0 + 1e-9)) return;
  if (steps_ > 0) refuse_step(world_, recovery_.share() * *given, bound_.dt, bound_.name);
  throw InputError(
      fmt::format("time_step {:.4g} s is above the bound of {}, {:.4g} s: make it smaller, or run all the same with "
                  "[engines.tripoint] settings = {{ force_time_step = true }}",
                  *given, bound_.name, bound_.dt));
}

std::string Simulation::time_step_set_by() const {
  if (world_.scene.time_step) return "scene";
  return bound_.name == "none" ? "output" : bound_.name;
}

/// What every process has is added up: all entries are sums over particles, or told by one process alone.
Ledger Simulation::ledger() const {
  Ledger sum = own_ledger();
  if (!world_.halo) return sum;
  std::vector<double> numbers{sum.mass};
  for (const Vec3* v : {&sum.momentum, &sum.angular_momentum}) numbers.insert(numbers.end(), {v->x, v->y, v->z});
  for (const auto& [entry, energy] : sum.energy) numbers.push_back(energy);
  world_.halo->add(numbers);
  sum.mass = numbers[0];
  sum.momentum = {numbers[1], numbers[2], numbers[3]}, sum.angular_momentum = {numbers[4], numbers[5], numbers[6]};
  std::size_t next = 7;
  for (auto& [entry, energy] : sum.energy) energy = numbers[next++];
  return sum;
}

Ledger Simulation::own_ledger() const {
  Ledger sum;
  const auto m = world_.particles[field::mass];
  for (std::size_t id = 0; id < m.size(); ++id)
    if (const std::size_t row = world_.particles.row(id); world_.owns(row)) sum.mass += m[row];
  for (const Active& a : effects_) {
    const DeclaredView view(world_, a);
    a.effect->add_to(world_, sum);
  }
  close_ledger(world_, sum);
  return sum;
}

}  // namespace tripoint
