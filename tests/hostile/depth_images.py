"""Depth images of all formats: damaged, lying about their size, or of something else than depth."""

import os
import struct
import zlib

import base
import raster
from case import PLAN, Case

W, H = base.WIDTH, base.HEIGHT
PNG = raster.depth_png(W, H, base.depth_count)
ROWS = [struct.pack(f">{W}H", *([5000] * W)) for _ in range(H)]
IDAT = zlib.compress(b"".join(b"\0" + row for row in ROWS), 1)


def _png(*chunks):
    return raster.PNG_SIGNATURE + b"".join(chunks)


def _bomb(width, height):
    """Says that it is large, and is: zeros shrink to a thousandth."""
    data = zlib.compressobj(9)
    line = b"\0" * (2 * width + 1)
    packed = b"".join(data.compress(line) for _ in range(height)) + data.flush()
    return _png(raster.png_header(width, height), raster.chunk(b"IDAT", packed), raster.chunk(b"IEND", b""))


END = raster.chunk(b"IEND", b"")
HEADER = raster.png_header(W, H)

DAMAGED_PNG = {
    "empty": (b"", "000000.png"), "text": (b"depth", "PNG"), "signature only": (raster.PNG_SIGNATURE, "000000.png"),
    "header only": (_png(HEADER), "000000.png"), "half": (PNG[:len(PNG) // 2], "000000.png"),
    "without its end": (PNG[:-12], "000000.png"),
    "a byte short": (PNG[:-1], "000000.png"), "a wrong checksum": (PNG[:20] + b"\1" + PNG[21:], "000000.png"),
    "data damaged": (PNG[:60] + b"\xff" * 20 + PNG[80:], "000000.png"), "no data": (_png(HEADER, END), "000000.png"),
    "too little data": (_png(HEADER, raster.chunk(b"IDAT", zlib.compress(b"\0" * 100)), END), "000000.png"),
    "a wrong filter": (_png(HEADER, raster.chunk(b"IDAT", zlib.compress(b"".join(b"\x09" + r for r in ROWS))), END),
    "000000.png"),
    "8 bits": (raster.png(W, H, 8, 0, [b"\x50" * W] * H), "16"),
    "1 bit": (raster.png(W, H, 1, 0, [b"\x55" * (W // 8)] * H), "16"),
    "colour": (raster.colour_png(W, H), "16"), "colour of 16 bits": (raster.png(W, H, 16, 2,
    [b"\x10\0" * 3 * W] * H), "grey"),
    "grey with alpha": (raster.png(W, H, 16, 4, [b"\x10\0\xff\xff" * W] * H), "grey"),
    "colours of a table": (_png(raster.png_header(W, H, 8, 3), raster.chunk(b"PLTE", b"\0\1\2"),
                                raster.chunk(b"IDAT", zlib.compress(b"\0" * (H * (W + 1)))), END), "16"),
    "a table missing": (_png(raster.png_header(W, H, 8, 3), raster.chunk(b"IDAT", IDAT), END), "000000.png"),
    "width 0": (_png(raster.png_header(0, H), raster.chunk(b"IDAT", IDAT), END), "000000.png"),
    "width 2^31": (_png(raster.png_header(1 << 31, H), raster.chunk(b"IDAT", IDAT), END), "000000.png"),
    "width 4294967295": (_png(raster.png_header(0xFFFFFFFF, 0xFFFFFFFF), raster.chunk(b"IDAT", IDAT), END),
    "000000.png"),
    "16384 x 16384 with little in it": (_png(raster.png_header(16384, 16384), raster.chunk(b"IDAT", IDAT), END),
    "000000.png"),
    "30000 x 10": (_png(raster.png_header(30000, 10), raster.chunk(b"IDAT", IDAT), END), "000000.png"),
    "a bomb of 8000 x 8000": (_bomb(8000, 8000), "000000.png"),
    "3 bits": (_png(raster.png_header(W, H, 3), raster.chunk(b"IDAT", IDAT), END), "000000.png"),
    "colour type 5": (_png(raster.png_header(W, H, 16, 5), raster.chunk(b"IDAT", IDAT), END), "000000.png"),
    "interlaced wrongly": (_png(raster.png_header(W, H, 16, 0, 7), raster.chunk(b"IDAT", IDAT), END), "000000.png"),
    "two headers": (_png(HEADER, HEADER, raster.chunk(b"IDAT", IDAT), END), "000000.png"),
    "a long chunk": (raster.PNG_SIGNATURE + HEADER + struct.pack(">I", 0x7FFFFFFF) + b"IDAT" + IDAT, "000000.png"),
    "a JPEG": (raster.jpeg_header_only(W, H), "PNG"), "another size": (raster.depth_png(W // 2, H // 2, 5000),
    "of one size"),
    "one pixel": (raster.depth_png(1, 1, 5000), "1"), "a pointer of Git LFS":
    (b"version https://git-lfs.github.com/spec/v1\noid sha256:" + b"0" * 64 + b"\nsize 12345\n", "git lfs pull"),
}
ODD_PNG = {"all zero": (raster.depth_png(W, H, 0), "reading"), "all 65535": (raster.depth_png(W, H, 65535), "65535"),
           "whole metres": (raster.depth_png(W, H, 1), ""), "bytes behind the end": (PNG + b"more", "")}

DATA = struct.pack("<H", 5000) * (W * H)
FLOATS = struct.pack("<f", 500.0) * (W * H)


def _tags(**tags):
    return {int(tag[1:]): entry for tag, entry in tags.items()}


DAMAGED_TIFF = {
    "cut off": raster.depth_tiff(W, H, 5000)[:-20], "header only": b"II*\0\x08\0\0\0", "text": b"II*\0",
    "directory far away": b"II*\0\xff\xff\xff\xff",
    "data cut off": raster.tiff(W, H, DATA[:100], tags=_tags(t279=(4, 1, len(DATA)))),
    "strip far away": raster.tiff(W, H, DATA, tags=_tags(t273=(4, 1, 1 << 31))),
    "no width": raster.tiff(W, H, DATA, tags=_tags(t256=None)), "width 0": raster.tiff(0, H, DATA),
    "width 2^32-1": raster.tiff(0xFFFFFFFF, 0xFFFFFFFF, DATA),
    "16384 x 16384": raster.tiff(16384, 16384, DATA), "8 bits": raster.tiff(W, H, DATA, bits=8),
    "64 bits": raster.tiff(W, H, DATA * 4, bits=64, sample_format=3),
    "three channels": raster.tiff(W, H, DATA * 3, tags=_tags(t277=(3, 1, 3), t262=(3, 1, 2))),
    "compression 9999": raster.tiff(W, H, DATA, tags=_tags(t259=(3, 1, 9999))),
    "LZW that is none": raster.tiff(W, H, DATA, tags=_tags(t259=(3, 1, 5))),
    "65535 entries": b"II*\0\x08\0\0\0\xff\xff" + b"\0" * 100,
    "complex numbers": raster.tiff(W, H, FLOATS, bits=32, sample_format=6),
    "negative": raster.tiff(W, H, struct.pack("<h", -5) * (W * H), sample_format=2),
}
ODD_TIFF = {"floats that are none": raster.tiff(W, H, struct.pack("<f", float("nan")) * (W * H), bits=32,
    sample_format=3),
            "infinite floats": raster.tiff(W, H, struct.pack("<f", float("inf")) * (W * H), bits=32, sample_format=3)}
READ_TIFF = {"floats": raster.tiff(W, H, b"".join(struct.pack("<f", base.depth_count(x, y)) for y in range(H)
    for x in range(W)), bits=32, sample_format=3),
             "big-endian": raster.tiff(W, H, b"".join(struct.pack(">H", base.depth_count(x, y)) for y in range(H)
             for x in range(W)), order=">")}

COUNTS = [base.depth_count(x, y) for y in range(H) for x in range(W)]
U16 = struct.pack(f"<{W * H}H", *COUNTS)
DAMAGED_NPY = {
    "empty": b"", "magic only": b"\x93NUMPY", "cut off": raster.npy("<u2", (H, W), U16)[:-1],
    "more behind": raster.npy("<u2", (H, W), U16 + b"\0"),
    "pickled": raster.npy("|O", (H, W), b"cos\nsystem\n(S'ls'\ntR."), "text": raster.npy("<U2", (H, W), U16),
    "three axes": raster.npy("<u2", (1, H, W), U16),
    "one axis": raster.npy("<u2", (H * W,), U16).replace(b"(3072,)", b"(3072,)"),
    "no axis": raster.npy("<u2", (), b"\0\0"), "size 0": raster.npy("<u2", (0, 0), b""),
    "huge": raster.npy("<u2", (2**40, 2**40), U16), "negative": raster.npy("<u2", (-H, -W), U16),
    "structured": raster.npy("", (H, W), U16,
    header="{'descr': [('z', '<u2')], 'fortran_order': False, 'shape': (48, 64), }"),
    "header of code": raster.npy("", (H, W), U16, header="__import__('os').system('ls')"),
    "header endless": b"\x93NUMPY\1\0\xff\xff{'descr'",
    "format 9": raster.npy("<u2", (H, W), U16, version=9), "8 bits": raster.npy("|u1", (H, W), bytes(W * H)),
    "other size": raster.npy("<u2", (W, H), U16),
    "negative depths": raster.npy("<f4", (H, W), struct.pack("<f", -5) * (W * H)),
}
EXR_MAGIC = b"\x76\x2f\x31\x01"


def _exr(attributes):
    text = b"".join(name + b"\0" + kind + b"\0" + struct.pack("<I", len(value)) + value for name, kind,
        value in attributes)
    return EXR_MAGIC + struct.pack("<I", 2) + text + b"\0"


def _exr_header(width, height, channel=b"Z"):
    window = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    return _exr([(b"channels", b"chlist", channel + b"\0" + struct.pack("<iBBBBii", 2, 0, 0, 0, 0, 1, 1) + b"\0"),
        (b"compression", b"compression", b"\0"),
                 (b"dataWindow", b"box2i", window), (b"displayWindow", b"box2i", window),
                 (b"lineOrder", b"lineOrder", b"\0"),
                 (b"pixelAspectRatio", b"float", struct.pack("<f", 1)),
                 (b"screenWindowCenter", b"v2f", struct.pack("<ff", 0, 0)),
                 (b"screenWindowWidth", b"float", struct.pack("<f", 1))])


DAMAGED_EXR = {"empty": b"", "magic only": EXR_MAGIC, "text": b"EXR", "header only": _exr_header(W, H),
    "offsets far away": _exr_header(W, H) + b"\xff" * 8 * H,
               "offsets of 0": _exr_header(W, H) + b"\0" * 8 * H,
               "huge": _exr_header(1 << 30, 1 << 30) + b"\0" * 800,
               "16384 x 16384": _exr_header(16384, 16384) + b"\0" * 800,
               "window turned": _exr_header(-5, -5) + b"\0" * 800,
               "no channels": _exr([(b"dataWindow", b"box2i", struct.pack("<iiii", 0, 0, W - 1, H - 1))]),
               "an attribute of 2 GiB": EXR_MAGIC + struct.pack("<I", 2) + b"channels\0chlist\0" + struct.pack("<I",
               0x7FFFFFFF), "a long name": EXR_MAGIC + struct.pack("<I", 2) + b"n" * 5000,
               "another channel": _exr_header(W, H, b"velocity") + b"\0" * 8 * H,
               "many parts": EXR_MAGIC + struct.pack("<I", 0x1802) + b"\0\0"}


def _only(name, content):
    """Of image 0; image 1 keeps its PNG."""
    return {"scene/depth/000000.png": None, "scene/depth/" + name: content}


def _replaced_by(make):
    def prepare(folder):
        (folder / "scene/depth/000000.png").unlink()
        make(folder / "scene/depth/000000.png")
    return prepare


def cases():
    for name, (content, word) in DAMAGED_PNG.items():
        yield Case("depth PNG/" + name, PLAN, 3, ("000000.png", word), {"scene/depth/000000.png": content})
    for name, (content, word) in ODD_PNG.items():
        yield Case("depth PNG/" + name, PLAN, (0, 4), ("warning" if word else "", word),
            {"scene/depth/000000.png": content})
    for kind, damaged in (("tif", DAMAGED_TIFF), ("npy", DAMAGED_NPY), ("exr", DAMAGED_EXR)):
        for name, content in damaged.items():
            yield Case(f"depth {kind}/{name}", PLAN, 3, (f"000000.{kind}",), _only(f"000000.{kind}", content))
    for name, content in ODD_TIFF.items():
        yield Case("depth tif/" + name, PLAN, (0, 4), ("warning", "no valid reading"), _only("000000.tif", content))
    for name, content in READ_TIFF.items():
        yield Case("depth tif/" + name, PLAN, 0, (), _only("000000.tif", content))
    yield Case("depth npy/uint16", PLAN, 0, (), _only("000000.npy", raster.npy("<u2", (H, W), U16)))
    yield Case("depth/a FIFO", PLAN, 3, ("000000.png",), prepare=_replaced_by(os.mkfifo))
    yield Case("depth/a folder", PLAN, 3, ("000000.png",), prepare=_replaced_by(lambda path: path.mkdir()))
    yield Case("depth/a link to nowhere", PLAN, 3, ("000000.png",),
        prepare=_replaced_by(lambda path: path.symlink_to("nowhere")))
    yield Case("depth/endless", PLAN, 3, ("000000.png",), prepare=_replaced_by(lambda path:
        path.symlink_to("/dev/zero")))
    yield Case("depth/missing", PLAN, 3, ("000000.png", "missing"), {"scene/depth/000000.png": None})
    yield Case("depth/two of one image", PLAN, (0, 3), (), {"scene/depth/000000.tif": raster.depth_tiff(W, H, 5000)})
