#!/usr/bin/env python3
"""Checks README.md and docs/ against the repository and the built command.

    tests/check_docs.py [--vantage COMMAND]        links, names, options, code, messages, rooms, headers
    tests/check_docs.py --vantage COMMAND --run    runs the `sh` blocks that follow <!-- run -->

Without --vantage the command's verbs and options are not checked.
"""

import argparse
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import check_rooms

ROOT = check_rooms.ROOT
PAGES = [ROOT / name for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md")] + sorted(
    (ROOT / "docs").rglob("*.md"))
LIBRARIES = ("raycore", "volume", "reconstruction", "planner")
FENCE = re.compile(r"(?:<!-- *([^\n]*?) *-->\n)?```(\S*)[^\n]*\n(.*?)```", re.DOTALL)
LINK = re.compile(r"\]\(([^)\s]+)\)")
LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
MADE = ("build/", "out/")  # what commands write


class Page:
    """One page: its text, its fenced blocks as (comment, language, text), and the rest as prose."""

    def __init__(self, path):
        self.path = path
        self.text = path.read_text()
        self.blocks = [(m[1] or "", m[2], m[3]) for m in FENCE.finditer(self.text)]
        self.prose = FENCE.sub("", self.text)
        self.code = [" ".join(c.split()) for c in re.findall(r"`([^`]+)`", self.prose)]

    def says(self, text):
        return f"{self.path.relative_to(ROOT)}: {text}"


def sources(*folders):
    for folder in folders:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in (".cpp", ".hpp", ".in", ".sh", ".py"):
                yield path


