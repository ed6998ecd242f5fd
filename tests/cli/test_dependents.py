#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""tenon rename and tenon remove of prims that others are composed of, or that lists, layers and
arcs name. What is expected is what UsdNamespaceEditor of OpenUSD 26.11 makes of the same layers,
unless a test says otherwise.

usage: test_dependents.py TENON
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import textwrap
import unittest

TENON = str(pathlib.Path(sys.argv[1]).resolve())
MODEL = 'def "Model"\n{\n    def "Arm"\n    {\n        double mass = 1\n    }\n}\n'


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.root = self.folder / "root.usda"

    def write(self, name, text):
        (self.folder / name).write_text("#usda 1.0\n" + textwrap.dedent(text), encoding="utf-8")
        return self.folder / name

    def text(self, name="root.usda"):
        return (self.folder / name).read_text(encoding="utf-8")

    def tenon(self, *arguments):
        return subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                              check=False, cwd=self.folder)  # fmt: skip

    def do(self, *arguments):
        run = self.tenon(*arguments)
        self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
        return run.stdout

    def refused(self, rule, *arguments):
        """The edit as a whole: no file changes."""
        before = {path: path.read_bytes() for path in self.folder.iterdir() if path.is_file()}
        run = self.tenon(*arguments)
        self.assertEqual(run.returncode, 2, run.stderr + run.stdout)
        self.assertIn(f"[{rule}]", run.stderr)
        self.assertEqual(before, {path: path.read_bytes() for path in before})
        return run.stderr

    def value(self, attribute, asset="root.usda", flags=()):
        run = self.tenon("test-runner", "value", asset, attribute, "default", *flags)
        return json.loads(run.stdout)["default"] if run.returncode == 0 else None


