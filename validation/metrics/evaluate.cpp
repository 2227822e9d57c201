// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "files/gauge_error.hpp"
#include "tables/nearest.hpp"
#include "tables/units.hpp"
#include "validation/metrics/frame_error.hpp"
#include "validation/metrics/frames.hpp"
#include "validation/metrics/impact_quantities.hpp"
#include "validation/metrics/members.hpp"
#include "validation/metrics/norms.hpp"
#include "validation/metrics/series.hpp"

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
        &joint_quantities(), &impact_quantities(), &phase_quantities(), &probe_quantities()})
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

/// Whether a value is one number in time; a frequency or an average of many samples has no meaning.
std::string one_number_trouble(const MetricInput& in, const FrameError& error) {
  const bool swing = swings(in.choice.norm);
  if ((!swing && !(in.choice.average > 0.0)) || error.error.size() == 1) return {};
  return (swing ? "the norm " + std::string(to_string(in.choice.norm)) : std::string("`average`")) +
         " is of a single number in time, and " + in.choice.quantity +
         " is of many: choose a probe, a mean or a body";
}

/// The frames that an average around the chosen ones takes in.
Frames frames_seen(const MetricInput& in, const Frames& all, const Frames& chosen) {
  if (!(in.choice.average > 0.0)) return chosen;
  const double reach = 0.5 * in.choice.average + time_tolerance(in.job);
  Frames seen;
  for (const auto* f : all)
    if (f->time >= chosen.front()->time - reach && f->time <= chosen.back()->time + reach) seen.push_back(f);
  return seen;
}

MetricValue norm_in_time(const MetricInput& in, const Series& series) {
  if (in.choice.norm == Norm::frequency) return frequency_of(in, series);
  if (in.choice.norm == Norm::swing) return swing_of(in, series);
  return over_time(in.choice.norm, series);
}

MetricValue of_frames(const MetricInput& in, const Quantity& quantity, const Frames& all,
                      const Frames& chosen) {
  const Norm norm = in.choice.norm;
  const bool averages = in.choice.average > 0.0;
  if (averages && (norm == Norm::L2mean || norm == Norm::chi))
    return unformed("`average` goes with every norm but L2mean and chi");
  if (norm == Norm::L2mean) return l2_of_means(in, quantity, all, chosen);
  const bool signed_values = averages || !(is_spatial(norm) || norm == Norm::rms);
  const Norm in_space = signed_values ? Norm::Linf : norm == Norm::rms ? Norm::L2 : norm;
  Series series;
  for (const auto* now : frames_seen(in, all, chosen)) {
    const bool no_state = norm == Norm::drift || norm == Norm::frequency || now->gauges_only();
    const Snapshot truth = no_state ? *all.front() : in.reference.truth_for(*now);
    auto error = quantity.error({in, *now, truth, *all.front()});
    if (norm == Norm::drift) subtract_start(error, quantity, in, *all.front());
    // It needs the last frame alone
    const bool unasked = norm == Norm::final && !averages && now != chosen.back();
    if (!error.problem.empty() && unasked) continue;
    if (!error.problem.empty()) return unformed(error.problem);
    if (const auto why = one_number_trouble(in, error); !why.empty()) return unformed(why);
    const auto value = spatial_norm(in_space, error);
    if (!std::isfinite(value.value) && unasked) continue;
    if (!std::isfinite(value.value))
      return unformed("no finite value at t = " + std::to_string(now->time) + " s");
    series.times.push_back(now->time);
    series.value.push_back(value.value);
    series.uncertainty.push_back(value.uncertainty);
    series.worst.push_back(value.worst);
  }
  if (averages) {
    std::vector<double> kept;
    for (const auto* now : chosen) kept.push_back(now->time);
    if (const auto why = average_over(series, in.choice.average, kept, time_tolerance(in.job)); !why.empty())
      return unformed(why);
  }
  MetricValue v = norm_in_time(in, series);
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
    if (choice.average > 0.0)
      return unformed("`average` is of a quantity at output times, and " + choice.quantity +
                      " is of the whole run");
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
      swings(choice.norm) || find_run_quantity(choice))
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
          &solid_quantities(), &contact_quantities(), &joint_quantities(), &impact_quantities(),
          &phase_quantities(), &profile_quantities(), &probe_quantities()})
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
      {word(Norm::swing), "",
       "half of greatest minus least of a single number over the window, minus the stated `amplitude`"},
      {word(Norm::slope), "1/s", "trend of the largest error over time, least squares"}};
  return words;
}

}  // namespace tripoint
