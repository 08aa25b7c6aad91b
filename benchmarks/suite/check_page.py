#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Opens a report in headless Chromium, and sees that it is shown without errors and its plots without overlaps.

usage: check_page.py CHROMIUM PAGE; exit status 1 if Chromium complains, a link leads nowhere, a drawing is empty, or words of a
drawing overlap or stand outside of it.
"""

import os
import re
import subprocess
import sys
import tempfile

# Run at the end of a copy of the page; what it finds goes into an element that the dump of the page has.
PROBE = """<script>
const faults = [];
const apart = (a, b) => a.right <= b.left + 1 || b.right <= a.left + 1 || a.bottom <= b.top + 3 || b.bottom <= a.top + 3;
const drawings = [...document.querySelectorAll('svg')];
for (const drawing of drawings) {
  const words = [...drawing.querySelectorAll('text')].filter(word => word.textContent);
  if (!words.length) faults.push('a drawing without words');
  const frame = drawing.getBoundingClientRect();
  const boxes = words.map(word => word.getBoundingClientRect());
  boxes.forEach((box, k) => {
    if (box.left < frame.left || box.right > frame.right || box.top < frame.top || box.bottom > frame.bottom)
      faults.push('outside of its drawing: ' + words[k].textContent);
    for (let other = 0; other < k; ++other)
      if (!apart(box, boxes[other])) faults.push('overlap: ' + words[other].textContent + ' | ' + words[k].textContent);
  });
}
for (const link of document.querySelectorAll('a[href^="#"]'))
  if (!document.getElementById(link.getAttribute('href').slice(1))) faults.push('no target: ' + link.getAttribute('href'));
const found = document.createElement('pre');
found.id = 'found';
found.textContent = drawings.length + ' drawings; ' + faults.join('; ');
document.body.append(found);
</script>"""


def dump(chromium, page, folder):
    """The page as Chromium has it after its scripts, and what it has logged."""
    command = [chromium, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--enable-logging=stderr",
               f"--user-data-dir={folder}/profile", "--window-size=1300,2000", "--dump-dom", f"file://{page}"]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=240, check=False)
    if done.returncode != 0:
        sys.exit(f"check_page: Chromium ends with status {done.returncode}:\n{done.stderr[-2000:]}")
    return done.stdout, done.stderr


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    chromium, page = sys.argv[1], os.path.abspath(sys.argv[2])
    with tempfile.TemporaryDirectory() as folder:
        probed = os.path.join(folder, "page.html")
        with open(page, encoding="utf-8") as source, open(probed, "w", encoding="utf-8") as copy:
            copy.write(source.read().replace("</body>", PROBE + "</body>"))
        text, log = dump(chromium, probed, folder)
    complaints = [line for line in log.splitlines() if "CONSOLE" in line]
    found = re.search(r"<pre id=\"found\">(\d+) drawings; (.*?)</pre>", text, re.DOTALL)
    if not found:
        sys.exit(f"check_page: {page} has not been shown to its end")
    faults = complaints + [fault for fault in found.group(2).split("; ") if fault]
    print(f"{page}: {found.group(1)} drawings, {len(faults)} faults", *faults, sep="\n  ")
    return 1 if faults or found.group(1) == "0" else 0


if __name__ == "__main__":
    sys.exit(main())
