# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Published robots and poses of them by chance, for comparisons of mass matrices."""


def descriptions(robots, count):
    """An even choice of `count` URDF files, and MJCF files of dm_control's suite, in a folder."""
    files = sorted(robots.rglob("*.urdf")) + sorted((robots / "dm_control/suite").glob("*.xml"))
    return files[::max(1, len(files) // count)]


def random_pose(rows, followers, chance):
    """--pose for all joints that lead, within 1.5 rad or 5 cm of 0; followers: {(joint, dof)}."""
    words = []
    for row in rows:
        if row["joint"] is None or (row["joint"], row["dof"]) in followers:
            continue
        reach, unit = (1.5, "rad") if row["dof"].startswith("rot") else (0.05, "m")
        words.append(f"{row['joint']}:{row['dof']}={chance.uniform(-reach, reach)!r}{unit}")
    return ",".join(words)
