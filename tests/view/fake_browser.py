#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Stands for Chromium where there is none: speaks as much of its protocol, on descriptors 3 and 4,
as `tenon record` asks for, and answers with a picture or a film of its own.

TENON_FAKE_BROWSER says what goes wrong: ends, hangs, crashes, garbage, webgl, codec, throws,
message. TENON_FAKE_BROWSER_LOG is a file that gets what it was told, a line of JSON each: its
arguments, the names of methods and the calls of `tenonRecord`.
"""

import base64
import json
import os
import re
import sys
import time

FAULT = os.environ.get("TENON_FAKE_BROWSER", "")
LOG = os.environ.get("TENON_FAKE_BROWSER_LOG", "")
PNG = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAQAAAC1HAwCAAAAC0lEQVR42mNk+A8AAQUBAScY42YAAAAASUVORK5CYII=")
FILM = b"\x1aE\xdf\xa3" + bytes(range(256)) * 40


def remember(kind, what):
    if LOG:
        with open(LOG, "a", encoding="utf-8") as file:
            file.write(json.dumps([kind, what]) + "\n")


class Browser:
    def __init__(self):
        self.made = b""
        self.frames = 0

    def say(self, **message):
        os.write(4, json.dumps(message).encode() + b"\0")

    def evaluate(self, script):
        """-> the value of a script of `tenon record`."""
        call = re.match(r"tenonRecord\.(\w+)\((.*)\)$", script, re.DOTALL)
        if not call:
            return True if "ready" in script else 0
        remember("call", script)
        name, arguments = call[1], call[2]
        if name == "prepare" and FAULT == "webgl":
            return {"problem": "webgl"}
        if name == "begin" and FAULT == "codec":
            return {"problem": "codec", "codecs": ["vp8", "av1"]}
        if name in ("still", "end"):
            self.made = PNG if name == "still" else FILM
            return {"size": len(self.made)}
        if name == "take":
            at, count = json.loads(f"[{arguments}]")
            return base64.b64encode(self.made[at:at + count]).decode()
        return {}

    def answer(self, message):
        method = message["method"]
        remember("method", method)
        if method == "Runtime.evaluate":
            script = message["params"]["expression"]
            if "tenonRecord.prepare" in script:
                if FAULT == "crashes":
                    self.say(method="Inspector.targetCrashed", params={})
                    time.sleep(60)
                if FAULT == "throws":
                    return {"exceptionDetails": {"exception": {"description": "Error: planted"}}}
                if FAULT == "message":
                    self.say(method="Log.entryAdded",
                             params={"entry": {"level": "error", "text": "planted"}})
            return {"result": {"value": self.evaluate(script)}}
        return {"Browser.getVersion": {"product": "Fake/1"},
                "Target.createTarget": {"targetId": "t"},
                "Target.attachToTarget": {"sessionId": "s"},
                "Page.captureScreenshot": {"data": base64.b64encode(PNG).decode()},
                }.get(method, {})

    def run(self):
        rest = b""
        while piece := os.read(3, 1 << 20):
            *messages, rest = (rest + piece).split(b"\0")
            for text in messages:
                message = json.loads(text)
                self.say(id=message["id"], result=self.answer(message))


remember("argv", sys.argv[1:])
if FAULT == "ends":
    sys.exit("planted words")
if FAULT == "hangs":
    time.sleep(60)
if FAULT == "garbage":
    os.write(4, b"garbage\0")
    time.sleep(60)
Browser().run()
