#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Refuses the message of a commit without a body: one subject line, an empty line, and why the change is made. pre-commit calls it.
#   tools/commit_message.sh FILE   FILE holds the message, as git gives it to a commit-msg hook; ends 1 and says what to write
# Merges pass as git words them; so do fixup!, squash! and amend!, which end in another commit. Lines such as Signed-off-by: are no body.
set -euo pipefail

refuse() {
  printf 'commit message: %s\n' "$1" "write one subject line, an empty line, and a body that says why the change is made" >&2
  exit 1
}

message=$(sed '/^# -\+ >8 -\+$/,$d' "${1:?the file of the message}" | git stripspace --strip-comments)
subject=${message%%$'\n'*}
[[ -n $subject ]] || exit 0 # git itself refuses an empty one
[[ $subject =~ ^(fixup|squash|amend)!\  ]] && exit 0
[[ $subject =~ ^Merge\ (branch|branches|tag|tags|commit|commits|remote-tracking\ branch|remote-tracking\ branches|pull\ request)\ [\'#] ]] && exit 0
git rev-parse --quiet --verify MERGE_HEAD >/dev/null && exit 0

rest=${message#"$subject"}
[[ -z $rest || $rest == $'\n\n'* ]] || refuse "the line below the subject is not empty"
grep --quiet --invert-match --extended-regexp '^(([A-Za-z]+(-[A-Za-z]+)+|Fixes|Closes|Refs): .*)?$' <<<"$rest" || refuse "\"$subject\" has no body"
