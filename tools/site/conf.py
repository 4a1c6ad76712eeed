# SPDX-License-Identifier: Apache-2.0
# Settings with which tools/site.sh makes a searchable site of README.md and docs/. Reasons for the parts: the search of Sphinx
# works without a server, MyST reads the pages without changes, and Furo is readable on a phone, in light and dark.
project = "sixstep"
html_title = "sixstep"
extensions = ["myst_parser"]
include_patterns = ["README.md", "CHANGELOG.md", "docs/**.md", "faces/**.md", "data/**.md"]
root_doc = "README"
myst_heading_anchors = 4
html_theme = "furo"
html_copy_source = False
html_show_copyright = False
html_show_sphinx = False
highlight_language = "none"

CONTENTS = {"Get started": ["docs/README", "docs/start/tour", "docs/start/*", "docs/faq"], "How-to": ["docs/howto/*"],
            "Gallery": ["docs/gallery/README", "docs/gallery/*"],
            "Reference": ["docs/reference/*", "docs/reference/keys/README", "docs/reference/keys/*"],
            "Explanation": ["docs/explanation/*"],
            "For developers": ["docs/*", "faces/**", "data/**", "CHANGELOG"]}


def with_contents(_, name, source):
    """Adds the lists of the other pages to the first page, for the sidebar."""
    if name == root_doc:
        for caption, pages in CONTENTS.items():
            source[0] += "\n".join(["", "```{toctree}", ":hidden:", ":glob:", f":caption: {caption}", "", *pages, "```", ""])


def without_layers(_, name, source):
    """Marks the block of the layers as plain text, because the highlighter does not know the language "layers"."""
    source[0] = source[0].replace("```layers\n", "```text\n")


def setup(app):
    app.connect("source-read", with_contents)
    app.connect("source-read", without_layers)
