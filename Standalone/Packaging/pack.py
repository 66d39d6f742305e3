#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Packs a folder: pack.py FOLDER FILE.tar.gz|FILE.zip. The same files give the same bytes, whoever packs them, when and where: times are
SOURCE_DATE_EPOCH's."""
import gzip
import os
import sys
import tarfile
import time
import zipfile
from pathlib import Path

folder, packed = Path(sys.argv[1]), Path(sys.argv[2])
epoch = int(os.environ["SOURCE_DATE_EPOCH"])
files = sorted((path for path in folder.rglob("*") if path.is_symlink() or path.is_file()), key=lambda path: path.as_posix())


def modes(path: Path) -> int:
    return 0o755 if path.stat().st_mode & 0o100 else 0o644


if packed.suffix == ".zip":  # a link becomes what it leads to
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in files:
            entry = zipfile.ZipInfo(path.relative_to(folder.parent).as_posix(), time.gmtime(epoch)[:6])
            entry.external_attr = (0o100000 | modes(path)) << 16
            entry.create_system = 3
            archive.writestr(entry, path.read_bytes(), zipfile.ZIP_DEFLATED)
else:
    with packed.open("wb") as out, gzip.GzipFile("", "wb", 9, out, mtime=0) as zipped, tarfile.open(fileobj=zipped, mode="w", format=tarfile.GNU_FORMAT) as archive:
        for path in files:
            entry = archive.gettarinfo(str(path), path.relative_to(folder.parent).as_posix())
            entry.mtime, entry.uid, entry.gid, entry.uname, entry.gname = epoch, 0, 0, "root", "root"
            entry.mode = 0o777 if entry.issym() else modes(path)
            with path.open("rb") as data:
                archive.addfile(entry, None if entry.issym() else data)
