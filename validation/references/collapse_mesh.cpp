// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/collapse_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <map>
#include <mutex>
#include <tuple>

#include "core/errors.hpp"

namespace tripoint {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double>;

constexpr double step_of_cell = 0.05;
constexpr double kept = 1e-11;  // error of an area, over the area, at which a step ends
constexpr int most_rounds = 60;

}  // namespace

struct CollapseMesh::System {
  /// Corners of a cell, counter-clockwise.
  struct Corners {
    std::array<Eigen::Index, 4> node;
    [[nodiscard]] double x(const Vector& v, std::size_t k) const { return v[2 * node[k]]; }
    [[nodiscard]] double y(const Vector& v, std::size_t k) const { return v[2 * node[k] + 1]; }
    [[nodiscard]] double area(const Vector& p) const {
      return 0.5 * ((x(p, 2) - x(p, 0)) * (y(p, 3) - y(p, 1)) - (x(p, 3) - x(p, 1)) * (y(p, 2) - y(p, 0)));
    }
    /// Derivative of the area by the place of corner k.
    [[nodiscard]] std::array<double, 2> gradient(const Vector& p, std::size_t k) const {
      const std::size_t next = (k + 1) % 4, last = (k + 3) % 4;
      return {0.5 * (y(p, next) - y(p, last)), 0.5 * (x(p, last) - x(p, next))};
    }
  };

  System(double height, int cells, double damping)
      : across(cells),
        up(std::max(1, static_cast<int>(std::lround(height * cells)))),
        dt(step_of_cell / cells),
        damping_force(damping * std::sqrt(height) / (16.0 * cells)),
        cell_area(height / (static_cast<double>(across) * up)) {
    const auto nodes = static_cast<Eigen::Index>(across + 1) * (up + 1);
    place.resize(2 * nodes);
    fall = Vector::Zero(2 * nodes);
    mass = Vector::Zero(nodes);
    for (int i = 0; i <= across; ++i)
      for (int j = 0; j <= up; ++j) {
        place[2 * node(i, j)] = static_cast<double>(i) / across;
        place[2 * node(i, j) + 1] = height * j / up;
        fall[2 * node(i, j) + 1] = j == 0 ? 0.0 : -1.0;
      }
    for (int i = 0; i < across; ++i)
      for (int j = 0; j < up; ++j) {
        corners.push_back({{node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)}});
        for (const auto n : corners.back().node) mass[n] += 0.25 * cell_area;
      }
    mobility.resize(2 * nodes);
    for (Eigen::Index n = 0; n < nodes; ++n) mobility[2 * n] = mobility[2 * n + 1] = 1.0 / mass[n];
    for (int j = 0; j <= up; ++j) mobility[2 * node(0, j)] = 0.0;          // the wall
    for (int i = 0; i <= across; ++i) mobility[2 * node(i, 0) + 1] = 0.0;  // the floor
    velocity = Vector::Zero(2 * nodes);
    multiplier = Vector::Zero(static_cast<Eigen::Index>(corners.size()));
    first_energy = energy();
  }

  [[nodiscard]] Eigen::Index node(int i, int j) const { return static_cast<Eigen::Index>(i) * (up + 1) + j; }

  [[nodiscard]] double energy() const {
    double sum = 0.0;
    for (Eigen::Index n = 0; n < mass.size(); ++n)
      sum += mass[n] * (place[2 * n + 1] + 0.5 * (velocity[2 * n] * velocity[2 * n] +
                                                  velocity[2 * n + 1] * velocity[2 * n + 1]));
    return sum;
  }

  /// Area of each cell less that of the start.
  [[nodiscard]] Vector excess(const Vector& at) const {
    Vector out(static_cast<Eigen::Index>(corners.size()));
    for (std::size_t c = 0; c < corners.size(); ++c)
      out[static_cast<Eigen::Index>(c)] = corners[c].area(at) - cell_area;
    return out;
  }

  [[nodiscard]] Matrix area_gradient() const {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(8 * corners.size());
    for (std::size_t c = 0; c < corners.size(); ++c)
      for (std::size_t k = 0; k < 4; ++k) {
        const auto g = corners[c].gradient(place, k);
        const auto row = static_cast<int>(c), column = static_cast<int>(2 * corners[c].node[k]);
        entries.emplace_back(row, column, g[0]);
        entries.emplace_back(row, column + 1, g[1]);
      }
    Matrix out(static_cast<Eigen::Index>(corners.size()), place.size());
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
  }

  /// Force against the motion of each cell that is neither uniform nor linear in place: corners take turns in
  /// it.
  [[nodiscard]] Vector damped() const {
    constexpr std::array<double, 4> turns{1.0, -1.0, 1.0, -1.0};
    Vector force = Vector::Zero(place.size());
    for (const auto& c : corners) {
      std::array<double, 4> shape = turns;
      double along_x = 0.0, along_y = 0.0;
      for (std::size_t k = 0; k < 4; ++k) {
        along_x += turns[k] * c.x(place, k);
        along_y += turns[k] * c.y(place, k);
      }
      for (std::size_t k = 0; k < 4; ++k) {
        const auto g = c.gradient(place, k);
        shape[k] -= (g[0] * along_x + g[1] * along_y) / cell_area;
      }
      double x = 0.0, y = 0.0;
      for (std::size_t k = 0; k < 4; ++k) {
        x += shape[k] * c.x(velocity, k);
        y += shape[k] * c.y(velocity, k);
      }
      for (std::size_t k = 0; k < 4; ++k) {
        force[2 * c.node[k]] -= damping_force * shape[k] * x;
        force[2 * c.node[k] + 1] -= damping_force * shape[k] * y;
      }
    }
    return force;
  }

  void step() {
    velocity += dt * mobility.cwiseProduct(damped());
    Vector next = place + dt * velocity + dt * dt * fall;
    const Matrix gradient = area_gradient();
    const Matrix push = mobility.asDiagonal() * Matrix(gradient.transpose());
    solver.compute(gradient * push);
    multiplier.setZero();
    int round = 0;
    for (Vector error = excess(next); !(error.cwiseAbs().maxCoeff() <= kept * cell_area);
         error = excess(next)) {  // not a number, too
      if (++round > most_rounds || !error.allFinite())
        throw InputError("collapsing_column: the mesh is too distorted to go on");
      const Vector more = solver.solve(error);
      next -= push * more;
      multiplier -= more;
    }
    velocity = (next - place) / dt;
    place = next;
  }

  int across, up;
  double dt, damping_force, cell_area;
  std::vector<Corners> corners;
  Vector place, velocity, fall, mass, mobility, multiplier;
  Eigen::SimplicialLDLT<Matrix> solver;
  double first_energy = 0.0;
};

