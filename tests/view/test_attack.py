#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What a page may send to `tenon view` that makes no sense, of every request that the program
lists: each gets an answer or an error, and the server lives, answers in time and stays small.

    test_attack.py ROOT TENON
"""

import json
import pathlib
import random
import shutil
import socket
import sys
import tempfile
import threading
import time
import unittest

import viewer

if shutil.which("node") is None:  # no page, no viewer
    print("skipped: node is not installed, so there is no page")
    sys.exit(77)

ROOT, TENON = pathlib.Path(sys.argv[1]).absolute(), str(pathlib.Path(sys.argv[2]).absolute())
ASSET = ROOT / "examples/scenes/joint.usda"
HTTP = "GET /{}/live.js HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\n\r\n"
FLOOD = 8  # [s]
LONGEST_ANSWER = 10  # [s] while others flood the server
MOST_MEMORY = 600 << 10  # [kB] resident; three times as much of a program with sanitizers
RAW = [b"", b"\x00", b"{", b'{"do":', b'{"do":"play"', b'{"do":"play"}}', b'{"do":"play","do":1}',
       b'{"do":"play",}', b"[" * 60000, b'{"a":' * 10000, b'{"do":"play","id":' + b"[" * 50000,
       b'{"do":"step","count":' + b"9" * 60000 + b"}", b'{"do":"step","count":1e999}',
       b'{"do":"step","count":-0}', b'{"do":"' + b"x" * 60000 + b'"}', b'"\\ud800"', b"NaN",
       b'{"do":"play","id":"' + b"\\u0000" * 9000 + b'"}', b"\xef\xbb\xbf{}", b"/**/{}", b"1e400"]
WRONG = [None, True, 0, -1, 0.5, 1e308, -1e308, 2**63, 2**64, 10**300, "", "x", "\0", "é" * 900,
         "/none", "/World", "/World.x", "/" + "a/" * 2500, "../../etc/passwd", "(a+)+$", "1" * 5000,
         [], [None], [[]], [-1e308] * 3, ["/none"] * 257, [{}] * 300, {}, {"a": {"a": {}}}]


def memory(process):
    """Its peak memory [kB]."""
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text(encoding="utf-8")
    return int(status.split("VmHWM:")[1].split()[0])


def values_for(field):
    """Wrong ones, and what is nearly right: beyond the bounds, of another length, too many."""
    near = [field["minimum"] - 1] if "minimum" in field else []
    near += [field["maximum"] + 1] if "maximum" in field else []
    near += [field["enum"][0] + "x"] if field.get("enum") and field["enum"][0] else []
    if "items" in field:
        near += [[value] for value in WRONG[:12]]
        near += [[{name: value for name in field["items"].get("properties", {})}]
                 for value in WRONG[:8]]
    return WRONG + near


class Attack(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.asset = pathlib.Path(cls.kept.name, "joint.usda")
        shutil.copy(ASSET, cls.asset)
        cls.viewer = viewer.Viewer(TENON, cls.asset)
        with cls.viewer.client() as client:
            cls.requests = client.done("messages")["requests"]

    @classmethod
    def tearDownClass(cls):
        most = memory(cls.viewer.process)
        code, said = cls.viewer.end()
        cls.viewer.__exit__()
        cls.kept.cleanup()
        assert code == 0, f"it ended with {code}: {said}"
        factor = 3 if b"__asan_init" in pathlib.Path(TENON).read_bytes() else 1
        assert most < MOST_MEMORY * factor, f"{most} kB"

    def setUp(self):
        self.start = time.monotonic()

    def tearDown(self):
        self.assertTrue(self.viewer.lives())
        with self.viewer.client() as client:
            client.done("messages")

    def test_every_field_of_every_request(self):
        self.assertGreater(len(self.requests), 30)
        with self.viewer.client() as client:
            for row in self.requests:
                fields = {name: field for name, field in row["schema"]["properties"].items()
                          if name not in ("do", "id")}
                for name, field in fields.items():
                    for value in values_for(field):
                        client.ask(row["name"], **{name: value})
                for value in WRONG:  # of ten fields at most: a message may have 64 KiB
                    client.ask(row["name"], **dict.fromkeys(list(fields)[:10], value))
                client.ask(row["name"], noSuchField=[[[[]]]])
                client.notices.clear()
                client.frames.clear()

    def test_texts_that_are_no_request(self):
        with self.viewer.client() as client:
            for text in RAW:
                client.send_frame(text)
                client.until(lambda notice: notice["is"] in ("error", "answer"))
            names = [row["name"] for row in self.requests]
            for name in [*names, *(name.upper() for name in names), "", "messages\0"]:
                client.send_frame(json.dumps({"do": [name]}).encode())
                client.until(lambda notice: notice["is"] == "error")

    def test_cut_and_changed_requests(self):
        """Each request of the tables with bytes cut, doubled and changed."""
        draw = random.Random(47)
        with self.viewer.client() as client:
            for row in self.requests * 5:
                text = bytearray(json.dumps({"do": row["name"], "id": 1} | dict.fromkeys(
                    row["schema"]["properties"], draw.choice(WRONG))).encode()[:60000])
                for _ in range(draw.randrange(1, 4)):
                    at = draw.randrange(len(text))
                    text[at:at + draw.randrange(9)] = bytes(
                        draw.choice(b'{}[]",:0e-\\ \x7fa') for _ in range(draw.randrange(9)))
                client.send_frame(bytes(text))
                client.until(lambda notice: notice["is"] in ("error", "answer"))

    def test_thousands_of_messages_of_who_does_not_listen(self):
        with self.viewer.client() as deaf, self.viewer.client() as other:
            deaf.link.settimeout(5)
            try:
                for number in range(20000):
                    deaf.send_frame(json.dumps({"do": "messages", "id": number}).encode())
            except OSError:
                pass  # it is held up, or the server has closed it
            other.done("pause")

    def test_eight_clients_that_flood_it(self):
        """Four that hear what comes and four that do not send all they can, edits among it, while
        it plays; a ninth and plain HTTP are answered all the while."""
        end = time.monotonic() + FLOOD
        clients = [self.viewer.client() for _ in range(8)]
        clients[0].done("play")
        threads = [threading.Thread(target=self.flood, args=(client, number, end))
                   for number, client in enumerate(clients)]
        for thread in threads:
            thread.start()
        longest, answers = 0, 0
        with self.viewer.client() as other:
            while time.monotonic() < end:
                start = time.monotonic()
                other.done("messages")
                self.assertTrue(self.viewer.lives())
                longest, answers = max(longest, time.monotonic() - start), answers + 1
                other.notices.clear()
        for thread in threads:
            thread.join()
        for client in clients:
            client.link.close()
        self.assertGreater(answers, 1)
        self.assertLess(longest, LONGEST_ANSWER)

    def flood(self, client, number, end):
        draw = random.Random(number)
        client.link.settimeout(viewer.PATIENCE if number < 4 else 1)
        while time.monotonic() < end:
            row = draw.choice(self.requests)["name"]
            fields = {"object": "/World.x", "value": str(draw.random())} if row == "set" else {}
            try:
                if number < 4:
                    client.ask(row, **fields)
                    client.notices.clear()
                    client.frames.clear()
                else:
                    client.send_frame(json.dumps({"do": row, "id": 0, **fields}).encode())
            except (OSError, viewer.Closed):
                return  # it is held up, or the server has closed it

    def test_pages_that_come_and_go(self):
        for number in range(200):
            with self.viewer.client() as client:
                client.send_frame(json.dumps({"do": self.requests[number % len(self.requests)][
                    "name"], "id": "x" * number}).encode(), fin=number % 3 != 0)
                if number % 2:
                    client.link.shutdown(socket.SHUT_WR)

    def test_requests_byte_by_byte_and_half_closed(self):
        target = HTTP.format(self.viewer.token, self.viewer.port).encode()
        links = [self.viewer.connect() for _ in range(8)]
        for byte in target:
            for link in links:
                link.sendall(bytes([byte]))
        for link in links:
            link.shutdown(socket.SHUT_WR)
            with link:
                self.assertEqual(viewer.parse_response(viewer.read_all(link))[0], 200)
        for cut in range(0, len(target), 7):  # the other side ends in the middle
            with self.viewer.connect() as link:
                link.sendall(target[:cut])
                link.shutdown(socket.SHUT_WR)
                self.assertIn(viewer.parse_response(viewer.read_all(link))[0], (0, 400))

    def test_files_that_are_gone(self):
        """Every request without fields, and edits, while the asset is gone, a folder, or cut."""
        text = ASSET.read_bytes()
        with tempfile.TemporaryDirectory() as folder:
            asset = pathlib.Path(folder, "a.usda")
            asset.write_bytes(text)
            with viewer.Viewer(TENON, asset) as view, view.client() as client:
                for change in (asset.unlink, asset.mkdir, asset.rmdir,
                               lambda: asset.write_bytes(text[:len(text) // 2])):
                    change()
                    for row in self.requests:
                        client.ask(row["name"])
                    result = client.ask("set", object="/World.x", value="1")
                    self.assertIn("error", result)
                self.assertTrue(view.lives())
                self.assertEqual(view.end()[0], 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
