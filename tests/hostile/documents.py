"""YAML that is damaged, endless, too deep or too large, in place of a workcell."""

import os

import base
from case import PLAN, Case, text_of

VALID = text_of(base.CELL)
AREA = "work_area: {min_m: [-0.12, -0.1, 0], max_m: [0.12, 0.1, 0.1]}\n"


def _laughs(levels):
    text = "a0: &a0 [x, x, x, x, x, x, x, x, x]\n"
    for i in range(1, levels):
        text += f"a{i}: &a{i} [" + ", ".join([f"*a{i - 1}"] * 9) + "]\n"
    return text


def _fifo(folder):
    (folder / "cell.yaml").unlink()
    os.mkfifo(folder / "cell.yaml")


def _folder(folder):
    (folder / "cell.yaml").unlink()
    (folder / "cell.yaml").mkdir()


def _loop(folder):
    (folder / "cell.yaml").unlink()
    (folder / "cell.yaml").symlink_to("cell.yaml")


DAMAGED = {
    "empty": ("", "empty"), "blank": (" \n\n\t\n", "YAML"), "comment only": ("# nothing\n", "empty"),
    "byte order mark only": (b"\xef\xbb\xbf", "empty"), "null": ("null\n", "empty"),
    "number": ("5\n", "5"), "text": ("hello\n", "hello"), "list": ("[1, 2]\n", "expected"),
    "stray comma": ("{},", "YAML"), "comma": (AREA + "voxel_size_m: {,}\n", "YAML"),
    "NUL bytes": (b"\0" * 100, "YAML"), "NUL inside": (AREA.encode() + b"voxel_size_m: 0.0\x001\n", "YAML"),
    "control characters": (AREA.encode() + b"\x1b[31m: 1\n", "YAML"),
    "Latin 1": (AREA.encode() + b"# caf\xe9\nvoxel_size_m: 0.02\n", "UTF-8"),
    "surrogates": (AREA.encode() + b"x: \xed\xa0\x80\n", "UTF-8"),
    "overlong UTF-8": (AREA.encode() + b"x: \xc0\x80\n", "UTF-8"),
    "half of UTF-16": ("work_area: 1".encode("utf-16-le"), "YAML"),
    "UTF-16 cut off": (b"\xff\xfe" + AREA.encode("utf-16-le")[:-1], "YAML"),
    "tabs": ("work_area:\n\tmin_m: [0, 0, 0]\n", "YAML"), "open quote": (AREA + 'board: "board.yaml\n', "YAML"),
    "open list": ("work_area: {min_m: [-0.12, -0.1", "YAML"), "open map": ("{work_area: ", "YAML"),
    "closed twice": (AREA.replace("}", "}}"), "YAML"), "colon in a text": ("work_area: a: b\n", "YAML"),
    "bad indentation": ("work_area:\n   min_m: [0, 0, 0]\n  max_m: [1, 1, 1]\n", "YAML"),
    "deep lists": (AREA + "x: " + "[" * 100000, "64 levels"),
    "deep maps": (AREA + "x: " + "{a: " * 50000, "64 levels"),
    "deep blocks": ("".join(" " * i + "a:\n" for i in range(1500)), "64 levels"),
    "deep dashes": ("- " * 20000, "64 levels"),
    "many values": (AREA + "x: [" + "1," * 1500000 + "]", "1000000"),
    "many commas": ("[" + "," * 100000, "YAML"), "billion laughs": (_laughs(12) + AREA, "values"),
    "alias of nothing": (AREA + "board: *nobody\n", "nobody"), "alias of itself": (AREA + "x: &x [*x]\n", "x"),
    "alias as a key": ("&a work_area: {*a : 1}\n", "anchor"), "merge of a text": (AREA + "<<: board\n", "<<"),
    "a key twice": (AREA + AREA, "twice"), "a list as a key": (AREA + "[1, 2]: 3\n", "key"),
    "a map as a key": (AREA + "? {a: 1}\n: 3\n", "key"), "a long key": (AREA + "k" * 5000 + ": 1\n", "YAML"),
    "a second document": (AREA + "---\n" + AREA, "second document"),
    "a foreign tag": (AREA + "board: !!python/object/apply:os.system [ls]\n", "tag"),
    "an integer that is none": (AREA + "voxel_size_m: !!int abc\n", "abc"),
    "a number out of range": (AREA + "voxel_size_m: 1e99999\n", "out of range"),
    "a long number": (AREA + "voxel_size_m: " + "9" * 100000 + "\n", "out of range"),
    "a long text": (AREA + "board: " + "b" * 3000000 + "\n", "bbb"),
    "a later YAML": ("%YAML 3.0\n---\n" + AREA, "YAML"), "a directive only": ("%YAML 1.2\n", "YAML"),
    "an open anchor": ("work_area: &\n", "YAML"), "XML": ("<work_area/>", "work_area"),
    "a PNG": (b"\x89PNG\r\n\x1a\n" + bytes(range(256)), "YAML"), "an escape": (AREA + 'board: "\\q"\n', "YAML"),
    "an escape cut off": (AREA + 'board: "\\u12', "YAML"), "a pointer of Git LFS":
    ("version https://git-lfs.github.com/spec/v1\noid sha256:" + "0" * 64 + "\nsize 12345\n", "git lfs pull"),
    "17 MiB": ("#" * (17 << 20), "16777216"),
}

# Odd, and right all the same.
READ = {"CR line ends": AREA.replace("\n", "\r").encode(), "CRLF line ends": VALID.replace("\n", "\r\n").encode(),
        "UTF-16": VALID.encode("utf-16"), "a byte order mark": b"\xef\xbb\xbf" + VALID.encode(),
        "a merge key": ("base: &b {min_m: [-0.12, -0.1, 0]}\n" + "work_area: {<<: *b, max_m: [0.12, 0.1, 0.1]}\n")
        .replace("base: &b", "work_area_: &b").encode()}


def cases():
    for name, (content, word) in DAMAGED.items():
        yield Case("document/" + name, PLAN, 3, ("cell.yaml", word), {"cell.yaml": content})
    for name in ("CRLF line ends", "UTF-16", "a byte order mark"):
        yield Case("document/" + name, PLAN, 0, (), {"cell.yaml": READ[name]})
    yield Case("document/CR line ends", PLAN + ["--voxel-size", "0.02"], 0, (), {"cell.yaml": READ["CR line ends"]})
    yield Case("document/an unknown key", PLAN, 3, ("cell.yaml:1", "work_area_", "work_area"),
               {"cell.yaml": READ["a merge key"]})
    yield Case("document/missing", PLAN, 3, ("cell.yaml",), {"cell.yaml": None})
    yield Case("document/a FIFO", PLAN, 3, ("cell.yaml", "regular file"), prepare=_fifo)
    yield Case("document/a folder", PLAN, 3, ("cell.yaml",), prepare=_folder)
    yield Case("document/a link to itself", PLAN, 3, ("cell.yaml",), prepare=_loop)
