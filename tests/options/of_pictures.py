# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Options of `view` and `record`, whose browser is tests/view/fake_browser.py."""

import os
import re

from of_assets import of_assets, of_every_verb
from of_runs import of_commands, of_starts, of_steps
from of_verbs import answered, file
from option_row import Row

ALL = ("mujoco", "physx", "jolt")
BROWSER = "{root}/tests/view/fake_browser.py"


def drawn(outcome):
    """What a browser was told."""
    return outcome.seen


def of_browsers(words):
    """`words` make a picture."""
    yield Row("--size", ("--size", "320x200"), with_=words)
    yield Row("--browser", ("--browser", "{folder}/no_browser"), with_=words, once=True,
              refused={"*": "no_browser"})
    yield Row("--no-sandbox", ("--no-sandbox",), with_=words, once=True, wanted=lambda b, a, _: (
        "--no-sandbox" in a.browser) and ("--no-sandbox" in b.browser) == (os.geteuid() == 0))
    yield Row("--patience", ("--patience", "0.2", "--browser", "{folder}/hanging_browser"),
              with_=words, once=True, refused={"*": "says nothing|silent"})


def view(_):
    yield from (row for row in of_every_verb() if row.option != "--json")
    yield from of_assets()
    yield Row("--no-settings", ("--no-settings",), asset="settled/main.usda", once=True,
              leaves_out=("--engine",), wanted=lambda before, after, _: (
                  before.seen["engine"], after.seen["engine"]) == ("jolt", "mujoco"))
    yield Row("--json", (), wanted=lambda _, out, __: out.answer["schema"], once=True)
    yield Row("--bind", ("--bind", "0.0.0.0"), sees=answered("local"), once=True)
    yield Row("--port", ("--port", "{port}"), once=True, wanted=lambda before, after, _: (
        before.answer["port"] != after.answer["port"] == after.port))
    yield Row("--engine", ("--engine", "{engine}"), leaves_out=("--engine",),
              wanted=lambda before, after, engine: before.seen["engine"] == "mujoco" and
              after.seen["engine"] == engine)
    yield Row("--dt", ("--dt", "0.001"))
    yield Row("--triangles", ("--triangles", "100"), sees=lambda o: o.seen["picture"])
    yield Row("--watch", ("--watch",), sees=lambda o: o.seen["reopened"], once=True)
    yield Row("--read-only", ("--read-only",), sees=lambda o: o.seen["edit"])
    for option in ("--log", "--commands"):
        yield Row(option, (option, "run.csv"), sees=lambda o: o.seen["logs"], once=True)
    yield Row("--for", ("--for", "0.1"), sees=lambda o: o.seen["ended"])
    shot = ("--screenshot", "shot.png")
    yield Row("--screenshot", shot, leaves_out=("--engine",), sees=file("shot.png"), once=True)
    for row in of_browsers(shot):
        row.leaves_out = ("--engine",)
        row.once = True
        yield row
    for words in (("--engine", "{engine}"), ("--dt", "0.001"), ("--watch",), ("--read-only",),
                  ("--log", "run.csv"), ("--commands", "run.csv"), ("--bind", "127.0.0.1"),
                  ("--port", "0"), ("--for", "1")):
        yield Row(words[0], words, with_=shot, leaves_out=("--engine",), once=True,
                  refused={"*": re.escape(words[0]) + " is of "})
    yield from of_starts()


FILM = {"with_": ("-o", "film.webm", "--fps", "10", "--duration", "0.2"), "leaves_out": ("--time",)}


def names_in(text):
    """The names that the help of an option lists at its end."""
    return re.search(r": ([a-z]+(?:, [a-z]+)+)( \(|$)", text)[1].split(", ")


def of_looks(table):
    for words in (("--camera", "/World/Eye"), ("--azimuth", "70"), ("--elevation", "60"),
                  ("--zoom", "2"), ("--look-at", "/World/Slider"), ("--background", "dark"),
                  ("--background", "#123456"), ("--background", "transparent"),
                  ("--select", "/World/Slider"), ("--simplify", "100")):
        yield Row(words[0], words)
    for option in ("--show", "--hide"):
        for name in names_in(table[option]["help"]):
            yield Row(option, (option, name))


def record(table):
    choices = {option: row["choices"] for option, row in table.items()}
    yield from of_every_verb()
    yield from of_assets()
    yield Row("--no-settings", ("--no-settings",), asset="settled/main.usda",
              leaves_out=("--engine",), once=True)
    yield Row("--engine", ("--engine", "{engine}"), leaves_out=("--engine",), same=("mujoco",))
    yield from of_steps(choices)
    yield from of_starts()
    yield from of_commands()
    yield Row("--output", ("-o", "other.png"), sees=file("other.png"))
    yield from of_browsers(())
    yield from of_looks(table)
    yield Row("--time", ("--time", "0.2"))
    yield Row("--panels", ("--panels",))
    for words in (("--duration", "0.4"), ("--fps", "20"), ("--speed", "0.5"), ("--turn", "90"),
                  ("--bitrate", "1")):
        yield Row(words[0], words, **FILM)
        yield Row(words[0], words, once=True, refused={"*": re.escape(words[0]) + " is of films"})
    for codec in choices["--codec"]:
        yield Row("--codec", ("--codec", codec), with_=(
            "-o", "film.mp4" if codec == "h264" else "film.webm", "--fps", "10", "--duration",
            "0.1"), leaves_out=("--time",), same=() if codec == "h264" else (
                ALL if codec == "vp9" else ()), wanted=lambda _, after, __, c=codec: (
                    after.answer["codec"] == c))
    for words in (("--time", "0.1"), ("--panels",)):
        yield Row(words[0], words, once=True, **FILM,
                  refused={"*": re.escape(words[0]) + " is of pictures"})
    # A picture of the start is of no motion.
    for words in (("--engine", "{engine}"), ("--dt", "0.001"), ("--iterations", "1"),
                  ("--integrator", "euler"), ("--solver", "pgs"),
                  ("--commands", "{folder}/target.csv")):
        yield Row(words[0], words, leaves_out=("--time", "--engine"), once=True,
                  refused={"*": re.escape(words[0]) + " is of "})
