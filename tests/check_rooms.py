#!/usr/bin/env python3
"""Checks the rooms: no folder of sources has more than 25 files, and includes between folders make no
circle. `--draw` prints the graph of a module's rooms as Mermaid for docs/architecture.md.

    tests/check_rooms.py [--draw MODULE]

A public header belongs to the room of its .cpp; one without a .cpp belongs to none.
"""

import argparse
import collections
import pathlib
import re
import sys

MAX_FILES = 25
ROOT = pathlib.Path(__file__).resolve().parent.parent
# Where a module's sources are, and how its public headers are included.
MODULES = {
    "raycore": ("raycore/src", "vantage/raycore/"),
    "volume": ("volume/src", "vantage/volume/"),
    "reconstruction": ("reconstruction/src", "vantage/reconstruction/"),
    "planner": ("planner/src", "vantage/planner/"),
    "apps": ("apps", None),
}
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)


def files_in(folder):
    return sorted(p for p in (ROOT / folder).rglob("*") if p.suffix in (".cpp", ".hpp"))


class Rooms:
    """The rooms of one module: folders, as paths relative to the module's sources."""

    def __init__(self, module):
        self.folder, self.public = MODULES[module]
        self.base = ROOT / self.folder
        self.files = files_in(self.folder)
        self.of_stem = {p.stem: self.room(p) for p in self.files if p.suffix == ".cpp"}
        self.arrows = collections.defaultdict(list)  # (from, to) -> includes
        for path in self.files:
            self.add_arrows(path, self.room(path))
        if self.public:
            for path in files_in(f"{module}/include"):
                if path.stem in self.of_stem:
                    self.add_arrows(path, self.of_stem[path.stem])

    def room(self, path):
        return str(path.parent.relative_to(self.base))

    def target(self, include):
        if self.public and include.startswith(self.public):
            return self.of_stem.get(pathlib.PurePath(include).stem)
        path = self.base / include
        return self.room(path) if path.is_file() else None

    def add_arrows(self, path, room):
        for include in INCLUDE.findall(path.read_text()):
            target = self.target(include)
            if target is not None and target != room:
                self.arrows[room, target].append(f"{path.relative_to(ROOT)} includes {include}")

    def crowded(self):
        counts = collections.Counter(self.room(p) for p in self.files)
        return [f"{self.folder}/{room}: {n} files; expected at most {MAX_FILES}"
                for room, n in sorted(counts.items()) if n > MAX_FILES]

    def circles(self):
        """The includes of every arrow that lies on a circle."""
        after = collections.defaultdict(set)
        for a, b in self.arrows:
            after[a].add(b)

        def reach(start):
            seen, todo = set(), [start]
            while todo:
                for room in after[todo.pop()] - seen:
                    seen.add(room)
                    todo.append(room)
            return seen

        return [f"{a} -> {b} is part of a circle: {include}" for (a, b), includes
                in sorted(self.arrows.items()) if a in reach(b) for include in includes]

    def names(self):
        return sorted({self.room(path) for path in self.files})

    def draw(self):
        """Mermaid; an arrow that others imply is left out."""
        after = collections.defaultdict(set)
        for a, b in self.arrows:
            after[a].add(b)

        def reaches(a, b, direct):
            return any((c == b and not direct) or reaches(c, b, False) for c in after[a]
                       if not (direct and c == b))

        def node(room):  # the room "." holds main.cpp
            return f'{room.replace("/", "_")}["{room}"]' if room != "." else 'main["main.cpp"]'

        lines = ["```mermaid", "graph TD"]
        for a, b in sorted(self.arrows):
            if not reaches(a, b, True):
                lines.append(f"  {node(a)} --> {node(b)}")
        return "\n".join(lines + ["```"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--draw", choices=MODULES, metavar="MODULE")
    arguments = parser.parse_args()
    if arguments.draw:
        print(Rooms(arguments.draw).draw())
        return 0
    complaints = []
    for module in MODULES:
        rooms = Rooms(module)
        complaints += rooms.crowded() + rooms.circles()
    print("\n".join(complaints) or f"{len(MODULES)} modules: no circle, no room of more than "
          f"{MAX_FILES} files")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
