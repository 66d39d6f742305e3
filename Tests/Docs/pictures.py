#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Which pictures of renders are older than what they show: pictures.py ROOT PHYSVIB. Each call of Docs/pictures.txt is made again, without the picture; its event list has to
have the checksum that it had when the picture was drawn. Exit code 1 with the names of those to draw anew (Docs/pictures.sh)."""
import hashlib
import subprocess
import sys
import tempfile
from pathlib import Path

root, physvib = Path(sys.argv[1]), str(Path(sys.argv[2]).resolve())
old, count = [], 0
for line in (root / "Docs/pictures.txt").read_text().split("\n"):
    if not line or line.startswith("#"):
        continue
    picture, checksum, *call = line.split()
    count += 1
    with tempfile.TemporaryDirectory() as folder:
        events = Path(folder) / "events.csv"
        subprocess.run([physvib, *call, "--events", str(events)], check=True, cwd=root, stdout=subprocess.DEVNULL)
        rows = b"".join(row for row in events.read_bytes().splitlines(keepends=True) if not row.startswith(b"#"))
    if not (root / picture).exists():
        old.append(f"{picture}: there is no such file")
    elif hashlib.sha256(rows).hexdigest()[:16] != checksum:
        old.append(f"{picture}: `physvib {' '.join(call)}` makes other impacts now: draw it anew by Docs/pictures.sh")
if old:
    sys.exit("\n".join(old))
print(f"{count} pictures show what the program makes")
