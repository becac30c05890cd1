"""world.json, plan.json, reach maps and lists of views: files of vantage's and of NumPy's that come back changed."""

import json
import pathlib

import base
import raster
from case import PLAN, REMOVED, Case, changed, text_of

POSE = {"rotation": {"w": 1, "x": 0, "y": 0, "z": 0}, "translation_m": [0, 0, 0.5]}
CAMERA = {"image": 0, "T_world_cam": {"rotation": {"w": 0.58472, "x": -0.81124, "y": 0, "z": 0},
    "translation_m": [0, -0.45, 0.2]}}
WORLD = {"vantage": "0.1.0", "method": "pnp", "partial": False,
    "cameras": [{"image": i, "T_world_cam": {"rotation": {"w": 0, "x": 1, "y": 0, "z": 0},
    "translation_m": [0, 0, 0.6]}} for i in (0, 1)],
         "objects": [{"name": "red 1", "type": "red_cube",
         "T_world_object": {**POSE, "translation_m": [0, 0, 0.025]},
         "covariance": [[1e-8 if i == j else 0 for j in range(6)] for i in range(6)], "probability": 0.75}],
         "unexplained": []}

WORLDS = [
    ("vantage", REMOVED, "vantage"), ("cameras", REMOVED, "cameras"), ("cameras", [], "image 0"),
    ("cameras", {}, "cameras"), ("cameras/0/image", "0", "image"), ("cameras/0/image", 1, "twice"),
    ("cameras/0/image", 10**20, "image"), ("cameras/0/T_world_cam", REMOVED, "T_world_cam"),
    ("cameras/0/T_world_cam/rotation", {"w": 3, "x": 0, "y": 0, "z": 0}, "rotation"),
    ("cameras/0/T_world_cam/translation_m", [1e300, 0, 0], "camera"),
    ("cameras/0/T_world_cam/translation_m", [0, 0], "translation_m"), ("objects", None, "objects"),
    ("objects/0/name", REMOVED, "name"), ("objects/0/type", "green", "green"),
    ("objects/0/type", 5, "type"), ("objects/0/T_world_object/translation_m", [0, 0, 1e300], "red 1"),
    ("objects/0/covariance", [[0] * 6] * 5, "covariance"), ("objects/0/covariance/0/1", 5, "symmetric"),
    ("objects/0/covariance/0/0", -1, "covariance"), ("objects/0/probability", 2, "probability"),
    ("objects/0/probability", "sure", "probability"),
    ("objects/0/alternatives", [{"type": "red_cube"}], "alternatives"), ("objects", WORLD["objects"] * 2, "twice"),
]
WORLD_TEXTS = {"empty": "", "cut off": json.dumps(WORLD)[:300], "list": "[]", "plan": '{"best": null}',
    "deep": '{"a":' * 1000, "NaN": json.dumps(WORLD).replace("0.75", "NaN")}


def _view(**changes):
    return {"views": [{**{"eye_m": [0, -0.5, 0.5], "target_m": [0, 0, 0]}, **changes}]}


VIEWS = {"empty": ("", "empty"), "no views": ("{}", "views"), "a list of nothing": ('{"views": []}', "views"),
    "eye is target": (json.dumps(_view(eye_m=[0, 0, 0])), "target_m"),
    "eye 2D": (json.dumps(_view(eye_m=[0, 0])), "eye_m"), "eye far away": (json.dumps(_view(eye_m=[1e300, 0, 0])),
    "coordinates"),
         "both kinds": (json.dumps(_view(T_world_cam=POSE)), "views"),
         "rotation 0": (json.dumps({"views": [{"T_world_cam": {"rotation": {"w": 0, "x": 0, "y": 0, "z": 0},
         "translation_m": [0, 0, 0]}}]}), "rotation"), "a text": ('{"views": "all"}', "views"),
         "a key unknown": (json.dumps(_view(up=[0, 0, 1])), "up")}

