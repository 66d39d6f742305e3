#!/bin/sh
# SPDX-License-Identifier: MIT
# Prints the table of Docs/methods.md: peak and root mean square of ten seconds of box-study by each method, in g of one actuator of 2 g.
# Usage: methods.sh PHYSVIB
set -eu
physvib=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
echo '| method | peak, g | root mean square, g |'
echo '| --- | --- | --- |'
for method in AV-FV-DRV AV-FV-DRF AV-FF-DRV AV-FF-DRF AF-FV-DRV AF-FV-DRF AF-FF-DRV AF-FF-DRF; do
    "$physvib" render box-study --layout study1 --method $method --seconds 10 --out "$folder/it.wav" >"$folder/report"
    /usr/bin/python3 - "$folder/it.wav" $method <<'END'
import math, struct, sys
data = open(sys.argv[1], "rb").read()
at = data.index(b"data")  # 32-bit floats, one channel
count = struct.unpack("<I", data[at + 4:at + 8])[0] // 4
samples = struct.unpack(f"<{count}f", data[at + 8:at + 8 + 4 * count])
print(f"| `{sys.argv[2]}` | {2 * max(map(abs, samples)):.3f} | {2 * math.sqrt(math.fsum(s * s for s in samples) / count):.4f} |")
END
done
