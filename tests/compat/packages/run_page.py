# SPDX-License-Identifier: MIT
"""Runs the blocks of code of docs/install.md, section by section, in the root of the sources.

    run_page.py FOLDER [HEADING ...]

A section whose first line is `apt-get install ...` runs in a Debian that lies over FOLDER/system: packages and sources (dch)
are in its working directory, and all but that first line has no network. At its end the packages are purged, and no file may
be left of them. Other sections run here. Runs in a namespace of mounts of its own.
"""
import contextlib
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path.cwd()
PACKAGES = ROOT / "build" / "packages"
OURS = re.compile(r"dch", re.IGNORECASE)
ENVIRONMENT = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "LC_ALL": "C.UTF-8", "DEBIAN_FRONTEND": "noninteractive",
               **{name: value for name, value in os.environ.items() if name.lower().endswith("_proxy")}}
# Folders of the system itself, of apt and dpkg, and of whoever runs something.
NOT_COMPARED = ("proc", "dev", "sys", "tmp", "root", "run", "var/lib/apt", "var/lib/dpkg", "var/cache", "var/log")


def sections(page):
    """Headings, each with its blocks: (language, text)."""
    for part in re.split(r"^#+ ", page, flags=re.MULTILINE)[1:]:
        blocks = re.findall(r"^```(\w+)\n(.*?)^```", part, re.MULTILINE | re.DOTALL)
        if blocks:
            yield part.split("\n")[0], blocks


class System:
    """A copy of FOLDER/system, whose changes are kept in memory and lost."""

    def __init__(self, folder, scratch):
        self.root = scratch / "root"
        subprocess.run(["mount", "-t", "tmpfs", "tmpfs", scratch], check=True)
        for name in ("upper", "work", "root"):
            (scratch / name).mkdir()
        layers = f"lowerdir={folder}/system,upperdir={scratch}/upper,workdir={scratch}/work"
        subprocess.run(["mount", "-t", "overlay", "overlay", "-o", layers, self.root], check=True)
        subprocess.run(["mount", "-t", "proc", "proc", self.root / "proc"], check=True)
        subprocess.run(["mount", "--rbind", "/dev", self.root / "dev"], check=True)
        subprocess.run(["mount", "--bind", folder / "archives", self.root / "var/cache/apt/archives"], check=True)

    def run(self, *command, network=False, **options):
        enter = ["chroot", str(self.root), "env", "-C", "/root", *command]
        if not network:
            enter = ["unshare", "--net", "sh", "-ec", 'ip link set lo up; exec "$@"', "sh", *enter]
        return subprocess.run(enter, check=True, env=ENVIRONMENT, **options)

    def files(self):
        found = set()
        for folder, folders, names in os.walk(self.root):
            here = os.path.relpath(folder, self.root)
            folders[:] = [name for name in folders if os.path.normpath(f"{here}/{name}") not in NOT_COMPARED]
            found |= {os.path.normpath(f"{here}/{name}") for name in folders + names}
        return found


def field(package, name):
    return subprocess.run(["dpkg-deb", "--field", package, name], check=True, capture_output=True, text=True).stdout.strip()


def needed(packages):
    """What apt has to have installed before the packages."""
    names = {field(package, "Package") for package in packages}
    depends = ", ".join(field(package, "Depends") for package in packages).split(", ")
    return ", ".join(entry for entry in depends if entry and entry.split()[0] not in names)


def check_names(package):
    """A file with our name, or in a folder with it, can be in no package of others."""
    listing = subprocess.run(["dpkg-deb", "--fsys-tarfile", package], check=True, capture_output=True).stdout
    names = subprocess.run(["tar", "-t"], input=listing, check=True, capture_output=True).stdout.decode().split()
    strange = [name for name in names if not name.endswith("/") and not OURS.search(name)]
    if strange:
        raise SystemExit(f"{package.name}: {strange}")


def run_blocks(blocks, run):
    """run(command, input): a program with its standard input. A block that begins with the name of a file is one."""
    for language, text in blocks:
        name = re.match(r"(?://|#) ([\w.]+)\n", text)
        if name:
            run(["cp", "/dev/stdin", name[1]], text)
        elif language == "sh":
            run(["sh", "-e"], text)
        else:
            run(["python3", "-"], text)


def copy_sources(target):
    files = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", "--deduplicate"], check=True,
                           capture_output=True).stdout.split(b"\0")
    there = b"\0".join(name for name in files if name and os.path.exists(name))
    archive = subprocess.run(["tar", "-c", "--null", "-T", "-"], input=there, check=True, capture_output=True).stdout
    target.mkdir()
    subprocess.run(["tar", "-x", "-C", target], input=archive, check=True)


def run_in_debian(folder, blocks):
    install, _, rest = blocks[0][1].partition("\n")
    words = install.split()[2:]
    packages = [next(PACKAGES.glob(word[2:])) for word in words if word.startswith("./")]
    with tempfile.TemporaryDirectory() as scratch, contextlib.ExitStack() as after:
        after.callback(subprocess.run, ["umount", "--recursive", "--lazy", scratch], check=True)
        system = System(folder, pathlib.Path(scratch))
        quietly = {"network": True, "stdout": subprocess.DEVNULL}
        others = [word for word in words if not word.startswith("./")]
        system.run("apt-get", "-qq", "install", "--no-install-recommends", *others, **quietly)
        if packages:
            system.run("apt-get", "-qq", "satisfy", "--no-install-recommends", needed(packages), **quietly)
        copy_sources(system.root / "root" / "dch")
        before = system.files()
        for package in packages:
            check_names(package)
            subprocess.run(["cp", package, system.root / "root"], check=True)
        system.run("sh", "-ec", install.replace("install", "-qq install --no-install-recommends", 1), **quietly)
        run_blocks([("sh", rest), *blocks[1:]], lambda command, text: system.run(*command, input=text.encode()))
        if packages:
            system.run("dpkg", "--purge", *(field(package, "Package") for package in packages), stdout=subprocess.DEVNULL)
        changed = before ^ system.files()
        if changed:
            raise SystemExit(f"purging leaves or takes {sorted(changed)}")


def run_here(_, blocks):
    run_blocks(blocks, lambda command, text: subprocess.run(command, input=text.encode(), check=True))


def main(folder, *headings):
    for heading, blocks in sections((ROOT / "docs" / "install.md").read_text()):
        if headings and heading not in headings:
            continue
        print(f"-- {heading}", flush=True)
        run = run_in_debian if blocks[0][1].startswith("apt-get install ") else run_here
        try:
            run(pathlib.Path(folder), blocks)
        except subprocess.CalledProcessError as error:
            raise SystemExit(f"{heading}: exit status {error.returncode}") from None


main(*sys.argv[1:])
