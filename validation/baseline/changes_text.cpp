// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>

#include "scene/scene.hpp"
#include "validation/baseline/changes.hpp"
#include "validation/results/escaped_text.hpp"

namespace tripoint {
namespace {

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : std::string("no value");
}
std::string share(double value) {
  return std::isnan(value) ? std::string("-") : fmt::format("{:.3g}", value);
}

std::string value_of(const MetricStanding& s) {
  if (!s.fit_class) return number(s.value);
  return std::isfinite(s.value) ? fmt::format("{} {}", number(s.value), *s.fit_class)
                                : std::string(to_string(*s.fit_class));
}

/// Base beside head; one alone where the other has none; one where both read the same.
std::string pair_of(const std::optional<MetricStanding>& base, const std::optional<MetricStanding>& head,
                    std::string (*text)(const MetricStanding&)) {
  if (!base) return text(*head);
  if (!head) return text(*base);
  return text(*base) + " -> " + text(*head);
}

}  // namespace

std::string word_of(Trend trend) {
  switch (trend) {
    case Trend::better:
      return "better";
    case Trend::worse:
      return "worse";
    case Trend::appeared:
      return "new";
    case Trend::gone:
      return "gone";
    default:
      return "same";
  }
}

std::string name_of(const MetricChange& c) {
  return fmt::format("{}{} {}{}", c.engine, after_blank(c.mode), c.metric,
                     c.level ? fmt::format(" at {:g}", *c.level) : "");
}

std::string values_text(const MetricChange& c) {
  return pair_of(c.base, c.head, value_of) + (c.unit.empty() ? "" : " " + c.unit);
}

std::string used_text(const MetricChange& c) {
  return pair_of(c.base, c.head, [](const MetricStanding& s) { return share(s.used); });
}

std::string change_text(const MetricChange& c) {
  if (!c.base || !c.head || (std::isnan(c.base->used) && std::isnan(c.head->used) && c.change == 0.0))
    return "-";
  if (std::isinf(c.change)) return c.change > 0.0 ? "+inf" : "-inf";
  if (std::isnan(c.base->used) && std::isnan(c.head->used)) return fmt::format("{:.2g} %", 100.0 * c.change);
  return std::abs(c.change) < 0.5 * least_change ? std::string("0") : fmt::format("{:+.3g}", c.change);
}

std::string noise_text(const MetricChange& c) {
  if (c.noise_from.empty()) return "-";
  if (!(c.noise > 0.0)) return c.noise_from;
  return fmt::format("{:.2g}, {}", c.noise, c.noise_from);
}

std::string counts_text(const Comparison& all) {
  return fmt::format("{} better, {} worse, {} unchanged, {} new, {} gone", all.count(Trend::better),
                     all.count(Trend::worse), all.count(Trend::same), all.count(Trend::appeared),
                     all.count(Trend::gone));
}

std::string changes_table(const Comparison& all) {
  std::string text = one_line(fmt::format("against {}: {}; changes in units of the limit, above 0 is worse",
                                          all.base_name, counts_text(all))) +
                     "\n";
  for (const auto& remark : all.remarks) text += "note: " + one_line(remark) + "\n";
  for (const auto& c : all.changes) {
    const auto allows = c.base && !c.base->allows.empty()   ? c.base->allows
                        : c.head && !c.head->allows.empty() ? c.head->allows
                                                            : "no limit";
    text +=
        one_line(fmt::format("{:7}{:>9}  {} {}: {}, {} of {}; noise {}", word_of(c.trend), change_text(c),
                             c.case_id, name_of(c), values_text(c), used_text(c), allows, noise_text(c))) +
        "\n";
  }
  return text;
}

}  // namespace tripoint
