// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "effects/fluid_lab.hpp"
#include "liquids/fields.hpp"

namespace tripoint {
namespace {

/// A jittered column that is pressed on a jittered floor.
lab::Lab pressed_column(ViscosityForm form = ViscosityForm::laplacian, double scene_jitter = 0.0) {
  lab::Lab lab = lab::column(4, 6, 1.0, 1000.0, 10.0);
  lab.scene.jitter = scene_jitter;
  lab.scene.viscosity_form = form;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-0.1 * lab.scene.spacing, 0.1 * lab.scene.spacing);
  for (std::size_t i = 0; i < lab.initial.size(); ++i) {
    if (lab.initial.body[i] < 0) lab.initial.position[i].z *= 0.9;
    lab.initial.position[i] += {uniform(random), uniform(random), uniform(random)};
  }
  return lab;
}

double compression(const lab::Lab& lab) {
  return Simulation(lab.scene, lab.initial).ledger().energy.at("compression");
}

void expect_gradient(const lab::Lab& lab) {
  const Simulation s(lab.scene, lab.initial);
  const Particles& p = s.state().particles;
  const auto F = triple(p, field::force);
  int looked_at = 0;
  for (std::size_t id = 0; id < lab.initial.size(); id += 5) {
    if (lab.initial.body[id] >= 0 || lab.initial.position[id].z > lab.scene.spacing) continue;
    ++looked_at;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double step = 1e-5 * lab.scene.spacing;
      lab::Lab ahead = lab, behind = lab;
      ahead.initial.position[id][axis] += step;
      behind.initial.position[id][axis] -= step;
      const double slope = (compression(ahead) - compression(behind)) / (2.0 * step);
      EXPECT_NEAR(F.at(p.row(id))[axis], -slope, 1e-5 * norm(F.at(p.row(id))))
          << "particle " << id << ", axis " << axis;  // round-off of energies over a step of 1e-5
    }
  }
  EXPECT_GT(looked_at, 5);
}

TEST(Walls, PressByTheGradientOfTheEnergyThatTheLedgerHolds) { expect_gradient(pressed_column()); }
TEST(Walls, PressByThatGradientWhereTheyAreFeltFromTheirLattice) {
  expect_gradient(pressed_column(ViscosityForm::laplacian, 0.1));
}

TEST(Walls, ThatDoNotJitterAreFeltWhereTheyAre) {
  const auto forces = [](double scene_jitter, bool jitters) {
    lab::Lab lab = pressed_column(ViscosityForm::laplacian, scene_jitter);
    for (Body& b : lab.scene.bodies) b.jitters = jitters;
    const Simulation s(lab.scene, lab.initial);
    const Particles& p = s.state().particles;
    std::vector<Vec3> of_id;
    for (std::size_t id = 0; id < p.size(); ++id) of_id.push_back(p.vector(p.row(id), field::force));
    return of_id;
  };
  EXPECT_EQ(forces(0.1, false), forces(0.0, true));
  EXPECT_NE(forces(0.1, true), forces(0.0, true));
}

/// No step forms what none reads: the force on what is fixed, and densities behind faces.
TEST(Walls, AreShownTheForceAndDensityThatEveryStepWouldForm) {
  for (const double jitter : {0.0, 0.1}) {
    const lab::Lab lab = pressed_column(ViscosityForm::laplacian, jitter);
    Simulation some(lab.scene, lab.initial), all(lab.scene, lab.initial, {.sums_all = true});
    some.advance_to(1.0, [&] { return some.state().neighbours->rebuilds() < 5 && some.steps() < 3000; });
    all.advance_to(1.0, [&] { return all.steps() < some.steps(); });
    const Particles &p = some.state().particles, &q = all.state().particles;
    ASSERT_LT(p.moving(), p.size()) << "fixed rows are apart from the third lists on";
    ASSERT_EQ(some.steps(), all.steps());
    double greatest = 0.0;
    for (std::size_t id = 0; id < lab.initial.size(); ++id) {
      const std::size_t i = p.row(id), j = q.row(id);
      ASSERT_EQ(p.position(i), q.position(j));
      if (lab.initial.body[id] < 0) continue;
      for (const Field<double>* f :
           {&field::force.x, &field::force.y, &field::force.z, &field::viscous_force.x,
            &field::viscous_velocity.x, &field::number_density, &field::number_density_before})
        EXPECT_EQ(p[*f][i], q[*f][j]) << f->name << " of particle " << id << ", jitter " << jitter;
      greatest = std::max(greatest, std::abs(p[field::force.z][i]));
    }
    EXPECT_GT(greatest, 0.0);
  }
}

