// SPDX-License-Identifier: BSD-3-Clause
// Runs of the engine under faults that a seed draws: one to three calls that fail, each in a kind of its own,
// an interval of checkpoints, and up to three attempts, of which the later ones go on from the last announced
// checkpoint. A process is forked a run, so that hundreds of thousands can be made.
//   seeded-faults BUILD CASE.toml... [--count N | --runs N] [--seed S] [--jobs N]
// What was announced is read from the run's stderr, which is kept apart from its files. After each attempt
// announced frames are read back; after the last one of a seed, and for every eighth seed after each, a run
// without faults goes on from the last announced checkpoint to its end: a checkpoint that an attempt has
// spoilt stays spoilt, since no later attempt can go on from it and write another.
// --runs: as many seeds as it takes for so many runs with faults. Ctrl-C ends it after the seeds that are
// under way, with the table of those done. Exit: 0 every promise of docs/promises.md held, 1 one did not,
// with the seed that shows it again (--seed S
// --count 1).
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "adapters/tripoint/tripoint_engine.hpp"

extern "C" void fault_seam_begins();  // of seam.cpp, which is part of this program

using namespace tripoint;
namespace fs = std::filesystem;

namespace {

constexpr int patience = 60'000;  ///< [ms] for a run of some tens
constexpr std::array kinds{"before", "half",       "after",         "lost",        "short",
                           "eintr",  "eio",        "enospc",        "erofs",       "edquot",
                           "clock",  "eio+sticky", "enospc+sticky", "erofs+sticky"};
constexpr std::array codes{0, 1, 2, 4, 7, 130};  ///< that the contracts know of an engine
constexpr int most_attempts = 3;
/// The first three are good
constexpr std::array outcomes{"whole", "died", "refused", "LOST", "WRONG", "HANG", "other"};
constexpr std::array draws{1, 1, 1, 1, 1, 1, 2, 2,
                           /// Checkpoints of a run; eleven are one a step of the smallest scene
                           2, 2, 2, 2, 3, 3, 3, 11};

/// What all workers have done together: it lies in memory that they share.
struct Table {
  std::atomic<unsigned long> next_seed, seeds, runs, faults;
  std::atomic<bool> stop;
  std::array<std::atomic<unsigned long>, outcomes.size()> runs_of;
  std::array<std::array<std::atomic<unsigned long>, outcomes.size()>, kinds.size()>
      faults_of;  ///< a run with three faults counts three times
};

Table* table = nullptr;
void on_stop_of_all(int) { table->stop = true; }

/// Place of a word among the outcomes; those that have no column of their own are the last.
std::size_t outcome_of(const std::string& what) {
  const std::string word = what.substr(0, what.find_first_of(": "));
  return static_cast<std::size_t>(std::min(std::ranges::find(outcomes, word), outcomes.end() - 1) -
                                  outcomes.begin());
}
bool is_good(const std::string& what) { return outcome_of(what) < 3; }

bool is_harmless(const std::string& kind) { return kind == "short" || kind == "eintr" || kind == "clock"; }
bool kills(const std::string& kind) {
  return kind == "before" || kind == "half" || kind == "after" || kind == "lost";
}

struct Ended {
  int code = 0;  ///< exit code, or minus the signal
  bool hung = false;
  std::string said;  ///< stderr
};

InitialState* particles_read = nullptr;  ///< of the scene that is tried

/// Does `work` in a child of its own. @return how it ended and what it said
/// @param looks whether it only looks at files
template <class Work>
Ended in_child(Work work, bool looks = false) {
  const int said = memfd_create("said", MFD_CLOEXEC);
  const pid_t child = fork();
  if (child == 0) {
    dup2(said, 2);
    const int code = work();
    if (looks) std::_Exit(code);  // nothing of a look is to be tidied up
    std::exit(code);
  }
  const int handle = static_cast<int>(syscall(SYS_pidfd_open, child, 0));
  pollfd wait{handle, POLLIN, 0};
  Ended end;
  end.hung = poll(&wait, 1, patience) == 0;
  if (end.hung) kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  close(handle);
  end.code = WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
  const auto size = static_cast<std::size_t>(lseek(said, 0, SEEK_END));
  end.said.resize(size);
  end.said.resize(static_cast<std::size_t>(std::max<ssize_t>(0, pread(said, end.said.data(), size, 0))));
  close(said);
  return end;
}

int serve_job(const std::string& path) {
  std::string program = "engine-tripoint", verb = "--run", job = path;
  std::array<char*, 4> words{program.data(), verb.data(), job.data(), nullptr};
  return serve(3, words.data(), [] { return std::unique_ptr<Engine>(new TripointEngine); });
}

/// A scene, and what its undisturbed run shows.
struct Reference {
  nlohmann::json job;
  std::string particles;
  InitialState initial;
  double end_time = 0.0;
  std::vector<std::string> hashes;  ///< [n]: of the first n frames
  std::array<long, 12> calls{};     ///< [n]: that change a file in a run with n checkpoints
  [[nodiscard]] double interval(int checkpoints) const { return end_time / (checkpoints + 0.5); }
};

std::vector<std::string> hashes_of(const Trajectory& t) {
  FramesHash hash;
  std::vector<std::string> found{hash.text()};
  for (const Snapshot& frame : t.frames) {
    hash.add(frame);
    found.push_back(hash.text());
  }
  return found;
}

std::string write_job_file(const Reference& of, const fs::path& folder, double interval,
                           const std::string& resume) {
  nlohmann::json job = of.job;
  job["output"] = folder.string();
  job["particles"] = of.particles;
  job["threads"] = 1;
  job["settings"].erase("checkpoint_interval");
  if (interval > 0.0) job["settings"]["checkpoint_interval"] = interval;
  if (!resume.empty()) job["resume"] = resume;
  const fs::path path = folder.parent_path() / (folder.filename().string() + ".job.json");
  std::ofstream(path) << job.dump();
  return path.string();
}

void set_plan(const std::string& folder, const std::string& at, const std::string& kind, unsigned seed,
              const std::string& log = "") {
  setenv("FAULT_PROCESS", program_invocation_short_name, 1);
  setenv("FAULT_FOLDER", folder.c_str(), 1);
  setenv("FAULT_AT", at.c_str(), 1);
  setenv("FAULT_KIND", kind.c_str(), 1);
  setenv("FAULT_SEED", std::to_string(seed).c_str(), 1);
  setenv("FAULT_LOG", log.c_str(), 1);
  fault_seam_begins();
}

std::string status_of(const fs::path& folder) {
  std::ifstream in(folder / "result.json");
  return in ? nlohmann::json::parse(in).value("status", "") : "";
}

bool is_whole(const Reference& of, const fs::path& folder) {
  return hashes_of(read_trajectory((folder / "trajectory.h5").string())) == of.hashes;
}

/// @return "", or what is wrong with a run that says it is whole
std::string fault_of_whole(const Reference& of, const fs::path& folder) {
  if (status_of(folder) != "ok") return "WRONG: exit 0, and the result does not say ok";
  if (!is_whole(of, folder)) return "WRONG: exit 0, and not every frame has its bits";
  return "";
}

/// One attempt: its faults and what became of it.
struct Attempt {
  std::vector<std::string> kinds;
  Ended end;
  [[nodiscard]] bool may_be_killed() const { return std::ranges::any_of(kinds, kills); }
  [[nodiscard]] bool loses_power() const { return std::ranges::find(kinds, "lost") != kinds.end(); }
  [[nodiscard]] bool is_harmless() const { return std::ranges::all_of(kinds, ::is_harmless); }
};

/// The word after `mark`, for each line that begins with it.
std::vector<std::string> words_after(const std::string& mark, const std::string& said) {
  std::vector<std::string> words;
  for (std::size_t from = 0; from < said.size();) {
    const std::size_t end = std::min(said.find('\n', from), said.size());
    const std::size_t word = from + mark.size();
    if (said.compare(from, mark.size(), mark) == 0)
      if (const std::size_t space = said.find(' ', word); space < end)
        words.push_back(said.substr(word, space - word));
    from = end + 1;
  }
  return words;
}

/// Number of frames that this attempt announced, counted from the first of the run.
std::size_t announced_frames(const std::string& said) {
  std::size_t most = 0;
  for (const std::string& number : words_after("frame ", said))
    most = std::max<std::size_t>(most, std::stoul(number) + 1);
  return most;
}

std::string last_checkpoint(const std::string& said) {
  const std::vector<std::string> all = words_after("checkpoint ", said);
  return all.empty() ? "" : all.back();
}

/// What is left behind, looked at without faults. @param goes_on whether a run is to go on from the
/// checkpoint   @return "", or which promise does not hold
std::string broken_promise(const Reference& of, const fs::path& folder, const Attempt& attempt,
                           const std::string& checkpoint, bool goes_on) {
  if (attempt.end.code == 0) return fault_of_whole(of, folder);
  if (status_of(folder) == "ok") {  // the last act: who dies after it has left all that it says
    if (attempt.end.code > 0) return "WRONG: the run did not end well, and its result says ok";
    if (!is_whole(of, folder))
      return "WRONG: killed after its result said ok, and not every frame has its bits";
  }
  if (const std::size_t count = announced_frames(attempt.end.said); count > 0 && !attempt.loses_power()) {
    const std::vector<std::string> there = hashes_of(read_trajectory((folder / "trajectory.h5").string()));
    if (there.size() <= count)
      return fmt::format("LOST: {} of {} announced frames are there", there.size() - 1, count);
    if (there[count] != of.hashes.at(count))
      return fmt::format("WRONG: the first {} announced frames have other bits", count);
  }
  if (checkpoint.empty() || !goes_on) return "";
  const fs::path again = folder.string() + ".again";
  fs::copy(folder, again, fs::copy_options::recursive);
  if (serve_job(write_job_file(of, again, 0.0, (again / fs::path(checkpoint).filename()).string())) != 0)
    return "LOST: the announced " + checkpoint + " is refused";
  return fault_of_whole(of, again);
}

/// In capitals what must not be; whole, died, refused what may.
std::string judged(const Reference& of, const fs::path& folder, const Attempt& attempt,
                   const std::string& checkpoint, bool goes_on) {
  const Ended& end = attempt.end;
  if (end.hung) return "HANG";
  if (end.code < 0 && !(end.code == -SIGKILL && attempt.may_be_killed()))
    return fmt::format("CRASH by signal {}", -end.code);
  if (end.code > 0 && attempt.is_harmless()) return "REFUSED what may be made again: " + end.said;
  if (end.code > 0 && std::ranges::find(codes, end.code) == codes.end())
    return fmt::format("CODE: exit {} means nothing", end.code);
  if (end.code > 0 && end.said.empty()) return fmt::format("SILENT: exit {} without a word", end.code);
  const Ended look = in_child(
      [&] {
        std::string found;
        try {
          found = broken_promise(of, folder, attempt, checkpoint, goes_on);
        } catch (const std::exception& e) {
          found = std::string("LOST: cannot be read: ") + e.what();
        }
        if (found.empty()) return 0;
        fmt::print(stderr, "\n\t{}", found);
        return 1;
      },
      true);
  if (look.code == 0) return end.code == 0 ? "whole" : end.code < 0 ? "died" : "refused";
  const std::size_t tab = look.said.rfind('\t');
  return tab == std::string::npos ? fmt::format("CRASH while it is looked at: {}, {}", look.code, look.said)
                                  : look.said.substr(tab + 1);
}

/// Books one run with its faults.
void accumulate(const Attempt& attempt, const std::string& what) {
  const std::size_t outcome = outcome_of(what);
  ++table->runs;
  ++table->runs_of[outcome];
  for (const std::string& kind : attempt.kinds) {
    ++table->faults;
    ++table->faults_of[static_cast<std::size_t>(std::ranges::find(kinds, kind) - kinds.begin())][outcome];
  }
}

/// One seed: attempts until one ends well, or as many as there may be. @return whether every promise held;
/// the story is of all attempts
bool try_seed(std::vector<Reference>& references, unsigned long seed, const fs::path& scratch,
              std::string& story) {
  std::mt19937_64 dice(seed);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(dice() % n); };
  Reference& of = references[below(references.size())];
  particles_read = &of.initial;
  const fs::path folder = scratch / std::to_string(seed);
  const int checkpoints = draws[below(draws.size())];
  const bool goes_on_each_time = seed % 8 == 0;
  std::string checkpoint, found;
  for (int n = 1; n <= most_attempts; ++n) {
    Attempt attempt;
    std::string at, kind;
    for (std::size_t k = 1 + below(3); k-- > 0;) {
      attempt.kinds.emplace_back(kinds[below(kinds.size())]);
      at += (at.empty() ? "" : ",") +
            std::to_string(1 +
                           below(static_cast<std::size_t>(of.calls[static_cast<std::size_t>(checkpoints)])));
      kind += (kind.empty() ? "" : ",") + attempt.kinds.back();
    }
    fs::create_directories(folder);
    const std::string job = write_job_file(of, folder, of.interval(checkpoints), checkpoint);
    attempt.end = in_child([&] {
      set_plan(folder.string(), at, kind, static_cast<unsigned>(dice()));
      return serve_job(job);
    });
    if (const std::string written = last_checkpoint(attempt.end.said); !written.empty()) checkpoint = written;
    const bool is_last = n == most_attempts || checkpoint.empty() || attempt.end.code == 0;
    found = judged(of, folder, attempt, checkpoint, is_last || goes_on_each_time);
    accumulate(attempt, found);
    fs::remove_all(folder.string() + ".again");
    story +=
        fmt::format("  attempt {}: calls {} fail by {}: exit {}: {}\n", n, at, kind, attempt.end.code, found);
    if (is_last || !is_good(found)) break;
  }
  fs::remove_all(folder);
  fs::remove(folder.string() + ".job.json");
  fs::remove(folder.string() + ".again.job.json");
  return is_good(found);
}

