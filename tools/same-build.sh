#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the last commit twice, in folders of two names, hours and languages, without a compiler cache, and compares all that was compiled and linked.
#   tools/same-build.sh [-j JOBS] [TARGET...]     no target = everything; ends 0 where every file has the same bytes
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)

jobs=2
if [[ ${1:-} == -j ]]; then
  jobs=$2
  shift 2
fi
commit=$(git -C "$root" rev-parse HEAD) # of both, also where somebody commits meanwhile: programs hold its name
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# build FOLDER LANGUAGE ZONE TARGET...
build() {
  local folder=$1 language=$2 zone=$3
  shift 3
  git clone --quiet --shared --no-checkout "$root" "$folder"
  git -C "$folder" checkout --quiet --detach "$commit"
  (cd "$folder" && env LC_ALL="$language" TZ="$zone" CCACHE_DISABLE=1 cmake -S . -B build -G Ninja >/dev/null &&
    env LC_ALL="$language" TZ="$zone" CCACHE_DISABLE=1 cmake --build build -j "$jobs" ${1:+--target} "$@" >/dev/null)
}

# All that a compiler or linker made: objects, archives, libraries, programs, as "hash  name".
made() { (cd "$1/build" && find . -type f ! -path './CMakeFiles/*' -exec sh -c 'head -c 8 "$1" | grep -qE "ELF|!<arch>"' sh {} \; -exec sha256sum {} + | sort -k 2); }

build "$work/a" C UTC "$@"
build "$work/a much longer name/b" C.UTF-8 Asia/Kathmandu "$@"
made "$work/a" >"$work/first"
made "$work/a much longer name/b" >"$work/second"
if [[ ! -s $work/first ]]; then
  echo 'same-build: nothing was built' >&2
  exit 2
fi
if diff "$work/first" "$work/second"; then
  echo "$(grep -c '\.o$' "$work/first") objects and $(grep -vc '\.o$' "$work/first") archives, libraries and programs have the same bytes in both builds"
else
  exit 1
fi
