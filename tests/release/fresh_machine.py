#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""README's two commands on a machine that has nothing: a Debian made by debootstrap with git, make
and sudo, a user who is not root, a clone in a folder with a space in its name below the temporary
folder, and nothing beside it. Then once more as root, in the same clone.

    fresh_machine.py CODENAME [--only demo] [--user-alone] [--keep] [--commit COMMIT]

CODENAME is bookworm (Debian 12) or trixie (13). The last commit is tried, or COMMIT. Of this host
the new one gets how its package clients reach their registries (mirror, proxy, certificates, names
of hosts), and nothing else: no package, no cache, no environment. Needs root.
The bare system is kept in the judge's cache; the machine is removed at the end, unless --keep.
What the commands say is printed; the last line is the result: minutes, and tests passed and
skipped. Exit 0: both commands ended with 0 each time; 1: one did not; 77: no such machine can be
made here.
"""

import argparse
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
CACHE = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache")
KEPT = CACHE / "tenon-judge"
CLONE = "/tmp/a new folder/tenon"
USER = "newcomer"
VERSIONS = {"bookworm": "Debian 12", "trixie": "Debian 13"}

# Runs in namespaces of its own, which end with it: what it mounts and starts is gone then.
MOUNTS = r"""
set -euo pipefail
root=$1
shift
mount --make-rprivate /
mount -t proc proc "$root/proc"
mount -t sysfs -o ro sysfs "$root/sys" 2>/dev/null || true
mount --rbind /dev "$root/dev"
mount -t tmpfs -o mode=1777 tmpfs "$root/dev/shm" 2>/dev/null || true
hostname fresh
exec chroot "$root" /usr/bin/env -i TERM=dumb PATH=/usr/sbin:/usr/bin:/sbin:/bin "$@"
"""


class NotHere(Exception):
    """Why no machine can be made on this one."""


def output_of(*words):
    """What a command prints; empty where it is missing or fails."""
    try:
        return subprocess.run(words, capture_output=True, text=True, check=False).stdout
    except OSError:
        return ""


def readme_commands():
    """The two commands, as the first lines in code that begin with them."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    code = re.findall(r"^(?: {4}|\$ )(.+)$", text, re.M)
    for block in re.findall(r"^```\w*\n(.*?)^```$", text, re.M | re.S):
        code += block.splitlines()
    commands = {}
    for line in code:
        found = re.match(r"(make (demo|test)\b.*?)\s*(?:#|$)", line.strip().removeprefix("$ "))
        if found:
            commands.setdefault(found[2], found[1])
    if set(commands) != {"demo", "test"}:
        sys.exit("README.md no longer prints `make demo` and `make test`")
    return commands


def package_sources():
    """[(address, suite with CODENAME in it)] of this Debian's own packages."""
    here = re.search(r"^VERSION_CODENAME=(\w+)$",
                     pathlib.Path("/etc/os-release").read_text(encoding="utf-8"), re.M)
    lines = output_of("apt-get", "indextargets", "--format",
                      "$(REPO_URI) $(RELEASE) $(COMPONENT) $(CREATED_BY)").splitlines()
    found = []
    for line in lines:
        address, suite, component, kind = line.split(" ", 3)
        if here and here[1] in suite and (component, kind) == ("main", "Packages"):
            found.append((address, suite.replace(here[1], "CODENAME")))
    if not any(suite == "CODENAME" for _, suite in found):
        raise NotHere("apt has no mirror of Debian here")
    return found


def make_base(codename, sources):
    """The bare system with git, make and sudo, made once."""
    base = KEPT / f"fresh-{codename}"
    if (KEPT / f"fresh-{codename}.made").exists():
        return base
    shutil.rmtree(base, ignore_errors=True)
    KEPT.mkdir(parents=True, exist_ok=True)
    mirror = next(address for address, suite in sources if suite == "CODENAME")
    print(f"debootstrap {codename}", flush=True)
    done = subprocess.run(["debootstrap", "--variant=minbase", "--include=git,make,sudo", codename,
                           base, mirror], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, check=False)
    if done.returncode:
        raise NotHere(f"debootstrap made no {codename}: " + done.stdout.strip()[-300:])
    (KEPT / f"fresh-{codename}.made").touch()
    return base


