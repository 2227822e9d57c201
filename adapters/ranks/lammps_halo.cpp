// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/ranks/lammps_halo.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "core/errors.hpp"

namespace tripoint::ranks {
namespace {

/// Calls visit(values, number of the column) for each column of numbers. @throws EngineError for a column of anything else
template <class P, class Visit>
void each_column(P& particles, Visit visit) {
  int column = 0;
  particles.for_each([&]<class T>(const FieldInfo& field, std::span<T> values) {
    if constexpr (std::is_arithmetic_v<T>)
      visit(values, column++);
    else
      throw EngineError("the column " + std::string(field.name) + " is not made of numbers and cannot go between ranks");
  });
}

int count_columns(const Particles& particles) {
  int count = 0;
  each_column(particles, [&](auto, int) { ++count; });
  return count;
}

}  // namespace

PeriodicBox LammpsHalo::split_of(const PeriodicBox& box) const {
  PeriodicBox split = box;
  for (std::size_t a = 0; a < 3; ++a) split.periodic[a] = box.periodic[a] && splits_[a];
  return split;
}

/// Every rank has all particles, and takes those that LAMMPS has put into its part of the box. Particles that flowed in have no
/// atoms yet: then all are made anew, which also evens out the parts.
void LammpsHalo::share_out(Particles& particles, Bonds& bonds, OwnPairs& own, const PeriodicBox& box) {
  const std::size_t lists = most_list_numbers(bonds, own);
  has_lists_ = lists > 0;
  if (!ranks_) {
    columns_of_particle_ = count_columns(particles);
    ranks_ = &host_.begin(columns_of_particle_);
  }
  ranks_->make_room(lists);
  if (particles.size() != atoms_) {
    std::vector<Vec3> places;
    for (std::size_t id = 0; id < particles.size(); ++id) places.push_back(particles.position(particles.row(id)));
    host_.renew(places);
    atoms_ = particles.size();
  }
  reach_now_ = has_lists_ ? std::max(reach_, longest_bond(particles, bonds, particles.size(), box) * (1.0 + 1e-9)) : reach_;
  pack(particles, split_of(box), true);
  const bool are_written = ranks_->size() == 1 && migrations_ > 0 && known_changes_ == std::array{bonds.changes(), own.changes()};
  for (std::size_t atom = 0; atom < ranks_->owned() && !are_written; ++atom)
    ranks_->lists(atom) =
        has_lists_ ? lists_as_numbers(bonds, own, static_cast<std::size_t>(ranks_->id(atom))) : std::vector<double>{};
  hand_over(particles, bonds, own, split_of(box));
}

void LammpsHalo::migrate(Particles& particles, Bonds& bonds, OwnPairs& own, const PeriodicBox& box) {
  if (ranks_->size() == 1) {  // its part is the whole; what more ranks would ask each other is counted
    collectives_ += has_lists_ ? 1.0 : 0.0;
    return share_out(particles, bonds, own, box);
  }
  expect_known(bonds, own);
  reach_now_ = reach_of(has_lists_ ? longest_bond(particles, bonds, owned(), box) : 0.0);
  pack(particles, split_of(box), false);
  hand_over(particles, bonds, own, split_of(box));
}

void LammpsHalo::hand_over(Particles& particles, Bonds& bonds, OwnPairs& own, const PeriodicBox& split) {
  ranks_->migrate(reach_now_);
  unpack(particles, split);
  unpack_lists(bonds, own);
  if (++migrations_ == 1) own_at_start_ = ranks_->owned(), copies_at_start_ = ranks_->all() - ranks_->owned();
}

/// As far as the longest bond of all ranks reaches now: until the next migration nobody takes copies away, however bonds are
/// stretched.
double LammpsHalo::reach_of(double longest_bond) {
  if (!has_lists_) return reach_;
  double least = -longest_bond;
  std::string unused;
  take_least(least, unused);
  return std::max(reach_, -least * (1.0 + 1e-9));
}

/// Lists are written down as the scene is shared out, with the numbers that ids are there: its parts nobody changes.
void LammpsHalo::expect_known(const Bonds& bonds, const OwnPairs& own) const {
  if (known_changes_ != std::array{bonds.changes(), own.changes()})
    throw EngineError("bonds or own pairs of a scene that is shared out have changed");
}

WholeScene LammpsHalo::gather(const Particles& particles, const Bonds& bonds, const OwnPairs& own) {
  expect_known(bonds, own);
  ++gatherings_;
  std::vector<double> numbers;
  for (std::size_t id = 0; id < owned(); ++id) {
    numbers.push_back(number_of(id));
    const std::size_t row = particles.row(id);
    each_column(particles, [&](auto values, int) { numbers.push_back(static_cast<double>(values[row])); });
    const std::vector<double>& lists = ranks_->lists(id);
    numbers.push_back(static_cast<double>(lists.size()));
    numbers.insert(numbers.end(), lists.begin(), lists.end());
  }
  const std::vector<double> all = all_of(numbers);
  WholeScene whole{Particles(atoms_, particles.fields()), {}, {}};
  Share share{atoms_, {}, {}};
  std::vector<std::span<const double>> lists(atoms_);
  for (const double* from = all.data(); from != all.data() + all.size();) {
    const auto number = static_cast<std::size_t>(*from++);
    each_column(whole.particles, [&](auto values, int) {
      using T = typename decltype(values)::value_type;
      values[number] = static_cast<T>(*from++);
    });
    whole.particles[field::id][number] = static_cast<int>(number);
    const auto count = static_cast<std::size_t>(*from++);
    lists[number] = {from, count};
    from += count;
  }
  share.lists = [&](std::size_t id) { return lists[id]; };
  for (std::size_t n = 0; n < atoms_; ++n) share.number.push_back(static_cast<int>(n));
  if (has_lists_) take_lists(share, whole.bonds, whole.own);
  return whole;
}

void LammpsHalo::unpack_lists(Bonds& bonds, OwnPairs& own) {
  if (!has_lists_) {
    bonds = {}, own = {};
    known_changes_ = {};
    return;
  }
  Share share{ranks_->owned(), {}, [this](std::size_t id) { return std::span<const double>(ranks_->lists(id)); }};
  for (std::size_t atom = 0; atom < ranks_->all(); ++atom) share.number.push_back(ranks_->id(atom));
  take_lists(share, bonds, own);
  known_changes_ = {bonds.changes(), own.changes()};
}

/// @param whole ids are numbers
void LammpsHalo::pack(Particles& particles, const PeriodicBox& box, bool whole) {
  for (std::size_t atom = 0; atom < ranks_->owned(); ++atom) {
    const std::size_t row = particles.row(whole ? static_cast<std::size_t>(ranks_->id(atom)) : atom);
    each_column(particles, [&](auto values, int column) { ranks_->numbers(atom)[column] = static_cast<double>(values[row]); });
    const Vec3 r = particles.position(row);
    for (std::size_t a = 0; a < 3; ++a)
      ranks_->position(atom)[a] = box.periodic[a] ? r[a] - std::floor((r[a] - box.min[a]) / box.width[a]) * box.width[a] : r[a];
  }
}

/// Whose place in LAMMPS differs from that in its column is seen across a periodic boundary, or has crossed one.
void LammpsHalo::unpack(Particles& particles, const PeriodicBox& box) {
  const std::vector<FieldInfo> fields = particles.fields();
  const std::size_t count = ranks_->all();
  particles = Particles(count, fields);
  each_column(particles, [&](auto values, int column) {
    using T = typename decltype(values)::value_type;
    for (std::size_t atom = 0; atom < count; ++atom) values[atom] = static_cast<T>(ranks_->numbers(atom)[column]);
  });
  const auto id = particles[field::id];
  for (std::size_t atom = 0; atom < count; ++atom) id[atom] = static_cast<int>(atom);
  if (!box.any()) return;
  const auto r = positions(particles);
  const auto image = images(particles);
  const std::array<std::span<double>, 3> x{r.x, r.y, r.z};
  const std::array<std::span<int>, 3> n{image.x, image.y, image.z};
  for (std::size_t a = 0; a < 3; ++a) {
    if (!box.periodic[a]) continue;
    for (std::size_t atom = 0; atom < count; ++atom) {
      const double widths = std::round((ranks_->position(atom)[a] - x[a][atom]) / box.width[a]);
      if (widths == 0.0) continue;
      x[a][atom] += widths * box.width[a];
      n[a][atom] -= static_cast<int>(widths);
    }
  }
}

void LammpsHalo::refresh(Particles& particles, std::span<const Field<double>* const> columns) {
  rows_.resize(particles.size());
  for (std::size_t id = 0; id < rows_.size(); ++id) rows_[id] = static_cast<std::uint32_t>(particles.row(id));
  columns_.clear();
  for (const Field<double>* f : columns) columns_.push_back(particles[*f].data());
  exchanges_ += 1.0, numbers_a_copy_ += static_cast<double>(columns_.size());
  ranks_->forward({columns_.data(), static_cast<int>(columns_.size()), rows_.data(), 1});
}

void LammpsHalo::refresh(std::span<double> by_id, std::size_t each) {
  columns_.clear();
  for (std::size_t k = 0; k < each; ++k) columns_.push_back(by_id.data() + k);
  exchanges_ += 1.0, numbers_a_copy_ += static_cast<double>(each);
  ranks_->forward({columns_.data(), static_cast<int>(each), nullptr, each});
}

std::vector<double> LammpsHalo::all_of(const std::vector<double>& own) {
  collectives_ += 2.0;
  return ranks_->all_of(own);
}

void LammpsHalo::take_least(double& number, std::string& word) {
  if (!ranks_) return;  // all still hold the whole scene, and know the same
  char text[32] = {};
  word.copy(text, sizeof text - 1);
  collectives_ += word.empty() ? 1.0 : 2.0;
  ranks_->take_least(number, text, word.empty() ? 0 : static_cast<int>(sizeof text));
  word = text;
}

}  // namespace tripoint::ranks
