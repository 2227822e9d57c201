#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Takes packages from Debian's archive as it was when this system's image was made: the same image then gets the same packages at any later day.
#   tools/debian_snapshot.sh [FILE=/etc/apt/sources.list.d/debian.sources]
# Debian's own images name that place and date in a comment of the file; where there is none, nothing is changed and the exit is 1.
set -eu
file=${1:-/etc/apt/sources.list.d/debian.sources}
if ! grep -q '^# http.*/[0-9]\{8\}T[0-9]\{6\}Z$' "$file"; then
  echo "debian_snapshot: $file names no date of the archive" >&2
  exit 1
fi
# The comment becomes the place, and the place that stood below it goes. A list of an earlier day is out of date, and wanted.
sed -i -e '/^# http.*\/[0-9]\{8\}T[0-9]\{6\}Z$/ { s/^# \(.*\)/Check-Valid-Until: no\nURIs: \1/; n; /^URIs:/d }' "$file"
