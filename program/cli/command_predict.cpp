// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "program/cli/predict_runs.hpp"
#include "program/cli/predict_text.hpp"
#include "program/cli/predict_turns.hpp"
#include "program/predict/kit.hpp"
#include "validation/campaign/case_names.hpp"
#include "validation/campaign/suite.hpp"
#include "validation/case/read_case.hpp"
#include "validation/results/interrupt.hpp"
#include "validation/results/json_text.hpp"
#include "validation/results/results.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace {

constexpr const char* predict_description =
    "Predicts the cost of a step of a case on many ranks of the engine tripoint-mpi: time, efficiency,\n"
    "memory. Three short runs on one rank give the cost of a particle and a pair. A probe of MPI between\n"
    "two ranks gives latency and bandwidth. The particles are shared out as the engine would do it. Every\n"
    "table says which figures are predictions; --measure runs them beside.\n"
    "  tripoint predict heat/cosine-mode --ranks 2,4,64\n"
    "  tripoint predict fluid/dam-break-small --ranks 1024,10240 --particles 1e8,1e9 --machine "
    "cluster.toml\n"
    "  tripoint predict heat/cosine-mode --ranks 1,2 --measure 1,2 --set scene.spacing='0.125 mm'   "
    "with this machine's figures beside\n"
    "  tripoint predict speed/liquid-heat --measure 1,2 --weak-set "
    "'body.cube.shape.max=[0.34,0.34,0.68]'    as many particles a rank\n"
    "  tripoint predict heat/cosine-mode --ranks 1,2,4,8 --kit > kit.sh                one file for "
    "a cluster: sbatch kit.sh\n"
    "  tripoint predict --compare FILE.json                                            figures that "
    "the kit has brought back\n"
    "A machine file (TOML) has name, cores_a_node, latency (s), bandwidth (bytes/s). It may have\n"
    "allreduce (s), pack_rate (bytes/s), core_speed (of its cores over these) and speed_at_once (of a\n"
    "core where all have work, over one alone). It may also have waiting (fraction of the work, 0.05).\n"
    "Exit: 0 done, 2 bad input, 4 the engine is missing or cannot run the case over ranks.";

/// Particles times ranks up to which shares are counted one by one; beyond, they are scaled by volume.
constexpr double most_counted = 1e9;
/// [s] of a message between two processes of one machine: fifty times that of a quiet one
constexpr double slow_latency = 1e-4;
constexpr int most_repeats_by_default = 40;  ///< where other work slows the cores, times settle late
constexpr int most_ranks = 1000000, most_measured = 1024;

struct PredictOptions {
  std::string what, machine, out, compare;
  std::vector<int> ranks, measure;
  std::vector<double> particles;
  std::vector<std::string> set, larger;
  int repeats = 3, most_repeats = most_repeats_by_default;
  double seconds = 1.5, patience = 60.0;
  bool weak = false, kit = false, quiet = false, json = false;
};

