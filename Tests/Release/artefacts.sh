#!/bin/sh
# SPDX-License-Identifier: MIT
# Each file of a release beside the packages (bare-debian.sh), as who downloads it: taken out of its archive, installed cold, and its first example run.
# Source, wheel and npm package in a bare Debian 12, with no network from there on; what is for other systems under Wine, qemu and rp2040js,
# on this machine. Needs root, a network, Node 20.16 or newer, and what those take.
# usage: artefacts.sh RELEASE [--godot FOLDER (of Tests/godot.sh)] [--cache FOLDER (a compiler cache)] [--mirror URL]
# shellcheck disable=SC2016 # the machine's own shell expands what it is told
set -eu
cd "$(dirname "$0")/../.."
. .ci/packages.sh
. Tests/bare-machine.sh
release=$(realpath "${1:?"expected the folder of a release"}") godot="" cache="" mirror="" keep=""
shift
while [ $# -gt 0 ]; do
    case $1 in
        --godot) godot=$(realpath "${2:?"--godot needs a folder"}") && shift ;;
        --cache) cache=$(realpath "${2:?"--cache needs a folder"}") && shift ;;
        --mirror) mirror=${2:?"--mirror needs a URL"} && shift ;;
        *) say "expected --godot FOLDER, --cache FOLDER or --mirror URL, not $1" && exit 2 ;;
    esac
    shift