def anchors(path):
    """The names by which headings of a page can be linked."""
    headings = re.findall(r"^#+ (.*)$", FENCE.sub("", path.read_text()), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", h.lower()).strip().replace(" ", "-") for h in headings}


def check_links(page):
    for link in LINK.findall(page.prose):
        if re.match(r"[a-z]+:", link):
            continue
        path, _, anchor = link.partition("#")
        target = (page.path.parent / path).resolve() if path else page.path
        if not target.exists():
            yield page.says(f"the link {link} leads nowhere")
        elif anchor and anchor not in anchors(target):
            yield page.says(f"the link {link} names no heading; there are {sorted(anchors(target))}")


def check_compiled(page):
    for comment, _, text in page.blocks:
        if not comment.startswith("compiled:"):
            continue
        example = comment.removeprefix("compiled:").strip()
        if not (ROOT / example).is_file() or text not in (ROOT / example).read_text():
            yield page.says(f"a block is not part of {example}:\n{text}")


class Names:
    """Words that sources and scripts use, to tell whether a name in the prose exists."""

    def __init__(self):
        texts = [p.read_text() for p in sources(*LIBRARIES, "apps", "tests", "docs", ".ci")]
        texts += [p.read_text() for p in (ROOT / "cmake").iterdir()]
        texts += [(ROOT / name).read_text() for name in ("CMakeLists.txt", "CMakePresets.json")]
        self.words = set(re.findall(r"\w+", " ".join(texts)))
        self.options = set(re.findall(r"--[a-z][a-z0-9-]+", " ".join(texts)))
        # Neighbouring literals are one text.
        joined = (re.sub(r'"\s*\n\s*"', "", text) for text in texts)
        self.messages = "\n".join(part for text in joined for part in LITERAL.findall(text))
        self.messages += "".join(p.read_text() for p in (ROOT / "apps").glob("*.sh"))


def check_names(page, names):
    """Paths, types and options in the prose's code spans."""
    folders = "|".join(LIBRARIES + ("apps", "tests", "assets", "docs", "cmake", r"\.ci"))
    for code in page.code:
        if re.fullmatch(rf"({folders})/[a-z0-9_./-]*", code) and not (ROOT / code).exists():
            yield page.says(f"there is no {code}")
        if re.fullmatch(r"vantage/[\w/]+\.hpp", code) and page.path.name != "CHANGELOG.md":
            if not any((ROOT / module / "include" / code).is_file() for module in LIBRARIES):
                yield page.says(f"there is no header {code}")
        type_name = re.fullmatch(r"(?:vantage::)?([A-Z][a-z]+[A-Z]\w+)(\(.*\))?", code)
        if type_name and type_name[1] not in names.words and page.path.name != "CHANGELOG.md":
            yield page.says(f"no source has the name {type_name[1]}")
        for option in re.findall(r"(?<!\S)--[a-z][a-z0-9-]+", code):
            if option not in names.options and not code.startswith("cmake "):
                yield page.says(f"nothing has the option {option}")


def check_messages(page, names):
    """What the first column of a table of messages quotes has to be part of a text in the sources."""
    in_table = False
    for line in page.prose.splitlines():
        cell = re.match(r"\| (.*?) \|", line)
        if re.match(r"\| .*message", line):
            in_table = True
        elif not line.startswith("|"):
            in_table = False
        elif in_table and cell:
            for message in re.findall(r"`([^`]+)`", cell[1]):
                if message.lower() not in names.messages.lower() and ".json" not in message:
                    yield page.says(f"no source says \"{message}\"")


def commands(text):
    """The command lines of an sh block, each as a list of words."""
    for line in text.replace("\\\n", " ").splitlines():
        for part in line.split("&&"):
            words = shlex.split(part, comments=True)
            while words and re.fullmatch(r"[A-Z_]+=.*", words[0]):
                words = words[1:]
            if words and words[0] not in ("cd", "export", "sudo", "cmake", "diff", "jq"):
                yield words


class Command:
    """The built command's verbs and options, as its help has them."""

    def __init__(self, program):
        self.program = program
        self.helps = {}

    def help(self, *verbs):
        if verbs not in self.helps:
            texts = [subprocess.run([self.program, *verbs, flag], capture_output=True, text=True)
                     for flag in ("--help", "--help-all")]
            self.helps[verbs] = "\n".join(t.stdout for t in texts if t.returncode == 0)
        return self.helps[verbs]

    def complaints(self, words):
        verbs = []
        for word in words:
            listed = re.search(rf"^\s+{re.escape(word)}(\s|$)", self.help(*verbs), re.MULTILINE)
            if word.startswith("-") or not listed or (
                    self.help(*verbs, word) == self.help(*verbs)):
                break
            verbs.append(word)
        if not verbs and not words[0].startswith("-"):
            return [f"vantage has no verb {words[0]}"]
        known = set(re.findall(r"--?[a-z][a-z0-9-]*", self.help(*verbs)))
        used = [w.split("=")[0] for w in words if re.match(r"--?[a-z]", w)]
        return [f"vantage {' '.join(verbs)} has no option {w}" for w in used if w not in known]


def check_commands(page, command):
    blocks = [text for _, language, text in page.blocks if language == "sh"]
    # Captions name the command that made a picture.
    blocks += [code for code in page.code if re.match(r"vantage [a-z]+ [^…]", code)
               and "::" not in code and "VERB" not in code]
    for words in (w for text in blocks for w in commands(text)):
        program = words[0]
        if program == "vantage" or program.endswith("/vantage"):
            if command and len(words) > 1:
                yield from (page.says(c) for c in command.complaints(words[1:]))
        elif "/bench/" in program and program.startswith("build/"):
            name = program.split("/")[-1]
            if not re.search(rf"\b{name}\b", (ROOT / "tests/bench/CMakeLists.txt").read_text()):
                yield page.says(f"there is no benchmark {name}")
        elif not program.startswith(MADE) and not (ROOT / program).is_file():
            yield page.says(f"there is no command {program}")


def check_api():
    """Every public header is on its module's page, the advanced ones in their part."""
    for module in LIBRARIES:
        page = ROOT / f"docs/api/{module}.md"
        everyday, _, advanced = page.read_text().partition("## Advanced headers")
        include = ROOT / module / "include"
        public = {str(p.relative_to(include)) for p in include.rglob("*.hpp")
                  if "detail" not in p.parts}
        for part, wanted in ((everyday, {h for h in public if "/advanced/" not in h}),
                             (advanced, {h for h in public if "/advanced/" in h})):
            shown = set(re.findall(r"\{doxygenfile\} (\S+)", part))
            for header in sorted(shown ^ wanted):
                what = "is missing" if header in wanted else "is no such header"
                yield f"docs/api/{module}.md: {header} {what}"


def check_rooms_drawn():
    text = (ROOT / "docs/architecture.md").read_text()
    for module in check_rooms.MODULES:
        rooms = check_rooms.Rooms(module)
        if rooms.draw() not in text:
            yield f"docs/architecture.md: expected what tests/check_rooms.py --draw {module} prints"
        yield from (f"docs/architecture.md: no sentence on the room {name} of {module}"
                    for name in rooms.names() if f"| `{name}` |" not in text)


def check_citation():
    text = (ROOT / "CITATION.cff").read_text()
    version = re.search(r"project\(vantage VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
    for line in ("cff-version: 1.2.0", f"version: {version}", "title: vantage", "authors:"):
        if not re.search(rf"^{re.escape(line)}$", text, re.MULTILINE):
            yield f"CITATION.cff: expected the line \"{line}\""


def check_examples():
    for path in sorted((ROOT / "apps/examples").glob("*.cpp")):
        lines = len(path.read_text().splitlines())
        if lines > 60:
            yield f"{path.relative_to(ROOT)}: {lines} lines; expected at most 60"


def run(pages, program):
    """Runs the pages' commands where only the assets are, and shows how long each block took."""
    environment = dict(os.environ, PATH=f"{pathlib.Path(program).parent}:{os.environ['PATH']}")
    count = 0
    for page in pages:
        blocks = [text for comment, _, text in page.blocks if comment == "run"]
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "assets").symlink_to(ROOT / "assets")
            for text in blocks:
                count += 1
                done = subprocess.run(["bash", "-euo", "pipefail", "-c", text], cwd=folder,
                                      env=environment, capture_output=True, text=True)
                if done.returncode != 0:
                    return [page.says(f"ended with {done.returncode}:\n{text}{done.stderr}")]
    print(f"{count} blocks of commands ran")
    return [] if count else ["no page has a block to run"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--vantage", metavar="COMMAND", help="the built command")
    parser.add_argument("--run", action="store_true", help="run the marked blocks")
    arguments = parser.parse_args()
    pages = [Page(path) for path in PAGES]
    if arguments.run:
        complaints = run(pages, arguments.vantage or parser.error("--run needs --vantage"))
    else:
        names = Names()
        command = Command(arguments.vantage) if arguments.vantage else None
        complaints = [*check_api(), *check_rooms_drawn(), *check_citation(), *check_examples()]
        for page in pages:
            complaints += [*check_links(page), *check_compiled(page), *check_names(page, names),
                           *check_messages(page, names), *check_commands(page, command)]
    print("\n".join(complaints) or f"{len(pages)} pages: nothing to complain about")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
