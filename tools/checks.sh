#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# What CI asks beside the tests of the ordinary build, each in a folder of its own; exits with the first that fails.
#   tools/checks.sh format       every C++ file is as .clang-format says
#   tools/checks.sh scorecard    the checks of OpenSSF Scorecard that a checkout can answer
#   tools/checks.sh tidy         clang-tidy on most of the solver and on what reads third-party files (docs/ci.md); a finding of clang-analyzer or bugprone fails
#   tools/checks.sh clang        clang-16 compiles the libraries and runs the tests of the rooms
#   tools/checks.sh asan-ubsan   the same rooms, and the corpus of the fuzz targets, under the address and undefined-behaviour sanitizers
#   tools/checks.sh tsan         everything that shares memory between threads under the thread sanitizer
# TARGETS="test-core ..." in the environment takes fewer of them, JOBS=N more compilers at a time (2).
set -euo pipefail
cd "$(dirname "$0")/.."

jobs=${JOBS:-2}
rooms=(test-core test-particles test-sph test-scene test-files test-effects test-step test-metrics test-references test-harness test-queue)
replays=(replay-{baseline,case,checkpoint,csv,job,mesh,reply,results,text,trajectory,verdict})
threads=(test-particles test-effects test-step test-queue state-hashes)
cases=(cases/{fluid/dam-break-small,coupling/gum-ball,solid/plastic-sheet,phase/melt-rigid,phase/split-by-melting,heat/inflow}.toml)
tidied=(src/{core,scene,files,particles,state,effects,step} validation/case)
launcher=()
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)

# build FOLDER TARGET...
build() { cmake --build "$1" --parallel "$jobs" --target "${@:2}" >&2; }

# run_all FOLDER TARGET...: each test program once, each replay over its corpus, and no other test
run_all() {
  local folder=$1 target
  shift
  for target in "$@"; do
    [[ $target == test-* || $target == replay-* ]] || continue
    echo "checks: $target"
    case $target in
      test-*) "$folder/tests/$target" --gtest_brief=1 ;;
      replay-*) "$folder/tests/$target" "tests/fuzz/corpus/${target#replay-}" ;;
    esac
  done
}

case ${1:-} in
  format) tools/format.sh --check ;;
  scorecard) tools/scorecard.py ;;
  tidy)
    # Without tests: with them the self-test compiles the solver again, and each of its files would be read twice.
    cmake -S . -B build-tidy -G Ninja -DTRIPOINT_TESTS=OFF -DCMAKE_UNITY_BUILD=OFF -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null
    git ls-files "${tidied[@]/%//*.cpp}" |
      xargs --max-procs "$jobs" --max-args 4 clang-tidy-14 -p build-tidy --quiet --warnings-as-errors='clang-analyzer-*,bugprone-*'
    ;;
  clang)
    read -ra targets <<<"${TARGETS:-${rooms[*]}}"
    cmake -S . -B build-clang -G Ninja -DCMAKE_CXX_COMPILER=clang++-16 -DTRIPOINT_TESTS=ON -DTRIPOINT_WERROR=OFF "${launcher[@]}" >/dev/null
    build build-clang "${targets[@]}"
    run_all build-clang "${targets[@]}"
    ;;
  asan-ubsan)
    read -ra targets <<<"${TARGETS:-${rooms[*]} ${replays[*]}}"
    cmake --preset asan-ubsan "${launcher[@]}" >/dev/null
    build build-asan-ubsan "${targets[@]}"
    ASAN_OPTIONS=detect_leaks=0 run_all build-asan-ubsan "${targets[@]}"
    ;;
  tsan)
    read -ra targets <<<"${TARGETS:-${threads[*]}}"
    cmake --preset tsan "${launcher[@]}" >/dev/null
    build build-tsan "${targets[@]}"
    # Barriers of OpenMP are seen through Archer; without it each would look like a race. HDF5 and the system's libraries are not instrumented.
    archer=$(ls /usr/lib/llvm-16/lib/libarcher.so)
    export OMP_TOOL_LIBRARIES=$archer TSAN_OPTIONS="halt_on_error=1 ignore_noninstrumented_modules=1 ${TSAN_OPTIONS:-}"
    run_all build-tsan "${targets[@]}"
    if [[ " ${targets[*]} " == *" state-hashes "* ]]; then build-tsan/tests/state-hashes --steps 20 --threads 3 "${cases[@]}"; fi
    ;;
  *)
    echo "usage: tools/checks.sh format|scorecard|tidy|clang|asan-ubsan|tsan" >&2
    exit 2
    ;;
esac
