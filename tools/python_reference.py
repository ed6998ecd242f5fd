# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The reference of the Python package as Markdown: its modules, classes and functions with
signatures and docstrings, read from the sources, and the compiled module's from its stub where that
was made."""

import ast
import glob
import os
import textwrap

# Modules of python/tenon_usd in the order of the page; what each is called there.
MODULES = (("functions", "tenon_usd"), ("tuning", "tenon_usd"), ("pages", "tenon_usd"),
           ("world", "tenon_usd"),
           ("dynamics", "tenon_usd.dynamics"), ("errors", "tenon_usd.errors"),
           ("options", "tenon_usd.options"), ("gym", "tenon_usd.gym"),
           ("actuators", "tenon_usd.actuators"), ("draws", "tenon_usd.draws"),
           ("observations", "tenon_usd.observations"), ("rendering", "tenon_usd.rendering"),
           ("tasks/task", "tenon_usd.tasks"), ("tasks/env", "tenon_usd.tasks.env"),
           ("logs", "tenon_usd.logs"),
           ("sweep/__init__", "tenon_usd.sweep"), ("sweep/plan", "tenon_usd.sweep.plan"),
           ("sweep/cases", "tenon_usd.sweep.cases"), ("sweep/chunks", "tenon_usd.sweep.chunks"),
           ("sweep/work", "tenon_usd.sweep.work"),
           ("identify/log", "tenon_usd.identify.log"),
           ("identify/channels", "tenon_usd.identify.channels"),
           ("identify/log_files", "tenon_usd.identify.log_files"),
           ("identify/joints", "tenon_usd.identify.joints"),
           ("identify/delays", "tenon_usd.identify.delays"),
           ("identify/quality", "tenon_usd.identify.quality"),
           ("identify/excite", "tenon_usd.identify.excite"),
           ("identify/trajectory_files", "tenon_usd.identify.trajectory_files"),
           ("identify/parameters", "tenon_usd.identify.parameters"),
           ("identify/model", "tenon_usd.identify.model"),
           ("identify/identifiable", "tenon_usd.identify.identifiable"),
           ("identify/solve", "tenon_usd.identify.solve"),
           ("identify/run", "tenon_usd.identify.run"),
           ("identify/overlay", "tenon_usd.identify.overlay"),
           ("identify/selftest", "tenon_usd.identify.selftest"))
DEFINITIONS = (ast.FunctionDef, ast.ClassDef)


def is_public(node):
    return not node.name.startswith("_") or node.name == "__init__"


def signature(node):
    """`name(arguments) -> result` as it stands in the source."""
    arguments = ast.unparse(node.args).removeprefix("self, ").removeprefix("self")
    result = f" -> {ast.unparse(node.returns)}" if node.returns is not None else ""
    return f"{node.name}({arguments}){result}"


def is_property(node):
    names = [ast.unparse(decorator) for decorator in node.decorator_list]
    return any(name == "property" or name.endswith("_property") for name in names)


def is_setter(node):
    return any(ast.unparse(decorator).endswith(".setter") for decorator in node.decorator_list)


def text_of(node):
    return ast.get_docstring(node) or ""


def indented(text):
    """A docstring as Markdown: its code stays code; brackets of units are no links."""
    return textwrap.dedent(text).replace("[", "\\[").replace("<", "&lt;") + "\n\n"


def member(node, level):
    if isinstance(node, ast.ClassDef):
        return class_text(node, level)
    if is_property(node):
        result = f": {ast.unparse(node.returns)}" if node.returns is not None else ""
        shown = f"{node.name}{result}"
    else:
        shown = signature(node)
    return f"{'#' * level} {node.name}\n\n```python\n{shown}\n```\n\n" + indented(text_of(node))


def class_text(node, level):
    bases = ", ".join(ast.unparse(base) for base in node.bases)
    text = f"{'#' * level} class {node.name}{f'({bases})' if bases else ''}\n\n"
    text += indented(text_of(node))
    for each in node.body:
        if isinstance(each, DEFINITIONS) and is_public(each) and not is_setter(each) \
                and (text_of(each) or each.name == "__init__"):
            text += member(each, level + 1)
    return text


def module_text(path, name):
    with open(path, encoding="utf-8") as file:
        module = ast.parse(file.read())
    nodes = [node for node in module.body if isinstance(node, DEFINITIONS) and is_public(node)
             and text_of(node)]
    head = f"## {name}: {os.path.basename(path).removesuffix('.py')}\n\n" + indented(
        text_of(module))
    return head + "".join(member(node, 3) for node in nodes)


def reference(root):
    """-> Markdown"""
    folder = os.path.join(root, "python/tenon_usd")
    text = ("# Python\n\n`pip install dist/tenon_usd-*.whl`, `import tenon_usd`. "
            "[python/README.md](README.md) shows the first steps.\n\n")
    for name, shown in MODULES:
        path = os.path.join(folder, name + ".py")
        if os.path.exists(path):
            text += module_text(path, shown)
    stubs = sorted(glob.glob(os.path.join(root, "build/wheel/*/_tenon.pyi")), key=os.path.getmtime)
    if stubs:
        text += module_text(stubs[-1], "tenon_usd, compiled").replace("_tenon.pyi", "stages, prims"
                                                                      " and physics")
    return text
