# SPDX-License-Identifier: BSD-3-Clause
"""JSON that others have a hand in: titles, reasons and names of cases and engines.

No control character of theirs reaches a page, a table or a terminal, nor a mark that turns the direction of writing or
is not seen. The program does the same with what it prints (validation/results/escaped_text.cpp)."""

from __future__ import annotations

import json
import re

BREAK = re.compile("[\x0b\x0c\x0d\x85\u2028\u2029]")
HIDDEN = re.compile(
    "[\x00-\x08\x0e-\x1f\x7f-\x84\x86-\x9f\u200b-\u200f\u202a-\u202e\u2060-\u206f\ud800-\udfff\ufeff\ufffe\uffff]"
)


def plain(text):
    """Line breaks of other kinds become spaces, hidden characters question marks; tabs and newlines stay."""
    return HIDDEN.sub("?", BREAK.sub(" ", text))


def cleaned(value):
    if isinstance(value, str):
        return plain(value)
    if isinstance(value, list):
        return [cleaned(item) for item in value]
    if isinstance(value, dict):
        return {plain(key): cleaned(item) for key, item in value.items()}
    return value


def parsed(text):
    """As json.loads. @raises ValueError, RecursionError"""
    return cleaned(json.loads(text))


def read(path):
    """The document of a file. @raises OSError, ValueError, RecursionError"""
    return parsed(path.read_text(encoding="utf-8"))
