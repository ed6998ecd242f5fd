// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

/// Internal to this folder.
namespace tenon::xacro {

/// Python: where it and its packages are, one folder a line; then a line "xacro" where it has that.
/// It answers on descriptor 4, in messages that end with a zero byte.
inline constexpr std::string_view kAboutPython = R"python(
import importlib.util, os, sys
folders = [sys.prefix, sys.base_prefix, sys.exec_prefix, os.path.realpath(sys.executable)]
folders += [p for p in sys.path if p and os.path.exists(p)]
if importlib.util.find_spec("xacro"):
    folders.append("xacro")
os.write(4, "\n".join(folders).encode() + b"\0")
sys.stdin.read()
)python";

/// Python: expands argv[1]. Then come NAME=DIR of packages, "--" and NAME=VALUE of arguments.
/// Three messages: "done", the text and the files that were read; or "failed", the message and the
/// file that it is about; or "package", a name whose folder is not known, and the file.
inline constexpr std::string_view kExpand = R"python(
import os, sys, types

def say(*parts):
    for part in parts:
        data = part.encode("utf-8", "replace").replace(b"\0", b"?") + b"\0"
        while data:
            data = data[os.write(4, data):]
    sys.stdin.read()
    os._exit(0)

file, words = sys.argv[1], sys.argv[2:]
split = words.index("--")
packages = dict(word.split("=", 1) for word in words[:split])
mappings = dict(word.split("=", 1) for word in words[split + 1:])

class Unknown(Exception):
    pass

unknown = []

def share(name, *_):
    if name not in packages:
        unknown.append(str(name))
        raise Unknown(str(name))
    return packages[name]

class RosPack:
    def get_path(self, name):
        return share(name)

ament = types.ModuleType("ament_index_python")
ament.packages = types.ModuleType("ament_index_python.packages")
ament.get_package_share_directory = ament.packages.get_package_share_directory = share
ament.PackageNotFoundError = ament.packages.PackageNotFoundError = Unknown
ros = types.ModuleType("rospkg")
ros.RosPack = RosPack
sys.modules.update({"ament_index_python": ament, "ament_index_python.packages": ament.packages,
                    "rospkg": ros})
import xacro
try:
    document = xacro.process_file(file, mappings=mappings)
    text = document.toprettyxml(indent="  ")
except BaseException as error:
    stack = getattr(xacro, "filestack", None) or [file]
    if unknown:
        say("package", unknown[-1], str(stack[-1]))
    say("failed", str(error) or type(error).__name__, str(stack[-1]))
say("done", text, "\n".join([file] + sorted(map(str, getattr(xacro, "all_includes", [])))))
)python";

}  // namespace tenon::xacro
