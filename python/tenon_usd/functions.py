# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What is done with assets in files, a function each. docs/outputs.md lists the keys of answers."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from . import _tenon
from ._lists import no_such
from .errors import InvalidError
from .options import OpenOptions, PathLike, arguments_of, list_of, path_of

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
    only: Sequence[str] = (),
    skip: Sequence[str] = (),
    for_: Sequence[str] = (),
    baseline: PathLike = "",
    fix: bool = False,
    suggested: bool = False,
    **options: Unpack[OpenOptions],
) -> dict[str, Any]:
    """Checks assets, or all assets below folders, against the rules (docs/rules).

    `profile` "isaac-3.0" holds the files to Asset Structure 3.0 as well, "simready" to NVIDIA's
    requirements (docs/simready.md). `only` and `skip` are rules or families of rules ("mass",
    "joint.body-missing"), also of those that `fix` corrects; `for_` are engines that read the
    asset themselves, for the rules of portability. Findings in the file `baseline` are known.
    NotFoundError for a rule that there is not. `fix` writes what has a safe correction, with
    `suggested` also the names and types that messages suggest. Returns
    {"diagnostics": findings with file, line, prim and fix, "summary": counts of errors, warnings,
    infos, "assets"}.
    """
    names = [path_of(path) for path in paths]
    rules = {
        "only": list_of("only", only),
        "skip": list_of("skip", skip),
        "for_": list_of("for_", for_),
    }
    return _tenon.check(names, arguments_of(options), profile, rules, path_of(baseline), fix,
                        suggested)


def rules() -> list[dict[str, Any]]:
    """All rules of check(): {"rule", "severity", "numbers", "autofix", "suggestedFix", "title"}."""
    rows: list[dict[str, Any]] = _tenon.rules()["rules"]
    return rows


def rule(name: str) -> str:
    """The page of a rule, as text: rule("joint.body-missing"). Raises KeyError for others."""
    page = _tenon.rule_page(name)
    if not page:
        raise KeyError(no_such(name, [str(row["rule"]) for row in rules()]))
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


def poses(
    path: PathLike, *, export: PathLike = "", **options: Unpack[OpenOptions]
) -> list[dict[str, Any]]:
    """The named poses that an asset keeps: {"name", "path", "robot", "startLink", "endLink",
    "valid", "joints"}, and of each joint {"joint", "dof", "value", "lower", "upper", "fixed",
    "follows", "problem"} [rad, m]. `export` writes them as a file of Isaac Sim's robot poser
    (.json), too.
    """
    answer = _tenon.poses(path_of(path), arguments_of(options), path_of(export))
    rows: list[dict[str, Any]] = answer["poses"]
    return rows


def edit_poses(
    path: PathLike,
    *,
    rename: Mapping[str, str] | None = None,
    remove: Sequence[str] = (),
    import_: PathLike = "",
    robot: str = "",
    **options: Unpack[OpenOptions],
) -> dict[str, Any]:
    """Renames the named poses of an asset, removes some, or keeps all of a file, in the file that
    owns them; pose(save=...) keeps one.

    One of: `rename`, from old names to new ones; `remove`, names; `import_`, a file as Isaac Sim's
    robot poser writes it (.json), for the prim `robot`, which is the only robot where it is not
    given. Returns {"edits", "written", "diagnostics"}. NotFoundError for a pose that is not there.
    """
    tasks = [bool(rename), bool(remove), bool(path_of(import_))]
    if sum(tasks) != 1:
        raise ValueError("give one of rename, remove and import_")
    return _tenon.edit_poses(
        path_of(path), arguments_of(options), dict(rename or {}), list_of("remove", remove),
        path_of(import_), robot
    )


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


def _check_form(names: str, schema: str, schemas: Sequence[str]) -> None:
    if names not in ("", "current", "tutorial"):
        raise ValueError(f"names is {names!r}; expected current or tutorial")
    if schema not in ("", *schemas):
        raise ValueError(f"schema is {schema!r}; expected one of {', '.join(schemas)}")


# What convert() can be given of a description that becomes an asset alone.
_OF_ASSETS = ("name", "gains", "armature", "friction", "collision", "density", "fix_base",
              "float_base", "merge_fixed", "scene", "flat", "self_collision", "names", "schema",
              "robot_type", "packages", "model", "arg")


def _check_export(input: PathLike, given: Mapping[str, Any]) -> None:
    ending = os.path.splitext(path_of(input))[1].lower()
    named = [name for name in _OF_ASSETS if given[name] not in (None, "", False)]
    if ending in (".usd", ".usda", ".usdc", ".usdz") and named:
        raise InvalidError(f"{named[0]} is about assets that are made, and this makes a "
                           f"description; leave {named[0]} out")


def _check_robot(start: str, density: float | None) -> None:
    if start not in ("zero", "valid"):
        raise ValueError(f"start is {start!r}; expected zero or valid")
    if density is not None and not 0 < density <= 1e6:
        raise ValueError(f"density is {density!r}; expected above 0, up to 1e6 kg/m^3")


def _gains_text(pair: Any) -> str:
    """K,D as the library takes them. Raises TypeError for what are no two numbers."""
    try:
        stiffness, damping = map(float, pair)
    except (TypeError, ValueError):
        raise TypeError(f"gains are two numbers (K, D), or such pairs by joint, not {pair!r}"
                        ) from None
    return f"{stiffness!r},{damping!r}"


