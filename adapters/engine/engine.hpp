// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/checkpoint.hpp"
#include "core/defect.hpp"
#include "files/job.hpp"
#include "files/result.hpp"
#include "files/trajectory.hpp"

/// An engine adapter is five functions, SI in and out, one executable each (contracts: engine protocol).
namespace tripoint {

struct EngineInfo {
  std::string name, version, build;
  std::string library_path;  ///< of the engine's own library; its hash is taken by serve()
  /// e.g. rigid-free-flight, gravity, merge, split, heat, contact, prescribed
  std::vector<std::string> capabilities;
  std::vector<std::string> presets{"default"};
  /// Settings that change results -> their meaning and their default
  std::map<std::string, std::string> settings;
  bool deterministic = true;
  std::vector<DefectEntry> defects;  ///< run-time defects that the test build of this engine knows
  /// False: the engine's library is missing; --info still answers, with the reason
  bool available = true;
  std::string reason;  ///< why it is not available
};

class Engine {
 public:
  virtual ~Engine() = default;
  [[nodiscard]] virtual EngineInfo info() const = 0;
  /// Why not; empty = can. A report row, not an error
  [[nodiscard]] virtual std::string refusal(const Job&) const = 0;
  /// Why the engine cannot begin, as only a start with the job's particles tells; empty = it can. --check
  /// asks it after refusal().
  [[nodiscard]] virtual std::string trial(const Job&) const { return {}; }
  /// @throws EngineError with the engine's own words
  virtual void load(const Job&, const InitialState&) = 0;
  virtual void advance_to(double time) = 0;            ///< [s] @throws Diverged, EngineError
  [[nodiscard]] virtual Snapshot observe() const = 0;  ///< SI, world frame, particles by id
  /// Values that the engine itself holds, read from it
  [[nodiscard]] virtual Readback readback() const = 0;
  /// After Diverged: leaves the culprit and its surroundings in `folder`, as a file that ParaView opens.
  /// @return its name, empty = none
  [[nodiscard]] virtual std::string show_failure(const Diverged&, const std::string& /*folder*/) const {
    return {};
  }
  /// Fills steps, counters and extra of the result at the end of a run.
  virtual void account(Result&) const {}
};

/// Interface of an engine that can be cut between two steps and continued with the same bits; its info()
/// lists `restart`.
class Restartable {
 public:
  virtual ~Restartable() = default;
  /// After load(): takes the state that save() kept. @throws InputError naming what does not fit
  virtual void resume(const Job&, const InitialState&, const Checkpoint&) = 0;
  /// Like advance_to(time). @param go_on asked after every step with its time [s] and number: false stops
  /// there
  /// @return whether `time` was reached
  virtual bool advance_to(double time, const std::function<bool(double time, long step)>& go_on) = 0;
  virtual void save(Checkpoint&) const = 0;
  /// Whether the run ends after this step, with a checkpoint: asked once after every step. @param asked
  /// whether this process was told to; those that share a scene agree
  [[nodiscard]] virtual bool stops(bool asked) { return asked; }
};

using MakeEngine = std::unique_ptr<Engine> (*)();

/// The whole executable: --info, --check JOB, --run JOB by the contracts. `int main(int c, char** v) { return
/// serve(c, v, make);
/// }`
int serve(int argc, char** argv, MakeEngine make);

}  // namespace tripoint
