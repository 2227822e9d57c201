// SPDX-License-Identifier: BSD-3-Clause
#include "validation/queue/emit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/errors.hpp"

namespace tripoint {
namespace {

/// A word for the shell, whatever is in it.
std::string quoted(const std::string& word) {
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

/// "1-4,7": the form of array options of schedulers.
std::string ranges(const std::vector<int>& numbers) {
  std::string text;
  for (std::size_t n = 0; n < numbers.size();) {
    std::size_t last = n;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += fmt::format("{}{}", text.empty() ? "" : ",", numbers[n]);
    if (last > n) text += fmt::format("-{}", numbers[last]);
    n = last + 1;
  }
  return text;
}

/// Minutes that a shard may take: four times the predicted time, and a quarter of an hour at least.
int minutes(double predicted) { return std::max(15, static_cast<int>(std::ceil(4.0 * predicted / 60.0))); }

std::string head(const Queue& queue, const EmitOptions& o) {
  return fmt::format(
      "# {} jobs in {} shards; the longest shard is predicted to take {:.0f} CPU s. Written by: tripoint "
      "suite emit\n",
      queue.jobs.size(), o.shards, o.longest);
}

std::string names(const EmitOptions& o) {
  return fmt::format("TRIPOINT=${{TRIPOINT:-{}}}\nDIR={}\n", quoted(o.program), quoted(o.dir));
}

std::string slurm(const Queue& queue, const EmitOptions& o) {
  return "#!/bin/bash\n" + head(queue, o) +
         fmt::format(R"(# sbatch THIS, then, when the array has ended:
#   sbatch --dependency=afterany:JOBID --wrap="tripoint merge {dir}"
# A task that was killed or preempted is sent again by the same line; what is done is skipped.
#SBATCH --job-name=tripoint
#SBATCH --array={array}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task={threads}
#SBATCH --time={minutes}
#SBATCH --signal=B:TERM@60
#SBATCH --requeue
set -u
{names}"$TRIPOINT" suite work "$DIR" --shard "$SLURM_ARRAY_TASK_ID/{shards}" &
child=$!
trap 'kill -TERM "$child"' TERM
wait "$child" || wait "$child"
)",
                     fmt::arg("dir", o.dir), fmt::arg("array", ranges(o.numbers)),
                     fmt::arg("threads", queue.threads), fmt::arg("minutes", minutes(o.longest)),
                     fmt::arg("names", names(o)), fmt::arg("shards", o.shards));
}

std::string hyperqueue(const Queue& queue, const EmitOptions& o) {
  return "#!/bin/bash\n" + head(queue, o) +
         fmt::format(
             R"(# Needs a server and workers: hq server start, hq worker start (or hq alloc add slurm).
set -eu
{names}hq submit --wait --name tripoint --array {array} --cpus {threads} --crash-limit 3 -- \
  bash -c 'exec "$1" suite work "$2" --shard "$HQ_TASK_ID/{shards}"' shard "$TRIPOINT" "$DIR"
exec "$TRIPOINT" merge "$DIR"
)",
             fmt::arg("array", ranges(o.numbers)), fmt::arg("threads", queue.threads),
             fmt::arg("names", names(o)), fmt::arg("shards", o.shards));
}

std::string parallel(const Queue& queue, const EmitOptions& o) {
  return "#!/bin/bash\n" + head(queue, o) +
         fmt::format(
             R"(# JOBS=8 bash THIS: eight shards at a time (2 where nothing is said). Other machines:
# PARALLEL="--sshloginfile hosts" where the folder is shared.
set -u
{names}parallel --jobs "${{JOBS:-2}}" --quote --retries 3 --ungroup "$TRIPOINT" suite work "$DIR" --shard "{{}}/{shards}" ::: {numbers}
exec "$TRIPOINT" merge "$DIR"
)",
             fmt::arg("names", names(o)), fmt::arg("shards", o.shards),
             fmt::arg("numbers", fmt::join(o.numbers, " ")));
}

/// A string for Python.
std::string python_word(const std::string& word) {
  std::string out = "\"";
  for (const char c : word) out += (c == '"' || c == '\\') ? std::string{'\\', c} : std::string(1, c);
  return out + "\"";
}

