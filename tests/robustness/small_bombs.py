# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Small assets that mean much: each is answered, or ends at a limit that is named, in bounded
processor time and memory (docs/limits.md).

    small_bombs.py TENON
"""

import os
import pathlib
import resource
import subprocess
import sys
import tempfile

TENON = os.path.abspath(sys.argv[1])
SANITIZED = b"__asan_init" in pathlib.Path(TENON).read_bytes()
SECONDS = 60 if SANITIZED else 5  # 2 where nothing else runs
MEGABYTES = 512


def layer(body, head=""):
    return f'#usda 1.0\n(\n    defaultPrim = "W"\n    upAxis = "Z"\n{head})\n{body}'


def prim(name, arcs="", inside="", kind="def"):
    return f'{kind} "{name}" (\n{arcs}\n)\n{{\n{inside}}}\n'


def physics(name, kind, *apis):
    listed = ", ".join(f'"Physics{api}API"' for api in apis)
    return f'def {kind} "{name}" (\nprepend apiSchemas = [{listed}]\n)\n{{\n}}\n'


def instancer(name, prototype, count):
    return (f'def PointInstancer "{name}"\n{{\nrel prototypes = </{prototype}>\n'
            f'int[] protoIndices = [{", ".join(["0"] * count)}]\n'
            f'point3f[] positions = [{", ".join(["(0, 0, 0)"] * count)}]\n}}\n')


def layers_of_each_other(count, more=()):
    """Layers that each name all others, and `more`, as sublayers."""
    files = {"a.usda": layer("", "    subLayers = [@./s0.usda@]\n")}
    for i in range(count):
        names = [f"s{(i + j) % count}" for j in range(1, count)] + list(more)
        files[f"s{i}.usda"] = layer('def "W"\n{\n}\n', "    subLayers = [" + ", ".join(
            f"@./{name}.usda@" for name in names) + "]\n")
    return files


def instances_of_instances(count, leaf):
    """`count` times `count` instances of a body with a collider."""
    def level(name, below):
        return prim(name, inside="".join(prim(
            f"c{i}", f"instanceable = true\nreferences = </{below}>") for i in range(count)))
    return layer(level("W", "L") + level("L", "Body") + leaf)


def laughs(levels, instanceable):
    words = "instanceable = true\n" if instanceable else ""
    text = physics("L0", "Cube", "RigidBody", "Collision")
    for i in range(1, levels + 1):
        text += prim(f"L{i}", inside="".join(prim(
            f"c{k}", f"{words}references = </L{i - 1}>") for k in range(10)))
    return layer(text + prim("W", f"references = </L{levels}>"))


def classes(kind, count):
    """Classes that lead to each other, with children that do, too."""
    text = "".join(prim(f"_c{i}", f"{kind} = </_c{(2 * i + 1) % count}>", "".join(prim(
        f"k{j}", f"{kind} = </_c{(i + j + 1) % count}>") for j in range(2)), "class")
        for i in range(count))
    return layer(text + prim("W", f"{kind} = [" + ", ".join(
        f"</_c{i}>" for i in range(count)) + "]"))


def template(start, end, stride):
    return layer(prim("W", 'clips = {\ndictionary default = {\nstring primPath = "/P"\n'
                      'string templateAssetPath = "./c.###.usda"\n'
                      f"double templateStartTime = {start}\ndouble templateEndTime = {end}\n"
                      f"double templateStride = {stride}\n}}\n}}", "double x\n"))


def relocations(count):
    pairs = ",\n".join(f"</W/a{i}>: </W/b{i}>" for i in range(count))
    return layer(prim("W", "references = </_r>") + prim("_r", inside="".join(
        prim(f"a{i}") for i in range(count)), kind="class"), f"relocates = {{\n{pairs}\n}}\n")


def relocations_under_references(count):
    pairs = ",\n".join(f"</W/a{i}>: </W/b{i}>" for i in range(count))
    arcs = ", ".join(f"</_r/x{i}>" for i in range(count))
    return layer(prim("W", f"references = [{arcs}]") + prim("_r", inside="".join(
        prim(f"x{i}", inside=prim(f"a{i}")) for i in range(count)), kind="class"),
        f"relocates = {{\n{pairs}\n}}\n")


def doubling(count):
    lines = "".join(f'string V{i} = "`\'${{V{i + 1}}}${{V{i + 1}}}\'`"\n' for i in range(count))
    return layer(prim("W", 'references = @`"${V0}"`@'),
                 f'expressionVariables = {{\n{lines}string V{count} = "x"\n}}\n')


def star(count):
    """Links on one hub, each with a drive."""
    text = 'def Xform "hub" (prepend apiSchemas = ["PhysicsRigidBodyAPI"])\n{\n}\n'
    for i in range(count):
        text += physics(f"b{i}", "Xform", "RigidBody") + (
            f'def PhysicsRevoluteJoint "j{i}" (prepend apiSchemas = ["PhysicsDriveAPI:angular"])\n'
            f"{{\nrel physics:body0 = </W/hub>\nrel physics:body1 = </W/b{i}>\n"
            "float drive:angular:physics:damping = 1\n}\n")
    return layer(prim("W", inside=text))


def replicates(levels, count, inside='<body><geom size="0.01"/></body>'):
    """A model in MuJoCo's format, of `count` to the power of `levels` times `inside`."""
    for _ in range(levels):
        inside = f'<replicate count="{count}" offset="0.1 0 0">\n{inside}</replicate>'
    return f"<mujoco><worldbody>\n{inside}</worldbody></mujoco>\n"