TEST(Walls, HaveTheMeanDensityOfTheirFaceAndTheRestDensityBehindIt) {
  const lab::Lab lab = pressed_column();
  const Simulation s(lab.scene, lab.initial);
  const Particles& p = s.state().particles;
  const auto own = [&](std::size_t id) {
    return p[field::mass][p.row(id)] * p[field::number_density][p.row(id)] / 1000.0;
  };
  double least = 1e300, most = 0.0, least_own = 1e300, most_own = 0.0;
  for (std::size_t id = 0; id < lab.initial.size(); ++id) {
    if (lab.initial.body[id] < 0) continue;
    const double z = lab.initial.position[id].z / lab.scene.spacing,
                 relative = p[field::density][p.row(id)] / 1000.0;
    if (z > -2.0 && z < -1.0) {
      EXPECT_EQ(relative, 1.0) << "of a particle between two layers";
    }
    if (z < -1.0) continue;
    least = std::min(least, relative);
    most = std::max(most, relative);
    least_own = std::min(least_own, own(id));
    most_own = std::max(most_own, own(id));
  }
  EXPECT_GT(least, 1.0) << "the liquid is pressed on the floor";
  EXPECT_LT(most - least, 0.5 * (most_own - least_own))
      << "the mean of 9 particles whose scatter is independent would have a third";
}

/// Jitter moves the layers behind a face, which press on nothing, nearer to it and farther from it. Fixed
/// walls of a jittered scene read their lattice.
TEST(Walls, OfAJitteredSceneDoNotLookAtWhereTheJitterPutTheLayersBehindTheirFace) {
  const auto face = [](double scene_jitter, double moved, double every_second) {
    lab::Lab lab = lab::column(4, 6, 1.0, 1000.0, 10.0);
    lab.scene.jitter = scene_jitter;
    int n = 0;
    for (Vec3& r : lab.initial.position)
      if (r.z < -lab.scene.spacing) r.z += (++n % 2 == 0 ? every_second : moved) * lab.scene.spacing;
    const Simulation s(lab.scene, lab.initial);
    const auto rho = lab::by_id(s, field::density);
    for (std::size_t id = 0; id < rho.size(); ++id)
      if (const double z = lab.initial.position[id].z; z < 0.0 && z > -lab.scene.spacing)
        return rho[id] / 1000.0;
    return 0.0;
  };
  EXPECT_NEAR(face(0.1, 0.1, -0.1), 1.0, 1e-6);  // what jitter adds is kept to a millionth
  EXPECT_NEAR(face(0.1, -0.1, 0.1), 1.0, 1e-6);
  EXPECT_GT(face(0.0, 0.1, 0.1), 1.03);  // whoever lays a wall denser than the lattice has it denser
  EXPECT_NEAR(face(0.1, 0.0, 0.0), face(0.0, 0.0, 0.0), 1e-12);
}

