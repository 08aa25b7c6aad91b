#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Looks at the top pages of the site in headless Chromium.

usage: check_pages.py CHROMIUM SITE; exit status 1 if a page has no title or navigation in sight, lacks a picture that it should
have, is wider than the window, asks for what is not there, or has a fault in a script.
"""
import functools
import html
import http.server
import pathlib
import re
import subprocess
import sys
import tempfile
import threading

# Which of them have a picture, at least.
PAGES = {"docs/site/index": True, "docs/site/lammps": True, "docs/site/openmm": True, "docs/site/python": False, "docs/site/cpp": True,
         "docs/site/replay": False, "docs/theory": True, "docs/site/api/python": False, "docs/site/api/core": False}

# Run at the end of each page; what it finds goes into an element that the dump of the page has.
PROBE = """<script>
addEventListener('load', () => {
  const faults = [];
  const seen = element => element && element.getClientRects().length && element.textContent.trim();
  if (!document.title.trim()) faults.push('no title');
  if (!seen(document.querySelector('h1'))) faults.push('no heading in sight');
  const entries = [...document.querySelectorAll('.wy-menu a.reference')].filter(seen);
  if (entries.length < 10) faults.push(entries.length + ' entries of navigation in sight');
  const pictures = [...document.querySelectorAll('[role=main] img')];
  for (const picture of pictures)
    if (!picture.complete || !picture.naturalWidth || !picture.alt) faults.push('not shown, or without a text: ' + picture.src);
  if (document.documentElement.scrollWidth > innerWidth) faults.push('wider than the window');
  const found = document.createElement('pre');
  found.id = 'found';
  found.textContent = pictures.length + ' pictures; ' + faults.join('; ');
  document.body.append(found);
});
</script></body>"""


class Server(http.server.SimpleHTTPRequestHandler):
    """Pages with the probe; remembers what was not there."""

    missing = []

    def do_GET(self):
        path = pathlib.Path(self.translate_path(self.path))
        if path.suffix != ".html" or not path.is_file():
            super().do_GET()
            return
        page = path.read_text(encoding="utf-8").replace("</body>", PROBE).encode()
        self.send_response(200)
        self.send_header("Content-Type", "text/html; charset=utf-8")
        self.send_header("Content-Length", str(len(page)))
        self.end_headers()
        self.wfile.write(page)

    def send_error(self, code, message=None, explain=None):
        if self.path != "/favicon.ico":  # which a browser asks for by itself
            self.missing.append(f"{self.path}: {code}")
        super().send_error(code, message, explain)

    def log_message(self, *_):
        pass


def dump(chromium, address, folder, *options):
    """The page as Chromium has it after its scripts, and what it has logged."""
    command = [chromium, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--enable-logging=stderr",
               f"--user-data-dir={folder}/profile", "--window-size=1300,1000", "--no-proxy-server", *options, "--dump-dom", address]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=240, check=False)
    if done.returncode != 0:
        sys.exit(f"check_pages: Chromium ends with status {done.returncode}:\n{done.stderr[-2000:]}")
    return done.stdout, [line for line in done.stderr.splitlines() if "CONSOLE" in line]


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Server, directory=sys.argv[2]))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    wrong = 0
    for page, has_picture in PAGES.items():
        with tempfile.TemporaryDirectory() as folder:
            text, faults = dump(sys.argv[1], f"http://127.0.0.1:{server.server_port}/{page}.html", folder)
        found = re.search(r'<pre id="found">(\d+) pictures; (.*?)</pre>', text, re.DOTALL)
        if not found:
            sys.exit(f"check_pages: {page} has not been shown to its end")
        faults += [fault for fault in html.unescape(found[2]).split("; ") if fault] + Server.missing
        Server.missing.clear()
        if has_picture and found[1] == "0":
            faults.append("no picture")
        print(f"{page}: {found[1]} pictures, {len(faults)} faults", *faults, sep="\n  ", flush=True)
        wrong += len(faults)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
