#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the fuzz targets with clang and runs each for so many seconds, one at a time: docs/fuzz.md.
#   tools/fuzz.sh [SECONDS=60] [TARGET...]     what a target learns stays in build-fuzz/corpus/TARGET, what breaks it in build-fuzz/found
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
mkdir -p build-fuzz/found
status=0
for target in "${targets[@]}"; do
  mkdir -p "build-fuzz/corpus/$target"
  log=build-fuzz/found/$target.log
  if build-fuzz/tests/fuzz-"$target" -max_total_time="$seconds" -timeout=25 -rss_limit_mb=3000 -print_final_stats=1 \
    -artifact_prefix="build-fuzz/found/$target-" "build-fuzz/corpus/$target" "tests/fuzz/corpus/$target" >"$log" 2>&1; then
    found='no crash'
  else
    found="BROKEN, see $log"
    status=1
  fi
  printf '%-11s %10s inputs, %s\n' "$target" "$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")" "$found"
done
exit $status
