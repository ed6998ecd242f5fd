# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Good text layers that use much of the grammar, for text_mutants.py, and words to put in."""

PRIMS = '''#usda 1.0
(
    "a comment"
    defaultPrim = "A"
    doc = """two
lines"""
    subLayers = [
        @a.usda@,
        @b.usda@ (offset = 1; scale = 2)
    ]
    customLayerData = {
        string note = "x"
        dictionary more = {
            int[] numbers = [1, 2]
        }
    }
    relocates = {
        </A/B>: </A/C>
    }
)

def Xform "A" (
    active = true
    add references = </B>
    prepend inherits = [</C>, </D>]
    payload = @p.usda@</P> (offset = 2)
    kind = "group"
    variants = {
        string v = "one"
    }
    append variantSets = ["v", "w"]
    customData = {
        bool b = 1
    }
)
{
    reorder nameChildren = ["x", "y"]
    reorder properties = ["p", "q"]
    custom float p = 1.5 (
        doc = "a number"
        interpolation = "vertex"
    )
    uniform token[] q = ["a", "b"]
    double3 t.timeSamples = {
        1: (1, 2, 3),
        2.5: None,
    }
    float c.connect = </A.p>
    delete float c.connect = [</B.p>, </C.p>]
    rel r = [
        </A>,
        <B/C.x>,
    ]
    append rel s = <../X>
    varying rel u (displayName = "u")
    variantSet "v" = {
        "one" (kind = "component") {
            int inside = 3
            def "child" {
            }
        }
        "two" {
        }
    }
    over "y"
    {
        asset a = @file.png@
        asset[] as = [@x@, @@@y@z@@@]
        matrix2d m = ( (1, 2), (3, 4) )
        string text = 'it''s'
        quatf w = (1, 0, 0, 0)
        color3f[] colors = [(1, 0, 0), (0, 1, 0)]
    }
}

class "C" { int a = 1; int b = 2 }
'''

VALUES = '''#usda 1.0

def "A"
{
    int[] e = edit [append 1; prepend [2]; write 3 to [-1]; insert 4 at [2]; erase [0]]
    float[] f = edit [
        minsize 4 fill 0.5
        resize 3
        maxsize 9; resize 2 fill -1
    ]
    token[] g.timeSamples = {
        1: edit [append "a"],
        2: ["b"],
    }
    duration d = 2.5
    timecode tc = 3
    bool yes = true
    half h = 0.1
    uint64 big = 18446744073709551615
    double inf1 = inf
    double nan1 = nan
    double neg = -inf
    pathExpression pe = "//a*"
    opaque o
    group gr
    int blocked = None
    int anim = AnimationBlock
    unknownType z = [1, "a", (2, 3)]
    double s.spline = {
        bezier,
        pre: held,
        post: linear,
        1: 2; pre (0.5, 1); post curve (0.5, 2),
        3: 4 & 5; post held; { string note = "k" },
    }
    # a comment
    string long = """a "quoted" text
over lines""" // another
    /* and
       one more */
    float[] empty = []
    float2[] pairs = [(1, 2), (3, 4),]
    custom rel only
    string tail = "x" ( customData = { string k = "v" } )
}
'''

TEXTS = (PRIMS, VALUES)

VOCABULARY = (
    "add", "append", "delete", "prepend", "reorder", "def", "over", "class", "custom", "uniform",
    "varying", "config", "rel", "references", "payload", "inherits", "specializes", "variantSet",
    "variantSets", "variants", "None", "AnimationBlock", "edit", "[", "]", "(", ")", "{", "}", "=",
    ",", ";", ":", ".", "&", "-", "+", "1", "-1", "0.5", "1e3", "inf", "nan", "true", '"x"', "'x'",
    "@x@", "@@", "@@@x@@@", "<>", "</A>", "<A>", "<../A>", "</A.p>", "<.p>", "</A{v=one}B>",
    "int", "int[]", "float", "string", "token", "double3", "asset", "dictionary", "foo::bar",
    "timeSamples", "connect", "spline", "default", "offset", "scale", "doc", "comment", "kind",
    "permission", "displayUnit", "customData", "assetInfo", "hidden", "symmetricPeer", "relocates",
    "prefixSubstitutions", "suffix", "nameChildren", "properties", "rootPrims", "subLayers",
    "# c", "/* c */", "// c", "\n", "\n\n", " ", "\t", "\r\n", "\u00e9", "a:b", "a::b", "[]",
)
