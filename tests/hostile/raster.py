"""Images of all formats that vantage reads, written byte by byte, so that each can be damaged."""

import struct
import zlib

PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"


def chunk(kind, data, checksum=None):
    checksum = zlib.crc32(kind + data) if checksum is None else checksum
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", checksum)


def png_header(width, height, bits=16, colour=0, interlace=0):
    return chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, bits, colour, 0, 0, interlace))


def png(width, height, bits, colour, rows, interlace=0):
    """`rows` are the bytes of the scan lines, without their filters."""
    data = b"".join(b"\0" + row for row in rows)
    return (PNG_SIGNATURE + png_header(width, height, bits, colour, interlace)
            + chunk(b"IDAT", zlib.compress(data, 1)) + chunk(b"IEND", b""))


def depth_png(width, height, count):
    """`count` is a number, or a function of x and y."""
    at = count if callable(count) else lambda x, y: count
    return png(width, height, 16, 0,
               [struct.pack(f">{width}H", *(at(x, y) for x in range(width))) for y in range(height)])


def colour_png(width, height, shade=90):
    return png(width, height, 8, 2, [bytes([shade, shade, shade]) * width] * height)


def bmp(width, height):
    stride = (3 * width + 3) // 4 * 4
    size = 54 + stride * height
    return (b"BM" + struct.pack("<IHHI", size, 0, 0, 54)
            + struct.pack("<IiiHHIIiiII", 40, width, height, 1, 24, 0, stride * height, 2835, 2835, 0, 0)
            + b"\x5a" * (stride * height))


def tiff(width, height, data, bits=16, sample_format=1, tags=None, order="<"):
    """One strip. `tags` replaces or adds entries: tag: (type, count, value); None takes one away."""
    entries = {256: (4, 1, width), 257: (4, 1, height), 258: (3, 1, bits), 259: (3, 1, 1), 262: (3, 1, 1),
               273: (4, 1, 8), 277: (3, 1, 1), 278: (4, 1, height), 279: (4, 1, len(data)),
               339: (3, 1, sample_format)}
    entries.update(tags or {})
    entries = {tag: entry for tag, entry in sorted(entries.items()) if entry is not None}
    directory = struct.pack(order + "H", len(entries))
    for tag, (kind, count, value) in entries.items():
        packed = struct.pack(order + ("HH" if kind == 3 else "I"), *((value, 0) if kind == 3 else (value,)))
        directory += struct.pack(order + "HHI", tag, kind, count) + packed
    mark = b"II" if order == "<" else b"MM"
    return mark + struct.pack(order + "HI", 42, 8 + len(data)) + data + directory + struct.pack(order + "I", 0)


def depth_tiff(width, height, count):
    return tiff(width, height, struct.pack("<H", count) * (width * height))


def npy(descr, shape, data, fortran=False, version=1, header=None):
    text = header or f"{{'descr': '{descr}', 'fortran_order': {fortran}, 'shape': {shape}, }}"
    text = text.encode() if isinstance(text, str) else text
    text += b" " * (-(len(text) + 11) % 16) + b"\n"
    return b"\x93NUMPY" + bytes([version, 0]) + struct.pack("<H", len(text)) + text + data


def jpeg_header_only(width, height):
    """Up to the start of the frame: enough to be asked how large it is."""
    return (b"\xff\xd8\xff\xe0\x00\x10JFIF\0\x01\x01\0\0\x01\0\x01\0\0"
            + b"\xff\xc0\x00\x11\x08" + struct.pack(">HH", height, width)
            + b"\x03\x01\x11\x00\x02\x11\x01\x03\x11\x01")
