#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# PhysVib-Music applied to a file by hosts that know LV2's core alone: lv2apply and ecasound. Fails unless each of the four
# outputs has the music's low frequencies, and both hosts give the same samples (lv2apply writes 16 bits).
# Usage: apply.sh BUILD_FOLDER; 77: lv2apply or ecasound is not installed (physvib_apply_packages in .ci/packages.sh)
set -eu
plugins=$(realpath "$1")/plugins
for program in lv2apply ecasound python3; do
    command -v $program >/dev/null || { echo "skipped: $program is not installed (Debian packages lilv-utils, ecasound, python3)"; exit 77; }
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir lv2 && ln -s "$plugins/PhysVib-Music.lv2" lv2 # beside no VST3, of which lilv would complain
LV2_PATH=$folder/lv2
export LV2_PATH
python3 - <<'END'
import math, struct, wave
with wave.open("song.wav", "wb") as out:
    out.setparams((2, 2, 48000, 0, "NONE", ""))
    out.writeframes(b"".join(struct.pack("<hh", *[int(16000 * math.sin(2 * math.pi * 80 * n / 48000))] * 2) for n in range(96000)))
END
lv2apply -i song.wav -o lv2apply.wav -c music 0 urn:physvib:plugin:music
# ecasound takes all control ports in their order, outputs too
values=$(lv2info urn:physvib:plugin:music | awk '
    function told() { if (isControl) printf ",%s", symbol == "music" ? 0 : value; isControl = value = 0 }
    /^\tPort/ { told() } /#ControlPort/ { isControl = 1 } /Symbol:/ { symbol = $2 } /Default:/ { value = $2 } END { told() }')
ecasound -q -z:nodb -f:f32_le,4,48000 -o ecasound.wav -f:16,2,48000 -i song.wav "-elv2:urn:physvib:plugin:music$values" >ecasound.log 2>&1 || { cat ecasound.log; exit 1; }
python3 - <<'END'
import struct, sys
def samples(name):
    data = open(name, "rb").read()
    at, kind = 12, None
    while at + 8 <= len(data):
        tag, size = data[at:at + 4], struct.unpack("<I", data[at + 4:at + 8])[0]
        body = data[at + 8:at + 8 + size]
        if tag == b"fmt ":
            form, channels, rate, _, _, bits = struct.unpack("<HHIIHH", body[:16])
            kind = struct.unpack("<H", body[24:26])[0] if form == 0xfffe else form
        if tag == b"data":
            break
        at += 8 + size + size % 2
    if kind == 3:
        flat = struct.unpack("<%df" % (len(body) // 4), body[:len(body) // 4 * 4])
    else:
        width = bits // 8
        flat = [int.from_bytes(body[i:i + width], "little", signed=True) / 2 ** (bits - 1) for i in range(0, len(body) - width + 1, width)]
    return [flat[c::channels] for c in range(channels)]
both = [(name, samples(name)) for name in ("lv2apply.wav", "ecasound.wav")]
for name, found in both:
    peaks = [max(map(abs, c)) for c in found]
    print(name, len(found), "channels,", len(found[0]), "frames, peaks", " ".join("%.3f" % p for p in peaks))
    if len(found) != 4 or min(peaks) < 0.05:
        sys.exit("%s: expected four channels with the music" % name)
worst = max(abs(a - b) for one, other in zip(both[0][1], both[1][1]) for a, b in zip(one, other))
print("the two differ by at most %.7f" % worst)
if worst > 1e-4:
    sys.exit("expected the same samples")
END
