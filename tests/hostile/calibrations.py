"""Calibrations by OpenCV, ROS and Kalibr: damaged, of another model, of another camera."""

import json

import base
from case import PLAN, RECONSTRUCT, Case

OPENCV = base.CALIBRATION
ROS = {"image_width": 64, "image_height": 48, "camera_name": "c",
    "camera_matrix": {"rows": 3, "cols": 3, "data": base.K}, "distortion_model": "plumb_bob",
       "distortion_coefficients": {"rows": 1, "cols": 5, "data": [0, 0, 0, 0, 0]}}
KALIBR = {"cam0": {"camera_model": "pinhole", "intrinsics": [52, 52, 31.5, 23.5], "distortion_model": "radtan",
    "distortion_coeffs": [0, 0, 0, 0], "resolution": [64, 48]}}
XML = (
    '<?xml version="1.0"?><opencv_storage><image_width>64</image_width><image_height>48'
        '</image_height><camera_matrix type_id="opencv-matrix"><rows>3</rows><cols>3</cols><dt>d</dt>'
       '<data>52. 0. 31.5 0. 52. 23.5 0. 0. 1.</data></camera_matrix>'
           '<distortion_coefficients type_id="opencv-matrix"><rows>1</rows><cols>4</cols><dt>d</dt>'
       '<data>0. 0. 0. 0.</data></distortion_coefficients></opencv_storage>')


def _ros(**changes):
    document = json.loads(json.dumps(ROS))
    document.update(changes)
    return json.dumps({key: value for key, value in document.items() if value is not None})


def _kalibr(**changes):
    return json.dumps({"cam0": {**KALIBR["cam0"], **changes}})


def _matrix(data, rows=3, cols=3):
    return {"rows": rows, "cols": cols, "data": data}


def _distortion(data, rows=1):
    return {"rows": rows, "cols": len(data), "data": data}


