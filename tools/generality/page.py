# SPDX-License-Identifier: BSD-3-Clause
"""The page of a draw: one plot a family, the worst ten, in one file."""

import html
import math
import pathlib
import tomllib

LEAST, MOST = -8, 4  # decades of error over limit that a plot shows
WIDTH, HEIGHT = 640, 56
STYLE = """body { font: 15px/1.45 sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; color: #222 }
h2 { margin: 1.6rem 0 .2rem; font-size: 1.05rem } p { margin: .2rem 0 } table { border-collapse: collapse }
td, th { text-align: left; padding: .2rem .6rem; border-bottom: 1px solid #ddd; vertical-align: top }
.right { color: #1b7837 } .wrong { color: #b2182b } small { color: #666 }"""
KINDS = {
    "drawn": "Drawn scenes: the error over its limit",
    "bystanders": "Bystanders: change by something far away, over 1 % of the family's limit",
    "symmetries": "Symmetries: change by mirroring, turning, boosting, other units, over one millionth of the way",
}


def known():
    """Groups that are not within their limits today, by kind and family."""
    file = pathlib.Path(__file__).with_name("known.toml")
    return {(k["kind"], k["family"]): k for k in tomllib.loads(file.read_text())["known"]}


def used(row):
    """The error over its limit; without an error, infinite."""
    return row["error"] / row["limit"] if row.get("error") is not None else math.inf


def place(share):
    """Of a share on the logarithmic axis [px]; beyond it, at its end."""
    decade = LEAST if share <= 0 else MOST if math.isinf(share) else min(max(math.log10(share), LEAST), MOST)
    return 10 + (decade - LEAST) / (MOST - LEAST) * (WIDTH - 20)


def plot(rows):
    """One point a scene, right of the line where it is above its limit."""
    at = place(1.0)
    parts = [f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}" role="img">']
    parts.append(
        f'<line x1="{at}" x2="{at}" y1="2" y2="40" stroke="#222"/>'
        f'<line x1="10" x2="{WIDTH - 10}" y1="40" y2="40" stroke="#999"/>'
    )
    for decade in range(LEAST, MOST + 1, 2):
        word = "limit" if decade == 0 else f"1e{decade}"
        parts.append(f'<text x="{place(10.0**decade)}" y="53" font-size="10" text-anchor="middle">{word}</text>')
    for n, row in enumerate(rows):
        share = used(row)
        hue = "#1b7837" if share <= 1.0 else "#b2182b"
        parts.append(f'<circle cx="{place(share):.1f}" cy="{8 + n % 6 * 5}" r="3" fill="{hue}" fill-opacity=".7">')
        parts.append(f"<title>{html.escape(name_of(row))}: {share:.3g}</title></circle>")
    return "".join(parts) + "</svg>"


def name_of(row):
    return " ".join(str(part) for part in (row["family"], row["scene"], row["change"]) if part != "")


def numbers(row):
    return ", ".join(f"{k} {v:.3g}" if isinstance(v, float) else f"{k} {v}" for k, v in row.get("drawn", {}).items())


def reason(row, listed):
    if "failed" in row:
        return row["failed"]
    same = row.get("at equal steps")
    if same is not None and same <= row["limit"]:
        return f"the time step alone: with the same steps {same:.2g}"
    return listed.get((row["kind"], row["family"]), {}).get("reason", "not known")


def worst_ten(groups, listed):
    rows = sorted((r for g in groups.values() for r in g if used(r) > 1.0), key=used, reverse=True)
    text = "<table><tr><th>scene</th><th>error over limit</th><th>reason</th><th>drawn</th></tr>"
    for kind in KINDS:
        for r in [r for r in rows if r["kind"] == kind][:10]:
            text += f'<tr><td>{kind}: {html.escape(name_of(r))}</td><td class="wrong">{used(r):.3g}</td>'
            text += (
                f"<td>{html.escape(reason(r, listed))[:300]}</td><td><small>{html.escape(numbers(r))}</small></td></tr>"
            )
    return text + "</table>" if rows else "<p>No scene is above its limit.</p>"


def page(seed, groups, heads, verdicts):
    """@param verdicts by kind and family: 95th percentile, why it is not as expected or "", the known entry or None"""
    listed = known()
    parts = [
        "<!doctype html><html lang='en'><meta charset='utf-8'><title>Generality</title>",
        f"<style>{STYLE}</style>",
    ]
    parts.append(f"<h1>Does it hold outside the suite?</h1><p>Scenes drawn from seed {seed}, run at the defaults. "
                 "Each point is a scene. Points right of the line are wrong.</p>")  # fmt: skip
    for kind, title in KINDS.items():
        of_kind = {k: g for k, g in sorted(groups.items()) if k[0] == kind}
        if of_kind:
            parts.append(f"<h1>{title}</h1>")
        for key, rows in of_kind.items():
            at, why, entry = verdicts[key]
            wrong = sum(used(r) > 1.0 for r in rows)
            hue, word = ("wrong", "above its limit") if at > 1.0 else ("right", "within its limit")
            if entry and at <= 1.0:  # other draws are wrong: no green
                hue, word = "open", "within its limit in this draw"
            head, reason = heads[key[1]], f" Known: {entry['reason']}." if entry else ""
            parts.append(f"<h2>{html.escape(head['title'])}</h2><p>{html.escape(head['why'])}.")
            parts.append(f"<b class='{hue}'>95th percentile {at:.3g}: {word}</b>; {wrong} of {len(rows)} scenes above.")
            parts.append(html.escape(f"{reason} {why}") + "</p>")
            parts.append(plot(rows))
    parts.append("<h1>The worst ten of each kind</h1>" + worst_ten(groups, listed))
    return "\n".join(parts) + "\n"
