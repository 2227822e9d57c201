// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/cosine_lattice.hpp"

#include <cmath>
#include <numbers>

#include "files/job.hpp"
#include "scene/geometry.hpp"
#include "scene/shared_terms.hpp"
#include "validation/references/cosine_wave.hpp"
#include "validation/references/functions.hpp"

namespace tripoint {
namespace {

using std::numbers::pi;

/// Sum of f(r) over the points of a cubic lattice, or of its layer, with |r| < support, the origin included,
/// in a fixed order.
template <class F>
double lattice_sum(double spacing, double support, bool planar, F f) {
  const int reach = static_cast<int>(std::ceil(support / spacing)), deep = planar ? 0 : reach;
  double sum = 0.0;
  for (int i = -reach; i <= reach; ++i)
    for (int j = -deep; j <= deep; ++j)
      for (int k = -reach; k <= reach; ++k) {
        const Vec3 r{i * spacing, j * spacing, k * spacing};
        if (norm(r) < support) sum += f(r);
      }
  return sum;
}

/// 1 - cos x without its cancellation.
double versine(double x) { return 2.0 * std::sin(0.5 * x) * std::sin(0.5 * x); }

std::unique_ptr<Reference> make_lattice(const ReferenceInput& in) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!is_endless(in.job.scene, axis))
      throw InputError("cosine_mode_lattice holds on the full lattice: make all directions periodic");
  if (in.job.scene.jitter != 0.0) throw InputError("cosine_mode_lattice holds without jitter");
  const auto wave = cosine_wave(in);
  refuse_open_ends(wave, in);
  const double dx = in.job.resolution.spacing > 0.0 ? in.job.resolution.spacing : in.job.scene.spacing;
  const double ratio =
      in.job.resolution.support_ratio > 0.0 ? in.job.resolution.support_ratio : in.job.scene.support_ratio;
  const double support = in.args.number("support_ratio").value_or(ratio) * dx;
  const double damping =
      in.args.form(in.job.scene.mode_of(term::heat)) == Mode::paper
          ? paper_lattice_damping(wave.wave_vector, dx, support, in.job.scene.is_planar())
          : corrected_lattice_damping(wave.wave_vector, dx, support, in.job.scene.is_planar());
  return std::make_unique<DecayingCosine>(in, wave, common_diffusivity(in.job) * damping);
}

}  // namespace

double paper_lattice_damping(const Vec3& k, double dx, double h, bool planar) {
  const double poly6 = planar ? 4.0 / (pi * std::pow(h, 8)) : 315.0 / (64.0 * pi * std::pow(h, 9)),
               laplacian = planar ? 40.0 / (pi * std::pow(h, 5)) : 45.0 / (pi * std::pow(h, 6));
  // m_j/rho_j = 1/this
  const double number_density =
      lattice_sum(dx, h, planar, [&](const Vec3& r) { return poly6 * std::pow(h * h - dot(r, r), 3); });
  return lattice_sum(dx, h, planar,
                     [&](const Vec3& r) { return laplacian * (h - norm(r)) * versine(dot(k, r)); }) /
         number_density;
}

double corrected_lattice_damping(const Vec3& k, double dx, double h, bool planar) {
  // K = -2 W'/r is (1 - q)^3 times a constant, which cancels in the quotient: W = 21/(2 pi h^3) (1 - q)^4 (1
  // + 4 q), q = r/h.
  const auto K = [&](const Vec3& r) { return std::pow(1.0 - norm(r) / h, 3); };
  const double moment = 0.5 * lattice_sum(dx, h, planar, [&](const Vec3& r) { return K(r) * r.x * r.x; });
  return lattice_sum(dx, h, planar, [&](const Vec3& r) { return K(r) * versine(dot(k, r)); }) / moment;
}

ReferenceEntry cosine_mode_lattice_entry() {
  auto args = cosine_arguments();
  args.push_back(
      {"form", "", "paper or corrected; default the run's mode of the heat term", ArgumentType::word});
  args.push_back({"support_ratio", "", "h/dx; default the run's"});
  return {
      {"cosine_mode_lattice", "discrete_exact",
       "eigenvalue of the conduction operator on the cubic lattice: model (21) or section 8.6",
       "decay of one cosine mode by the SPH operator itself, on an unbounded cubic lattice, exact in time",
       args},
      make_lattice};
}

}  // namespace tripoint
