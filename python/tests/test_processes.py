# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Processes, signals and threads: errors travel with their findings, Ctrl-C ends what takes long
and leaves everything usable."""

import copy
import errno
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import support

import tenon_usd as tenon
from tenon_usd import errors

WRONG = '#usda 1.0\ndef Xform "a"\n{\n    float x = \n}\n'


def open_it(path):
    return len(tenon.open(path).prims)


def step_it(path):
    world = tenon.World(path, threads=1)
    world.step(20)
    return world.body_poses


class Stopped(Exception):
    """What the handlers of these tests raise."""


class Pickles(support.FilesTestCase):
    def assert_same(self, one, other):
        self.assertIs(type(one), type(other))
        self.assertEqual(str(one), str(other))
        rows = [[(d.severity, d.rule, d.message, d.file, d.line, d.column, d.prim, d.property_name,
                  d.fix, str(d), [(r.path, r.role, r.file) for r in d.related])
                 for d in error.diagnostics] for error in (one, other)]
        self.assertEqual(rows[0], rows[1])

    def raised(self, call, *arguments):
        with self.assertRaises(tenon.Error) as caught:
            call(*arguments)
        return caught.exception

    def test_errors_and_findings_come_out_of_pickles_as_they_were(self):
        gone = self.raised(tenon.open, self.folder / "nope.usda")
        wrong = self.raised(tenon.open, self.written("wrong.usda", WRONG))
        self.assertGreater(wrong.line, 0)
        for error in (gone, wrong):
            for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
                self.assert_same(pickle.loads(pickle.dumps(error, protocol)), error)
            self.assert_same(copy.deepcopy(error), error)
        related = self.written("joint.usda", '''#usda 1.0
(
    defaultPrim = "W"
)
def Xform "W"
{
    def PhysicsRevoluteJoint "joint"
    {
        rel physics:body0 = </W/none>
    }
}
''')
        findings = tenon.physics(related).diagnostics + tenon.open(related).diagnostics
        self.assertTrue(any(finding.related for finding in findings))
        for finding in findings:
            other = pickle.loads(pickle.dumps(finding))
            self.assertEqual(str(other), str(finding))
            self.assertEqual([r.path for r in other.related], [r.path for r in finding.related])

    def test_every_class_of_errors(self):
        for kind in {*errors.CLASSES.values(), tenon.Error}:
            error = kind("what is wrong")
            error.note_of_mine = 7
            again = pickle.loads(pickle.dumps(error))
            self.assert_same(again, error)
            self.assertEqual(again.note_of_mine, 7)

    def test_errors_of_sweeps_and_logs(self):
        from tenon_usd.logs import LogError
        from tenon_usd.sweep import ExtraMissing, FolderError, PlanError
        from tenon_usd.sweep.plan import Fault
        from tenon_usd.sweep.signals import UnknownName

        for error in (PlanError("plan.toml", [Fault("vary 1", 3, "what is wrong")]),
                      ExtraMissing("Ray", "ray", "--on ray"), FolderError("f"), LogError("l"),
                      UnknownName("u")):
            again = pickle.loads(pickle.dumps(error))
            self.assertIs(type(again), type(error))
            self.assertEqual(str(again), str(error))

    def test_a_missing_file_is_told_as_python_tells_it(self):
        path = self.folder / "nope.usda"
        for error in (self.raised(tenon.open, path),
                      pickle.loads(pickle.dumps(self.raised(tenon.open, path)))):
            self.assertIsInstance(error, FileNotFoundError)
            self.assertEqual(error.filename, str(path))
            self.assertEqual(error.errno, errno.ENOENT)
            self.assertNotIn("Errno", str(error))

    def test_pools_tell_the_reason(self):
        hand, gone = os.fspath(support.HAND), str(self.folder / "nope.usda")
        for method in ("fork", "spawn", "forkserver"):
            context = multiprocessing.get_context(method)
            with self.subTest(method), ProcessPoolExecutor(1, context) as pool:
                self.assertGreater(pool.submit(open_it, hand).result(), 10)
                with self.assertRaises(tenon.MissingFileError) as caught:
                    pool.submit(open_it, gone).result()
                self.assertIn("nope.usda", str(caught.exception))
                self.assertEqual(caught.exception.diagnostics[0].rule, "file.not-found")
                np.testing.assert_array_equal(
                    pool.submit(step_it, os.fspath(support.GRASP)).result(), step_it(support.GRASP))

    def test_a_process_that_is_forked_after_steps_steps_on(self):
        world = tenon.World(support.GRASP, envs=4, threads=2)
        world.step(10)
        reading, writing = os.pipe()
        child = os.fork()
        if child == 0:
            try:
                world.step(10)
                os.write(writing, world.body_poses.tobytes())
            finally:
                os._exit(0)
        os.close(writing)
        world.step(10)
        mine = world.body_poses.tobytes()
        with os.fdopen(reading, "rb") as file:
            self.assertEqual(file.read(), mine)
        self.assertEqual(os.waitpid(child, 0)[1], 0)

    def test_a_world_is_not_copied_or_pickled(self):
        world = tenon.World(support.GRASP)
        for call in (copy.copy, copy.deepcopy, pickle.dumps):
            with self.assertRaisesRegex(TypeError, r"restore\(save\(\)\)"):
                call(world)
        other = tenon.World(support.GRASP)
        world.step(30)
        other.restore(pickle.loads(pickle.dumps(world.save())))
        np.testing.assert_array_equal(other.body_poses, world.body_poses)


class Interrupts(support.FilesTestCase):
    def setUp(self):
        super().setUp()
        self.addCleanup(signal.signal, signal.SIGALRM, signal.signal(signal.SIGALRM, self.stop))
        self.addCleanup(signal.setitimer, signal.ITIMER_REAL, 0)

    def stop(self, *_):
        raise Stopped

    def stopped(self, call, *arguments, after=0.3):
        """Calls what would take minutes, and is stopped by a signal."""
        signal.setitimer(signal.ITIMER_REAL, after)
        with self.assertRaises(Stopped):
            call(*arguments)

    def test_steps_end_and_the_world_goes_on_as_if_so_many_had_been_asked_for(self):
        for threads in (1, 2):
            world = tenon.World(support.GRASP, envs=4, threads=threads, outputs=["contacts"])
            self.stopped(world.step, 10**9)
            taken = np.round(world.time / world.time_step).astype(int)
            self.assertGreater(taken[0], 0)
            self.assertLess(taken[0], 10**8)
            np.testing.assert_array_equal(taken, taken[0])
            other = tenon.World(support.GRASP, envs=4, threads=1, outputs=["contacts"])
            other.step(int(taken[0]))
            np.testing.assert_array_equal(world.body_poses, other.body_poses)
            world.step(7)
            other.step(7)
            np.testing.assert_array_equal(world.body_poses, other.body_poses)
            np.testing.assert_array_equal(world.contacts(3)["force"], other.contacts(3)["force"])
            world.reset()
            self.assertEqual(world.time[0], 0)

    def test_ctrl_c_of_a_program(self):
        code = f"""
