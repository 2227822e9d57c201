// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "validation/case/choices.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/case/gated_metric.hpp"
#include "validation/case/idle_search.hpp"

/// Parts of a case's judgement that no run of it can show.
namespace tripoint {
namespace {

/// A limit below 0 passes nothing; a floor of 0 under a value that is never negative passes anything.
void can_fail(IdleSearch& in, const Gate& g) {
  if (is_order(g.metric)) return;
  if (g.limit && *g.limit < 0.0)
    in.error(
        g.place,
        fmt::format(
            "the gate on \"{}\" has limit {}, which nothing can pass: a limit is of the magnitude, which is "
            "never below 0; write a positive number, or a band",
            g.metric, *g.limit));
  const auto m = std::ranges::find(in.value.metrics, g.metric, &MetricChoice::name);
  static constexpr std::array of_sizes{Norm::L1,  Norm::L2,  Norm::L2raw, Norm::L2mean,
                                       Norm::max, Norm::rms, Norm::drift, Norm::chi};
  const bool never_negative =
      m != in.value.metrics.end() && std::ranges::find(of_sizes, m->norm) != of_sizes.end();
  if (never_negative && g.at_least && *g.at_least <= 0.0 && !g.limit && !g.band)
    in.error(
        g.place,
        fmt::format(
            "the gate on \"{}\" passes anything: at least {} is asked, and the norm {} is never below 0; "
            "write a positive number, or a limit",
            g.metric, *g.at_least, m->norm));
}

void unread_reference(IdleSearch& in) {
  const bool exact =
      std::ranges::any_of(in.value.engines, [](const EngineChoice& e) { return is_exact(e.name); });
  const auto reads_it = [](const MetricChoice& m) { return !m.reference && m.norm != Norm::drift; };
  if (const auto place = in.given("reference.function"); !place.file.empty() && !exact &&
                                                         !in.value.metrics.empty() &&
                                                         std::ranges::none_of(in.value.metrics, reads_it))
    in.warn(place,
            "[reference] is compared with nothing: each metric has a reference of its own, or measures a "
            "drift from the start");
}

/// A norm in space reads `at`, one over time reads `window`.
void unread_time(IdleSearch& in, const MetricChoice& m) {
  const auto place = in.given("metric." + m.name + ".at");
  const bool in_space = is_spatial(m.norm);
  if (!place.file.empty() && m.at != "end" && !in_space)
    in.warn(
        place,
        fmt::format(
            "metric \"{}\": the norm {} is over all output times of the window, and reads no `at`: give a "
            "window, or a norm in space (L1 L2 L2raw Linf chi)",
            m.name, m.norm));
  if (const auto from = in.given("metric." + m.name + ".window");
      !from.file.empty() && in_space && m.at != "all")
    in.warn(
        from,
        fmt::format(
            "metric \"{}\": the norm {} is taken at `at` = \"{}\", and reads no window: write at = \"all\", "
            "or remove the window",
            m.name, m.norm, m.at));
}

/// A run has no output after its end.
void measured_after_the_end(IdleSearch& in, const MetricChoice& m) {
  const double end = in.scene.end_time;
  if (m.window[1] > end * (1.0 + 1e-9))
    in.warn(
        in.given("metric." + m.name + ".window"),
        fmt::format("metric \"{}\": its window lasts until {} s, and the run ends at end_time = {} s: run "
                    "longer, or shorten the window",
                    m.name, m.window[1], end));
}

/// Runs that differ by their seed alone differ in nothing where nothing is random.
void unread_seeds(IdleSearch& in, const Study& s) {
  const auto may_be_random = [](const EngineChoice& e) {
    return is_lammps(e.name) || e.settings.size() > e.settings.count("refuses");
  };
  const bool random =
      s.jitter > 0.0 || in.scene.jitter > 0.0 || std::ranges::any_of(in.value.engines, may_be_random);
  if (s.seeds > 1 && !random)
    in.warn(
        s.place,
        fmt::format(
            "the study makes {} runs a level that differ by the seed alone, and nothing is random without "
            "jitter: give it a jitter, or remove seeds",
            s.seeds));
}

}  // namespace

void find_idle_judgement(IdleSearch& in) {
  unread_reference(in);
  for (const MetricChoice& m : in.value.metrics) {
    unread_time(in, m);
    measured_after_the_end(in, m);
  }
  for (const Gate& g : in.value.gates) can_fail(in, g);
  for (const Study& s : in.value.studies) unread_seeds(in, s);
}

}  // namespace tripoint
