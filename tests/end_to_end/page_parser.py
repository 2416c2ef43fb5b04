# SPDX-License-Identifier: BSD-3-Clause
"""What HTML pages must be: tags closed in their order, nothing from outside."""

import html.parser


class PageParser(html.parser.HTMLParser):
    """Checks that tags are closed in their order."""

    VOID = {"meta", "link", "br", "hr", "img", "input", "col"}

    def __init__(self):
        super().__init__()
        self.open = []
        self.mistakes = []
        self.outside = []
        self.text = ""

    def handle_starttag(self, tag, attrs):
        if tag not in self.VOID:
            self.open.append(tag)
        self.handle_startendtag(tag, attrs)

    def handle_startendtag(self, tag, attrs):
        self.outside += [value for key, value in attrs if key in ("src", "href") and not (value or "#").startswith("#")]

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.mistakes.append((tag, self.getpos()))

    def handle_data(self, data):
        self.text += data
