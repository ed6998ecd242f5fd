# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Where figures come from: machine, compiler, commit; kept with them in bench/results."""

import datetime
import json
import os
import platform
import re
import subprocess


def cpu_model():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        for line in file:
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return platform.machine()


def first_line(command, folder):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    return done.stdout.split("\n")[0].strip() if done.returncode == 0 else "unknown"


def cache_entry(build, key):
    """The value of a CMake cache entry; "" without one."""
    with open(os.path.join(build, "CMakeCache.txt"), encoding="utf-8") as file:
        found = re.search(rf"^{key}:[A-Z]+=(.*)$", file.read(), re.MULTILINE)
    return found.group(1) if found else ""


def description(root, build):
    compiler = cache_entry(build, "CMAKE_CXX_COMPILER")
    changed = first_line(["git", "status", "--porcelain", "--untracked-files=no"], root)
    return {
        "machine": cpu_model(),
        "processors": os.cpu_count(),
        "system": platform.platform(terse=True),
        "compiler": first_line([compiler, "--version"], root),
        "flags": cache_entry(build, "CMAKE_CXX_FLAGS_RELEASE"),
        "commit": first_line(["git", "rev-parse", "HEAD"], root) + ("+changes" if changed else ""),
        "date": datetime.date.today().isoformat(),
        "load": os.getloadavg()[0],
    }


def record(root, arguments, rows):
    """Writes bench/results/<machine>.json; -> its path."""
    found = description(root, arguments.build)
    words = f"{found['machine']} {found['processors']}".lower()
    name = re.sub(r"[^a-z0-9]+", "_", words).strip("_")
    folder = os.path.join(root, "bench/results")
    os.makedirs(folder, exist_ok=True)
    path = os.path.join(folder, name + ".json")
    rounded = [{key: round(value, 5) if isinstance(value, float) else value
                for key, value in row.items() if value is not None} for row in rows]
    with open(path, "w", encoding="utf-8") as file:
        json.dump({**found, "rounds": arguments.rounds, "clock": arguments.clock,
                   "rows": rounded}, file, indent=1)
        file.write("\n")
    return path
