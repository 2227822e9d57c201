#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# What a new user sees: a bare Debian 12 root, the committed checkout, `make validate`, then `make test`; nothing else typed.
#   tools/test-fresh.sh [COMMAND...]     commands to run instead of the two, e.g. "make setup"
#   KEEP=1 keeps the root (and says where), TMPDIR says where it is made (3 GB).
set -euo pipefail
cd "$(dirname "$0")/.."

say() { printf 'test-fresh: %s\n' "$*" >&2; }
fail() { say "$*"; exit 2; }

((EUID == 0)) || fail "needs root: sudo make test-fresh"
command -v mmdebstrap >/dev/null || fail "needs mmdebstrap: apt-get install --no-install-recommends mmdebstrap"
# In a mount and process namespace of its own nothing stays mounted or running, however this ends.
[[ ${TRIPOINT_FRESH:-} ]] || TRIPOINT_FRESH=1 exec unshare --mount --pid --fork --kill-child "$0" "$@"

root=$(mktemp -d "${TMPDIR:-/tmp}/tripoint-fresh.XXXXXX")
leave() {
  local code=$?
  trap - EXIT INT TERM
  if [[ ${KEEP:-} == 1 ]]; then
    say "the root stays: $root"
  else
    umount --recursive --lazy "$root/proc" "$root/sys" "$root/dev" 2>/dev/null || true
    rm -rf --one-file-system "$root"
  fi
  exit $code
}
trap leave EXIT
trap 'exit 130' INT TERM

# The root: Debian's own sources, or this machine's where it is a Debian 12 too; this machine's proxy settings for apt.
make_root() {
  local -a options=(--quiet --variant=apt --include=make)
  local line
  while IFS= read -r line; do options+=("--aptopt=$line"); done < <(apt-config dump | grep -E '^Acquire::(https?|Retries|Check-)' || true)
  local -a sources=()
  if grep -qs '^VERSION_CODENAME=bookworm' /etc/os-release; then
    mapfile -t sources < <(grep -lsE 'bookworm' /etc/apt/sources.list /etc/apt/sources.list.d/*.list /etc/apt/sources.list.d/*.sources |
      xargs -r grep -lE '(debian-archive-keyring|^deb .*/debian)')
  fi
  mmdebstrap "${options[@]}" bookworm "$root" "${sources[@]}" >&2
}

# What a bare root lacks: host names, the certificates and pip settings by which this machine reaches its registries.
furnish_root() {
  printf '127.0.0.1 localhost\n::1 localhost\n' >"$root/etc/hosts"
  local bundle=${PIP_CERT:-${SSL_CERT_FILE:-/etc/ssl/certs/ca-certificates.crt}}
  if [[ -f $bundle ]]; then
    install -D -m 644 "$bundle" "$root/usr/local/share/ca-certificates/outer.crt"
  fi
  local file
  for file in /etc/pip.conf "${HOME:-/root}/.config/pip/pip.conf" "${PIP_CONFIG_FILE:-}"; do
    if [[ -f $file ]]; then cat "$file" >>"$root/etc/pip.conf"; fi
  done
  if [[ -d ${PIP_FIND_LINKS:-} ]]; then
    mkdir -p "$root$PIP_FIND_LINKS" && cp -r "$PIP_FIND_LINKS/." "$root$PIP_FIND_LINKS"
  fi
  mount -t proc proc "$root/proc"
  mount -t sysfs -o ro sysfs "$root/sys"
  mount -t tmpfs -o mode=755 tmpfs "$root/dev"
  local node
  for node in "null 3" "zero 5" "full 7" "random 8" "urandom 9"; do mknod -m 666 "$root/dev/${node% *}" c 1 "${node#* }"; done
  ln -s /proc/self/fd "$root/dev/fd"
  mkdir -m 755 "$root/dev/pts"
  mount -t devpts -o newinstance,ptmxmode=0666 devpts "$root/dev/pts"  # a terminal, as a user has
  ln -s pts/ptmx "$root/dev/ptmx"
  mkdir -m 1777 "$root/dev/shm"
  mount -t tmpfs -o mode=1777 tmpfs "$root/dev/shm"
}

# Runs one line in the root as a fresh login would, with this machine's PIP_* and proxy settings and nothing else of it.
inside() {
  local -a settings=(HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 TERM="${TERM:-dumb}")
  local name
  while IFS= read -r name; do settings+=("$name=${!name}"); done < <(compgen -e | grep -iE '^PIP_|^(https?|no)_proxy$' | grep -v '^PIP_C')
  if [[ -f $root/usr/local/share/ca-certificates/outer.crt ]]; then settings+=(PIP_CERT=/usr/local/share/ca-certificates/outer.crt); fi
  chroot "$root" /usr/bin/env -i "${settings[@]}" sh -c "cd /srv/tripoint && $1" </dev/null
}

# Runs one line, passing its output on, and says how long it took and when its first and last verdict line came.
timed() {
  local begin=$SECONDS code=0
  say "\$ $1"
  inside "$1" 2>&1 | while IFS= read -r line; do
    printf '%s\n' "$line"
    [[ $line =~ (^|[^A-Za-z])(PASS|FAIL|INCONCLUSIVE)([^A-Za-z]|$) && -z ${seen:-} ]] && { seen=1; say "first verdict line after $((SECONDS - begin)) s"; }
    true
  done || code=$?
  say "\$ $1: exit $code after $((SECONDS - begin)) s"
  return $code
}

begin=$SECONDS
make_root
furnish_root
git clone --quiet --no-hardlinks . "$root/srv/tripoint"
say "bare root with $(git rev-parse --short HEAD) after $((SECONDS - begin)) s"
(($#)) || set -- "make validate" "make test"
for line in "$@"; do timed "$line"; done
say "all of it: $((SECONDS - begin)) s"
