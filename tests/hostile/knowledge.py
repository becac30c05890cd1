"""Knowledge bases: types that are none, and folders of models that do not fit."""

import json

import base
import raster
from case import PLAN, REMOVED, Case, changed, text_of
from meshes import _ply

TYPE = "object_types/0"
FEATURE = TYPE + "/features/0"
WRONG = [
    ("object_types", REMOVED, "object_types"), ("object_types", {}, "object_types"),
    ("object_types", [1], "object_types"), (TYPE + "/name", REMOVED, "name"), (TYPE + "/name", "", "name"),
    (TYPE + "/name", 5, "name"), ("object_types", base.KNOWLEDGE["object_types"] * 2, "red_cube"),
    (TYPE + "/is_a", ["red_cube"], "red_cube"), (TYPE + "/is_a", "cube", "is_a"),
    ("hierarchy/cube", ["cube"], "cube"), ("hierarchy", {"cube": ["block"], "block": ["cube"]}, "block"),
    ("hierarchy/cube", [], "cube"), (TYPE + "/shape", REMOVED, "shape"), (TYPE + "/shape", {}, "shape"),
    (TYPE + "/mesh", "cube.obj", "mesh"),
    (TYPE + "/shape", {"box": {"size_m": [0, 0, 0]}}, "size_m"),
    (TYPE + "/shape", {"box": {"size_m": [1e300, 1, 1]}}, "vertex 0"),
    
    (TYPE + "/shape", {"pyramid": {}}, "pyramid"), (TYPE + "/shape",
    {"cup": {"radius_m": 0.01, "height_m": 0.1, "wall_m": 0.02}}, "wall"),
    (TYPE + "/shape", {"sphere": {"radius_m": -1}}, "radius_m"), (TYPE + "/shape", {"mesh": "none.stl"}, "none.stl"),
    (TYPE + "/color", [2, 0, 0], "color"), (TYPE + "/color", "red", "color"),
    (TYPE + "/symmetries", {"continuous": [{"axis": [0, 0, 0]}]}, "axis"),
    (TYPE + "/symmetries", {"discrete": [{"w": 0, "x": 0, "y": 0, "z": 0}]}, "discrete"),
    (FEATURE + "/dictionary", "4X4_9", "4X4_9"), (FEATURE + "/value", 250, "250"),
    (FEATURE + "/size_m", 0.06, "size_m"), (FEATURE + "/size_m", 0, "size_m"), (FEATURE + "/face", "up", "face"),
    (FEATURE + "/face", REMOVED, "face"), (FEATURE + "/pose", {}, "pose"),
    (TYPE + "/features/1/anywhere", False, "anywhere"), (TYPE + "/features/1/near_m", [[0, 0, 0]], "near_m"),
    (TYPE + "/features/1", {"type": "keypoint", "value": "k", "points_m": []}, "points_m"),
    (TYPE + "/features/1", base.KNOWLEDGE["object_types"][0]["features"][0], "repeats"),
    (TYPE + "/mas_kg", 1, "mas_kg"),
]
INFO = {"1": {"diameter": 70, "min_x": -25, "min_y": -25, "min_z": -25, "size_x": 50, "size_y": 50, "size_z": 50}}
MODELS = {
    "info empty": ({"models/models_info.json": ""}, "models_info.json"),
    "info a list": ({"models/models_info.json": "[]"}, "models_info.json"),
    "no model": ({"models/models_info.json": json.dumps(INFO)}, "obj_000001.ply"),
    "model damaged": ({"models/models_info.json": json.dumps(INFO), "models/obj_000001.ply": _ply()[:100]},
    "obj_000001.ply"), "id a word": ({"models/models_info.json": json.dumps({"one": INFO["1"]})}, "one"),
    "symmetry of 3 numbers": ({"models/models_info.json": json.dumps({"1": {**INFO["1"],
    "symmetries_discrete": [[1, 0, 0]]}}), "models/obj_000001.ply": _ply()}, "symmetries_discrete"),
    "axis 0": ({"models/models_info.json": json.dumps({"1": {**INFO["1"],
    "symmetries_continuous": [{"axis": [0, 0, 0], "offset": [0, 0, 0]}]}}), "models/obj_000001.ply": _ply()},
    "symmetries_continuous"),
}


def cases():
    for i, (path, value, word) in enumerate(WRONG):
        shown = "removed" if value is REMOVED else text_of(value).replace("\n", "")[:30]
        yield Case(f"knowledge/{i} {path.replace('/', '.')} {shown}", PLAN, 3,
            ("none.stl" if word == "none.stl" else "k.yaml", word),
            {"k.yaml": text_of(changed(base.KNOWLEDGE, path, value))})
    for name, (files, word) in MODELS.items():
        yield Case("models/" + name, PLAN, 3, (word,), {**files,
            "cell.yaml": text_of(changed(base.CELL, "knowledge_base", ["models", "k.yaml"]))})