U8 = b"\1" * 1000
MAPS = {"empty": b"", "text": b"yes", "cut off": raster.npy("|u1", (10, 10, 10), U8[:-1]),
    "more behind": raster.npy("|u1", (10, 10, 10), U8 + b"\1"), "two axes": raster.npy("|u1", (10, 100), U8),
    "floats": raster.npy("<f4", (10, 10, 10), U8 * 4), "Fortran": raster.npy("|u1", (10, 10, 10), U8, fortran=True),
        "a bool of 7": raster.npy("|b1", (10, 10, 10), b"\7" * 1000), "size 0": raster.npy("|u1", (0, 10, 10), b""),
        "pickled": raster.npy("|O", (10, 10, 10), b"cos\nsystem\n."),
        "overflow": raster.npy("|u1", (2**32, 2**32, 4), U8), "2^31": raster.npy("|u1", (2**31, 1, 1), U8),
        "no shape": raster.npy("", (), U8, header="{'descr': '|u1', 'fortran_order': False}")}

RESULT = {"vantage": "0.1.0", "method": "voxel"}
RESULTS = {"empty": "", "cut off": '{"vantage": "0.1.0", ', "list": "[]", "nothing in it": "{}",
    "little in it": json.dumps(RESULT), "deep": "[" * 1000, "no JSON": "best: 1"}


def _with_map(origin=(-1, -1, -1), cell=0.2):
    return text_of(changed(base.CELL, "reach/map", {"file": "map.npy", "origin_m": list(origin), "cell_m": cell}))


# A plan as the schema has it; what `config` says is up to who wrote it.
CORPUS = pathlib.Path(__file__).parent.parent / "fuzz/corpus/plan/one.json"
CONFIGS = [("config", {}), ("config/dataset", 5), ("config/workcell", 5), ("config/dataset", "nowhere"),
    ("inputs", []), ("config/images", "all"), ("best", None)]


def cases():
    by_file = PLAN + ["--objects", "world.json"]
    for i, (path, value, word) in enumerate(WORLDS):
        yield Case(f"world/{i} {path.replace('/', '.')}", by_file, 3, (word,),
            {"world.json": text_of(changed(WORLD, path, value))})
    for name, content in WORLD_TEXTS.items():
        yield Case("world/" + name, by_file, 3, ("world.json",), {"world.json": content})
    yield Case("world/right", by_file, (0, 4), (), {"world.json": json.dumps(WORLD)})
    yield Case("world/missing", by_file, 3, ("world.json",))
    for name, (content, word) in VIEWS.items():
        place = "views.json" if name != "eye far away" else "view 0"
        yield Case("views/" + name, PLAN + ["--candidates", "views.json"], 3, (place, word),
            {"views.json": content})
    for name, content in MAPS.items():
        yield Case("reach map/" + name, PLAN, (6,) if name in ("overflow", "2^31") else 3, ("map.npy",),
            {"cell.yaml": _with_map(), "map.npy": content})
    for name, origin, cell, word in (("cell 0", (0, 0, 0), 0, "cell_m"), ("cell -1", (0, 0, 0), -1, "cell_m"),
        ("far away", (1e300, 0, 0), 0.1, "origin_m"), ("cell 1e-300", (0, 0, 0), 1e-300, "cell_m")):
        yield Case("reach map/" + name, PLAN, (3, 4) if "1e" in name or "far" in name else 3,
            () if "1e" in name or "far" in name else (word,), {"cell.yaml": _with_map(origin, cell),
            "map.npy": raster.npy("|u1", (10, 10, 10), U8)})
    for name, content in RESULTS.items():
        yield Case("evaluate gain/" + name, ["evaluate", "gain", "cell.yaml", "plan.json"], 3, ("plan.json",),
            {"plan.json": content})
    plan = json.loads(CORPUS.read_text())
    for i, (path, value) in enumerate(CONFIGS):
        yield Case(f"evaluate gain/{i} {path.replace('/', '.')}", ["evaluate", "gain", "cell.yaml", "plan.json"], 3,
            ("plan.json",), {"plan.json": text_of(changed(plan, path, value))})
    yield Case("evaluate gain/missing", ["evaluate", "gain", "cell.yaml", "plan.json"], 3, ("plan.json",))
