#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Plans, cases and results of `tenon sweep`, with a runner that is a formula: no wheel is needed.

    test_sweep_logic.py [-v]
"""

import contextlib
import csv
import io
import json
import os
import pathlib
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time
import unittest
from unittest import mock

import numpy as np
import sweep_source
from sweep_source import PLAN, Stone

from tenon_usd._command import text_of
from tenon_usd.sweep import (Cases, ExtraMissing, FolderError, Outcome, PlanError, Results,
                             load_plan, plan_from_table, run_on_threads, shard_of)
from tenon_usd.sweep.command import main
from tenon_usd.sweep.plan import vary_from_text
from tenon_usd.sweep.report import page, rank_correlation


def has(*names):
    try:
        for name in names:
            __import__(name)
    except ImportError:
        return False
    return True


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.put(PLAN)

    def put(self, text, name="plan.toml"):
        (self.folder / name).write_text(text, encoding="utf-8")
        return str(self.folder / name)

    def faults(self, text):
        with self.assertRaises(PlanError) as caught:
            load_plan(self.put(text, "bad.toml"))
        return [(fault.row, fault.line, fault.message) for fault in caught.exception.faults]

    def sweep(self, *words, code=None):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            found = main([str(self.folder / "plan.toml"), *map(str, words)], Stone,
                         sweep_source.digest_of)
        if code is not None:
            self.assertEqual(found, code, out.getvalue() + err.getvalue())
        return out.getvalue(), err.getvalue()

    def bytes_of(self, *words, form="csv", code=1):
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        self.sweep("-o", folder, "--format", form, *words, code=code)
        path = folder / f"result.{form}"
        return path.read_bytes() if path.exists() else None


class Plans(Folder):
    def test_a_plan_is_what_its_file_says(self):
        plan = load_plan(str(self.folder / "plan.toml"))
        self.assertEqual((plan.case_count, plan.grid_points, plan.chunk_count), (100, 4, 13))
        self.assertEqual([row.name for row in plan.vary], ["bodyMass", "height"])
        self.assertEqual(plan.metrics[0].take, "final")
        self.assertEqual(plan.asset_path(plan.asset), str(self.folder / "stone.usda"))

    def test_each_fault_is_named_with_its_row_and_line(self):
        faults = self.faults('asset = 5\nduration = -1\ntime = 2\n[[vary]]\nscale = "m"\n'
                             '[[vary]]\nscale = "m"\nset = "/A.b"\ngrid = [1]\n[[vary]]\n'
                             'scale = "m"\nrandom = [3, 1]\n[[metric]]\ntake = "final"\n'
                             '[[metric]]\nof = "x"\ntake = "sum"\n')
        rows = {(row, line) for row, line, _ in faults}
        self.assertLessEqual({("vary 1", 4), ("vary 2", 6), ("vary 3", 10), ("metric 1", 13),
                              ("metric 2", 15)}, rows)
        text = "\n".join(message for _, _, message in faults)
        for word in ("asset is 5", "duration is -1", 'no "time"', "with which values",
                     "['scale', 'set']", "not above the second", "`of` says", "'sum'"):
            self.assertIn(word, text)

    def test_bad_values_are_faults(self):
        row = 'asset = "a"\n[[vary]]\nscale = "m"\n'
        for text in (row + "grid = []\n", row + "grid = [[1]]\n", row + "grid = [nan]\n",
                     row + "grid = {from = 1, to = 2, count = 0}\n", row + "random = [1]\n",
                     row + "random = [0, 1]\ndistribution = \"log\"\n", row + "random = [0, inf]\n",
                     row + "random = [0, 1]\ndistribution = \"beta\"\n",
                     row + "random = [0, -1]\ndistribution = \"normal\"\n",
                     row + 'grid = ["a"]\n', 'asset = "a"\n[[vary]]\nasset = [1]\n',
                     'asset = "a"\nsamples = 2\n' + row[12:] + "grid = [1]\n",
                     'asset = "a"\nvary = 3\n', 'asset = "a"\nvary = [1]\n', "duration = 1\n",
                     'asset = "a"\nseed = true\n', 'asset = "a"\nchunk = 0\n', "a =\n", "\x00",
                     'asset = "a"\n[[metric]]\nof="x"\nname="case"\n',
                     row + "grid = [1]\n" + row[12:] + "grid = [1]\n",
                     row + "grid = {from = 0, to = 1, count = 100000}\n" + row[12:]
                     + 'name = "b"\ngrid = {from = 0, to = 1, count = 100000}\n'):
            with self.subTest(text):
                self.assertTrue(self.faults(text))

    def test_a_plan_that_is_too_large_or_no_text(self):
        self.assertTrue(self.faults("#" * (1 << 20) + "\n"))
        path = self.folder / "bytes.toml"
        path.write_bytes(b"asset = \"\xff\"\n")
        self.assertRaises(PlanError, load_plan, str(path))

    def test_files_that_would_cost_much_or_hold_us(self):
        """Each takes minutes or gigabytes, or ends with a traceback, where nothing looks for it."""
        row = 'asset = "a"\n[[vary]]\nscale = "m"\n'
        large = "grid = {from = 0, to = 1, count = 1000000}\n"
        for text, words in (
                ("duration = 1" + "0" * 400, "64 bits"), ("duration = 1" + "0" * 5000, "64 bits"),
                ("a = 0x" + "f" * 5000, "64 bits"), ("a = " + "[" * 5000 + "]" * 5000, "too deep"),
                ("a" + ".a" * 20000 + " = 1", "names"), ("[a" + ".a" * 20000 + "]\n", "names"),
                ('asset = "a"\n' + "".join(row[12:] + f'name = "n{at}"\n' + large
                                           for at in range(40)), "cases or more"),
                ('asset = "a"\n' + "[[vary]]\n" * 100000, "further faults"),
                ("".join(f"k{at} = 1\n" for at in range(50000)), "further faults"),
                ('asset = "a"\n' + '[[metric]]\nof = "x"\n' * 30000, "further faults"),
                ('asset = "a\\u0000b"\n', "one line"), (row + 'grid = ["a\\n"]\n', "one line"),
                (row + "random = [" + "[1]," * 100000 + "]\n", "...")):
            began = time.process_time()
            faults = self.faults(text)
            with self.subTest(text[:40]):
                self.assertIn(words, " ".join(fault[2] for fault in faults))
                self.assertLess(sum(len(fault[2]) for fault in faults), 10000)
                self.assertLess(time.process_time() - began, 20)
        os.mkfifo(self.folder / "pipe.toml")
        self.assertRaises(OSError, load_plan, str(self.folder / "pipe.toml"))
        self.put("\ufeff" + PLAN, "bom.toml")
        self.assertEqual(load_plan(str(self.folder / "bom.toml")).seed, 7)
        self.assertEqual(self.faults('seed = 7\na = "\n')[0][1], 2)

    def test_errors_of_files_name_them(self):
        with self.assertRaises(FileNotFoundError) as caught:
            load_plan(str(self.folder / "plam.toml"))
        self.assertEqual(text_of(caught.exception), f"{self.folder}/plam.toml: No such file or "
                         f"directory; did you mean {self.folder}/plan.toml?")

    def test_rows_of_the_command_line(self):
        self.assertEqual(vary_from_text("bodyMass@/A=0.8..1.2"),
                         {"scale": "bodyMass@/A", "random": [0.8, 1.2]})
        self.assertEqual(vary_from_text("/A.physics:mass=1:3:5"),
                         {"set": "/A.physics:mass", "grid": {"from": 1.0, "to": 3.0, "count": 5}})
        self.assertEqual(vary_from_text("/A.axis=X,Y"), {"set": "/A.axis", "grid": ["X", "Y"]})
        self.assertEqual(vary_from_text("engine=mujoco,jolt"), {"engine": ["mujoco", "jolt"]})
        for text in ("", "a", "a=", "=1..2", "a=b..c", "a=1:2:x"):
            self.assertRaises(PlanError, vary_from_text, text)

    def test_an_asset_alone_is_a_plan(self):
        plan = load_plan("x/hand.usda", ["bodyMass=0.5..2"], samples=10)
        self.assertEqual((plan.asset, plan.folder, plan.case_count),
                         ("hand.usda", os.path.abspath("x"), 10))

    def test_the_digest_tells_all_that_cases_depend_on(self):
        plan = load_plan(str(self.folder / "plan.toml"))
        digests = {plan.digest(), plan.digest({"a": b"1"}), plan.digest({"a": b"2"}),
                   plan.digest({"b": b"1"}), plan.digest({}, "0.2"),
                   load_plan(self.put(PLAN.replace("seed = 7", "seed = 8"))).digest(),
                   load_plan(self.put(PLAN.replace("chunk = 8", "chunk = 9"))).digest()}
        self.assertEqual(len(digests), 7)
        shutil.copytree(self.folder, self.folder / "moved", ignore=lambda *_: ["moved"])
        self.put(PLAN)
        self.assertEqual(plan.digest(), load_plan(str(self.folder / "plan.toml")).digest())


class Values(Folder):
    def cases(self, rows, **keys):
        plan = plan_from_table({"asset": "a", "vary": rows, **keys}, "")
        return [Cases(plan)[i].values for i in range(plan.case_count)]

    def test_grids_are_all_combinations_the_last_fastest(self):
        cases = self.cases([{"scale": "a", "grid": [1, 2]},
                            {"set": "/A.b", "grid": ["x", "y", "z"]}])
        self.assertEqual(cases, [(a, b) for a in (1.0, 2.0) for b in "xyz"])

    def test_draws_are_those_of_a_formula_and_fill_their_range(self):
        rows = [{"scale": "a", "random": [2, 4]},
                {"scale": "b", "random": [1, 100], "distribution": "log"},
                {"scale": "c", "random": [5, 2], "distribution": "normal"}]
        cases = self.cases(rows, samples=2000, seed=3)
        a, b, c = zip(*cases)
        self.assertTrue(2 <= min(a) < 2.01 and 3.99 < max(a) <= 4)
        self.assertAlmostEqual(sum(a) / len(a), 3, delta=0.05)
        self.assertAlmostEqual(sorted(b)[1000], 10, delta=1.5)
        self.assertAlmostEqual(sum(c) / len(c), 5, delta=0.15)
        self.assertAlmostEqual((sum((x - 5)**2 for x in c) / len(c))**0.5, 2, delta=0.1)
        self.assertEqual(cases[:50], self.cases(rows, samples=50, seed=3))
        self.assertNotEqual(cases[:50], self.cases(rows, samples=50, seed=4))

    def test_each_grid_point_has_the_same_draws(self):
        cases = self.cases([{"scale": "a", "grid": [1, 2]}, {"scale": "b", "random": [0, 1]}],
                           samples=3)
        self.assertEqual([b for _, b in cases[:3]], [b for _, b in cases[3:]])

    @unittest.skipUnless(has("scipy"), "SciPy is not installed")
    def test_sobol_fills_a_square_evenly_whatever_order_is_asked(self):
        rows = [{"scale": "a", "sobol": [0, 1]}, {"scale": "b", "sobol": [0, 1]}]
        cases = self.cases(rows, samples=256, seed=5)
        cells = {(int(a * 16), int(b * 16)) for a, b in cases}
        self.assertEqual(len(cells), 256)  # one point in each of 16 x 16 cells
        plan = plan_from_table({"asset": "a", "vary": rows, "samples": 256, "seed": 5}, "")
        backwards = Cases(plan)
        self.assertEqual([backwards[i].values for i in reversed(range(256))], cases[::-1])

    @unittest.skipIf(has("scipy"), "SciPy is installed")
    def test_sobol_without_scipy_says_what_to_install(self):
        with self.assertRaisesRegex(ExtraMissing, r"tenon-usd\[sobol\]"):
            self.cases([{"scale": "a", "sobol": [0, 1]}])


class Levels(Folder):
    def test_threads_and_shards_give_the_same_bytes(self):
        whole = self.bytes_of("-j", 1)
        self.assertEqual(self.bytes_of("-j", 4), whole)
        folder = self.folder / "shards"
        for index in (2, 0, 3, 1):
            self.sweep("-o", folder, "--format", "csv", "--shard", f"{index}/4")
        self.assertEqual((folder / "result.csv").read_bytes(), whole)

    def test_rows_are_those_of_the_formula(self):
        rows = list(csv.DictReader(io.StringIO(self.bytes_of("-j", 2).decode())))[:-1]
        self.assertEqual([int(row["case"]) for row in rows], list(range(100)))
        plan = load_plan(str(self.folder / "plan.toml"))
        unstable = 0
        for row in rows:
            wanted = Stone(plan).outcome(float(row["bodyMass"]), float(row["height"]))
            self.assertEqual(row["status"], wanted.status)
            if wanted.status == "ok":
                self.assertEqual(float(row["speed"]), wanted.metrics[0])
            else:
                unstable += 1
                self.assertEqual((row["rule"], row["speed"]), ("simulation.unstable", "nan"))
        self.assertGreater(unstable, 0)

    def test_every_format_reads_back_the_same(self):
        forms = ["csv", "npz"] + (["parquet"] if has("pyarrow") else [])
        plan = load_plan(str(self.folder / "plan.toml"))
        found = []
        for form in forms:
            results = Results(str(self.folder / form), plan, "d", form)
            run_on_threads(results, range(plan.chunk_count), Stone, 2)
            found.append([{key: repr(value) for key, value in row.items()}
                          for row in results.rows()])
            with open(results.merge(), "rb") as file:
                first = file.read()
            time.sleep(0.01)
            with open(results.merge(), "rb") as file:
                self.assertEqual(file.read(), first)
        self.assertTrue(all(rows == found[0] for rows in found))

    def test_merge_alone_and_list(self):
        out, _ = self.sweep("-o", self.folder / "r", "--merge", "--format", "csv", code=1)
        self.assertIn("missing", out)
        out, _ = self.sweep("--list", code=0)
        self.assertEqual(len(out.splitlines()), 101)

    def test_json_names_what_failed(self):
        out, _ = self.sweep("-o", self.folder / "r", "--format", "csv", "--json", code=1)
        answer = json.loads(out)
        self.assertEqual(answer["statuses"]["ok"] + len(answer["failed"]), 100)
        self.assertIn("m, ä", answer["failed"][0]["error"])

    def test_a_report_has_counts_numbers_plots_and_what_failed(self):
        folder = self.folder / "<r>"
        out, _ = self.sweep("-o", folder, "--format", "csv", "--report", code=1)
        self.assertIn(str(folder / "report.html"), out)
        text = (folder / "report.html").read_text(encoding="utf-8")
        out, _ = self.sweep("-o", folder, "--merge", "--json", "--report", code=1)
        answer = json.loads(out)
        self.assertEqual(answer["report"], str(folder / "report.html"))
        self.assertEqual((folder / "report.html").read_text(encoding="utf-8"), text)
        lines = (folder / "result.csv").read_text(encoding="utf-8").splitlines()
        rows = list(csv.DictReader(line for line in lines if line[0] != "#"))
        good = [float(row["speed"]) for row in rows if row["status"] == "ok"]
        cells = re.findall(r"<td[^>]*>([^<]*)</td>", text)
        self.assertIn("100 of 100", cells)
        at = cells.index("speed [m/s]")
        self.assertEqual(cells[at + 1:at + 4], [str(len(good)), f"{min(good):.5g}",
                                                f"{statistics.median(good):.5g}"])
        plots = text.split("<svg")[1:]
        self.assertEqual([plot.count("<circle") for plot in plots], [len(good)] * 2)
        self.assertEqual([plot.count("<polyline") for plot in plots], [1, 0])
        self.assertEqual(text.count("<td>unstable</td>"), 100 - len(good) + 1)
        for absent in ("<script", "http:", "https:", "src="):
            self.assertNotIn(absent, text)

    def test_a_report_of_names_and_of_nothing_is_whole(self):
        plan = plan_from_table({"asset": "a&b.usda", "vary": [
            {"name": "<b>", "scale": "m", "grid": [1, 2]}, {"engine": ["mujoco", "<i>"]}],
            "metric": [{"name": "m\"", "of": "energy"}]}, "")
        rows = [{"case": i, "<b>": 1.0 + i // 2, "engine": ("mujoco", "<i>")[i % 2], "m\"": 5.0,
                 "status": "ok", "time": 1.0, "rule": "", "error": ""} for i in range(4)]
        for some in (rows, []):
            text = page(plan, some)
            self.assertNotIn("<b>", text)
            self.assertNotIn("<i>", text)
            self.assertIn("a&amp;b.usda", text)
        many = [{**rows[0], "case": i} for i in range(9000)]
        self.assertLessEqual(page(plan, many).count("<circle"), 2 * 2000)

    def test_rank_correlations(self):
        x = np.arange(5.0)
        # 1 - 6 sum d^2 / (n (n^2 - 1)) where no values are equal.
        self.assertAlmostEqual(rank_correlation(x, np.array([2.0, 1, 4, 3, 5])), 0.8)
        self.assertAlmostEqual(rank_correlation(x, -np.exp(x)), -1)
        self.assertAlmostEqual(rank_correlation(np.array([1.0, 2, 2, 3]),
                                                np.array([5.0, 7, 7, 9])), 1)
        self.assertTrue(np.isnan(rank_correlation(x, np.ones(5))))

    def test_a_shard_that_is_none(self):
        for shard in ("4/4", "a/4", "1", "-1/4", "1/0"):
            self.sweep("-o", self.folder / "r", "--shard=" + shard, code=2)
        self.assertRaises(ValueError, shard_of, 10, (4, 4))

    def test_an_error_of_a_worker_ends_the_run_and_keeps_what_is_done(self):
        class Breaks(Stone):
            def run(self, cases):
                if cases[0].index == 40:
                    raise RuntimeError("broken")
                return super().run(cases)
        plan = load_plan(str(self.folder / "plan.toml"))
        results = Results(str(self.folder / "r"), plan, "d", "csv")
        with self.assertRaisesRegex(RuntimeError, "broken"):
            run_on_threads(results, range(plan.chunk_count), Breaks, 1)
        self.assertEqual(results.missing(range(13)), list(range(5, 13)))

    def test_progress_is_told(self):
        plan, told = load_plan(str(self.folder / "plan.toml")), []
        results = Results(str(self.folder / "r"), plan, "d", "csv")
        run_on_threads(results, range(13), Stone, 1, lambda *numbers: told.append(numbers))
        self.assertEqual((told[0][:2], told[-1][:2], len(told)), ((8, 100), (100, 100), 13))


class Resuming(Folder):
    def test_what_is_there_is_not_done_again(self):
        folder = self.folder / "r"
        self.sweep("-o", folder, "--format", "csv", "--shard", "0/2")
        kept = {path.name: path.stat().st_mtime_ns for path in (folder / "chunks").iterdir()}
        self.sweep("-o", folder, code=1)
        for name, when in kept.items():
            self.assertEqual((folder / "chunks" / name).stat().st_mtime_ns, when)

    def test_damaged_chunks_are_done_again(self):
        for form in ["csv", "npz"] + (["parquet"] if has("pyarrow") else []):
            folder = self.folder / form
            self.sweep("-o", folder, "--format", form, code=1)
            whole = (folder / f"result.{form}").read_bytes()
            chunks = sorted((folder / "chunks").iterdir())
            chunks[0].write_bytes(b"")
            chunks[1].write_bytes(chunks[1].read_bytes()[:-20])
            chunks[2].write_bytes(chunks[3].read_bytes())
            chunks[4].write_bytes(os.urandom(500))
            chunks[5].unlink()
            chunks[6].unlink()
            os.mkfifo(chunks[6])
            self.sweep("-o", folder, code=1)
            self.assertEqual((folder / f"result.{form}").read_bytes(), whole)

    def test_a_chunk_that_unpacks_to_too_much_is_none(self):
        plan = load_plan(str(self.folder / "plan.toml"))
        results = Results(str(self.folder / "r"), plan, "d", "npz")
        run_on_threads(results, range(1), Stone, 1)
        self.assertIsNotNone(results.read_chunk(0))
        with mock.patch.multiple("tenon_usd._arrays", UNPACKED=10, UNPACKED_PER_BYTE=0):
            self.assertIsNone(results.read_chunk(0))

    def test_results_of_another_plan_are_left_alone(self):
        self.sweep("-o", self.folder / "r", "--format", "csv", code=1)
        before = (self.folder / "r/result.csv").read_bytes()
        _, told = self.sweep("-o", self.folder / "r", "--seed", 9, code=2)
        self.assertIn("another plan", told)
        _, told = self.sweep("-o", self.folder / "r", "--format", "npz", code=2)
        self.assertIn("holds results as csv", told)
        self.assertEqual((self.folder / "r/result.csv").read_bytes(), before)

    def test_places_that_are_no_folder(self):
        self.put("x", "file")
        self.sweep("-o", self.folder / "file", code=2)
        self.put("{}", "plan.json")
        _, told = self.sweep("-o", self.folder, code=2)
        self.assertIn("not of a sweep", told)
        self.put("[" * 100000, "plan.json")
        self.sweep("-o", self.folder, code=2)
        plan = load_plan(str(self.folder / "plan.toml"))
        results = Results(str(self.folder / "r"), plan, "d", "csv")
        self.assertRaises(FolderError, results.write_chunk, 0, [])

    def test_a_driver_that_is_killed_loses_nothing(self):
        whole, folder = self.bytes_of("-j", 1), self.folder / "killed"
        words = [sys.executable, sweep_source.__file__, str(self.folder / "plan.toml"), "-o",
                 str(folder), "--format", "csv", "-j", "2"]
        kills = 0
        for delay in (0.15, 0.2, 0.25, 0.3):
            process = subprocess.Popen(words, stdout=subprocess.DEVNULL,
                                       env={**os.environ, "STONE_SECONDS": "0.01"})
            time.sleep(delay)
            process.send_signal(signal.SIGKILL)
            kills += process.wait() == -signal.SIGKILL
        subprocess.run(words, stdout=subprocess.DEVNULL, check=False)
        self.assertGreater(kills, 0)
        self.assertEqual((folder / "result.csv").read_bytes(), whole)


class Outcomes(unittest.TestCase):
    def test_an_outcome_without_metrics_is_nan(self):
        self.assertEqual(Outcome("failed", 0).metrics, ())


if __name__ == "__main__":
    unittest.main()
