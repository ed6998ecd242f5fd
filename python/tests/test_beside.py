# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The package beside other libraries of its field, in one process and in either order."""

import subprocess
import sys
import unittest

import support

OTHERS = {
    "mujoco": """
import mujoco
model = mujoco.MjModel.from_xml_string(
    '<mujoco><worldbody><body><freejoint/><geom size="1"/></body></worldbody></mujoco>')
data = mujoco.MjData(model)
mujoco.mj_step(model, data, 10)
assert abs(data.qvel[2] + 9.81 * data.time) < 1e-9
""",
    "pxr": f"""
from pxr import Usd
stage = Usd.Stage.Open({str(support.HAND)!r})
assert len(list(stage.Traverse())) > 20
""",
    "gymnasium": """
import gymnasium
import tenon_usd.gym
""",
}
OWN = f"""
import tenon_usd
world = tenon_usd.World({str(support.GRASP)!r})
world.step(5)
assert world.engine == "mujoco" and world.contact_counts[0] > 0
"""


class Beside(unittest.TestCase):
    def run_together(self, *parts):
        done = subprocess.run([sys.executable, "-c", "".join(parts)], capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_in_either_order(self):
        for name, other in OTHERS.items():
            with self.subTest(name):
                self.run_together(OWN, other, OWN)
                self.run_together(other, OWN, other)

    def test_models_are_made_by_the_users_mujoco(self):
        self.run_together(OWN, """
import mujoco
model = world.model
assert isinstance(model, mujoco.MjModel) and model.nv == world.dofs
data = mujoco.MjData(model)
mujoco.mj_step(model, data, 10)
""")


if __name__ == "__main__":
    support.main()
