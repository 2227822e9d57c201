// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <tuple>

#include "core/durable_file.hpp"
#include "scene/scene.hpp"
#include "tables/library.hpp"
#include "validation/baseline/baseline_lacking.hpp"
#include "validation/baseline/baseline_propose.hpp"
#include "validation/baseline/baseline_rows.hpp"
#include "validation/judge/headroom.hpp"
#include "validation/results/escaped_text.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

/// A floor and a band have no measure in common: only their edges are compared.
bool has_edges_alike(const AcceptedGate& a, const AcceptedGate& b) {
  return a.band.has_value() == b.band.has_value() && a.at_least.has_value() == b.at_least.has_value();
}

}  // namespace

Baseline accepted_from(const CaseResult& c, const Tool& tool, std::uint64_t seed, const Baseline* before,
                       const Acceptance& acceptance) {
  Baseline b;
  b.id = c.id;
  b.case_hash = hash_of_file(c);
  b.seed = seed;
  const auto hashes = case_hashes(c.file);
  if (hashes) {
    b.scene = hashes->scene;
    b.reference = hashes->reference;
    b.profiles = hashes->profiles;
    for (const auto& [name, required] : hashes->required)
      if (required) b.required.push_back(name);
  }
  if (before) b.accepted = before->accepted;
  b.accepted.push_back(acceptance);
  b.gates = gates_of(c, hashes);
  b.cost = costs_of(c, tool);
  b.engines = engines_of(c);
  const auto own = b.gates;
  for (std::size_t k = 0; k < own.size(); ++k) {
    auto& g = b.gates[k];
    const auto* old = before ? counterpart(own, k, before->gates) : nullptr;
    g.first_room = old ? old->first_room : g.room;
    g.first_value = old ? old->first_value : g.value;
    const bool looser = old && has_edges_alike(g, *old) && g.room > old->room && old->room > 0.0;
    if (old) g.loosened = old->loosened + (looser ? std::log(g.room / old->room) : 0.0);
  }
  if (before) b.removed = before->removed;
  return b;
}

namespace {

/// Runs that count more than 1 % more or fewer pairs or steps: a gate would compare them with the new
/// figures.
std::string changes_of_cost(const Baseline& before, const Baseline& after) {
  constexpr double seen = 0.01;
  std::string text;
  for (const auto& now : after.cost) {
    const auto old =
        std::find_if(before.cost.begin(), before.cost.end(), [&](const auto& o) { return o.run == now.run; });
    if (old == before.cost.end()) continue;
    for (const auto& [what, is, was] :
         {std::tuple{"pairs", now.pairs, old->pairs}, std::tuple{"steps", now.steps, old->steps}})
      if (std::abs(is - was) > seen * was)
        text += one_line(fmt::format("{} {}: {} {:.6g} -> {:.6g}", after.id, now.run, what, was, is)) + "\n";
  }
  return text;
}

/// Another question than the accepted one: id, seed, scene, reference, profiles and required engines.
std::string changes_of_question(const Baseline& before, const Baseline& after) {
  std::string text;
  const auto say = [&](const std::string& what) { text += one_line(after.id + ": " + what) + "\n"; };
  if (!before.id.empty() && before.id != after.id) say("RENAMED, it was " + before.id);
  if (before.seed != after.seed) say(fmt::format("seed {} -> {}", before.seed, after.seed));
  if (!before.scene.empty() && before.scene != after.scene) say("another scene, study or setting");
  if (!before.reference.empty() && before.reference != after.reference) say("another reference");
  for (const auto& profile : before.profiles)
    if (std::ranges::find(after.profiles, profile) == after.profiles.end())
      say("LEAVES the profile " + profile);
  for (const auto& engine : before.required)
    if (std::ranges::find(after.required, engine) == after.required.end())
      say(engine + " is REQUIRED NO MORE");
  return text;
}

/// Changes of one case by acceptance: each gate whose edges, metric or value have changed.
std::string changes(const Baseline* before, const Baseline& after) {
  if (!before) return fmt::format("{}: first baseline, {} gates\n", one_line(after.id), after.gates.size());
  std::string text = changes_of_question(*before, after);
  for (std::size_t k = 0; k < after.gates.size(); ++k) {
    const auto& now = after.gates[k];
    const auto* old = counterpart(after.gates, k, before->gates);
    const std::string name =
        one_line(fmt::format("{} {}{} {}{}", after.id, now.engine, after_blank(now.mode), now.metric,
                             now.level ? fmt::format(" at {:g}", *now.level) : ""));
    if (!old) {
      text += fmt::format("{}: new, {}\n", name, now.allows);
      continue;
    }
    if (!old->measures.empty() && old->measures != now.measures) text += name + ": another metric\n";
    const auto edge = looser_edge(now, *old);
    if (has_edges_alike(now, *old) && std::abs(now.room / old->room - 1.0) > 1e-9)
      text += fmt::format("{}: {} -> {}, {} by a factor {:.3g}\n", name, old->allows, now.allows,
                          now.room > old->room ? "LOOSER" : "tighter",
                          std::max(now.room / old->room, old->room / now.room));
    else if (!edge.empty())
      text += fmt::format("{}: {} -> {}, LOOSER: {}\n", name, old->allows, now.allows, edge);
    else if (now.allows != old->allows)
      text += fmt::format("{}: {} -> {}\n", name, old->allows, now.allows);
    else if (std::abs(now.value - old->value) > 1e-3 * std::abs(old->value) + roundoff_limit)
      text += fmt::format("{}: value {:.4g} -> {:.4g}\n", name, old->value, now.value);
  }
  return text + changes_of_cost(*before, after);
}

double loosenings(const Baseline& b, int& count) {
  double sum = 0.0;
  for (const auto& g : b.gates) {
    sum += g.loosened;
    count += g.loosened > 0.0;
  }
  return sum;
}

void check_reason(const Acceptance& acceptance) {
  if (acceptance.reason.find_first_not_of(" \t\n") == std::string::npos)
    throw InputError("gate accept: --reason says who decided what, and why");
}

/// A line of warning where the sources of the program that measured are in no commit; else nothing.
std::string unreproducible(const std::string& commit) {
  if (!commit.ends_with("-dirty")) return "";
  return one_line(fmt::format("note: measured by a tripoint of changed sources ({}), which nobody can build "
                              "again: commit, build and "
                              "validate before you accept what others rely on",
                              commit)) +
         "\n";
}

void check_acceptable(const CaseResult& c) {
  if (c.exit_code != exit_pass)
    throw InputError(fmt::format("{}: is {} and cannot be accepted; what is measured must be green first",
                                 c.id, c.verdict));
}

/// A note for each accepted engine that the case does not name: a run that is not told of it lacks what was
/// accepted.
std::string unnamed_engines(const CaseResult& c, const Baseline& after) {
  const auto hashes = case_hashes(c.file);
  if (!hashes) return "";
  std::string text;
  for (const auto& e : after.engines)
    if (!hashes->required.contains(e.name))
      text +=
          one_line(fmt::format(
              "{} {}: note: the case names no such engine, so that each run without --engines {} lacks its "
              "gates and is red: add [engines.{}], or accept results without it",
              c.id, e.name, e.name, e.name)) +
          "\n";
  return text;
}

}  // namespace

