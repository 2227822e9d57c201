// SPDX-License-Identifier: BSD-3-Clause
#include "program/cli/predict_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"

namespace tripoint {
namespace {

using json = nlohmann::ordered_json;
using predict::Prediction;

/// One line each, the same in the table and in JSON.
const std::vector<std::string>& assumptions() {
  static const std::vector<std::string> lines{
      "work: seconds fixed, a particle and a pair, fitted to CPU seconds on one rank here; a rank pays them "
      "for its ghosts too, as it computes them",
      "shares: the decomposition at the start; what moves later and is not balanced again is not seen",
      "every rank has a core of its own, and is as slow beside others as runs on one rank are that go at "
      "once on this machine, "
      "apart from each other; no core is slow for another reason",
      "network: each message has the same latency and each rank its whole bandwidth, however many send; "
      "messages do not overlap "
      "with work",
      "bonds are part of the cost of a particle, and what they send with a new share is not counted",
      "new neighbour lists are made as often as in the timed steps",
      "memory: what one rank took at most, a particle, and the whole scene on every rank, which holds it as "
      "it starts"};
  return lines;
}

std::vector<std::string> outside(const PredictionReport& r) {
  int most = 1;
  for (const auto& line : r.lines)
    if (line.measured) most = std::max(most, line.measured->ranks);
  std::vector<std::string> text{
      fmt::format("measured here: one rank{}, on one machine; everything beyond is prediction",
                  most > 1 ? fmt::format(", and up to {} ranks beside the prediction", most) : "")};
  bool crowded = false, scaled = false;
  for (const auto& line : r.lines) {
    crowded = crowded || line.prediction.ranks > r.machine.cores_a_node;
    scaled = scaled || !line.prediction.counted;
  }
  if (crowded)
    text.push_back(
        fmt::format("more ranks than the {} cores of a node: the latency and bandwidth between nodes are "
                    "taken to be those given",
                    r.machine.cores_a_node));
  if (scaled)
    text.push_back("lines \"by volume\" scale the scene's own particles to another number, by its shape");
  if (std::any_of(r.lines.begin(), r.lines.end(), [](const auto& l) { return l.prediction.ranks > 1024; }))
    text.push_back("the engine takes at most 1024 ranks today");
  return text;
}

json of(const PredictedLine& line) {
  const Prediction& p = line.prediction;
  json row{{"prediction", true},
           {"scaling", line.weak ? "weak" : "strong"},
           {"ranks", p.ranks},
           {"grid", line.grid},
           {"particles", p.particles},
           {"particles_a_rank", p.own},
           {"copies_over_own", p.copies / p.own},
           {"shares", p.counted ? "counted" : "by volume"},
           {"ms_a_step", 1e3 * p.seconds()},
           {"ms_of",
            {{"work", 1e3 * p.work},
             {"messages", 1e3 * p.messages},
             {"transport", 1e3 * p.transport},
             {"collectives", 1e3 * p.collectives},
             {"waiting", 1e3 * p.waiting}}},
           {"speed_at_once", p.speed_at_once},
           {"imbalance", p.imbalance},
           {"efficiency", p.efficiency},
           {"particle_steps_a_second", p.rate()},
           {"gb_a_rank", 1e-9 * p.bytes},
           {"gb_of_whole_scene", 1e-9 * p.scene_bytes},
           {"rank_0", {{"own", line.first.own}, {"copies", line.first.copies}, {"pairs", line.first.pairs}}}};
  if (!line.measured) return row;
  const Timed& t = *line.measured;
  json repeats = json::array();
  for (const double s : t.wall) repeats.push_back(1e3 * s);
  row["measured"] = {{"ms_a_step", 1e3 * t.best.wall()},
                     {"repeats_ms", repeats},
                     {"cpu_ms_of_rank_0", 1e3 * t.best.cpu()},
                     {"steps", t.steps},
                     {"efficiency", line.measured_efficiency},
                     {"speed_at_once", line.measured_at_once},
                     {"efficiency_of_cores", line.measured_efficiency / line.measured_at_once},
                     {"undisturbed_ms_a_step", 1e3 * t.best.undisturbed()},
                     {"undisturbed_efficiency", line.undisturbed_efficiency},
                     {"difference_percent", 100.0 * (p.seconds() / t.best.wall() - 1.0)},
                     {"undisturbed_difference_percent", 100.0 * (p.seconds() / t.best.undisturbed() - 1.0)},
                     {"gb_a_rank", 1e-9 * t.bytes},
                     {"rank_0", {{"own", t.own}, {"copies", t.copies}, {"pairs", t.pairs}}}};
  return row;
}

std::string head(const json& d) {
  const json& m = d.at("machine");
  return fmt::format(
      "prediction of {} on {} ({}): latency {:.3g} us, bandwidth {:.3g} GB/s, allreduce {:.3g} us a "
      "doubling, waiting {:.0f} %\n",
      d.at("case").get<std::string>(), m.at("name").get<std::string>(), m.at("source").get<std::string>(),
      1e6 * m.at("latency").get<double>(), 1e-9 * m.at("bandwidth").get<double>(),
      1e6 * m.at("allreduce").get<double>(), 100.0 * m.at("waiting").get<double>());
}

std::string predicted_table(const json& rows) {
  std::string text = fmt::format("{:10} {:>7} {:>10} {:>11} {:>10} {:>11} {:>10} {:>12} {:>9}  {}\n",
                                 "prediction", "ranks", "particles", "a rank", "ghosts/own", "ms a step",
                                 "efficiency", "part.-st./s", "GB a rank", "shares");
  for (const json& r : rows)
    text += fmt::format("{:10} {:7} {:10.4g} {:11.4g} {:10.3f} {:11.4g} {:10.3f} {:12.4g} {:9.3g}  {}\n",
                        r.at("scaling").get<std::string>(), r.at("ranks").get<int>(),
                        r.at("particles").get<double>(), r.at("particles_a_rank").get<double>(),
                        r.at("copies_over_own").get<double>(), r.at("ms_a_step").get<double>(),
                        r.at("efficiency").get<double>(), r.at("particle_steps_a_second").get<double>(),
                        r.at("gb_a_rank").get<double>(), r.at("shares").get<std::string>());
  return text;
}

std::string measured_table(const json& rows) {
  std::string text;
  for (const json& r : rows) {
    if (!r.contains("measured")) continue;
    const json& m = r.at("measured");
    const double efficiency = m.at("efficiency").get<double>(), measured = m.at("ms_a_step").get<double>(),
                 off = m.at("difference_percent").get<double>(), at_once = r.value("speed_at_once", 1.0);
    text += fmt::format(
        "{:10} {:7} {:10.4g} | {:9.4g} {:10.3f} {:8.3f} | {:9.4g} {:+8.1f} {:10.3f} {:8.3f} {:12.3f} | "
        "{:9.4g} {:+8.1f} {:10.3f} "
        "| "
        "{:8} {:8}\n",
        r.at("scaling").get<std::string>(), r.at("ranks").get<int>(), r.at("particles").get<double>(),
        r.at("ms_a_step").get<double>(), r.at("efficiency").get<double>(), at_once, measured, off, efficiency,
        m.value("speed_at_once", at_once), m.value("efficiency_of_cores", efficiency),
        m.value("undisturbed_ms_a_step", measured), m.value("undisturbed_difference_percent", off),
        m.value("undisturbed_efficiency", efficiency), r.at("rank_0").at("copies").get<double>(),
        m.at("rank_0").at("copies").get<double>());
  }
  if (text.empty()) return text;
  return "\nmeasured beside the prediction, which is of cores that nothing slows. Undisturbed: of each part "
         "of a step the work "
         "of the "
         "slowest rank,\n"
         "each at its best of the repeats, and the shortest call: as if no core were ever slow. Shortest "
         "parts: of each part the "
         "shortest, in which\n"
         "all cores were fast at once. At once: speed of one rank where as many runs of one rank go at once, "
         "over one alone; "
         "eff. of "
         "that: what\n"
         "ranks have of what cores leave. Off by: the prediction over that time\n" +
         fmt::format("{:29} | {:29} | {:51} | {:29} | ghosts\n", "", "prediction", "shortest parts",
                     "undisturbed") +
         fmt::format(
             "{:10} {:>7} {:>10} | {:>9} {:>10} {:>8} | {:>9} {:>8} {:>10} {:>8} {:>12} | {:>9} {:>8} {:>10} "
             "| {:>8} {:>8}\n",
             "", "ranks", "particles", "ms", "efficiency", "at once", "ms", "off by %", "efficiency",
             "at once", "eff. of that", "ms", "off by %", "efficiency", "pred.", "meas.") +
         text;
}

}  // namespace

json prediction_json(const PredictionReport& r) {
  const auto& m = r.machine;
  json runs = json::array(), rows = json::array();
  for (std::size_t n = 0; n < r.runs.size(); ++n)
    runs.push_back({{"run", r.labels[n]},
                    {"particles", r.runs[n].particles},
                    {"pairs", r.runs[n].pairs},
                    {"cpu_ms_a_step", 1e3 * r.runs[n].seconds},
                    {"peak_bytes", r.runs[n].bytes},
                    {"fitted_ms", 1e3 * r.cost.seconds(r.runs[n].particles, r.runs[n].pairs)}});
  for (const auto& line : r.lines) rows.push_back(of(line));
  return {{"format", 1},
          {"kind", "prediction"},
          {"case", r.case_id},
          {"set", r.set},
          {"version", r.version},
          {"machine",
           {{"name", m.name},
            {"source", m.source},
            {"cores_a_node", m.cores_a_node},
            {"latency", m.latency},
            {"bandwidth", m.bandwidth},
            {"allreduce", m.allreduce},
            {"pack_rate", m.pack_rate},
            {"core_speed", m.core_speed},
            {"waiting", m.waiting}}},
          {"measured_on",
           {{"cpu", r.cpu},
            {"cores", r.cores},
            {"repeats", r.went.repeats},
            {"settled", r.went.settled},
            {"looks_at_cores", r.went.looks},
            {"slow_looks", r.went.slow_looks},
            {"waited_s", r.went.waited}}},
          {"cost",
           {{"fixed_s", r.cost.fixed},
            {"particle_s", r.cost.particle},
            {"pair_s", r.cost.pair},
            {"worst_misfit", r.cost.worst_misfit}}},
          {"memory",
           {{"base_bytes", r.memory.base},
            {"scene_bytes_a_particle", r.memory.scene},
            {"bytes_a_held_particle", r.memory.particle}}},
          {"traffic_a_step",
           {{"exchanges", r.traffic.exchanges},
            {"numbers_a_copy", r.traffic.numbers_a_copy},
            {"collectives", r.traffic.collectives},
            {"new_shares", r.traffic.migrations},
            {"columns", r.traffic.columns}}},
          {"one_rank", runs},
          {"rows", rows},
          {"assumptions", assumptions()},
          {"outside_measured", outside(r)},
          {"notes", r.notes}};
}

std::string prediction_text(const json& d) {
  try {
    if (d.at("kind") != "prediction" || d.at("format") != 1)
      throw InputError("it is no prediction of format 1");
    const json &c = d.at("cost"), &rows = d.at("rows"), &on = d.at("measured_on");
    std::string text = head(d);
    text += fmt::format(
        "cost on one rank of {} ({} cores): {:.4g} us a step + {:.4g} ns a particle + {:.4g} ns a pair; "
        "worst misfit of its {} "
        "runs {:.1f} %\n\n",
        on.at("cpu").get<std::string>(), on.at("cores").get<int>(), 1e6 * c.at("fixed_s").get<double>(),
        1e9 * c.at("particle_s").get<double>(), 1e9 * c.at("pair_s").get<double>(), d.at("one_rank").size(),
        100.0 * c.at("worst_misfit").get<double>());
    text += predicted_table(rows) + measured_table(rows) + "\nassumptions of the prediction\n";
    for (const json& line : d.at("assumptions")) text += "  " + line.get<std::string>() + "\n";
    text += "outside what was measured\n";
    for (const json& line : d.at("outside_measured")) text += "  " + line.get<std::string>() + "\n";
    for (const json& line : d.at("notes")) text += "note: " + line.get<std::string>() + "\n";
    return text;
  } catch (const json::exception& e) {
    throw InputError(std::string("it is no result of tripoint predict: ") + e.what());
  }
}

}  // namespace tripoint
