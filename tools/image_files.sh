#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copies what the program needs to run from build/ to a folder, links followed, and writes DIR/packages: the Debian packages that its
# libraries and the report are from.
#   tools/image_files.sh DIR
set -euo pipefail
cd "$(dirname "$0")/.."
to=${1:?usage: tools/image_files.sh DIR}

mkdir -p "$to"/{bin,libexec,lib,share}
cp build/bin/tripoint "$to/bin/"
cp -rL build/share/tripoint "$to/share/"
cp -rL build/lib/tripoint "$to/lib/"
mkdir -p "$to/libexec/tripoint"
find build/libexec/tripoint -maxdepth 1 -type f -name 'engine-*' -exec cp {} "$to/libexec/tripoint/" \;
strip "$to"/bin/tripoint 2>/dev/null || true

# A library may be listed under /lib and belong to a package under /usr/lib.
programs=$(find "$to" -type f -exec sh -c 'head -c 4 "$1" | grep -q ELF' _ {} \; -print)
for library in $(ldd $programs 2>/dev/null | awk '/=> \//{print $3}' | sort -u); do
  dpkg-query --search "$(realpath "$library")" 2>/dev/null || dpkg-query --search "$library" 2>/dev/null || true
done | cut -d: -f1 | sort -u >"$to/packages"
printf '%s\n' python3 python3-matplotlib python3-h5py python3-jinja2 >>"$to/packages"
