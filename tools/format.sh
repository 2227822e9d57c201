#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Formats the C++ files of the checkout by .clang-format, or says which are not formatted.
#   tools/format.sh           formats all of them in place
#   tools/format.sh --check   changes nothing; names each file that would change and ends 1 (77 where clang-format-14 is not installed)
set -euo pipefail
cd "$(dirname "$0")/.."

formatter=clang-format-14  # other versions break lines at other places
if ! command -v "$formatter" >/dev/null; then
  echo "format: $formatter is not installed; make test installs it" >&2
  exit 77
fi
mapfile -d '' -t files < <(find src adapters validation program tests \( -name '*.cpp' -o -name '*.hpp' \) -print0)
if [[ ${1:-} != --check ]]; then exec "$formatter" -i "${files[@]}"; fi
found=$(mktemp)
trap 'rm -f "$found"' EXIT
"$formatter" --dry-run --Werror "${files[@]}" 2>&1 >/dev/null | sed -n 's/^\(.*\):[0-9]*:[0-9]*: error: .*/\1/p' | sort | uniq -c >"$found" || true
[[ -s $found ]] || exit 0
cat "$found" >&2
echo "format: places in the files above are not as .clang-format says; run tools/format.sh" >&2
exit 1
