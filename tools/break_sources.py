#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the sources of the self-test: copies of the solver's files, with the registered defects in them.

    tools/break_sources.py --list ROOT...                 the files that defects change, a line each, relative to their
    ROOT
    tools/break_sources.py --write FILE --to OUT ROOT     one of them, with all its changes
    tools/break_sources.py --register OUT ROOT...         C++ source of registered_defects(): the names of all

A folder of ROOT may hold a `defects.toml`: what can be broken there, and how. Formulas know nothing of it.

    [[defect]]
    name = "heat.conductivity"                            # then set by TRIPOINT_DEFECT=heat.conductivity=0.05
    what = "conductivity times 1 + size"
    case = "heat/cosine-mode"                             # the case that must turn red

    [[change]]
    file = "heat_corrected.cpp"                           # beside this file
    text = "return *m.conductivity;"                      # stands once in it; how its lines are broken does not matter
    broken = 'return *m.conductivity * (1.0 + defect<"heat.conductivity">());'   # the same where no defect is set: its
    size is 0

Errors name the file, and what to write: a text that is not there any more, or twice; a defect that no change uses; one
that is not registered."""

import argparse
import json
import re
import sys
import tomllib
from pathlib import Path

USED = re.compile(r'defect<"([^"]+)">')


class Wrong(Exception):
    pass


def load(root):
    """Changes by file, relative to root, and the defects of all folders. @raises Wrong"""
    changes, defects, used, named = {}, [], [], []
    for path in sorted(root.rglob("defects.toml")):
        own, here = rows_of(path)
        used += [(path, name) for _, _, broken in here for name in sorted(set(USED.findall(broken)))]
        named += [(path, name) for name, _, _ in sorted(own)]
        defects += own
        for file, text, broken in here:
            place = (path.parent / file).relative_to(root).as_posix()
            changes.setdefault(place, []).append((path, text, broken))
    check_names(root, used, named)
    return changes, defects


def rows_of(path):
    """([(name, what, case)], [(file, text, broken)]) of one defects.toml. @raises Wrong"""
    try:
        data = tomllib.loads(path.read_text())
        own = [(d["name"], d["what"], d["case"]) for d in data.pop("defect", [])]
        here = [(c["file"], c["text"], c["broken"]) for c in data.pop("change", [])]
    except (tomllib.TOMLDecodeError, KeyError) as why:
        raise Wrong(
            f"{path}: {why}: a [[defect]] has name, what and case, a [[change]] has file, text and broken"
        ) from None
    if data:
        raise Wrong(f"{path}: unknown {', '.join(data)}: only [[defect]] and [[change]] stand here")
    return own, here


def check_names(root, used, named):
    """Each defect is registered once, and each that is used is registered. @raises Wrong"""
    names = [name for _, name in named]
    seen = {name for _, name in used}
    for path, name in used:
        if name not in names:
            raise Wrong(f'{path}: defect<"{name}">() is used, and no [[defect]] has that name')
    for path, name in named:
        if name not in seen:
            raise Wrong(f'{path}: no [[change]] uses defect<"{name}">()')
    twice = {name for name in names if names.count(name) > 1}
    if twice:
        raise Wrong(f"{root}: registered twice: {', '.join(sorted(twice))}")


def broken_text(root, file, changes):
    """The file with all its changes. A change is looked for in the file as it stands, so that no change depends on
    another."""
    source = (root / file).read_text()
    spans = []
    for path, text, broken in changes:
        found = list(re.finditer(r"\s+".join(map(re.escape, text.split())), source))
        if len(found) != 1:
            raise Wrong(f"{path}: the text {text!r} stands {len(found)} times in {file}; write what stands there once")
        spans.append((*found[0].span(), broken.strip(), path))
    spans.sort()
    for (_, end, _, path), (start, _, _, _) in zip(spans, spans[1:]):
        if start < end:
            raise Wrong(f"{path}: two changes of {file} overlap; make one of them")
    for start, end, broken, _ in reversed(spans):
        source = source[:start] + broken + source[end:]
    head, sep, rest = source.partition("#include ")
    return head + '#include "core/defect.hpp"\n' + sep + rest


def register(defects):
    rows = "".join(f"      {{{', '.join(json.dumps(word) for word in one)}}},\n" for one in defects)
    return (
        '// Written by tools/break_sources.py.\n#include "core/defect.hpp"\n\nnamespace tripoint {\n\n'
        f"std::vector<DefectEntry> registered_defects() {{\n  return {{\n{rows}  }};\n}}\n\n}}  // namespace tripoint\n"
    )


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("roots", nargs="+", type=Path, metavar="ROOT")
    what = words.add_mutually_exclusive_group(required=True)
    what.add_argument("--list", action="store_true")
    what.add_argument("--write", metavar="FILE")
    what.add_argument("--register", type=Path, metavar="OUT")
    words.add_argument("--to", type=Path, metavar="OUT")
    asked = words.parse_args()
    try:
        loaded = [(root, *load(root)) for root in asked.roots]
        if asked.list:
            for _, changes, _ in loaded:
                print("\n".join(sorted(changes)))
        elif asked.register:
            asked.register.parent.mkdir(parents=True, exist_ok=True)
            asked.register.write_text(register([d for _, _, defects in loaded for d in defects]))
        else:
            root, changes, _ = loaded[0]
            asked.to.parent.mkdir(parents=True, exist_ok=True)
            asked.to.write_text(broken_text(root, asked.write, changes[asked.write]))
    except (Wrong, OSError) as why:
        print(f"break_sources: {why}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