/// @param program that writes the job of a case; @param file of the case
Reference reference_of(const fs::path& program, const fs::path& file, const fs::path& scratch) {
  const fs::path from = scratch / file.stem();
  if (std::system(
          fmt::format("{} run {} --quiet --out {} >/dev/null", program.string(), file.string(), from.string())
              .c_str()) != 0)
    throw std::runtime_error(file.string() + " does not run");
  Reference of;
  std::ifstream in(from / "job.json");
  of.job = nlohmann::json::parse(in);
  of.particles = fs::absolute(from / "particles.h5").string();
  of.end_time = of.job.at("times").back().get<double>() - of.job.at("times").front().get<double>();
  of.initial = read_particles(of.particles);
  particles_read = &of.initial;
  for (const int checkpoints : draws) {
    if (of.calls[static_cast<std::size_t>(checkpoints)] > 0) continue;
    const fs::path folder = scratch / fmt::format("reference-{}-{}", file.stem().string(), checkpoints);
    fs::create_directories(folder);
    const std::string job = write_job_file(of, folder, of.interval(checkpoints), ""),
                      log = folder.string() + ".log";
    const Ended end = in_child([&] {
      set_plan(folder.string(), "0", "files", 0, log);
      return serve_job(job);
    });
    if (end.code != 0)
      throw std::runtime_error(from.string() + ": the undisturbed run ends with " + end.said);
    of.hashes = hashes_of(read_trajectory((folder / "trajectory.h5").string()));
    std::ifstream calls(log);
    for (std::string line; std::getline(calls, line);) ++of.calls[static_cast<std::size_t>(checkpoints)];
  }
  return of;
}

