# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Text layers of this project for the text parser, one idea each. GOOD ones have to be read, BAD
ones refused, by tenon and by OpenUSD alike. The first line, `#usda 1.0`, is put in front of each
but those that begin with `#`."""


def prim(*lines):
    return 'def Xform "A"\n{\n' + "".join(f"    {line}\n" for line in lines) + "}\n"


def layer(*lines):
    return "(\n" + "".join(f"    {line}\n" for line in lines) + ")\n"


GOOD = {
    "empty": "",
    "comment_first": "# nothing else\n",
    "no_blank_line": 'def "A" {}\n',
    "documentation": layer('"two words"'),
    "documentation_named": layer('doc = "two words"'),
    "documentation_long": layer('"""first\nsecond\n"""'),
    "layer_metadata": layer('defaultPrim = "A"', "metersPerUnit = 0.01", 'upAxis = "Z"'),
    "layer_data": layer("customLayerData = {", "    int a = 1", "    dictionary b = {",
                        "    }", "}"),
    "sublayers": layer("subLayers = [", "    @a.usda@,",
                       "    @b.usda@ (offset = 2; scale = 0.5)", "]"),
    "sublayers_none": layer("subLayers = []"),
    "relocates": layer("relocates = {", "    </A/B>: </A/C>", "}"),
    "semicolons": 'def "A" { int a = 1; int b = 2; }\n',
    "class_and_over": 'class "_a"\n{\n}\nover "b"\n{\n}\n',
    "untyped": 'def "A"\n{\n}\n',
    "nested": 'def "A"\n{\n    def "B"\n    {\n        def "C" {}\n    }\n}\n',
    "reorder": 'reorder rootPrims = ["B", "A"]\ndef "A" {}\ndef "B" {}\n',
    "reorder_properties": prim('reorder properties = ["b", "a"]', "int a", "int b"),
    "reorder_children": prim('reorder nameChildren = ["C", "B"]', 'def "B" {}', 'def "C" {}'),
    "prim_metadata": 'def "A" (\n    active = false\n    kind = "group"\n    hidden = true\n'
                     ')\n{\n}\n',
    "list_edits": 'def "A" (\n    prepend apiSchemas = ["X"]\n    append inherits = </b>\n'
                  '    delete specializes = </c>\n)\n{\n}\n',
    "references": 'def "A" (\n    references = [@a.usda@</B>, </C>, @d.usda@ (offset = 1)]\n)\n'
                  '{\n}\n',
    "reference_data": 'def "A" (\n    references = @a.usda@ (\n        customData = {\n'
                      '            int n = 1\n        }\n    )\n)\n{\n}\n',
    "payload_none": 'def "A" (\n    payload = None\n)\n{\n}\n',
    "variants": 'def "A" (\n    variantSets = "v"\n    variants = {\n'
                '        string v = "x"\n    }\n'
                ')\n'
                '{\n    variantSet "v" = {\n        "x" {\n            int a = 1\n        }\n'
                '        "y" (\n            active = false\n        ) {\n        }\n    }\n}\n',
    "unregistered": 'def "A" (\n    someWord = "text"\n)\n{\n}\n',
    "bools": prim("bool a = true", "bool b = 0", 'uniform bool c = 1'),
    "integers": prim("int a = -3", "uint b = 4000000000", "int64 c = -9000000000", "uchar d = 255"),
    "reals": prim("float a = 1", "double b = -1.5e-3", "half c = .5", "double d = 1.",
                  "float e = inf",
                  "float f = -inf", "double g = nan"),
    "strings": prim('string a = "x"', "string b = 'y'", 'string c = "\\t\\"\\x41\\101"',
                    'token d = ""'),
    "string_long": prim('string a = """one\n"two"\n"""', "string b = '''three'''"),
    "assets": prim("asset a = @x.png@", "asset b = @@", "asset c = @@@a@b@@@", 'asset d = "x"'),
    "vectors": prim("float3 a = (1, 2, 3)", "int2 b = (1, -2)", "quatf c = (1, 0, 0, 0)",
                    "matrix2d d = ( (1, 0), (0, 1) )"),
    "trailing_commas": prim("int[] a = [1, 2,]", "float3[] b = [(1, 2, 3),]"),
    "arrays_empty": prim("int[] a = []", "token[] b = []", "matrix4d[] c = []"),
    "array_over_lines": prim("int[] a = [", "    1,", "    2", "]"),
    "blocked": prim("int a = None", "float[] b = None", "rel c = None"),
    "samples": prim("double a.timeSamples = {", "    1: 2,", "    -1.5: 3,", "    5: None,", "}"),
    "samples_empty": prim("double a.timeSamples = {", "}"),
    "connections": prim("float a.connect = </A.b>", "append float a.connect = </A.c>",
                        "int d.connect = [</A.b>, </A.c>]"),
    "relationships": prim("rel a", "rel b = </A>", "rel c = [</A>, </A.a>]", "delete rel d = </A>",
                          "custom rel e", "custom varying rel f"),
    "relative_paths": prim("rel a = <../A>", "rel b = <B>"),
    "namespaces": prim("custom int a:b:c = 1", "rel d:e = </A>"),
    "property_metadata": prim("int a = 1 (", '    doc = "why"', "    customData = {",
                              "        string x = \"y\"", "    }", ")"),
    "color_space": prim('color3f a = (1, 0, 0) (', '    colorSpace = "x"', ")"),
    "dictionary_types": 'def "A" (\n    customData = {\n        int[] a = [1]\n'
                        '        string "b c" = "1"\n'
                        '    }\n)\n{\n}\n',
    "splines": prim("double a.spline = {", "    1: 2; post linear,", "    3: 4,", "}"),
    "splines_loop": prim("double a.spline = {", "    bezier,", "    pre: held,",
                         "    post: linear,",
                         "    1: 2; pre (1, 2); post curve (3, 4),", "}"),
    "utf8": 'def "\u00fcber"\n{\n    string \u00e4 = "\u20ac"\n}\n',
    "carriage_returns": 'def "A"\r\n{\r\n    int a = 1\r\n}\r\n',
    "comments": 'def "A" # one\n{\n    int a = 1 // two\n    /* three\n    */\n    int b = 2\n}\n',
    "no_newline_at_end": 'def "A" {}',
    "api_none": 'def "A" (\n    apiSchemas = None\n)\n{\n}\n',
    "symmetry": 'def "A" (\n    symmetryFunction =\n)\n{\n}\n',
    "permission": 'def "A" (\n    permission = private\n)\n{\n}\n',
    "time_code": prim("timecode a = 3", "timecode[] b = [1, 2]"),
    "path_expression": prim('pathExpression a = "/A//B - /C"'),
    "old_names": prim("Vec3f a = (1, 2, 3)", "Matrix4d b", "Quatf c"),
    "spaces": '   def   Xform   "A"   {   int   a   =   1   ;   }   \n',
}

BAD = {
    "header_missing": "# no header\n",
    "header_word": "#obj 1.0\n",
    "header_version": "#usda 3.7\n",
    "brace_open": 'def "A"\n{\n',
    "brace_extra": 'def "A"\n{\n}\n}\n',
    "brace_missing": 'def "A"\nint a = 1\n',
    "parenthesis_open": 'def "A" (\n    active = false\n{\n}\n',
    "parenthesis_extra": prim(")"),
    "name_missing": "def Xform\n{\n}\n",
    "name_number": 'def "1a"\n{\n}\n',
    "name_blank": 'def "a b"\n{\n}\n',
    "name_empty": 'def ""\n{\n}\n',
    "name_unquoted": "def A\n{\n}\n",
    "name_twice": 'def "A" "B"\n{\n}\n',
    "keyword_unknown": 'make "A"\n{\n}\n',
    "property_outside": "int a = 1\n",
    "type_missing": prim("a = 1"),
    "value_missing": prim("int a ="),
    "value_word": prim("int a = five"),
    "value_string": prim('int a = "5"'),
    "value_real": prim("int a = (1, 2)"),
    "value_too_short": prim("float3 a = (1, 2)"),
    "value_too_long": prim("float3 a = (1, 2, 3, 4)"),
    "value_no_array": prim("int a = [1]"),
    "value_array_needed": prim("int[] a = 1"),
    "value_matrix": prim("matrix2d a = (1, 0, 0, 1)"),
    "value_two": prim("int a = 1 2"),
    "array_open": prim("int[] a = [1, 2"),
    "array_no_comma": prim("int[] a = [1 2]"),
    "array_two_commas": prim("int[] a = [1,, 2]"),
    "string_open": prim('string a = "x'),
    "string_long_open": prim('string a = """x'),
    "string_unquoted": prim("string a = x"),
    "asset_open": prim("asset a = @x"),
    "samples_no_brace": prim("double a.timeSamples = 1: 2"),
    "samples_no_colon": prim("double a.timeSamples = { 1 2 }"),
    "samples_open": prim("double a.timeSamples = { 1: 2"),
    "samples_word": prim("double a.timeSamples = { one: 2 }"),
    "connection_string": prim('float a.connect = "/A.b"'),
    "relationship_string": prim('rel a = "/B"'),
    "relationship_open": prim("rel a = </B"),
    "relationship_number": prim("rel a = 1"),
    "path_bad": prim("rel a = </A//B>"),
    "metadata_outside": '(\n    active = \n)\ndef "A" {}\n',
    "metadata_type": 'def "A" (\n    active = (1, 2)\n)\n{\n}\n',
    "metadata_of_layer_type": layer('metersPerUnit = "1"'),
    "metadata_no_equals": 'def "A" (\n    kind "group"\n)\n{\n}\n',
    "sublayers_string": layer('subLayers = ["a.usda"]'),
    "sublayers_scale": layer("subLayers = [@a.usda@ (stretch = 2)]"),
    "reference_number": 'def "A" (\n    references = 1\n)\n{\n}\n',
    "reference_property": 'def "A" (\n    references = @a.usda@</B.c>\n)\n{\n}\n',
    "inherits_asset": 'def "A" (\n    inherits = @a.usda@\n)\n{\n}\n',
    "list_edit_unknown": 'def "A" (\n    insert apiSchemas = ["X"]\n)\n{\n}\n',
    "variants_no_brace": prim('variantSet "v" = "x"'),
    "variants_no_name": prim("variantSet = {", "}"),
    "variants_unquoted": prim("variantSet v = {", "}"),
    "variant_no_block": prim('variantSet "v" = {', '    "x"', "}"),
    "dictionary_no_type": 'def "A" (\n    customData = {\n        a = 1\n    }\n)\n{\n}\n',
    "dictionary_open": 'def "A" (\n    customData = {\n        int a = 1\n)\n{\n}\n',
    "comma_between": prim("int a = 1, int b = 2"),
    "child_twice": 'def "A" {}\ndef "A" {}\n',
    "property_twice_types": prim("int a = 1", "float a = 1"),
    "keyword_twice": prim("uniform uniform int a = 1"),
    "relationship_typed": prim("int rel a"),
    "reorder_number": "reorder rootPrims = [1]\n",
    "nul": prim("int a = 1\0"),
}


def cases():
    """[(name, text, whether it has to be refused)]"""
    found = [(name, text, False) for name, text in GOOD.items()]
    found += [(name, text, True) for name, text in BAD.items()]
    return [(name, text if is_bad and text.startswith("#") else "#usda 1.0\n" + text, is_bad)
            for name, text, is_bad in found]
