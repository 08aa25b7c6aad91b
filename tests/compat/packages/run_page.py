# SPDX-License-Identifier: MIT
"""Runs the blocks of code of docs/install.md, section by section, in the root of the sources, and those by which docs/python.md
builds the module.

    run_page.py [--builder ROOT] FOLDER [HEADING ...]

A section whose first line is `apt-get install ...` runs in a Debian that lies over FOLDER/system: packages and sources (dch)
are in its working directory, and all but that first line has no network. The rest of it runs twice, as root and as nobody.
At its end the packages are purged, and no file may be left of them. Other sections run here, or in the system at ROOT, in
its /usr/src/dch. Runs in a namespace of mounts of its own.
"""
import argparse
import contextlib
import os
import pathlib
import re
import subprocess
import tempfile

ROOT = pathlib.Path.cwd()
BUILT_IN = "usr/src/dch"  # of another system
OURS = re.compile(r"dch", re.IGNORECASE)
ENVIRONMENT = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "LC_ALL": "C.UTF-8", "DEBIAN_FRONTEND": "noninteractive",
               **{name: value for name, value in os.environ.items() if name.lower().endswith("_proxy")}}
HOMES = {"root": "/root", "nobody": "/tmp/nobody"}  # who runs what is installed, and where
# Folders of the system itself, of apt and dpkg, and of whoever runs something.
NOT_COMPARED = ("proc", "dev", "sys", "tmp", "root", "run", "var/lib/apt", "var/lib/dpkg", "var/cache", "var/log")


def all_sections():
    """Of both pages, each with a heading of its own."""
    docs = ROOT / "docs"
    yield from sections((docs / "install.md").read_text())
    yield next(("Build of the module", blocks) for heading, blocks in sections((docs / "python.md").read_text()) if heading == "Build")


def sections(page):
    """Headings, each with its blocks: (language, text). Lines of a block may begin as headings do."""
    found = []
    for heading, language, text in re.findall(r"^#+ ([^\n]*)$|^```(\w+)\n(.*?)^```", page, re.MULTILINE | re.DOTALL):
        if heading:
            found.append((heading, []))
        else:
            found[-1][1].append((language, text))
    return [(heading, blocks) for heading, blocks in found if blocks]


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

    def run(self, *command, home="/root", user="root", network=False, **options):
        enter = ["chroot", f"--userspec={user}", str(self.root), "env", "-C", home, f"HOME={home}", *command]
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
            run(["dd", "status=none", f"of={name[1]}"], text)
        elif language == "sh":
            run(["sh", "-e"], text)
        else:
            run(["python3", "-"], text)


def copy_sources(target):
    files = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", "--deduplicate"], check=True,
                           capture_output=True).stdout.split(b"\0")
    there = b"\0".join(name for name in files if name and os.path.exists(name))
    archive = subprocess.run(["tar", "-c", "--null", "-T", "-"], input=there, check=True, capture_output=True).stdout
    target.mkdir(parents=True)
    subprocess.run(["tar", "-x", "-C", target], input=archive, check=True)


def run_in_debian(folder, sources, blocks):
    install, _, rest = blocks[0][1].partition("\n")
    words = install.split()[2:]
    packages = [next((sources / "build" / "packages").glob(word[2:])) for word in words if word.startswith("./")]
    with tempfile.TemporaryDirectory() as scratch, contextlib.ExitStack() as after:
        after.callback(subprocess.run, ["umount", "--recursive", "--lazy", scratch], check=True)
        system = System(folder, pathlib.Path(scratch))
        quietly = {"network": True, "stdout": subprocess.DEVNULL}
        others = [word for word in words if not word.startswith("./")]
        system.run("apt-get", "-qq", "install", "--no-install-recommends", *others, **quietly)
        if packages:
            system.run("apt-get", "-qq", "satisfy", "--no-install-recommends", needed(packages), **quietly)
        for user, home in HOMES.items():
            copy_sources(system.root / home.lstrip("/") / "dch")
            system.run("chown", "--recursive", user, home)
        before = system.files()
        for package in packages:
            check_names(package)
            subprocess.run(["cp", package, system.root / "root"], check=True)
        system.run("sh", "-ec", install.replace("install", "-qq install --no-install-recommends", 1), **quietly)
        for user, home in HOMES.items():
            run_blocks([("sh", rest), *blocks[1:]],
                       lambda command, text: system.run(*command, home=home, user=user, input=text.encode()))
        if packages:
            system.run("dpkg", "--purge", *(field(package, "Package") for package in packages), stdout=subprocess.DEVNULL)
        changed = before ^ system.files()
        if changed:
            raise SystemExit(f"purging leaves or takes {sorted(changed)}")


def run_here(builder, blocks):
    enter, environment = ([], None) if not builder else (["chroot", builder, "env", "-C", f"/{BUILT_IN}"], ENVIRONMENT)
    run_blocks(blocks,
               lambda command, text: subprocess.run([*enter, *command], input=text.encode(), check=True, env=environment))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--builder", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("headings", nargs="*")
    args = parser.parse_args()
    sources = args.builder / BUILT_IN if args.builder else ROOT
    for heading, blocks in all_sections():
        if args.headings and heading not in args.headings:
            continue
        print(f"-- {heading}", flush=True)
        try:
            if blocks[0][1].startswith("apt-get install "):
                run_in_debian(args.folder, sources, blocks)
            else:
                run_here(args.builder, blocks)
        except subprocess.CalledProcessError as error:
            raise SystemExit(f"{heading}: exit status {error.returncode}") from None


if __name__ == "__main__":
    main()
