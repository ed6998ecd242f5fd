# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What is done with assets in files, a function each. docs/outputs.md lists the keys of answers."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from . import _tenon
from .options import OpenOptions, PathLike, arguments_of, path_of

if TYPE_CHECKING:
    from typing import Unpack


def open(path: PathLike, **options: Unpack[OpenOptions]) -> _tenon.Stage:
    """Opens and composes an asset: .usd, .usda, .usdc or .usdz.

    `options` are those of tenon_usd.options.OpenOptions: physics="mujoco" selects that variant of
    the variant sets "Physics". What is wrong but leaves a scene is in Stage.diagnostics. Raises
    FileError, ParseError, CorruptError and other errors of tenon_usd.errors.
    """
    return _tenon.open_stage(path_of(path), arguments_of(options))


def physics(path: PathLike, **options: Unpack[OpenOptions]) -> _tenon.PhysicsScene:
    """What an engine receives of an asset, in metres, kilograms, seconds and radians."""
    return open(path, **options).physics()


def info(path: PathLike, **options: Unpack[OpenOptions]) -> dict[str, Any]:
    """What an asset is: units, variants, counts of bodies and joints, mass [kg]."""
    return open(path, **options).info()


def explain(
    path: PathLike, object: str, other: str | None = None, **options: Unpack[OpenOptions]
) -> dict[str, Any]:
    """Where numbers of "/prim" or "/prim.property" come from [SI, rad]; why two prims collide."""
    return open(path, **options).explain(object, other)


def where(
    path: PathLike,
    object: str,
    time: float | None = None,
    *,
    variants: bool = False,
    **options: Unpack[OpenOptions],
) -> dict[str, Any]:
    """Every file that speaks about "/prim.property" or "/prim", at a time [time codes]."""
    return open(path, **options).where(object, time, variants=variants)


def check(
    *paths: PathLike,
    profile: str = "",
    fix: bool = False,
    suggested: bool = False,
    **options: Unpack[OpenOptions],
) -> dict[str, Any]:
    """Checks assets, or all assets below folders, against the rules (docs/rules).

    `profile` "isaac-3.0" holds the files to Asset Structure 3.0 as well, "simready" to NVIDIA's
    requirements (docs/simready.md). `fix` writes what has a safe correction, with `suggested` also
    the names and types that messages suggest. Returns
    {"diagnostics": findings with file, line, prim and fix, "summary": counts of errors, warnings,
    infos, "assets"}.
    """
    names = [path_of(path) for path in paths]
    return _tenon.check(names, arguments_of(options), profile, fix, suggested)


def rules() -> list[dict[str, Any]]:
    """All rules of check(): {"rule", "severity", "numbers", "autofix", "suggestedFix", "title"}."""
    rows: list[dict[str, Any]] = _tenon.rules()["rules"]
    return rows


def rule(name: str) -> str:
    """The page of a rule, as text: rule("joint.body-missing"). Raises KeyError for others."""
    page = _tenon.rule_page(name)
    if not page:
        raise KeyError(name)
    return page


def diff(
    before: PathLike,
    after: PathLike,
    *,
    mode: str = "files",
    tolerance: float = 0.0,
    **options: Unpack[OpenOptions],
) -> dict[str, Any]:
    """What differs between two layers, packages or folders.

    `mode` is "files", "composed" (the scenes that they compose to) or "physics" (what engines
    receive [SI, rad]). Numbers a, b are equal when |a - b| <= tolerance max(1, |a|, |b|). Returns
    {"equal", "differences", "mode", "diagnostics"}.
    """
    if mode not in ("files", "composed", "physics"):
        raise ValueError(f"mode is {mode!r}; expected files, composed or physics")
    return _tenon.diff(path_of(before), path_of(after), arguments_of(options), mode, tolerance)


def compare(
    path: PathLike,
    engines: Sequence[str] = (),
    *,
    duration: float | None = None,
    time_step: float = 0.0,
    frames_per_second: float = 60.0,
    reasons: bool = True,
    commands: PathLike = "",
    bounds: str = "",
    **options: Unpack[OpenOptions],
) -> dict[str, Any]:
    """One motion of an asset on several engines: how far they are apart [SI, rad], and why.

    `engines` are names as of engines(), "physx:VARIANT" with a variant; all where it is empty.
    `duration` and `time_step` in seconds; 0 and None stand for what the asset says. `bounds` such
    as "5mm" fills "exceeded". Returns {"engines", "pairs": gaps and reasons, "exceeded"}.
    """
    return _tenon.compare(
        path_of(path),
        arguments_of(options),
        list(engines),
        duration,
        time_step,
        frames_per_second,
        100 if reasons else 0,
        commands,
        bounds,
    )


