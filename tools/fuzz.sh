#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the fuzz targets with clang and runs each for so many processor seconds, one at a time: docs/fuzz.md.
#   tools/fuzz.sh [SECONDS=60] [TARGET...]     what a target learns stays in build-fuzz/corpus/TARGET, what breaks it in build-fuzz/found
# A busy machine takes longer, and gives each target as much. Prints a row of a table a target: inputs, seconds, time to ten to the ninth, what was found.
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=60
if [[ ${1:-} =~ ^[0-9]+$ ]]; then
  seconds=$1
  shift
fi
targets=("$@")
((${#targets[@]})) || mapfile -t targets < <(cd tests/fuzz/corpus && ls)

if ! command -v clang++-16 >/dev/null; then
  echo 'fuzz: clang is not here: tools/setup.sh fuzz installs it (Debian: clang-16 libclang-rt-16-dev libomp-16-dev)' >&2
  exit 2
fi
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target "${targets[@]/#/fuzz-}" >/dev/null

# The leaks that would be found are those of libraries at their end. What asks for too much memory gets an exception in a build without sanitizers.
export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1
[[ -d /dev/shm ]] && export TMPDIR=${TMPDIR:-/dev/shm} # inputs that are read as files: a disk would hold the targets up
mkdir -p build-fuzz/found
status=0
TIMEFORMAT='%U %S'
for target in "${targets[@]}"; do
  mkdir -p "build-fuzz/corpus/$target"
  log=build-fuzz/found/$target.log
  : >"$log"
  inputs=0 used=0 found=nothing
  while ((used < seconds)); do
    left=$((seconds - used < 100 ? seconds - used : 100)) # a part at a time: libFuzzer counts the seconds of the clock
    # Inputs of several of a case file's longest lines: libFuzzer would keep to the length of the corpus.
    { time build-fuzz/tests/fuzz-"$target" -max_total_time="$left" -timeout=25 -rss_limit_mb=3000 -max_len=65536 -print_final_stats=1 \
      -artifact_prefix="build-fuzz/found/$target-" "build-fuzz/corpus/$target" "tests/fuzz/corpus/$target" >"$log.part" 2>&1; } 2>"$log.time" || found="BROKEN, see $log"
    cat "$log.part" >>"$log"
    executed=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log.part")
    inputs=$((inputs + ${executed:-0}))
    used=$((used + $(awk 'END { print int($1 + $2 + 0.5) }' "$log.time")))
    if [[ $found != nothing ]]; then
      status=1
      break
    fi
  done
  rm -f "$log.part" "$log.time"
  printf '| `%s` | %d | %d | %.1f | %s |\n' "$target" "$inputs" "$used" "$(awk "BEGIN { print $used / ($inputs + 1) * 1e9 / 86400 }")" "$found"
done
exit $status
