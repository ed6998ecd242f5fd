#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What strangers may send to `tenon view`: it is refused, and the server lives.

    test_security.py ROOT TENON
"""

import pathlib
import shutil
import socket
import struct
import sys
import unittest
import urllib.parse

import viewer

if shutil.which("node") is None:  # no page, no viewer
    print("skipped: node is not installed, so there is no page")
    sys.exit(77)

ROOT, TENON = pathlib.Path(sys.argv[1]).absolute(), str(pathlib.Path(sys.argv[2]).absolute())
ASSET = ROOT / "examples/scenes/box_on_box.usda"


class Security(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.viewer = viewer.Viewer(TENON, ASSET)

    @classmethod
    def tearDownClass(cls):
        code, said = cls.viewer.end()
        cls.viewer.__exit__()
        assert code == 0, f"it ended with {code}: {said}"

    def tearDown(self):
        self.assertTrue(self.viewer.lives())

    def test_token(self):
        self.assertRegex(self.viewer.token, "^[0-9a-f]{32}$")
        for token in ("", "0" * 32, self.viewer.token[:-1], self.viewer.token + "0",
                      self.viewer.token.upper() + "x", "../" + self.viewer.token):
            for name in ("", "scene.glb", "live.js"):
                self.assertEqual(self.viewer.get(name, token=token)[0], 404, token)
            with self.viewer.client(token=token) as client:
                self.assertEqual(client.status, 404)

    def test_other_names_for_this_machine(self):
        for host in ("evil.example", f"evil.example:{self.viewer.port}", "127.0.0.1.evil.example",
                     "192.168.0.1", "", "[::2]", "127.0.0.1@evil.example"):
            self.assertEqual(self.viewer.get(host=host)[0], 403, host)
        self.assertEqual(self.viewer.get(host="localhost")[0], 200)
        self.assertEqual(self.viewer.get(host="localhost:1")[0], 200)  # a port that ssh forwards

    def test_pages_of_other_sites(self):
        own = f"http://127.0.0.1:{self.viewer.port}"
        for origin in ("http://evil.example", "null", own + ".evil.example", own + "0",
                       "https://127.0.0.1:" + str(self.viewer.port)):
            with self.viewer.client(origin=origin) as client:
                self.assertEqual(client.status, 403, origin)
        with self.viewer.client(origin=own) as client:
            self.assertEqual(client.status, 101)
            client.wait("hello")

    def test_paths(self):
        for name in ("../../../../etc/passwd", "..%2f..%2fetc/passwd", "/etc/passwd",
                     "....//etc/passwd", "%2e%2e/etc/passwd", "live.js/../../x", "live.js%00",
                     urllib.parse.quote(str(ASSET)), "file:///etc/passwd", "\\etc\\passwd",
                     "index.html", "a" * 2000):
            status, _, body = self.viewer.get(name)
            self.assertEqual(status, 404, name)
            self.assertNotIn(b"root:", body)

    def test_policy(self):
        for name in ("", "live.js", "page.css", "scene.glb"):
            status, fields, _ = self.viewer.get(name)
            self.assertEqual(status, 200)
            policy = fields["content-security-policy"]
            self.assertIn("default-src 'none'", policy)
            self.assertNotIn("unsafe-inline", policy)
            self.assertNotIn("https:", policy)
            self.assertEqual(fields["x-content-type-options"], "nosniff")
            self.assertEqual(fields["referrer-policy"], "no-referrer")
            self.assertEqual(fields["cross-origin-resource-policy"], "same-origin")
            self.assertNotIn("access-control-allow-origin", fields)

    def test_page_names_no_other_machine(self):
        page = self.viewer.get("")[2].decode()
        self.assertNotRegex(page, r"(src|href)=\"?(https?:)?//")
        self.assertNotIn("<script>", page)

    def test_methods(self):
        for method in ("POST", "PUT", "DELETE", "OPTIONS", "TRACE", "CONNECT"):
            self.assertIn(self.viewer.get(method=method)[0], (400, 404, 405), method)
        status, fields, body = self.viewer.get("live.js", method="HEAD")
        self.assertEqual((status, body), (200, b""))
        self.assertGreater(int(fields["content-length"]), 0)

    def send(self, data):
        """-> the status; None where the server closed the connection on what it had not read yet,
        which may take the answer along."""
        with self.viewer.connect() as link:
            try:
                link.sendall(data)
                link.shutdown(socket.SHUT_WR)
                return viewer.parse_response(viewer.read_all(link))[0]
            except OSError:
                return None

    def test_garbage(self):
        target = f"/{self.viewer.token}/".encode()
        for data, allowed in (
                (b"\x00\x01\x02\x03\r\n\r\n", (400,)),
                (b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + b"\x55" * 200, (400, 0)),
                (b"GET\r\n\r\n", (400,)),
                (b"GET " + target + b" HTTP/9.9\r\n\r\n", (400,)),
                (b"GET " + target + b" HTTP/1.1\r\n\r\n", (403,)),
                (b"GET " + target + b" HTTP/1.1\r\nHost: a\r\nHost: localhost\r\n\r\n", (400, 403)),
                (b"GET " + target + b" HTTP/1.1\r\nHost: localhost\r\nX: " + b"y" * 10000, (431,)),
                (b"GET /" + b"y" * 20000 + b" HTTP/1.1\r\nHost: localhost\r\n\r\n", (400, 431)),
                (b"GET " + target + b" HTTP/1.1\r\nHost: localhost\r\n" + b"A: b\r\n" * 3000,
                 (400, 431)),
                (b"GET " + target + b" HTTP/1.1\r\nHost: localhost\r\n"
                 b"Content-Length: 100000000000\r\n\r\n", (400, 413)),
                (b"GET " + target + b" HTTP/1.1\r\nHost: localhost\r\n"
                 b"Transfer-Encoding: chunked\r\n\r\nffffffffffff\r\n", (400, 413)),
                (b"", (0,))):
            self.assertIn(self.send(data), (*allowed, None), data[:60])
        self.assertEqual(self.viewer.get("")[0], 200)  # it lives

    def test_frames_that_are_none(self):
        def closed(*sent):
            with self.viewer.client() as client:
                client.wait("state")
                for data in sent:
                    client.link.sendall(data)
                with self.assertRaises((viewer.Closed, ConnectionError)):
                    while True:
                        client.hear()
        mask = b"\x00" * 4
        closed(b"\xff" * 20)                                           # reserved bits
        closed(b"\x81\x05hello")                                       # not masked
        closed(b"\x81\xff" + struct.pack(">Q", 1 << 62) + mask)        # larger than anything
        closed(b"\x81\xff" + struct.pack(">Q", 70000) + mask + b" " * 70000)
        closed(b"\x82\x81" + mask + b"x")                              # bytes
        closed(b"\x81\x82" + mask + b"\xff\xfe")                       # no UTF-8
        closed(b"\x80\x81" + mask + b"x")                              # goes on with nothing
        closed(b"\x89\xfe\x00\xff" + mask + b"x" * 255)                # a ping that is too long
        closed(*[b"\x01\xfe" + struct.pack(">H", 60000) + mask + b" " * 60000] +
               [b"\x00\xfe" + struct.pack(">H", 60000) + mask + b" " * 60000])  # in pieces

    def test_messages_that_are_none(self):
        with self.viewer.client() as client:
            for text in ("", "x", "[]", "{}", "null", '{"do":1}', "[" * 60000, '"' + "x" * 60000,
                         '{"do":"play","a":{"b":[[[[]]]]}}', '{"do":"fly"}',
                         '{"do":"setDrive","joint":"/' + "a/" * 10000 + '"}',
                         '{"do":"inspect","prim":"/World{a=b}"}', '{"do":"inspect","prim":"/.."}',
                         '{"do":"step","count":1e300}', '{"do":"set","object":"/","value":""}',
                         '{"do":"set","object":"/a.b","value":"\\u0000\\ud800"}',
                         '{"do":"filterPairs","filter":["/etc/passwd"]}',
                         '{"do":"filterPairs","filter":[{"bodyA":"/x.srdf","bodyB":"/y"}]}',
                         '{"do":"filterPairs","filter":[' + '{},' * 9000 + '{}]}',
                         '{"do":"pairs","postures":1000000}', '{"do":"pairs","seed":-1}',
                         '{"do":"drives","postures":1e9}',
                         '{"do":"setLimits","limits":[{"joint":"/a","dof":[[[]]]}]}',
                         '{"do":"setLimits","limits":[{"joint":"/World","dof":"rotZ"}]}',
                         '{"do":"setGains","joint":"/World","dof":"rotX","frequency":1e300}',
                         '{"do":"testDrives","test":"stress"}',
                         '{"do":"testDrives","test":"step","period":1e9}',
                         '{"do":"testDrives","test":"step","joints":["(a+)+$"]}',
                         '{"do":"goToPose","pose":"/none"}',
                         '{"do":"renamePose","pose":"/a","name":"="}',
                         '{"do":"savePose","name":"../../x"}', '{"do":"importPoses","text":"[[[["}',
                         '{"do":"fix","file":"/etc/passwd"}'):
                client.send_frame(text.encode())
                client.wait("error")
            client.done("messages")

    def test_more_connections_than_there_may_be(self):
        links = [self.viewer.connect() for _ in range(40)]
        refused = 0
        for link in links[32:]:
            refused += link.recv(100).startswith(b"HTTP/1.1 503")
        self.assertGreaterEqual(refused, 8 - 1)
        for link in links:
            link.close()
        for _ in range(1000):
            if self.viewer.lives():
                break

    def test_half_open(self):
        links = [self.viewer.connect() for _ in range(10)]
        for link in links[:5]:
            link.sendall(b"GET /")
        with self.viewer.client() as client:  # others are served meanwhile
            client.wait("hello")
        self.assertEqual([viewer.read_all(link) for link in links], [b""] * 10)  # closed in time
        for link in links:
            link.close()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
