# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Text layers: numbers, tuples, and a writer that keeps the indentation. Equal input gives equal
bytes."""

import textwrap
from contextlib import contextmanager


def number(value):
    """Seven significant digits, which hold any float; noise far below them becomes 0, and -0
    becomes 0."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    return "0" if abs(value) < 1e-12 else f"{value:.7g}"


def length(value):
    """As number(), but anything below a nanometre (or a turn of that size) is 0."""
    return number(0.0 if abs(value) < 1e-9 else round(value, 10))


def group(values, item=length):
    return "(" + ", ".join(item(v) for v in values) + ")"


def array(values, item=str):
    return "[" + ", ".join(item(v) for v in values) + "]"


def tokens(values):
    return array(values, lambda v: f'"{v}"')


def path(target):
    return f"<{target}>"


class Layer:
    """Collects the lines of one layer."""

    def __init__(self, doc, default_prim, metadata=()):
        doc = "\n".join(textwrap.fill(paragraph, 88) for paragraph in doc.split("\n"))
        self._lines = ["#usda 1.0", "("]
        fields = [
            f'defaultPrim = "{default_prim}"',
            f'doc = """{doc}"""',
            "kilogramsPerUnit = 1",
            "metersPerUnit = 1",
            'upAxis = "Z"',
        ] + list(metadata)
        for field in sorted(fields):
            self._lines += [f"    {line}" if line else "" for line in field.split("\n")]
        self._lines.append(")")
        self._depth = 0

    def line(self, text=""):
        self._lines.append("    " * self._depth + text if text else "")

    def comment(self, *texts):
        for text in texts:
            self.line(f"# {text}")

    def attribute(self, declaration, value):
        self.line(f"{declaration} = {value}")

    @contextmanager
    def prim(self, header, *metadata, apis=()):
        """A prim: header such as 'def Xform "a"', then its metadata lines; applied schemas are
        prepended."""
        if (
            self._lines[-1]
            and not self._lines[-1].endswith("{")
            and not self._lines[-1].lstrip().startswith("#")
        ):
            self.line()
        fields = list(metadata)
        if apis:
            fields.append(f"prepend apiSchemas = {tokens(apis)}")
        if fields:
            self.line(header + " (")
            for text in "\n".join(fields).split("\n"):
                self.line("    " + text)
            self.line(")")
        else:
            self.line(header)
        with self._braces():
            yield

    @contextmanager
    def block(self, header):
        """Anything else with braces: variantSet "x" = {."""
        self.line(header + " {")
        self._depth += 1
        yield
        self._depth -= 1
        self.line("}")

    @contextmanager
    def _braces(self):
        self.line("{")
        self._depth += 1
        yield
        self._depth -= 1
        self.line("}")

    def text(self):
        lines = list(self._lines)
        lines.insert(lines.index(")") + 1, "")
        return "\n".join(lines).replace("\n\n\n", "\n\n") + "\n"
