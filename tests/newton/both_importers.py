#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Stages into newton.ModelBuilder by Newton's own importer and by tenon_usd.newton: what differs.

    both_importers.py < jobs > answers

Runs in a Python that has Newton, usd-core and tenon_usd. A job is a line of JSON: {"file",
"mujoco": with what SolverMuJoCo asks for}. Its answer: {"seconds": of the processor, for each of
the two; "errors": what each raised; "counts": bodies, joints, shapes; "differences": by array of
the builder, or key of the answer, how it differs; "colours": shapes of another colour, which count
nowhere}.
"""

import json
import logging
import os
import sys
import time
import warnings

ANSWERS = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)  # what the libraries print

import newton  # noqa: E402
import numpy as np  # noqa: E402
import warp  # noqa: E402

from tenon_usd.newton import add_usd  # noqa: E402

#: Relative to the larger one: Newton keeps 32 bits, and takes some poses apart in them.
NEAR = 2e-5
LEAST = 2e-6            # of numbers near 0; of inertias relative to the largest of a body
KINDS = ("body", "joint", "shape", "articulation", "constraint")
POSES = ("body_q", "shape_transform", "joint_X_p", "joint_X_c")
#: Compared by themselves, or what viewers alone use.
APART = ("shape_source", "shape_color", "shape_opacity", "body_shapes")
MAPS = ("path_body_map", "path_joint_map", "path_shape_map")
PLAIN = ("fps", "duration", "up_axis", "mass_unit", "linear_unit", "physics_scene_path",
         "physics_dt", "max_solver_iterations", "particle_scene_path", "actuator_count")


def arrays_of(builder):
    """Names of the lists of a builder that become arrays of its model."""
    return sorted(name for name, value in vars(builder).items()
                  if name.split("_")[0] in KINDS and name not in APART
                  and isinstance(value, (list, np.ndarray)))


def rows_of(values):
    """Numbers (count, width), or None where they are none."""
    try:
        return np.array([np.array(value, dtype=float).reshape(-1) for value in values])
    except (TypeError, ValueError):
        return None


def first_of(rows, first, second):
    at = int(np.argwhere(rows)[0][0])
    shown = [np.array2string(np.asarray(each[at]), precision=6) for each in (first, second)]
    return f"{int(rows.sum())} of {len(first)}, at {at}: {shown[0]} and {shown[1]}"


def numbers_differ(name, first, second):
    """How two lists of numbers differ; None: they do not."""
    if name in POSES:  # q and -q turn alike
        sign = np.sign((first[:, 3:] * second[:, 3:]).sum(axis=1))
        second = second.copy()
        second[:, 3:] *= np.where(sign == 0, 1, sign)[:, None]
    scale = np.maximum(np.abs(first), np.abs(second))
    least = LEAST
    if "inertia" in name:
        scale, least = np.broadcast_to(scale.max(axis=1, keepdims=True), scale.shape), 0.0
    with np.errstate(invalid="ignore"):
        near = np.abs(first - second) <= NEAR * scale + least
    near |= (first == second) | (np.isnan(first) & np.isnan(second))
    wrong = ~near.all(axis=1)
    return first_of(wrong, first, second) if wrong.any() else None


def lists_differ(name, first, second):
    if len(first) != len(second):
        return f"{len(first)} and {len(second)} of them"
    numbers = None if name.endswith("label") else (rows_of(first), rows_of(second))
    if numbers and all(each is not None for each in numbers) and len(first) and (
            numbers[0].shape == numbers[1].shape):
        return numbers_differ(name, *numbers)
    wrong = [(str(a), str(b)) for a, b in zip(first, second, strict=True) if str(a) != str(b)]
    return f"{len(wrong)} of {len(first)}: {wrong[0][0]} and {wrong[0][1]}" if wrong else None


def measures_of(mesh):
    """Bounds and area of a mesh, whichever way its corners are shared."""
    points = np.asarray(mesh.vertices, dtype=float)
    corners = points[np.asarray(mesh.indices, dtype=int).reshape(-1, 3)]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(across, axis=1).sum() / 2
    used = corners.reshape(-1, 3)
    if not len(used):
        return np.zeros(7)
    return np.concatenate([used.min(axis=0), used.max(axis=0), [area]])


def meshes_differ(first, second):
    wrong = []
    for at, (one, other) in enumerate(zip(first, second, strict=True)):
        if not hasattr(one, "vertices") or not hasattr(other, "vertices"):
            if (one is None) != (other is None):
                wrong.append(at)
            continue
        a, b = measures_of(one), measures_of(other)
        if (np.abs(a - b) > 1e-4 * np.abs(a).max() + 1e-9).any():
            wrong.append(at)
    return f"{len(wrong)} of {len(first)}, at {wrong[0]}" if wrong else None


def pairs_of(builder):
    return {tuple(sorted(pair)) for pair in builder.shape_collision_filter_pairs}


def custom_differ(first, second):
    """Values of custom attributes that differ, by key."""
    for key in sorted({*first.custom_attributes, *second.custom_attributes}):
        values = [dict(enumerate(kept) if isinstance(kept, list) else kept.items())
                  for builder in (first, second)
                  for kept in [getattr(builder.custom_attributes.get(key), "values", None) or {}]]
        values = [{at: value for at, value in each.items() if value is not None} for each in values]
        for at in sorted({*values[0], *values[1]}):
            one, other = (each.get(at) for each in values)
            numbers = None if one is None or other is None else (rows_of([one]), rows_of([other]))
            if numbers and all(each is not None for each in numbers) and (
                    numbers[0].shape == numbers[1].shape):
                if np.allclose(*numbers, rtol=1e-4, atol=1e-6):
                    continue
            elif str(one) == str(other):
                continue
            yield key, f"at {at}: {one} and {other}"
            break


def builders_differ(first, second):
    """By array: how the builder of Newton's importer and that of tenon's differ."""
    found = {}
    for name in arrays_of(first):
        words = lists_differ(name, getattr(first, name), getattr(second, name))
        if words:
            found[name] = words
    if len(first.shape_source) == len(second.shape_source):
        words = meshes_differ(first.shape_source, second.shape_source)
        if words:
            found["shape_source"] = words
    pairs = pairs_of(first), pairs_of(second)
    if pairs[0] != pairs[1]:
        found["shape_collision_filter_pairs"] = (
            f"{len(pairs[0])} and {len(pairs[1])}; only in one {sorted(pairs[0] ^ pairs[1])[:3]}")
    if not np.allclose(np.array(first.gravity), np.array(second.gravity), atol=1e-5):
        found["gravity"] = f"{first.gravity} and {second.gravity}"
    if first.up_axis != second.up_axis:
        found["builder.up_axis"] = f"{first.up_axis} and {second.up_axis}"
    found.update(custom_differ(first, second))
    return found


def answers_differ(first, second):
    """By key: how what the two calls answered differs."""
    for key in MAPS:
        if first[key] != second[key]:
            yield key, str(sorted({*first[key].items()} ^ {*second[key].items()})[:2])
    for key in PLAIN:
        one, other = first[key], second[key]
        numbers = isinstance(one, float) and isinstance(other, (int, float))
        close = numbers and np.isclose(one, other)
        if one != other and not close:
            yield key, f"{one} and {other}"
    for key in ("scene_attributes", "path_shape_scale", "path_body_relative_transform"):
        if set(first[key]) != set(second[key]):
            yield key, str(sorted({*first[key]} ^ {*second[key]})[:3])
    for resolver, prims in first["schema_attrs"].items():
        names = [{path: sorted(kept) for path, kept in each.items() if kept}
                 for each in (prims, second["schema_attrs"][resolver])]
        if names[0] != names[1]:
            yield "schema_attrs", resolver


def arguments_of(job):
    if not job.get("mujoco"):
        return {}
    usd = newton.usd
    return {"schema_resolvers": [usd.SchemaResolverMjc(), usd.SchemaResolverNewton()]}


def imported(importer, job):
    """-> builder, answer, the error's text, seconds of the processor"""
    builder = newton.ModelBuilder()
    if job.get("mujoco"):
        newton.solvers.SolverMuJoCo.register_custom_attributes(builder)
    arguments = arguments_of(job)
    start = time.process_time()
    try:
        answer, error = importer(builder, job["file"], **arguments), None
    except Exception as reason:  # the libraries' own kinds
        answer, error = None, f"{type(reason).__name__}: {reason}"[:300]
    return builder, answer, error, time.process_time() - start


def judge(job):
    first = imported(lambda builder, *given, **more: builder.add_usd(*given, **more), job)
    second = imported(add_usd, job)
    errors = [first[2], second[2]]
    answer = {"errors": errors, "seconds": [first[3], second[3]], "differences": {}}
    builder = first[0] if second[2] else second[0]
    answer["counts"] = [builder.body_count, builder.joint_count, builder.shape_count]
    if not any(errors):
        differences = builders_differ(first[0], second[0])
        differences.update(answers_differ(first[1], second[1]))
        answer["differences"] = differences
        colours = [np.array(each[0].shape_color, dtype=float).reshape(-1, 3)
                   for each in (first, second)]
        if colours[0].shape == colours[1].shape:
            far = np.abs(colours[0] - colours[1]) > 1e-3
            answer["colours"] = int(far.any(axis=1).sum())
    return answer


def main():
    warp.config.quiet = True
    warnings.simplefilter("ignore")
    logging.disable(logging.CRITICAL)
    with warp.ScopedDevice("cpu"):
        for line in sys.stdin:
            print(json.dumps(judge(json.loads(line))), file=ANSWERS, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
