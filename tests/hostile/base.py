"""A small recording and a small workcell that are right in everything: cases change one thing of it."""

import json

import raster

WIDTH, HEIGHT = 64, 48
K = [52, 0, 31.5, 0, 52, 23.5, 0, 0, 1]
_ROTATION = [1, 0, 0, 0, -0.31622776601683794, -0.9486832980505138, 0, 0.9486832980505138, -0.31622776601683794]


def _entry(t):
    return {"cam_K": K, "depth_scale": 0.1, "cam_R_w2c": _ROTATION, "cam_t_w2c": t}


CAMERAS = {"0": _entry([0, 47.434164902525694, 490.15303732609885]),
           "1": _entry([-50, 47.434164902525694, 490.15303732609885])}

BOARD = {"size_m": [0.5, 0.35], "thickness_m": 0.01, "dictionary": "4X4_250",
         "markers": [{"id": 100, "size_m": 0.04, "at_m": [-0.225, -0.15]},
                     {"id": 101, "size_m": 0.04, "at_m": [0.225, -0.15]},
                     {"id": 102, "size_m": 0.04, "at_m": [0.225, 0.15]}]}

KNOWLEDGE = {"hierarchy": {"cube": ["block"]},
             "object_types": [{"name": "red_cube", "is_a": ["cube"], "shape": {"box": {"size_m": [0.05, 0.05, 0.05]}},
                               "color": [0.78, 0.1, 0.09],
                               "features": [{"type": "aruco", "dictionary": "4X4_250", "value": 10, "size_m": 0.032,
                                             "face": "+x"},
                                            {"type": "label", "value": "red", "anywhere": True}]}]}

CELL = {"work_area": {"min_m": [-0.12, -0.1, 0], "max_m": [0.12, 0.1, 0.1]}, "voxel_size_m": 0.02,
        "sensor": {"depth_range_m": [0.1, 3]},
        "movable_camera": {"width": WIDTH, "height": HEIGHT, "fx": 50, "fy": 50, "cx": 31.5, "cy": 23.5,
                           "depth_range_m": [0.1, 3]},
        "candidates": {"radii_m": [0.5], "count": 6, "rings": 0, "ring_step_rad": 0.17},
        "reach": {"shell": {"base_m": [0, -0.6, 0], "min_m": 0.1, "max_m": 1.8},
                  "box": {"min_m": [-1.5, -1.5, 0.05], "max_m": [1.5, 1.75, 1.5]}},
        "view_cone": {"axis": [0, 0, -1], "half_angle_rad": 1.5},
        "camera_body": {"box": {"min_m": [-0.05, -0.015, -0.03], "max_m": [0.05, 0.015, 0.005]}},
        "clearance_m": 0.02, "knowledge_base": ["k.yaml"], "board": "board.yaml",
        "static_structures": [{"name": "wall", "box": {"min_m": [-1, 0, 0], "max_m": [1, 0.05, 0.5]},
                               "pose": {"translation_m": [0, 0.8, 0]}}],
        "known_objects": [{"name": "b", "mesh": "cube.obj", "pose": {"translation_m": [-0.05, 0, 0]}},
                          {"name": "a", "type": "red_cube", "pose": {"translation_m": [0.05, 0, 0.025]}}],
        "volume": {"occluders": "mesh", "anti_alias": False, "band_sigmas": 4}}

CUBE = """v 0 0 0
v 0.05 0 0
v 0.05 0.05 0
v 0 0.05 0
v 0 0 0.05
v 0.05 0 0.05
v 0.05 0.05 0.05
v 0 0.05 0.05
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
"""

CALIBRATION = """%YAML:1.0
---
image_width: 64
image_height: 48
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 52., 0., 31.5, 0., 52., 23.5, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [ 0., 0., 0., 0., 0. ]
"""


def depth_count(x, y):
    """A table 0.5 m away and a box on it, in tenths of a millimetre."""
    return 4400 if 26 <= x < 40 and 18 <= y < 30 else 5200 - 8 * y


def files():
    """The whole of it: paths and contents."""
    depth = raster.depth_png(WIDTH, HEIGHT, depth_count)
    colour = raster.colour_png(WIDTH, HEIGHT)
    return {"scene/scene_camera.json": json.dumps(CAMERAS, indent=1),
            "scene/depth/000000.png": depth, "scene/depth/000001.png": depth,
            "scene/rgb/000000.png": colour, "scene/rgb/000001.png": colour,
            "cell.yaml": json.dumps(CELL, indent=1), "k.yaml": json.dumps(KNOWLEDGE, indent=1),
            "board.yaml": json.dumps(BOARD, indent=1), "cube.obj": CUBE, "camera.yml": CALIBRATION}