def give_apt(root, codename, sources):
    lines = [f"deb {address} {suite.replace('CODENAME', codename)} main\n"
             for address, suite in sources]
    (root / "etc/apt/sources.list").write_text("".join(lines), encoding="utf-8")
    wanted = re.compile(r"Acquire::(https?|Check-Valid-Until|Check-Date|Retries|ForceIPv[46])\b")
    settings = [line + "\n" for line in output_of("apt-config", "dump").splitlines()
                if wanted.match(line) and not line.endswith('"";')]
    (root / "etc/apt/apt.conf.d/90mirror").write_text("".join(settings), encoding="utf-8")
    for name in pathlib.Path("/etc/apt/auth.conf.d").glob("*"):
        shutil.copy(name, root / "etc/apt/auth.conf.d")


def give_pip(root):
    """Where pip looks, from the files and the environment of this machine."""
    wanted = {"index-url", "extra-index-url", "proxy", "trusted-host", "timeout", "retries"}
    lines = []
    for line in output_of(sys.executable, "-m", "pip", "config", "list").splitlines():
        name, _, value = line.partition("=")
        if name.rpartition(".")[2] in wanted:
            lines.append(f"{name.rpartition('.')[2]} = {value.strip(chr(39))}\n")
    (root / "etc/pip.conf").write_text("[global]\n" + "".join(lines), encoding="utf-8")


def give_npm(home):
    lines = []
    for name in ("registry", "proxy", "https-proxy", "noproxy"):
        value = output_of("npm", "config", "get", name).strip()
        if value not in ("", "null", "undefined"):
            lines.append(f"{name}={value}\n")
    (home / ".npmrc").write_text("".join(lines), encoding="utf-8")


def give_cargo(home):
    own = pathlib.Path(os.environ.get("CARGO_HOME") or pathlib.Path.home() / ".cargo")
    for name in ("config.toml", "config"):
        if (own / name).exists():
            (home / ".cargo").mkdir(exist_ok=True)
            shutil.copy(own / name, home / ".cargo/config.toml")


def give_profile(root):
    """Proxies, and the certificates of the fresh machine for the clients that bring their own."""
    names = ("http_proxy", "https_proxy", "no_proxy", "all_proxy")
    lines = [f"export {name}={shlex.quote(os.environ[name])}\n"
             for each in names for name in (each, each.upper()) if name in os.environ]
    bundle = "/etc/ssl/certs/ca-certificates.crt"
    own = pathlib.Path("/usr/local/share/ca-certificates")
    for certificate in own.rglob("*.crt"):
        place = root / "usr/local/share/ca-certificates"
        place.mkdir(parents=True, exist_ok=True)
        shutil.copy(certificate, place)
        lines.append(f"export NODE_EXTRA_CA_CERTS={bundle} PIP_CERT={bundle}\n")
    (root / "etc/profile.d/registries.sh").write_text("".join(sorted(set(lines))),
                                                      encoding="utf-8")


def make_machine(codename):
    """The folder of a new machine with its user."""
    sources = package_sources()
    base = make_base(codename, sources)
    root = KEPT / f"fresh-{codename}-run"
    remove_machine(root)
    subprocess.run(["cp", "-a", base, root], check=True)
    for name in ("resolv.conf", "hosts"):  # how names of hosts are found
        shutil.copy(f"/etc/{name}", root / "etc" / name)
    with open(root / "etc/hosts", "a", encoding="utf-8") as file:
        file.write("127.0.1.1 fresh\n")
    (root / "etc/hostname").write_text("fresh\n", encoding="utf-8")
    give_apt(root, codename, sources)
    give_pip(root)
    give_profile(root)
    subprocess.run(["chroot", root, "useradd", "--create-home", "--shell", "/bin/bash", USER],
                   check=True)
    rights = root / "etc/sudoers.d" / USER
    rights.write_text(f"{USER} ALL=(ALL) NOPASSWD:ALL\n", encoding="utf-8")
    rights.chmod(0o440)
    for home in (root / "root", root / "home" / USER):
        give_npm(home)
        give_cargo(home)
    return root


def remove_machine(root):
    if root.exists():
        subprocess.run(["rm", "-rf", "--one-file-system", root], check=True)