def _robot_rules(gains: Any, armature: Any, friction: Any, collision: Any) -> dict[str, list[str]]:
    return {
        "gains": _rules(gains or None, _gains_text),
        "armature": _rules(armature, lambda value: repr(float(value))),
        "friction": _rules(friction, lambda value: repr(float(value))),
        "collision": _rules(collision, str),
    }


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
    flat: bool = False,
    self_collision: bool | None = None,
    names: str = "",
    schema: str = "",
    robot_type: str = "",
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
    the model says for SDF and MJCF. With `flat` links are side by side below the robot, not nested.
    `schema` is which schemas of vendors joints get: "current" (as without it), "legacy" or "both";
    `names` "tutorial" names files and scopes of a folder as the tutorial of Isaac Sim 6 does;
    `robot_type` is isaac:robotType, which no description says. `packages` are folders of ROS
    packages and models of Gazebo by name, `model` is the one of an SDF file with several, `arg` are
    arguments of a file with macros of xacro. Files that were edited since they were written stay,
    unless `force`.
    Returns {"output", "links", "joints", "diagnostics"}; of MJCF "bodies" in place of links, of
    configurations in Python joints alone. What the description lacks is in the diagnostics.

    `update` takes over what the source changed since and keeps what was edited in `output`, and
    adds "updated": {"files", "edits", "changes", "moved", "conflicts"}; give the options that the
    asset was made with. Where both changed the same thing edits stay and every update reports it,
    but for what `conflicts` says: "edits" (they stay and are reported no more), "source", or
    "fail", which writes nothing and raises InvalidError of the rule "update.conflict".
    """
    _check_conflicts(conflicts)
    _check_form(names, schema, ("current", "legacy", "both"))
    _check_export(input, locals())
    _check_robot(start, density)
    return _tenon.convert(
        path_of(input),
        path_of(output),
        arguments_of(options),
        name,
        _robot_rules(gains, armature, friction, collision),
        density,
        start == "valid",
        fix_base,
        float_base,
        merge_fixed,
        scene,
        flat,
        self_collision,
        {key: str(folder) for key, folder in (packages or {}).items()},
        model,
        {key: str(value) for key, value in (arg or {}).items()},
        force,
        update,
        conflicts or "",
        format,
        assets,
        {"names": names, "schema": schema, "robot_type": robot_type},
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
    names: str = "",
    schema: str = "",
    links: str = "",
    overridable_colliders: bool = False,
    robot_type: str = "",
    **options: Unpack[OpenOptions],
) -> dict[str, Any]:
    """An asset in Asset Structure 3.0, proven to be the same and written to `folder`.

    Without a folder nothing is written. `engines` get a variant and a layer of their own. `names`,
    `schema` and `robot_type` are those of convert(), `schema` "as-authored" where it is not given.
    `links` "flat" puts the bodies of a robot side by side, "nested" each below the one that carries
    it. With `overridable_colliders` meshes that collide are no instances, so that each engine's
    layer may tune them. Returns
    {"interface", "files", "variants", "selection", "moved", "diagnostics"}. `update` and
    `conflicts` are those of convert(), for an asset in `folder` that was made of `path`.
    """
    _check_conflicts(conflicts)
    _check_form(names, schema, ("as-authored", "current", "legacy", "both"))
    if links not in ("", "as-authored", "flat", "nested"):
        raise ValueError(f"links is {links!r}; expected as-authored, flat or nested")
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
        overridable_colliders,
        {"names": names, "schema": schema, "robot_type": robot_type, "links": links},
    )


def new(
    path: PathLike,
    *,
    up_axis: str = "Z",
    meters_per_unit: float = 1.0,
    kilograms_per_unit: float = 1.0,
    default_prim: str = "World",
    time_codes_per_second: float | None = None,
    start_time_code: float | None = None,
    end_time_code: float | None = None,
    force: bool = False,
) -> _tenon.Stage:
    """Writes a file with the units [m, kg] and an empty Xform as its default prim, and opens it.

    Time codes are those of motions; without them there are 24 in a second, and no first and last
    one. Raises FileError where there is a file of that name, unless `force` replaces it.
    """
    if up_axis not in ("Y", "Z"):
        raise ValueError(f"up_axis is {up_axis!r}; expected Y or Z")
    units = {
        "meters_per_unit": meters_per_unit,
        "kilograms_per_unit": kilograms_per_unit,
        "time_codes_per_second": time_codes_per_second,
    }
    for name, value in units.items():
        if value is not None and not 0 < value <= 1e9:
            raise ValueError(f"{name} is {value!r}; expected a number above 0, up to 1e9")
    for name, value in {"start_time_code": start_time_code, "end_time_code": end_time_code}.items():
        if value is not None and not -1e12 <= value <= 1e12:
            raise ValueError(f"{name} is {value!r}; expected a number from -1e12 to 1e12")
    _tenon.new_asset(path_of(path), up_axis, meters_per_unit, kilograms_per_unit, default_prim,
                     time_codes_per_second, start_time_code, end_time_code, force)
    return open(path)


def undo(path: PathLike, *, dry_run: bool = False) -> dict[str, Any]:
    """Takes back the last edit of an asset in its files, as `tenon undo` does: one of the command,
    or of Stage.save(undoable=True). A stage that is open does not follow.

    `path` is the asset, or a file of it. With `dry_run` nothing is written. Returns {"dryRun",
    "verb", "asset", "files": [{"file", "diff", "removed"}]}. NotFoundError where no edit is kept,
    InvalidError where a file has changed since.
    """
    return _tenon.undo(path_of(path), dry_run)


def engines() -> list[dict[str, Any]]:
    """The engines of this build: {"name", "version", "available", "how_to_get"}."""
    return _tenon.engines()


def doctor() -> dict[str, Any]:
    """Engines, libraries and programs that tenon can do without, and how to get them."""
    return _tenon.doctor()
