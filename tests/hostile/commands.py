"""Command lines that are wrong, and places where nothing can be written."""


from case import PLAN, RECONSTRUCT, Case

AREA = ["--work-area", "-0.12", "-0.1", "0", "0.12", "0.1", "0.1"]
WRONG = {
    "nothing": [], "no verb": ["paln", "scene"], "an empty verb": [""], "no dataset": ["plan"],
    "two datasets": ["plan", "scene", "scene"] + AREA, "an option unknown": PLAN + ["--colour", "red"],
    "an option cut off": PLAN + ["--voxel-size"], "an empty file": ["plan", "scene", "--workcell", "", "-o", "out"],
    "an empty folder": ["plan", "scene", "--workcell", "cell.yaml", "-o", ""],
    "an empty dataset": ["plan", ""] + AREA, "no area": ["plan", "scene", "-o", "out"],
    "five numbers": ["plan", "scene"] + AREA[:-1], "words for numbers": ["plan", "scene", "--work-area", "a", "b",
    "c", "d", "e", "f"],
    "voxels of 0": PLAN + ["--voxel-size", "0"],
    "voxels of -1": PLAN + ["--voxel-size", "-1"], "voxels of 1e999": PLAN + ["--voxel-size", "1e999"],
    "voxels of 0x1": PLAN + ["--voxel-size", "0x1"], "voxels of nothing": PLAN + ["--voxel-size", ""],
    "voxels with a unit": PLAN + ["--voxel-size", "2cm"],
    "voxels twice": PLAN + ["--voxel-size", "0.02", "--voxel-size", "0.03"],
    "method unknown": PLAN + ["--method", "best"], "views of 0": PLAN + ["--views", "0"],
    "views of 1.5": PLAN + ["--views", "1.5"], "views of 10^20": PLAN + ["--views", "100000000000000000000"],
    "threads of -1": PLAN + ["--threads", "-1"], "threads of 9999": PLAN + ["--threads", "9999"],
    "deadline of -1": PLAN + ["--deadline-ms", "-1"], "deadline of nan": PLAN + ["--deadline-ms", "nan"],
    "images of words": PLAN + ["--images", "a,b"], "radii of 0": PLAN + ["--radii", "0"],
    "count of 0": PLAN + ["--count", "0"], "rings of 1000": PLAN + ["--rings", "1000"],
    "idle from": PLAN + ["--from", "0", "0", "0"], "idle travel weight": PLAN + ["--travel-weight", "1"],
    "idle gain": PLAN + ["--least-gain", "1"], "idle mesh": PLAN + ["--mesh-open", "0.01"],
    "pictures without a folder": PLAN[:4] + ["--pictures"], "explain words": PLAN + ["--explain", "best"],
    "camera body unknown": PLAN + ["--camera-body", "d999"],
    "reconstruct by magic": RECONSTRUCT + ["--method", "magic"],
    "cameras by magic": RECONSTRUCT + ["--cameras", "magic"],
    "simulate without a folder": ["simulate", "cell.yaml"], "render without a picture": ["render", "cell.yaml"],
    "evaluate nothing": ["evaluate"], "evaluate something": ["evaluate", "everything"],
    "an argument of 100,000 letters": PLAN + ["--method", "x" * 100000],
    "raw bytes": PLAN + ["--method", "\x1b[31mred"],
}
BAD = {
    "nan": (["plan", "scene"] + AREA[:-1] + ["nan"], "--work-area"),
    "area inside out": (["plan", "scene", "--work-area", "0", "0", "0", "1", "1", "0"], "--work-area"),
    "depth range inside out": (PLAN + ["--depth-range", "3", "1"], "--depth-range"),
    "image 9": (PLAN + ["--images", "9"], "9"), "image -1": (PLAN + ["--images", "-1"], "-1"),
    "candidate 99": (PLAN + ["--explain", "99"], "--explain"),
    "candidates nowhere": (PLAN + ["--candidates", "none.yaml"], "none.yaml"),
    "objects nowhere": (PLAN + ["--objects", "none.json"], "--objects"),
    "dataset nowhere": (["plan", "nowhere"] + AREA, "nowhere"),
    "dataset is a file": (["plan", "cell.yaml"] + AREA, "cell.yaml"),
    "workcell is a picture": (["plan", "scene", "--workcell", "scene/rgb/000000.png"], "000000.png"),
    "render without cameras": (["render", "cell.yaml", "-o", "a.png"], "cell.yaml"),
    "simulate without cameras": (["simulate", "cell.yaml", "-o", "out"], "cell.yaml"),
    "a name with line breaks": (["plan", "no\nwhere\x1b[31m"] + AREA, "no"),
    "a name of 5,000 letters": (["plan", "n" * 5000] + AREA, "nnn"),
    "no UTF-8": (["plan", b"no\xff\xfe"] + AREA, "no"),
}


def _file_in_the_way(folder):
    (folder / "out").write_text("in the way")


def _plan_is_a_folder(folder):
    (folder / "out/plan.json").mkdir(parents=True)


def _link_to_nowhere(folder):
    (folder / "out").symlink_to("nowhere/at/all")


def _device(folder):
    (folder / "out").symlink_to("/dev/null")


def cases():
    for name, arguments in WRONG.items():
        yield Case("command/" + name, arguments, 2)
    for name, (arguments, word) in BAD.items():
        yield Case("command/" + name, arguments, 3, (word,))
    yield Case("command/too many voxels", PLAN + ["--voxel-size", "0.00001"], 6, ("voxel",))
    yield Case("command/an endless area", ["plan", "scene", "--work-area", "-1e300", "-1e300", "-1e300", "1e300",
        "1e300", "1e300"], (3, 6), ("--work-area",))
    yield Case("command/no time", PLAN + ["--deadline-ms", "0.001"], 5)
    yield Case("command/nothing reachable", PLAN + ["--clearance", "100"], 4)
    yield Case("output/a file in the way", PLAN, 3, ("out",), prepare=_file_in_the_way)
    yield Case("output/below a file", PLAN[:5] + ["cell.yaml/out"], 3, ("cell.yaml/out",))
    yield Case("output/a folder in the way", PLAN, 3, ("plan.json",), prepare=_plan_is_a_folder)
    yield Case("output/a link to nowhere", PLAN, 3, ("out",), prepare=_link_to_nowhere)
    yield Case("output/a device", PLAN, 3, ("out",), prepare=_device)
    yield Case("output/below /proc", PLAN[:5] + ["/proc/vantage"], 3, ("/proc/vantage",))
    yield Case("output/a long name", PLAN[:5] + ["o" * 5000], 3, ("ooo",))
    yield Case("output/a picture of no format", ["render", "cell.yaml", "-o", "a.xyz"], (2, 3), ())
