#!/usr/bin/env python3
"""Checks what the linker made: executables that load anywhere, nothing writable that need not be, stack
guards and checked string functions in the command, and libraries that show nothing but vantage's.

    tests/check_hardening.py --executable FILE... --library FILE...
"""

import argparse
import re
import subprocess
import sys


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def faults_of_any(path):
    segments, dynamic = run("readelf", "-lW", path), run("readelf", "-dW", path)
    if "GNU_RELRO" not in segments or not re.search(r"BIND_NOW|\bNOW\b", dynamic):
        yield "its relocations stay writable: link with -z relro -z now"
    if re.search(r"GNU_STACK\s.*RWE", segments):
        yield "its stack is executable"
    if "DYN (" not in run("readelf", "-hW", path):
        yield "it is no position-independent executable or library"


def faults_of_executable(path):
    symbols = run("nm", "-D", path)
    if "__stack_chk_fail" not in symbols:
        yield "it has no stack guards: compile with -fstack-protector-strong"
    if not re.search(r"__\w+_chk\b", symbols.replace("__stack_chk_fail", "")):
        yield "no function of libc is checked: compile with -D_FORTIFY_SOURCE"


def faults_of_library(path):
    shown = [line.split()[-1] for line in run("nm", "-D", "--defined-only", path).splitlines()]
    foreign = [s for s in shown if not re.match(r"_Z(N|NK|T[ISVT]N|T[hv].*_NK?)7vantage", s)]
    if foreign:
        yield f"it shows {len(foreign)} symbols that are not vantage's, e.g. {foreign[0]}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--executable", nargs="+", default=[])
    parser.add_argument("--library", nargs="+", default=[])
    arguments = parser.parse_args()
    faults = [(path, fault) for path in arguments.executable + arguments.library
              for fault in faults_of_any(path)]
    faults += [(path, fault) for path in arguments.executable for fault in faults_of_executable(path)]
    faults += [(path, fault) for path in arguments.library for fault in faults_of_library(path)]
    for path, fault in faults:
        print(f"{path}: {fault}")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
