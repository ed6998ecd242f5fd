# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Scenes of this project about composition, a rule or two each: {name: {file: text}}. The root layer
is l0.usda. run_composition.py compares what tenon composes of them with what OpenUSD does."""

HEAD = "#usda 1.0\n"


def sublayers(*names):
    return "(\n    subLayers = [\n" + "".join(f"        {name},\n" for name in names) + "    ]\n)\n"


def prim(name, metadata="", inside="", specifier="def"):
    head = f" (\n    {metadata}\n)" if metadata else ""
    return f'{specifier} "{name}"{head}\n{{\n{inside}}}\n'


def number(name, value):
    return f"    int {name} = {value}\n"


SCENES = {
    "sublayers": {
        "l0.usda": HEAD + sublayers("@a.usda@", "@b.usda@ (offset = 3; scale = 2)") +
        prim("P", "", number("x", 1), "over"),
        "a.usda": HEAD + prim("P", "", number("x", 2) + number("y", 2)),
        "b.usda": HEAD + prim("P", "", number("z", 3))},
    "sublayer_missing": {"l0.usda": HEAD + sublayers("@nowhere.usda@") + prim("P")},
    "sublayer_cycle": {"l0.usda": HEAD + sublayers("@a.usda@") + prim("P"),
                       "a.usda": HEAD + sublayers("@l0.usda@") + prim("P")},
    "reference": {
        "l0.usda": HEAD + prim("P", "references = @a.usda@</Q>", number("x", 1)),
        "a.usda": HEAD + prim("Q", "", number("x", 2) + '    def "C"\n    {\n    }\n')},
    "reference_default_prim": {
        "l0.usda": HEAD + prim("P", "references = @a.usda@"),
        "a.usda": HEAD + '(\n    defaultPrim = "Q"\n)\n' + prim("Q", "", number("x", 2))},
    "reference_no_default_prim": {"l0.usda": HEAD + prim("P", "references = @a.usda@"),
                                  "a.usda": HEAD + prim("Q")},
    "reference_missing_prim": {"l0.usda": HEAD + prim("P", "references = @a.usda@</R>"),
                               "a.usda": HEAD + prim("Q")},
    "reference_missing_file": {"l0.usda": HEAD + prim("P", "references = @nowhere.usda@</Q>")},
    "reference_cycle": {"l0.usda": HEAD + prim("P", "references = </Q>") +
                        prim("Q", "references = </P>")},
    "reference_chain": {
        "l0.usda": HEAD + prim("P", "references = @a.usda@</A> (offset = 1)"),
        "a.usda": HEAD + prim("A", "references = @b.usda@</B> (scale = 3)", number("x", 1)),
        "b.usda": HEAD + prim("B", "", number("y", 2))},
    "reference_list_edits": {
        "l0.usda": HEAD + sublayers("@a.usda@") +
        prim("P", "delete references = </B>", "", "over") + prim("A", "", number("x", 1)) +
        prim("B", "", number("x", 2)) + prim("C", "", number("x", 3)),
        "a.usda": HEAD + prim("P", "prepend references = [</A>, </B>, </C>]")},
    "payload": {
        "l0.usda": HEAD + prim("P", "payload = @a.usda@</Q>"),
        "a.usda": HEAD + prim("Q", "", number("x", 2))},
    "inherits": {"l0.usda": HEAD + prim("P", "inherits = </_C>", number("x", 1)) +
                 prim("_C", "", number("x", 2) + number("y", 2), "class")},
    "inherits_across_reference": {
        "l0.usda": HEAD + prim("P", "references = @a.usda@</Q>") +
        prim("_C", "", number("y", 9), "class"),
        "a.usda": HEAD + prim("Q", "inherits = </_C>") +
        prim("_C", "", number("x", 2) + number("y", 2), "class")},
    "specializes": {
        "l0.usda": HEAD + prim("P", "references = @a.usda@</Q>") +
        prim("_C", "", number("x", 5), "class"),
        "a.usda": HEAD + prim("Q", "specializes = </_C>", number("x", 1)) +
        prim("_C", "", number("x", 2) + number("y", 2), "class")},
    "variants": {"l0.usda": HEAD + prim(
        "P", 'variantSets = ["v", "w"]\n    variants = {\n        string v = "a"\n    }',
        '    variantSet "v" = {\n        "a" (\n            variants = {\n'
        '                string w = "y"\n            }\n        ) {\n            int x = 1\n'
        '        }\n        "b" {\n            int x = 2\n        }\n    }\n'
        '    variantSet "w" = {\n        "y" {\n            int y = 1\n'
        '            def "C"\n            {\n            }\n        }\n        "z" {\n        }\n'
        "    }\n")},
    "variant_unknown": {"l0.usda": HEAD + prim(
        "P", 'variantSets = "v"\n    variants = {\n        string v = "none"\n    }',
        '    variantSet "v" = {\n        "a" {\n            int x = 1\n        }\n    }\n')},
    "variant_with_reference": {
        "l0.usda": HEAD + prim(
            "P", 'variantSets = "v"\n    variants = {\n        string v = "a"\n    }',
            '    variantSet "v" = {\n        "a" (\n            references = @a.usda@</Q>\n'
            "        ) {\n        }\n    }\n"),
        "a.usda": HEAD + prim("Q", "", number("x", 7))},
    "relocates": {
        "l0.usda": HEAD + "(\n    relocates = {\n        </P/C>: </P/D>\n    }\n)\n" +
        prim("P", "references = @a.usda@</Q>", '    over "D"\n    {\n        int y = 1\n    }\n'),
        "a.usda": HEAD + prim("Q", "", '    def "C"\n    {\n        int x = 1\n    }\n')},
    "relocates_invalid": {
        "l0.usda": HEAD + "(\n    relocates = {\n        </P/C>: </P/C/D>\n    }\n)\n" +
        prim("P", "references = @a.usda@</Q>"),
        "a.usda": HEAD + prim("Q", "", '    def "C"\n    {\n    }\n')},
    "instances": {
        "l0.usda": HEAD + prim("P", "instanceable = true\n    references = @a.usda@</Q>") +
        prim("R", "instanceable = true\n    references = @a.usda@</Q>"),
        "a.usda": HEAD + prim("Q", "", '    def "C"\n    {\n        int x = 1\n    }\n')},
    "targets_across_reference": {
        "l0.usda": HEAD + prim("P", "references = @a.usda@</Q>"),
        "a.usda": HEAD + prim("Q", "", "    rel r = [</Q/C>, </Other>]\n"
                              '    def "C"\n    {\n    }\n') + prim("Other")},
    "inactive": {"l0.usda": HEAD + sublayers("@a.usda@") + prim("P", "active = false", "", "over"),
                 "a.usda": HEAD + prim("P", "", '    def "C"\n    {\n    }\n')},
    "order_of_children": {
        "l0.usda": HEAD + sublayers("@a.usda@") +
        prim("P", "", '    reorder nameChildren = ["B", "A"]\n', "over"),
        "a.usda": HEAD + prim("P", "", "".join(f'    def "{name}"\n    {{\n    }}\n'
                                               for name in "ABC"))},
}