std::string snakemake(const Queue& queue, const EmitOptions& o) {
  return head(queue, o) +
         fmt::format(
             R"(# snakemake --snakefile THIS --cores 2        (--executor slurm sends the rules to a cluster)
# A shard that was killed is made again by --retries 2, or by the same line once more; what is done
# in it is skipped.
import os

TRIPOINT = os.environ.get("TRIPOINT", {program})
DIR = {dir}


rule merge:
    input:
        expand(os.path.join(DIR, "shards", "{{k}}-of-{shards}"), k=[{numbers}]),
    shell:
        # A gate that fails is a result, not a rule that broke: `tripoint gate DIR` ends with the
        # verdict's code.
        "{{TRIPOINT:q}} merge {{DIR:q}} || test $? -ne 2 -a -f {{DIR:q}}/results.json"


rule shard:
    output:
        touch(os.path.join(DIR, "shards", "{{k}}-of-{shards}")),
    threads: {threads}
    resources:
        runtime={minutes},
    shell:
        "{{TRIPOINT:q}} suite work {{DIR:q}} --shard {{wildcards.k}}/{shards}"
)",
             fmt::arg("program", python_word(o.program)), fmt::arg("dir", python_word(o.dir)),
             fmt::arg("shards", o.shards), fmt::arg("numbers", fmt::join(o.numbers, ", ")),
             fmt::arg("threads", queue.threads), fmt::arg("minutes", minutes(o.longest)));
}

/// The line that plans this suite anew on another machine.
std::string make_command(const Queue& queue, const EmitOptions& o) {
  std::string line = "tripoint suite make " + quoted(o.typed);
  for (const auto& word : queue.filter.what) line += " " + quoted(word);
  if (!queue.filter.profile.empty()) line += " --profile " + queue.filter.profile;
  if (!queue.filter.tag.empty()) line += " --tag " + quoted(queue.filter.tag);
  if (!queue.filter.substring.empty()) line += " -k " + quoted(queue.filter.substring);
  if (!queue.engine_words.empty())
    line += " --engines " + quoted(fmt::format("{}", fmt::join(queue.engine_words, ",")));
  if (queue.selection.seed) line += fmt::format(" --seed {}", *queue.selection.seed);
  return line + fmt::format(" --threads {} --time-limit {:g}", queue.threads, queue.wall_limit);
}

std::string github(const Queue& queue, const EmitOptions& o) {
  return head(queue, o) +
         fmt::format(
             R"(# Runners share no folder: each plans the suite anew. Ids are hashes of runs, so that all
# come to the same jobs and shards.
# Put the step that installs tripoint in the place of the one that is marked, in both jobs. Program
# and engines must be the same builds on every runner.
name: suite
on: workflow_dispatch
permissions:
  contents: read
jobs:
  shard:
    runs-on: ubuntu-24.04
    timeout-minutes: {minutes}
    strategy:
      fail-fast: false
      matrix:
        k: [{numbers}]
    steps:
      - uses: actions/checkout@v4
      - run: tripoint --version  # in the place of this: what installs it
      - run: {make}
      - run: tripoint suite work {dir} --shard ${{{{ matrix.k }}}}/{shards}
      - uses: actions/upload-artifact@v4
        if: always()
        with:
          name: shard-${{{{ matrix.k }}}}
          path: |
            {typed}/runs
            {typed}/done
            {typed}/failed
          if-no-files-found: ignore
  merge:
    needs: shard
    if: always()
    runs-on: ubuntu-24.04
    steps:
      - uses: actions/checkout@v4
      - run: tripoint --version  # in the place of this: what installs it
      - uses: actions/download-artifact@v4
        with:
          path: {typed}
          merge-multiple: true
      - run: {make}
      - run: tripoint merge {dir}
      - uses: actions/upload-artifact@v4
        if: always()
        with:
          name: report
          path: {typed}
)",
             fmt::arg("minutes", minutes(o.longest)), fmt::arg("numbers", fmt::join(o.numbers, ", ")),
             fmt::arg("shards", o.shards), fmt::arg("make", make_command(queue, o)),
             fmt::arg("dir", quoted(o.typed)), fmt::arg("typed", o.typed));
}

using Writer = std::string (*)(const Queue&, const EmitOptions&);
const std::map<std::string, Writer>& writers() {
  static const std::map<std::string, Writer> all{{"github", github},
                                                 {"hyperqueue", hyperqueue},
                                                 {"parallel", parallel},
                                                 {"slurm", slurm},
                                                 {"snakemake", snakemake}};
  return all;
}

}  // namespace

std::vector<std::string> schedulers() {
  std::vector<std::string> list;
  for (const auto& [name, writer] : writers()) list.push_back(name);
  return list;
}

std::string script_for(const std::string& scheduler, const Queue& queue, const EmitOptions& options) {
  const auto at = writers().find(scheduler);
  if (at == writers().end())
    throw InputError(fmt::format("--for {}: write one of {}", scheduler, fmt::join(schedulers(), ", ")));
  return at->second(queue, options);
}

}  // namespace tripoint