/// Jitter puts a fixed wall off its lattice, and nothing evens that out. Liquid feels the same wall all the
/// same: its densities and forces are those over a wall on the lattice, but for pairs about the support apart
/// and a millionth of a spacing.
TEST(Walls, OfAJitteredSceneAreFeltFromTheirLattice) {
  const auto over = [](double scene_jitter, double amplitude) {
    lab::Lab lab = lab::column(4, 6, 0.0, 1000.0, 10.0);
    lab.scene.jitter = scene_jitter;
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform(-amplitude * lab.scene.spacing,
                                                   amplitude * lab.scene.spacing);
    Vec3 shift;
    bool back = false;  // every second particle goes where the one before did not: the wall as a whole stays
    for (std::size_t i = 0; i < lab.initial.size(); ++i) {
      if (lab.initial.body[i] < 0) continue;
      shift = back ? -shift : Vec3{uniform(random), uniform(random), uniform(random)};
      lab.initial.position[i] += shift;
      back = !back;
    }
    for (Vec3& r : lab.initial.position) r.z *= r.z > 0.0 ? 0.95 : 1.0;
    const Simulation s(lab.scene, lab.initial);
    const auto rho = lab::by_id(s, field::density), f = lab::by_id(s, field::force.z);
    std::array<std::vector<double>, 2> lowest;
    for (std::size_t id = 0; id < rho.size(); ++id)
      if (const double z = lab.initial.position[id].z; lab.initial.body[id] < 0 && z < lab.scene.spacing) {
        lowest[0].push_back(rho[id] / 1000.0);
        lowest[1].push_back(f[id]);
      }
    return lowest;
  };
  const auto farthest = [](const std::vector<double>& a, const std::vector<double>& b) {
    double most = 0.0;
    for (std::size_t n = 0; n < a.size(); ++n) most = std::max(most, std::abs(a[n] - b[n]));
    return most;
  };
  // No pair has a core
  const auto lattice = over(0.1, 0.0), jittered = over(0.1, 0.05), as_it_is = over(0.0, 0.05);
  ASSERT_EQ(lattice[0].size(), 36U);
  for (std::size_t column = 0; column < 2; ++column)
    EXPECT_LT(farthest(jittered[column], lattice[column]), 1e-3 * farthest(as_it_is[column], lattice[column]))
        << (column == 0 ? "density" : "force");
}

/// Of viscous forces on liquid at random velocities beside a wall at rest.
double viscous_power(ViscosityForm form, unsigned seed) {
  lab::Lab lab = pressed_column(form);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  lab::set_velocity(lab, [&](const Vec3&) { return Vec3{normal(random), normal(random), normal(random)}; });
  const Simulation s(lab.scene, lab.initial);
  const Particles& p = s.state().particles;
  const auto F = triple(p, field::viscous_force);
  double power = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p[field::body][i] < 0) power += dot(F.at(i), p.velocity(i));
  return power;
}

TEST(Walls, TakeEnergyByViscosityInBothForms) {
  for (const ViscosityForm form : {ViscosityForm::laplacian, ViscosityForm::central})
    for (unsigned seed = 1; seed <= 20; ++seed)
      EXPECT_LT(viscous_power(form, seed), 0.0) << static_cast<int>(form) << ", seed " << seed;
}

TEST(Walls, DoNoWorkWhereTheyAreFixedAndTheStepsLittle) {
  lab::Lab lab = lab::column(5, 6, 1e-3, 1000.0, 10.0);
  lab::jitter(lab, 0.05);
  Simulation s(lab.scene, lab.initial);
  const double weight = 1000.0 * 10.0 * 1.2 * 1.2;  // rho g H V, H = 1 m
  double kinetic = 0.0;
  for (int n = 1; n <= 20; ++n) {
    s.advance_to(0.1 * n);
    const Ledger now = s.ledger();
    EXPECT_EQ(now.energy.at("walls"), 0.0);
    EXPECT_GE(now.energy.at("bulk_viscous"), 0.0);
    kinetic = now.energy.at("kinetic");
  }
  // Falls with the square of the step
  EXPECT_LT(std::abs(s.ledger().energy.at("time_integration")), 1e-3 * weight);
  EXPECT_LT(kinetic, 2e-3 * weight);  // what the start lets go is of the order of (g H/c)^2
}

}  // namespace
}  // namespace tripoint