class Renamed(Case):
    def test_opinions_over_a_reference_follow(self):
        self.write("root.usda", MODEL + '''
            def "Robot1" (
                references = </Model>
            )
            {
                over "Arm"  # heavier
                {
                    double mass = 7
                }
                rel to = </Robot1/Arm>
            }
        ''')  # fmt: skip
        self.do("rename", "root.usda", "/Model/Arm", "Link")
        self.assertEqual(self.value("/Robot1/Link.mass"), 7)
        self.assertIn('over "Link"  # heavier', self.text())
        self.assertIn("rel to = </Robot1/Link>", self.text())
        self.assertNotIn("Arm", self.text())

    def test_path_expressions_follow(self):
        self.write("root.usda", """
            def "World" (
                prepend apiSchemas = ["CollectionAPI:c"]
            )
            {
                pathExpression collection:c:membershipExpression = "/Model/Arm//{isa:Mesh} + /World"
                pathExpression collection:d:membershipExpression = "../Model/Arm - %/Model/Arm:x"
                pathExpression[] several = ["/Model/Arms", "/Model/Arm/*"]
            }
            def "Robot" (
                references = </Model>
            )
            {
                pathExpression e = "/Robot/Arm & /Model"
            }
            """ + MODEL)
        self.do("rename", "root.usda", "/Model/Arm", "Link")
        for text in ('/Model/Link//{isa:"Mesh"} + /World', "/Model/Link - %/Model/Link:x",
                     '["/Model/Arms", "/Model/Link/*"]', "/Robot/Link & /Model"):
            self.assertIn(text, self.text())

    def test_properties_of_what_is_composed_of_the_prim_follow(self):
        self.write("root.usda", """
            (
                subLayers = [@sub.usda@]
            )
            def "Robot" (
                references = </Model/Arm>
                variants = {
                    string v = "a"
                }
                prepend variantSets = "v"
            )
            {
                double mass = 7
                rel to = </Robot.mass>
                variantSet "v" = {
                    "a" {
                    }
                    "b" {
                        double mass = 8
                    }
                }
            }
            def "Both" (
                inherits = </Model>
            )
            {
                over "Arm"
                {
                    double mass = 9
                    double x.connect = </Both/Arm.mass>
                }
            }
            """)
        self.write("sub.usda", MODEL)
        self.do("rename", "root.usda", "/Model/Arm.mass", "weight")
        self.assertEqual(self.value("/Robot.weight"), 7)
        self.assertEqual(self.value("/Both/Arm.weight"), 9)
        self.assertNotIn("mass", self.text())
        self.assertNotIn("mass", self.text("sub.usda"))
        for text in ("rel to = </Robot.weight>", "x.connect = </Both/Arm.weight>",
                     "double weight = 8"):
            self.assertIn(text, self.text())

    def test_a_property_that_a_dependent_has_elsewhere_refuses_the_whole_edit(self):
        self.write("root.usda", """
            def "Robot" (
                references = [</Model/Arm>, </Other>]
            )
            {
                double mass = 7
            }
            def "Other"
            {
                double mass = 3
            }
            """ + MODEL)
        self.refused("edit.in-use", "rename", "root.usda", "/Model/Arm.mass", "weight")
        self.write("root.usda", """
            def "Robot" (
                references = </Model/Arm>
            )
            {
                double weight = 7
            }
            """ + MODEL)
        self.refused("edit.property-exists", "rename", "root.usda", "/Model/Arm.mass", "weight")

    def test_opinions_over_inherits_specializes_and_payloads_follow(self):
        for arc in ("inherits", "specializes", "payload"):
            self.write("root.usda", f'''
                class "_X"
                {{
                    def "B"
                    {{
                        double x = 1
                    }}
                }}
                def "Y" (
                    {arc} = </_X>
                )
                {{
                    over "B"
                    {{
                        double x = 2
                    }}
                }}
                def "Z" (
                    references = </Y>
                )
                {{
                    over "B"
                    {{
                        double x = 3
                    }}
                }}
            ''')  # fmt: skip
            with self.subTest(arc=arc):
                self.do("rename", "root.usda", "/_X/B", "C")
                self.assertEqual([self.value(f"/{prim}/C.x") for prim in ("_X", "Y", "Z")],
                                 [1, 2, 3])  # fmt: skip
                self.assertNotIn('"B"', self.text())

    def test_other_files_that_reference_the_same_one_follow(self):
        """The file between is no layer of the asset's own, but depends on one that is."""
        self.write("sub.usda", '(\n    defaultPrim = "Model"\n)\n' + MODEL)
        self.write("middle.usda", '''
            def "M" (
                references = @./sub.usda@
            )
            {
                over "Arm"
                {
                    double mass = 3
                }
            }
        ''')  # fmt: skip
        self.write("root.usda", '''
            (
                subLayers = [@./sub.usda@]
            )
            def "R" (
                references = @./middle.usda@</M>
            )
            {
                over "Arm"
                {
                    rel to = </R/Arm>
                }
            }
            def "Q" (
                payload = @./sub.usda@</Model/Arm>
            )
            {
            }
        ''')  # fmt: skip
        out = self.do("rename", "root.usda", "/Model/Arm", "Link")
        self.assertEqual(self.value("/R/Link.mass"), 3)
        self.assertEqual(self.value("/Q.mass"), 1)
        self.assertIn("rel to = </R/Link>", self.text())
        self.assertNotIn("Arm", self.text() + self.text("middle.usda") + self.text("sub.usda"))
        self.assertIn("middle.usda", out)

    def test_a_default_prim_follows_in_each_layer(self):
        self.write("sub.usda", '(\n    defaultPrim = "Model"\n)\n' + MODEL)
        self.write("root.usda", '''
            (
                defaultPrim = "/Model/Arm"
                subLayers = [@./sub.usda@]
            )
            def "R" (
                references = @./sub.usda@
            )
            {
            }
        ''')  # fmt: skip
        self.do("rename", "root.usda", "/Model", "Robot")
        self.assertIn('defaultPrim = "/Robot/Arm"', self.text())
        self.assertIn('defaultPrim = "Robot"', self.text("sub.usda"))
        self.assertEqual(self.value("/R/Arm.mass"), 1)

    def test_variants_that_are_not_selected_follow(self):
        """OpenUSD leaves them: `b` would lose its opinion."""
        self.write("root.usda", MODEL + '''
            def "R" (
                prepend variantSets = "v"
                variants = {
                    string v = "a"
                }
            )
            {
                variantSet "v" = {
                    "a" {
                    }
                    "b" (
                        references = </Model>
                    ) {
                        over "Arm"
                        {
                            double mass = 5
                        }
                    }
                }
            }
        ''')  # fmt: skip
        self.do("rename", "root.usda", "/Model/Arm", "Link")
        self.assertNotIn("Arm", self.text())
        self.root.write_text(self.text().replace('v = "a"', 'v = "b"'), encoding="utf-8")
        self.assertEqual(self.value("/R/Link.mass"), 5)

    def test_classes_that_a_reference_implies_follow(self):
        self.write("sub.usda", '''
            class "_K"
            {
                def "B"
                {
                    double x = 1
                }
            }
            def "R" (
                inherits = </_K>
            )
            {
            }
        ''')  # fmt: skip
        self.write("user.usda", '''
            class "_K"
            {
                over "B"
                {
                    double y = 2
                }
            }
            def "U" (
                references = @./sub.usda@</R>
            )
            {
            }
        ''')  # fmt: skip
        self.write("root.usda", '''
            (
                subLayers = [@./sub.usda@]
            )
            def "W" (
                references = @./user.usda@</U>
            )
            {
            }
        ''')  # fmt: skip
        self.do("rename", "root.usda", "/_K/B", "C")
        self.assertEqual(self.value("/W/C.y"), 2)
        self.assertNotIn('"B"', self.text("user.usda"))

    def test_a_relocate_follows_and_its_target_stays(self):
        self.write("root.usda", '''
            (
                relocates = {
                    </R/Arm>: </R/Hand>
                }
            )
        ''' + textwrap.indent(MODEL, " " * 12) + '''
            def "R" (
                references = </Model>
            )
            {
                over "Hand"
                {
                    double mass = 4
                }
            }
        ''')  # fmt: skip
        self.do("rename", "root.usda", "/Model/Arm", "Link")
        self.assertIn("</R/Link>: </R/Hand>", self.text())
        self.assertEqual(self.value("/R/Hand.mass"), 4)

    def test_targets_below_instances_follow(self):
        self.write("root.usda", MODEL + '''
            def "I" (
                instanceable = true
                references = </Model>
            )
            {
            }
            def "J"
            {
                rel to = </I/Arm>
            }
        ''')  # fmt: skip
        self.do("rename", "root.usda", "/Model/Arm", "Link")
        self.assertIn("rel to = </I/Link>", self.text())

    def test_what_cannot_follow_refuses_the_whole_edit(self):
        other = 'def "Other"\n{\n    def "Arm"\n    {\n    }\n}\n'
        self.write("root.usda", MODEL + other + '''
            def "R" (
                references = [</Model>, </Other>]
            )
            {
                over "Arm"
                {
                    double mass = 7
                }
            }
        ''')  # fmt: skip
        error = self.refused("edit.in-use", "rename", "root.usda", "/Model/Arm", "Link")
        self.assertIn("</R/Arm>", error)
        self.refused("edit.in-use", "remove", "root.usda", "/Model/Arm")

    def test_a_dependent_that_nothing_is_said_about_may_stay(self):
        """It is made of the other prim alone then, and no opinion is lost."""
        self.write("root.usda", MODEL + '''
            def "Other"
            {
                def "Arm"
                {
                    double size = 2
                }
            }
            def "R" (
                references = [</Model>, </Other>]
            )
            {
            }
        ''')  # fmt: skip
        self.do("rename", "root.usda", "/Model/Arm", "Link")
        self.assertEqual([self.value("/R/Link.mass"), self.value("/R/Arm.size")], [1, 2])

    def test_a_dependent_in_a_file_that_is_read_only_refuses_the_whole_edit(self):
        self.write("sub.usda", MODEL)
        self.write("middle.usda", '''
            def "M" (
                references = @./sub.usda@</Model>
            )
            {
                over "Arm"
                {
                }
            }
        ''').chmod(0o444)  # fmt: skip
        self.write("root.usda", '''
            (
                subLayers = [@./sub.usda@]
            )
            def "R" (
                references = @./middle.usda@</M>
            )
            {
            }
        ''')  # fmt: skip
        self.refused("file.unwritable", "rename", "root.usda", "/Model/Arm", "Link")

    def test_a_name_that_a_dependent_has_already_is_refused(self):
        self.write("root.usda", MODEL + '''
            def "R" (
                references = </Model>
            )
            {
                def "Link"
                {
                }
            }
        ''')  # fmt: skip
        error = self.refused("edit.prim-exists", "rename", "root.usda", "/Model/Arm", "Link")
        self.assertIn("</R/Link>", error)


