// SPDX-License-Identifier: BSD-3-Clause
// Bonds and excluded pairs of the start.
#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"
#include "solids/solid_particles.hpp"

namespace tripoint::solid {
namespace {

/// Which bodies are connected, by rows of the table: a deformable one with itself and with those that it is
/// joined to.
class Joins {
 public:
  explicit Joins(const State& state) : count_(state.bodies.size()), joined_(count_ * count_, 0) {
    for (std::size_t b = 0; b < count_; ++b) {
      if (!is_rigid(state, b)) set(b, b);
      const auto source = static_cast<std::size_t>(state.bodies[field::body_source][b]);
      for (const std::string& name : state.scene.bodies[source].joined_to) {
        const auto other =
            static_cast<std::size_t>(std::ranges::find(state.body_names, name) - state.body_names.begin());
        if (other == count_)
          throw InputError("the body " + state.body_names[b] + " is joined to " + name +
                           ", which is liquid: bonds need two solids");
        if (!is_rigid(state, b) || !is_rigid(state, other)) set(b, other);
      }
    }
  }
  [[nodiscard]] bool any(std::size_t b) const {
    return std::find(row(b), row(b) + count_, 1) != row(b) + count_;
  }
  [[nodiscard]] bool operator()(int a, int b) const {
    return joined_[static_cast<std::size_t>(a) * count_ + static_cast<std::size_t>(b)] != 0;
  }

 private:
  using Row = std::vector<char>::const_iterator;
  [[nodiscard]] Row row(std::size_t b) const {
    return joined_.begin() + static_cast<std::ptrdiff_t>(b * count_);
  }
  void set(std::size_t a, std::size_t b) { joined_[a * count_ + b] = joined_[b * count_ + a] = 1; }
  std::size_t count_;
  std::vector<char> joined_;
};

/// The particles that can have bonds: their ids, and a copy of their places to search in.
struct Candidates {
  std::vector<std::uint32_t> ids;
  Particles places;
};

Candidates candidates_of(const State& state, const Joins& joined) {
  Candidates found;
  const Particles& p = state.particles;
  const auto body = p[field::body];
  for (std::uint32_t id = 0; id < p.size(); ++id) {
    const int b = body[p.row(id)];
    if (b >= 0 && joined.any(static_cast<std::size_t>(b))) found.ids.push_back(id);
  }
  found.places = Particles(found.ids.size(), common_fields(state.box.any()));
  for (std::size_t n = 0; n < found.ids.size(); ++n)
    positions(found.places).set(n, p.position(p.row(found.ids[n])));
  return found;
}

/// Length of a bond over its first one up to which a narrow box is checked [1]: a choice.
constexpr double most_stretch = 1.15;

/// Bonds are told apart by the nearest image, so one must be shorter than half the box, also when stretched.
void refuse_narrow_box(const State& state) {
  const double least = 2.0 * most_stretch * bond_reach(state.scene) * state.scene.spacing;
  for (std::size_t a = 0; a < 3; ++a) {
    if (!state.box.periodic[a] || state.box.width[a] >= least) continue;
    throw InputError(std::string("the periodic direction ") + "xyz"[a] + " is " +
                     std::to_string(state.box.width[a]) + " m wide, and bonds of elastic bodies need " +
                     std::to_string(least) +
                     " m to be told apart: make the domain wider or the spacing smaller");
  }
}

/// Which candidates are members of rigid bodies with a particle of a deformable body within reach. These own
/// strain energy, and need their mates for it.
std::vector<char> joints_of(const State& state, const Joins& joined, const Candidates& found,
                            const Neighbours& near, double reach) {
  std::vector<char> at_joint(found.ids.size(), 0);
  const ElasticParticles is_elastic(state);
  const auto body = state.particles[field::body];
  const auto place = found.places[field::id];
  for (std::size_t n = 0; n < found.ids.size(); ++n) {
    const std::size_t i = state.particles.row(found.ids[n]);
    if (is_elastic(i)) continue;
    at_joint[n] = std::ranges::any_of(near.of(found.places.row(n)), [&](Entry e) {
      const std::size_t j = state.particles.row(found.ids[static_cast<std::size_t>(place[e.row()])]);
      return is_elastic(j) && joined(body[i], body[j]) && norm(separation(state, j, i)) < reach;
    });
  }
  return at_joint;
}

void set_twins(Bonds& bonds, std::span<const std::uint32_t> ids) {
  for (const std::uint32_t id : ids) {
    for (Bond& b : bonds.edit(id)) {
      const auto list = std::as_const(bonds).of(b.other);
      b.twin =
          static_cast<std::uint32_t>(std::ranges::lower_bound(list, id, {}, &Bond::other) - list.begin());
    }
  }
}

}  // namespace

ElasticityKernel bond_kernel(const Scene& scene) {
  return ElasticityKernel(bond_reach(scene) * scene.spacing, scene.space());
}

Bond bond_of(const ElasticityKernel& kernel, const Vec3& x) {
  const double r = norm(x);
  Bond b;
  b.x = x;
  b.gradient = (kernel.derivative(r) / r) * x;
  b.weight = kernel.value(r);
  return b;
}

double own_weight(const Scene& scene, double distance) {
  return WendlandC2(scene.support_ratio * scene.spacing, scene.space()).value(distance);
}

Vec3 separation(const State& state, std::size_t i, std::size_t j, double back) {
  const Particles& p = state.particles;
  const auto place = [&](std::size_t row) {
    return back == 0.0 ? p.position(row) : p.position(row) - back * p.velocity(row);
  };
  return nearest_image(state.box, place(j) - place(i));
}

namespace {

/// How far lists of a particle reach, and which it has.
struct Connecting {
  bool meets;  ///< without pressure excluded pairs have nothing to be kept from
  bool paper;
  double reach;  ///< of bonds [m]

