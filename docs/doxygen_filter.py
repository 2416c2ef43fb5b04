#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Turns a page of the documentation, as GitHub shows it, into what Doxygen understands: docs/doxygen_filter.py PAGE.

Headings get the labels that GitHub gives them, links between pages lead to these, and links to other files of the
project lead to the files.
"""

import os
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
HTML = ROOT / "build/docs/html"


def page_label(page):
    return "page_" + page.stem.lower()


def label(page, heading):
    return page_label(page) + "_" + re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "_").replace("-", "_")


def is_page(file):
    return file.suffix == ".md" and (file.parent in (ROOT, ROOT / "docs")) and file.name != "CHANGELOG.md"


def without_links_of_github(line, page):
    def link(match):
        text, target = match[1], match[2]
        if target.startswith(("http://", "https://")):
            return match[0]
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        if is_page(file):
            name = label(file, anchor) if anchor else page_label(file)
            return f"@ref {name} \"{text}\""
        # Doxygen would take a link to a .md file for one to a page.
        return f'<a href="{os.path.relpath(file, HTML)}">{text}</a>'

    def image(match):
        return f'<img src="{os.path.relpath(page.parent / match[2], HTML)}" alt="{match[1]}" style="max-width: 100%"/>'

    line = re.sub(r"!\[([^\]]*)\]\(([^)]*)\)", image, line)
    return re.sub(r"(?<!!)\[([^\]]*)\]\(([^)\s]*)\)", link, line)


def main():
    page = pathlib.Path(sys.argv[1]).resolve()
    fenced = False
    for line in page.read_text().split("\n"):
        if line.startswith("```"):
            fenced = not fenced
            # Doxygen takes all that stands there for the name of a language.
            print(line.partition(" ")[0])
        elif fenced:
            print(line)
        elif match := re.match(r"(#{1,6}) (.*)", line):
            name = page_label(page) if len(match[1]) == 1 else label(page, match[2])
            print(f"{match[1]} {match[2]} {{#{name}}}")
        else:
            print(without_links_of_github(line, page))


if __name__ == "__main__":
    main()
