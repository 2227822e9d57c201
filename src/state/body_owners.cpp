// SPDX-License-Identifier: BSD-3-Clause
#include "state/body_owners.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "scene/scene.hpp"
#include "state/body_table.hpp"

namespace tripoint {
namespace {

bool can_move(const State& state, std::size_t b) {
  return is_alive(state, b) && is_rigid(state, b) &&
         state.bodies[field::body_motion][b] != static_cast<int>(Motion::fixed);
}

/// Calls visit(value) for each column that the motion of a rigid body changes.
template <class Visit>
void each_of_motion(Columns& t, std::size_t b, Visit visit) {
  for (const Field<Vec3>* f :
       {&field::body_centre, &field::body_velocity, &field::body_acceleration, &field::body_angular_velocity,
        &field::body_angular_acceleration, &field::body_angular_momentum})
    visit(t[*f][b]);
  visit(t[field::body_orientation][b]);
}
constexpr std::size_t numbers_of_motion = 6 * 3 + 4;

struct PutMotion {
  std::vector<double>& to;
  void operator()(const Vec3& v) const { to.insert(to.end(), {v.x, v.y, v.z}); }
  void operator()(const Quaternion& q) const { to.insert(to.end(), {q.w, q.x, q.y, q.z}); }
};

struct TakeMotion {
  const double* from;
  void operator()(Vec3& v) {
    v = {from[0], from[1], from[2]};
    from += 3;
  }
  void operator()(Quaternion& q) {
    q = {from[0], from[1], from[2], from[3]};
    from += 4;
  }
};

}  // namespace

/// The upper bits of a product: rows that follow one another come to all processes alike.
std::size_t BodyOwners::owner(std::size_t body) const {
  constexpr std::uint64_t golden = 0x9E3779B97F4A7C15;
  return (((body * golden) >> 32) * subscribers_.size()) >> 32;
}

/// Body by body, in the order in which they come in memory.
void BodyOwners::find_members(const State& state) {
  const auto body_of = [&, body = state.particles[field::body]](std::uint32_t id) {
    return body[state.particles.row(id)];
  };
  std::vector<std::uint32_t> own, counts(state.bodies.size()), ends(state.bodies.size());
  Bodies order;
  for (std::uint32_t id = 0; id < state.halo->owned(); ++id) {
    const int b = body_of(id);
    if (b < 0 || !can_move(state, static_cast<std::size_t>(b))) continue;
    own.push_back(id);
    if (counts[static_cast<std::size_t>(b)]++ == 0) order.push_back(static_cast<std::size_t>(b));
  }
  std::uint32_t next = 0;
  for (const std::size_t b : order) {
    ends[b] = next;
    next += counts[b];
  }
  members_.resize(own.size());
  for (const std::uint32_t id : own) members_[ends[static_cast<std::size_t>(body_of(id))]++] = id;
  has_own_.assign(state.bodies.size(), 0);
  for (const std::size_t b : order) {
    has_own_[b] = 1;
    const auto end = members_.begin() + ends[b];
    std::ranges::sort(end - counts[b], end, {},
                      [number = state.halo->numbers()](std::uint32_t id) { return number[id]; });
  }
}

void BodyOwners::find_kept(const State& state) {
  std::vector<char> is_near = has_own_;
  const auto body = state.particles[field::body];
  for (std::size_t id = state.halo->owned(); id < state.particles.size(); ++id)
    if (const int b = body[state.particles.row(id)]; b >= 0) is_near[static_cast<std::size_t>(b)] = 1;
  for (std::size_t b = 0; b < is_near.size(); ++b) {
    if (!can_move(state, b) || !(is_near[b] || is_here(b))) continue;
    kept_.push_back(b);
    asked_[owner(b)].push_back(b);
  }
}

/// Owners hear who keeps which of their bodies, and who has members of them. @return bodies that a process
/// has begun to keep
std::vector<BodyOwners::Bodies> BodyOwners::ask(const State& state, const std::vector<Bodies>& begun) {
  std::vector<std::vector<double>> questions(asked_.size());
  for (std::size_t process = 0; process < asked_.size(); ++process)
    for (const std::size_t b : asked_[process]) {
      const bool is_new = std::ranges::binary_search(begun[process], b);
      const auto question = {static_cast<double>(b), static_cast<double>(has_own_[b]), is_new ? 1.0 : 0.0};
      questions[process].insert(questions[process].end(), question);
    }
  const std::vector<std::vector<double>> asked_here = state.halo->exchange(questions);
  std::vector<Bodies> begun_there(subscribers_.size());
  for (std::size_t from = 0; from < subscribers_.size(); ++from)
    for (std::size_t k = 0; k < asked_here[from].size(); k += 3) {
      const auto b = static_cast<std::size_t>(asked_here[from][k]);
      subscribers_[from].push_back(b);
      holders_[b] += asked_here[from][k + 1] > 0.0 ? 1 : 0;
      if (asked_here[from][k + 2] > 0.0) begun_there[from].push_back(b);
    }
  return begun_there;
}

/// As the scene is first shared out, every process knows all bodies.
void BodyOwners::share(State& state) {
  const BodyOwners before = std::exchange(*this, {});
  const Halo& halo = *state.halo;
  if (halo.processes() == 1 || state.bodies.size() <= halo.owners_above()) return;
  here_ = halo.process();
  asked_.resize(halo.processes());
  subscribers_.resize(halo.processes());
  is_alone_.resize(state.bodies.size());
  holders_.resize(state.bodies.size());
  find_members(state);
  find_kept(state);
  std::vector<Bodies> begun(asked_.size());
  for (const std::size_t b : kept_)
    if (before.any() && !std::ranges::binary_search(before.kept_, b)) begun[owner(b)].push_back(b);
  const std::vector<Bodies> begun_there = ask(state, begun);
  exchange(
      state, subscribers_, asked_, 1,
      [&](std::size_t b, std::vector<double>& to) { to.push_back(holders_[b] == 1 ? 1.0 : 0.0); },
      [&](std::size_t b, const double* from) { is_alone_[b] = *from > 0.0 ? 1 : 0; });
  exchange(
      state, begun_there, begun, numbers_of_motion,
      [&](std::size_t b, std::vector<double>& to) { each_of_motion(state.bodies, b, PutMotion{to}); },
      [&](std::size_t b, const double* from) { each_of_motion(state.bodies, b, TakeMotion{from}); });
}

void BodyOwners::complete(State& state) const {
  if (!any()) return;
  std::vector<double> own;
  for (const std::size_t b : kept_) {
    if (!is_here(b)) continue;
    own.push_back(static_cast<double>(b));
    each_of_motion(state.bodies, b, PutMotion{own});
  }
  const std::vector<double> all = state.halo->all_of(own);
  for (std::size_t k = 0; k < all.size(); k += 1 + numbers_of_motion)
    each_of_motion(state.bodies, static_cast<std::size_t>(all[k]), TakeMotion{&all[k + 1]});
}

std::vector<double> BodyOwners::to_owners(const State& state, const std::vector<double>& records,
                                          std::size_t width) const {
  std::vector<std::vector<double>> to(subscribers_.size());
  for (auto record = records.begin(); record != records.end(); record += static_cast<std::ptrdiff_t>(width)) {
    std::vector<double>& there = to[owner(static_cast<std::size_t>(record[1]))];
    there.insert(there.end(), record, record + static_cast<std::ptrdiff_t>(width));
  }
  std::vector<double> here;
  for (const std::vector<double>& from : state.halo->exchange(to))
    here.insert(here.end(), from.begin(), from.end());
  return here;
}

void BodyOwners::to_subscribers(const State& state, std::size_t width, const Put& put,
                                const Take& take) const {
  exchange(state, subscribers_, asked_, width, put, take);
}

/// @param there for each process bodies of which it is told   @param here for each process bodies of which it
/// tells this one
void BodyOwners::exchange(const State& state, const std::vector<Bodies>& there,
                          const std::vector<Bodies>& here, std::size_t width, const Put& put,
                          const Take& take) {
  std::vector<std::vector<double>> to(there.size());
  for (std::size_t process = 0; process < to.size(); ++process) {
    to[process].reserve(there[process].size() * width);
    for (const std::size_t b : there[process]) put(b, to[process]);
  }
  const std::vector<std::vector<double>> from = state.halo->exchange(to);
  for (std::size_t process = 0; process < from.size(); ++process)
    for (std::size_t k = 0; k < here[process].size(); ++k) take(here[process][k], &from[process][k * width]);
}

}  // namespace tripoint
