// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "adapters/ranks/ranks.hpp"
#include "adapters/ranks/step_times.hpp"
#include "particles/halo.hpp"
#include "particles/moving_lists.hpp"
#include "particles/neighbours.hpp"

namespace tripoint::ranks {

/// The solver's halo on LAMMPS's atoms: every column of a particle goes with its atom as a number.
class LammpsHalo : public Halo {
 public:
  /// Actions that only LAMMPS itself can do, beside its fix.
  struct Host {
    /// Makes the fix, when the columns are known
    std::function<Ranks&(int columns)> begin;
    /// Other atoms for those that there are, by number [m]
    std::function<void(const std::vector<Vec3>& places)> renew;
  };
  /// @param reach of a neighbour list [m]: ghosts reach as far, or as the longest bond does   @param
  /// owners_above as of Halo
  LammpsHalo(std::array<bool, 3> splits, double reach, std::size_t atoms, bool is_first,
             std::size_t owners_above, Host host)
      : splits_(splits),
        reach_(reach),
        atoms_(atoms),
        is_first_(is_first),
        owners_above_(owners_above),
        host_(std::move(host)) {}
  void share_out(Particles&, Bonds&, ExcludedPairs&, const PeriodicBox&, std::span<const Vec3> places,
                 std::span<const double> cost) override;
  void share_lists(Bonds&, ExcludedPairs&) override;
  void begin_anew() override;
  /// @throws EngineError where bonds or excluded pairs are not as the last call left them
  [[nodiscard]] WholeScene gather(const Particles&, const Bonds&, const ExcludedPairs&) override;
  /// @throws EngineError as gather()
  void migrate(Particles&, Bonds&, ExcludedPairs&, const PeriodicBox&, std::span<const double> cost) override;
  [[nodiscard]] std::array<bool, 3> splits() const override { return splits_; }
  [[nodiscard]] std::size_t owned() const override { return ranks_->owned(); }
  [[nodiscard]] std::span<const int> numbers() const override { return numbers_; }
  void refresh(Particles&, std::span<const Field<double>* const> columns) override;
  void refresh(std::span<double> by_id, std::size_t each) override;
  void add(std::span<double> numbers) override {
    // Before, all hold the whole scene.
    if (ranks_) {
      collectives_ += 2;
      begin_call();
      ranks_->add(numbers.data(), static_cast<int>(numbers.size()));
      end_part();
    }
  }
  [[nodiscard]] std::vector<double> all_of(const std::vector<double>& own) override;
  [[nodiscard]] std::vector<std::vector<double>> exchange(
      const std::vector<std::vector<double>>& to) override;
  [[nodiscard]] std::size_t processes() const override { return static_cast<std::size_t>(ranks_->size()); }
  [[nodiscard]] std::size_t process() const override { return static_cast<std::size_t>(ranks_->rank()); }
  [[nodiscard]] std::size_t owners_above() const override { return owners_above_; }
  void take_least(double& number, std::string& word) override;
  [[nodiscard]] bool is_first() const override { return is_first_; }

  /// Every call of all ranks ends a part of a step. @param times null: nobody wants to know
  void report_parts_to(StepTimes* times) noexcept { times_ = times; }

  [[nodiscard]] Ranks* ranks() const noexcept { return ranks_; }
  [[nodiscard]] long migrations() const noexcept { return migrations_; }
  [[nodiscard]] long gatherings() const noexcept { return gatherings_; }
  /// Requests to the other ranks so far, counted also where there is no other. They are exchanges of columns,
  /// numbers that each copy took in them, and collective calls. `tripoint predict` has its counts from here.
  struct Traffic {
    double exchanges = 0.0, numbers_a_copy = 0.0, collectives = 0.0;
    int columns = 0;                                    ///< that go with a particle or a new copy
    std::size_t own_at_start = 0, copies_at_start = 0;  ///< of this rank
  };
  [[nodiscard]] Traffic traffic() const noexcept {
    return {exchanges_, numbers_a_copy_, collectives_, columns_of_particle_, own_at_start_, copies_at_start_};
  }
  [[nodiscard]] double reach_of_copies() const noexcept { return reach_now_; }  ///< at the last migration [m]

 private:
  void begin_call() const {
    if (times_) times_->begin_call();
  }
  void end_part() const {
    if (times_) times_->end_part();
  }
  void hand_over(Particles&, Bonds&, ExcludedPairs&);
  [[nodiscard]] std::vector<std::uint32_t> follow_rows(const Particles&);
  void balance(double allowed);
  void pack(const Particles&, const PeriodicBox& split, const std::vector<std::size_t>& rows,
            std::span<const Vec3> places = {});
  void unpack(Particles&);
  void number_atoms();
  void unpack_lists(Bonds&, ExcludedPairs&);
  void expect_known(const Bonds&, const ExcludedPairs&) const;
  [[nodiscard]] double reach_of(double longest_bond);
  [[nodiscard]] PeriodicBox split_of(const PeriodicBox&) const;

  std::array<bool, 3> splits_;
  double reach_, reach_now_ = 0.0;
  std::size_t atoms_;  ///< of all ranks
  bool is_first_;
  std::size_t owners_above_;
  Host host_;
  Ranks* ranks_ = nullptr;
  StepTimes* times_ = nullptr;
  long migrations_ = 0, gatherings_ = 0;
  double exchanges_ = 0.0, numbers_a_copy_ = 0.0, collectives_ = 0.0;
  int columns_of_particle_ = 0;
  std::size_t own_at_start_ = 0, copies_at_start_ = 0;
  bool has_lists_ = false;  ///< the scene has bonds or excluded pairs
  /// Of bonds and of excluded pairs, as the last migration left them
  std::array<std::uint64_t, 2> known_changes_{};
  /// Of each id of this part, among the particles of all ranks
  std::vector<int> numbers_;
  std::vector<std::uint32_t> id_of_atom_;  ///< of each of LAMMPS's atoms, ghosts too
  std::vector<std::uint32_t> atoms_here_;  ///< of each id the atom that it was made of
  std::vector<double*> columns_;           ///< likewise
};

}  // namespace tripoint::ranks
