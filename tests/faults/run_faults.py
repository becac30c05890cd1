#!/usr/bin/env python3
"""Lets allocations, writes and the like of `vantage plan` fail, one run for each, and checks that
every run ends with exit code 6, or as if nothing had happened; that no temporary file stays; and that
files are whole: as an earlier run left them, or new.

    tests/faults/run_faults.py --vantage FILE --library FILE [--most N] [--call NAME]

Of more than N calls (60) of a kind N are tried, the same ones every time.
"""

import argparse
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile

CALLS = ["malloc", "open", "write", "rename", "fsync", "pthread_create"]
CELL = """work_area: {min_m: [-0.1, -0.1, 0], max_m: [0.1, 0.1, 0.1]}
voxel_size_m: 0.02
known_objects:
  - {name: box, box: {min_m: [-0.03, -0.03, 0], max_m: [0.03, 0.03, 0.06]}}
"""
CAMERA = {"0": {"cam_K": [200, 0, 79.5, 0, 200, 59.5, 0, 0, 1], "width": 160, "height": 120,
                "cam_R_w2c": [1, 0, 0, 0, -0.5, -0.8660254037844386, 0, 0.8660254037844386, -0.5],
                "cam_t_w2c": [0, 46.41016151377539, 719.6152422706632], "depth_scale": 1.0}}


class Runs:
    def __init__(self, vantage, library, folder):
        self.vantage, self.library, self.folder = vantage, library, folder
        (folder / "scene").mkdir()
        (folder / "scene/scene_camera.json").write_text(json.dumps(CAMERA))
        (folder / "scene/cell.yaml").write_text(CELL)

    def run(self, fail, out):
        """Plans and saves into `out`. Returns the exit code, stderr, and the number of calls."""
        count = self.folder / "count"
        count.unlink(missing_ok=True)
        environment = dict(os.environ, LD_PRELOAD=str(self.library), VANTAGE_FAIL=fail,
                           VANTAGE_FAIL_FROM="cell.yaml", VANTAGE_FAIL_COUNT=str(count))
        command = [self.vantage, "plan", self.folder / "scene", "--workcell",
                   self.folder / "scene/cell.yaml", "--threads", "2", "--save-grid", "-o", out]
        result = subprocess.run(command, env=environment, capture_output=True, text=True,
                                errors="replace", timeout=120)
        calls = int(count.read_text()) if count.exists() else 0
        return result.returncode, result.stderr, calls


def faults_of(out, code, before):
    """What is wrong with a run's end and what it left; empty: nothing."""
    faults = []
    if code not in (0, 6):
        faults.append(f"exit code {code}")
    for path in out.iterdir():
        if path.name.startswith(".vantage-"):
            faults.append(f"{path.name} was left")
    for name in before:
        if not (out / name).is_file():
            faults.append(f"{name} is gone")
        elif name.endswith(".json"):
            try:
                json.loads((out / name).read_text())
            except ValueError:
                faults.append(f"{name} is not whole")
        elif (out / name).stat().st_size != before[name]:
            faults.append(f"{name} is not whole")
    return faults


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--vantage", required=True)
    parser.add_argument("--library", required=True)
    parser.add_argument("--most", type=int, default=60)
    parser.add_argument("--call", choices=CALLS, action="append")
    arguments = parser.parse_args()
    bad = 0
    with tempfile.TemporaryDirectory(prefix="vantage-faults-") as name:
        folder = pathlib.Path(name)
        runs = Runs(arguments.vantage, arguments.library, folder)
        out = folder / "out"
        for call in arguments.call or CALLS:
            code, err, total = runs.run(f"{call}:0", out)
            if code != 0 or total == 0:
                sys.exit(f"the run without a fault: exit code {code}, {total} calls of {call}\n{err}")
            before = {p.name: p.stat().st_size for p in out.iterdir()}
            numbers = list(range(1, total + 1))
            if total > arguments.most:
                numbers = sorted(random.Random(1).sample(numbers, arguments.most))
            ends = {}
            for number in numbers:
                for goes_on in ("", ":on"):
                    fail = f"{call}:{number}{goes_on}"
                    code, err, _ = runs.run(fail, out)
                    ends[code] = ends.get(code, 0) + 1
                    for fault in faults_of(out, code, before):
                        bad += 1
                        print(f"VANTAGE_FAIL={fail}: {fault}\n    {err.strip()[-300:]}")
                    for path in out.glob(".vantage-*"):
                        path.unlink()
            print(f"{call}: {total} calls, {len(numbers)} of them failed, once and from there on; "
                  f"exit codes {ends}", flush=True)
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
