# SPDX-License-Identifier: BSD-3-Clause
"""For scripts/docs.sh, which has Sphinx make the site: the pages are Markdown as a code host shows it."""

import pathlib
import re
import xml.etree.ElementTree as xml

project = "trismooth"
project_copyright = "the authors of trismooth, BSD 3-Clause"
extensions = ["myst_parser"]
root_doc = "README"
include_patterns = ["*.md", "docs/*.md", "examples/**.md", "benchmarks/results/**.md", "api/index.md", "reports/index.md"]

html_theme = "furo"
html_title = "trismooth"
html_show_sphinx = False
html_static_path = ["style"]
html_css_files = ["site.css"]
# The pages' text is in the tree, under its own name.
html_copy_source = False

# Headings have the labels that a code host gives them; a link to another place is an error.
myst_heading_anchors = 6

# What the front page leads to, in this order. A page of docs/ that is not here is an error.
NAVIGATION = {
    "Use": ["docs/install", "docs/which_option", "docs/command_line", "docs/formats", "docs/walks", "examples/data/README",
            "reports/index", "docs/limits", "docs/troubleshooting"],
    "Program": ["docs/library", "docs/headers", "api/index", "docs/python", "docs/python_peers", "docs/gpu", "docs/ranks",
                "examples/README", "examples/python/README"],
    "Methods": ["docs/method", "docs/mean_ratio", "docs/sliding", "docs/moving", "docs/finite_elements", "docs/experiments",
                "benchmarks/results/README"],
    "Project": ["docs/architecture", "CONTRIBUTING", "SECURITY", "CHANGELOG"],
}
MEASUREMENTS = ["paper/README", "2*"]


def toctree(entries, *options):
    return "\n".join(["", "```{toctree}", *options, "", *entries, "```", ""])


def with_links_to_doxygen(text):
    """Names of public headers lead to what Doxygen has made of them."""
    output = pathlib.Path(__file__).parent.parent / "build/docs"
    places = {file.findtext("path").removeprefix(f"{output}/include/") + file.findtext("name"): file.findtext("filename")
              for file in xml.parse(output / "api.xml").findall("compound[@kind='file']")}
    return re.sub("`(trismooth/[^`]*)`", lambda name: f'<a href="../api/{places[name[1]]}"><code>{name[1]}</code></a>', text)


def add_what_the_site_has(_, page, source):
    """The pages themselves have no directives of Sphinx, which a code host would show as text."""
    if page == root_doc:
        source[0] += "".join(toctree(pages, ":hidden:", f":caption: {name}") for name, pages in NAVIGATION.items())
    elif page == "benchmarks/results/README":
        source[0] += toctree(MEASUREMENTS, ":glob:", ":reversed:")
    elif page == "docs/headers":
        source[0] = with_links_to_doxygen(source[0])


def setup(app):
    app.connect("source-read", add_what_the_site_has)
