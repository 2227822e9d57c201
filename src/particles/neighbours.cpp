// SPDX-License-Identifier: BSD-3-Clause
#include "particles/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "core/machine.hpp"
#include "particles/grid.hpp"

namespace tripoint {
namespace {

const char* const axis_names[] = {"x", "y", "z"};

/// @param listed rows that the last lists knew: the fixed ones among them have not moved
void refuse_not_finite(const Particles& particles, double time, std::size_t listed) {
  const auto x = positions(particles);
  const auto refuse_among = [&](std::size_t first, std::size_t past) {
    for (std::size_t i = first; i < past; ++i) {
      if (finite(x.at(i)) && norm(x.at(i)) <= 1e100) continue;
      throw Diverged(particles[field::id][i], particles[field::body][i], "position", "drift", time,
                     "a position is not finite");
    }
  };
  refuse_among(0, particles.moving());
  refuse_among(std::max(particles.moving(), listed), particles.size());
}

}  // namespace

Neighbours::Neighbours(double support, double skin, const PeriodicBox& box, int threads, int lanes)
    : support_(support), skin_(skin), box_(box), threads_(threads), scan_(scan_of(lanes)) {
  clusters_.lanes = lanes;
  for (std::size_t a = 0; a < 3; ++a) {
    if (!box.periodic[a] || box.width[a] >= support + skin) continue;
    throw InputError(std::string("the periodic direction ") + axis_names[a] + " is " +
                     std::to_string(box.width[a]) + " m wide, less than the support radius with its skin, " +
                     std::to_string(support + skin) + " m: make the domain wider or the spacing smaller");
  }
  for (int k = 0; k < 27; ++k) {
    const int n[] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
    for (std::size_t a = 0; a < 3; ++a)
      shift_[static_cast<std::size_t>(k)][a] = box.periodic[a] ? n[a] * box.width[a] : 0.0;
  }
}

Neighbours Neighbours::anew(const PeriodicBox& box) const {
  Neighbours lists(support_, skin_, box, threads_, clusters_.lanes);
  lists.rebuilds_ = rebuilds_;
  lists.whole_lists_ = whole_lists_;
  return lists;
}

bool Neighbours::outdated(const Particles& particles) const {
  if (!are_made_ || built_.size() != particles.size() || rebuilds_ == 0) return true;
  const auto x = positions(particles);
  // Beyond rounding: all within the support now was within reach then
  const double limit = 0.25 * skin_ * skin_ * (1.0 - 1e-9);
  double greatest = 0.0;
#pragma omp parallel for schedule(static) num_threads(threads_) \
    reduction(max                                               \
              : greatest) if (particles.moving() > worth_threads)
  for (std::size_t i = 0; i < particles.moving(); ++i) {
    const Vec3 d = x.at(i) - built_[i];
    const double d2 = dot(d, d);
    greatest = std::max(greatest, std::isfinite(d2) ? d2 : 1e300);
  }
  return greatest > limit;
}

bool Neighbours::update(Particles& particles, double time, const std::function<Resting()>& resting) {
  if (!outdated(particles)) return false;
  rebuild(particles, time, resting ? resting() : Resting{});
  return true;
}

void Neighbours::rebuild_from(Particles& particles, std::span<const Vec3> build_positions, double time,
                              long rebuilds) {
  const auto x = positions(particles);
  std::vector<Vec3> now(particles.size());  // by id, since the rebuild moves rows
  const auto id = particles[field::id];
  for (std::size_t i = 0; i < particles.size(); ++i) {
    now[static_cast<std::size_t>(id[i])] = x.at(i);
    x.set(i, build_positions[i]);
  }
  refuse_not_finite(particles, time, built_.size());
  sort_and_list(
      particles,
      // Not wrapped again: one a rounding error below the box was put on its upper edge, and stays there
      {});
  rebuilds_ = rebuilds;
  const auto sorted = positions(particles);
  for (std::size_t k = 0; k < now.size(); ++k) sorted.set(particles.row(k), now[k]);
}

/// Moves particles by whole box widths into the box, and counts them in `image`.
void Neighbours::wrap(Particles& particles) const {
  if (!box_.any()) return;
  const auto x = positions(particles);
  const auto image = images(particles);
  const std::array<std::span<double>, 3> r{x.x, x.y, x.z};
  const std::array<std::span<int>, 3> n{image.x, image.y, image.z};
  for (std::size_t a = 0; a < 3; ++a) {
    if (!box_.periodic[a]) continue;
    for (std::size_t i = 0; i < particles.size(); ++i) {  // sleeping particles are within the box
      const double widths = std::floor((r[a][i] - box_.min[a]) / box_.width[a]);
      if (widths == 0.0) continue;
      r[a][i] -= widths * box_.width[a];
      n[a][i] += static_cast<int>(widths);
    }
  }
}

void Neighbours::rebuild(Particles& particles, double time, const Resting& resting) {
  if (particles.size() > Entry::row_mask) throw InputError("more than 2^26 particles");
  refuse_not_finite(particles, time, built_.size());
  wrap(particles);
  sort_and_list(particles, resting);
  ++rebuilds_;
}

Neighbours::Extent Neighbours::extent_of(const Particles& particles) const {
  const std::size_t n = particles.size(), moving = particles.moving();
  const auto x = positions(particles);
  Extent all;
  all.low = all.high = n ? x.at(0) : Vec3{};
  const auto reach_to = [&](const Vec3& r) {
    for (std::size_t a = 0; a < 3; ++a) {
      all.low[a] = std::min(all.low[a], r[a]);
      all.high[a] = std::max(all.high[a], r[a]);
    }
  };
  for (std::size_t i = 0; i < moving; ++i) reach_to(x.at(i));
  if (moving == n) return all;
  for (std::size_t i = built_.size(); i < n; ++i) reach_to(x.at(i));
  reach_to(still_.low);
  reach_to(still_.high);
  return all;
}

void Neighbours::sort_and_list(Particles& particles, const Resting& resting) {
  const std::size_t n = particles.size();
  const auto [low, high] = extent_of(particles);
  Grid grid = whole_ ? Grid::over(whole_->low, whole_->high, support_ + skin_, box_, whole_->particles)
                     : Grid::over(low, high, support_ + skin_, box_, n);
  if (whole_ && n > 0) grid.keep(low, high, box_);
  const bool same_cells = grid.origin == still_.origin && grid.width == still_.width,
             same_bodies = !resting.bodies.empty() && resting.bodies == still_.bodies;
  listed_all_ = !(still_.known && same_cells && same_bodies);
  if (listed_all_) {
    sort_all(particles, grid);
    still_.known = false;
    if (same_cells && same_bodies) learn_still(particles, grid, resting);
    still_.origin = grid.origin;
    still_.width = grid.width;
    still_.bodies = resting.bodies;
    ++whole_lists_;
  } else {
    sort_awake(particles, grid, resting);
  }
  marked_ = listed_sleeping_ = false;
  are_made_ = true;
  moving_ = particles.moving();
  form_clusters(particles, grid);
  if (asked_) return keep_to_ask(particles, std::move(grid));
  const auto sorted = positions(particles);
  const Places places{sorted.x.data(), sorted.y.data(), sorted.z.data()};
  pairs_ = list(places, grid, clusters_.listed, listed_by_[0]);
  if (!order_.empty()) list_fixed(particles, places, grid);
  count_still_pairs(particles);
  if (!order_.empty()) grid_ = std::make_shared<const Grid>(std::move(grid));
}

/// Counting sort by cell, and by id within each, or by the number in the whole.
void Neighbours::sort_all(Particles& particles, Grid& grid) {
  const std::size_t n = particles.size();
  const auto x = positions(particles);
  grid.first.assign(grid.cells() + 1, 0);
  std::vector<std::uint32_t> order(n), cell_of(n);
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (std::size_t i = 0; i < n; ++i)
    cell_of[i] = static_cast<std::uint32_t>(grid.index(grid.place(x.at(i))));
  for (std::size_t i = 0; i < n; ++i) ++grid.first[cell_of[i] + 1];
  for (std::size_t c = 0; c < grid.cells(); ++c) grid.first[c + 1] += grid.first[c];
  std::vector<std::uint32_t> next(grid.first.begin(), grid.first.end() - 1);
  const auto id = particles[field::id];
  const auto number = [&](std::uint32_t row) {
    return whole_ ? whole_->numbers[static_cast<std::size_t>(id[row])] : id[row];
  };
  for (std::uint32_t row = 0; row < n; ++row) {
    const std::uint32_t c = cell_of[row];
    std::uint32_t at = next[c]++;
    for (const int own = number(row); at > grid.first[c] && number(order[at - 1]) > own; --at)
      order[at] = order[at - 1];
    order[at] = row;  // a cell holds few, and most come in order
  }
  bring_own_first(particles, order);
  // Before columns are held twice.
  std::vector<std::uint32_t>().swap(cell_of);
  std::vector<std::uint32_t>().swap(next);
  particles.permute(order, threads_);
  std::vector<std::uint32_t>().swap(order);
  const auto sorted = positions(particles);
  built_.resize(n);
  for (std::size_t i = 0; i < n; ++i) built_[i] = sorted.at(i);
  order_.clear();
  meets_.clear();
  moving_first_.clear();
  row_blocks_.clear();
  grid_.reset();
}

/// In a shared scene the rows of this process's own particles come before the rows of ghosts, each in order
/// of (cell, number). A cluster then has members of one kind. Copies need no lists, because their owners form
/// their sums.
/// @param order of each place the row that it was, and then of each row
void Neighbours::bring_own_first(const Particles& particles, std::vector<std::uint32_t>& order) {
  own_first_.clear();
  if (!whole_ || whole_->own == order.size()) return;
  const auto id = particles[field::id];
  auto own = std::uint32_t{0}, copy = static_cast<std::uint32_t>(whole_->own);
  std::vector<std::uint32_t> rows(order.size());
  for (const std::uint32_t was : order) {
    own_first_.push_back(static_cast<std::size_t>(id[was]) < whole_->own ? own++ : copy++);
    rows[own_first_.back()] = was;
  }
  order.swap(rows);
}

}  // namespace tripoint