import tenon_usd as tenon
world = tenon.World({os.fspath(support.GRASP)!r}, threads=1)
print("stepping", flush=True)
try:
    world.step(10**9)
except KeyboardInterrupt:
    print(world.time[0] > 0, world.step(3))
"""
        process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        self.assertEqual(process.stdout.readline(), "stepping\n")
        time.sleep(0.2)
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=60)
        self.assertEqual((process.returncode, out), (0, "True 0\n"))

    def test_a_handler_may_look_at_the_world(self):
        world = tenon.World(support.GRASP, threads=1)
        seen = []

        def look(*_):
            seen.append(float(world.time[0]))
            if len(seen) == 3:
                raise Stopped

        signal.signal(signal.SIGALRM, look)
        signal.setitimer(signal.ITIMER_REAL, 0.1, 0.1)
        with self.assertRaises(Stopped):
            world.step(10**9)
        self.assertEqual(seen, sorted(set(seen)))  # it went on in between
        self.assertEqual(world.time[0], seen[-1])

    def test_sweeps_end(self):
        from tenon_usd.sweep import simulate
        from tenon_usd.sweep.chunks import Results
        from tenon_usd.sweep.plan import load_plan
        from tenon_usd.sweep.work import run_on_threads

        plan = load_plan(str(self.written(
            "plan.toml", f'asset = "{support.GRASP}"\nduration = 100000\nsamples = 4\n'
            '[[vary]]\nscale = "bodyMass@/World/can"\nrandom = [0.5, 2]\n'
            '[[metric]]\nof = "energy"\n')), [])
        results = Results(str(self.folder / "runs"), plan, simulate.digest_of(plan), "csv")
        before = threading.active_count()
        self.stopped(run_on_threads, results, results.missing(range(plan.chunk_count)),
                     simulate.make_runner, 2, after=1.0)
        for _ in range(500):
            if threading.active_count() == before:
                break
            time.sleep(0.02)
        self.assertEqual(threading.active_count(), before)  # nothing goes on behind one's back
        self.assertEqual(len(results.missing(range(plan.chunk_count))), plan.chunk_count)

    def test_what_is_left_writes_nothing(self):
        robot = self.written("slow.urdf", slow_robot())
        out = self.folder / "asset"
        self.stopped(tenon.convert, robot, out, after=0.03)
        tenon._tenon.wait_for_left_calls()
        self.assertFalse(out.exists())
        answer = tenon.convert(robot, out)
        self.assertEqual(answer["links"], LINKS)
        self.stopped(tenon.structure, out / "slow.usda", self.folder / "again", after=0.03)
        tenon._tenon.wait_for_left_calls()
        self.assertFalse((self.folder / "again").exists())

    def test_a_program_that_ctrl_c_ends_does_not_wait(self):
        robot = self.written("slow.urdf", slow_robot())
        code = f"""
