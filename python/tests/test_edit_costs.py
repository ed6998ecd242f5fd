# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Edits one by one beside usd-core's, in one process: at most 20 times its processor time."""

import time
import unittest

import support

import tenon_usd as tenon

try:
    from pxr import Usd, UsdPhysics
except ImportError:
    Usd = None

COUNT = 1600
MOST = 20
MASS = "physics:mass"


def bodies():
    prims = "".join(f'def Cube "b{i}" (prepend apiSchemas = ["PhysicsMassAPI"])\n{{\n'
                    "float physics:mass = 1\n}\n" for i in range(COUNT))
    return f'#usda 1.0\n(\ndefaultPrim = "W"\n)\ndef Xform "W"\n{{\n{prims}}}\n'


def spent(call, things):
    begun = time.process_time()
    for thing in things:
        call(thing)
    return time.process_time() - begun


@unittest.skipIf(Usd is None, "no usd-core beside the package")
class Costs(support.FilesTestCase):
    def test_edits_cost_at_most_twenty_times_those_of_usd_core(self):
        path = self.written("bodies.usda", bodies())
        own, other = tenon.open(path), Usd.Stage.Open(str(path))
        prims = [f"/W/b{i}" for i in range(COUNT)]
        added = [f"/W/c{i}" for i in range(COUNT)]
        of = other.GetPrimAtPath
        edits = {
            "values": (lambda prim: own[prim].set(MASS, 2.0),
                       lambda prim: of(prim).GetAttribute(MASS).Set(2.0), prims),
            "schemas": (lambda prim: own[prim].apply("PhysicsCollisionAPI"),
                        lambda prim: of(prim).ApplyAPI(UsdPhysics.CollisionAPI), prims),
            "prims": (lambda prim: own.define(prim, "Cube"),
                      lambda prim: other.DefinePrim(prim, "Cube"), added),
        }
        for name, (ours, theirs, things) in edits.items():
            ratio = spent(ours, things) / spent(theirs, things)
            with self.subTest(name):
                self.assertLess(ratio, MOST)
        self.assertEqual({own[prim][MASS] for prim in prims}, {2.0})
        self.assertEqual(len(own.prims), 2 * COUNT + 1)


if __name__ == "__main__":
    support.main()
