// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/errors.hpp"
#include "files/trajectory.hpp"
#include "program/bench/measure.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "validation/results/json_text.hpp"

namespace tripoint {
namespace {

using json = nlohmann::ordered_json;
using bench::Measured;
using bench::Spread;
using bench::Work;

constexpr const char* bench_description =
    "Times standard work on this machine, stage by stage, beside the machine's own limit. The limit is\n"
    "the same pair loops fused by hand in the best layout known, measured in the same seconds. Compare\n"
    "ratios, not seconds.\n"
    "  tripoint bench\n"
    "  tripoint bench --work liquid-heat-40k --threads 2 --json\n"
    "  tripoint bench --growth --threads 1    cost a particle-step of liquid with heat from 1,000 "
    "to 2,000,000 particles";

struct BenchOptions {
  std::vector<std::string> work;
  int threads = 0, rounds = 12;
  long steps = 0;
  bool list = false, growth = false, as_document = false;
  std::string particles;
};

/// 10 to 126 across: 1,000 to 2,000,376 particles.
constexpr int ladder[] = {10, 16, 34, 58, 100, 126};

json as_json(const Spread& s) { return {{"median", s.median}, {"best", s.best}, {"worst", s.worst}}; }

json as_json(const Work& work, const Measured& m) {
  json stages;
  for (std::size_t k = 0; k < stage_names.size(); ++k) stages[std::string(stage_names[k])] = m.stages[k];
  stages["outside"] = m.outside;
  json row{{"name", work.name},
           {"case", work.case_id},
           {"mode", to_string(work.mode)},
           {"set", work.set},
           {"particles", m.particles},
           {"threads", m.threads},
           {"steps", m.steps},
           {"step_s", as_json(m.step_seconds)},
           {"particle_steps_per_s", m.particle_steps_per_second()},
           {"setup_s", m.setup_seconds},
           {"time_step", m.time_step},
           {"support", m.support},
           {"cpu_s", m.cpu_seconds.median},
           {"stages_s", stages},
           {"search_share", m.search_share()},
           {"rebuilds_per_step", m.rebuilds},
           {"bytes", m.bytes},
           {"bytes_per_particle", m.bytes / static_cast<double>(m.particles)},
           {"planned_bytes_per_particle", m.planned_bytes},
           {"state_hash", m.state_hash}};
  if (m.bonds > 0.0) row["bonds_per_particle"] = m.bonds / static_cast<double>(m.particles);
  if (m.limit) {
    row["neighbours"] = m.pairs / static_cast<double>(m.particles);
    row["pairs_per_s"] = m.pairs_per_second();
    row["limit"] = {{"lanes", m.limit->lanes},
                    {"search_s", m.limit->search},
                    {"density_s", m.limit->density},
                    {"rates_s", m.limit->rates},
                    {"again_s", m.limit->again},
                    {"step_s", m.limit->step(m.rebuilds)},
                    {"cpu_s", m.limit_cpu},
                    {"particle_steps_per_s", static_cast<double>(m.particles) / m.limit->step(m.rebuilds)}};
    row["over_limit"] = as_json(m.over_limit);
    row["over_limit_cpu"] = as_json(m.over_limit_cpu);
  }
  return row;
}

void print_header() {
  print(fmt::format("{:26} {:>9} {:>3} {:>19} {:>8} {:>8} {:>8} {:>15} {:>8} {:>7}  {}\n", "work",
                    "particles", "thr", "ms/step (best)", "M p-s/s", "M pair/s", "limit ms", "x limit (CPU)",
                    "rebuilds", "B/part.", "share of the step"));
}

/// The stages that take most, in per cent of the step.
std::string shares(const Measured& m) {
  std::vector<std::pair<double, std::string_view>> parts{{m.outside, "outside"}};
  double all = m.outside;
  for (std::size_t k = 0; k < stage_names.size(); ++k) {
    parts.emplace_back(m.stages[k], stage_names[k]);
    all += m.stages[k];
  }
  std::ranges::sort(parts, std::ranges::greater{});
  std::string text;
  for (const auto& [seconds, name] : parts)
    if (seconds > 0.02 * all)
      text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", name, 100.0 * seconds / all);
  return text;
}

void print_row(const Work& work, const Measured& m) {
  const auto limit = [&](const std::string& text) { return m.limit ? text : std::string("-"); };
  print(fmt::format("{:26} {:9} {:3} {:10.3f} ({:.3f}) {:8.3f} {:>8} {:>8} {:>15} {:8.3f} {:7.0f}  {}\n",
                    work.name, m.particles, m.threads, 1e3 * m.step_seconds.median, 1e3 * m.step_seconds.best,
                    1e-6 * m.particle_steps_per_second(),
                    limit(fmt::format("{:.1f}", 1e-6 * m.pairs_per_second())),
                    limit(m.limit ? fmt::format("{:.3f}", 1e3 * m.limit->step(m.rebuilds)) : ""),
                    limit(fmt::format("{:.2f} ({:.2f})", m.over_limit.median, m.over_limit_cpu.median)),
                    m.rebuilds, m.bytes / static_cast<double>(m.particles), shares(m)));
}

json machine() {
  std::ifstream file("/proc/cpuinfo");
  std::string cpu = "unknown";
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) cpu = line.substr(line.find(':') + 2);
  return {{"cpu", cpu.substr(0, cpu.find('\n'))}, {"cores", std::thread::hardware_concurrency()}};
}

std::vector<Work> chosen(const BenchOptions& o) {
  if (o.growth) {
    std::vector<Work> list;
    for (const int across : ladder) list.push_back(bench::liquid_heat(across, Mode::paper));
    return list;
  }
  const auto& all = bench::standard_work();
  if (o.work.empty()) return all;
  std::vector<Work> list;
  for (const std::string& name : o.work) {
    const auto place = std::ranges::find(all, name, &Work::name);
    if (place == all.end())
      throw InputError("no standard work is named " + name + " (tripoint bench --list prints the names)");
    list.push_back(*place);
  }
  return list;
}

int list_work() {
  for (const Work& w : bench::standard_work())
    print(fmt::format("{:26} {:9} {}\n", w.name, to_string(w.mode), w.case_id));
  return 0;
}

int run_bench(const BenchOptions& o) {
  if (o.list) return list_work();
  const std::vector<Work> works = chosen(o);
  if (!o.particles.empty()) {
    write_particles(o.particles, bench::prepare(works.front()).particles);
    return 0;
  }
  bench::MeasureOptions how;
  how.threads =
      o.threads > 0 ? o.threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  how.rounds = o.rounds;
  if (o.steps > 0) how.steps = o.steps;
  json rows = json::array();
  if (!o.as_document) print_header();
  for (const Work& w : works) {
    const Measured m = bench::measure(w, how);
    if (o.as_document)
      rows.push_back(as_json(w, m));
    else
      print_row(w, m);
  }
  if (o.as_document)
    print(
        json_text(json{{"format", 1}, {"machine", machine()}, {"threads", how.threads}, {"works", rows}}, 2));
  return 0;
}

}  // namespace

void add_bench(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("bench", bench_description);
  auto o = std::make_shared<BenchOptions>();
  command->add_option("--work", o->work, "only this piece of standard work; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--threads", o->threads, "default: all cores")->check(CLI::Range(1, 1024));
  command->add_option("--steps", o->steps, "steps of the timed part, default: 120")
      ->check(CLI::Range(1L, 1000000000L));
  command
      ->add_option("--rounds", o->rounds,
                   "parts that they are timed in, each followed by a round of the limit")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command
      ->add_option("--particles", o->particles,
                   "runs nothing: writes the particles that the work starts from, for other codes")
      ->type_name("FILE.h5");
  command->add_flag("--list", o->list, "print the standard work");
  command->add_flag("--growth", o->growth, "liquid with heat, from 1,000 to 2,000,000 particles");
  command->add_flag("--json", o->as_document, "print one JSON document");
  command->callback([o, &exit_code] { exit_code = guarded([&] { return run_bench(*o); }); });
}

}  // namespace tripoint
