#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The long runs, by name, and the table of CONFORMANCE.md that says how each of them ended.

usage: judge.py [NAME...] [--list] [--jobs N] [--no-table]    (make judge, make judge ONLY="a b")

Without names all are run. A judgement is a command; it is good when the command ends with 0, and a
skip (77) is a failure here, because nobody looks at what it left out. The last line that it
prints is its result in the table, with commit and date; rows of judgements that were not run stay.
Environments lie outside of the clone, in $XDG_CACHE_HOME/tenon-judge or ~/.cache/tenon-judge, and
are made once. Exit 0: all good; 1: one was not; 2: unknown name.
"""

import argparse
import datetime
import glob
import hashlib
import os
import re
import shutil
import subprocess
import sys
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
DOCUMENT = os.path.join(ROOT, "CONFORMANCE.md")
CACHE = os.path.join(os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache"),
                     "tenon-judge")
TABLE = re.compile(r"(<!-- judgements: .*? -->\n)(.*?)(<!-- end of judgements -->)", re.S)
HEAD = "| judgement | commit | date | minutes | good | result |\n|---|---|---|---|---|---|\n"
SKIPPED = 77
TESTS_PASSED = re.compile(r"\d+% tests passed")
SEEDS = ["fuzz/seeds", "fuzz/corpus", "examples", "tests"]
FUZZ_SECONDS = 120
# What is to run on any machine: the folders up to the reading of physics.
CORE = ("base", "math", "bytes", "layer", "formats", "schema", "compose", "scene", "stage", "edit",
        "approximate", "physics")
LOGS = os.path.join(ROOT, "build/judge")
RACES_OF_OTHERS = os.path.join(ROOT, "tests/thread_suppressions.txt")


class Judgement:
    """A command and what has to be built for it; {jobs} and {python} are filled in, and {engine}
    by the Python of an environment with another engine, whose file of requirements is `engine`,
    and {packages} by a folder with the packages of `node`, a folder with a package-lock.json."""

    def __init__(self, name, command, preset=None, targets=(), engine=None, node=None):
        self.name, self.command, self.preset, self.targets = name, command, preset, targets
        self.engine, self.node = engine, node


def judgements_of_engines():
    yield Judgement("closed_forms", ["{python}", "-B", "tests/closed_forms/closed_forms.py",
                                     "build/release/bin/tenon", "docs/closed-forms.md",
                                     "tests/closed_forms/known_misses.txt"],
                    "release", ["tenon_cli", "tenon_worker"])
    yield Judgement("robots_per_engine", ["{python}", "-B",
                                          "tests/engines_beside/robots_per_engine.py", ".",
                                          "build/release/bin/tenon", "docs/robots-per-engine.md"],
                    "release", ["tenon_cli", "tenon_worker"])
    yield Judgement("robots_hold", ["{python}", "-B", "tests/engines_beside/robots_hold.py", ".",
                                    "build/release/bin/tenon", "docs/robots-hold.md",
                                    "tests/engines_beside/robots_hold_misses.txt"],
                    "release", ["tenon_cli", "tenon_worker"])
    # Every option on every engine, and exported robots beside their assets, in full.
    yield Judgement("every_option", ["{python}", "-B", "tests/options/every_option.py", ".",
                                     "build/release/bin/tenon", "--all"],
                    "release", ["tenon_cli", "tenon_worker", "tenon_page"])
    yield Judgement("stepped_beside", ["{python}", "-B", "tests/convert/stepped_beside.py", ".",
                                       "build/release/bin/tenon", "20"],
                    "release", ["tenon_cli", "tenon_worker"])
    yield Judgement("watch_costs", ["{python}", "-B", "bench/watch_costs.py", ".",
                                    "build/release/bin/tenon"],
                    "release", ["tenon_cli", "tenon_worker"])
    # Tuned drives beside the closed form, and multibody algebra beside MuJoCo, in full.
    yield Judgement("tuned_responses", ["{python}", "-B", "tests/tuning/test_responses.py",
                                        "build/release/bin/tenon", "all"],
                    "release", ["tenon_cli", "tenon_worker"])
    yield Judgement("tuned_robots", ["{python}", "-B", "tests/tuning/tuned_robots.py", ".",
                                     "build/release/bin/tenon", "docs/tuned-robots.md",
                                     "--robots", "50"],
                    "release", ["tenon_cli", "tenon_worker"])
    yield Judgement("filtered_robots", ["{engine}", "-B", "tests/dynamics/filtered_robots.py", ".",
                                        "build/release/bin/tenon"],
                    "release", ["tenon_cli", "tenon_worker"],
                    "tests/dynamics/requirements-filtered.txt")
    yield Judgement("mass_matrices", ["{python}", "-B", "tests/dynamics/mujoco_matrices.py", ".",
                                      "build/release/bin/tenon", "1000"],
                    "release", ["tenon_cli", "tenon_worker"])
    yield Judgement("mass_matrices_physx", ["{engine}", "-B", "tests/dynamics/physx_matrices.py",
                                            ".", "build/release/bin/tenon", "1000"],
                    "release", ["tenon_cli", "tenon_worker"],
                    "tests/engines_beside/requirements-ovphysx.txt")
    # The same, and pairs that touch, beside Pinocchio and Coal.
    pinocchio = "tests/dynamics/requirements-pinocchio.txt"
    yield Judgement("pairs_beside", ["{engine}", "-B", "tests/dynamics/pairs_beside.py", ".",
                                     "build/release/bin/tenon"],
                    "release", ["tenon_cli", "tenon_worker"], pinocchio)
    yield Judgement("mass_matrices_beside", ["bash", "-c", "python/tests/install.sh && "
                                             "python/tests/run.sh $(dirname {engine})/.. "
                                             "tests/dynamics/pinocchio_matrices.py . "
                                             "build/release/bin/tenon"],
                    "release", ["tenon_cli", "tenon_worker"], pinocchio)


def judgements_of_pages_and_python():
    # tests/browser/run.mjs --list names the tests; they run by name too.
    yield Judgement("browser", ["bash", "-c", "python/tests/install.sh && "
                                "TENON_PYTHON=$PWD/build/wheel/beside/bin/python "
                                "PYTHONPATH=$(echo $PWD/build/wheel/clean/lib/python*/"
                                "site-packages) node tests/browser/run.mjs {packages} . "
                                "build/release/bin/tenon"],
                    "release", ["tenon_cli", "tenon_worker", "tenon_page"], node="tests/browser")
    # The Python package: memory after 100,000 openings, and its benchmark once, tiny.
    yield Judgement("python_opens", ["bash", "-c", "python/tests/install.sh && "
                                     "python3 -B bench/python_package.py --smoke && "
                                     "python/tests/run.sh build/wheel/clean "
                                     "python/tests/many_opens.py"], "release")
    yield Judgement("vector_environments", ["bash", "-c", "python/tests/install.sh && python3 -B "
                                            "bench/vector_environments.py "
                                            "docs/vector-environments.md"], "release")
    yield Judgement("python_versions", ["python/tests/versions.sh"], "release")
    yield Judgement("python_types", ["bash", "-c", "python/tests/install.sh && "
                                     "python/tests/pyright.sh"], "release")
    # What the example of docs/tasks.md learns; without the wheel in its environment.
    yield Judgement("learned", ["bash", "-c", "python/tests/install.sh && "
                                "python/tests/learned.sh {engine}"], "release", (),
                    "python/examples/learn/requirements-learn.txt")
    # Known truth of identify on robots of build/robots.
    yield Judgement("identify_robots", ["bash", "-c", "python/tests/install.sh && "
                                        "python/tests/run.sh build/wheel/beside "
                                        "python/tests/identify_robots.py . "
                                        "build/release/bin/tenon "
                                        "python/tests/identify_robots_misses.txt"],
                    "release", ["tenon_cli", "tenon_worker"])
    # The same beside MuJoCo's own.
    yield Judgement("identify_beside", ["bash", "-c", "python/tests/install.sh && "
                                        "PYTHONPATH=$(echo build/wheel/clean/lib/python*/"
                                        "site-packages) {engine} -B "
                                        "python/tests/identify_beside.py . "
                                        "build/release/bin/tenon docs/identify.md"],
                    "release", ["tenon_cli", "tenon_worker"],
                    "python/tests/requirements-sysid.txt")
    # Fits from several starts on a cluster of Ray.
    yield Judgement("identify_ray", ["bash", "-c", "python/tests/install.sh && TENON_RAY=1 "
                                     "PYTHONPATH=$(echo build/wheel/clean/lib/python*/"
                                     "site-packages) {engine} -B "
                                     "python/tests/test_identify_truth.py -k on_ray"], "release",
                    (), "tests/sweep/requirements-sweep.txt")
    # Logs of another simulator, with effects that the model lacks.
    yield Judgement("identify_drake", ["bash", "-c", "python/tests/install.sh && "
                                       "python/tests/run.sh build/wheel/beside "
                                       "python/tests/identify_drake.py . "
                                       "build/release/bin/tenon {engine} docs/identify.md"],
                    "release", ["tenon_cli", "tenon_worker"],
                    "tests/convert/requirements-sdf.txt")
    yield Judgement("clean_root", ["bash", "-c", "python/tests/install.sh && "
                                   "python/tests/clean_root.sh"], "release")
    yield Judgement("python_sanitized", ["bash", "-c", "python/tests/install.sh && "
                                         "python/tests/sanitized.sh"], "dev",
                    ["tenon_asset", "tenon_worker"])
    yield from judgements_of_clusters()


def judgements_of_clusters():
    """What examples say of Slurm and Kubernetes, and worlds in packages for GPUs."""
    tenon = "build/wheel/clean/bin/tenon"
    install = "python/tests/install.sh && "
    yield Judgement("sweep_slurm", ["bash", "-c", install +
                                    f"python3 -B tests/sweep/on_slurm.py . {tenon}"], "release")
    yield Judgement("sweep_kubernetes", ["bash", "-c", install + "{engine} -B "
                                         f"tests/sweep/on_kubernetes.py . {tenon}"], "release", (),
                    "tests/sweep/requirements-kubernetes.txt")
    yield Judgement("to_gpu", ["bash", "-c", install +
                               "PYTHONPATH=$(echo build/wheel/clean/lib/python*/site-packages) "
                               "{engine} -B python/tests/to_gpu.py ."], "release", (),
                    "tests/convert/requirements-readers.txt")


def corpora():
    """Published robots through this program and back."""
    yield Judgement("mjcf_corpus", ["{python}", "-B", "tests/convert/corpus_round_trip.py", ".",
                                    "build/release/bin/tenon", "--all", "--table"], "release")
    yield Judgement("edited_corpus", ["{python}", "-B", "tests/convert/edited_corpus.py", ".",
                                      "build/release/bin/tenon", "--all"], "release")
    # Two versions of MuJoCo do not go into one environment.
    for name, readers in (("readers", ["mujoco_warp", "mjx", "newton"]), ("mujoco33", ["mujoco"])):
        yield Judgement(f"mjcf_{name}", ["{python}", "-B", "tests/convert/mjcf_readers.py", ".",
                                         "build/release/bin/tenon", "{engine}", *readers],
                        "release", ["tenon_cli", "tenon_worker"],
                        f"tests/convert/requirements-{name}.txt")
    yield Judgement("simready", ["{python}", "-B", "tests/simready/beside_simready.py", ".",
                                 "build/release/bin/tenon", "{engine}"],
                    "release", ["tenon_cli", "tenon_worker"],
                    "tests/simready/requirements-simready.txt")
    yield Judgement("simready_made", ["{python}", "-B", "tests/simready/made_robots.py", ".",
                                      "build/release/bin/tenon", "{engine}"],
                    "release", ["tenon_cli", "tenon_worker", "tenon_page"],
                    "tests/simready/requirements-simready.txt")
    yield Judgement("robot_corpora", ["{python}", "-B", "tests/convert/robot_corpora.py", ".",
                                      "build/release/bin/tenon", "{engine}",
                                      "docs/robot-corpora.md", "--most", "60"],
                    "release", ["tenon_cli", "tenon_worker"],
                    "tests/convert/requirements-robots.txt")
    yield Judgement("sdf_beside_drake", ["{engine}", "-B", "tests/convert/sdf_beside_drake.py", ".",
                                         "build/release/bin/tenon"],
                    "release", ["tenon_cli", "tenon_worker"],
                    "tests/convert/requirements-sdf.txt")
    yield Judgement("ways_out_beside", ["{engine}", "-B", "tests/convert/ways_out_beside.py", ".",
                                        "build/release/bin/tenon"],
                    "release", ["tenon_cli", "tenon_worker"],
                    "tests/convert/requirements-ways.txt")
    yield Judgement("ways_out", ["{engine}", "-B", "tests/convert/ways_out.py", ".",
                                 "build/release/bin/tenon", "--installed"],
                    "release", ["tenon_cli", "tenon_worker"],
                    "tests/convert/requirements-sdf.txt")


def composition():
    """Random scenes beside OpenUSD, and twins beside themselves."""
    yield Judgement("random_scenes", ["{python}", "-B", "tests/differential/compose_random.py",
                                      "build/bench/bin/tenon_composition_dump", "--seed", "5001",
                                      "--scenes", "5000", "--show", "3", "--misses",
                                      "tests/differential/random_scenes_misses.txt"],
                    "bench", ["tenon_composition_dump"])
    yield Judgement("compose_twins", ["{python}", "-B", "tests/differential/compose_twins.py",
                                      "build/bench/bin/tenon_composition_dump",
                                      "--scenes", "500"], "bench", ["tenon_composition_dump"])


def mutants():
    """The next 25,000 each; all parts of a build add up (fuzz/mutants/parts.tsv)."""
    for build in ("release", "sanitizers"):
        yield Judgement(f"mutants_{build}", ["{python}", "-B", "tools/mutant_parts.py", "run",
                                             build, "--jobs", "{jobs}"],
                        "bench", ["tenon_mutants"])


def judgements():
    """All of them, in the order in which they are run."""
    # README's two commands where nothing is installed; --only demo and --user-alone are shorter.
    for number, codename in ((12, "bookworm"), (13, "trixie")):
        yield Judgement(f"fresh_machine_debian{number}",
                        ["{python}", "-B", "tests/release/fresh_machine.py", codename])
    yield Judgement("separate_files", ["cmake", "-E", "echo", "every source compiles alone"],
                    "separate")
    core = [f"tenon_{folder}_test" for folder in CORE]
    yield Judgement("bits32", ["bash", "-c", " && ".join(["build/bits32/bin/" + t for t in core]
                                                         + ["echo passed: " + " ".join(CORE)])],
                    "bits32", core)
    # Unit tests are the ones whose names begin with a capital letter.
    for preset in ("clang", "threads"):
        yield Judgement(preset, ["ctest", "--test-dir", f"build/{preset}", "-R", "^[A-Z]", "-j",
                                 "{jobs}", "--no-tests=error"], preset)
    yield Judgement("kill_runs", ["{python}", "-B", "tests/output/kill_runs.py",
                                  ".", "build/release/bin/tenon", "--runs", "50", "--pairs", "20"],
                    "release")
    yield Judgement("power_cuts", ["{python}", "-B", "tests/output/power_cuts.py", ".",
                                   "build/release/bin/tenon", "--recoveries", "2000"],
                    "release", ["tenon_cli", "tenon_worker"])
    yield Judgement("determinism", ["{python}", "-B", "tests/output/determinism.py", ".",
                                    "build/release/bin/tenon", "--jobs", "{jobs}"],
                    "release", ["tenon_cli", "tenon_worker", "tenon_page"])
    yield from mutants()
    yield Judgement("labelled", ["ctest", "--preset", "dev", "-L", "judge", "-j", "{jobs}",
                                 "--no-tests=error"], "dev")
    yield Judgement("reference", ["{python}", "-B", "tools/make_reference.py"], "release")
    yield Judgement("site", ["{python}", "-B", "tools/make_site.py"], "release")
    yield Judgement("workflows", ["{python}", "-B", "tests/workflows/test_workflows.py"])
    yield Judgement("bench", ["ctest", "--test-dir", "build/bench", "-R", "^bench[.]",
                              "--no-tests=error"], "bench")
    yield Judgement("structure_sweep", ["{python}", "-B", "tests/structure/sweep.py", ".",
                                        "build/release/bin/tenon", "--all"], "release")
    yield from composition()
    yield from corpora()
    yield Judgement("recordings", ["{python}", "-B", "tests/view/recordings.py", ".",
                                   "build/release/bin/tenon"], "release")
    for engine in ("ovphysx", "newton"):
        yield Judgement(f"beside_{engine}", ["{python}", "-B", "tests/engines_beside/beside.py",
                                             engine, "{engine}", "build/release/bin/tenon",
                                             "docs/beside-other-engines.md"],
                        "release", ["tenon_cli", "tenon_worker"],
                        f"tests/engines_beside/requirements-{engine}.txt")
    # tenon_usd.newton beside Newton's own importer, in the same environment.
    yield Judgement("newton_importer", ["bash", "-c", "python/tests/install.sh && {python} -B "
                                        "tests/newton/beside_newton_importer.py . "
                                        "build/release/bin/tenon {engine} docs/newton.md"],
                    "release", ["tenon_cli", "tenon_worker"],
                    "tests/engines_beside/requirements-newton.txt")
    yield Judgement("sweeps", ["{engine}", "-B", "tests/sweep/at_scale.py"], "release", (),
                    "tests/sweep/requirements-sweep.txt")
    # Logs in MCAP and bags, which take packages that the tests of the package do without.
    yield Judgement("robot_logs", ["env", "TENON_EXTRAS=1", "{engine}", "-B",
                                   "python/tests/test_identify_logs.py"], None, (),
                    "python/tests/requirements-bags.txt")
    # Of a build with every engine (make build ENGINES=all, make test).
    yield Judgement("own_physx", ["{python}", "-B", "tests/engines_beside/own_physx.py", "{engine}",
                                  "build/release/bin/tenon", "docs/beside-other-engines.md"],
                    "release", ["tenon_cli", "tenon_worker"],
                    "tests/engines_beside/requirements-ovphysx.txt")
    yield from judgements_of_engines()
    yield from judgements_of_pages_and_python()
    yield from fuzzers()


def fuzzers():
    for source in sorted(glob.glob(os.path.join(ROOT, "fuzz/*_fuzz.cpp"))):
        target = os.path.basename(source)[:-len(".cpp")]
        yield Judgement(f"fuzz_{target[:-len('_fuzz')]}",
                        ["fuzz/run.sh", target, str(FUZZ_SECONDS)], "fuzz", [target])


def environment_name(requirements):
    """requirements-ovphysx.txt -> beside_ovphysx: one for all judgements that ask for it."""
    return "beside_" + os.path.basename(requirements).split("-", 1)[1].split(".")[0]


def environment_python(name, requirements):
    """The Python of an environment with what a file asks for by hash, made once in the cache."""
    requirements = os.path.join(ROOT, requirements)
    with open(requirements, "rb") as file:
        key = hashlib.sha256(file.read()).hexdigest()[:12]
    folder = os.path.join(CACHE, f"{name}-{key}")
    python = os.path.join(folder, "bin/python")
    if not os.path.exists(os.path.join(folder, "made")):
        subprocess.run([sys.executable, "-m", "venv", "--clear", folder], check=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", "--no-deps", "--require-hashes",
                        "-r", requirements], check=True)
        with open(os.path.join(folder, "made"), "w", encoding="utf-8"):
            pass
    return python


def node_packages(name, folder):
    """A folder of the cache with the packages that package-lock.json of a folder pins."""
    sources = [os.path.join(ROOT, folder, each) for each in ("package.json", "package-lock.json")]
    with open(sources[1], "rb") as file:
        key = hashlib.sha256(file.read()).hexdigest()[:12]
    made = os.path.join(CACHE, f"{name}-{key}")
    if not os.path.exists(os.path.join(made, "made")):
        shutil.rmtree(made, ignore_errors=True)
        os.makedirs(made)
        for source in sources:
            shutil.copy(source, made)
        subprocess.run(["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund",
                        "--loglevel=error"], cwd=made, check=True)
        with open(os.path.join(made, "made"), "w", encoding="utf-8"):
            pass
    return made


def build(judgement, jobs, log):
    """True when what the judgement needs is built."""
    if judgement.preset is None:
        return True
    folder = os.path.join(ROOT, "build", judgement.preset)
    if not os.path.exists(os.path.join(folder, "build.ninja")):
        done = subprocess.run(["cmake", "--preset", judgement.preset], cwd=ROOT, stdout=log,
                              stderr=log, check=False)
        if done.returncode:
            return False
    targets = [word for target in judgement.targets for word in ("--target", target)]
    return subprocess.run(["cmake", "--build", folder, "-j", str(jobs), *targets], cwd=ROOT,
                          stdout=log, stderr=log, check=False).returncode == 0


def last_line(path):
    with open(path, encoding="utf-8", errors="replace") as file:
        lines = [line.strip() for line in file if line.strip()]
    return lines[-1].replace("|", "/")[:200] if lines else "it printed nothing"


def result_of_tests(path):
    """What ctest says at its end, and the names of tests that were skipped."""
    with open(path, encoding="utf-8", errors="replace") as file:
        lines = [line.strip() for line in file]
    said = [line for line in lines if TESTS_PASSED.search(line)]
    skipped = [line.split()[2] for line in lines if line.endswith("(Skipped)")]
    words = ([said[-1]] if said else ["ctest did not end"]) + skipped
    return ", skipped ".join(words)[:200], bool(skipped)


def run(judgement, python, jobs):
    """-> (good, result, minutes)"""
    os.makedirs(LOGS, exist_ok=True)
    path = os.path.join(LOGS, judgement.name + ".txt")
    start = time.monotonic()
    with open(path, "w", encoding="utf-8") as log:
        if not build(judgement, jobs, log):
            return False, f"not built: {os.path.relpath(path, ROOT)}", 0
        engine = judgement.engine and environment_python(environment_name(judgement.engine),
                                                         judgement.engine)
        packages = judgement.node and node_packages(judgement.name, judgement.node)
        words = [word.format(jobs=jobs, python=python, engine=engine, packages=packages)
                 for word in judgement.command]
        environment = {**os.environ, "TENON_ORACLE_PYTHON": python,
                       "TSAN_OPTIONS": f"suppressions={RACES_OF_OTHERS}"}
        try:
            status = subprocess.run(words, cwd=ROOT, stdout=log, stderr=log, env=environment,
                                    check=False).returncode
        except OSError as error:
            print(error, file=log)
            status = -1
    minutes = (time.monotonic() - start) / 60
    result = last_line(path)
    if judgement.command[0].startswith("fuzz/"):
        status = 1 if status else 0  # 77 is a finding there
    if judgement.command[0] == "ctest":
        result, skipped = result_of_tests(path)
        status = 1 if skipped else status
    return status == 0, f"skipped: {result}" if status == SKIPPED else result, minutes


def commit():
    def lines(*words):
        return subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True,
                              check=False).stdout.strip()
    # The tables themselves change with each row.
    others = lines("status", "--porcelain", "--untracked-files=no", "--", ":!CONFORMANCE.md",
                   ":!fuzz/mutants/parts.tsv")
    changed = "+changes" if others else ""
    return lines("rev-parse", "--short", "HEAD") + changed


def write_row(judgement, judged, good, result, minutes):
    """Puts the row into the table, in the place of the one that was there. judged: the commit."""
    with open(DOCUMENT, encoding="utf-8") as file:
        text = file.read()
    found = TABLE.search(text)
    if found is None:
        sys.exit("CONFORMANCE.md has no part <!-- judgements: ... --> <!-- end of judgements -->")
    rows = {row.split("|")[1].strip(): row for row in found[2].split("\n")[2:] if row}
    rows[judgement.name] = (f"| {judgement.name} | {judged} | {datetime.date.today()} "
                            f"| {minutes:.0f} | {'yes' if good else 'NO'} | {result} |")
    order = [each.name for each in judgements()]
    kept = [rows[name] for name in order if name in rows]
    whole = found[1] + HEAD + "".join(row + "\n" for row in kept) + found[3]
    with open(DOCUMENT + ".new", "w", encoding="utf-8") as file:
        file.write(text[:found.start()] + whole + text[found.end():])
    os.replace(DOCUMENT + ".new", DOCUMENT)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--list", action="store_true", help="only name the judgements")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--no-table", action="store_true", help="leave CONFORMANCE.md alone")
    arguments = parser.parse_intermixed_args()
    known = {judgement.name: judgement for judgement in judgements()}
    if arguments.list:
        for judgement in known.values():
            print(f"{judgement.name:24} {' '.join(judgement.command)}")
        return 0
    unknown = [name for name in arguments.names if name not in known]
    if unknown:
        print(f"no judgement {', '.join(unknown)}; there are {', '.join(known)}")
        return 2
    python = environment_python("oracle", "tests/requirements.txt")
    all_good = True
    for name in arguments.names or known:
        judged = commit()  # others may commit meanwhile
        good, result, minutes = run(known[name], python, arguments.jobs)
        all_good = all_good and good
        print(f"{'good' if good else 'BAD '} {name:24} {minutes:6.1f} min  {result}", flush=True)
        if not arguments.no_table:
            write_row(known[name], judged, good, result, minutes)
    return 0 if all_good else 1


if __name__ == "__main__":
    sys.exit(main())