/// Takes seeds until there are none left. @return whether every promise held
bool work_on(std::vector<Reference>& references, unsigned long end, unsigned long runs,
             const fs::path& scratch) {
  bool good = true;
  while (!table->stop && table->runs < runs) {
    const unsigned long seed = table->next_seed++;
    if (seed >= end) break;
    std::string story;
    const bool held = try_seed(references, seed, scratch, story);
    ++table->seeds;
    good = good && held;
    if (held) continue;
    fmt::print("seed {} breaks a promise\n{}", seed, story);
    std::fflush(stdout);
  }
  return good;
}

/// A row a kind of fault, a column an outcome.
void print_table() {
  const auto row = [](const char* name, const auto& counts) {
    fmt::print("{:14}", name);
    for (const auto& count : counts) fmt::print("{:>9}", count.load());
    fmt::print("\n");
  };
  fmt::print("{:14}", "fault");
  for (const char* outcome : outcomes) fmt::print("{:>9}", outcome);
  fmt::print("\n");
  for (std::size_t k = 0; k < kinds.size(); ++k) row(kinds[k], table->faults_of[k]);
  row("runs", table->runs_of);
}

}  // namespace

// The linker hands calls of read_particles to this one (--wrap): the file of particles lies outside the
// folder in which calls fail, and reading eight particles took as long as all steps and frames of a run. Who
// reads it is the parent, once.
tripoint::InitialState particles_kept(const std::string& path) asm(
    "__wrap__ZN8tripoint14read_particlesERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE");
