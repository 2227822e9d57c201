// SPDX-License-Identifier: BSD-3-Clause
#include "step/recovery.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tripoint {
namespace {

constexpr const char* older_prefix = "good/older/";
constexpr const char* newer_prefix = "good/newer/";

void put(const std::optional<Checkpoint>& state, const std::string& prefix, Checkpoint& kept) {
  if (!state) return;
  for (const auto& [name, values] : state->real) kept.real[prefix + name] = values;
  for (const auto& [name, values] : state->whole) kept.whole[prefix + name] = values;
  for (const auto& [name, values] : state->text) kept.text[prefix + name] = values;
}

std::optional<Checkpoint> take(const Checkpoint& kept, const std::string& prefix) {
  Checkpoint state;
  const auto pick = [&](const auto& from, auto& to) {
    for (auto at = from.lower_bound(prefix); at != from.end() && at->first.starts_with(prefix); ++at)
      to[at->first.substr(prefix.size())] = at->second;
  };
  pick(kept.real, state.real);
  pick(kept.whole, state.whole);
  pick(kept.text, state.text);
  if (state.real.empty()) return {};
  return state;
}

}  // namespace

void Recovery::keep(Checkpoint state, double time) {
  older_ = std::move(newer_);
  newer_ = std::move(state);
  if (share_ == 1.0 || time <= failed_at_ || ++good_ < (1L << std::min(count_, 30L))) return;
  share_ *= 2.0;
  good_ = 0;
}

const Checkpoint& Recovery::go_back(const Diverged& failure) {
  if (share_ <= std::ldexp(1.0, -most_halvings)) {
    throw Diverged(failure.particle, failure.body, failure.field, failure.stage, failure.time,
                   std::string(failure.what()) + "; " + std::to_string(most_halvings) +
                       " halvings of the step from the last good state did not help",
                   failure.guard);
  }
  if (older_) newer_ = std::move(older_);
  older_.reset();
  share_ *= 0.5;
  failed_at_ = std::max(failed_at_, failure.time);
  ++count_;
  good_ = 0;
  last_ = failure.what();
  return *newer_;
}

void Recovery::save(Checkpoint& kept) const {
  kept.real["good/step"] = {share_, failed_at_, static_cast<double>(count_), static_cast<double>(good_)};
  kept.text["good/last"] = {last_};
  put(older_, older_prefix, kept);
  put(newer_, newer_prefix, kept);
}

void Recovery::restore(const Checkpoint& kept) {
  const auto step = kept.real.find("good/step");
  const auto last = kept.text.find("good/last");
  if (step == kept.real.end() || step->second.size() != 4 || last == kept.text.end() ||
      last->second.size() != 1)
    throw InputError("the checkpoint lacks the good states of a scene that recovers");
  share_ = step->second[0];
  failed_at_ = step->second[1];
  count_ = static_cast<long>(step->second[2]);
  good_ = static_cast<long>(step->second[3]);
  last_ = last->second[0];
  older_ = take(kept, older_prefix);
  newer_ = take(kept, newer_prefix);
}

}  // namespace tripoint
