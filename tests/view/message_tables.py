#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the tables of messages in docs/viewer.md, and the types of the page in
page/src/live/protocol.ts, of what the program tells.

    message_tables.py ROOT TENON [--write]

Exit 0: both are up to date, or were written; 1: one is not; 77: there is no page, so no viewer.
"""

import json
import pathlib
import re
import shutil
import sys

import viewer

TYPES = {"string": "string", "number": "number", "integer": "number", "boolean": "boolean"}
POINT = {"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3}
HEAD = """// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What the page and the session say to each other. Made of the tables of the program (tenon/live)
// by tests/view/message_tables.py --write: change it there.
"""


def types_of(schema):
    """-> the names of its types, and whether null is one of them."""
    types = schema.get("type", [])
    types = [types] if isinstance(types, str) else types
    return [name for name in types if name != "null"], "null" in types


def objects_of(schema, found):
    """Puts each object that has a name into `found`, those that it is made of before it."""
    for part in [*schema.get("properties", {}).values(), *filter(None, [schema.get("items")])]:
        objects_of(part, found)
    if "title" in schema:
        known = found.setdefault(schema["title"], schema)
        assert known["properties"] == schema["properties"], schema["title"]


# ---- TypeScript

def type_text(schema):
    """The type of a value."""
    if "const" in schema:
        return json.dumps(schema["const"])
    types, or_null = types_of(schema)
    if not types:
        return "unknown"
    if "title" in schema:
        text = schema["title"]
    elif types == ["array"]:
        text = type_text(schema["items"])
        text = f"({text})[]" if types_of(schema["items"])[1] else f"{text}[]"
        text = "[number, number, number]" if POINT.items() <= schema.items() else text
    elif types == ["object"]:
        text = members(schema, " ") if "properties" in schema else "object"
    else:
        text = TYPES[types[0]]
    return text + (" | null" if or_null else "")


def members(schema, end):
    """The members of an object between braces, with `end` behind each."""
    lines = []
    for name, field in schema["properties"].items():
        about = f"/** {field['description']} */ " if end == "\n" and "description" in field else ""
        missing = "" if name in schema["required"] else "?"
        lines.append(f"{about}{name}{missing}: {type_text(field)};")
    if not lines:
        return "Record<string, never>" if schema["additionalProperties"] is False else "object"
    indent = "  " if end == "\n" else ""
    return "{" + end + "".join(indent + line + end for line in lines) + "}"


def protocol(tables):
    found = {}
    for row in tables["requests"]:
        objects_of(row["schema"], found)
        objects_of(row["result"], found)
        del row["schema"]["properties"]["id"]  # the connection's own
    for row in tables["notices"]:
        objects_of(row["schema"], found)
        found[row["name"].capitalize() + "Notice"] = row["schema"]
    parts = [HEAD]
    for name, schema in found.items():
        parts.append(f"\nexport interface {name} {members(schema, chr(10))}\n")
    parts.append("\n/** Requests: their fields and answers. */\n"
                 "export interface Requests {\n")
    for row in tables["requests"]:
        properties = {name: field for name, field in row["schema"]["properties"].items()
                      if name != "do"}
        given = type_text(row["schema"] | {"properties": properties})
        answer = type_text(row["result"])
        parts.append(f"  /** {row['meaning']}. */\n"
                     f"  {row['name']}: {{ fields: {given}; answer: {answer} }};\n")
    parts.append("}\n\n/** Notices, by name. */\nexport interface Notices {\n")
    for row in tables["notices"]:
        parts.append(f"  /** {row['meaning']}. */\n"
                     f"  {row['name']}: {row['name'].capitalize()}Notice;\n")
    return "".join(parts) + "}\n"


# ---- docs/viewer.md

def kind_text(schema):
    """"a `Finding`" of objects with a name, "rows of `Finding`" of lists of them; else nothing."""
    title = schema.get("title", "")
    items = schema.get("items", {}).get("title", "")
    return f"a `{title}`" if title else f"rows of `{items}`" if items else ""


def fields(schema):
    lines = []
    for name, field in schema["properties"].items():
        if name not in ("do", "is", "id"):
            about = ": ".join(filter(None, [kind_text(field), field.get("description", "")]))
            note = "optional" if name not in schema["required"] else ""
            note = note or ("or null" if types_of(field)[1] and "null:" not in about else "")
            lines.append(" ".join(filter(None, [f"`{name}`", about, note and f"({note})"])))
    return "<br>".join(lines)


def result(schema):
    if "title" in schema:
        return f"`{schema['title']}`"
    parts = [f"`{name}` {kind_text(field)}".strip() for name, field in schema["properties"].items()]
    about = [schema["$comment"]] if "$comment" in schema else []
    return ": ".join(about + ["{" + ", ".join(parts) + "}"] * bool(parts)) or "nothing"


def table(heads, rows):
    return "\n".join(f"| {' | '.join(row)} |" for row in [heads, *rows]).replace(
        "\n", "\n|" + "---|" * len(heads) + "\n", 1)


def with_tables(page, tables):
    """The page with its tables between the marks made anew."""
    objects = {}
    for row in tables["requests"] + tables["notices"]:
        objects_of(row["schema"], objects)
        objects_of(row.get("result", {}), objects)
    made = {
        "requests": table(["`do`", "what", "fields", "result"],
                          [[f"`{row['name']}`", row["meaning"], fields(row["schema"]),
                            result(row["result"])] for row in tables["requests"]]),
        "notices": table(["`is`", "what", "fields"],
                         [[f"`{row['name']}`", row["meaning"], fields(row["schema"])]
                          for row in tables["notices"]]),
        "objects": table(["object", "more", "fields"],
                         [[f"`{name}`", schema.get("$comment", ""), fields(schema)]
                          for name, schema in objects.items()])}
    for kind, text in made.items():
        page, count = re.subn(rf"(<!-- {kind} -->\n\n).*?(\n\n<!-- end -->)",
                              lambda found, text=text: found[1] + text + found[2], page,
                              flags=re.DOTALL)
        assert count == 1, f"docs/viewer.md has no marks around the table of {kind}"
    return page


def main():
    if shutil.which("node") is None:
        print("skipped: node is not installed, so there is no page")
        return 77
    words = [word for word in sys.argv[1:] if word != "--write"]
    root, tenon = pathlib.Path(words[0]).absolute(), str(pathlib.Path(words[1]).absolute())
    with viewer.Viewer(tenon, root / "examples/scenes/box_on_box.usda") as view, \
            view.client() as client:
        tables = client.done("messages")
    page = root / "docs/viewer.md"
    stale = 0
    for path, text in ((page, with_tables(page.read_text(), tables)),
                       (root / "page/src/live/protocol.ts", protocol(tables))):
        if "--write" in sys.argv:
            path.write_text(text)
        elif not path.exists() or path.read_text() != text:
            stale += 1
            print(f"{path.relative_to(root)}:1: not as the tables of tenon/live say; run "
                  "tests/view/message_tables.py . build/release/bin/tenon --write")
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