class Removed(Case):
    def test_opinions_over_a_reference_go(self):
        self.write("root.usda", MODEL + '''
            def "Robot1" (
                references = </Model>
            )
            {
                over "Arm"
                {
                    double mass = 7
                }
                rel to = </Robot1/Arm>
                double x.connect = </Robot1/Arm.mass>
            }
        ''')  # fmt: skip
        self.do("remove", "root.usda", "/Model/Arm")
        self.assertNotIn("Arm", self.text())

    def test_a_default_prim_that_goes_is_no_longer_named(self):
        self.write("root.usda", '(\n    defaultPrim = "A"\n)\n\ndef "A"\n{\n}\n\ndef "B"\n{\n}\n')
        out = self.do("remove", "root.usda", "/A")
        self.assertNotIn("defaultPrim", self.text())
        self.assertIn("names no more /A", out)

    def test_an_emptied_list_lets_no_weaker_target_through(self):
        self.write("weak.usda", '''
            def "B"
            {
                custom rel r = </W>
                double x.connect = </W.y>
            }
            def "W"
            {
                double y = 1
            }
        ''')  # fmt: skip
        self.write("root.usda", '''
            (
                subLayers = [@./weak.usda@]
            )
            over "B"
            {
                rel r = </V>
                double x.connect = </V.y>
                prepend rel p = </V>
            }
            def "V"
            {
                double y = 2
            }
        ''')  # fmt: skip
        self.do("remove", "root.usda", "/V")
        self.assertIn("rel r = None", self.text())
        self.assertIn("double x.connect = None", self.text())
        self.assertNotIn("rel p", self.text())

    def test_path_expressions_lose_what_goes(self):
        self.write("root.usda", """
            def "World"
            {
                pathExpression a = "/V//{isa:Mesh} + /W"
                pathExpression b = "/W - /V/x"
                pathExpression c = "/V"
                rel r = </V> (
                    doc = "kept"
                )
            }
            def "V"
            {
            }
            """)
        self.do("remove", "root.usda", "/V")
        for text in ('a = "/W"', 'b = "/W"', 'c = ""', 'doc = "kept"'):
            self.assertIn(text, self.text())

    def test_relocates_of_what_goes_go(self):
        self.write("root.usda", '''
            (
                relocates = {
                    </R/Arm>: </R/Hand>,
                    </R/Other>: </R/Rest>
                }
            )
            def "Model"
            {
                def "Arm"
                {
                }
                def "Other"
                {
                }
            }
            def "R" (
                references = </Model>
            )
            {
            }
        ''')  # fmt: skip
        self.do("remove", "root.usda", "/Model/Arm")
        self.assertNotIn("Arm", self.text())
        self.assertIn("</R/Other>: </R/Rest>", self.text())

    def test_what_an_arc_of_another_file_leads_to_stays(self):
        self.write("sub.usda", '(\n    defaultPrim = "Model"\n)\n' + MODEL)
        for arc in ("@./sub.usda@</Model/Arm>", "@./sub.usda@"):
            self.write("root.usda", f'''
                (
                    subLayers = [@./sub.usda@]
                )
                def "Q" (
                    references = {arc}
                )
                {{
                }}
            ''')  # fmt: skip
            with self.subTest(arc=arc):
                error = self.refused("edit.in-use", "remove", "root.usda",
                                     "/Model/Arm" if "Arm" in arc else "/Model")
                self.assertIn("</Q>", error)


class Told(Case):
    def test_json_tells_whether_files_were_written(self):
        self.write("root.usda", '''
            def "A" (
                references = @./missing.usda@
            )
            {
            }
            def "B"
            {
                double x = 1
            }
        ''')  # fmt: skip
        before = self.text()
        for more, written in ((["--dry-run"], False), ([], True)):
            run = self.tenon("set", "root.usda", "/B.x=2", "--json", *more)
            self.assertEqual(run.returncode, 1)
            self.assertEqual(json.loads(run.stdout)["written"], written)
            self.assertEqual(self.text() != before, written)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