done
# shellcheck disable=SC2086 # a list of words
ensure_packages debootstrap $physvib_cross_packages
step() { echo "artefacts: $*"; }
(cd "$release" && sha256sum --quiet -c SHA256SUMS)
python3 Standalone/Packaging/sbom.py --opened "$release"/*.whl "$release"/*.tgz "$release"/*-page.zip "$release"/*-firmware.zip "$release"/*-windows-*.zip "$release"/*-arm64.tar.gz "$release"/*-godot.zip
base=$(echo "$release"/physvib-*.changes.md)
base=${base%.changes.md}

tried="artefacts"
make_machine "$mirror"
work=$machine/root
cp "$base.tar.gz" "$work/source.tar.gz"
cp "$release"/physvib-*.tgz "$release"/*.whl "$work"
there() { in_machine unshare --net sh -euc "cd /root && $1" >"$machine.log" 2>&1 || { tail -n 20 "$machine.log" && exit 1; }; }
# shellcheck disable=SC2086 # a list of words
in_machine sh -c "apt-get update && DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
    python3-venv python3-numpy git $physvib_first_packages" >"$machine.log" 2>&1 || { tail "$machine.log" && exit 1; }

there 'mkdir source && tar -xzf source.tar.gz -C source --strip-components 1
    cd source && ./run.sh && test -s out/shake-the-box.wav && test -s out/shake-the-box.png'
step "source: run.sh without a network renders a scene"
render="$work/source/build/first/bin/physvib-render"

there 'python3 -m venv --system-site-packages venv && venv/bin/pip install --no-index --no-deps physvib-*.whl
    venv/bin/python source/Tests/Api/drop.py && test -s drop.wav'
step "wheel: $(tail -n 1 "$machine.log")"

cp "$(readlink -f "$(command -v node)")" "$machine/usr/bin/node" # this machine's: Debian 12's is older than the package takes
there 'mkdir -p node_modules/physvib && tar -xzf physvib-*.tgz -C node_modules/physvib --strip-components 1
    echo "import { load } from \"physvib\";
        const physvib = await load();
        const strike = { timeNs: 0, x: 4, y: 3, amplitude: 0.5, frequencyHz: 200, decayPerSecond: 30 };
        const channels = physvib.render([strike], { seconds: 1, layout: \"phone4\", fieldWidth: 8, fieldHeight: 6 });
        console.log(channels.length, \"channels, peak\", Math.max(...channels[0].map(Math.abs)).toFixed(3));" >strike.mjs
    node --version && node strike.mjs'
step "npm: $(tail -n 1 "$machine.log"), Node $(sed -n '/^v/p' "$machine.log")"

# The page and the pages: every file that one of them names is there.
mkdir "$work/page" "$work/pages"
python3 -m zipfile -e "$base-page.zip" "$work/page"
tar -xzf "$base-documentation.tar.gz" -C "$work/pages"
python3 - "$work/page" "$work/pages" <<'END'
import pathlib, re, sys, urllib.parse
missing, named, pages = [], 0, 0
for folder in map(pathlib.Path, sys.argv[1:]):
    for page in folder.rglob("*.html"):
        pages += 1
        for link in re.findall(r'(?:href|src)="([^"#?:]+)["#?]', page.read_text()):
            named += 1
            if not (page.parent / urllib.parse.unquote(link)).exists():
                missing.append(f"{page.name}: {link}")
sys.exit("\n".join(missing) or print(f"artefacts: {pages} pages name {named} files, which are all there"))
END

# Other systems: the same bytes as from source, of a scene where they must be (Docs/platforms.md).
"$render" fruit-basket --seconds 10 --seed 3 --instructions scalar --out "$work/here.wav" --events "$work/here.csv" >/dev/null
for system in windows arm64; do
    mkdir "$work/$system"
    case $system in
        windows)
            python3 -m zipfile -e "$base-windows-x86_64.zip" "$work/$system"
            export WINEDEBUG=-all WINEPREFIX="$work/wine" WINEDLLOVERRIDES="mscoree=;mshtml="
            set -- env -u DISPLAY wine ;;
        arm64)
            tar -xzf "$base-linux-arm64.tar.gz" -C "$work/$system"
            set -- qemu-aarch64 -L /usr/aarch64-linux-gnu ;;
    esac
    program=$(find "$work/$system" -name 'physvib-render*' -type f)
    (cd "$work" && timeout 600 "$@" "$program" fruit-basket --seconds 10 --seed 3 --instructions scalar --out there.wav --events there.csv </dev/null >"$machine.log" 2>&1) ||
        { tail "$machine.log" && exit 1; }
    [ $system != windows ] || wineserver -k || true
    tr -d '\r' <"$work/there.csv" >"$work/there.lf"
    cmp "$work/here.wav" "$work/there.wav"
    step "$system: fruit-basket, $(wc -c <"$work/there.wav") bytes, as from source; events $(cmp -s "$work/here.csv" "$work/there.lf" && echo the same || echo others)"
done

# The Pico's files: what is dropped onto a board is what the emulator plays.
python3 -m zipfile -e "$base-firmware.zip" "$work"
python3 - "$work/physvib-firmware" <<'END'
import pathlib, struct, sys
for uf2 in sorted(pathlib.Path(sys.argv[1]).glob("*.uf2")):
    data = uf2.read_bytes()
    blocks = [struct.unpack_from("<8I476s", data, at) for at in range(0, len(data), 512)]
    begin = min(block[3] for block in blocks if block[3] & 0xf0000000 == 0x10000000)
    flash = bytearray()
    for block in sorted((b for b in blocks if b[3] >= begin and not b[2] & 1), key=lambda b: b[3]):
        flash[block[3] - begin:] = block[8][:block[4]]
    image = uf2.with_suffix(".bin").read_bytes()
    if bytes(flash[:len(image)]) != image:
        sys.exit(f"{uf2.name}: other bytes than its .bin")
    print(f"artefacts: {uf2.name}: {len(blocks)} blocks, its .bin")
END
for channels in 4 8; do ln -s "physvib-pico-$channels-channels.bin" "$work/physvib-firmware/physvib-pico$channels.bin"; done
IMAGES=$work/physvib-firmware RENDER=$render Tests/Firmware/pico.sh 2

[ -z "$godot" ] || {
    rm -rf "$godot/downloaded" && mkdir "$godot/downloaded"
    python3 -m zipfile -e "$base-godot.zip" "$godot/downloaded"
    root=$PWD build="" tree=$godot
    . Tests/Godot/tree.sh
    project=$godot/downloaded
    cp Tests/Godot/project.godot Tests/Godot/bounce.gd "$project"
    within downloaded godot --headless --import --frame-delay 1000 >"$machine.log" 2>&1
    within downloaded godot --headless -s bounce.gd --fixed-fps 60 -- space=2 hz=60 ball >"$machine.log" 2>&1 || { tail "$machine.log" && exit 1; }
    step "Godot: $(grep '^| ' "$machine.log")"
}
