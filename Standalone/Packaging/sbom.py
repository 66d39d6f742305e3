#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a release holds, as SPDX 2.3: sbom.py RELEASE FOLDER writes it; its files, and the code of others in them (third-party.txt) with the versions of
this machine. sbom.py --needed FILE...: fails if a program or library needs one that the table lacks. sbom.py --licences KIND: prints the licences of others whose
code is in an artefact of that kind. sbom.py --opened FILE...: fails if an artefact lacks ours or one of these."""
import datetime
import gzip
import hashlib
import json
import os
import re
import subprocess
import sys
import tarfile
import zipfile
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


def kind_of(name: str) -> str:
    return next((kind for kind, pattern in KINDS.items() if re.fullmatch(pattern, name)), "")


def is_inside(row: dict, kind: str, is_package: bool = False) -> bool:
    """Its code is in the artefact, not only needed by it."""
    return kind in row["held"].split() and (row["sonames"] == "-" or not is_package and row["name"] in ("Box2D", "Highway", "qr-code-generator"))


def licences(kind: str, *without: str) -> str:
    """Theirs as their packages or sources have them, with each whole text to which they refer. Godot's interface is a header that names its own."""
    texts, common = [], {}
    for row in table:
        if not is_inside(row, kind) or row["package"] == "-" or row["name"] in without:
            continue
        sources = root / "build/web"
        places = [Path("/usr/share/doc", row["package"], "copyright"), *root.glob(f"build/*/usr/share/doc/{row['package']}/copyright"),
                  *sources.glob(f"{row['name'].lower()}*/LICENSE"), *sources.glob(f"{row['name']}/c/qrcodegen.c")]
        text = next((place.read_text().split("*/")[0] for place in places if place.is_file()), None)
        if text is None:
            raise SystemExit(f"{row['name']}: expected its licence in one of {', '.join(map(str, places))}")
        texts.append(f"{row['name']} ({row['licence']})\n\n{text}")
        common |= {name: Path("/usr/share/common-licenses", name).read_text() for name in re.findall(r"/common-licenses/([\w.-]*\w)", text) if name in row["licence"]}
    return f"\n{'=' * 70}\n".join([*texts, *common.values()])


def opened(files: list[str]) -> None:
    """Each has our licence, and names each of the others."""
    lacking = []
    for file in map(Path, files):
        if zipfile.is_zipfile(file):
            with zipfile.ZipFile(file) as archive:
                held = {name: archive.read(name).decode(errors="replace") for name in archive.namelist() if "LICEN" in name or "THIRD" in name}
        else:
            with tarfile.open(file) as archive:
                held = {name: archive.extractfile(name).read().decode(errors="replace") for name in archive.getnames() if "LICEN" in name or "THIRD" in name}
        kind, text = kind_of(file.name), "".join(held.values())
        assert kind, f"{file}: expected an artefact of a release"
        if not any("Permission is hereby granted" in words for name, words in held.items() if name.endswith("LICENSE")):
            lacking.append(f"{file.name}: no licence of ours")
        wanted = [row for row in table if is_inside(row, kind) and row["package"] != "-" and not file.name.startswith("jspsych")]
        lacking += [f"{file.name}: no licence of {row['name']}" for row in wanted if f"{row['name']} ({row['licence']})\n" not in text]
        print(f"{file.name}: {len(wanted)} of others")
    sys.exit("\n".join(lacking) or 0)


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
        kind = kind_of(file.name)
        licence = {"programs": "GPL-3.0-or-later", "plugins": "GPL-3.0-or-later", "": "MIT AND GPL-3.0-or-later"}.get(kind, "MIT")
        add(file.name, release, licence, packageFileName=file.name, checksums=[{"algorithm": "SHA256", "checksumValue": hashlib.sha256(file.read_bytes()).hexdigest()}])
        relations.append(("SPDXRef-DOCUMENT", "DESCRIBES", identified(file.name)))
        for row in table:
            if kind in row["held"].split() and "dbgsym" not in file.name:
                inside = is_inside(row, kind, file.suffix == ".deb")
                linked = "CONTAINS" if inside else "OPTIONAL_DEPENDENCY_OF" if row["sonames"] == "loaded" else "DEPENDS_ON"
                ends = [identified(file.name), identified(row["name"])]
                relations.append((ends.pop(linked.startswith("OPTIONAL")), linked, ends.pop()))
    made = datetime.datetime.fromtimestamp(int(os.environ["SOURCE_DATE_EPOCH"]), datetime.timezone.utc)
    json.dump({"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"physvib-{release}",
               "documentNamespace": f"https://physvib.example.org/spdx/{release}", "creationInfo": {"created": made.strftime("%Y-%m-%dT%H:%M:%SZ"), "creators": ["Tool: sbom.py"]},
               "packages": packages, "relationships": [dict(zip(("spdxElementId", "relationshipType", "relatedSpdxElement"), relation)) for relation in relations]}, sys.stdout, indent=1)


if __name__ == "__main__":
    if sys.argv[1] == "--needed":
        needed(sys.argv[2:])
    if sys.argv[1] == "--opened":
        opened(sys.argv[2:])
    if sys.argv[1] == "--licences":
        sys.exit(print(licences(*sys.argv[2:])))
    write(sys.argv[1], Path(sys.argv[2]))
