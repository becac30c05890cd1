"""Recordings of TUM RGB-D, nerfstudio, COLMAP and ScanNet that are not quite that."""

import json
import os

import base
import raster
from case import REMOVED, Case, changed, text_of

W, H = base.WIDTH, base.HEIGHT
COLOUR, DEPTH = raster.colour_png(W, H), raster.depth_png(W, H, 5000)
IMPORT = ["import", "source", "-o", "out"]
UNIT = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]

TUM = {"source/rgb.txt": "# colour\n1.0 rgb/1.png\n2.0 rgb/2.png\n",
    "source/depth.txt": "1.001 depth/1.png\n2.001 depth/2.png\n",
    "source/groundtruth.txt": "1.0 0 0 0 0 0 0 1\n2.0 0.1 0 0 0 0 0 1\n",
       "source/rgb/1.png": COLOUR, "source/rgb/2.png": COLOUR, "source/depth/1.png": DEPTH,
       "source/depth/2.png": DEPTH, "camera.yml": base.CALIBRATION}
TRANSFORMS = {"fl_x": 52, "fl_y": 52, "cx": 32, "cy": 24, "w": W, "h": H,
    "frames": [{"file_path": "images/1.png", "depth_file_path": "depth/1.png", "transform_matrix": UNIT}]}
NERF = {"source/transforms.json": json.dumps(TRANSFORMS), "source/images/1.png": COLOUR, "source/depth/1.png": DEPTH}
COLMAP = {"source/cameras.txt": f"# cameras\n1 PINHOLE {W} {H} 52 52 32 24\n",
    "source/images.txt": "1 1 0 0 0 0 0 1 1 1.png\n\n", "source/images/1.png": COLOUR, "source/depth/1.png": DEPTH}
MATRIX = "52 0 31.5 0\n0 52 23.5 0\n0 0 1 0\n0 0 0 1\n"
SCANNET = {"source/intrinsic/intrinsic_depth.txt": MATRIX,
    "source/pose/0.txt": "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", "source/depth/0.png": DEPTH,
    "source/color/0.png": COLOUR}

TUM_WRONG = {
    "no times": ("rgb.txt", "", "rgb.txt"), "words for times": ("rgb.txt", "one rgb/1.png\n", "rgb.txt:1"),
    "time only": ("rgb.txt", "1.0\n", "rgb.txt:1"), "infinite time": ("rgb.txt", "inf rgb/1.png\n", "finite"),
    "never together": ("depth.txt", "9.0 depth/1.png\n", "no image"), "bytes": ("depth.txt", b"\0\1\2", "depth.txt"),
    "pose of 3 numbers": ("groundtruth.txt", "1.0 0 0 0\n", "groundtruth.txt:1"),
    "quaternion 0": ("groundtruth.txt", "1.0 0 0 0 0 0 0 0\n2.0 0 0 0 0 0 0 1\n", "groundtruth.txt:1"),
    "pose nan": ("groundtruth.txt", "1.0 nan 0 0 0 0 0 1\n2.0 0 0 0 0 0 0 1\n", "groundtruth.txt:1"),
    "pose 1e300": ("groundtruth.txt", "1.0 1e300 0 0 0 0 0 1\n2.0 0 0 0 0 0 0 1\n", "1e"),
    "picture missing": ("rgb/1.png", None, "1.png"), "depth missing": ("depth/1.png", None, "1.png"),
    "depth of 8 bits": ("depth/1.png", raster.png(W, H, 8, 0, [b"\x50" * W] * H), "16"),
    "picture cut off": ("rgb/1.png", COLOUR[:60], "000000.png"),
    "path outside": ("rgb.txt", "1.0 ../../../../etc/passwd\n", "passwd"),
    "path absolute": ("depth.txt", "1.0 /etc/passwd\n", "passwd"),
    "endless picture": ("rgb.txt", "1.0 /dev/zero\n", "/dev/zero"),
}
NERF_WRONG = [
    ("frames", REMOVED, "frames"), ("frames", [], "image"), ("frames", "all", "frames"), ("frames/0", 5, "frames"),
    ("frames/0/file_path", REMOVED, "file_path"), ("frames/0/file_path", 5, "file_path"),
    ("frames/0/file_path", "none.png", "none.png"), ("frames/0/file_path", "", "file_path"),
    ("frames/0/transform_matrix", REMOVED, "transform_matrix"),
    ("frames/0/transform_matrix", [[1]], "transform_matrix"),
    ("frames/0/transform_matrix", [[0] * 4] * 4, "transform_matrix"),
    ("frames/0/transform_matrix", "unit", "transform_matrix"),
    ("frames/0/transform_matrix/0/0", "1", "transform_matrix"), ("frames/0/transform_matrix/0/3", 1e300, "1e"),
    ("fl_x", REMOVED, "fl_x"), ("fl_x", "far", "fl_x"), ("fl_x", 0, "fx"),
    ("w", -1, "w"), ("w", 1e9, "w"), ("w", "wide", "w"), ("k1", "much", "k1"), ("k1", 1e300, "k1"),
    ("camera_model", "SPHERICAL", "SPHERICAL"), ("camera_model", 5, "camera_model"),
    ("depth_unit_scale_factor", "mm", "depth_unit_scale_factor"), ("depth_unit_scale_factor", -1, "depth_unit_scale_factor"),
    ("cx", 1e300, "cam_K"),
]
NERF_TEXTS = {"empty": "", "cut off": json.dumps(TRANSFORMS)[:60], "list": "[]", "deep": "[" * 100000,
    "NaN": json.dumps(TRANSFORMS).replace("52", "NaN", 1)}