def poses(path: PathLike, **options: Unpack[OpenOptions]) -> list[dict[str, Any]]:
    """The named poses that an asset keeps: {"name", "path", "robot", "startLink", "endLink",
    "valid", "joints"}, and of each joint {"joint", "dof", "value", "lower", "upper", "fixed",
    "follows", "problem"} [rad, m].
    """
    rows: list[dict[str, Any]] = _tenon.poses(path_of(path), arguments_of(options))["poses"]
    return rows


def pose(
    path: PathLike,
    pose: str = "",
    *,
    ik: Mapping[str, Sequence[float]] | None = None,
    rotation: Mapping[str, Sequence[float]] | None = None,
    hold: Sequence[str] = (),
    tolerance: float | None = None,
    starts: int = 32,
    seed: int = 1,
    save: str = "",
    robot: str = "",
    **options: Unpack[OpenOptions],
) -> dict[str, Any]:
    """Where the joints of an asset are, and where they have to be for frames to be at places.

    `pose` is a named pose, or text as of Dynamics, several with commas between; the start where it
    is empty. `ik` gives the place of prims [m, world], `rotation` their orientation as quaternions
    (w, x, y, z); `hold` names joints that stay. The search begins at `pose`, then at postures drawn
    from `seed`, `starts` in all. `save` keeps what was found under that name in the file that owns
    it; what was not reached is not saved. Returns {"joints": as of poses(), "reach": {"reached",
    "obstacle", "targets", ..}} with `ik`, and "edits" and "written" where it was saved.
    """
    places = [
        f"{frame}=" + ",".join(f"{float(number)!r}m" for number in place)
        for frame, place in (ik or {}).items()
    ]
    turns = [
        f"{frame}=" + ",".join(repr(float(number)) for number in turn)
        for frame, turn in (rotation or {}).items()
    ]
    return _tenon.pose(
        path_of(path),
        arguments_of(options),
        [pose] if pose else [],
        places,
        turns,
        list(hold),
        tolerance,
        starts,
        seed,
        save,
        robot,
    )


def _check_conflicts(conflicts: str | None) -> None:
    if conflicts not in (None, "edits", "source", "fail"):
        raise ValueError(f"conflicts is {conflicts!r}; expected edits, source or fail")


def _rules(given: Any, text: Callable[[Any], str]) -> list[str]:
    """A value, a mapping of them or a text as the command takes them: VALUE or REGEX=VALUE."""
    if given is None:
        return []
    if isinstance(given, str):
        return [given]
    if not isinstance(given, Mapping):
        return [text(given)]
    return [
        text(value) if pattern == "*" else f"{pattern}={text(value)}"
        for pattern, value in given.items()
    ]


