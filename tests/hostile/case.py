"""One bad or awkward input: what lies in its folder, the command that reads it, and what is right."""

import dataclasses
import json
import typing


@dataclasses.dataclass
class Case:
    name: str
    arguments: list  # of vantage, which runs in the case's folder
    code: object  # the expected exit code, or a tuple of those that are right
    words: tuple = ()  # what the messages hold: the file's name, and what is wrong with it
    files: dict = dataclasses.field(default_factory=dict)  # path: text, bytes, None (remove it)
    written: tuple = ()  # what the result says, where that is the place for it
    prepare: typing.Optional[typing.Callable] = None  # of the folder, for what is no plain file

    @property
    def codes(self):
        return self.code if isinstance(self.code, tuple) else (self.code,)


PLAN = ["plan", "scene", "--workcell", "cell.yaml", "-o", "out", "--servo", "0", "--polish", "0"]
RECONSTRUCT = ["reconstruct", "scene", "--workcell", "cell.yaml", "-o", "out"]


def changed(document, path, value):
    """A copy of nested lists and dicts with another value at "a/0/b"; REMOVED takes it away."""
    copy = json.loads(json.dumps(document))
    *outer, last = path.split("/")
    at = copy
    for key in outer:
        at = at[int(key)] if isinstance(at, list) else at.setdefault(key, {})
    last = int(last) if isinstance(at, list) else last
    if value is REMOVED:
        del at[last]
    else:
        at[last] = value
    return copy


REMOVED = object()


class Raw(str):
    """Text that stands in JSON as it is: numbers that Python would not write."""


def text_of(document):
    """JSON, in which a Raw is not quoted: 1e999 and the like."""
    raw = {}

    def replaced(value):
        if isinstance(value, Raw):
            raw[f"@raw{len(raw)}@"] = str(value)
            return f"@raw{len(raw) - 1}@"
        if isinstance(value, dict):
            return {k: replaced(v) for k, v in value.items()}
        if isinstance(value, (list, tuple)):
            return [replaced(v) for v in value]
        return value

    text = json.dumps(replaced(document), indent=1)
    for mark, content in raw.items():
        text = text.replace(f'"{mark}"', content)
    return text
