#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""examples/sweep/slurm.sh as a job array on one node of Slurm, and what one machine gives alone.

    on_slurm.py ROOT TENON [FOLDER]

ROOT is the repository, TENON the command of an environment that has the package. Slurm is Debian's:
its packages are downloaded with apt-get and unpacked in FOLDER, or a temporary one, where its
daemons run as the user with configuration, ports and spool of their own; nothing is installed. The
merged file of the array has to have the bytes of a run without Slurm, and a task that is asked for
again has nothing to do. Exit 77: Debian's packages cannot be downloaded here.
"""

import contextlib
import hashlib
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

PACKAGES = ("libhwloc15", "liblua5.1-0", "libmunge2", "slurm-wlm-basic-plugins", "slurm-client",
            "slurmctld", "slurmd")
TASKS, CPUS, SECONDS = 3, 1, 300
CONF = """ClusterName=one
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
AuthType=auth/none
CredType=cred/none
PluginDir={plugins}
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SchedulerType=sched/builtin
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
StateSaveLocation={work}/state
SlurmdSpoolDir={work}/spool
SlurmctldPidFile={work}/slurmctld.pid
SlurmdPidFile={work}/slurmd.pid
SlurmctldLogFile={work}/slurmctld.log
SlurmdLogFile={work}/slurmd.log
SlurmdParameters=config_overrides
ReturnToService=2
MailProg=/bin/true
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} RealMemory=100
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def unpacked(folder):
    """Debian's Slurm below `folder`; None: it cannot be downloaded."""
    if not (folder / "usr/sbin/slurmd-wlm").exists():
        debs = folder / "debs"
        debs.mkdir(parents=True, exist_ok=True)
        done = subprocess.run(["apt-get", "download", *PACKAGES], cwd=debs, capture_output=True,
                              check=False)
        if done.returncode:
            return None
        for package in sorted(debs.glob("*.deb")):
            subprocess.run(["dpkg", "-x", package, folder], check=True)
    return folder


def free_ports(count):
    with contextlib.ExitStack() as stack:
        found = [stack.enter_context(socket.socket()) for _ in range(count)]
        for each in found:
            each.bind(("127.0.0.1", 0))
        return [each.getsockname()[1] for each in found]


class Cluster:
    """A controller and one node, while the block lasts."""

    def __init__(self, slurm, work):
        self.slurm, self.work, self.daemons = slurm, work, []
        libraries = slurm / "usr/lib/x86_64-linux-gnu"
        plugins = libraries / "slurm-wlm"
        self.environment = {**os.environ, "SLURM_CONF": str(work / "slurm.conf"),
                            "LD_LIBRARY_PATH": f"{libraries}:{plugins}"}
        for name in ("state", "spool"):
            (work / name).mkdir()
        host = socket.gethostname().split(".")[0]
        (work / "slurm.conf").write_text(CONF.format(
            host=host, user=subprocess.check_output(["id", "-un"], text=True).strip(),
            ports=free_ports(2), plugins=plugins, work=work, cpus=os.cpu_count()))

    def __enter__(self):
        sbin = self.slurm / "usr/sbin"
        for command in ([sbin / "slurmctld-wlm", "-D", "-i"],
                        [sbin / "slurmd-wlm", "-D", "-d", sbin / "slurmstepd-wlm"]):
            self.daemons.append(subprocess.Popen(command, env=self.environment,
                                                 stdout=subprocess.DEVNULL,
                                                 stderr=subprocess.DEVNULL))
            time.sleep(1)
        return self

    def __exit__(self, *_):
        for daemon in reversed(self.daemons):
            daemon.send_signal(signal.SIGTERM)
        for daemon in self.daemons:
            with contextlib.suppress(subprocess.TimeoutExpired):
                daemon.wait(20)
            daemon.kill()

    def call(self, name, *arguments, **environment):
        done = subprocess.run([self.slurm / "usr/bin" / name, *map(str, arguments)], text=True,
                              capture_output=True, env={**self.environment, **environment},
                              cwd=self.work, check=False, timeout=SECONDS)
        if done.returncode:
            raise SystemExit(f"{name}: {done.stderr.strip()}\n{self.logs()}")
        return done.stdout

    def logs(self):
        found = sorted([*self.work.glob("*.log"), *self.work.glob("slurm-*.out")])
        return "\n".join(f"{path.name}:\n{path.read_text()[-1500:]}" for path in found)


def submitted(cluster, script, array, **environment):
    """Runs a job array to its end; -> exit codes of its tasks, by their number."""
    job = cluster.call("sbatch", "--parsable", f"--array={array}", f"--cpus-per-task={CPUS}",
                       "--export=ALL", script, **environment).strip()
    end = time.monotonic() + SECONDS
    while time.monotonic() < end:
        rows = cluster.call("scontrol", "-o", "show", "job", job).splitlines()
        fields = [dict(word.split("=", 1) for word in row.split() if "=" in word) for row in rows]
        if fields and all(row["JobState"] not in ("PENDING", "RUNNING", "COMPLETING",
                                                  "CONFIGURING") for row in fields):
            return {int(row["ArrayTaskId"]): int(row["ExitCode"].split(":")[0]) for row in fields}
        time.sleep(0.5)
    raise SystemExit(f"the job did not end in {SECONDS} s\n{cluster.logs()}")


def digest(folder):
    (result,) = folder.glob("result.*")
    return hashlib.sha256(result.read_bytes()).hexdigest()


def main():
    root, tenon = (pathlib.Path(text).absolute() for text in sys.argv[1:3])
    with tempfile.TemporaryDirectory(prefix="tenon-slurm-") as temporary:
        work = pathlib.Path(temporary)
        slurm = unpacked(pathlib.Path(sys.argv[3]).absolute() if len(sys.argv) > 3
                         else work / "slurm")
        if slurm is None:
            print("skipped: Debian's packages of Slurm cannot be downloaded here")
            return 77
        shutil.copytree(root / "examples/inspire_hand", work / "inspire_hand")
        shutil.copytree(root / "examples/sweep", work / "sweep")
        plan = work / "sweep/grasp.toml"
        alone = subprocess.run([tenon, "sweep", plan, "-o", work / "alone", "-j", "1"],
                               capture_output=True, text=True, check=False)
        if alone.returncode not in (0, 1):
            raise SystemExit(alone.stderr)
        with Cluster(slurm, work) as cluster:
            wanted = {"PLAN": str(plan), "RUNS": str(work / "runs"),
                      "PATH": f"{tenon.parent}:{os.environ['PATH']}"}
            script = work / "sweep/slurm.sh"
            codes = submitted(cluster, script, f"0-{TASKS - 1}", **wanted)
            before = {path: path.stat().st_mtime_ns for path in (work / "runs").rglob("*.*")}
            again = submitted(cluster, script, f"0-{TASKS - 1}", **wanted)
            after = {path: path.stat().st_mtime_ns for path in (work / "runs").rglob("*.*")}
            said = cluster.logs()
        chunks = [path for path in before if path.parent.name == "chunks"]
        same = digest(work / "alone") == digest(work / "runs")
        rested = all(before[path] == after[path] for path in chunks)
        good = same and rested and set(codes.values()) | set(again.values()) <= {0, 1}
        version = subprocess.run([slurm / "usr/bin/sbatch", "--version"], text=True,
                                 capture_output=True, env=cluster.environment, check=True).stdout
        print(f"{version.strip()}: {len(codes)} tasks of an array, exit codes "
              f"{sorted(codes.values())}, {len(chunks)} chunks; the same bytes as alone: {same}; "
              f"nothing done again: {rested}")
        if not good:
            print(said)
        return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
