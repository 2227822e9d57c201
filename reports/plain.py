# SPDX-License-Identifier: BSD-3-Clause
"""The page where Jinja is not installed: the same verdicts as plain tables."""

from __future__ import annotations

from html import escape

from page import percent, show


def render(results, missing_libraries):
    out = [
        "<!doctype html><html lang=en><meta charset=utf-8><meta name=viewport content='width=device-width'><meta "
        "name=color-scheme content='light dark'>",
        f"<title>{escape(results.verdict)} · tripoint report</title><style>body{{font:16px "
        f"sans-serif;max-width:75em;margin:1em auto;padding:0 1em}}td,th{{padding:.15em .6em;text-align:left}}</style>",
        f"<h1>{escape(results.verdict)}, exit code {escape(results.exit_code)}</h1>",
    ]
    out += [f"<p><b>No pictures:</b> {escape(line)}</p>" for line in missing_libraries]
    out += [f"<p>{escape(line)}</p>" for line in results.notes]
    out.append(
        f"<p>{escape(results.command)} · profile {escape(results.profile)} · seed "
        f"{escape(results.seed)}</p><p>{escape(', '.join(f'{k} {v}' for k, v in results.tool.items()))}</p>"
    )
    for case in results.cases:
        out.append(
            f"<h2>{escape(case.id)}: {escape(case.verdict)}</h2><p>{escape(case.title)}. {escape(case.claims)}</p>"
        )
        out.append(
            "<table><tr><th>engine<th>status<th>metric<th>mode<th>value<th>uncertainty<th>allowed<th>used<th>verdict<th>reason"
        )
        for engine in case.engines:
            head = f"<tr><td>{escape(engine.label)}<td>{escape(engine.status)}"
            out += [
                f"{head}<td>{escape(g.metric)}<td>{escape(g.mode)}<td>{show(g.value)}<td>{show(g.uncertainty)}<td>{escape(g.allowed)}<td>{percent(g.used)}<td>{escape(g.verdict)}<td>{escape(g.reason)}"
                for g in engine.gates
            ]
            if not engine.gates:
                out.append(f"{head}<td colspan=8>{escape(engine.reason or 'no gate')}")
        out.append(f"</table><p><code>{escape(case.repeat)}</code></p>")
    return "\n".join(out) + "</html>\n"
