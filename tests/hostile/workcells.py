"""Workcells that are read well and make no sense."""

import base
from case import PLAN, REMOVED, Case, Raw, changed, text_of

# path, value, exit code, words
WRONG = [
    ("work_area", REMOVED, 3, ["cell.yaml:1", "work_area"]), ("work_area", None, 3, ["work_area"]),
    ("work_area", [], 3, ["work_area"]),
    ("work_area/min_m", REMOVED, 3, ["min_m"]), ("work_area/min_m", [0, 0], 3, ["min_m"]),
    ("work_area/min_m", [0, 0, "0"], 3, ["min_m"]), ("work_area/min_m", [1, 1, 1], 3, ["work_area"]),
    ("work_area/max_m", [0.12, -0.1, 0.1], 3, ["work_area"]), ("work_area/max_m", [Raw(".nan"), 1, 1], 3, ["max_m"]),
    ("work_area/max_m", [Raw(".inf"), 1, 1], 3, ["max_m"]), ("work_area/max_m", [1e300, 1, 1], (3, 6), ["work"]),
    ("work_area/max_m", [1e5, 1e5, 1e5], 6, ["voxel"]), ("work_area/max_m", [50, 50, 50], 6, ["voxel"]),
    ("work_area", {"min_m": [5e6, 0, 0], "max_m": [5000000.2, 0.2, 0.2]}, 3, ["5e+06 m away"]),
    ("work_area/min_m", [True, 0, 0], 3, ["min_m"]), ("work_area/extra", 1, 3, ["extra"]),
    ("voxel_size_m", 0, 3, ["voxel_size_m"]), ("voxel_size_m", -0.02, 3, ["voxel_size_m"]),
    ("voxel_size_m", Raw(".nan"), 3, ["voxel_size_m"]), ("voxel_size_m", "0.02", 3, ["voxel_size_m", "string"]),
    ("voxel_size_m", 1e-9, 6, ["voxel"]), ("voxel_size_m", 1e-300, (3, 6), ["voxel"]),
    ("voxel_size_m", 1e300, 3, ["voxel"]),
    ("voxel_size_m", None, 3, ["voxel_size_m"]), ("voxel_size_m", [0.02], 3, ["voxel_size_m"]),
    ("voxel_siz_m", 0.02, 3, ["voxel_siz_m", "voxel_size_m"]),
    ("sensor/depth_range_m", [3, 0.1], 3, ["depth_range_m"]), ("sensor/depth_range_m", [-1, 3], 3, ["depth_range_m"]),
    ("sensor/depth_range_m", [0.1], 3, ["depth_range_m"]), ("sensor/depth_range_m", [0, 1e300], 3, ["depth_range_m"]),
    ("sensor/depth_range_m", [1, 1], 3, ["depth_range_m"]), ("sensor/calibration", "none.yml", 3, ["none.yml"]),
    ("movable_camera/width", 0, 3, ["width"]), ("movable_camera/width", -5, 3, ["width"]),
    ("movable_camera/width", 1.5, 3, ["width"]), ("movable_camera/width", 10**30, 3, ["width"]),
    ("movable_camera/height", REMOVED, 3, ["height"]), ("movable_camera/fx", 0, 3, ["fx"]),
    ("movable_camera/fx", 1e-300, 3, ["movable_camera"]), ("movable_camera/fy", Raw(".inf"), 3, ["fy"]),
    ("movable_camera/cx", 1e300, 3, ["movable_camera"]), ("movable_camera/depth", {"baseline_m": 0}, 3,
    ["baseline_m"]),
    ("candidates/radii_m", [], 3, ["radii_m"]), ("candidates/radii_m", [0], 3, ["radii_m"]),
    ("candidates/radii_m", [-0.5], 3, ["radii_m"]), ("candidates/radii_m", ["far"], 3, ["radii_m"]),
    ("candidates/radii_m", [1e300], (3, 4), []), ("candidates/count", 0, 3, ["count"]),
    ("candidates/count", 10**9, 3, ["count"]),
    ("candidates/count", [1, 2, 3], 3, ["count"]), ("candidates/rings", -1, 3, ["rings"]),
    ("candidates/rings", 10**6, 3, ["rings"]),
    ("candidates/ring_step_rad", 0, 3, ["ring_step_rad"]), ("candidates/set", "some", 3, ["set"]),
    ("candidates", {"views": "none.yaml"}, 3, ["none.yaml"]), ("candidates", {"views": []}, 3, ["views"]),
    ("candidates", {"box_grid": {"min_m": [0, 0, 0], "max_m": [1, 1, 1], "counts": [10**6] * 3}}, (3, 6), ["positions"]),
    ("candidates", {"box_grid": {"min_m": [1, 1, 1], "max_m": [0, 0, 0], "counts": [2, 2, 2]}}, 3, ["box_grid"]),
    ("candidates", {"around_path": {"path": [], "count": 6}}, 3, ["path"]),
    ("reach/shell/min_m", 2, 3, ["shell"]), ("reach/shell/max_m", -1, 3, ["max_m"]),
    ("reach/box/min_m", [9, 9, 9], 3, ["box"]),
    ("reach/map", {"file": "none.npy", "origin_m": [0, 0, 0], "cell_m": 0.1}, 3, ["none.npy"]),
    ("view_cone/axis", [0, 0, 0], 3, ["axis"]), ("view_cone/half_angle_rad", -1, 3, ["half_angle_rad"]),
    ("view_cone/half_angle_rad", 10, 3, ["half_angle_rad"]), ("view_cone/half_angle_rad", 0.001, 4, []),
    ("camera_body/box/min_m", [1, 1, 1], 3, ["camera_body"]), ("camera_body", "d999", 3, ["camera_body"]),
    ("camera_body", {"sphere": {"radius_m": -1}}, 3, ["radius_m"]),
    ("camera_body", {"sphere": {"radius_m": 1e30}}, (3, 4), []),
    ("clearance_m", -1, 3, ["clearance_m"]), ("clearance_m", 1e30, (3, 4), []),
    ("floor_z_m", "low", 3, ["floor_z_m"]),
    ("floor_z_m", 1e300, (3, 4), []), ("knowledge_base", ["none.yaml"], 3, ["none.yaml"]),
    ("knowledge_base", 5, 3, ["knowledge_base"]),
    ("knowledge_base", [], 3, ["knowledge_base"]), ("knowledge_base", ["k.yaml", "k.yaml"], 0, []),
    ("knowledge_base", ["scene"], 3, ["scene"]), ("board", "none.yaml", 3, ["none.yaml"]),
    ("board", "cube.obj", 3, ["cube.obj"]),
    ("board", 7, 3, ["board"]), ("known_objects/0/name", "a", 3, ["a"]), ("known_objects/0/name", "", 3, ["name"]),
    ("known_objects/0/mesh", "none.obj", 3, ["none.obj"]), ("known_objects/0/mesh", "cell.yaml", 3, ["cell.yaml"]),
    ("known_objects/0/mesh", {"file": "cube.obj", "unit_m": 0}, 3, ["unit_m"]),
    ("known_objects/0/mesh", {"file": "cube.obj", "unit_m": 1e300}, 3, ["cube.obj"]),
    ("known_objects/0/mesh", {"file": "cube.obj", "unit_m": 1e-300}, (0, 3), []),
    ("known_objects/0/mesh", {"file": "cube.obj", "up": "w"}, 3, ["up"]),
    ("known_objects/0/mesh", "../" * 50 + "etc/passwd", 3, ["passwd"]),
    ("known_objects/0/mesh", "/dev/zero", 3, ["/dev/zero"]),
    ("known_objects/0/mesh", "cube.obj\0.stl", 3, ["cube.obj"]),
    ("known_objects/0/box", {"min_m": [0, 0, 0], "max_m": [1, 1, 1]}, 3, ["known_objects"]),
    ("known_objects/1/type", "green_cube", 3, ["green_cube"]), ("known_objects/1/type", "cube", 3, ["cube"]),
    ("known_objects/1/pose", {"rotation": {"w": 0, "x": 0, "y": 0, "z": 0}}, 3, ["rotation"]),
    ("known_objects/1/pose", {"rotation": {"w": 2, "x": 0, "y": 0, "z": 0}}, 3, ["rotation"]),
    ("known_objects/1/pose", {"translation_m": [1e300, 0, 0]}, 3, ["a"]),
    ("known_objects/1/pose", {"translation_m": [Raw(".nan"), 0, 0]}, 3, ["translation_m"]),
    ("known_objects/1/pose", {"matrix": [[1, 0, 0, 0]] * 4}, 3, ["matrix"]),
    ("known_objects/1/pose", {"matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 0], [0, 0, 0, 1]]}, 3, ["matrix"]),
    ("known_objects/1/pose", {"rpy_rad": [0, 0]}, 3, ["rpy_rad"]),
    ("known_objects/1/pose", {"rpy_rad": [1e300, 0, 0]}, (0, 3), []),
    ("known_objects/1/pose", {"look_at_m": [0, 0, 0], "translation_m": [0, 0, 0]}, 3, ["look_at_m"]),
    ("known_objects/1/pose", {"rpy_rad": [0, 0, 0], "rotation": {"w": 1, "x": 0, "y": 0, "z": 0}}, 3, ["rpy_rad"]),
    ("static_structures/0/box", {"min_m": [1, 1, 1], "max_m": [0, 0, 0]}, 3, ["box"]),
    ("static_structures/0", {"name": "wall"}, 3, ["static_structures"]),
    ("static_structures", {"name": "wall"}, 3, ["static_structures"]),
    ("static_structures/0/box/max_m", [1e9, 1e9, 1e9], (0, 3, 4), []),
    ("volume/occluders", "both", 3, ["occluders"]), ("volume/band_sigmas", -1, 3, ["band_sigmas"]),
    ("volume/anti_alias", "perhaps", 3, ["anti_alias"]), ("volume/noise", {"focal_px": 0}, 3, ["focal_px"]),
    ("plan", {"method": "best"}, 3, ["method"]), ("plan", {"views": {"most": 0}}, 3, ["most"]),
    ("plan", {"servo": {"iterations": -1}}, 3, ["iterations"]), ("cameras", [{"name": "x"}], 3, ["cameras"]),
]

BOARDS = [
    ("size_m", [0, 0], ["size_m"]), ("size_m", [0.5], ["size_m"]), ("thickness_m", -1, ["thickness_m"]),
    ("dictionary", "9X9_9", ["9X9_9"]), ("dictionary", "", ["dictionary"]), ("markers/0/id", 101, ["101"]),
    ("markers/0/id", 5000, ["5000"]), ("markers/0/id", -1, ["id"]), ("markers/0/size_m", 0, ["size_m"]),
    ("markers/0/at_m", [9, 9], ["at_m"]), ("markers/0/size_m", 0.5, ["marker"]),
    ("markers/0/at_m", [-0.225, -0.15, 0], ["at_m"]),
]

PATTERNS = [
    ({"charuco": {"columns": 1, "rows": 1, "square_m": 0.03, "marker_m": 0.02, "dictionary": "4X4_50"}}, "charuco"),
    ({"charuco": {"columns": 5, "rows": 7, "square_m": 0.03, "marker_m": 0.04, "dictionary": "4X4_50"}}, "marker_m"),
    ({"charuco": {"columns": 100000, "rows": 100000, "square_m": 0.03, "marker_m": 0.02, "dictionary": "4X4_50"}},
    "columns"),
    ({"grid": {"columns": 30, "rows": 30, "marker_m": 0.03, "gap_m": 0.01, "dictionary": "4X4_50"}}, "4X4_50"),
    ({"grid": {"columns": 2, "rows": 2, "marker_m": 0.03, "gap_m": -0.01, "dictionary": "4X4_50"}}, "gap_m"),
]


def cases():
    for i, (path, value, code, words) in enumerate(WRONG):
        shown = "removed" if value is REMOVED else text_of(value).replace("\n", "").replace("\0", "")[:40]
        yield Case(f"workcell/{i} {path.replace('/', '.')} {shown}", PLAN, code, tuple(words),
                   {"cell.yaml": text_of(changed(base.CELL, path, value))})
    for path, value, words in BOARDS:
        yield Case(f"board/{path.replace('/', '.')} {value}", PLAN, 3, ("board.yaml", *words),
                   {"board.yaml": text_of(changed(base.BOARD, path, value))})
    for i, (board, word) in enumerate(PATTERNS):
        yield Case(f"board/pattern {i}", PLAN, 3, ("board.yaml", word), {"board.yaml": text_of(board)})
