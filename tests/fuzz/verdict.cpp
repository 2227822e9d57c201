// SPDX-License-Identifier: BSD-3-Clause
// The judge, on a case of any runs, values and gates: PASS only where an independent reading of the gates,
// written again here, says so; and what gets worse is never judged better.
#include <cmath>
#include <optional>

#include "fuzz/input.hpp"
#include "validation/judge/apply_gate.hpp"
#include "validation/judge/judge.hpp"

using namespace tripoint;

namespace {

constexpr Status states[] = {Status::ok,      Status::ok,      Status::ok,       Status::ok,
                             Status::refused, Status::missing, Status::diverged, Status::killed,
                             Status::timeout, Status::error,   Status::error};
constexpr JudgedMode modes[] = {JudgedMode::corrected, JudgedMode::paper, JudgedMode::none};

Gate made_gate(fuzz::Bytes& bytes) {
  Gate g;
  g.metric = bytes.one_of(8) == 0 ? "other" : "error";
  g.reason = "fuzz";
  const unsigned kinds = bytes.byte();
  if (kinds & 1) g.limit = bytes.real();
  if (kinds & 2) g.at_least = bytes.real();
  if (kinds & 4) g.band = {bytes.real(), bytes.real()};
  if (kinds & 8) g.engine = "one";
  if (kinds & 16) g.mode = modes[bytes.one_of(2)];
  return g;
}

RunRow made_run(fuzz::Bytes& bytes, unsigned k) {
  RunRow run;
  run.base = true;
  run.group = "group " + std::to_string(bytes.flag() ? k : 0);
  run.status = states[bytes.one_of(11)];
  run.comparable = bytes.one_of(8) != 0;
  run.knobs.mode = modes[bytes.one_of(3)];
  if (bytes.one_of(8) != 0)
    run.metrics["error"] = {bytes.real(), {0.0, bytes.flag() ? bytes.real() : 0.0, 0.0, 0.0}, {}, {}, {}};
  return run;
}

CaseResult made_case(fuzz::Bytes& bytes) {
  CaseResult c;
  c.id = "fuzz/one";
  c.kind = CaseKind::verification;
  c.metrics.resize(1);
  c.metrics[0].name = "error";
  for (unsigned k = 0, n = bytes.one_of(4); k < n; ++k) c.gates.push_back(made_gate(bytes));
  for (unsigned e = 0, n = bytes.one_of(3); e < n; ++e) {
    EngineRow engine;
    engine.name = e == 0 ? "one" : "two";
    engine.required = bytes.flag();
    for (unsigned k = 0, runs = bytes.one_of(4); k < runs; ++k) engine.runs.push_back(made_run(bytes, k));
    c.engines.push_back(engine);
  }
  return c;
}

/// The gate by its words: the value, widened by twice its uncertainty, is within everything that is set, and
/// all of it is finite.
bool holds(const Gate& g, double value, double u) {
  if (!std::isfinite(value) || !std::isfinite(u) || u < 0.0) return false;
  bool within = g.limit || g.at_least || g.band;
  if (g.limit) within &= std::abs(value) + 2.0 * u <= *g.limit;
  if (g.at_least) within &= value - 2.0 * u >= *g.at_least;
  if (g.band) within &= value - 2.0 * u >= (*g.band)[0] && value + 2.0 * u <= (*g.band)[1];
  return within;
}

int badness(Verdict v) { return v == Verdict::pass ? 0 : v == Verdict::inconclusive ? 1 : 2; }

void check_one_value(fuzz::Bytes& bytes) {
  const Gate gate = made_gate(bytes);
  const double value = bytes.real(), u = bytes.real();
  const Verdict verdict = verdict_of(gate, value, u);
  fuzz::expect((verdict == Verdict::pass) == holds(gate, value, u),
               "a value passes where the gate's words say so, and there alone");
  if (!gate.limit || gate.at_least || gate.band || !std::isfinite(u) || u < 0.0) return;
  const double farther = value * (1.0 + bytes.byte() / 16.0);
  if (std::isfinite(farther))
    fuzz::expect(badness(verdict_of(gate, farther, u)) >= badness(verdict),
                 "a greater error is judged no better");
  fuzz::expect(verdict != Verdict::fail || verdict_of(gate, value, 0.0) == Verdict::fail,
               "what fails with its uncertainty fails without");
}

/// Every gate has a value of the engine that it names, and every value that it looks at holds.
bool all_hold(const CaseResult& c) {
  std::size_t judged = 0;
  for (const auto& engine : c.engines)
    for (const auto& row : engine.gates) {
      if (!holds(row.gate, row.value, row.uncertainty)) return false;
      ++judged;
    }
  return judged > 0;
}

bool is_broken(const RunRow& run) {
  return run.status == Status::killed || run.status == Status::timeout || run.status == Status::error ||
         !run.comparable;
}

void check_case(fuzz::Bytes& bytes) {
  CaseResult c = made_case(bytes);
  judge(c, false);
  if (c.verdict == CaseVerdict::pass) {
    fuzz::expect(c.exit_code == 0, "PASS ends with 0");
    fuzz::expect(all_hold(c),
                 "a case passes where each of its gates has a finite value that holds, and at least one has");
    for (const auto& engine : c.engines)
      for (const auto& run : engine.runs) {
        fuzz::expect(run.comparable, "a case with a run of another scene does not pass");
        fuzz::expect(run.status != Status::diverged, "a case with a run that diverged does not pass");
        fuzz::expect(!engine.required || run.status == Status::ok,
                     "a required engine that did not end well does not pass");
      }
  }
  if (c.verdict != CaseVerdict::pass || c.gates.empty()) return;
  for (auto& engine : c.engines)  // one number goes: nothing that a gate looked at may be missing
    for (auto& run : engine.runs)
      if (!engine.gates.empty() && run.metrics.count("error")) {
        CaseResult worse = c;
        auto& changed = worse.engines[static_cast<std::size_t>(&engine - c.engines.data())]
                            .runs[static_cast<std::size_t>(&run - engine.runs.data())];
        changed.metrics["error"].value = std::nan("");
        judge(worse, false);
        const bool looked_at = std::any_of(c.gates.begin(), c.gates.end(), [&](const Gate& g) {
          return g.metric == "error" && (g.engine.empty() || g.engine == engine.name) &&
                 fits_mode(g, run.knobs.mode);
        });
        fuzz::expect(
            !looked_at || is_broken(run) || run.status != Status::ok || worse.verdict != CaseVerdict::pass,
            "a value that is not finite does not pass");
      }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  if (bytes.flag())
    check_case(bytes);
  else
    check_one_value(bytes);
  return 0;
}