# What it is: its files, and what has to be said, where it cannot be answered whole.
BOMBS = {
    "layers that name each other": (layers_of_each_other(30), "too many sublayers"),
    "and names of no file": (layers_of_each_other(7, [f"m{i}" for i in range(3000)]),
                             "too many sublayers"),
    "instances of instances of bodies": (instances_of_instances(
        1500, prim("Body", inside=physics("x", "Cube", "RigidBody", "Collision"))),
        "kInstancedPhysics"),
    "instancers of instancers": (layer("".join(
        instancer(f"P{i}", f"P{i + 1}", 1000) for i in range(8))
        + physics("P8", "Cube", "RigidBody", "Collision")), "kPointInstances"),
    "instancers of themselves": (layer(instancer("W", "W", 1000)), ""),
    "references of references": (laughs(9, False), "kComposeWork"),
    "instances of instances": (laughs(9, True), "stage.too-many-prims"),
    "classes in circles": (classes("inherits", 8), ""),
    "copied classes in circles": (classes("specializes", 8), "kComposeWork"),
    "clips without end": (template(1, 2, 1e-320), "kTemplateClips"),
    "clips between two equal times": (template(1e14, 1e14, 2e-5), ""),
    "clips for ever": (template(0, "inf", 1), "kTemplateClips"),
    "relocations": (relocations(5000), "prims          10002"),
    "too many relocations": (relocations_under_references(3000), "kComposeWork"),
    "variables that double": (doubling(60), "65536"),
}
# The same of runs, with the engine.
RUNS = {"drives around one body": (star(2000), "joints are not listed")}
# The same of descriptions of robots, which become assets.
FLEX = ('<body name="b"><flexcomp name="f" type="grid" count="30 30 30" spacing="1 1 1" dim="3"/>'
        "</body>")
MODELS = {
    "replicates of replicates": (replicates(3, 100), "a.xml:2: error: the model's <replicate>"),
    "replicates of an included file": ({
        "a.xml": replicates(2, 60, '<include file="b.xml"/>'),
        "b.xml": "<mujocoinclude><body><geom size='1'/></body><body/></mujocoinclude>"},
        "kReplicatedElements"),
    "many points": (replicates(0, 1, FLEX), "kReplicatedElements"),
    "as many copies as may be": (replicates(3, 16), "4097 links"),
}


def end_of_patience():
    resource.setrlimit(resource.RLIMIT_CPU, (4 * SECONDS, 4 * SECONDS))


def faults_of(words, ends, files, said):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (files if isinstance(files, dict) else {words[1]: files}).items():
            pathlib.Path(folder, name).write_text(text, encoding="utf-8")
        with open(pathlib.Path(folder, "said"), "w+b") as log:
            process = subprocess.Popen([TENON, *words], cwd=folder, stdout=log,
                                       stderr=subprocess.STDOUT, preexec_fn=end_of_patience)
            _, status, used = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            log.seek(0)
            text = log.read().decode(errors="replace")
    if process.returncode == 4:
        return  # the engine is not here
    if process.returncode not in ends:
        yield f"ends with {process.returncode}: {text[-300:]}"
    if said not in text:
        yield f'does not say "{said}": {text[-300:]}'
    seconds, megabytes = used.ru_utime + used.ru_stime, used.ru_maxrss // 1024
    if seconds > SECONDS:
        yield f"takes {seconds:.1f} s of processor time"
    if megabytes > MEGABYTES and not SANITIZED:
        yield f"takes {megabytes} MB"


def main():
    count = 0
    for words, ends, bombs in ((["info", "a.usda"], (0, 1), BOMBS),
                               (["sim", "a.usda", "--engine", "jolt", "--duration", "0.004"],
                                (0, 1), RUNS),
                               (["convert", "a.xml", "out.usda"], (0, 2), MODELS)):
        for name, bomb in bombs.items():
            for fault in faults_of(words, ends, *bomb):
                print(f"{name}: {fault}")
                count += 1
    print(f"{len({**BOMBS, **RUNS, **MODELS})} small assets that mean much, {count} faults")
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(main())