def convert(
    input: PathLike,
    output: PathLike,
    *,
    name: str = "",
    gains: str | tuple[float, float] | Mapping[str, tuple[float, float]] = "",
    armature: float | Mapping[str, float] | None = None,
    friction: float | Mapping[str, float] | None = None,
    collision: str | Mapping[str, str] | None = None,
    density: float | None = None,
    start: str = "zero",
    fix_base: bool = False,
    float_base: bool = False,
    merge_fixed: bool = False,
    scene: bool = False,
    self_collision: bool | None = None,
    packages: Mapping[str, PathLike] | None = None,
    model: str = "",
    arg: Mapping[str, str] | None = None,
    force: bool = False,
    update: bool = False,
    conflicts: str | None = None,
    format: str = "",
    assets: str = "",
    **options: Unpack[OpenOptions],
) -> dict[str, Any]:
    """A robot's description (URDF, SDF, MJCF) as an asset, or an asset as a description.

    `output` is a file, or a folder for Asset Structure 3.0; of an asset an .xml (MJCF), .urdf,
    .sdf, .srdf or .py file. `format` says what it is where the ending does not: "isaaclab" or
    "mjlab" of a .py file, "ros2_control" of an .urdf file. `assets` is the folder below that of the
    output for meshes and images, as a name; without it meshes of MJCF are in its text.
    `gains` are K, D of a drive for each joint [N m/rad, N m s/rad or N/m, N s/m], or a JSON file.
    `armature` [kg m^2 or kg] and `friction` [N m or N] are those of joints with one axis,
    `collision` is what meshes of links collide as: "hull", "decomposition", "sphere" or "none" (the
    mesh itself). Each of the four may be a mapping, from a regular expression for the whole name of
    joints (of `collision`: links) to the value; the last that matches counts, and "*" is for the
    others. One that matches nothing is a NotFoundError. `density` [kg/m^3] is that of links that
    move and have colliders and no mass. With `start` "valid" joints whose limits exclude 0 start
    inside of them; "zero" is the pose that the description has.
    `self_collision` says whether links of the robot touch each other; None is no for URDF and what
    the model says for SDF and MJCF. `packages` are folders of ROS packages and models of Gazebo by
    name, `model` is the one of an SDF file with several, `arg` are arguments of a file with macros
    of xacro. Files that were edited since they were written stay, unless `force`.
    Returns {"output", "links", "joints", "diagnostics"}; of MJCF "bodies" in place of links, of
    configurations in Python joints alone. What the description lacks is in the diagnostics.

    `update` takes over what the source changed since and keeps what was edited in `output`, and
    adds "updated": {"files", "edits", "changes", "moved", "conflicts"}; give the options that the
    asset was made with. Where both changed the same thing edits stay and every update reports it,
    but for what `conflicts` says: "edits" (they stay and are reported no more), "source", or
    "fail", which writes nothing and raises InvalidError of the rule "update.conflict".
    """
    _check_conflicts(conflicts)
    if start not in ("zero", "valid"):
        raise ValueError(f"start is {start!r}; expected zero or valid")
    if density is not None and not 0 < density <= 1e6:
        raise ValueError(f"density is {density!r}; expected above 0, up to 1e6 kg/m^3")
    rules = {
        "gains": _rules(gains or None, lambda pair: f"{float(pair[0])!r},{float(pair[1])!r}"),
        "armature": _rules(armature, lambda value: repr(float(value))),
        "friction": _rules(friction, lambda value: repr(float(value))),
        "collision": _rules(collision, str),
    }
    folders = {key: str(folder) for key, folder in (packages or {}).items()}
    return _tenon.convert(
        path_of(input),
        path_of(output),
        arguments_of(options),
        name,
        rules,
        density,
        start == "valid",
        fix_base,
        float_base,
        merge_fixed,
        scene,
        self_collision,
        folders,
        model,
        {key: str(value) for key, value in (arg or {}).items()},
        force,
        update,
        conflicts or "",
        format,
        assets,
    )


def structure(
    path: PathLike,
    folder: PathLike | None = None,
    *,
    name: str = "",
    engines: Sequence[str] = (),
    force: bool = False,
    update: bool = False,
    conflicts: str | None = None,
    **options: Unpack[OpenOptions],
) -> dict[str, Any]:
    """An asset in Asset Structure 3.0, proven to be the same and written to `folder`.

    Without a folder nothing is written. `engines` get a variant and a layer of their own. Returns
    {"interface", "files", "variants", "selection", "moved", "diagnostics"}. `update` and
    `conflicts` are those of convert(), for an asset in `folder` that was made of `path`.
    """
    _check_conflicts(conflicts)
    if update and folder is None:
        raise ValueError("update is about an asset in a folder; give the folder")
    return _tenon.structure(
        path_of(path),
        "" if folder is None else path_of(folder),
        arguments_of(options),
        name,
        force,
        list(engines),
        update,
        conflicts or "",
    )


def new(
    path: PathLike,
    *,
    up_axis: str = "Z",
    meters_per_unit: float = 1.0,
    kilograms_per_unit: float = 1.0,
    default_prim: str = "World",
) -> _tenon.Stage:
    """Writes a file with the units [m, kg] and an empty Xform as its default prim, and opens it.

    Raises FileError where there is a file of that name.
    """
    _tenon.new_asset(path_of(path), up_axis, meters_per_unit, kilograms_per_unit, default_prim)
    return open(path)


def engines() -> list[dict[str, Any]]:
    """The engines of this build: {"name", "version", "available", "how_to_get"}."""
    return _tenon.engines()


def doctor() -> dict[str, Any]:
    """Engines, libraries and programs that tenon can do without, and how to get them."""
    return _tenon.doctor()
