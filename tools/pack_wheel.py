#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Packs a zip archive anew with the best that deflate can do, which any reader of zip reads.

usage: pack_wheel.py FROM TO    (with the Python of tools/make_wheel.sh, which has `deflate`)

Members keep their order, names and permissions; their time is that of SOURCE_DATE_EPOCH, or 1980,
so that equal contents are equal files.
"""

import os
import struct
import sys
import time
import zipfile
import zlib

import deflate

BEST = 12
UTF8 = 0x800
STORED, DEFLATED = 0, 8


def dos_time():
    """-> (time, date) as zip writes them."""
    year, month, day, hour, minute, second = time.gmtime(
        max(int(os.environ.get("SOURCE_DATE_EPOCH", 0)), 315532800))[:6]
    return hour << 11 | minute << 5 | second // 2, (year - 1980) << 9 | month << 5 | day


def packed(source, target):
    """Writes all members of an open ZipFile to an open file, without ZIP64: 4 GB are too many."""
    stamp = dos_time()
    directory = b""
    members = source.infolist()
    for info in members:
        contents = source.read(info)
        small = bytes(deflate.deflate_compress(contents, BEST))
        method = DEFLATED if len(small) < len(contents) else STORED
        body = small if method == DEFLATED else contents
        name = info.filename.encode()
        common = struct.pack("<HHHHHIIIHH", 20, UTF8, method, *stamp, zlib.crc32(contents),
                             len(body), len(contents), len(name), 0)
        place = target.tell()
        target.write(b"PK\x03\x04" + common + name + body)
        directory += (b"PK\x01\x02" + struct.pack("<H", 3 << 8 | 20) + common
                      + struct.pack("<HHHII", 0, 0, 0, info.external_attr, place) + name)
    place = target.tell()
    target.write(directory + b"PK\x05\x06" + struct.pack(
        "<HHHHIIH", 0, 0, len(members), len(members), len(directory), place, 0))


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__.split("\n\n")[1])
    part = sys.argv[2] + ".part"
    with zipfile.ZipFile(sys.argv[1]) as source, open(part, "wb") as target:
        packed(source, target)
    with zipfile.ZipFile(part) as made, zipfile.ZipFile(sys.argv[1]) as source:
        if made.testzip() is not None or made.namelist() != source.namelist():
            sys.exit(f"{part} is not what {sys.argv[1]} was")
    os.replace(part, sys.argv[2])


if __name__ == "__main__":
    main()
