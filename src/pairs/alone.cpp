// SPDX-License-Identifier: BSD-3-Clause
#include "pairs/alone.hpp"

#include <stdexcept>
#include <string>

#include "pairs/pair_passes.hpp"
#include "state/fill.hpp"

namespace tripoint {

PassFunction alone_pass(const State& state, const PairTerm& term) {
  const PassFunction pass = pair_passes(state.neighbours->clusters().lanes).alone(term);
  if (!pass.run)
    throw std::logic_error("the pair term " + std::string(term.name) +
                           " has no pass of its own: PairSlots::alone of its effect lacks it");
  return pass;
}

void sum_alone(State& state, const PairTerm& term, const PairKernels& kernels) {
  const PassFunction pass = alone_pass(state, term);
  for (const Field<double>* f : pass.adds()) fill(state.particles[*f], 0.0, state.threads);
  run_pass(pass, state.particles, *state.neighbours, kernels, state.threads);
  state.refresh(pass.adds());
}

void add_alone(State& state, const PassFunction& pass, const PairKernels& kernels,
               const ChosenClusters& chosen) {
  add_alone_here(state, pass, kernels, chosen);
  state.refresh(pass.adds());
}

void add_alone_here(State& state, const PassFunction& pass, const PairKernels& kernels,
                    const ChosenClusters& chosen) {
  run_pass_over(pass, state.particles, *state.neighbours, kernels, state.threads, chosen);
}

void add_alone_to(std::vector<std::vector<double>>& sums, State& state, const PassFunction& pass,
                  const PairKernels& kernels, const ChosenClusters& chosen) {
  std::vector<double*> columns;
  for (const Field<double>* f : pass.fields.first(pass.reads)) columns.push_back(state.particles[*f].data());
  for (std::vector<double>& one : sums) columns.push_back(one.data());
  run_pass_over(pass, columns, state.particles, *state.neighbours, kernels, state.threads, chosen);
}

}  // namespace tripoint