DAMAGED = {
    "empty": ("", "empty"), "deep": ("%YAML:1.0\n---\nx: " + "[" * 60000, "64 levels"),
    "binary": (bytes(range(256)), "camera.yml"), "no camera": ("a: 1\n", "camera_matrix"),
    "list": ("[1, 2]", "camera_matrix"),
    "XML cut off": (XML[:150], "XML"), "XML of something else": ("<a><b/></a>", "opencv_storage"),
    "XML deep": ("<opencv_storage>" + "<a>" * 50000, "XML"),
    "XML deep and closed": ("<opencv_storage>" + "<a>" * 5000 + "</a>" * 5000 + "</opencv_storage>", "64 levels"),
    "XML entities": ('<!DOCTYPE x [<!ENTITY a "b">]><opencv_storage>&a;</opencv_storage>', "camera_matrix"),
    "XML twice": (XML.replace("<image_height>48</image_height>", "<image_width>64</image_width>"), "twice"),
    "8 numbers": (_ros(camera_matrix=_matrix(base.K[:8])), "camera_matrix"),
    "2 x 2": (_ros(camera_matrix=_matrix(base.K[:4], 2, 2)), "3 × 3"),
    "no numbers": (_ros(camera_matrix=_matrix(["a"] * 9)), "finite"),
    "rows of -1": (_ros(camera_matrix=_matrix(base.K, -1)), "camera_matrix"),
    "rows of 10^9": (_ros(camera_matrix=_matrix(base.K, 10**9, 10**9)), "camera_matrix"),
    "data missing": (_ros(camera_matrix={"rows": 3, "cols": 3}), "data"),
    "matrix is a text": (_ros(camera_matrix="K"), "camera_matrix"),
    "rows of different length": (_ros(camera_matrix=[[52, 0, 31.5], [0, 52], [0, 0, 1]]), "length"),
    "focal length 0": (_ros(camera_matrix=_matrix([0] + base.K[1:])), "fx"),
    "focal length -52": (_ros(camera_matrix=_matrix([-52] + base.K[1:])), "fx"),
    "skew": (_ros(camera_matrix=_matrix([52, 3] + base.K[2:])), "skew"),
    "no K": (_ros(camera_matrix=_matrix(base.K[:8] + [2])), "expected [fx"),
    "1e300": (_ros(camera_matrix=_matrix([1e300] + base.K[1:])), "camera"),
    "3 coefficients": (_ros(distortion_coefficients=_distortion([0, 0, 0])), "4, 5 or 8"),
    "14 coefficients": (_ros(distortion_coefficients=_distortion([0] * 13 + [0.1])), "tilted"),
    "1000 coefficients": (_ros(distortion_coefficients=_distortion([0] * 1000)), "numbers"),
    "coefficients of 1e300": (_ros(distortion_coefficients=_distortion([1e300, 0, 0, 0, 0])), "distortion"),
    "coefficients that fold": (_ros(distortion_coefficients=_distortion([-5, 0, 0, 0, 0])), "distortion"),
    "model unknown": (_ros(distortion_model="thin_prism"), "thin_prism"),
    "model a number": (_ros(distortion_model=5), "distortion_model"),
    "inverse model": (_ros(distortion_model="inverse_brown_conrady",
    distortion_coefficients=_distortion([0.1, 0, 0, 0, 0])), "RealSense"),
    "fisheye of 5": (_ros(distortion_model="equidistant"), "four numbers"),
    "other resolution": (_ros(image_width=128, image_height=96), "128"),
    "width a text": (_ros(image_width="wide"), "image_width"), "width -1": (_ros(image_width=-1), "image_width"),
    "binning": (_ros(binning_x=2), "binning"), "Kalibr with 3 intrinsics": (_kalibr(intrinsics=[52, 52, 31.5]),
    "four numbers"), "Kalibr omni": (_kalibr(camera_model="omni"), "omni"),
    "Kalibr resolution": (_kalibr(resolution=[64]), "resolution"),
    "Kalibr nan": (_kalibr(intrinsics=[52, 52, 31.5, "nan"]), "intrinsics"),
    "two cameras": (json.dumps({"cam0": KALIBR["cam0"], "cam1": KALIBR["cam0"]}), "several cameras"),
    "flag 7": (OPENCV + "fisheye_model: 7\n", "fisheye_model"),
    "pointer": ("version https://git-lfs.github.com/spec/v1\noid sha256:" + "0" * 64 + "\nsize 1\n", "git lfs pull"),
}
ARGUMENTS = RECONSTRUCT + ["--cameras", "dataset", "--calibration"]


def cases():
    for name, (content, word) in DAMAGED.items():
        yield Case("calibration/" + name, ARGUMENTS + ["camera.yml"], 3, ("camera.yml", word),
            {"camera.yml": content})
    for name, content in {"OpenCV": OPENCV, "ROS": _ros(), "Kalibr": _kalibr(), "XML": XML,
        "fisheye": _ros(distortion_model="equidistant", distortion_coefficients=_distortion([0, 0, 0, 0]))}.items():
        yield Case("calibration/right " + name, ARGUMENTS + ["camera.yml"], 0, (), {"camera.yml": content})
    bent = {"camera.yml": _ros(distortion_coefficients=_distortion([-0.1, 0, 0, 0, 0]))}
    planned = PLAN + ["--calibration", "camera.yml"]
    yield Case("calibration/depth of a lens that distorts", planned, 0, ("warning", "--depth-lens calibrated"), bent)
    for kind in ("pinhole", "calibrated"):
        yield Case(f"calibration/depth of a lens, {kind}", planned + ["--depth-lens", kind], 0, (), bent)
    for name, value, word in (("missing", "none.yml", "none.yml"), ("no such camera", "camera.yml#cam7", "cam7"),
        ("too many", "camera.yml,camera.yml,camera.yml", "3 files for 2 images"),
                              ("ids and none", "0=camera.yml,camera.yml", "id"),
                              ("id twice", "0=camera.yml,0=camera.yml", "two calibrations"),
                              ("id missing", "0=camera.yml", "image 1"), ("a folder", "scene", "scene")):
        yield Case("calibration/" + name, ARGUMENTS + [value], 3, (word,))
