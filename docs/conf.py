# SPDX-License-Identifier: BSD-3-Clause
# The guide: `make docs` writes build/docs/index.html from these pages with Sphinx and MyST
# (tools/requirements-docs.txt).
from pygments.lexers.special import TextLexer
from sphinx.highlighting import lexers

lexers["mermaid"] = lexers["csv"] = TextLexer()
project = "tripoint"
copyright = "the tripoint authors"
extensions = ["myst_parser"]
myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 4
myst_fence_as_directive = ["math"]
exclude_patterns = ["accuracy/*", "still-water/*", "**/__pycache__"]
html_theme = "furo"
html_title = "tripoint"
html_copy_source = False
html_show_sphinx = False
suppress_warnings = [
    "myst.xref_missing",
    "misc.highlighting_failure",
    "toc.not_included",
]  # tests/docs/links_test.py looks at every link, also at those that leave this folder