std::string text_of(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw InputError(path + ": cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

int compare(const PredictOptions& o) {
  const auto document = nlohmann::ordered_json::parse(text_of(o.compare), nullptr, false);
  if (document.is_discarded()) throw InputError(o.compare + ": is no JSON");
  print(o.json ? json_text(document, 2) : prediction_text(document));
  return exit_pass;
}

void check(const std::vector<int>& list, const char* option, int most) {
  for (const int n : list)
    if (n < 1 || n > most)
      throw InputError(fmt::format("{} {}: write whole numbers from 1 to {}", option, n, most));
}

predict::Shares shares_of(const predict::Cloud& cloud, int ranks, double particles, bool& counted) {
  const auto own = static_cast<double>(cloud.position.size());
  counted = particles == own && own * ranks <= most_counted;
  return counted ? predict::share_out(cloud, ranks) : predict::share_volume(cloud, ranks, particles);
}

/// Of a core of a node with so many ranks, over its speed where no other has work.
double speed_where_all_work(const PredictionReport& r, int ranks) {
  if (r.machine.speed_at_once) return *r.machine.speed_at_once;
  const auto found = r.speed_at_once.upper_bound(ranks);
  return found == r.speed_at_once.begin() ? 1.0 : std::prev(found)->second;
}

PredictedLine line_of(const PredictionReport& r, const predict::Cloud& cloud, const predict::Share& whole,
                      int ranks, double particles) {
  PredictedLine line;
  bool counted = false;
  const predict::Shares shares = shares_of(cloud, ranks, particles, counted);
  line.prediction =
      predict::predict(shares, whole, r.cost, r.memory, r.traffic, r.machine, speed_where_all_work(r, ranks));
  line.prediction.particles = particles;  // shares by volume add up to it but for rounding
  line.prediction.counted = counted;
  line.grid = shares.grid;
  line.first = shares.ranks.front();
  return line;
}

/// The scene on one rank: its particles and pairs.
predict::Share whole_of(const predict::Cloud& cloud, double particles) {
  bool counted = false;
  return shares_of(cloud, 1, particles, counted).ranks.front();
}

/// The line of the scene as it is on these ranks; where there is none it is added.
std::size_t line_on(PredictionReport& r, const Prepared& base, int ranks) {
  const auto particles = static_cast<double>(base.initial.size());
  const auto found = std::find_if(r.lines.begin(), r.lines.end(), [&](const auto& l) {
    return l.prediction.ranks == ranks && l.prediction.particles == particles;
  });
  if (found != r.lines.end()) return static_cast<std::size_t>(found - r.lines.begin());
  r.lines.push_back(line_of(r, base.cloud, whole_of(base.cloud, particles), ranks, particles));
  return r.lines.size() - 1;
}

/// Predicts each line, and puts what was measured beside it.
void add_lines(PredictionReport& r, const PredictOptions& o, const RunsInTurns& runs) {
  const Prepared& base = runs.one_rank.front();
  const auto sampled = static_cast<double>(base.initial.size());
  for (const double particles : o.particles.empty() ? std::vector<double>{sampled} : o.particles) {
    const predict::Share whole = whole_of(base.cloud, particles);
    for (const int ranks : o.ranks) r.lines.push_back(line_of(r, base.cloud, whole, ranks, particles));
  }
  for (const int ranks : o.measure) r.lines[line_on(r, base, ranks)].measured = runs.on(ranks);
  for (const auto& [ranks, larger] : runs.larger) {
    const auto particles = static_cast<double>(larger.initial.size());
    r.lines.push_back(line_of(r, larger.cloud, whole_of(larger.cloud, particles), ranks, particles));
    r.lines.back().weak = true;
    if (const auto found = runs.weak.find(ranks); found != runs.weak.end())
      r.lines.back().measured = found->second;
  }
  const auto on_one = [&](double seconds, const PredictedLine& line) {
    return seconds / sampled * line.prediction.particles / line.prediction.ranks;
  };
  for (PredictedLine& line : r.lines) {
    if (!line.measured) continue;
    line.measured_efficiency = on_one(runs.alone().best.wall(), line) / line.measured->best.wall();
    if (const auto found = runs.at_once.find(std::min(line.prediction.ranks, r.cores));
        found != runs.at_once.end())
      line.measured_at_once = std::min(1.0, runs.alone().best.wall() / found->second.best.wall());
    line.undisturbed_efficiency =
        on_one(runs.alone().best.undisturbed(), line) / line.measured->best.undisturbed();
  }
}

TurnsWanted turns_wanted(const PredictOptions& o, int cores) {
  TurnsWanted wanted;
  wanted.ranks = o.ranks;
  wanted.measure = o.measure;
  wanted.larger = o.larger;
  wanted.weak = o.weak;
  wanted.repeats = o.repeats;
  wanted.most_repeats = std::max(o.repeats, o.most_repeats);
  wanted.patience = o.patience;
  wanted.cores = cores;
  wanted.quiet = o.quiet;
  return wanted;
}

int predict_case(PredictOptions o) {
  catch_interrupts();
  const std::string file = shown_path(case_file(o.what));
  const Case value = read_case(file, o.set).value;
  PredictionReport r;
  if (!o.machine.empty()) r.machine = predict::read_machine(o.machine);
  if (o.out.empty()) o.out = own_folder("predict", value.id);
  const auto lock = hold_folder(o.out);
  const Tool tool = this_tool();
  r.case_id = value.id;
  r.version = tool.version;
  r.set = o.set;
  r.cpu = tool.cpu;
  r.cores = tool.cores;
  PredictRuns engine(file, o.set, o.out, o.seconds, o.quiet);
  const RunsInTurns runs = run_in_turns(engine, turns_wanted(o, r.cores), r.notes);
  if (interrupted()) return exit_interrupted;
  for (std::size_t k = 0; k < runs.one_rank.size(); ++k) {
    const Prepared& p = runs.one_rank[k];
    const Timed& t = runs.one_rank_timed[k];
    r.runs.push_back({static_cast<double>(p.initial.size()),
                      whole_of(p.cloud, static_cast<double>(p.initial.size())).worked, t.best.cpu(),
                      t.bytes});
    r.labels.push_back(p.label);
  }
  r.cost = predict::fit_work(r.runs);
  r.memory = predict::fit_memory(r.runs, runs.one_rank.front().weight_bytes);
  r.traffic = runs.alone().traffic;
  r.went = runs.went;
  for (const auto& [count, timed] : runs.at_once)
    r.speed_at_once[count] = std::min(1.0, runs.alone().best.undisturbed() / timed.best.undisturbed());
  if (o.machine.empty()) r.machine = engine.probe();
  if (o.machine.empty() && r.machine.latency > slow_latency)
    r.notes.push_back(
        fmt::format("the probe found {:.3g} us for a message: other programs hold the cores, so that what is "
                    "said of messages is "
                    "far too slow; probe a quiet machine, or give --machine",
                    1e6 * r.machine.latency));
  add_lines(r, o, runs);
  const nlohmann::ordered_json document = prediction_json(r);
  print(o.json ? json_text(document, 2) : prediction_text(document));
  return exit_pass;
}

int predict_for(PredictOptions o) {
  if (!o.compare.empty()) return compare(o);
  if (o.what.empty()) throw InputError("predict: name a case, or --compare a result.json");
  if (o.ranks.empty()) o.ranks = o.measure;
  if (o.ranks.empty()) throw InputError("predict: say --ranks N[,N...]");
  if (!o.larger.empty()) o.weak = true;
  const std::vector<int>& larger_on = o.measure.empty() ? o.ranks : o.measure;
  if (!o.larger.empty() && std::count_if(larger_on.begin(), larger_on.end(), [](int n) { return n > 1; }) > 1)
    throw InputError("--weak-set makes one larger scene: name one number of ranks beside 1");
  check(o.ranks, "--ranks", most_ranks);
  check(o.measure, "--measure", most_measured);
  for (const double n : o.particles)
    if (!(n >= 1.0 && n <= 1e15))
      throw InputError(fmt::format("--particles {:g}: write numbers from 1 to 1e15", n));
  if (!o.kit) return predict_case(std::move(o));
  // a kit that cannot run is found out here
  static_cast<void>(read_case(shown_path(case_file(o.what)), o.set));
  if (!o.larger.empty())
    throw InputError("--weak-set: a kit makes its larger scenes finer; leave one of the two out");
  check(o.ranks, "--ranks", most_measured);
  std::sort(o.ranks.begin(), o.ranks.end());
  print(predict::kit_script(o.what, o.set, o.ranks));
  return exit_pass;
}

}  // namespace

void add_predict(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("predict", predict_description);
  auto o = std::make_shared<PredictOptions>();
  command->add_option("CASE", o->what, "a case file or id");
  command->add_option("--ranks", o->ranks, "numbers of ranks to predict, N[,N...]")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--particles", o->particles,
                   "numbers of particles instead of the case's own, by its shape: 1e7,1e9")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--machine", o->machine, "a machine file (TOML) in the place of the probe")
      ->type_name("FILE");
  command->add_option("--measure", o->measure, "numbers of ranks to run here too, beside the prediction")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_flag("--weak", o->weak, "also P times the particles on P ranks, by a finer spacing");
  command
      ->add_option(
          "--weak-set", o->larger,
          "a.b=VALUE makes the scene of --weak larger, in the place of a finer spacing; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  command
      ->add_option("--repeats", o->repeats,
                   "of each run at least, in turns; the best time of each part of a step counts")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command
      ->add_option("--most-repeats", o->most_repeats,
                   "of each run at most; repeats end when three in a row lower no time by 0.5 %")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command
      ->add_option("--patience", o->patience,
                   "seconds to wait in all for cores that are slow before a run; 0: none")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--seconds", o->seconds, "of each run on one rank, about")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--set", o->set, "a.b=VALUE replaces a key of the case file; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--out", o->out, "folder of the runs (default: report-predict/CASE)");
  command->add_flag("--kit", o->kit,
                    "runs nothing: prints one shell file that measures the case on a cluster");
  command->add_option("--compare", o->compare, "runs nothing: prints this result, measured beside predicted")
      ->type_name("RESULT");
  command->add_flag("--quiet", o->quiet, "no progress on stderr");
  command->add_flag("--json", o->json, "print one JSON document");
  command->callback([o, &exit_code] { exit_code = guarded([&] { return predict_for(*o); }); });
}

}  // namespace tripoint
