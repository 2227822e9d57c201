// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <memory>
#include <optional>
#include <string>

#include "adapters/engine/checkpoints.hpp"
#include "adapters/engine/engine.hpp"
#include "adapters/ranks/lammps_halo.hpp"
#include "adapters/ranks/step_times.hpp"
#include "adapters/ranks/wheel.hpp"
#include "step/simulation.hpp"

namespace tripoint::ranks {

/// The solver over MPI ranks. As one of several it makes the same calls as the others: load(), advance_to()
/// and observe() are for all of them.
class RanksEngine : public Engine, public Restartable {
 public:
  /// @param lammps of this rank; null where the program only tells of itself
  explicit RanksEngine(Lammps* lammps) : lammps_(lammps) {}
  [[nodiscard]] EngineInfo info() const override;
  [[nodiscard]] std::string refusal(const Job&) const override;
  [[nodiscard]] std::string trial(const Job&) const override;
  void load(const Job&, const InitialState&) override;
  void advance_to(double time) override;
  void resume(const Job&, const InitialState&, const Checkpoint&) override;
  bool advance_to(double time, const std::function<bool(double time, long step)>& go_on) override;
  /// All call it after the same steps: those of is_due(), and where stops() says so.
  void save(Checkpoint&) const override;
  [[nodiscard]] bool is_due() const noexcept { return is_due_; }
  /// True for all ranks where one was told to. All call it, after every step.
  [[nodiscard]] bool stops(bool asked) override;
  [[nodiscard]] Snapshot observe() const override;
  [[nodiscard]] Readback readback() const override;
  void account(Result&) const override;
  /// Where the job asks for them. account() does so too. @throws EngineError where the file cannot be written
  void write_step_times() const;

 private:
  void write_words() const;  ///< how far this rank is
  void start(const Job&, const InitialState&, const Checkpoint*);

  Lammps* lammps_;
  std::optional<LammpsHalo> halo_;
  /// Not const where the engine is: observe() and save() ask it, and asking computes
  std::unique_ptr<Simulation> simulation_;
  std::optional<Checkpoints> checkpoints_;
  std::optional<StepTimes> step_times_;  ///< where the job asks for them
  bool is_due_ = false;                  ///< a checkpoint, after the last step
  std::string words_path_;               ///< where this rank says how far it is
  mutable double words_at_ = 0.0;        ///< [s] of wall time
};

/// Names of the presets: default, and ranks- with their number.
[[nodiscard]] const std::vector<std::string>& presets();
/// Ranks that a job asks for: its setting, else its preset, else its key. @throws InputError for a preset
/// that there is not, and unless it is a whole number from 1 to 1024
[[nodiscard]] int ranks_of(const Job&);
/// Bodies up to which every rank keeps all (Halo::owners_above). @throws InputError for a number that is none
[[nodiscard]] std::size_t owners_above(const Job&);

/// File in the folder of a run: the fault that ended a rank.
[[nodiscard]] std::string failure_file(const std::string& output, int rank);

}  // namespace tripoint::ranks
