# SPDX-License-Identifier: MIT
"""The pictures of contacts in the documentation are as the command draws them now.

    pictures.py DCH FOLDER_OF_PICTURES
"""

import os
import subprocess
import sys
import tempfile

from dch_command import Checks


def main(command, pictures):
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-B", os.path.join(pictures, "draw_contacts.py"), command, folder], check=True)
        drawn = sorted(os.listdir(folder))
        checks.that(drawn == ["contact-map.svg", "contact-separation.svg"], f"drawn: {drawn}")
        for name in drawn:
            with open(os.path.join(folder, name)) as now, open(os.path.join(pictures, name)) as kept:
                checks.that(now.read() == kept.read(), f"docs/images/{name} is not as draw_contacts.py draws it")
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])
