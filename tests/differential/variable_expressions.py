# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares the evaluation of random variable expressions with OpenUSD: value, variables used, and
whether there is an error. Needs OpenUSD's Python modules.

usage: variable_expressions.py EVALUATE_EXPRESSIONS [SEED COUNT]

EVALUATE_EXPRESSIONS is built from tests/tools.
"""

import os
import random
import subprocess
import sys
import tempfile

try:
    from pxr import Sdf, Tf, Vt
except ImportError:
    print("skipped: no OpenUSD modules in this Python")
    sys.exit(77)

VARIABLES = """
    string S = "abc"
    string E = ""
    int I = 5
    int64 L = 1099511627776
    bool B = 1
    int64[] LI = [1, 2, 5]
    int[] SI = [1, 2]
    string[] LS = ["a", "abc"]
    bool[] LB = [1, 0]
    string[] LE = []
    double F = 1.5
    string X = "`'${S}x'`"
    string Y = "`${I}`"
    string Z = "`if(${B}, ${X}, 'z')`"
    string C1 = "`${C2}`"
    string C2 = "`'${C1}'`"
    string N = "`None`"
    string BAD = "`foo(`"
"""
NAMES = ["S", "E", "I", "L", "B", "LI", "SI", "LS", "LB", "LE", "F", "X", "Y", "Z", "C1", "N",
         "BAD", "NOPE"]  # fmt: skip
FIXED = ["``", "`", "` 5`", "`5 `", "abc", "`[1,]`", "`[[1]]`", "`f(1)`", "`TRUE`", "`${S `",
         "`'a`b'`", "`'\\`'`", "`if (True, 1)`", "`99999999999999999999`",
         "`'${S'`", "`'\\n\\x41'`",
         "`\"a\\\"b'\"`", "`-`", "`--5`", "`True1`", "`if(1)`", "`[ ]`", "`len( )`"]  # fmt: skip
FUNCTIONS = {"if": (2, 3), "and": (2, 4), "or": (2, 4), "not": (1, 1), "eq": (2, 2), "neq": (2, 2),
             "lt": (2, 2), "leq": (2, 2), "gt": (2, 2), "geq": (2, 2), "contains": (2, 2),
             "at": (2, 2), "len": (1, 1), "defined": (1, 3)}  # fmt: skip


def text(rng):
    quote = rng.choice("'\"")
    variable = "${%s}" % rng.choice(NAMES)
    parts = [rng.choice(["a", "abc", "${S}", variable, "\\${S}", " ", "$", "\\\\"])
             for _ in range(rng.randint(0, 3))]  # fmt: skip
    return quote + "".join(parts) + quote


def scalar(rng, depth):
    if depth < 3 and rng.random() < 0.45:
        name = rng.choice(list(FUNCTIONS))
        fewest, most = FUNCTIONS[name]
        count = rng.randint(fewest, most) + (rng.random() < 0.03)
        arguments = [body(rng, depth + 1) for _ in range(count)]
        if name == "at":
            arguments[1:2] = [str(rng.randint(-4, 4))]
        if name in ("if", "and", "or", "not") and rng.random() < 0.8:
            arguments[0] = condition(rng, depth + 1)
        return name + rng.choice(["(", "( ", " ("]) + rng.choice([",", ", "]).join(arguments) + ")"
    return rng.choice([text(rng), text(rng), "${%s}" % rng.choice(NAMES), str(rng.randint(-9, 9)),
                       "True", "false", "None", "none"])  # fmt: skip


def condition(rng, depth):
    return rng.choice(["True", "False", "${B}", "eq(${I}, 5)", "lt(${S}, 'b')", "not(${B})",
                       "defined('S')", "defined(\"NOPE\")", scalar(rng, depth)])  # fmt: skip


def body(rng, depth):
    if rng.random() < 0.2:
        kind = rng.choice([lambda: text(rng), lambda: str(rng.randint(-9, 9)),
                           lambda: rng.choice(["True", "False"]),
                           lambda: scalar(rng, depth + 1)])  # fmt: skip
        return "[" + ", ".join(kind() for _ in range(rng.randint(0, 3))) + "]"
    return scalar(rng, depth)


def expression(rng):
    result = "`" + body(rng, 0) + "`"
    if rng.random() < 0.1:
        at = rng.randrange(len(result) + 1)
        result = result[:at] + rng.choice("()[]`,'$ {}a") + result[at + rng.choice([0, 1]) :]
    return result


def expected_of(layer, source):
    """(state, variables, value) as the program prints them; None when OpenUSD fails."""
    expression_of = Sdf.VariableExpression(source)
    if not expression_of:
        return "error", "", None
    try:
        result = expression_of.Evaluate(layer.pseudoRoot.GetInfo("expressionVariables"))
    except Tf.ErrorException:
        return None
    used = ",".join(sorted(result.usedVariables))
    return ("error" if result.errors else "value"), used, result.value


def same_value(expected, printed):
    if expected is None or (isinstance(expected, list) and not expected):
        return printed in ("", "None", "[]")
    if isinstance(expected, (Vt.StringArray, Vt.Int64Array, Vt.BoolArray)):
        expected = list(expected)
        bools = all(isinstance(x, bool) for x in expected)
        if bools:
            expected = [int(x) for x in expected]
    elif isinstance(expected, bool):
        expected = int(expected)
    layer = Sdf.Layer.CreateAnonymous(".usda")
    kind = "string" if isinstance(expected, str) else "int64"
    if isinstance(expected, list):
        kind = "string[]" if any(isinstance(x, str) for x in expected) else "int64[]"
    if printed == "[]":
        return expected == []
    layer.ImportFromString(f'#usda 1.0\ndef "A" {{\n{kind} v = {printed}\n}}\n')
    value = layer.GetAttributeAtPath("/A.v").default
    return (list(value) if isinstance(expected, list) else value) == expected


def main():
    program = sys.argv[1]
    seed, count = (int(a) for a in sys.argv[2:4]) if len(sys.argv) > 3 else (1, 4000)
    rng = random.Random(seed)
    sources = FIXED + [expression(rng) for _ in range(count)]
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString("#usda 1.0\n(\nexpressionVariables = {" + VARIABLES + "}\n)\n")
    layer.customLayerData = {f"e{i:06}": source for i, source in enumerate(sources)}
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "expressions.usda")
        layer.Export(path)
        run = subprocess.run([program, path], capture_output=True, text=True, check=True)
    lines = [line.split("\t", 3) for line in run.stdout.split("\n")[:-1]]
    differences, skipped = [], 0
    for source, (_, state, used, value) in zip(sources, lines, strict=True):
        expected = expected_of(layer, source)
        if expected is None:
            skipped += 1
        elif (state, used) != expected[:2] or not (
            state == "error" or same_value(expected[2], value)
        ):
            differences.append(f"{source}\n  OpenUSD {expected}\n  tenon   {(state, used, value)}")
    print("\n".join(differences[:8]))
    print(f"{len(sources)} compared, {len(differences)} different, {skipped} where OpenUSD fails")
    return 1 if differences else 0


if __name__ == "__main__":
    sys.exit(main())