COLMAP_WRONG = {
    "no cameras": ("cameras.txt", "", "camera"), "model unknown": ("cameras.txt", "1 SPHERE 64 48 1 2 3 4\n",
    "SPHERE"), "too few": ("cameras.txt", "1 PINHOLE 64 48 52\n", "cameras.txt:1"),
    "words": ("cameras.txt", "1 PINHOLE wide high 52 52 32 24\n", "cameras.txt:1"),
    "focal length 0": ("cameras.txt", "1 PINHOLE 64 48 0 0 32 24\n", "fx"),
    "width -5": ("cameras.txt", "1 PINHOLE -5 48 52 52 32 24\n", "cameras.txt:1"),
    "no images": ("images.txt", "", "image"), "image cut off": ("images.txt", "1 1 0 0 0\n", "images.txt:1"),
    "quaternion 0": ("images.txt", "1 0 0 0 0 0 0 1 1 1.png\n\n", "images.txt:1"),
    "camera 9": ("images.txt", "1 1 0 0 0 0 0 1 9 1.png\n\n", "9"),
    "picture missing": ("images.txt", "1 1 0 0 0 0 0 1 1 none.png\n\n", "none.png"),
    "bytes": ("images.txt", b"\0\xff", "images.txt"),
    "nan": ("images.txt", "1 1 0 0 0 nan 0 1 1 1.png\n\n", "images.txt:1"),
}
SCANNET_WRONG = {
    "intrinsics empty": ("intrinsic/intrinsic_depth.txt", "", "intrinsic_depth.txt"),
    "intrinsics of words": ("intrinsic/intrinsic_depth.txt", "a b c\n", "intrinsic_depth.txt:1"),
    "focal length 0": ("intrinsic/intrinsic_depth.txt", MATRIX.replace("52", "0"), "fx"),
    "two rows": ("pose/0.txt", "1 0 0 0\n0 1 0 0\n", "0.txt"),
    "no rotation": ("pose/0.txt", "5 0 0 0\n0 5 0 0\n0 0 5 0\n0 0 0 1\n", "0.txt"),
    "never tracked": ("pose/0.txt", "-inf -inf -inf -inf\n" * 4, "image"), "no poses": ("pose/0.txt", None, "pose"),
    "depth cut off": ("depth/0.png", DEPTH[:60], "000000.png"),
    "huge": ("pose/0.txt", "1 0 0 1e300\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", "1e"),
}


def _with(files, name, content):
    files = dict(files)
    files.pop("source/" + name, None) if content is None else files.update({"source/" + name: content})
    return files


def _keep_folder(folder):
    (folder / "source/pose").mkdir(exist_ok=True)


def _foreign(folder):
    (folder / "out").mkdir()
    (folder / "out/thesis.tex").write_text("years of work")


def _fifo(folder):
    (folder / "source/rgb/1.png").unlink()
    os.mkfifo(folder / "source/rgb/1.png")


def cases():
    tum = IMPORT + ["--calibration", "camera.yml"]
    for name, (file, content, word) in TUM_WRONG.items():
        yield Case("import TUM/" + name, tum, 3, (word,), _with(TUM, file, content))
    for i, (path, value, word) in enumerate(NERF_WRONG):
        yield Case(f"import nerfstudio/{i} {path.replace('/', '.')}", IMPORT, 3, (word,),
            _with(NERF, "transforms.json", text_of(changed(TRANSFORMS, path, value))))
    for name, content in NERF_TEXTS.items():
        yield Case("import nerfstudio/" + name, IMPORT, 3, ("transforms.json",),
            _with(NERF, "transforms.json", content))
    for name, (file, content, word) in COLMAP_WRONG.items():
        yield Case("import COLMAP/" + name, IMPORT, 3, (word,), _with(COLMAP, file, content))
    for name, (file, content, word) in SCANNET_WRONG.items():
        yield Case("import ScanNet/" + name, IMPORT, 3, (word,), _with(SCANNET, file, content), prepare=_keep_folder)
    for name, arguments, files in (("TUM", tum, TUM), ("nerfstudio", IMPORT, NERF), ("COLMAP", IMPORT, COLMAP),
        ("ScanNet", IMPORT, SCANNET)):
        yield Case(f"import {name}/right", arguments, 0, (), files)
    yield Case("import/no folder", IMPORT, 3, ("source",))
    yield Case("import/nothing known", IMPORT, 3, ("source", "TUM"), {"source/a.txt": "a"})
    yield Case("import TUM/no intrinsics", IMPORT, 3, ("--calibration",), TUM)
    yield Case("import TUM/a FIFO", tum, 3, ("1.png",), TUM, prepare=_fifo)
    yield Case("import/into somebody's folder", IMPORT, 3, ("out", "not empty"), {**NERF}, prepare=_foreign)
    yield Case("import/an image that is not there", IMPORT + ["--images", "7"], 3, ("--images", "7"), NERF)
    yield Case("import/every 0", IMPORT + ["--every", "0"], 2, ("--every",), NERF)
    yield Case("import/scale of nothing", IMPORT + ["--depth-scale-mm", "nan"], 2, ("--depth-scale-mm",), NERF)