CollapseMesh::CollapseMesh(const LiquidColumn& column, int cells, double damping)
    : column_(column), system_(std::make_unique<System>(column.height / column.width, cells, damping)) {}
CollapseMesh::~CollapseMesh() = default;

double CollapseMesh::step_size() const { return system_->dt * std::sqrt(column_.width / column_.gravity); }

void CollapseMesh::step() {
  system_->step();
  time_ += step_size();
}

double CollapseMesh::front() const {
  return column_.width * system_->place[2 * system_->node(system_->across, 0)];
}
double CollapseMesh::top() const {
  return column_.width * system_->place[2 * system_->node(0, system_->up) + 1];
}
double CollapseMesh::energy() const { return system_->energy() / system_->first_energy; }
double CollapseMesh::greatest_area_error() const {
  return system_->excess(system_->place).cwiseAbs().maxCoeff() / system_->cell_area;
}
std::array<int, 2> CollapseMesh::cells() const { return {system_->across, system_->up}; }
double CollapseMesh::pressure(int i, int j) const {
  return system_->multiplier[static_cast<Eigen::Index>(i) * system_->up + j] / (system_->dt * system_->dt);
}

double CollapseMesh::pressure_at(double x, double y) const {
  const auto& s = *system_;
  const Eigen::Vector2d at(x / column_.width, y / column_.width);
  const auto middle = [&](int i, int j) {
    const auto& corners =
        s.corners[static_cast<std::size_t>(i) * static_cast<std::size_t>(s.up) + static_cast<std::size_t>(j)];
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < 4; ++k)
      sum += 0.25 * Eigen::Vector2d(corners.x(s.place, k), corners.y(s.place, k));
    return sum;
  };
  std::array<int, 2> nearest{};
  for (int i = 0; i < s.across; ++i)
    for (int j = 0; j < s.up; ++j)
      if ((middle(i, j) - at).norm() < (middle(nearest[0], nearest[1]) - at).norm()) nearest = {i, j};
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (int i = std::max(0, nearest[0] - 1); i <= std::min(s.across - 1, nearest[0] + 1); ++i)
    for (int j = std::max(0, nearest[1] - 1); j <= std::min(s.up - 1, nearest[1] + 1); ++j) {
      const Eigen::Vector2d away = middle(i, j) - at;
      const Eigen::Vector3d basis(1.0, away[0], away[1]);
      A += basis * basis.transpose();
      b += pressure(i, j) * basis;
    }
  return A.ldlt().solve(b)[0];
}

namespace {

std::vector<double> fronts_of(const LiquidColumn& column, int cells, const std::vector<double>& times) {
  CollapseMesh mesh(column, cells);
  std::vector<double> out;
  double before = mesh.front();
  for (const double t : times) {
    while (mesh.time() < t) {
      before = mesh.front();
      mesh.step();
    }
    const double share = 1.0 - (mesh.time() - t) / mesh.step_size();
    out.push_back(mesh.time() > 0.0 ? before + share * (mesh.front() - before) : before);
  }
  return out;
}

std::vector<double> pressures_of(const LiquidColumn& column, int cells, const std::vector<double>& times,
                                 double x, double y) {
  CollapseMesh mesh(column, cells);
  std::vector<double> out;
  for (const double t : times) {
    do mesh.step();
    while (mesh.time() < t);
    out.push_back(mesh.pressure_at(x, y));
  }
  return out;
}

}  // namespace

CollapsePressures collapse_pressures(const LiquidColumn& column, int cells, const std::vector<double>& times,
                                     double x, double y) {
  CollapsePressures out{pressures_of(column, cells, times, x, y),
                        pressures_of(column, cells / 2, times, x, y)};
  for (std::size_t n = 0; n < times.size(); ++n)
    out.difference[n] = std::abs(out.pressure[n] - out.difference[n]);
  return out;
}

CollapseFronts collapse_fronts(const LiquidColumn& column, int cells, const std::vector<double>& times) {
  using Question = std::tuple<double, double, double, int, std::vector<double>>;
  static std::map<Question, CollapseFronts> known;
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const Question question{column.width, column.height, column.gravity, cells, times};
  if (const auto found = known.find(question); found != known.end()) return found->second;
  CollapseFronts out{fronts_of(column, cells, times), fronts_of(column, cells / 2, times)};
  for (std::size_t n = 0; n < times.size(); ++n)
    out.difference[n] = std::abs(out.front[n] - out.difference[n]);
  return known.emplace(question, std::move(out)).first->second;
}

}  // namespace tripoint
