// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/solid_scene.hpp"

#include "files/job.hpp"
#include "scene/geometry.hpp"
#include "scene/shared_terms.hpp"
#include "tables/nearest.hpp"
#include "validation/references/heat_scene.hpp"

namespace tripoint {

ElasticConstants elastic_constants(const Job& job, std::size_t body) {
  const auto& m = job.scene.material(job.bodies.at(body).material);
  if (!m.young_modulus || !m.poisson_ratio)
    throw InputError("material `" + m.name +
                     "` needs young_modulus and poisson_ratio for an exact solution of elasticity");
  return {*m.young_modulus, *m.poisson_ratio};
}

std::optional<std::size_t> named_body(const ReferenceInput& in, const char* argument) {
  const auto name = in.args.word(argument);
  if (!name) return {};
  std::vector<std::string> known;
  for (std::size_t b = 0; b < in.job.bodies.size(); ++b) {
    if (in.job.bodies[b].name == *name) return b;
    known.push_back(in.job.bodies[b].name);
  }
  throw InputError(std::string("argument `") + argument + "` names body `" + printable(*name) + "`" +
                   suggestion(*name, known));
}

std::size_t elastic_body(const ReferenceInput& in, const char* function) {
  if (const auto given = named_body(in, "body")) return *given;
  std::optional<std::size_t> found;
  for (std::size_t b = 0; b < in.job.bodies.size(); ++b) {
    if (in.job.bodies[b].phase != Phase::elastic || in.job.bodies[b].motion != Motion::free) continue;
    if (found)
      throw InputError(std::string(function) +
                       " is of one free elastic body: name it by the argument `body`");
    found = b;
  }
  if (!found) throw InputError(std::string(function) + " needs a free elastic body");
  return *found;
}

std::array<double, 3> extents(const ReferenceInput& in, std::size_t body) {
  std::array<double, 3> size{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& scene = in.job.scene;
    size[k] = is_endless(scene, k) && scene.min && scene.max
                  ? (*scene.max)[k] - (*scene.min)[k]
                  : body_along(k, body, in.job, in.initial).length();
  }
  return size;
}

std::size_t long_axis(const ReferenceInput& in, std::size_t body) {
  const auto size = extents(in, body);
  std::size_t axis = 3;
  for (std::size_t k = 0; k < 3; ++k)
    if (!is_endless(in.job.scene, k) && (axis == 3 || size[k] > size[axis])) axis = k;
  if (axis == 3)
    throw InputError("body `" + in.job.bodies[body].name + "` has no end: every direction is periodic");
  return axis;
}

BarSides bar_sides(const ReferenceInput& in, std::size_t axis) {
  if (const auto word = in.args.word("sides")) {
    if (const auto sides = find_word<BarSides>(*word)) return *sides;
    throw InputError("argument `sides` must be \"free\", \"plane_strain\" or \"confined\"");
  }
  int held = 0;
  for (std::size_t k = 0; k < 3; ++k) held += k != axis && is_held_across(in.job.scene, k) ? 1 : 0;
  return held == 0 ? BarSides::free : held == 1 ? BarSides::plane_strain : BarSides::confined;
}

BarLaw bar_law(const ReferenceInput& in, std::size_t bar, std::size_t axis) {
  const auto elastic = elastic_constants(in.job, bar);
  const auto& material = in.job.scene.material(in.job.bodies[bar].material);
  BarLaw law;
  law.young = elastic.young;
  law.poisson_ratio = elastic.poisson_ratio;
  law.sides = bar_sides(in, axis);
  law.elastic_limit = material.elastic_limit.value_or(law.elastic_limit);
  law.plastic_limit = material.plastic_limit.value_or(law.plastic_limit);
  if (in.args.form(in.job.scene.mode_of(term::elastic)) == Mode::corrected) return law;
  const double given =
      in.job.resolution.support_ratio > 0.0 ? in.job.resolution.support_ratio : in.job.scene.support_ratio;
  const auto lattice = elastic_lattice_factors(in.args.number("support_ratio").value_or(given));
  law.strain_factor = 1.0;
  law.moment = lattice.moment;
  law.volume = lattice.volume;
  return law;
}

}  // namespace tripoint
