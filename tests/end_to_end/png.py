# SPDX-License-Identifier: BSD-3-Clause
"""Reads the PNG files that browsers write."""

import struct
import zlib

SIGNATURE = b"\x89PNG\r\n\x1a\n"
CHANNELS = {2: 3, 6: 4}  # of the colour types: RGB, RGBA


class Picture:
    """`width`, `height` and the colours of the pixels."""

    def __init__(self, content):
        if not content.startswith(SIGNATURE):
            raise ValueError("no PNG")
        chunks = list(self.chunks(content))
        self.width, self.height, depth, colour_type, _, _, interlaced = struct.unpack(">IIBBBBB", chunks[0][1])
        if depth != 8 or colour_type not in CHANNELS or interlaced:
            raise ValueError("a kind of PNG that browsers do not write")
        self.channels = CHANNELS[colour_type]
        data = zlib.decompress(b"".join(content for kind, content in chunks if kind == b"IDAT"))
        stride = self.width * self.channels
        if len(data) != self.height * (stride + 1):
            raise ValueError("the PNG has not the pixels that it promises")
        self.rows = []
        above = bytes(stride)
        for begin in range(0, len(data), stride + 1):
            above = self.unfiltered(data[begin], bytearray(data[begin + 1:begin + 1 + stride]), above)
            self.rows.append(above)

    @staticmethod
    def chunks(content):
        place = len(SIGNATURE)
        while place < len(content):
            size, kind = struct.unpack_from(">I4s", content, place)
            yield kind, content[place + 8:place + 8 + size]
            place += size + 12

    def unfiltered(self, filter_type, row, above):
        """See the PNG specification, "Filtering"."""
        step = self.channels
        if filter_type == 0:
            return row
        for i in range(len(row)):
            a = row[i - step] if i >= step else 0
            b = above[i]
            if filter_type == 1:
                predicted = a
            elif filter_type == 2:
                predicted = b
            elif filter_type == 3:
                predicted = (a + b) // 2
            else:
                c = above[i - step] if i >= step else 0
                to_a, to_b, to_c = abs(b - c), abs(a - c), abs(a + b - 2 * c)
                predicted = a if to_a <= to_b and to_a <= to_c else b if to_b <= to_c else c
            row[i] = (row[i] + predicted) & 255
        return row

    def colour(self, x, y):
        """(red, green, blue), 0 to 255."""
        return tuple(self.rows[y][x * self.channels:x * self.channels + 3])
