"""What other detectors saw: lines that are none, or of what cannot be."""

import json

from case import RECONSTRUCT, Case

MARKER = {"image": 0, "type": "aruco", "dictionary": "4X4_250", "value": 10,
    "corners_px": [[10, 10], [20, 10], [20, 20], [10, 20]]}
LABEL = {"image": 0, "type": "label", "value": "red", "point_m": [0, 0, 0.5], "sigma_m": 0.01}
POSE = {"image": 0, "type": "pose", "value": "red_cube", "T_cam_feature": {"rotation": {"w": 1, "x": 0, "y": 0,
    "z": 0}, "translation_m": [0, 0, 0.5]}, "sigma_m": 0.01}


def _line(one, **changes):
    return json.dumps({key: value for key, value in {**one, **changes}.items() if value is not None})


DAMAGED = {
    "no JSON": "marker 10\n", "cut off": _line(MARKER)[:40], "list": "[]", "null": "null", "text": '"a"',
    "two in a line": _line(MARKER) + _line(MARKER), "deep": "[" * 100000, "NUL": b"\0\0\0",
    "invalid UTF-8": b'{"image": "\xff"}',
    "over two lines": json.dumps(MARKER, indent=1), "second line": _line(MARKER) + "\n{",
    "a long line": '{"image": 0, "x": "' + "x" * 3000000 + '"}', "no image": _line(MARKER, image=None),
    "image -1": _line(MARKER, image=-1), "image 0.5": _line(MARKER, image=0.5),
    "image a text": _line(MARKER, image="0"), "image 7": _line(MARKER, image=7),
    "image 10^30": _line(MARKER, image=10**30), "no type": _line(MARKER, type=None),
    "no corners": _line(MARKER, corners_px=None), "3 corners": _line(MARKER, corners_px=MARKER["corners_px"][:3]),
    "corners 3D": _line(MARKER, corners_px=[[1, 2, 3]] * 4), 
    "dictionary unknown": _line(MARKER, dictionary="3X3_9"), "value -1": _line(MARKER, value=-1),
    "value 250": _line(MARKER, value=250), "value a text": _line(MARKER, value="10"),
    "point 2D": _line(LABEL, point_m=[0, 0]),
    "no value": _line(LABEL, value=None), "a key unknown": _line(LABEL, colour="red"),
    "rotation 0": _line(POSE, T_cam_feature={"rotation": {"w": 0, "x": 0, "y": 0, "z": 0},
    "translation_m": [0, 0, 1]}), 
    "point and pose": _line({**LABEL, **POSE}), "pointer": "version https://git-lfs.github.com/spec/v1\noid sha256:"
    + "0" * 64 + "\nsize 1\n",
}
# Of no use, and said so in world.json's list of what was not explained.
UNUSED = {"pose far away": (_line(POSE, T_cam_feature={"rotation": {"w": 1, "x": 0, "y": 0, "z": 0},
    "translation_m": [0, 0, 1e300]}), ""), "sigma 1e300": (_line(LABEL, sigma_m=1e300), ""),
    "sigma -1": (_line(LABEL, sigma_m=-1), "sigma_m is -1"), "sigma 0": (_line(LABEL, sigma_m=0), "sigma_m is 0"),
    "corners turned": (_line(MARKER, corners_px=MARKER["corners_px"][::-1]), "wrong order"),
    "corners at 1e300": (_line(MARKER, corners_px=[[1e300, 0], [20, 10], [20, 20], [10, 20]]), ""),
    "corners crossed": (_line(MARKER, corners_px=[[10, 10], [20, 20], [20, 10], [10, 20]]), "convex"),
    "corners alike": (_line(MARKER, corners_px=[[10, 10]] * 4), "is the same as"), }
ARGUMENTS = RECONSTRUCT + ["--cameras", "dataset", "--features", "seen.jsonl"]


def cases():
    for name, content in DAMAGED.items():
        yield Case("features/" + name, ARGUMENTS, 3, ("seen.jsonl",), {"seen.jsonl": content})
    for name, (content, word) in UNUSED.items():
        yield Case("features/" + name, ARGUMENTS, 0, (), {"seen.jsonl": content}, (word,))
    for name, content in {"marker": _line(MARKER), "label": _line(LABEL), "empty": "",
        "blank lines": "\n\n" + _line(LABEL) + "\n\n", "CRLF": _line(LABEL) + "\r\n"}.items():
        yield Case("features/right " + name, ARGUMENTS, 0, (), {"seen.jsonl": content})
    many = "".join(_line(LABEL, point_m=[i * 0.001, 0, 0.5]) + "\n" for i in range(300))
    yield Case("features/300 labels in one place", ARGUMENTS, 0, (), {"seen.jsonl": many})
    yield Case("features/missing", ARGUMENTS, 3, ("seen.jsonl",))