  explicit Connecting(const State& state)
      : meets(state.particles.has(field::force)),
        paper(state.scene.mode_of(term::density) == Mode::paper),
        reach(bond_reach(state.scene) * state.scene.spacing) {}
  [[nodiscard]] double search(const State& state) const {
    return meets && !paper ? std::max(reach, state.support()) : reach;
  }
  [[nodiscard]] bool is_own(bool bonded) const { return meets && (bonded || !paper); }
};

/// Bonds and excluded pairs of candidate n.
void list_partners(State& state, const Joins& joined, const Candidates& found, const Neighbours& near,
                   const std::vector<char>& at_joint, const Connecting& how, std::size_t n) {
  const ElasticityKernel kernel = bond_kernel(state.scene);
  const auto body = state.particles[field::body];
  const auto place = found.places[field::id];
  const std::size_t i = state.particles.row(found.ids[n]);
  std::vector<Bond> bonds;
  std::vector<ExcludedPair> own;
  for (const Entry e : near.of(found.places.row(n))) {
    const auto other = static_cast<std::size_t>(place[e.row()]);
    const std::size_t j = state.particles.row(found.ids[other]);
    const bool mates = body[i] == body[j] && (at_joint[n] || at_joint[other]);
    if (!joined(body[i], body[j]) && !mates) continue;
    const Vec3 x = separation(state, j, i);
    const double r = norm(x);
    const bool bonded = r < how.reach;
    if (bonded) {
      bonds.push_back(bond_of(kernel, x));
      bonds.back().other = found.ids[other];
    }
    if (!mates && how.is_own(bonded))
      own.push_back({found.ids[other], how.paper ? 0.0 : own_weight(state.scene, r)});
  }
  std::ranges::sort(bonds, {}, &Bond::other);
  std::ranges::sort(own, {}, &ExcludedPair::other);
  state.bonds.replace(found.ids[n], bonds);
  if (how.meets) state.own.replace(found.ids[n], own);
}

}  // namespace

void connect_solids(State& state) {
  if (!can_have_deformable_bodies(state.scene)) return;
  const Joins joined(state);
  Candidates found = candidates_of(state, joined);
  if (found.ids.empty()) return;
  refuse_narrow_box(state);
  const Connecting how(state);
  Neighbours near(how.search(state), 0.0, state.box, state.threads);
  near.update(found.places, 0.0);
  const std::vector<char> at_joint = joints_of(state, joined, found, near, how.reach);
  for (std::size_t n = 0; n < found.ids.size(); ++n)
    list_partners(state, joined, found, near, at_joint, how, n);
  set_twins(state.bonds, found.ids);
  state.bonds.compact();
  state.own.compact();
}

}  // namespace tripoint::solid
