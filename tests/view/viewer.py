# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A running `tenon view`, and clients of it over plain sockets: HTTP and WebSocket (RFC 6455)."""

import base64
import json
import os
import signal
import socket
import struct
import subprocess
import urllib.parse

PATIENCE = 60  # [s] until something that has to come is missed


class Viewer:
    """The program, running on an asset."""

    def __init__(self, program, asset, *options):
        self.process = subprocess.Popen([program, "view", "--json", str(asset), *options],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        text = ""
        while not text.endswith("\n}\n"):
            line = self.process.stdout.readline()
            if not line:
                raise AssertionError("no address: " + text + self.process.stderr.read())
            text += line
        self.answer = json.loads(text)
        url = urllib.parse.urlparse(self.answer["url"])
        self.port = url.port
        self.token = url.path.strip("/")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()

    def end(self, number=signal.SIGINT):
        """-> exit code and what stood on standard error."""
        self.process.send_signal(number)
        return self.process.wait(PATIENCE), self.process.stderr.read()

    def connect(self):
        return socket.create_connection(("127.0.0.1", self.port), PATIENCE)

    def get(self, name="", token=None, host=None, method="GET"):
        """-> status, fields, body."""
        token = self.token if token is None else token
        with self.connect() as link:
            host = f"127.0.0.1:{self.port}" if host is None else host
            link.sendall(f"{method} /{token}/{name} HTTP/1.1\r\nHost: {host}\r\n"
                         "Connection: close\r\n\r\n".encode())
            return parse_response(read_all(link))

    def client(self, **options):
        return Client(self, **options)

    def lives(self):
        return self.get()[0] == 200


def read_all(link):
    data = b""
    while True:
        try:
            piece = link.recv(1 << 20)
        except ConnectionResetError:
            return data
        if not piece:
            return data
        data += piece


def parse_response(data):
    head, _, body = data.partition(b"\r\n\r\n")
    lines = head.decode("latin-1").split("\r\n")
    fields = dict(line.lower().split(": ", 1) for line in lines[1:] if ": " in line)
    return int(lines[0].split()[1]) if lines[0] else 0, fields, body


class Closed(Exception):
    """The other side has ended the WebSocket."""


class Client:
    """One WebSocket. Everything that comes is kept: notices by name, frames as tuples of floats."""

    def __init__(self, viewer, origin=None, token=None):
        self.link = viewer.connect()
        self.data = b""
        self.notices = []
        self.frames = []
        self.number = 0
        key = base64.b64encode(os.urandom(16)).decode()
        origin = f"Origin: {origin}\r\n" if origin else ""
        self.link.sendall(
            (f"GET /{viewer.token if token is None else token}/ws HTTP/1.1\r\n"
             f"Host: 127.0.0.1:{viewer.port}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
             f"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n{origin}\r\n").encode())
        while b"\r\n\r\n" not in self.data:
            piece = self.link.recv(1 << 16)
            if not piece:
                break
            self.data += piece
        head, _, self.data = self.data.partition(b"\r\n\r\n")
        self.status = int(head.split()[1]) if head else 0

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.link.close()

    def send_frame(self, payload, opcode=1, fin=True):
        size = len(payload)
        if size < 126:
            head = bytes([opcode | (128 if fin else 0), 128 | size])
        elif size < 1 << 16:
            head = bytes([opcode | (128 if fin else 0), 254]) + struct.pack(">H", size)
        else:
            head = bytes([opcode | (128 if fin else 0), 255]) + struct.pack(">Q", size)
        mask = os.urandom(4)
        self.link.sendall(head + mask + bytes(b ^ mask[i % 4] for i, b in enumerate(payload)))

    def _take(self, size):
        while len(self.data) < size:
            piece = self.link.recv(1 << 20)
            if not piece:
                raise Closed
            self.data += piece
        taken, self.data = self.data[:size], self.data[size:]
        return taken

    def hear(self):
        """Takes one message. -> the notice, or None for a frame."""
        first, size = self._take(2)
        if size == 126:
            size, = struct.unpack(">H", self._take(2))
        elif size == 127:
            size, = struct.unpack(">Q", self._take(8))
        payload = self._take(size)
        opcode = first & 15
        if opcode == 8:
            raise Closed
        if opcode == 9:
            self.send_frame(payload, 10)
        elif opcode == 2:
            self.frames.append(struct.unpack(f"<{size // 4}f", payload))
        elif opcode == 1:
            self.notices.append(json.loads(payload))
            return self.notices[-1]
        return None

    def until(self, test):
        """Hears until a notice passes; -> it."""
        while True:
            notice = self.hear()
            if notice is not None and test(notice):
                return notice

    def wait(self, name, **values):
        """The next notice of that name with these values."""
        return self.until(lambda n: n["is"] == name and
                          all(n.get(key) == value for key, value in values.items()))

    def ask(self, do, **fields):
        """-> the result, or {"error": ...} of the request."""
        self.number += 1
        self.send_frame(json.dumps({"do": do, "id": self.number, **fields}).encode())
        notice = self.until(lambda n: n["is"] in ("answer", "error") and
                            n["id"] == self.number)
        return notice["result"] if notice["is"] == "answer" else {"error": notice["error"]}

    def done(self, do, **fields):
        """The same where it has to succeed."""
        result = self.ask(do, **fields)
        assert "error" not in result, f"{do} {fields}: {result['error']}"
        return result

    def refused(self, do, **fields):
        """The rule of the error that it has to be."""
        result = self.ask(do, **fields)
        assert "error" in result, f"{do} {fields} was done"
        return result["error"]["rule"]

    def last(self, name):
        found = [notice for notice in self.notices if notice["is"] == name]
        assert found, f"no notice `{name}` came"
        return found[-1]

    def next_frame(self):
        count = len(self.frames)
        while len(self.frames) == count:
            self.hear()
        return self.frames[-1]
