"""Computes the errors of `vantage evaluate reconstruction` from its files alone, and compares.

    check_reconstruction.py FOLDER

FOLDER has a simulated dataset, `data`, and `out/reconstruction.json`. Errors and scores are written from
the BOP challenge's description: matrices, loops over symmetries, a ray for each pixel. Exit code 77
without NumPy or Pillow; 1, and what differs, if something does.
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

THETAS = np.arange(1, 11) * 0.05
differences = []


def check_near(name, ours, theirs, tolerance):
    if not abs(ours - theirs) <= tolerance:
        differences.append(f"{name}: computed {ours}, found {theirs}")


def matrix_of_pose(pose):
    """4 x 4, in millimetres."""
    w, x, y, z = (pose["rotation"][key] for key in "wxyz")
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    matrix[:3, 3] = np.array(pose["translation_m"]) * 1000
    return matrix


def matrix_of_bop(rotation, translation):
    matrix = np.eye(4)
    matrix[:3, :3] = np.array(rotation).reshape(3, 3)
    matrix[:3, 3] = translation
    return matrix


def moved(points, matrix):
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def symmetries_of(info):
    """Discrete motions, each followed by each of 315 turns around each axis."""
    discrete = [np.eye(4)] + [np.array(s).reshape(4, 4) for s in info.get("symmetries_discrete", [])]
    turns = []
    for symmetry in info.get("symmetries_continuous", []):
        x, y, z = np.array(symmetry["axis"]) / np.linalg.norm(symmetry["axis"])
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        for angle in np.arange(315) * 2 * np.pi / 315:
            turn = np.eye(4)
            turn[:3, :3] += np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
            turn[:3, 3] = (np.eye(3) - turn[:3, :3]) @ symmetry["offset"]
            turns.append(turn)
    return [turn @ motion for motion in discrete for turn in turns] if turns else discrete


class Model:
    def __init__(self, folder, number, info):
        lines = (folder / f"obj_{number:06}.ply").read_text().split("\n")
        end = lines.index("end_header")
        counts = {w[1]: int(w[2]) for w in map(str.split, lines[:end]) if w[0] == "element"}
        body = [line.split() for line in lines[end + 1:]]
        corners = np.array([row[:3] for row in body[:counts["vertex"]]], dtype=float)
        self.points = np.unique(corners, axis=0)  # faces have corners of their own in the file alone
        faces = body[counts["vertex"]:][:counts["face"]]
        self.triangles = corners[np.array([row[1:4] for row in faces], dtype=int)]
        self.diameter = info["diameter"]
        self.symmetries = symmetries_of(info)


def te(estimate, truth):
    return np.linalg.norm(estimate[:3, 3] - truth[:3, 3])


def re(estimate, truth):
    cosine = (np.trace(estimate[:3, :3] @ np.linalg.inv(truth[:3, :3])) - 1) / 2
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))


def add(model, estimate, truth):
    off = moved(model.points, estimate) - moved(model.points, truth)
    return np.linalg.norm(off, axis=1).mean()


def add_s(model, estimate, truth):
    there = moved(model.points, estimate)
    return np.mean([np.linalg.norm(there - p, axis=1).min() for p in moved(model.points, truth)])


def mssd(model, estimate, truth):
    there = moved(model.points, estimate)
    return min(np.linalg.norm(there - moved(model.points, truth @ s), axis=1).max()
               for s in model.symmetries)


def project(points, k):
    return points[:, :2] / points[:, 2:] * [k[0, 0], k[1, 1]] + [k[0, 2], k[1, 2]]


def mspd(model, estimate, truth, k):
    there = project(moved(model.points, estimate), k)
    return min(np.linalg.norm(there - project(moved(model.points, truth @ s), k), axis=1).max()
               for s in model.symmetries)


def render(model, pose, k, rays):
    """Distance from the camera for each ray (h x w x 3, unit length); 0 for a miss."""
    nearest = np.full(rays.shape[:2], np.inf)
    for a, b, c in moved(model.triangles.reshape(-1, 3), pose).reshape(-1, 3, 3):
        normal = np.cross(b - a, c - a)
        corners = project(np.stack([a, b, c]), k)
        low = np.maximum(np.floor(corners.min(axis=0)).astype(int), 0)
        high = np.ceil(corners.max(axis=0)).astype(int) + 1
        part = np.s_[low[1]:max(high[1], 0), low[0]:max(high[0], 0)]
        with np.errstate(divide="ignore", invalid="ignore"):
            distance = (normal @ a) / (rays[part] @ normal)
            hits = rays[part] * distance[..., None]
            inside = distance > 0
            for start, stop in ((a, b), (b, c), (c, a)):
                inside &= np.cross(stop - start, hits - start) @ normal >= 0
        nearest[part] = np.where(inside & (distance < nearest[part]), distance, nearest[part])
    return np.where(np.isfinite(nearest), nearest, 0)


def visible(range_mm, scene):
    return (range_mm > 0) & ((scene == 0) | (range_mm - scene <= 15))


def vsd(estimate, truth, scene, diameter):
    """For each misalignment tau."""
    seen_true = visible(truth, scene)
    seen = visible(estimate, scene) | (seen_true & (estimate > 0))
    union, both = seen_true | seen, seen_true & seen
    if not union.any():
        return np.ones(10)
    off = np.abs(truth - estimate)[both] / diameter
    return np.array([((off >= tau).sum() + union.sum() - both.sum()) / union.sum() for tau in THETAS])


def recalled(errors, scores, targets):
    """How many targets are matched, the highest score first, summed over the thresholds."""
    total = 0
    for theta in THETAS:
        free = set(targets)
        for e in sorted(range(len(scores)), key=lambda e: -scores[e]):
            least = min(((errors[e, t], t) for t in sorted(free)), default=(np.inf, -1))
            if least[0] < theta:
                free.remove(least[1])
                total += 1
    return total


class Dataset:
    def __init__(self, folder, images):
        infos = json.loads((folder / "models" / "models_info.json").read_text())
        self.models = {int(n): Model(folder / "models", int(n), i) for n, i in infos.items()}
        self.folder, self.wanted = folder, images
        self.cameras = json.loads((folder / "scene_camera.json").read_text())
        self.truths = json.loads((folder / "scene_gt.json").read_text())

    def images(self):
        for image, camera in self.cameras.items():
            if int(image) not in self.wanted:
                continue
            w2c = matrix_of_bop(camera["cam_R_w2c"], camera["cam_t_w2c"])
            truth = [(t["obj_id"], matrix_of_bop(t["cam_R_m2c"], t["cam_t_m2c"]))
                     for t in self.truths[image]]
            depth = np.array(Image.open(self.folder / "depth" / f"{int(image):06}.png"), dtype=float)
            yield w2c, np.array(camera["cam_K"]).reshape(3, 3), truth, depth * camera["depth_scale"]


def ids_by_name(dataset, objects):
    """The obj_id of each true object: that which the first image has at its place."""
    w2c, _, truth, _ = next(dataset.images())
    return {o["name"]: min(truth, key=lambda t: np.abs(
        w2c @ matrix_of_pose(o["T_world_object"]) - t[1]).max())[0] for o in objects}


def check_estimates(dataset, report, method, ids):
    truth = {o["name"]: matrix_of_pose(o["T_world_object"]) for o in report["true_objects"]}
    for index, found in enumerate(method["estimates"]):
        if found["object"] is None:
            continue
        model = dataset.models[ids[found["object"]]]
        pair = matrix_of_pose(found["T_world_object"]), truth[found["object"]]
        name = f"{method['method']}, estimate {index}, "
        check_near(name + "te_mm", te(*pair), found["te_mm"], 1e-6)
        check_near(name + "re_deg", re(*pair), found["re_deg"], 1e-5)
        check_near(name + "add_mm", add(model, *pair), found["add_mm"], 1e-4)
        check_near(name + "add_s_mm", add_s(model, *pair), found["add_s_mm"], 1e-4)
        check_near(name + "mssd_mm", mssd(model, *pair), found["mssd_mm"], 1e-4)


def check_scores(dataset, method, ids, types):
    estimates = [(types[e["type"]], matrix_of_pose(e["T_world_object"]))
                 for e in method["estimates"] if e["type"] in types]
    scores = [e["probability"] for e in method["estimates"] if e["type"] in types]
    sums, count = np.zeros(3), 0
    for w2c, k, truth, depth in dataset.images():
        v, u = np.mgrid[:depth.shape[0], :depth.shape[1]]
        rays = np.stack([(u - k[0, 2]) / k[0, 0], (v - k[1, 2]) / k[1, 1], np.ones(u.shape)], axis=-1)
        length = np.linalg.norm(rays, axis=-1)
        scene, rays = depth * length, rays / length[..., None]
        real = [render(dataset.models[n], pose, k, rays) for n, pose in truth]
        fractions = [visible(r, scene).sum() / max((r > 0).sum(), 1) for r in real]
        targets = [t for t, fraction in enumerate(fractions) if fraction >= 0.1]
        count += len(targets)
        errors = np.full((12, len(estimates), len(truth)), np.inf)
        for e, (kind, pose) in enumerate(estimates):
            pose = w2c @ pose
            model = dataset.models[kind]
            drawn = render(model, pose, k, rays)
            for t in targets:
                if truth[t][0] == kind:
                    errors[0, e, t] = mssd(model, pose, truth[t][1]) / model.diameter
                    errors[1, e, t] = mspd(model, pose, truth[t][1], k) / (100 * u.shape[1] / 640)
                    errors[2:, e, t] = vsd(drawn, real[t], scene, model.diameter)
        each = [recalled(e, scores, targets) for e in errors]
        sums += [each[0], each[1], sum(each[2:]) / 10]
    bop = method["bop"]
    check_near(method["method"] + " targets", count, bop["targets"], 0)
    for name, total, tolerance in zip(("ar_mssd", "ar_mspd", "ar_vsd"), sums, (1e-9, 1e-9, 5e-3)):
        check_near(f"{method['method']} {name}", total / (10 * count), bop[name], tolerance)


def main():
    folder = pathlib.Path(sys.argv[1])
    report = json.loads((folder / "out" / "reconstruction.json").read_text())
    dataset = Dataset(folder / "data", {camera["image"] for camera in report["cameras"]})
    ids = ids_by_name(dataset, report["true_objects"])
    types = {o["type"]: ids[o["name"]] for o in report["true_objects"]}
    for method in report["methods"]:
        if not method["estimates"]:
            differences.append(f"{method['method']} found nothing that could be checked")
        check_estimates(dataset, report, method, ids)
        check_scores(dataset, method, ids, types)
    for difference in differences:
        print(difference)
    sys.exit(1 if differences else 0)


main()
