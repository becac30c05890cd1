#!/usr/bin/env python3
"""Gives vantage bad and awkward inputs of every kind, and checks that each run ends as it should: with
the right exit code, a message that names the file and what is wrong with it, within 2 s of computing
and 1 GiB of memory, and with nothing half-written left.

    tests/hostile/run_hostile.py --vantage FILE [--only EXPRESSION] [--every N] [--jobs N] [--keep FOLDER] [--verbose]

The inputs are made here, case by case, from the small recording of base.py.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time

import base
import calibrations
import commands
import depth_images
import detections
import documents
import imports
import knowledge
import meshes
import pictures
import plans
import recordings
import workcells

MAX_CPU_S = 2.0
MAX_RSS_KIB = 1024 * 1024
MAX_WALL_S = 120  # of a machine that does much else; what hangs is ended then
ROOMS = [documents, workcells, recordings, depth_images, pictures, meshes, calibrations, detections, plans,
         knowledge, imports, commands]


def all_cases():
    cases = [case for room in ROOMS for case in room.cases()]
    names = [case.name for case in cases]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        sys.exit(f"two cases have one name: {twice}")
    return cases


def write_files(folder, files):
    for name, content in files.items():
        path = folder / name
        if content is None:
            path.unlink(missing_ok=True)
            continue
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content.encode() if isinstance(content, str) else content)


class Outcome:
    def __init__(self, status, usage, out, err, killed):
        self.signal = os.WTERMSIG(status) if os.WIFSIGNALED(status) else None
        self.code = os.WEXITSTATUS(status) if os.WIFEXITED(status) else None
        self.cpu_s = usage.ru_utime + usage.ru_stime  # of its children, too
        self.rss_kib = usage.ru_maxrss
        self.out, self.err, self.killed = out, err, killed


def limit():
    resource.setrlimit(resource.RLIMIT_CPU, (30, 30))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run(vantage, case, folder):
    """In a file each, as a pipe that nobody reads would hold it up."""
    with open(folder / ".stdout", "wb") as out, open(folder / ".stderr", "wb") as err:
        process = subprocess.Popen([vantage, *case.arguments], cwd=folder, stdin=subprocess.DEVNULL, stdout=out,
                                   stderr=err, preexec_fn=limit, start_new_session=True)
        killed = threading.Event()

        def kill():
            killed.set()
            os.killpg(process.pid, signal.SIGKILL)

        timer = threading.Timer(MAX_WALL_S, kill)
        timer.start()
        _, status, usage = os.wait4(process.pid, 0)
        timer.cancel()
        process.returncode = 0  # it was waited for
    return Outcome(status, usage, (folder / ".stdout").read_bytes(), (folder / ".stderr").read_bytes(),
        killed.is_set())


def results_in(folder):
    return {path for path in (folder / "out").rglob("*") if path.is_file()} if (folder / "out").is_dir() else set()


def left_behind(folder, code, before):
    """What is wrong with the files of a run; those in `before` were there already."""
    faults = []
    for path in folder.rglob("*"):
        if path.name.startswith(".vantage-"):
            faults.append(f"{path.relative_to(folder)} was left")
    results = sorted(results_in(folder) - before)
    if code in (2, 3, 6) and results:
        faults.append(f"failed, and wrote {results[0].relative_to(folder)} all the same")
    for path in results:
        if path.suffix == ".json":
            try:
                json.loads(path.read_text())
            except ValueError:
                faults.append(f"{path.relative_to(folder)} is not whole")
    return faults


def faults_of(case, outcome, folder, before):
    faults = []
    if outcome.killed:
        return [f"not done after {MAX_WALL_S} s"]
    if outcome.signal is not None:
        return [f"ended by signal {outcome.signal}"]
    if outcome.code not in case.codes:
        faults.append(f"exit code {outcome.code}, expected {case.code}")
    if outcome.cpu_s > MAX_CPU_S:
        faults.append(f"took {outcome.cpu_s:.1f} s of computing")
    if outcome.rss_kib > MAX_RSS_KIB:
        faults.append(f"took {outcome.rss_kib / 1024:.0f} MiB")
    text = outcome.err.decode(errors="replace")
    for word in case.words:
        if word not in text:
            faults.append(f"the message does not say \"{word}\"")
    if any(byte < 32 and byte not in b"\n\t" for byte in outcome.err):
        faults.append("raw bytes in the message")
    if len(outcome.err) > 20000:
        faults.append(f"a message of {len(outcome.err)} bytes")
    written = "".join(path.read_text() for path in sorted((folder / "out").glob("*.json"))) if case.written else ""
    for word in case.written:
        if word not in written:
            faults.append(f"the result does not say \"{word}\"")
    return faults + left_behind(folder, outcome.code, before)


def check(vantage, case, parent, files, verbose):
    folder = pathlib.Path(parent) / case.name.replace("/", "-")
    folder.mkdir()
    write_files(folder, {**files, **case.files} if case.arguments[:1] != ["import"] else case.files)
    if case.prepare:
        case.prepare(folder)
    before = results_in(folder)
    outcome = run(vantage, case, folder)
    faults = faults_of(case, outcome, folder, before)
    message = outcome.err.decode(errors="replace").strip()
    if faults or verbose:
        print(f"{case.name}: {'; '.join(faults) if faults else 'right'}"
              f" [{outcome.code}, {outcome.cpu_s:.2f} s, {outcome.rss_kib // 1024} MiB]\n    {message[:500]}",
              flush=True)
    return not faults, outcome


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--vantage", required=True, type=lambda name: str(pathlib.Path(name).resolve()))
    parser.add_argument("--only", help="cases whose names match this expression")
    parser.add_argument("--every", type=int, default=1, help="of the cases, each of so many: a sample")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--keep", help="a new folder for the inputs, which stay there")
    parser.add_argument("--verbose", action="store_true", help="show every message")
    arguments = parser.parse_args()
    cases = [case for case in all_cases() if not arguments.only or re.search(arguments.only, case.name)]
    cases = cases[::arguments.every]
    start = time.time()
    files = base.files()
    with tempfile.TemporaryDirectory(prefix="vantage-hostile-") as temporary:
        parent = arguments.keep or temporary
        pathlib.Path(parent).mkdir(exist_ok=True)
        with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
            results = list(pool.map(lambda case: check(arguments.vantage, case, parent, files, arguments.verbose),
                cases))
    bad = sum(not right for right, _ in results)
    outcomes = [outcome for _, outcome in results]
    print(
        f"{len(cases)} inputs, {bad} of them wrong; at most {max(o.cpu_s for o in outcomes):.2f} s of computing and "
          f"{max(o.rss_kib for o in outcomes) // 1024} MiB each; {sum(o.cpu_s for o in outcomes):.0f} s of computing "
          f"in {time.time() - start:.0f} s")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
