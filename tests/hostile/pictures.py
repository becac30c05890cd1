"""Colour images: damaged, lying about their size, or of another size than depth."""

import struct
import zlib

import base
import raster
from case import RECONSTRUCT, Case

W, H = base.WIDTH, base.HEIGHT
PNG, BMP = raster.colour_png(W, H), raster.bmp(W, H)


def _webp(width, height, data=b""):
    body = b"VP8X" + struct.pack("<I", 10) + b"\0\0\0\0" + struct.pack("<I", width - 1)[:3] + struct.pack("<I",
        height - 1)[:3] + data
    return b"RIFF" + struct.pack("<I", len(body) + 4) + b"WEBP" + body


DAMAGED = {
    "empty.png": b"", "text.png": b"picture", "half.png": PNG[:len(PNG) // 2],
    "no-data.png": raster.PNG_SIGNATURE + raster.png_header(W, H, 8, 2) + raster.chunk(b"IEND", b""),
    "garbage-data.png": raster.PNG_SIGNATURE + raster.png_header(W, H, 8, 2) + raster.chunk(b"IDAT", b"\xff" * 50)
    + raster.chunk(b"IEND", b""),
    "huge.png": raster.PNG_SIGNATURE + raster.png_header(60000, 60000, 8, 2) + raster.chunk(b"IDAT",
    zlib.compress(b"")) + raster.chunk(b"IEND", b""),
    "other-size.png": raster.colour_png(32, 24), "width-0.png": raster.PNG_SIGNATURE + raster.png_header(0, 0, 8, 2)
    + raster.chunk(b"IEND", b""),
    "header-only.jpg": raster.jpeg_header_only(W, H), "no-frame.jpg": b"\xff\xd8\xff\xd9",
    "cut-off.jpg": raster.jpeg_header_only(W, H)[:30],
    "huge.jpg": raster.jpeg_header_only(65535, 65535) + b"\xff\xd9",
    "no-scan.jpg": raster.jpeg_header_only(W, H) + b"\xff\xd9", "segment-of-0.jpg": b"\xff\xd8\xff\xe0\0\0\xff\xd9",
    "cut-off.bmp": BMP[:100], "header-only.bmp": BMP[:54],
    "huge.bmp": BMP[:18] + struct.pack("<ii", 1 << 30, 1 << 30) + BMP[26:],
    "negative.bmp": BMP[:18] + struct.pack("<i", -W) + BMP[22:],
    "compression.bmp": BMP[:30] + struct.pack("<I", 99) + BMP[34:],
    "data-far-away.bmp": BMP[:10] + struct.pack("<I", 0x7FFFFFFF) + BMP[14:],
    "header-only.webp": _webp(W, H), "cut-off.webp": _webp(W, H)[:20],
    "garbage.webp": _webp(W, H, b"VP8 \x10\0\0\0" + b"\xff" * 16), "huge.webp": _webp(1 << 24, 1 << 24),
    "cut-off.tif": raster.tiff(W, H, b"\0" * 100, bits=8),
    "floats.tif": raster.tiff(W, H, b"\0" * 4 * W * H, bits=32, sample_format=3),
    "huge.tif": raster.tiff(1 << 20, 1 << 20, b"\0" * 100, bits=8),
    "a-gif.png": b"GIF89a" + b"\0" * 50, "pointer.png": b"version https://git-lfs.github.com/spec/v1\noid sha256:"
    + b"0" * 64 + b"\nsize 1\n",
}
ARGUMENTS = RECONSTRUCT + ["--cameras", "dataset"]


def cases():
    for name, content in DAMAGED.items():
        stem, ending = name.split(".")
        file = "000000." + ending
        yield Case(f"picture/{ending} {stem}", ARGUMENTS, 3, (file,),
            {"scene/rgb/000000.png": None, "scene/rgb/" + file: content})
    yield Case("picture/bmp", ARGUMENTS, 0, (), {"scene/rgb/000000.png": None, "scene/rgb/000000.BMP": BMP})
    yield Case("picture/grey", ARGUMENTS, 0, (), {"scene/rgb/000000.png": raster.png(W, H, 8, 0, [b"\x50" * W] * H)})
