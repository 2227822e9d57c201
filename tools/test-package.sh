#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the Debian package of build/, installs it into a bare Debian 12 root by apt, and validates there.
#   tools/test-package.sh [PROFILE|CASE...]     default: rigid/ballistic; "--profile commit" runs the commit profile
#   KEEP=1 keeps the root and says where; TMPDIR says where it is made (1 GB). Needs root and mmdebstrap.
set -euo pipefail
cd "$(dirname "$0")/.."

say() { printf 'test-package: %s\n' "$*" >&2; }
((EUID == 0)) || { say "needs root: sudo tools/test-package.sh"; exit 2; }
command -v mmdebstrap >/dev/null || { say "needs mmdebstrap: apt-get install --no-install-recommends mmdebstrap"; exit 2; }
[[ -f build/CPackConfig.cmake ]] || { say "build first: make build"; exit 2; }
[[ ${TRIPOINT_PACKAGE:-} ]] || TRIPOINT_PACKAGE=1 exec unshare --mount --pid --fork --kill-child "$0" "$@"

work=$(mktemp -d "${TMPDIR:-/tmp}/tripoint-package.XXXXXX")
root=$work/root
leave() {
  local code=$?
  trap - EXIT INT TERM
  umount --recursive --lazy "$root/proc" "$root/sys" "$root/dev/shm" 2>/dev/null || true
  if [[ ${KEEP:-} == 1 ]]; then say "the root stays: $root"; else rm -rf --one-file-system "$work"; fi
  exit $code
}
trap leave EXIT
trap 'exit 130' INT TERM

cpack --config build/CPackConfig.cmake -B "$work/packed" >&2
package=$(ls "$work"/packed/*.deb)
say "$(basename "$package"): $(stat -c %s "$package") bytes; needs $(dpkg-deb -f "$package" Depends)"

options=(--quiet --variant=minbase --dpkgopt=force-unsafe-io)
while IFS= read -r line; do options+=("--aptopt=$line"); done < <(apt-config dump | grep -E '^Acquire::(https?|Retries|Check-)' || true)
begin=$SECONDS
# apt itself resolves the package's dependencies in the bare root
options+=("--customize-hook=copy-in $package /tmp" "--customize-hook=chroot \"\$1\" apt-get install --yes --no-install-recommends /tmp/$(basename "$package")")
sources=()
if grep -qs '^VERSION_CODENAME=bookworm' /etc/os-release; then
  mapfile -t sources < <(grep -lsE 'bookworm' /etc/apt/sources.list /etc/apt/sources.list.d/*.list /etc/apt/sources.list.d/*.sources |
    xargs -r grep -lE '(debian-archive-keyring|^deb .*/debian)')
fi
mmdebstrap "${options[@]}" bookworm "$root" "${sources[@]}" >&2
say "installed into a bare root after $((SECONDS - begin)) s: $(du -sm "$root" | cut -f1) MB"
mount -t proc proc "$root/proc"
mount -t sysfs -o ro sysfs "$root/sys"  # without it OpenMPI, under LAMMPS, writes complaints among an engine's answers
mkdir -p "$root/dev/shm" && mount -t tmpfs -o mode=1777 tmpfs "$root/dev/shm"
[[ -e $root/dev/null && -c $root/dev/null ]] || mknod -m 666 "$root/dev/null" c 1 3
words=("$@")
((${#words[@]})) || words=(rigid/ballistic)
begin=$SECONDS
code=0
chroot "$root" /usr/bin/env -i HOME=/srv PATH=/usr/bin:/bin LANG=C.UTF-8 sh -c 'cd /srv && exec "$@"' - tripoint validate "${words[@]}" --out report || code=$?
say "tripoint validate ${words[*]}: exit $code after $((SECONDS - begin)) s"
[[ -f $root/srv/report/index.html ]] || { say "no page was drawn"; exit 1; }
chroot "$root" dpkg --verify tripoint || { say "files of the package were changed"; exit 1; }
exit $code
