# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""tenon_usd.view: the page of an asset for notebooks."""

import html
import os
import re
import unittest

import support

import tenon_usd as tenon


class Pages(support.FilesTestCase):
    def page(self, asset, **options):
        try:
            return tenon.view(asset, **options)
        except tenon.MissingError as reason:
            self.skipTest(str(reason))

    def test_a_page_of_a_path_a_stage_and_a_world(self):
        of_path = self.page(support.GRASP, duration=0.1)
        self.assertEqual(of_path.frames, 4)
        self.assertGreater(of_path.triangles, 1000)
        self.assertEqual(self.page(tenon.open(support.GRASP), duration=0.1).html, of_path.html)
        world = tenon.World(support.GRASP, "jolt", time_step=0.01)
        of_world = self.page(world, duration=0.1)
        same = self.page(support.GRASP, engine="jolt", time_step=0.01, duration=0.1)
        self.assertEqual(of_world.html, same.html)
        self.assertNotEqual(of_world.html, of_path.html)
        with self.assertRaises(TypeError):
            tenon.view(world, physics="mujoco")

    def test_notebooks_show_it_in_a_frame(self):
        page = self.page(support.HAND, duration=0, height=300)
        self.assertEqual(page.frames, 0)
        shown = page._repr_html_()
        frame = re.fullmatch(
            r'<iframe srcdoc="([^"]*)" sandbox="([^"]*)" style="([^"]*)"></iframe>', shown)
        self.assertEqual(html.unescape(frame[1]), page.html)
        self.assertNotIn("allow-same-origin", frame[2])
        self.assertIn("height:300px", frame[3])

    def test_it_is_saved(self):
        page = self.page(support.HAND, duration=0.1, triangles=2000, colliders=False)
        for _ in range(2):
            page.save(self.folder / "hand.html")
        self.assertEqual(os.listdir(self.folder), ["hand.html"])
        self.assertEqual((self.folder / "hand.html").read_text("utf-8"), page.html)
        page.save(self.folder / "made/hand.html")
        self.assertTrue((self.folder / "made/hand.html").is_file())
        with self.assertRaises(OSError):
            page.save(self.folder / "hand.html/hand.html")

    def test_what_makes_no_sense_is_refused(self):
        for wrong in ({"duration": -1}, {"fps": 0}, {"height": 0}, {"engine": "mujocco"},
                      {"time_step": float("nan")}):
            with self.assertRaises((ValueError, tenon.Error), msg=wrong):
                tenon.view(support.HAND, **wrong)
        with self.assertRaises(tenon.MissingFileError):
            tenon.view("nowhere.usda")


if __name__ == "__main__":
    unittest.main()