std::vector<Proposal> proposals(const Results& results, const std::vector<std::string>& ids,
                                const Acceptance& acceptance, const Lacking& lacking) {
  check_reason(acceptance);
  const bool engines_were_chosen = !results.only_engines.empty();
  std::vector<const CaseResult*> chosen;
  for (const auto& c : results.cases)
    if (ids.empty() || std::find(ids.begin(), ids.end(), c.id) != ids.end()) chosen.push_back(&c);
  for (const auto& id : ids)
    if (std::none_of(chosen.begin(), chosen.end(), [&](const auto* c) { return c->id == id; }))
      throw InputError(id + ": the results hold no case of this id");
  for (const auto* c : chosen) check_acceptable(*c);
  std::vector<Proposal> list;
  for (const auto* c : chosen) {
    Proposal p;
    p.id = c->id;
    p.file = baseline_file(c->file);
    std::optional<Baseline> before;
    if (fs::exists(p.file)) {
      before = read_baseline(p.file);
      p.before = text_of_file(p.file);
    }
    auto after = accepted_from(*c, results.tool, results.seed, before ? &*before : nullptr, acceptance);
    if (before) p.removed = carry_over(*c, *before, after, lacking, engines_were_chosen);
    p.after = baseline_text(after);
    p.changes = changes(before ? &*before : nullptr, after) + unnamed_engines(*c, after);
    p.loosened = loosenings(after, p.limits_loosened);
    p.limits_removed = after.removed;
    list.push_back(std::move(p));
  }
  return list;
}

std::string accept(const Results& results, const std::vector<std::string>& ids, const Acceptance& acceptance,
                   const Lacking& lacking) {
  const auto list = proposals(results, ids, acceptance, lacking);
  std::string text;
  double sum = 0.0;
  int count = 0, removed = 0;
  for (const auto& p : list) {
    fs::create_directories(fs::path(p.file).parent_path());
    write_durably(p.file, p.after);
    text += p.changes + p.removed;
    sum += p.loosened;
    count += p.limits_loosened;
    removed += p.limits_removed;
  }
  text += unreproducible(acceptance.commit);
  return text + fmt::format(
                    "{} cases accepted; since the first baseline {} limits were loosened, in all by a factor "
                    "{:.4g} (sum of ln "
                    "new/old {:.3g}), and {} were removed\n",
                    list.size(), count, std::exp(sum), sum, removed);
}

std::string accept_removal(const std::vector<std::string>& ids, const Acceptance& acceptance) {
  check_reason(acceptance);
  const auto suite = fs::weakly_canonical(fs::path(share_folder()) / "cases");
  std::string text;
  for (const auto& id : ids) {
    const auto of = id.ends_with(".toml") ? id : (suite / (id + ".toml")).string();
    const auto file = baseline_file(of);
    if (!fs::exists(file)) throw InputError(file + ": there is no such baseline to remove");
    if (fs::exists(of)) throw InputError(of + ": the case is still there, and its baseline stays");
    const auto b = read_baseline(file);
    fs::remove(file);
    text += one_line(fmt::format("{}: REMOVED with {} gates: {}", b.id, b.gates.size(), acceptance.reason)) +
            "\n";
  }
  return text;
}

}  // namespace tripoint
