"""scene_camera.json: damaged JSON, and cameras that are none."""

import os

import base
from case import PLAN, REMOVED, Case, changed, text_of

FILE = "scene/scene_camera.json"
VALID = text_of(base.CAMERAS)

DAMAGED = {
    "empty": ("", "empty"), "blank": ("  \n", "empty"), "list": ("[]", "object"), "no image": ("{}", "object"),
    "null": ("null", "object"), "text": ('"0"', "object"), "cut off": (VALID[:200], "JSON"),
    "cut at the end": (VALID[:-1], "JSON"),
    "more behind": (VALID + "}", "JSON"), "two of them": (VALID + VALID, "JSON"),
    "a comment": ("// cameras\n" + VALID, "JSON"),
    "a comma too many": (VALID[:-2] + ",}", "JSON"), "NaN": (VALID.replace("490.15303732609885", "NaN"), "JSON"),
    "Infinity": (VALID.replace("490.15303732609885", "Infinity"), "JSON"),
    "1e999": (VALID.replace("490.15303732609885", "1e999"), "1e999"),
    "hexadecimal": (VALID.replace("0.1,", "0x1,", 1), "JSON"), "single quotes": (VALID.replace('"', "'"), "JSON"),
    "deep lists": ("[" * 200000, "64 levels"), "deep objects": ('{"a":' * 100000, "64 levels"),
    "a key twice": ('{"0": {}, "0": {}}', "twice"), "an inner key twice": ('{"0": {"cam_K": [], "cam_K": []}}',
    "twice"),
    "invalid UTF-8": (VALID.encode().replace(b"cam_K", b"cam_\xff", 1), "scene_camera.json"),
    "an escape": ('{"\\x": 1}', "JSON"), "half a surrogate": ('{"\\ud800": 1}', "JSON"), "NUL": (b"\0" * 50, "JSON"),
    "many values": ("[" + "1," * 2500000 + "1]", "2000000"), "65 MiB": (" " * (65 << 20) + "{}", "67108864"),
    "a long key": ('{"' + "k" * 100000 + '": {}}', "1024"),
}

K = "0/cam_K"
WRONG = [
    (K, REMOVED, "cam_K"), (K, None, "cam_K"), (K, [], "cam_K"), (K, base.K[:8], "9"), (K, base.K + [0], "cam_K"),
    (K, "K", "cam_K"),
    (K, [[52, 0, 31.5], [0, 52, 23.5], [0, 0, 2]], "cam_K"), (K, ["52"] + base.K[1:], "cam_K"), (K, [0] * 9, "cam_K"),
    (K, [-52] + base.K[1:], "-52"), (K, [52, 1] + base.K[2:], "skew"), (K, [1e300] + base.K[1:], "cam_K"),
    (K, [1e-300] + base.K[1:], "cam_K"),
    (K, [52, 0, 1e300] + base.K[3:], "cam_K"), (K, [True] + base.K[1:], "cam_K"), (K, {"fx": 52}, "cam_K"),
    (K, [520, 0, 315, 0, 520, 235, 0, 0, 1], "scale cam_K"),
    ("0/depth_scale", REMOVED, "depth_scale"), ("0/depth_scale", 0, "depth_scale"),
    ("0/depth_scale", -1, "depth_scale"),
    ("0/depth_scale", "0.1", "depth_scale"), ("0/depth_scale", None, "depth_scale"),
    ("0/depth_scale", [0.1], "depth_scale"),
    ("0/cam_R_w2c", REMOVED, "cam_R_w2c"), ("0/cam_R_w2c", [0] * 9, "cam_R_w2c"),
    ("0/cam_R_w2c", [1, 0, 0, 0, 1, 0, 0, 0, -1], "reflection"),
    ("0/cam_R_w2c", [2, 0, 0, 0, 2, 0, 0, 0, 2], "rotation"),
    ("0/cam_R_w2c", [1, 0, 0], "cam_R_w2c"), ("0/cam_R_w2c", ["a"] * 9, "cam_R_w2c"),
    ("0/cam_R_w2c", [1e200] * 9, "cam_R_w2c"),
    ("0/cam_t_w2c", REMOVED, "cam_t_w2c"), ("0/cam_t_w2c", [1, 2], "cam_t_w2c"),
    ("0/cam_t_w2c", [1e300, 0, 0], "cam_t_w2c"),
    ("0/cam_t_w2c", None, "cam_t_w2c"), ("0/width", 63, "height"), ("0/width", -1, "width"),
    ("0/width", "64", "width"),
    ("0/height", 48, "width"), ("0", None, "object"), ("0", [], "object"), ("0", 1, "object"),
    ("-1", base.CAMERAS["0"], "-1"),
    ("a", base.CAMERAS["0"], "a"), ("1e3", base.CAMERAS["0"], "1e3"),
    ("99999999999", base.CAMERAS["0"], "99999999999"),
    ("00", base.CAMERAS["0"], "twice"), ("", base.CAMERAS["0"], "id"), ("2000000", base.CAMERAS["0"], "999999"),
    ("7", base.CAMERAS["0"], "000007"), ("0\n", base.CAMERAS["0"], "id"), (" 0", base.CAMERAS["0"], "id"),
]

# Whatever is said, it is said, and the plan is made all the same.
ODD = [("0/depth_scale", 1e308, "reading"), ("0/depth_scale", 1000, "depth_scale"),
    ("0/depth_scale", 1e-6, "depth_scale"), ("0/cam_t_w2c", [0, 0, 1e6], "image"),
       ("0/cam_t_w2c", [0, 0.0474, 0.49], "")]


def _fifo(folder):
    (folder / FILE).unlink()
    os.mkfifo(folder / FILE)


def _no_scene(folder):
    (folder / "scene").rename(folder / "away")


def cases():
    for name, (content, word) in DAMAGED.items():
        yield Case("scene_camera/" + name, PLAN, 3, ("scene_camera.json", word), {FILE: content})
    for i, (path, value, word) in enumerate(WRONG):
        shown = "removed" if value is REMOVED else text_of(value).replace("\n", "")[:30]
        yield Case(f"scene_camera/{i} {path.replace('/', '.').strip()} {shown}", PLAN, 3, (word,),
                   {FILE: text_of(changed(base.CAMERAS, path, value))})
    for i, (path, value, word) in enumerate(ODD):
        yield Case(f"scene_camera/odd {i} {path.replace('/', '.')}", PLAN, (0, 4), ("warning", word),
                   {FILE: text_of(changed(base.CAMERAS, path, value))})
    yield Case("scene_camera/missing", PLAN, 3, ("scene_camera.json",), {FILE: None})
    yield Case("scene_camera/a FIFO", PLAN, 3, ("scene_camera.json",), prepare=_fifo)
    yield Case("scene_camera/no folder", PLAN, 3, ("scene",), prepare=_no_scene)
