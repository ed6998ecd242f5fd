#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Writes what a release has in it as a bill of materials in SPDX 2.3 (JSON).

usage: make_sbom.py PREFIX OUTPUT FILE...

PREFIX is an installed tenon (cmake --install); each folder of its licences, share/doc/tenon, is a
library that is compiled in, linked or loaded: tests/release/licences.py holds these to the build.
Versions are those of the packages that the machine has, or the pinned ones of cmake/*.cmake. FILEs
are the artefacts that the bill is of, with their SHA-256.
"""

import datetime
import glob
import hashlib
import json
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
#: Who owns a file of each library that comes as a Debian package.
PACKAGES = {
    "eigen": "libeigen3-dev", "cli11": "libcli11-dev", "nlohmann-json": "nlohmann-json3-dev",
    "lz4": "liblz4-dev", "qhull": "libqhull-dev", "pugixml": "libpugixml-dev",
    "toml++": "libtomlplusplus-dev",
    "boost": "libboost-dev", "meshoptimizer": "libmeshoptimizer-dev", "zlib": "zlib1g-dev",
    "assimp": "libassimp-dev", "nlopt": "libnlopt0", "libstdc++": "libstdc++6"}


def version_of_tenon():
    with open(os.path.join(ROOT, "CMakeLists.txt"), encoding="utf-8") as file:
        return re.search(r"project\(tenon VERSION ([0-9.]+)", file.read())[1]


def pinned_versions():
    """{"mujoco": "4.0.1", ...} of cmake/*.cmake."""
    found = {}
    for path in glob.glob(os.path.join(ROOT, "cmake/*.cmake")):
        with open(path, encoding="utf-8") as file:
            for name, version in re.findall(r"set\(TENON_(\w+)_VERSION ([0-9.]+)\)", file.read()):
                found[name.lower()] = version
    return found


def debian_version(package):
    """Of a package, whichever architectures of it there are; empty where it is not installed."""
    done = subprocess.run(["dpkg-query", "-W", "-f", "${Version}\\n", package],
                          capture_output=True, text=True, check=False)
    return done.stdout.partition("\n")[0]


def packages_of_page():
    """-> [(name, version)] of what the page of `tenon view` is bundled with."""
    with open(os.path.join(ROOT, "page/package.json"), encoding="utf-8") as file:
        return sorted(json.load(file)["dependencies"].items())


def libraries(prefix):
    """-> [(name, version)] of what is in the release; a library without a version is an error."""
    folder = os.path.join(prefix, "share/doc/tenon")
    names = sorted(name for name in os.listdir(folder)
                   if os.path.isdir(os.path.join(folder, name)))
    pinned = pinned_versions()
    found = [(name, pinned.get(name) or debian_version(PACKAGES.get(name, name)))
             for name in names]
    unknown = [name for name, version in found if not version]
    if os.path.isdir(os.path.join(prefix, "share/tenon/page")):
        found += packages_of_page()
    if unknown or not found:
        sys.exit(f"make_sbom: no version of {', '.join(unknown) or 'anything'}")
    return found


def package(identifier, name, version, licence="NOASSERTION"):
    return {"SPDXID": f"SPDXRef-{identifier}", "name": name, "versionInfo": version,
            "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
            "licenseConcluded": licence, "licenseDeclared": licence, "copyrightText": "NOASSERTION"}


def artefact(number, path):
    with open(path, "rb") as file:
        digest = hashlib.sha256(file.read()).hexdigest()
    return {"SPDXID": f"SPDXRef-artefact-{number}", "fileName": "./" + os.path.basename(path),
            "checksums": [{"algorithm": "SHA256", "checksumValue": digest}],
            "licenseConcluded": "NOASSERTION", "copyrightText": "NOASSERTION"}


def bill(prefix, files):
    version = version_of_tenon()
    seconds = int(os.environ.get("SOURCE_DATE_EPOCH", 0))
    parts = libraries(prefix)
    artefacts = [artefact(i, path) for i, path in enumerate(sorted(files))]
    whole = hashlib.sha256(json.dumps([parts, artefacts]).encode()).hexdigest()
    names = [re.sub(r"[^A-Za-z0-9.-]", "-", name) for name, _ in parts]
    relations = [("SPDXRef-DOCUMENT", "DESCRIBES", "SPDXRef-tenon")]
    relations += [("SPDXRef-tenon", "CONTAINS", f"SPDXRef-{name}") for name in names]
    relations += [(each["SPDXID"], "GENERATED_FROM", "SPDXRef-tenon") for each in artefacts]
    created = datetime.datetime.fromtimestamp(seconds, datetime.timezone.utc)
    return {
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"tenon-{version}",
        "documentNamespace": f"urn:tenon:{version}:{whole}",
        "creationInfo": {"created": created.strftime("%Y-%m-%dT%H:%M:%SZ"),
                         "creators": ["Organization: tenon authors", "Tool: tools/make_sbom.py"]},
        "packages": [package("tenon", "tenon", version, "Apache-2.0"),
                     *[package(identifier, name, number) for identifier, (name, number)
                       in zip(names, parts)]],
        "files": artefacts,
        "relationships": [{"spdxElementId": one, "relationshipType": kind, "relatedSpdxElement": to}
                          for one, kind, to in relations],
    }


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__.split("\n\n")[1])
    text = json.dumps(bill(sys.argv[1], sys.argv[3:]), indent=1) + "\n"
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main()