tripoint::InitialState particles_from_file(const std::string& path) asm(
    "__real__ZN8tripoint14read_particlesERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE");
tripoint::InitialState particles_kept(const std::string& path) {
  return particles_read ? *particles_read : particles_from_file(path);
}

int main(int argc, char** argv) {
  unsigned long count = 200, first = 1, jobs = 2, runs = 0;
  std::vector<fs::path> paths;
  for (int n = 1; n < argc; ++n) {
    const std::string word = argv[n];
    unsigned long* const number = word == "--count"  ? &count
                                  : word == "--seed" ? &first
                                  : word == "--jobs" ? &jobs
                                  : word == "--runs" ? &runs
                                                     : nullptr;
    if (number && n + 1 < argc)
      *number = std::strtoul(argv[++n], nullptr, 10);
    else
      paths.emplace_back(word);
  }
  if (paths.size() < 2) {
    fmt::print(stderr,
               "usage: seeded-faults BUILD CASE.toml... [--count N | --runs N] [--seed S] [--jobs N]\n");
    return 2;
  }
  const fs::path scratch =
      fs::path(fs::exists("/dev/shm") ? "/dev/shm" : "/tmp") / fmt::format("tripoint-seeded-{}", getpid());
  fs::create_directories(scratch);
  table =
      new (mmap(nullptr, sizeof(Table), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) Table{};
  table->next_seed = first;
  const unsigned long most = std::numeric_limits<unsigned long>::max(), end = runs > 0 ? most : first + count;
  std::vector<Reference> references;
  for (std::size_t n = 1; n < paths.size(); ++n) {
    particles_read = nullptr;
    references.push_back(reference_of(paths[0] / "bin/tripoint", paths[n], scratch));
  }

  signal(SIGINT, on_stop_of_all);
  signal(SIGTERM, on_stop_of_all);
  std::vector<pid_t> workers;
  for (unsigned long j = 0; j < jobs; ++j) {
    workers.push_back(fork());
    if (workers.back() != 0) continue;
    setpgid(0, 0);  // Ctrl-C is for the parent: runs would take it for theirs
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    const bool good = work_on(references, end, runs > 0 ? runs : most, scratch);
    std::_Exit(good ? 0 : 1);
  }
  bool good = true;
  for (const pid_t worker : workers) {
    int status = 0;
    while (waitpid(worker, &status, 0) < 0 && errno == EINTR) continue;
    good = good && status == 0;
  }
  fs::remove_all(scratch);
  print_table();
  fmt::print("{} runs with {} faults, of {} seeds from {} on: {}; --seed {} goes on\n", table->runs.load(),
             table->faults.load(), table->seeds.load(), first,
             good ? "every promise held" : "a promise was broken", std::min(table->next_seed.load(), end));
  return good ? 0 : 1;
}
