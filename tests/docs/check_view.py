#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Opens pages of dchmd replay --view in headless Chromium, as files.

usage: check_view.py CHROMIUM DCHMD DATA; exit status 1 if a script of a page has a fault, reads other numbers than
tests/golden/replay/view_reader.py does, tells other counts, or does not draw what is ticked and nothing else.
"""
import html
import json
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "golden" / "replay"))
from check_pages import dump  # noqa: E402
from view_reader import read_view  # noqa: E402

RUNS = [("polymer.lammpstrj", "5"), ("triclinic-namd.dcd", "4"), ("nopbc.dcd", "5")]
OPTIONS = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--virtual-time-budget=60000"]

# Shows the last frame at its highest level but one, each thing by itself and none, and counts the pixels that are not the page's.
PROBE = """<script>
(async () => {
  const wait = () => new Promise(done => setTimeout(done, 50));
  const tick = (id, ticked) => {
    element(id).checked = ticked;
    element(id).dispatchEvent(new Event('change'));
  };
  const drawn = () => {
    const canvas = document.querySelector('canvas'), copy = document.createElement('canvas');
    copy.width = canvas.width;
    copy.height = canvas.height;
    const pen = copy.getContext('2d');
    pen.drawImage(canvas, 0, 0);
    const pixels = new Uint32Array(pen.getImageData(0, 0, copy.width, copy.height).data.buffer);
    return pixels.filter(pixel => pixel !== pixels[pixels.length - 1]).length;
  };
  // How many frames are waited for at once if it is stopped and played again while a frame loads.
  const loops = async () => {
    const read = readFrame, wait100 = setTimeout;
    let waiting = 0, most = 0, again = true;
    readFrame = facts => {
      if (again) {
        again = false;
        element('play').click();
        element('play').click();
      }
      return read(facts);
    };
    setTimeout = (task, time) => {
      if (time !== 100) return wait100(task, time);
      most = Math.max(most, ++waiting);
      return wait100(() => { --waiting; task(); }, time);
    };
    element('play').click();
    for (let k = 0; k < 10; ++k) await wait();
    most = waiting;
    for (let k = 0; k < 10; ++k) await wait();
    element('play').click();
    readFrame = read;
    setTimeout = wait100;
    return most;
  };
  const weighed = values => values.reduce((sum, value, k) => sum + (k + 1) % 1000 * value, 0);
  while (document.body.dataset.shown !== '0') await wait();
  const found = {first: drawn(), pixels: {}};
  const last = frames.length - 1, level = Math.max(1, frames[last].levels.length - 2);
  element('frame').value = last;
  element('frame').dispatchEvent(new Event('input'));
  while (document.body.dataset.shown !== String(last)) await wait();
  element('level').value = level;
  element('level').dispatchEvent(new Event('change'));
  const boxes = [...document.querySelectorAll('fieldset input')].map(box => box.id);
  for (const id of boxes) tick(id, false);
  found.pixels.none = drawn();
  for (const id of boxes) {
    tick(id, true);
    found.pixels[id] = drawn();
    tick(id, false);
  }
  const frame = await readFrame(frames[last]);
  const edges = frame.levels.slice(1).map(one => one.edges);
  found.sums = [frame.contacts, ...edges, ...frame.levels.slice(1).map(one => one.nodes), ...frame.levels.map(one => one.parents)].map(weighed);
  found.level = level;
  found.counts = element('counts').textContent;
  found.loops = await loops();
  found.fault = element('fault').textContent;
  const shown = document.createElement('pre');
  shown.id = 'found';
  shown.textContent = JSON.stringify(found);
  document.body.append(shown);
})();
</script></body>"""


def counted(number, thing):
    return f"{number:,} {thing}" + ("" if number == 1 else "s")


def faults_of(found, frame):
    facts, level = frame.facts, found["level"]
    parts = [counted(facts["atoms"], "atom"), counted(facts["contacts"], "contact"), f"level {level}: ",
             counted(facts["levels"][level]["nodes"], "node"), counted(facts["levels"][level]["edges"], "edge")]
    yield from (f"the page does not tell {part!r}: {found['counts']}" for part in parts if part not in found["counts"])
    if found["sums"] != frame.sums():
        yield f"the page reads other numbers: {found['sums']}, not {frame.sums()}"
    has = {"atoms": True, "contacts": facts["contacts"] > 0, "balls": True, "edges": facts["levels"][level]["edges"] > 0,
           "parents": True, "cell": facts["periods"] != [], "none": False}
    for what, is_there in has.items():
        if (found["pixels"][what] > 200) != is_there or not is_there and found["pixels"][what] > 0:
            yield f"{found['pixels'][what]} pixels are drawn of {what}"
    if found["loops"] != 1:
        yield f"{found['loops']} loops play at once"
    if found["first"] < 1000 or found["fault"]:
        yield f"the first frame has {found['first']} pixels; {found['fault']}"


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    chromium, command, data = sys.argv[1:]
    wrong = 0
    for name, cutoff in RUNS:
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "view.html"
            subprocess.run([command, "replay", pathlib.Path(data) / name, "--cutoff", cutoff, "--frames", ":4", "--view", page, "--quiet"],
                           check=True)
            frames = read_view(page)[1]
            page.write_text(page.read_text(encoding="utf-8").replace("</body>", PROBE), encoding="utf-8")
            text, console = dump(chromium, page.as_uri(), folder, *OPTIONS)
        shown = re.search(r'<pre id="found">(.*?)</pre>', text, re.DOTALL)
        # What the probe itself makes a browser say.
        faults = [line for line in console if "GPU stall due to ReadPixels" not in line]
        if shown:
            found = json.loads(html.unescape(shown[1]))
            print(name, found["counts"], found["pixels"])
            faults += faults_of(found, frames[-1])
        else:
            faults.append("has not been shown to its end")
        print(f"{name}: {len(faults)} faults", *faults, sep="\n  ", flush=True)
        wrong += len(faults)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
