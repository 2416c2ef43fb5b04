# SPDX-License-Identifier: BSD-3-Clause
"""The program on a pseudo-terminal: what it writes there, and how wide that is."""

import fcntl
import os
import pty
import struct
import subprocess
import termios
import unicodedata

import tool

ERASE = "\r\x1b[K"


def width(text):
    """Columns that a text takes: wide characters two, combining ones none."""
    return sum(0 if unicodedata.combining(c) else 2 if unicodedata.east_asian_width(c) in "WF" else 1 for c in text)


class Screen:
    """A terminal of that many columns with the program on it, its results and its messages alike."""

    def __init__(self, test, columns, *arguments):
        self.end, terminal = pty.openpty()
        self.resize(columns)
        self.text = ""
        # Line feeds are to come as they are written.
        modes = termios.tcgetattr(terminal)
        modes[1] &= ~termios.OPOST
        termios.tcsetattr(terminal, termios.TCSANOW, modes)
        self.process = subprocess.Popen([tool.program, *map(str, arguments)], cwd=test.folder,
                                        stdin=subprocess.DEVNULL, stdout=terminal, stderr=terminal)
        os.close(terminal)
        for action in (lambda: os.close(self.end), self.process.wait, self.process.kill):
            test.addCleanup(action)

    def resize(self, columns):
        fcntl.ioctl(self.end, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))

    def wait_for(self, words):
        """Until the program has written this since the last call, or has ended; returns what it has written."""
        text = b""
        while words is None or words.encode() not in text:
            try:
                more = os.read(self.end, 4096)
            except OSError:  # Linux says so where the program has closed it
                break
            if not more:
                break
            text += more
        self.text += text.decode()
        return text.decode()

    def finish(self):
        """Until the program has ended; returns its exit code."""
        self.wait_for(None)
        return self.process.wait()

    def progress(self):
        """The lines that were drawn and erased again."""
        return [part for line in self.text.split("\n") for part in line.split(ERASE)[:-1] if part]

    def lines(self):
        """What stays on the terminal."""
        return [line.split(ERASE)[-1] for line in self.text.split("\n")]
