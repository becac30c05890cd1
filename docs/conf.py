"""Sphinx: the pages in this folder, and the API from Doxygen's XML. docs/build.sh runs it."""

import os
import pathlib
import re

DOCS = pathlib.Path(__file__).resolve().parent
ROOT = DOCS.parent

project = "vantage"
author = "The vantage authors"
copyright = author
release = re.search(r"project\(vantage VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]

extensions = ["breathe", "myst_parser", "sphinx.ext.graphviz"]
source_suffix = {".md": "markdown"}
exclude_patterns = ["Doxyfile", "build.sh"]
html_theme = "furo"
html_title = f"vantage {release}"
html_show_sphinx = False
myst_heading_anchors = 3
graphviz_output_format = "svg"
primary_domain = "cpp"
highlight_language = "none"

breathe_projects = {"vantage": os.environ["VANTAGE_DOXYGEN_XML"]}
breathe_default_project = "vantage"
breathe_default_members = ("members",)
breathe_show_include = False

# Pages of the site that stand elsewhere in the repository.
PAGES = {"../README.md": "index.md", "../CHANGELOG.md": "changelog.md",
         "../CONTRIBUTING.md": "contributing.md"}
LINK = re.compile(r"(?<!!)\[([^\]]*)\]\((\.\./[^)#]*)(#[^)]*)?\)")
MERMAID = re.compile(r"```mermaid\ngraph TD\n(.*?)```", re.DOTALL)


def in_site(match):
    """A link out of docs/: to the page of the site, if there is one, else to a copy of the file."""
    text, path, anchor = match[1], match[2], match[3] or ""
    if path in PAGES:
        return f"[{text}]({PAGES[path]}{anchor})"
    return match[0] if (DOCS / path).is_file() else text


def as_dot(match):
    """A Mermaid graph as check_rooms.py draws it, for Graphviz."""
    arrows = re.findall(r'\["(.*?)"\] --> \w*\.?\w*\["(.*?)"\]', match[1])
    lines = [f'  "{a}" -> "{b}"' for a, b in arrows]
    return ('```{graphviz}\ndigraph {\n  rankdir=TB; bgcolor=transparent\n'
            '  node [shape=box, style="rounded,filled", fillcolor=white, fontname="sans-serif", '
            'fontsize=11]\n' + "\n".join(lines) + "\n}\n```")


def from_root(page):
    """A page of the repository's root, with its links as seen from docs/."""
    text = (ROOT / page).read_text()
    return re.sub(r"\]\((?!https?:|#)([^)]*)\)", lambda m: "](" + (
        m[1].removeprefix("docs/") if m[1].startswith("docs/") else "../" + m[1]) + ")", text)


def adapt(_app, name, source):
    if name in ("changelog", "contributing"):
        source[0] = from_root(f"{name.upper()}.md")
    source[0] = MERMAID.sub(as_dot, LINK.sub(in_site, source[0]))


def setup(app):
    app.connect("source-read", adapt)
