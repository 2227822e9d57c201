#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Configures build/ where that is needed, and builds it.
#   tools/build.sh [--tests|--selftest] JOBS [TARGET...]
#     --tests adds the test programs to the same folder; no object is built anew for it.
#     --selftest adds what `tripoint gate selftest` needs, builds that alone, and wants no further package.
#     TARGET: these and what they need, in place of all
# With CI set in the environment the first configuration makes warnings errors.
set -euo pipefail
cd "$(dirname "$0")/.."

tests=OFF selftest=OFF
case ${1:-} in
  --tests) tests=ON && shift ;;
  --selftest) selftest=ON && shift ;;
esac
jobs=${1:-2}
targets=("${@:2}")
[[ $selftest == OFF ]] || targets+=(tripoint engine-tripoint-selftest)

if [[ ! -f build/build.ninja ]]; then
  options=(-DTRIPOINT_TESTS=$tests -DTRIPOINT_SELFTEST=$selftest)
  [[ -z ${CI:-} ]] || options+=(-DTRIPOINT_WERROR=ON)
  command -v ccache >/dev/null && options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  cmake -S . -B build -G Ninja "${options[@]}" >/dev/null
elif [[ $tests == ON ]] && ! grep -q '^TRIPOINT_TESTS:BOOL=ON$' build/CMakeCache.txt; then
  cmake -S . -B build -DTRIPOINT_TESTS=ON >/dev/null
elif [[ $selftest == ON ]]; then
  cmake -S . -B build -DTRIPOINT_SELFTEST=ON >/dev/null
fi
exec ninja -C build -j "$jobs" "${targets[@]}" >&2
