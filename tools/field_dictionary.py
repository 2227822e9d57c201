#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the field dictionary of docs/model.md: a table of every field, between two marks.

    tools/field_dictionary.py TRIPOINT                         prints the table
    tools/field_dictionary.py TRIPOINT --write docs/model.md   puts it into the page (make pages)

A folder of src that declares fields has a `fields.toml` with the symbol, if there is one, and the meaning of each.
Components of a vector have one line:

    temperature = { symbol = "T", meaning = "temperature" }
    drag_force = { symbol = "F", meaning = "force of drag, -c m v" }     # drag_force.x, .y and .z

Unit, owner, carrier and components come from the program: `tripoint explain --json` of every case, in each of its
modes. Errors name the file, and what to write: a field without a meaning, a line of no field, or an effect's line of a
field that the effect does not own."""

import argparse
import json
import os
import re
import subprocess
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[1]
BEGIN, END = "<!-- begin fields -->", "<!-- end fields -->"
COMPONENT = re.compile(r"(.*)\.(x|y|z|xx|yy|zz|yz|xz|xy|yx|zx|zy)")
TYPES = {4: "1", 8: "1", 24: "Vec3", 32: "Quaternion"}  # by the bytes of one value


class Wrong(Exception):
    pass


def explained(tripoint, case, *more):
    done = subprocess.run([tripoint, "explain", str(case), "--json", *more], capture_output=True, text=True)
    if done.returncode:
        raise Wrong(done.stderr.strip())
    return json.loads(done.stdout)


def columns_of(tripoint, case):
    """Columns of a case in each of its modes, as the program plans them."""
    first = explained(tripoint, case)
    value = {d["key"]: json.loads(d["value"]) for d in first["decisions"] if d["key"] in ("case.modes", "scene.mode")}
    others = [mode for mode in value["case.modes"] if mode != value["scene.mode"]]
    return first["fields"] + [
        f for mode in others for f in explained(tripoint, case, "--set", f'scene.mode="{mode}"')["fields"]
    ]


def columns_of_all(tripoint, cases):
    files = [path for path in sorted(cases.rglob("*.toml")) if path.parent.name != "materials"]
    with ThreadPoolExecutor(min(4, len(os.sched_getaffinity(0)))) as several:
        return [column for columns in several.map(lambda case: columns_of(tripoint, case), files) for column in columns]


def fields_from(columns):
    """What the code says of each field: components, carrier, unit and owners. @raises Wrong"""
    fields = {}
    for column in columns:
        parts = COMPONENT.fullmatch(column["name"])
        name, component = parts.groups() if parts else (column["name"], TYPES[column["bytes"]])
        field = fields.setdefault(
            name, {"components": [], "per": column["per"], "unit": column["unit"], "owners": set()}
        )
        if component not in field["components"]:
            field["components"].append(component)
        field["owners"].add(column["owner"])
        if (field["per"], field["unit"]) != (column["per"], column["unit"]):
            raise Wrong(f"the columns of {name} differ in unit or in what carries them")
    return fields


def words_from(root):
    """(file, name, symbol, meaning) of each line of each fields.toml, in the order of the files. @raises Wrong"""
    words = []
    for path in sorted(root.rglob("fields.toml"), key=lambda path: ("effects" in path.parts, path)):
        shown = path.relative_to(root.parent)
        try:
            lines = tomllib.loads(path.read_text())
        except tomllib.TOMLDecodeError as why:
            raise Wrong(f"{shown}: {why}") from None
        for name, said in lines.items():
            if not isinstance(said, dict) or not said.get("meaning") or said.keys() - {"symbol", "meaning"}:
                raise Wrong(
                    f'{shown}: {name}: write {name} = {{ symbol = "...", meaning = "..." }}; the symbol may be left out'
                )
            if any(name == other for _, other, _, _ in words):
                raise Wrong(f"{shown}: {name} has two lines: delete one")
            cells = said.get("symbol", "-"), said["meaning"]
            if any("|" in cell or "\n" in cell for cell in cells):
                raise Wrong(f"{shown}: {name}: a cell of a table has no | and is one line")
            words.append((path, name, *cells))
    return words


def kind_of(field):
    """Components of a value, and what carries it; a scalar of a particle says neither."""
    parts = [",".join(field["components"])] if field["components"] != ["1"] else []
    parts += [f"({field['per']})"] if field["per"] != "particle" else []
    return "".join(" " + part for part in parts)


def table(fields, words, root):
    """The table of all fields. @raises Wrong"""
    rows = ["| field | symbol | unit | owner | meaning |", "|---|---|---|---|---|"]
    for path, name, symbol, meaning in words:
        shown, folder = path.relative_to(root.parent), path.parent
        if name not in fields:
            raise Wrong(f"{shown}: no effect of any case owns a field {name}: delete the line")
        field = fields[name]
        if folder.parent.name == "effects" and folder.name not in field["owners"]:
            raise Wrong(f"{shown}: {name} is a field of {', '.join(sorted(field['owners']))}: move the line")
        owners = ", ".join(sorted(field["owners"]))
        rows.append(f"| `{name}`{kind_of(field)} | {symbol} | {field['unit']} | {owners} | {meaning} |")
    for name in sorted(fields.keys() - {name for _, name, _, _ in words}):
        owner = min(fields[name]["owners"])
        raise Wrong(
            f'the field {name} of {owner} has no meaning: write {name} = {{ symbol = "...", meaning = "..." }} in the '
            "fields.toml beside its declaration"
        )
    return "\n".join(rows) + "\n"


def with_table(page, rows):
    """The page with these rows between its marks. @raises Wrong"""
    if page.count(BEGIN) != 1 or page.count(END) != 1 or page.index(BEGIN) > page.index(END):
        raise Wrong(f"the page needs the marks {BEGIN} and {END}, once each")
    return page[: page.index(BEGIN)] + f"{BEGIN}\n{rows}" + page[page.index(END) :]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tripoint", type=Path)
    parser.add_argument("--write", type=Path, metavar="PAGE")
    options = parser.parse_args()
    root = SOURCE / "src"
    try:
        rows = table(fields_from(columns_of_all(options.tripoint.resolve(), SOURCE / "cases")), words_from(root), root)
        if options.write:
            options.write.write_text(with_table(options.write.read_text(), rows))
        else:
            print(rows, end="")
    except (Wrong, OSError) as why:
        print(f"field_dictionary: {why}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
