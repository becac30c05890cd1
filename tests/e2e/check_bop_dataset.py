"""Reads what `vantage simulate --ideal-depth` wrote as the BOP format describes it.

    check_bop_dataset.py FOLDER

Written from the format's description alone: every field in its place and unit, models in millimetres
with their box, diameter, normals and texture; and with the poses of scene_gt.json the models' surfaces lie
where the depth images have them. Exit code 77 without NumPy or Pillow; 1, and what differs, if
something does.
"""

import json
import pathlib
import sys

try:
    import numpy as np
    from PIL import Image
except ImportError as error:
    print(f"skipped, for want of python3-numpy or python3-pil: {error}")
    sys.exit(77)

differences = []


def check(ok, what):
    if not ok:
        differences.append(what)


def read_ply(path):
    """Vertices by the names of their properties, faces, and the texture's file."""
    lines = path.read_text().split("\n")
    check(lines[:2] == ["ply", "format ascii 1.0"], f"{path.name}: not an ASCII PLY")
    names, counts, texture, end = [], {}, None, lines.index("end_header")
    for words in (line.split() for line in lines[2:end]):
        if words[0] == "element":
            counts[words[1]] = int(words[2])
        elif words[0] == "property" and words[1] != "list":
            names.append(words[2])
        elif words[:2] == ["comment", "TextureFile"]:
            texture = words[2]
    body = lines[end + 1:]
    rows = np.array([line.split() for line in body[:counts["vertex"]]], dtype=float)
    faces = np.array([line.split() for line in body[counts["vertex"]:][:counts["face"]]], dtype=int)
    check((faces[:, 0] == 3).all(), f"{path.name}: a face is no triangle")
    return dict(zip(names, rows.T)), faces[:, 1:], texture


def check_model(folder, number, info):
    vertices, faces, texture = read_ply(folder / f"obj_{int(number):06}.ply")
    points = np.stack([vertices[axis] for axis in "xyz"], axis=1)
    for axis, low, size in zip("xyz", points.min(axis=0), np.ptp(points, axis=0)):
        check(abs(info[f"min_{axis}"] - low) < 1e-3, f"model {number}: min_{axis}")
        check(abs(info[f"size_{axis}"] - size) < 1e-3, f"model {number}: size_{axis}")
    widest = max(np.linalg.norm(points - p, axis=1).max() for p in points)
    check(abs(info["diameter"] - widest) < 1e-3, f"model {number}: diameter, {widest}")
    check(10 < widest < 1000, f"model {number} is not in millimetres")
    normals = np.stack([vertices["n" + axis] for axis in "xyz"], axis=1)
    check(np.allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-4), f"model {number}: normals")
    corners = points[faces]
    volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
    check(volume > 0, f"model {number}: its faces point inwards")
    if texture:
        check((folder / texture).is_file(), f"model {number}: no texture {texture}")
        for axis in ("texture_u", "texture_v"):
            check((vertices[axis] >= 0).all() and (vertices[axis] <= 1).all(), f"{number}: {axis}")
    return corners


def surface_points(corners, rng):
    """Points all over the triangles, and the normals of these."""
    weights = rng.dirichlet([1, 1, 1], size=(len(corners), max(1, 4000 // len(corners))))
    points = np.einsum("tsk,tkd->tsd", weights, corners)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return points.reshape(-1, 3), np.repeat(normals, points.shape[1], axis=0)


def check_object(image, camera, depth_mm, truth, corners, rng):
    """@returns how many of the model's front points are seen by the depth image."""
    rotation = np.array(truth["cam_R_m2c"]).reshape(3, 3)
    check(np.allclose(rotation @ rotation.T, np.eye(3), atol=1e-9), f"{image}: cam_R_m2c")
    points, normals = surface_points(corners, rng)
    points = points @ rotation.T + truth["cam_t_m2c"]
    slope = -np.einsum("ij,ij->i", normals @ rotation.T, points) / np.linalg.norm(points, axis=1)
    points = points[slope > 0.5]
    k = np.array(camera["cam_K"]).reshape(3, 3)
    u, v = np.rint((points @ k.T)[:, :2] / points[:, 2:]).astype(int).T
    height, width = depth_mm.shape
    inside = (u >= 0) & (u < width) & (v >= 0) & (v < height)
    seen, z = depth_mm[v[inside], u[inside]], points[inside, 2]
    # A pixel is up to a millimetre from the point's own ray; what stands before it is nearer.
    behind = (seen > z + 3).mean() if len(z) else 0
    check(behind < 0.02, f"image {image}, object {truth['obj_id']}: {behind:.3f} of it is missing")
    return int((np.abs(seen - z) < 3).sum())


def check_images(folder, models):
    cameras = json.loads((folder / "scene_camera.json").read_text())
    truths = json.loads((folder / "scene_gt.json").read_text())
    check(cameras.keys() == truths.keys(), "scene_gt.json has other images than scene_camera.json")
    rng = np.random.default_rng(1)
    seen = 0
    for image, camera in cameras.items():
        depth = np.array(Image.open(folder / "depth" / f"{int(image):06}.png"))
        check(depth.dtype in (np.uint16, np.int32), f"depth image {image} is not of 16 bits")
        color = Image.open(folder / "rgb" / f"{int(image):06}.png")
        check(color.mode == "RGB" and color.size == depth.shape[::-1], f"rgb image {image}")
        rotation = np.array(camera["cam_R_w2c"]).reshape(3, 3)
        check(np.allclose(rotation @ rotation.T, np.eye(3), atol=1e-9), f"{image}: cam_R_w2c")
        check(np.linalg.norm(camera["cam_t_w2c"]) > 100, f"image {image}: cam_t_w2c is not in mm")
        depth_mm = depth * camera["depth_scale"]
        for truth in truths[image]:
            seen += check_object(image, camera, depth_mm, truth, models[truth["obj_id"]], rng)
    check(seen > 1000, f"the depth images show {seen} points of the models; expected many more")


def main():
    folder = pathlib.Path(sys.argv[1])
    infos = json.loads((folder / "models" / "models_info.json").read_text())
    models = {int(n): check_model(folder / "models", n, info) for n, info in infos.items()}
    check_images(folder, models)
    for difference in differences:
        print(difference)
    sys.exit(1 if differences else 0)


main()
