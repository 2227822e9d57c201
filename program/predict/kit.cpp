// SPDX-License-Identifier: BSD-3-Clause
#include "program/predict/kit.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tripoint::predict {
namespace {

/// A word for the shell, whatever is in it.
std::string quoted(const std::string& word) {
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

std::string kit_script(const std::string& what, const std::vector<std::string>& set,
                       const std::vector<int>& ranks) {
  std::string words, list;
  for (const auto& s : set) words += " --set " + quoted(s);
  for (const int n : ranks) list += (list.empty() ? "" : " ") + std::to_string(n);
  return fmt::format(R"(#!/bin/bash
# What one scene costs on 1 to {most} ranks of this machine, beside what one rank predicts: strong
# (the scene as it is) and weak (as many particles a rank).
#   sbatch THIS                          on a node of a Slurm cluster, with your partition and account
#   bash THIS                            anywhere, with the mpiexec of the wheel
#   tripoint predict --compare result.json    prints it, here or at home
# It needs tripoint with the engine tripoint-mpi (TRIPOINT=path of the program, where it is not on
# PATH). RANKS="1 2 4", REPEATS=5, MOST_REPEATS=20 (where times still fall), PATIENCE=60 (seconds in
# all, for slow cores), SECONDS_A_RUN=5, OUT=result.json change it.
# result.json holds the processor, its cores, MPI, times and counts; no name of a host, a user or a
# folder of yours. Runs are in a folder that is deleted at the end.
# Several nodes: TRIPOINT_MPI_LAUNCHER=slurm hands the ranks to Slurm (tried on one node alone); the
# folder of runs must then be shared (TMPDIR).
#SBATCH --job-name=tripoint-predict
#SBATCH --nodes=1
#SBATCH --ntasks-per-node={most}
#SBATCH --exclusive
#SBATCH --time=01:00:00
set -u
TRIPOINT=${{TRIPOINT:-tripoint}}
RANKS=${{RANKS:-{list}}}
OUT=${{OUT:-result.json}}
command -v "$TRIPOINT" > /dev/null || {{ echo "tripoint is not on PATH: TRIPOINT=/path/to/tripoint bash $0" >&2; exit 4; }}
cores=$(getconf _NPROCESSORS_ONLN)
[ -n "${{TRIPOINT_MPI_LAUNCHER:-}}" ] && cores=${{SLURM_NTASKS:-$cores}}
chosen=
for n in $RANKS; do
  if [ "$n" -le "$cores" ]; then chosen="${{chosen:+$chosen,}}$n"; else echo "left out: $n ranks on $cores cores" >&2; fi
done
[ -n "$chosen" ] || {{ echo "no number of ranks fits $cores cores" >&2; exit 2; }}
runs=$(mktemp -d)
trap 'rm -rf "$runs"' EXIT
"$TRIPOINT" predict {what}{words} --ranks "$chosen" --measure "$chosen" --weak --repeats "${{REPEATS:-5}}" --most-repeats "${{MOST_REPEATS:-20}}" --patience "${{PATIENCE:-60}}" --seconds "${{SECONDS_A_RUN:-5}}" --out "$runs" --json > "$runs/result.json"
code=$?
if [ "$code" -eq 0 ]; then mv "$runs/result.json" "$OUT" && "$TRIPOINT" predict --compare "$OUT"; fi
exit "$code"
)",
                     fmt::arg("most", *std::max_element(ranks.begin(), ranks.end())), fmt::arg("list", list),
                     fmt::arg("what", quoted(what)), fmt::arg("words", words));
}

}  // namespace tripoint::predict
