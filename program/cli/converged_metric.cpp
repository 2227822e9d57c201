// SPDX-License-Identifier: BSD-3-Clause
#include "program/cli/converged_metric.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/errors.hpp"
#include "core/written_file.hpp"
#include "program/cli/common.hpp"
#include "tables/nearest.hpp"
#include "validation/metrics/metric.hpp"
#include "validation/metrics/roache.hpp"
#include "validation/references/measuring.hpp"

namespace tripoint {
namespace {

std::string steps_table(const OrderRow& row, const std::string& unit) {
  std::string text = fmt::format("| {} | value [{}] | change |\n|---|---|---|\n", to_string(row.axes), unit);
  for (std::size_t k = 0; k < row.step.size(); ++k)
    text += fmt::format("| {:.6g} | {:.6g} | {} |\n", row.step[k], row.error[k],
                        k > 0 ? fmt::format("{:.3g}", row.error[k] - row.error[k - 1]) : "-");
  return text;
}

std::string conclusion(const OrderRow& row, const std::string& unit) {
  const RoacheIndex r = roache_index(row.step, row.error);
  const double finest = row.error.back(), share = 100.0 * r.index / std::abs(finest);
  if (!r.monotone)
    return fmt::format(
        "The values go up and down, so that no order is observed and no limit extrapolated. The index is "
        "three "
        "times their largest change: {:.4g} {} ({:.3g} % of the finest value). Refine further.\n",
        r.index, unit, share);
  return fmt::format(
      "| | |\n|---|---|\n| observed order | {:.3f} |\n| extrapolated value | {:.6g} {} |\n"
      "| grid convergence index of the finest value | {:.3g} {} ({:.3g} %) |\n| factor of safety | {:.2f} "
      "|\n\n"
      "The value is {:.6g} {} +- {:.2g} {} [Roache 1994].\n",
      r.order, r.limit, unit, r.index, unit, share, r.factor, finest, unit, r.index, unit);
}

}  // namespace

void ask_for(Case& value, const std::string& metric) {
  const auto own = std::ranges::find(value.metrics, metric, &MetricChoice::name);
  MetricChoice one;
  if (own != value.metrics.end()) {
    one = *own;
  } else {
    std::vector<std::string> known;
    for (const auto& m : value.metrics) known.push_back(m.name);
    for (const auto& q : metric_quantities()) known.push_back(q.name);
    if (std::ranges::find(known, metric) == known.end())
      throw InputError("--metric " + metric + " is no metric of the case and no quantity" +
                       suggestion(metric, known));
    one.name = one.quantity = metric;
    one.norm = Norm::final;
    one.reference = value.reference;
    one.reference->kind = ReferenceKind::self;
    one.reference->function = "self";
    const auto measuring = measuring_arguments();
    std::erase_if(one.reference->args, [&](const auto& arg) {
      return std::ranges::find(measuring, arg.first, &ReferenceArgument::name) == measuring.end();
    });
  }
  value.metrics = {one};
  value.gates.clear();
  value.studies.front().metric = one.name;
}

void tell_convergence(const CaseResult& result, const Case& value, const std::string& out) {
  const MetricChoice& metric = value.metrics.front();
  std::string page = fmt::format("# {}: {}\n", value.id, metric.name);
  bool any = false;
  for (const auto& engine : result.engines)
    for (const auto& row : engine.order) {
      const std::string unit = unit_of_value(metric);
      page += fmt::format("\n## {}{}{}\n\n{}\n{}", engine.name, row.mode == JudgedMode::none ? "" : ", ",
                          row.mode, steps_table(row, unit), conclusion(row, unit));
      any = true;
    }
  if (!any) page += "\nA level has no value: see the reasons of its runs in index.html.\n";
  const std::string file = (std::filesystem::path(out) / "convergence.md").string();
  WrittenFile to(file);
  to.add(page);
  to.close();
  print(page + file + "\n");
}

}  // namespace tripoint
