#!/bin/sh
# SPDX-License-Identifier: MIT
# Holds exports of all scenes against MPEG's published JSON Schemas: schema.sh FOLDER_OF_SCHEMAS [BIN_FOLDER].
# Needs python3 with jsonschema (Debian: python3-jsonschema). The schemas are not shipped.
set -eu
[ $# -ge 1 ] || { echo "schema.sh FOLDER_OF_SCHEMAS [BIN_FOLDER]" >&2; exit 2; }
bin=${2:-$(dirname "$0")/../../build/release/bin}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for scene in $("$bin/physvib" scenes | cut -d' ' -f1); do
    "$bin/physvib" export "$scene" --to "$work/$scene.hjif"
done
python3 - "$1" "$work"/*.hjif <<'PYTHON'
import json, pathlib, sys
from jsonschema import Draft4Validator, RefResolver
folder = pathlib.Path(sys.argv[1]).resolve()
schemas = {path.name: json.loads(path.read_text(encoding="utf-8")) for path in folder.glob("MPEG_haptics*.json")}
root = schemas["MPEG_haptics.schema.json"]
validator = Draft4Validator(root, resolver=RefResolver("", root, store=schemas))
faults = 0
for name in sys.argv[2:]:
    for fault in validator.iter_errors(json.loads(pathlib.Path(name).read_text(encoding="utf-8"))):
        faults += 1
        print(f"{name}: {'/'.join(map(str, fault.path))}: {fault.message[:200]}")
print(f"{len(sys.argv) - 2} files, {faults} faults")
sys.exit(1 if faults else 0)
PYTHON
