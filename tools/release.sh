#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Signs the tag of a release and verifies it as everybody else would; pushes nothing.
#   tools/release.sh VERSION     0.2.0 makes the tag v0.2.0 at HEAD, signed by the key of `git config user.signingkey`
# It wants a clean checkout that says this version everywhere, and a key that .github/allowed_signers names (a line each: NAME KEY-TYPE KEY).
# The workflow `image` publishes nothing of a tag that this file does not vouch for.
set -euo pipefail
cd "$(dirname "$0")/.."

say() { printf 'release: %s\n' "$*" >&2; }
version=${1:-}
[[ $version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]] || { say 'usage: tools/release.sh VERSION, as 0.2.0'; exit 2; }
signers=.github/allowed_signers

[[ -z $(git status --porcelain) ]] || { say 'the checkout has changes that are not committed'; exit 1; }
grep -q "^project(tripoint VERSION $version " CMakeLists.txt || { say "CMakeLists.txt says another version than $version"; exit 1; }
grep -q "^version: $version\$" CITATION.cff || { say "CITATION.cff says another version than $version"; exit 1; }
grep -q "^## \[$version\] - [0-9]\{4\}-[0-9][0-9]-[0-9][0-9]\$" CHANGELOG.md || { say "CHANGELOG.md has no heading ## [$version] - YYYY-MM-DD"; exit 1; }
git cat-file -e "HEAD:$signers" 2>/dev/null || { say "$signers is not committed: nobody could verify a signature"; exit 1; }

git -c gpg.format=ssh tag --sign --message "tripoint $version" "v$version"
if ! git -c gpg.format=ssh -c gpg.ssh.allowedSignersFile="$signers" verify-tag "v$version"; then
  git tag --delete "v$version" >/dev/null
  say "the key is not one of $signers: the tag is removed"
  exit 1
fi
say "v$version is signed; publish it by: git push origin v$version"
