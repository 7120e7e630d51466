"""Makes the checkerboards of the scenes beside it. Needs nothing but Python 3.

A checkerboard of two colours is a picture of 2 x 2 texels that is repeated and not filtered: one repeat is 2 x 2
squares. 16 bits a channel hold the colours to 1e-5, and the scenes read them as linear.
"""
import pathlib
import struct
import zlib

HERE = pathlib.Path(__file__).parent


def png(name, rows):
    """16-bit RGB, row 0 on top."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    raw = b"".join(
        b"\0" + b"".join(struct.pack(">3H", *(round(65535 * c) for c in texel)) for texel in row) for row in rows)
    header = struct.pack(">2I5B", len(rows[0]), len(rows), 16, 2, 0, 0, 0)
    (HERE / name).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw, 9))
                              + chunk(b"IEND", b""))


def checker(name, first, second):
    """`first` is the square at u = v = 0, which is the lower left texel."""
    png(name, [[second, first], [first, second]])


def grey(value):
    return (value, value, value)


checker("checker_m_dielectric.png", (0.7, 0.3, 0.1), (0.1, 0.3, 0.5))
checker("checker_m_thinlens.png", (0.7, 0.2, 0.1), (0.1, 0.2, 0.3))
