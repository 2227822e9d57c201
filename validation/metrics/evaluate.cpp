// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "files/gauge_error.hpp"
#include "tables/nearest.hpp"
#include "tables/units.hpp"
#include "validation/metrics/dominant_frequency.hpp"
#include "validation/metrics/frame_error.hpp"
#include "validation/metrics/frames.hpp"
#include "validation/metrics/impact_quantities.hpp"
#include "validation/metrics/members.hpp"
#include "validation/metrics/norms.hpp"
#include "validation/metrics/statistics.hpp"

namespace tripoint {
namespace {

std::string number_text(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

template <class List>
auto find_word(const List& list, const std::string& name) {
  return std::find_if(list.begin(), list.end(), [&](const auto& q) { return q.word.name == name; });
}

bool is_ledger(const std::string& quantity) {
  return quantity.rfind("ledger.", 0) == 0 && quantity.size() > 7;
}

/// A body has a centre and a motion of its own unless it is liquid: then its particles are meant.
const Quantity* find_quantity(const MetricInput& input) {
  const auto& choice = input.choice;
  const auto in = [&](const std::vector<Quantity>& list, const std::string& name) -> const Quantity* {
    const auto at = find_word(list, name);
    return at == list.end() ? nullptr : &*at;
  };
  if (is_ledger(choice.quantity)) return in(conserved_quantities(), "ledger.TERM");
  const auto* of_body = in(body_quantities(), choice.quantity);
  if (of_body && body_row(input) >= 0) return of_body;
  if (const auto* q = in(particle_quantities(), choice.quantity)) return q;
  if (of_body) return of_body;
  for (const auto* list :
       {&conserved_quantities(), &liquid_quantities(), &solid_quantities(), &contact_quantities(),
        &impact_quantities(), &phase_quantities(), &probe_quantities()})
    if (const auto* q = in(*list, choice.quantity)) return q;
  return in(profile_quantities(), choice.quantity);
}

const RunQuantity* find_run_quantity(const MetricChoice& choice) {
  for (const auto* list :
       {&run_quantities(), &motion_quantities(), &impact_run_quantities(), &front_quantities(),
        &solid_run_quantities(), &phase_run_quantities(), &heat_run_quantities()})
    for (const auto& q : *list)
      if (q.word.name == choice.quantity) return &q;
  return nullptr;
}

void refuse_unknown_quantity(const MetricChoice& choice) {
  if (is_ledger(choice.quantity)) return;
  std::vector<std::string> known;
  for (const auto& w : metric_quantities()) {
    if (w.name == choice.quantity) return;
    known.push_back(w.name);
  }
  throw InputError(choice.place, "metric `" + choice.name + "`: unknown quantity `" +
                                     printable(choice.quantity) + "`" + suggestion(choice.quantity, known));
}

/// Whether a value by this norm has the unit of its quantity: a slope, a frequency and a share of the
/// uncertainty have not.
bool keeps_unit(Norm norm) { return norm != Norm::slope && norm != Norm::frequency && norm != Norm::chi; }

std::string unit_of_quantity(const std::string& quantity) {
  if (is_ledger(quantity)) return "J";
  const auto at = std::ranges::find(metric_quantities(), quantity, &MetricWord::name);
  return at == metric_quantities().end() ? "1" : at->unit;
}

/// Refuses a unit for people that is not the unit of the number beside it. A value in m, divided by a scale
/// of 1, is none in mm.
void refuse_another_unit(const MetricChoice& choice) {
  if (choice.unit.empty() || choice.unit == "degC" || !keeps_unit(choice.norm)) return;
  const std::string own = unit_of_quantity(choice.quantity);
  if (choice.unit == own) return;  // the scale beside its own unit is in the baseline
  double factor = 0.0;
  try {
    factor = parse_quantity("1 " + choice.unit, own == "1" ? "" : own);
  } catch (const std::invalid_argument&) {
    return;  // of another dimension, or words: the scale of the value has it
  }
  if (std::abs(factor / choice.scale - 1.0) > 1e-9)
    throw InputError(choice.place, "metric `" + choice.name + "`: its value is in " + own +
                                       ", divided by scale = " + number_text(choice.scale) +
                                       ", and that is no " + choice.unit +
                                       ": write scale = " + number_text(factor) + ", or another unit");
}

/// Errors of all chosen frames under one norm in space, and their norm in time.
struct Series {
  std::vector<double> times, value, uncertainty;
  std::vector<long> worst;
};

double rms_over_time(const Series& s) {
  if (s.value.size() == 1) return std::abs(s.value[0]);
  double integral = 0.0;
  for (std::size_t n = 1; n < s.value.size(); ++n)
    integral +=
        0.5 * (s.times[n] - s.times[n - 1]) * (s.value[n] * s.value[n] + s.value[n - 1] * s.value[n - 1]);
  return std::sqrt(integral / (s.times.back() - s.times.front()));
}

double mean_over_time(const Series& s) {
  if (s.value.size() == 1) return s.value[0];
  double integral = 0.0;
  for (std::size_t n = 1; n < s.value.size(); ++n)
    integral += 0.5 * (s.times[n] - s.times[n - 1]) * (s.value[n] + s.value[n - 1]);
  return integral / (s.times.back() - s.times.front());
}

/// Trend of the error [unit/s] and its standard error.
std::pair<double, double> slope_over_time(const Series& s) {
  const double n = static_cast<double>(s.value.size());
  double t0 = 0.0, y0 = 0.0, tt = 0.0, ty = 0.0, rest = 0.0;
  for (std::size_t i = 0; i < s.value.size(); ++i) {
    t0 += s.times[i] / n;
    y0 += s.value[i] / n;
  }
  for (std::size_t i = 0; i < s.value.size(); ++i) {
    tt += (s.times[i] - t0) * (s.times[i] - t0);
    ty += (s.times[i] - t0) * (s.value[i] - y0);
  }
  for (std::size_t i = 0; i < s.value.size(); ++i)
    rest += std::pow(s.value[i] - y0 - ty / tt * (s.times[i] - t0), 2);
  return {ty / tt, n > 2.0 ? std::sqrt(rest / (n - 2.0) / tt) : not_a_number};
}

/// Mean after the burn-in with the error that blocks of it show; a series too short for a plateau has no
/// value.
MetricValue stationary(const Series& s, MetricValue v) {
  const auto m = stationary_mean(s.value);
  if (!std::isfinite(m.value))
    return unformed("a stationary mean needs eight finite output times or more in its window");
  v.value = m.value;
  v.uncertainty.statistical =
      std::max(m.uncertainty, *std::max_element(s.uncertainty.begin(), s.uncertainty.end()));
  v.note = std::to_string(m.burn_in) + " samples of burn-in cut, " +
           std::to_string(static_cast<long>(m.effective)) + " independent ones left" +
           (m.plateau ? "" : ", no plateau yet");
  return v;
}

/// The dominant frequency less the one that the case states: of a damped or uneven swing as of a sine.
MetricValue frequency(const MetricInput& in, const Series& s) {
  MetricValue v;
  v.times = s.times;
  v.series = s.value;
  const auto truth = in.reference.number("stated_frequency");
  if (!truth)
    return unformed(
        "the norm frequency needs the true one in Hz: reference = {function = \"stated\", args = {frequency "
        "= ...}}");
  const auto found = dominant_frequency(s.times, s.value);
  if (!found.problem.empty()) return unformed(found.problem);
  v.value = found.frequency - *truth;
  v.uncertainty.numerical = found.uncertainty;
  v.note = std::to_string(found.frequency) + " Hz against " + std::to_string(*truth) + ", amplitude " +
           std::to_string(found.amplitude) + ", " + std::to_string(100.0 * found.share) +
           " % of the variance";
  return v;
}

MetricValue over_time(Norm norm, const Series& s) {
  MetricValue v;
  v.times = s.times;
  v.series = s.value;
  std::size_t k = s.value.size() - 1;
  if (norm == Norm::rms) {
    v.value = rms_over_time(s);
    v.uncertainty.statistical = *std::max_element(s.uncertainty.begin(), s.uncertainty.end());
    return v;
  }
  if (norm == Norm::mean) {
    v.value = mean_over_time(s);
    v.uncertainty.statistical = *std::max_element(s.uncertainty.begin(), s.uncertainty.end());
    return v;
  }
  if (norm == Norm::stationary) return stationary(s, v);
  if (norm == Norm::slope) {
    if (s.value.size() < 2) return unformed("a slope needs two output times or more");
    std::tie(v.value, v.uncertainty.numerical) = slope_over_time(s);
    return v;
  }
  if (norm != Norm::final)  // the largest in time: max, drift, and a norm in space at all times
    for (std::size_t n = 0; n < s.value.size(); ++n) k = std::abs(s.value[n]) > std::abs(s.value[k]) ? n : k;
  v.value = norm == Norm::final ? s.value[k] : std::abs(s.value[k]);
  v.uncertainty.statistical = s.uncertainty[k];
  v.note = "at t = " + std::to_string(s.times[k]) + " s" +
           (s.worst[k] >= 0 ? ", row " + std::to_string(s.worst[k]) : "");
  return v;
}

/// Each sample's mean error over the window first, then L2: the error that is left when a settling medium
/// still swings.
MetricValue l2_of_means(const MetricInput& in, const Quantity& quantity, const Frames& all,
                        const Frames& chosen) {
  FrameError sum;
  for (const auto* now : chosen) {
    const auto error = quantity.error({in, *now, in.reference.truth_for(*now), *all.front()});
    if (!error.problem.empty()) return unformed(error.problem);
    if (sum.error.empty()) {
      sum = error;
      std::fill(sum.error.begin(), sum.error.end(), 0.0);
    }
    if (error.row != sum.row) return unformed("L2mean needs the same samples at all times of its window");
    for (std::size_t i = 0; i < error.error.size(); ++i)
      sum.error[i] += error.error[i] / static_cast<double>(chosen.size());
  }
  sum.sigma.clear();
  MetricValue v;
  v.value = spatial_norm(Norm::L2, sum).value;
  if (!std::isfinite(v.value)) return unformed("no finite mean over the window");
  return v;
}

/// A change since the start: a single number that is read off one frame alone, less the same number of the
/// first frame.
void subtract_start(FrameError& now, const Quantity& quantity, const MetricInput& in, const Snapshot& first) {
  if (!now.problem.empty() || now.error.size() != 1 || now.row[0] >= 0) return;
  const auto start = quantity.error({in, first, first, first});
  now.problem = start.problem;
  if (start.problem.empty()) now.error[0] -= start.error[0];
}

MetricValue of_frames(const MetricInput& in, const Quantity& quantity, const Frames& all,
                      const Frames& chosen) {
  const Norm norm = in.choice.norm;
  if (norm == Norm::L2mean) return l2_of_means(in, quantity, all, chosen);
  const Norm in_space = is_spatial(norm) ? norm : norm == Norm::rms ? Norm::L2 : Norm::Linf;
  Series series;
  for (const auto* now : chosen) {
    const bool no_state = norm == Norm::drift || norm == Norm::frequency || now->gauges_only();
    const Snapshot truth = no_state ? *all.front() : in.reference.truth_for(*now);
    auto error = quantity.error({in, *now, truth, *all.front()});
    if (norm == Norm::drift) subtract_start(error, quantity, in, *all.front());
    // It needs the last frame alone
    if (!error.problem.empty() && norm == Norm::final && now != chosen.back()) continue;
    if (!error.problem.empty()) return unformed(error.problem);
    if (norm == Norm::frequency && error.error.size() != 1)
      return unformed("the norm frequency is of a single number in time, and " + in.choice.quantity +
                      " is of many: choose a probe, a mean or a body");
    const auto value = spatial_norm(in_space, error);
    if (!std::isfinite(value.value) && norm == Norm::final && now != chosen.back()) continue;
    if (!std::isfinite(value.value))
      return unformed("no finite value at t = " + std::to_string(now->time) + " s");
    series.times.push_back(now->time);
    series.value.push_back(value.value);
    series.uncertainty.push_back(value.uncertainty);
    series.worst.push_back(value.worst);
  }
  MetricValue v = norm == Norm::frequency ? frequency(in, series) : over_time(norm, series);
  for (const auto* now : chosen)  // that of the last frame for the last value, else the largest
    if (norm != Norm::final || now == chosen.back())
      v.uncertainty.data =
          std::max(v.uncertainty.data, in.reference.uncertainty(in.choice.quantity, now->time).value_or(0.0));
  return v;
}

/// Standard error that the engine states of its gauge; 0 where it states none.
double stated_error(const Snapshot& frame, const std::string& metric) {
  const auto at = frame.gauges.find(gauge_error_key(metric));
  return at == frame.gauges.end() ? 0.0 : at->second;
}

/// The engine's own number in the place of one that is read from its particles.
Quantity gauge_quantity(const std::string& metric, const std::string& quantity) {
  return {{quantity, "", ""}, [=](const FramePair& f) {
            const auto own = f.now.gauges.find(metric), first = f.first.gauges.find(metric);
            if (own == f.now.gauges.end() || first == f.first.gauges.end())
              return problem("the engine shows no gauge of this metric at t = " + std::to_string(f.now.time) +
                             " s");
            auto error = f.in.choice.norm == Norm::drift ? single(own->second - first->second)
                                                         : against_truth(f, quantity.c_str(), own->second);
            if (const auto sigma = stated_error(f.now, metric); sigma > 0.0 && error.problem.empty())
              error.sigma.assign(error.error.size(), sigma);
            return error;
          }};
}

/// A diffusivity is one number of a whole run: the engine states it at the end.
MetricValue diffusivity_by_gauge(const MetricInput& in, const Snapshot& end) {
  const auto truth = in.reference.number("diffusivity");
  const auto own = end.gauges.find(in.choice.name);
  if (!truth)
    return unformed(
        "a diffusivity needs its true value: reference = {function = \"stated\", args = {diffusivity = "
        "...}}");
  if (own == end.gauges.end()) return unformed("the engine shows no gauge of this metric at the end");
  MetricValue v;
  v.value = in.choice.norm == Norm::final ? own->second - *truth : std::abs(own->second - *truth);
  v.uncertainty.statistical = stated_error(end, in.choice.name);
  v.note = std::to_string(own->second / *truth) + " of the true diffusivity, by the engine's own account";
  return v;
}

MetricValue of_gauges(const MetricInput& in, const Frames& all, const Frames& chosen) {
  if (!can_be_gauged(in.choice.quantity))
    return unformed("the engine answers by gauges and shows no particles, of which " + in.choice.quantity +
                    " is made");
  if (find_run_quantity(in.choice)) return diffusivity_by_gauge(in, *chosen.back());
  return of_frames(in, gauge_quantity(in.choice.name, in.choice.quantity), all, chosen);
}

void scale(MetricValue& v, double by) {
  v.value /= by;
  for (double* u : {&v.uncertainty.numerical, &v.uncertainty.statistical, &v.uncertainty.data}) *u /= by;
  for (double& x : v.series) x /= by;
}

}  // namespace

double Uncertainty::combined() const {
  return std::sqrt(numerical * numerical + statistical * statistical + input * input + data * data);
}

MetricValue evaluate(const MetricChoice& choice, const Job& job, const InitialState& initial,
                     const Trajectory& run, const Reference& reference) {
  refuse_unknown_quantity(choice);
  if (!(choice.scale > 0.0))
    throw InputError(choice.place, "metric `" + choice.name + "`: scale must be above 0");
  refuse_another_unit(choice);
  const MetricInput in{choice, job, initial, reference};
  (void)body_row(in);
  const auto frames = frames_of_job(job, initial, run);
  if (!frames.problem.empty()) return unformed(frames.problem);
  const auto chosen = chosen_frames(choice, job, frames.list);
  if (chosen.empty()) return unformed("no output time lies in the metric's window");
  if (chosen.back() == frames.list.front())
    return unformed("only the start lies in the metric's window, and there every run is what it was given");
  const bool gauged = can_be_gauged(choice.quantity) && chosen.back()->gauges.contains(choice.name);
  MetricValue value;
  if (gauged || chosen.back()->gauges_only()) {
    value = of_gauges(in, frames.list, chosen);
  } else if (const auto* whole = find_run_quantity(choice)) {
    value = whole->value(in, frames_in_window(choice, job, frames.list));
    if (choice.norm != Norm::final) value.value = std::abs(value.value);
  } else {
    value = of_frames(in, *find_quantity(in), frames.list, chosen);
  }
  scale(value, choice.scale);
  if (value.uncertainty.data == 0.0)
    value.uncertainty.data = (choice.reference ? *choice.reference : job.reference).uncertainty;
  return value;
}

std::optional<double> value_of_series(const MetricChoice& choice, const MetricValue& stored) {
  if (stored.series.empty() || stored.series.size() != stored.times.size() || choice.norm == Norm::L2mean ||
      choice.norm == Norm::frequency || find_run_quantity(choice))
    return {};
  const std::vector<double> nothing(stored.series.size(), 0.0);
  return over_time(choice.norm,
                   {stored.times, stored.series, nothing, std::vector<long>(stored.series.size(), -1)})
      .value;
}

const std::vector<MetricWord>& metric_quantities() {
  static const std::vector<MetricWord> words = [] {
    std::vector<MetricWord> list;
    for (const auto* group :
         {&particle_quantities(), &body_quantities(), &conserved_quantities(), &liquid_quantities(),
          &solid_quantities(), &contact_quantities(), &impact_quantities(), &phase_quantities(),
          &profile_quantities(), &probe_quantities()})
      for (const auto& q : *group)
        if (!q.word.meaning.empty()) list.push_back(q.word);
    for (const auto* group :
         {&run_quantities(), &motion_quantities(), &impact_run_quantities(), &front_quantities(),
          &solid_run_quantities(), &phase_run_quantities(), &heat_run_quantities()})
      for (const auto& q : *group) list.push_back(q.word);
    return list;
  }();
  return words;
}

std::string unit_of_value(const MetricChoice& choice) {
  if (!choice.unit.empty()) return choice.unit;
  return choice.scale == 1.0 && keeps_unit(choice.norm) ? unit_of_quantity(choice.quantity) : "1";
}

bool can_be_gauged(const std::string& quantity) {
  return quantity == "diffusivity" || find_word(probe_quantities(), quantity) != probe_quantities().end();
}

const std::vector<MetricWord>& metric_norms() {
  const auto word = [](Norm norm) { return std::string(to_string(norm)); };
  static const std::vector<MetricWord> words{
      {word(Norm::L1), "", "mean of the sizes, by volume, at `at`"},
      {word(Norm::L2), "",
       "root mean square, by volume, at `at`; the variance that walkers state is taken off below the root"},
      {word(Norm::L2raw), "", "as L2 with the statistical part left in"},
      {word(Norm::Linf), "", "largest size at `at`"},
      {word(Norm::chi), "",
       "root mean square of error over its stated standard error: 1 when walkers agree with the truth"},
      {word(Norm::max), "", "largest size over all output times of the window"},
      {word(Norm::rms), "", "root mean square over time of L2"},
      {word(Norm::L2mean), "", "root mean square, by volume, of each sample's mean error over the window"},
      {word(Norm::mean), "",
       "mean over the times of the window of a single number, with its sign; of many samples, of the largest "
       "size"},
      {word(Norm::stationary), "",
       "mean, with its sign, of a series that fluctuates about a steady value: burn-in cut, statistical "
       "uncertainty from block "
       "averages"},
      {word(Norm::final), "", "at the end; keeps the sign of a single number"},
      {word(Norm::drift), "", "largest change since the run's own start; needs no reference"},
      {word(Norm::frequency), "Hz",
       "frequency of the best-fitting sine of a single number, minus the stated `frequency`; its numerical "
       "uncertainty is the "
       "fit's"},
      {word(Norm::slope), "1/s", "trend of the largest error over time, least squares"}};
  return words;
}

}  // namespace tripoint
