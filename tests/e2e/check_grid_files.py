"""Reads what `vantage plan --save-grid --save-surface` wrote with programs that are not vantage's.

    check_grid_files.py FOLDER

NumPy and Debian's python3-openvdb read the files; counted volumes and positions have to be those of
plan.json. Exit code 77 if one of the two is missing; 1, and what differs, if something does.
"""

import json
import pathlib
import sys

try:
    import numpy as np

    try:
        import openvdb as vdb  # its name from OpenVDB 11 on
    except ImportError:
        import pyopenvdb as vdb
except ImportError as error:
    print(f"skipped, for want of python3-openvdb or python3-numpy: {error}")
    sys.exit(77)

FREE, OCCUPIED, SHADOW, REVEALED = range(4)
differences = []


def check(what, found, expected, tolerance=1e-9):
    """Notes a difference of more than `tolerance`, relative to what is large."""
    found, expected = np.asarray(found, float), np.asarray(expected, float)
    scale = np.maximum(1e-3, np.abs(expected))
    if found.shape != expected.shape or (np.abs(found - expected) > tolerance * scale).any():
        differences.append(f"{what}: found {found.tolist()}, expected {expected.tolist()}")


def check_volumes(plan, labels, unmeasured, unseen):
    voxel_m3 = plan["voxel_size_m"] ** 3
    volumes = plan["volumes_m3"]
    counts = np.bincount(labels.ravel(), minlength=4)
    check("states", counts[4:].sum(), 0)
    check("work area", labels.size * voxel_m3, volumes["work_area"])
    check("free", counts[FREE] * voxel_m3, volumes["free"])
    check("occupied", counts[OCCUPIED] * voxel_m3, volumes["occupied"])
    check("shadow", (counts[SHADOW] + counts[REVEALED]) * voxel_m3, volumes["shadow"])
    check("unseen", unseen.sum() * voxel_m3, volumes["shadow_unseen"])
    check("unmeasured", unmeasured.sum() * voxel_m3, volumes["shadow_unmeasured"])
    check("hidden", volumes["shadow"] - volumes["shadow_unmeasured"] - volumes["shadow_outside"],
          volumes["shadow_hidden"])
    check("revealed", counts[REVEALED] * voxel_m3, plan["best"]["newly_observed_volume_m3"])


def corners(mask):
    """First and last index along each axis where a mask is true."""
    places = np.argwhere(mask)
    return places.min(axis=0), places.max(axis=0)


def check_grid(path, name, mask, plan):
    """A bool grid of grid.vdb holds exactly `mask`, at the right place in the world."""
    grid = vdb.read(str(path), name)
    dense = np.zeros(mask.shape, bool)
    grid.copyToArray(dense)
    check(f"grid {name}: voxels that differ", (dense != mask).sum(), 0)
    check(f"grid {name}: active voxels", grid.activeVoxelCount(), mask.sum())
    check(f"grid {name}: background", grid.background, False)
    size = plan["voxel_size_m"]
    low = np.array(plan["config"]["work_area"]["min_m"])
    check(f"grid {name}: voxel size", grid.transform.voxelSize(), [size] * 3)
    if mask.any():
        box = grid.evalActiveVoxelBoundingBox()
        check(f"grid {name}: box", box, corners(mask))
        for index in box:  # an index is a voxel's centre
            check(f"grid {name}: world", grid.transform.indexToWorld(index),
                  low + (np.array(index) + 0.5) * size)
    return dense


def check_regions(plan, regions, labels, unseen):
    size = plan["voxel_size_m"]
    low = np.array(plan["config"]["work_area"]["min_m"])
    shadow = labels >= SHADOW
    check("regions outside the shadow", ((regions > 0) != shadow).sum(), 0)
    for axis in range(3):  # neighbours in the shadow belong to the same region
        a, b = np.moveaxis(regions, axis, 0)[1:], np.moveaxis(regions, axis, 0)[:-1]
        check("neighbours in two regions", ((a != b) & (a > 0) & (b > 0)).sum(), 0)
    counts = np.bincount(regions.ravel())[1:]
    check("number of regions", len(counts), plan["shadow_regions"]["count"])
    check("order of regions", counts, np.sort(counts)[::-1])
    largest = plan["shadow_regions"]["largest"]
    check("regions listed", len(largest), min(len(counts), 20))
    for label, region in enumerate(largest, start=1):
        mask = regions == label
        check("region", mask.sum() * size**3, region["volume_m3"])
        check("unseen part", (mask & unseen).sum() * size**3, region["unseen_m3"])
        check("centroid", low + (np.argwhere(mask).mean(axis=0) + 0.5) * size, region["centroid_m"])
        first, last = corners(mask)
        check("lower corner", low + first * size, region["min_m"])
        check("upper corner", low + (last + 1) * size, region["max_m"])


def enclosed_volume(path):
    """Of a binary PLY of triangles, by the divergence theorem."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    words = data[:end].decode().split()
    vertex_count, face_count = (int(words[words.index(e) + 1]) for e in ("vertex", "face"))
    vertices = np.frombuffer(data, "<f4", 3 * vertex_count, end).reshape(-1, 3).astype(float)
    face = np.dtype([("corners", "u1"), ("v", "<i4", 3)])
    faces = np.frombuffer(data, face, face_count, end + 12 * vertex_count)["v"]
    a, b, c = (vertices[faces[:, k]] - vertices[0] for k in range(3))
    return (a * np.cross(b, c)).sum() / 6


def main(folder):
    plan = json.loads((folder / "plan.json").read_text())
    labels, regions = np.load(folder / "labels.npy"), np.load(folder / "regions.npy")
    if (labels.dtype, regions.dtype) != (np.uint8, np.int32) or labels.shape != regions.shape:
        differences.append(f"arrays: {labels.dtype} {labels.shape}, {regions.dtype} {regions.shape}")
    path = folder / "grid.vdb"
    check_grid(path, "occupied", labels == OCCUPIED, plan)
    check_grid(path, "shadow", labels == SHADOW, plan)
    check_grid(path, "revealed", labels == REVEALED, plan)
    unseen, measured = np.zeros(labels.shape, bool), np.zeros(labels.shape, bool)
    vdb.read(str(path), "unseen").copyToArray(unseen)
    vdb.read(str(path), "measured").copyToArray(measured)
    unmeasured = np.zeros(labels.shape, bool)
    vdb.read(str(path), "unmeasured").copyToArray(unmeasured)
    check("voxels with two causes", (unmeasured & unseen).sum(), 0)
    check_grid(path, "unmeasured", unmeasured & (labels >= SHADOW), plan)
    check_grid(path, "unseen", unseen & (labels >= SHADOW), plan)
    check_grid(path, "measured", measured & (labels == OCCUPIED), plan)
    check_volumes(plan, labels, unmeasured, unseen)
    check_regions(plan, regions, labels, unseen)
    stays = (labels == SHADOW).sum() * plan["voxel_size_m"] ** 3
    check("shadow.ply", enclosed_volume(folder / "shadow.ply"), stays, 1e-4)
    check("shadow_smooth.ply", enclosed_volume(folder / "shadow_smooth.ply"), stays, 0.25)


main(pathlib.Path(sys.argv[1]))
print("\n".join(differences) or "everything agrees")
sys.exit(1 if differences else 0)