def bring_clone(root, commit):
    """A repository of this one's commit, as it would be on a server, and the user's clone of it."""
    source = root / "srv/tenon.git"
    git = ["git", "-c", "safe.directory=*"]
    subprocess.run([*git, "clone", "--quiet", "--bare", "--no-hardlinks", ROOT, source], check=True)
    subprocess.run([*git, "-C", source, "update-ref", "refs/heads/main", commit], check=True)
    subprocess.run([*git, "-C", source, "symbolic-ref", "HEAD", "refs/heads/main"], check=True)
    subprocess.run(["chroot", root, "chown", "-R", USER, "/srv/tenon.git"], check=True)
    folder = str(pathlib.PurePath(CLONE).parent)
    words = f"mkdir {shlex.quote(folder)} && git clone --quiet /srv/tenon.git {shlex.quote(CLONE)}"
    if within(root, USER, words, "/", lambda line: print(line, end="")):
        raise NotHere("git made no clone")


def within(root, user, command, folder, said):
    """Runs a command line in a login shell of a user, hands each line to said; -> exit code."""
    shell = f"cd {shlex.quote(folder)} && {command}"
    words = ["unshare", "--mount", "--pid", "--fork", "--uts", "--ipc", "--kill-child", "bash",
             "-c", MOUNTS, "machine", str(root), "su", "--login", user, "--command", shell]
    with subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, errors="replace") as process:
        for line in process.stdout:
            said(line)
    return process.returncode


class Outcome:
    """What one command said at its end, as words."""

    def __init__(self):
        self.total, self.failed, self.skipped = None, 0, []

    def read(self, line):
        print(line, end="", flush=True)
        ended = re.search(r"tests passed, (\d+) tests failed out of (\d+)", line)
        if ended:
            self.failed, self.total = int(ended[1]), int(ended[2])
        if line.rstrip().endswith("(Skipped)"):
            self.skipped.append(line.split()[2])

    def words(self):
        if self.total is None:
            return ""
        passed = self.total - self.failed - len(self.skipped)
        return (f": {passed} passed, {len(self.skipped)} skipped"
                + (f", {self.failed} failed" if self.failed else ""))


def try_commands(root, user, commands):
    """-> (all ended with 0, words of the result)"""
    words = []
    for name, command in commands.items():
        print(f"\n== {user}: {command}", flush=True)
        start, outcome = time.monotonic(), Outcome()
        status = within(root, user, command, CLONE, outcome.read)
        minutes = (time.monotonic() - start) / 60
        picture = name == "demo" and (root / CLONE[1:] / "build/demo/grasp.png").exists()
        words.append(f"{name} {minutes:.1f} min{outcome.words()}"
                     + (", with a picture" if picture else "")
                     + (f", exit code {status}" if status else ""))
        print(f"== {user}: {words[-1]}", flush=True)
        if status:
            return False, ", ".join(words)
    return True, ", ".join(words)


def run(arguments):
    commands = readme_commands()
    if arguments.only:
        commands = {arguments.only: commands[arguments.only]}
    root = make_machine(arguments.codename)
    results = []
    try:
        bring_clone(root, arguments.commit)
        good, words = try_commands(root, USER, commands)
        results.append(f"as a user {words}")
        if good and not arguments.user_alone:
            subprocess.run(["chroot", root, "chown", "-R", "root:root", CLONE], check=True)
            good, words = try_commands(root, "root", commands)
            results.append(f"once more as root {words}")
    finally:
        if arguments.keep:
            print(f"kept: {root}")
        else:
            remove_machine(root)
    print(f"{VERSIONS[arguments.codename]}: " + "; ".join(results))
    return 0 if good else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("codename", choices=VERSIONS)
    parser.add_argument("--only", choices=("demo", "test"), help="one of the two commands")
    parser.add_argument("--user-alone", action="store_true", help="not once more as root")
    parser.add_argument("--keep", action="store_true", help="leave the machine in the cache")
    parser.add_argument("--commit", default="HEAD")
    arguments = parser.parse_args()
    arguments.commit = output_of("git", "-C", str(ROOT), "rev-parse", "--verify", "--quiet",
                                 arguments.commit + "^{commit}").strip()
    try:
        if os.geteuid() != 0:
            raise NotHere("debootstrap and chroot need root")
        for program in ("debootstrap", "unshare", "git"):
            if not shutil.which(program):
                raise NotHere(f"no {program} (apt-get install debootstrap util-linux git)")
        return run(arguments)
    except NotHere as reason:
        print(f"skipped: {reason}")
        return 77


if __name__ == "__main__":
    sys.exit(main())
