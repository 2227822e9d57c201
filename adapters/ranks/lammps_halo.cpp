// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/ranks/lammps_halo.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <type_traits>

#include "core/errors.hpp"
#include "particles/rank_grid.hpp"

namespace tripoint::ranks {
namespace {

constexpr double allowed_later = 1.05;    ///< cost of the dearest rank over the mean, as lists are made anew
constexpr std::size_t rows_at_once = 32;  ///< whose columns are written while their numbers are in the cache

/// Calls visit(values, number of the column) for each column of numbers. @throws EngineError for a column of
/// anything else
template <class P, class Visit>
void each_column(P& particles, Visit visit) {
  int column = 0;
  particles.for_each([&]<class T>(const FieldInfo& field, std::span<T> values) {
    if constexpr (std::is_arithmetic_v<T>)
      visit(values, column++);
    else
      throw EngineError("the column " + std::string(field.name) +
                        " is not made of numbers and cannot go between ranks");
  });
}

int count_columns(const Particles& particles) {
  int count = 0;
  each_column(particles, [&](auto, int) { ++count; });
  return count;
}

/// The farthest that a particle is from a place of its own [m]. @param places by id; empty: 0
double farthest(const Particles& particles, std::span<const Vec3> places) {
  double most = 0.0;
  for (std::size_t id = 0; id < places.size(); ++id)
    most = std::max(most, norm(particles.position(particles.row(id)) - places[id]));
  return most;
}

}  // namespace

PeriodicBox LammpsHalo::split_of(const PeriodicBox& box) const {
  PeriodicBox split = box;
  for (std::size_t a = 0; a < 3; ++a) split.periodic[a] = box.periodic[a] && splits_[a];
  return split;
}

/// Every rank has all particles, and takes those that LAMMPS has put into its part of the box. Particles that
/// flowed in have no atoms yet: then all are made anew, which also evens out the parts.
void LammpsHalo::share_out(Particles& particles, Bonds& bonds, ExcludedPairs& own, const PeriodicBox& box,
                           std::span<const Vec3> places, std::span<const double> cost) {
  const std::size_t lists = most_list_numbers(bonds, own);
  has_lists_ = lists > 0;
  if (!ranks_) {
    columns_of_particle_ = count_columns(particles);
    ranks_ = &host_.begin(columns_of_particle_);
  }
  ranks_->make_room(lists);
  if (particles.size() != atoms_) {
    std::vector<Vec3> now;
    for (std::size_t id = 0; id < particles.size(); ++id)
      now.push_back(particles.position(particles.row(id)));
    host_.renew(now);
    atoms_ = particles.size();
  }
  const double bond =
      has_lists_ ? longest_bond(particles, bonds, particles.size(), box) + 2.0 * farthest(particles, places)
                 : 0.0;
  reach_now_ = std::max(reach_, bond * (1.0 + 1e-9));
  std::vector<std::size_t> rows(ranks_->owned());
  for (std::size_t atom = 0; atom < rows.size(); ++atom)
    rows[atom] = particles.row(static_cast<std::size_t>(ranks_->id(atom)));
  pack(particles, split_of(box), rows, places);
  const bool are_written =
      ranks_->size() == 1 && migrations_ > 0 && known_changes_ == std::array{bonds.changes(), own.changes()};
  for (std::size_t atom = 0; atom < ranks_->owned() && !are_written; ++atom)
    ranks_->lists(atom) = has_lists_
                              ? lists_as_numbers(bonds, own, static_cast<std::size_t>(ranks_->id(atom)))
                              : std::vector<double>{};
  if (!cost.empty() && ranks_->size() > 1) {
    for (std::size_t atom = 0; atom < ranks_->owned(); ++atom)
      ranks_->cost(atom) = cost[static_cast<std::size_t>(ranks_->id(atom))];
    balance(allowed_at_start);
  }
  hand_over(particles, bonds, own);
}

void LammpsHalo::share_lists(Bonds& bonds, ExcludedPairs& own) {
  const std::size_t lists = most_list_numbers(bonds, own);
  has_lists_ = lists > 0;
  ranks_->make_room(lists);
  for (std::size_t id = 0; id < numbers_.size() && has_lists_; ++id)
    ranks_->lists(atoms_here_[id]) = lists_as_numbers(bonds, own, static_cast<std::size_t>(numbers_[id]));
  unpack_lists(bonds, own);
}

/// All atoms are then made anew, with their lists.
void LammpsHalo::begin_anew() {
  constexpr auto never = std::numeric_limits<std::uint64_t>::max();
  atoms_ = 0;
  known_changes_ = {never, never};
}

void LammpsHalo::migrate(Particles& particles, Bonds& bonds, ExcludedPairs& own, const PeriodicBox& box,
                         std::span<const double> cost) {
  if (ranks_->size() == 1) {  // its part is the whole; requests that more ranks would make are counted
    collectives_ += has_lists_ ? 1.0 : 0.0;
    return share_out(particles, bonds, own, box, {}, {});
  }
  expect_known(bonds, own);
  reach_now_ = reach_of(has_lists_ ? longest_bond(particles, bonds, owned(), box) : 0.0);
  const std::vector<std::uint32_t> ids = follow_rows(particles);
  std::vector<std::size_t> rows(owned());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  pack(particles, split_of(box), rows);
  for (std::size_t atom = 0; atom < ids.size() && !cost.empty(); ++atom) ranks_->cost(atom) = cost[ids[atom]];
  if (!cost.empty()) balance(allowed_later);
  hand_over(particles, bonds, own);
}

/// From now on each atom carries the particle of its row. Neighbours in memory then move together, and
/// columns are written and read one after the other. Rows of this rank's own come first. @return for each
/// atom the id
std::vector<std::uint32_t> LammpsHalo::follow_rows(const Particles& particles) {
  const auto id = particles[field::id];
  std::vector<std::uint32_t> ids(id.begin(), id.begin() + static_cast<std::ptrdiff_t>(owned()));
  std::vector<std::vector<double>> lists;
  for (std::size_t id_of_list = 0; has_lists_ && id_of_list < ids.size(); ++id_of_list)
    lists.push_back(std::move(ranks_->lists(id_of_list)));  // atoms of its own have the order of ids
  for (std::size_t atom = 0; atom < ids.size(); ++atom) {
    ranks_->set_id(atom, numbers_[ids[atom]]);
    if (has_lists_) ranks_->lists(atom) = std::move(lists[ids[atom]]);
  }
  return ids;
}

void LammpsHalo::balance(double allowed) {
  collectives_ += 2.0;
  begin_call();
  ranks_->balance(allowed);
}

void LammpsHalo::hand_over(Particles& particles, Bonds& bonds, ExcludedPairs& own) {
  begin_call();
  ranks_->migrate(reach_now_);
  end_part();
  unpack(particles);
  unpack_lists(bonds, own);
  if (++migrations_ == 1) {
    own_at_start_ = ranks_->owned();
    copies_at_start_ = ranks_->all() - ranks_->owned();
  }
}

/// Copies reach as far as the longest bond of all ranks now. They stay until the next migration, however
/// bonds are stretched.
double LammpsHalo::reach_of(double longest_bond) {
  if (!has_lists_) return reach_;
  double least = -longest_bond;
  std::string unused;
  take_least(least, unused);
  return std::max(reach_, -least * (1.0 + 1e-9));
}

/// Lists are written down as the scene is shared out, where ids are numbers. Nobody changes the lists of its
/// parts.
void LammpsHalo::expect_known(const Bonds& bonds, const ExcludedPairs& own) const {
  if (known_changes_ != std::array{bonds.changes(), own.changes()})
    throw EngineError("bonds or excluded pairs of a scene that is shared out have changed");
}

/// Each rank sends how many particles it has, their numbers, then column by column, then the lengths of
/// lists, and the lists.
WholeScene LammpsHalo::gather(const Particles& particles, const Bonds& bonds, const ExcludedPairs& own) {
  expect_known(bonds, own);
  ++gatherings_;
  const std::size_t count = owned();
  std::size_t in_lists = 0;
  for (std::size_t id = 0; id < count; ++id) in_lists += ranks_->lists(id).size();
  std::vector<double> numbers{static_cast<double>(count)};
  numbers.reserve(1 + count * (2 + static_cast<std::size_t>(count_columns(particles))) + in_lists);
  numbers.insert(numbers.end(), numbers_.begin(), numbers_.begin() + static_cast<std::ptrdiff_t>(count));
  each_column(particles, [&](auto values, int) {
    for (std::size_t id = 0; id < count; ++id)
      numbers.push_back(static_cast<double>(values[particles.row(id)]));
  });
  for (std::size_t id = 0; id < count; ++id) numbers.push_back(static_cast<double>(ranks_->lists(id).size()));
  for (std::size_t id = 0; id < count; ++id)
    numbers.insert(numbers.end(), ranks_->lists(id).begin(), ranks_->lists(id).end());
  const std::vector<double> all = all_of(numbers);

  WholeScene whole{Particles(atoms_, particles.fields()), {}, {}};
  std::vector<std::span<const double>> lists(atoms_);
  for (const double* from = all.data(); from != all.data() + all.size();) {
    const auto there = static_cast<std::size_t>(*from++);
    const std::vector<std::size_t> number(from, from + there);
    from += there;
    each_column(whole.particles, [&](auto values, int) {
      using T = typename decltype(values)::value_type;
      for (const std::size_t n : number) values[n] = static_cast<T>(*from++);
    });
    const double* list = from + there;
    for (const std::size_t n : number) {
      lists[n] = {list, static_cast<std::size_t>(*from++)};
      list += lists[n].size();
    }
    from = list;
  }
  const auto ids = whole.particles[field::id];
  std::iota(ids.begin(), ids.end(), 0);
  if (!has_lists_) return whole;
  Share share{atoms_, std::vector<int>(ids.begin(), ids.end()), [&](std::size_t id) { return lists[id]; }};
  take_lists(share, whole.bonds, whole.own);
  return whole;
}

void LammpsHalo::unpack_lists(Bonds& bonds, ExcludedPairs& own) {
  if (!has_lists_) {
    bonds = {};
    own = {};
    known_changes_ = {};
    return;
  }
  Share share{ranks_->owned(), {}, [this](std::size_t id) {
                return std::span<const double>(ranks_->lists(atoms_here_[id]));
              }};
  share.number = numbers_;
  take_lists(share, bonds, own);
  known_changes_ = {bonds.changes(), own.changes()};
}

/// Only rows that other ranks are to have are written for LAMMPS; for the rest the row number alone is noted.
/// @param rows of the atoms   @param places that LAMMPS is told, by number; empty: those of now
void LammpsHalo::pack(const Particles& particles, const PeriodicBox& box,
                      const std::vector<std::size_t>& rows, std::span<const Vec3> places) {
  ranks_->set_rows(rows, [&particles](std::span<const std::size_t> wanted, std::span<double* const> to) {
    for (std::size_t from = 0; from < wanted.size(); from += rows_at_once)
      each_column(particles,
                  [&, past = std::min(from + rows_at_once, wanted.size())](auto values, int column) {
                    for (std::size_t k = from; k < past; ++k)
                      to[k][column] = static_cast<double>(values[wanted[k]]);
                  });
  });
  const auto x = positions(particles);
  for (std::size_t atom = 0; atom < rows.size(); ++atom) {
    const Vec3 r = places.empty() ? x.at(rows[atom]) : places[static_cast<std::size_t>(ranks_->id(atom))];
    for (std::size_t a = 0; a < 3; ++a)
      ranks_->position(atom)[a] =
          box.periodic[a] ? r[a] - std::floor((r[a] - box.min[a]) / box.width[a]) * box.width[a] : r[a];
  }
}

/// Ghosts of one particle at several images are one here, and so are ghosts of this rank's own particles.
/// Lists find them across a periodic boundary by themselves.
void LammpsHalo::number_atoms() {
  const auto owned = static_cast<std::uint32_t>(ranks_->owned()),
             all = static_cast<std::uint32_t>(ranks_->all());
  numbers_.clear();
  atoms_here_.clear();
  id_of_atom_.resize(all);
  std::vector<std::pair<int, std::uint32_t>> ghosts;  // number and atom
  for (std::uint32_t atom = owned; atom < all; ++atom) ghosts.emplace_back(ranks_->id(atom), atom);
  std::ranges::sort(ghosts);
  // By the last bits of a number: few share them
  std::vector<char> may_be_copied(std::bit_ceil(16 * ghosts.size() + 1), 0);
  const auto last_bits = [&](int number) {
    return static_cast<std::size_t>(number) & (may_be_copied.size() - 1);
  };
  for (const auto& [number, atom] : ghosts) may_be_copied[last_bits(number)] = 1;

  std::vector<std::uint32_t> first(all - owned);  // of each copy the first atom with its number
  for (std::size_t k = 0; k < ghosts.size(); ++k)
    first[ghosts[k].second - owned] = k > 0 && ghosts[k].first == ghosts[k - 1].first
                                          ? first[ghosts[k - 1].second - owned]
                                          : ghosts[k].second;
  for (std::uint32_t atom = 0; atom < owned; ++atom) {
    const int number = ranks_->id(atom);
    id_of_atom_[atom] = atom;
    numbers_.push_back(number);
    atoms_here_.push_back(atom);
    if (!may_be_copied[last_bits(number)]) continue;
    for (const auto& one :
         std::ranges::equal_range(ghosts, number, {}, &std::pair<int, std::uint32_t>::first))
      first[one.second - owned] = atom;
  }
  for (std::uint32_t atom = owned; atom < all; ++atom) {
    if (first[atom - owned] != atom) {
      id_of_atom_[atom] = id_of_atom_[first[atom - owned]];
      continue;
    }
    id_of_atom_[atom] = static_cast<std::uint32_t>(numbers_.size());
    numbers_.push_back(ranks_->id(atom));
    atoms_here_.push_back(atom);
  }
}

void LammpsHalo::unpack(Particles& particles) {
  number_atoms();
  if (ranks_->size() == 1) return;  // ids are numbers, and every particle keeps its row
  std::vector<std::uint32_t> rows;
  std::vector<std::pair<std::size_t, const double*>> came;  // id and numbers of each that has arrived
  for (std::size_t id = 0; id < numbers_.size(); ++id) {
    const std::size_t row = ranks_->row(atoms_here_[id]);
    if (row == Ranks::no_row) came.emplace_back(id, ranks_->arrived(atoms_here_[id]));
    rows.push_back(row == Ranks::no_row ? Particles::none : static_cast<std::uint32_t>(row));
  }
  particles.make_of(rows);
  for (std::size_t from = 0; from < came.size(); from += rows_at_once)
    each_column(particles, [&, past = std::min(from + rows_at_once, came.size())](auto values, int column) {
      using T = typename decltype(values)::value_type;
      for (std::size_t k = from; k < past; ++k)
        values[came[k].first] = static_cast<T>(came[k].second[column]);
    });
  particles.number();
}

void LammpsHalo::refresh(Particles& particles, std::span<const Field<double>* const> columns) {
  columns_.clear();
  for (const Field<double>* f : columns) columns_.push_back(particles[*f].data());
  exchanges_ += 1.0;
  numbers_a_copy_ += static_cast<double>(columns_.size());
  begin_call();
  ranks_->forward(
      {columns_.data(), static_cast<int>(columns_.size()), id_of_atom_.data(), particles.rows().data(), 1});
  end_part();
}

void LammpsHalo::refresh(std::span<double> by_id, std::size_t each) {
  columns_.clear();
  for (std::size_t k = 0; k < each; ++k) columns_.push_back(by_id.data() + k);
  exchanges_ += 1.0;
  numbers_a_copy_ += static_cast<double>(each);
  begin_call();
  ranks_->forward({columns_.data(), static_cast<int>(each), id_of_atom_.data(), nullptr, each});
  end_part();
}

std::vector<double> LammpsHalo::all_of(const std::vector<double>& own) {
  collectives_ += 2.0;
  begin_call();
  std::vector<double> all = ranks_->all_of(own);
  end_part();
  return all;
}

std::vector<std::vector<double>> LammpsHalo::exchange(const std::vector<std::vector<double>>& to) {
  collectives_ += 2.0;
  begin_call();
  std::vector<std::vector<double>> from = ranks_->exchange(to);
  end_part();
  return from;
}

void LammpsHalo::take_least(double& number, std::string& word) {
  if (!ranks_) return;  // all still hold the whole scene, and know the same
  char text[32] = {};
  word.copy(text, sizeof text - 1);
  collectives_ += word.empty() ? 1.0 : 2.0;
  begin_call();
  ranks_->take_least(number, text, word.empty() ? 0 : static_cast<int>(sizeof text));
  word = text;
  end_part();
}

}  // namespace tripoint::ranks