import tenon_usd as tenon
print("converting", flush=True)
tenon.convert({str(robot)!r}, {str(self.folder / "asset")!r})
print("done", flush=True)
"""
        process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        self.assertEqual(process.stdout.readline(), "converting\n")
        time.sleep(0.03)
        process.send_signal(signal.SIGINT)
        out, told = process.communicate(timeout=60)
        self.assertEqual((process.returncode, out), (-signal.SIGINT, ""))
        self.assertIn("KeyboardInterrupt", told)
        self.assertFalse((self.folder / "asset").exists())


LINKS = 200


def slow_robot():
    """A robot that takes a while to convert."""
    links = "".join(
        f'<link name="l{i}"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" '
        'ixz="0" iyz="0"/></inertial><collision><geometry><box size="1 1 1"/></geometry>'
        "</collision></link>" for i in range(LINKS))
    joints = "".join(
        f'<joint name="j{i}" type="revolute"><parent link="l{i // 2}"/><child link="l{i + 1}"/>'
        '<axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>'
        for i in range(LINKS - 1))
    return f'<robot name="slow">{links}{joints}</robot>'


class Threads(unittest.TestCase):
    def test_other_threads_run_while_the_library_works(self):
        world = tenon.World(support.GRASP, envs=8, threads=1)
        counted, stop = [0], threading.Event()

        def count():
            while not stop.is_set():
                counted[0] += 1

        thread = threading.Thread(target=count)
        thread.start()
        while not counted[0]:
            time.sleep(0.001)
        before = counted[0]
        world._batch.step(400)
        inside = counted[0] - before
        stop.set()
        thread.join()
        self.assertGreater(inside, 1_000)

    def test_worlds_on_threads_are_those_of_one(self):
        def run(world, found):
            for _ in range(5):
                world.step(20)
            found.append(world.body_poses)

        alone = []
        run(tenon.World(support.GRASP, threads=1), alone)
        found = []
        threads = [threading.Thread(target=run, args=(tenon.World(support.GRASP), found))
                   for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for poses in found:
            np.testing.assert_array_equal(poses, alone[0])


class Environment(unittest.TestCase):
    def test_the_command_finds_the_python_that_it_belongs_to(self):
        # As systemd, pipx and cron start it: nothing of the environment is on the PATH.
        from test_package import PROGRAM

        with tempfile.TemporaryDirectory() as folder:
            plan = os.path.join(folder, "plan.toml")
            with open(plan, "w", encoding="utf-8") as file:
                file.write(f'asset = "{support.GRASP}"\nduration = 0.01\n'
                           '[[vary]]\nscale = "bodyMass@/World/can"\ngrid = [1, 2]\n'
                           '[[metric]]\nof = "energy"\n')
            for more in ({}, {"TENON_PYTHON": ""}):
                done = subprocess.run([PROGRAM, "sweep", plan, "--list"], capture_output=True,
                                      text=True, cwd=folder,
                                      env={"PATH": "/usr/bin:/bin", **more})
                self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    support.main()
