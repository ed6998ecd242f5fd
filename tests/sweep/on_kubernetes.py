#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""examples/sweep/kubernetes.yaml beside the schema of Kubernetes, and its command run.

    on_kubernetes.py ROOT TENON

The Python has kubernetes-validate, which holds the schemas. The manifest has to fit that of its
kind, strictly, and a manifest with a misspelt key must not. Then each pod's command runs here, one
after another, with /data as a folder of this machine: the merged file has to have the bytes of a
run without shards.
"""

import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import kubernetes_validate
import yaml


def fits(manifest):
    """The version of the schema; None and the reason where the manifest does not fit it."""
    try:
        return kubernetes_validate.validate(manifest, kubernetes_validate.latest_version(),
                                            strict=True), ""
    except kubernetes_validate.ValidationError as reason:
        return None, str(reason.message)


def digest(folder):
    (result,) = folder.glob("result.*")
    return hashlib.sha256(result.read_bytes()).hexdigest()


def main():
    root, tenon = (pathlib.Path(text).absolute() for text in sys.argv[1:3])
    text = (root / "examples/sweep/kubernetes.yaml").read_text(encoding="utf-8")
    manifest = yaml.safe_load(text)
    version, reason = fits(manifest)
    wrong, _ = fits(yaml.safe_load(text.replace("completionMode", "completionMod")))
    (container,) = manifest["spec"]["template"]["spec"]["containers"]
    claims = {mount["mountPath"] for mount in container["volumeMounts"]}
    pods = manifest["spec"]["completions"]
    with tempfile.TemporaryDirectory(prefix="tenon-pods-") as folder:
        data = pathlib.Path(folder)
        shutil.copytree(root / "examples/inspire_hand", data / "inspire_hand")
        plan = data / "grasp.toml"
        plan.write_text((root / "examples/sweep/grasp.toml").read_text(encoding="utf-8")
                        .replace("../inspire_hand", "inspire_hand"), encoding="utf-8")
        subprocess.run([tenon, "sweep", plan, "-o", data / "alone", "-j", "1"], check=False,
                       capture_output=True)
        codes = []
        for index in range(pods):
            command = [re.sub(r"(?<!\S)/data", str(data), part).replace("-j 8", "-j 1")
                       for part in (*container["command"], *container["args"])]
            done = subprocess.run(command, check=False, capture_output=True, text=True, env={
                **os.environ, "JOB_COMPLETION_INDEX": str(index),
                "PATH": f"{tenon.parent}:{os.environ['PATH']}"})
            codes.append(done.returncode)
        same = digest(data / "alone") == digest(data / "runs")
    good = bool(version) and not wrong and claims == {"/data"} and set(codes) == {0} and same
    print(f"schema {version or reason}; a misspelt key is refused: {not wrong}; {pods} pods, exit "
          f"codes {sorted(set(codes))}; the same bytes as alone: {same}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
