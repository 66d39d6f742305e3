#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a release holds, as SPDX 2.3: sbom.py RELEASE FOLDER writes it; its files, and the code of others in them (third-party.txt) with the versions of
this machine. sbom.py --needed FILE...: fails if a program or library needs one that the table lacks."""
import datetime
import gzip
import hashlib
import json
import os
import re
import subprocess
import sys
from pathlib import Path

root = Path(__file__).parents[2]
table = [dict(zip(("name", "licence", "package", "sonames", "held"), (cell.strip() for cell in line.split("|"))))
         for line in Path(__file__).with_name("third-party.txt").read_text().splitlines() if not line.startswith("#")]
#: Which artefact a file is: the first that fits.
KINDS = {"plugins": r"physvib-plugins.*deb", "live": r"libphysvib-live.*deb", "library": r"(libphysvib|python3).*deb", "programs": r"physvib.*deb", "wheel": r".*whl", "npm": r".*tgz",
         "page": r".*-page.zip", "firmware": r".*-firmware.zip", "windows": r".*-windows-.*", "arm64": r".*-arm64.*", "godot": r".*-godot.zip"}


def needed(files: list[str]) -> None:
    known = {soname for row in table for soname in row["sonames"].split()} | {"libphysvib", "libphysvib-live"}
    lacking = []
    for file in files:
        said = subprocess.run(["readelf", "-d", file], check=True, capture_output=True, text=True).stdout
        found = re.findall(r"NEEDED.*\[(.+?)\.so\b", said)
        assert found, f"{file}: expected a program or a library"
        lacking += [f"{file}: third-party.txt lacks {name}" for name in found if name not in known]
    sys.exit("\n".join(lacking) or 0)


def version_of(package: str) -> str:
    """Of one that is installed, or unpacked in build/."""
    found = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", package], capture_output=True, text=True)
    if found.returncode == 0 and found.stdout:
        return found.stdout
    for log in root.glob(f"build/*/usr/share/doc/{package}/changelog*.gz"):
        return re.search(r"\((.+?)\)", gzip.open(log, "rt").readline())[1]
    return "NOASSERTION"


def identified(name: str) -> str:
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", name)


def write(release: str, folder: Path) -> None:
    packages, relations = [], []

    def add(name: str, version: str, licence: str, **more: object) -> None:
        packages.append({"name": name, "SPDXID": identified(name), "versionInfo": version, "downloadLocation": "NOASSERTION", "licenseConcluded": "NOASSERTION",
                         "licenseDeclared": licence, "copyrightText": "NOASSERTION", "filesAnalyzed": False, **more})

    for row in table:
        version = version_of(row["package"])
        source = {"sourceInfo": f"Debian's package {row['package']}"} if row["package"] != "-" else {}
        add(row["name"], version, row["licence"], **source)
    for file in sorted(folder.iterdir()):
        kind = next((kind for kind, pattern in KINDS.items() if re.fullmatch(pattern, file.name)), "")
        licence = {"programs": "GPL-3.0-or-later", "plugins": "GPL-3.0-or-later", "": "MIT AND GPL-3.0-or-later"}.get(kind, "MIT")
        add(file.name, release, licence, packageFileName=file.name, checksums=[{"algorithm": "SHA256", "checksumValue": hashlib.sha256(file.read_bytes()).hexdigest()}])
        relations.append(("SPDXRef-DOCUMENT", "DESCRIBES", identified(file.name)))
        for row in table:
            if kind in row["held"].split() and "dbgsym" not in file.name:
                inside = row["sonames"] == "-" or (file.suffix != ".deb" and row["name"] in ("Box2D", "Highway", "qr-code-generator"))
                linked = "CONTAINS" if inside else "OPTIONAL_DEPENDENCY_OF" if row["sonames"] == "loaded" else "DEPENDS_ON"
                ends = [identified(file.name), identified(row["name"])]
                relations.append((ends.pop(linked.startswith("OPTIONAL")), linked, ends.pop()))
    made = datetime.datetime.fromtimestamp(int(os.environ["SOURCE_DATE_EPOCH"]), datetime.timezone.utc)
    json.dump({"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"physvib-{release}",
               "documentNamespace": f"https://physvib.example.org/spdx/{release}", "creationInfo": {"created": made.strftime("%Y-%m-%dT%H:%M:%SZ"), "creators": ["Tool: sbom.py"]},
               "packages": packages, "relationships": [dict(zip(("spdxElementId", "relationshipType", "relatedSpdxElement"), relation)) for relation in relations]}, sys.stdout, indent=1)


if sys.argv[1] == "--needed":
    needed(sys.argv[2:])
write(sys.argv[1], Path(sys.argv[2]))
