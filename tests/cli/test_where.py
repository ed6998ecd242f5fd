#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""tenon where: every opinion with its place, the way there, and why one loses.

    test_where.py ROOT TENON
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]
HAND = ROOT / "examples/inspire_hand/inspire_hand.usda"
JOINT = "/inspire_hand/Physics/right_thumb_4_joint"


def tenon(*arguments):
    return subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                          check=False)


class Where(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def where(self, *arguments, code=0):
        process = tenon("where", *arguments, "--json")
        self.assertEqual(process.returncode, code, process.stderr)
        return json.loads(process.stdout)

    def write(self, name, text):
        path = self.folder / name
        path.write_text("#usda 1.0\n" + text)
        return path

    def line_of(self, file, text, after=""):
        """1-based line of the first `text` behind the first `after`."""
        lines = pathlib.Path(file).read_text().splitlines()
        start = next(i for i, line in enumerate(lines) if after in line)
        return next(i for i, line in enumerate(lines[start:], start + 1) if text in line)

    def test_a_value_of_the_hand_comes_through_the_variant_and_its_payload(self):
        answer = self.where(HAND, f"{JOINT}.physics:upperLimit", "--physics", "physx")
        row = answer["opinions"][0]
        physics = HAND.parent / "payloads/Physics/physics.usda"
        self.assertTrue(row["file"].endswith("payloads/Physics/physics.usda"), row)
        self.assertEqual(row["line"], self.line_of(physics, "physics:upperLimit",
                                                   "right_thumb_4_joint\""))
        self.assertEqual((row["what"], row["verdict"]), ("default", "wins"))
        self.assertTrue(row["sublayerOf"].endswith("physx.usda"), row)
        self.assertEqual([arc["arc"] for arc in row["arcs"]], ["variant", "payload"])
        self.assertEqual(row["arcs"][0]["variant"], "physx")
        self.assertEqual(row["arcs"][1]["line"], self.line_of(HAND, '"physx"'))
        fallback = answer["opinions"][-1]
        self.assertEqual((fallback["what"], fallback["verdict"]), ("fallback", "loses"))
        self.assertEqual(fallback["schema"], "PhysicsRevoluteJoint")

    def test_other_variants_are_named_when_asked_for(self):
        gearing = f"{JOINT}.physxMimicJoint:rotX:gearing"
        armature = "/inspire_hand/Physics/right_index_1_joint.physxJoint:armature"
        self.assertEqual(tenon("where", HAND, gearing).returncode, 2)
        answer = self.where(HAND, f"{JOINT}.physics:upperLimit", "--variants")
        self.assertEqual({row["verdict"] for row in answer["opinions"]}, {"wins", "loses"})
        answer = self.where(HAND, "/inspire_hand/Physics/right_index_1_joint", "--variants")
        other = [row for row in answer["opinions"] if row["verdict"] == "not in force"]
        self.assertTrue(any(row["why"] == "only with Physics=physx" for row in other), other)
        self.assertEqual(self.where(HAND, armature, "--physics", "physx")["value"], "0.0002")

    def test_the_strongest_wins_and_the_others_are_told_why_not(self):
        self.write("weak.usda", 'def "A"\n{\n    double a = 1\n}\n')
        root = self.write("root.usda", '(\n    subLayers = [@./weak.usda@]\n)\nover "A"\n{\n'
                                       '    double a = 2\n}\n')
        rows = self.where(root, "/A.a")["opinions"]
        self.assertEqual([(row["line"], row["value"], row["verdict"]) for row in rows],
                         [(7, "2", "wins"), (4, "1", "loses")])
        self.assertIn("root.usda:7", rows[1]["why"])
        self.assertTrue(rows[1]["sublayerOf"].endswith("root.usda"))

    def test_a_block_hides_what_is_weaker(self):
        self.write("weak.usda", 'def "A"\n{\n    double a = 1\n}\n')
        root = self.write("root.usda", '(\n    subLayers = [@./weak.usda@]\n)\nover "A"\n{\n'
                                       '    double a = None\n}\n')
        answer = self.where(root, "/A.a")
        self.assertIsNone(answer["value"])
        rows = answer["opinions"]
        self.assertEqual([row["verdict"] for row in rows], ["wins", "loses"])
        self.assertIn("blocks", rows[1]["why"])

    def test_samples_count_at_times_and_defaults_at_the_default_time(self):
        self.write("weak.usda", 'def "A"\n{\n    double a = 1\n}\n')
        root = self.write("root.usda", '(\n    subLayers = [@./weak.usda@]\n)\nover "A"\n{\n'
                                       '    double a.timeSamples = {\n        0: 5,\n    }\n}\n')
        rows = self.where(root, "/A.a")["opinions"]
        self.assertEqual([(row["what"], row["verdict"]) for row in rows],
                         [("timeSamples", "wins at times"),
                          ("default", "wins at the default time")])

    def clip_scene(self):
        """Samples and a default below a clip set with two clips."""
        for i, value in enumerate((5, 7)):
            self.write(f"clip{i}.usda", f'def "M"\n{{\n    double a.timeSamples = {{\n'
                                        f'        {10 * i}: {value},\n    }}\n}}\n')
        self.write("manifest.usda", 'over "M"\n{\n    double a\n}\n')
        self.write("weak.usda", 'over "A"\n{\n    double a = 1\n    double a.timeSamples = {\n'
                                '        0: 100,\n    }\n}\n')
        return self.write("root.usda", """(
    subLayers = [@./weak.usda@]
)
def "A" (
    clips = {
        dictionary default = {
            asset[] assetPaths = [@./clip0.usda@, @./clip1.usda@]
            string primPath = "/M"
            double2[] active = [(0, 0), (10, 1)]
            asset manifestAssetPath = @./manifest.usda@
        }
    }
)
{
}
""")

    def test_samples_below_value_clips_lose(self):
        root = self.clip_scene()
        answer = self.where(root, "/A.a")
        rows = answer["opinions"]
        self.assertEqual([(row["what"], row["verdict"]) for row in rows],
                         [("valueClips", "wins at times"), ("timeSamples", "loses"),
                          ("default", "wins at the default time")])
        self.assertEqual((rows[0]["line"], rows[0]["path"], rows[0]["clipSet"]),
                         (self.line_of(root, 'def "A"'), "/A", "default"))
        self.assertTrue(rows[0]["clip"].endswith("clip0.usda"), rows[0])
        self.assertIn("root.usda", rows[1]["why"])
        self.assertIn("the clips of", rows[2]["why"])
        self.assertNotIn("time", answer)

    def test_a_time_chooses_the_clip(self):
        root = self.clip_scene()
        answer = self.where(root, "/A.a", "--time", 12)
        self.assertEqual((answer["time"], answer["value"], answer["valueAtTime"]), (12, "1", "7"))
        self.assertTrue(answer["opinions"][0]["clip"].endswith("clip1.usda"))
        text = tenon("where", root, "/A.a", "--time", 12).stdout
        self.assertIn("at time 12: 7  (valueClips)", text)
        self.assertIn("clip1.usda", text)

    def test_explain_names_the_clips_that_give_the_value(self):
        process = tenon("explain", self.clip_scene(), "/A.a", "--json")
        rows = json.loads(process.stdout)["opinions"]
        self.assertEqual([row["what"] for row in rows if row["used"]], ["valueClips"])

    def test_arcs_of_each_layer_stack_count(self):
        self.write("c.usda", 'def "C"\n{\n}\n')
        self.write("b.usda", 'def "B" (\n    references = @./c.usda@</C>\n)\n{\n}\n')
        root = self.write("root.usda", 'def "A" (\n    references = @./b.usda@</B>\n)\n{\n}\n')
        rows = [row for row in self.where(root, "/A")["opinions"] if row["what"] == "references"]
        self.assertEqual([row["verdict"] for row in rows], ["wins", "wins"])

    def test_list_edits_are_combined_and_explicit_lists_replace(self):
        self.write("weakest.usda", 'def "A" (\n    prepend apiSchemas = ["X"]\n)\n{\n'
                                   '    rel r = </C>\n}\n')
        self.write("weak.usda", '(\n    subLayers = [@./weakest.usda@]\n)\nover "A"\n{\n'
                                '    rel r = </B>\n}\n')
        root = self.write("root.usda", '(\n    subLayers = [@./weak.usda@]\n)\nover "A" (\n'
                                       '    prepend apiSchemas = ["Y"]\n)\n{\n'
                                       '    prepend rel r = </D>\n}\n')
        answer = self.where(root, "/A.r")
        self.assertEqual(answer["value"], ["/D", "/B"])
        self.assertEqual([row["verdict"] for row in answer["opinions"]],
                         ["combined", "wins", "loses"])
        rows = [row for row in self.where(root, "/A")["opinions"] if row["what"] == "apiSchemas"]
        self.assertEqual([(row["value"], row["verdict"]) for row in rows],
                         [("prepend Y", "combined"), ("prepend X", "combined")])
        rows = self.where(root.parent / "weak.usda", "/")["opinions"]
        rows_of_hand = self.where(HAND, "/inspire_hand")["opinions"]
        self.assertIn(("variantSelection", "Physics=physics"),
                      [(row["what"], row["value"]) for row in rows_of_hand])
        self.assertIn("subLayers", [row["what"] for row in rows])

    def test_what_instances_ignore_is_named(self):
        self.write("shape.usda", 'def "S"\n{\n    def "M"\n    {\n        double a = 1\n    }\n}\n')
        root = self.write("root.usda", 'def "A" (\n    instanceable = true\n'
                                       '    references = @./shape.usda@</S>\n)\n{\n'
                                       '    over "M"\n    {\n        double a = 2\n    }\n}\n')
        rows = self.where(root, "/A/M.a")["opinions"]
        self.assertEqual([(row["value"], row["verdict"]) for row in rows],
                         [("1", "wins"), ("2", "ignored")])
        self.assertEqual(rows[1]["line"], 9)

    def test_text_has_a_line_for_each_opinion(self):
        text = tenon("where", HAND, f"{JOINT}.physics:upperLimit").stdout
        self.assertIn("> ", text)
        self.assertIn("through variant Physics=physics", text)
        self.assertIn("schema PhysicsRevoluteJoint  fallback = inf  [loses", text)

    def test_what_is_not_there_is_said(self):
        for name, words in (("/nowhere", "there is no prim"),
                            ("/inspire_hand.nothing", "has no property"),
                            ("relative", "not the path")):
            process = tenon("where", HAND, name)
            self.assertEqual(process.returncode, 2, name)
            self.assertIn(words, process.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
