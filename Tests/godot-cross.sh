#!/bin/sh
# SPDX-License-Identifier: MIT
# The addon for Godot on other systems: Linux arm64 and 64-bit Windows, cross-built; what each library needs of its system,
# what it shows, and its entry called under qemu and Wine. On arm64 also in Godot itself: Debian's, unpacked in FOLDER (0.8 GB), under qemu.
# Needs root, debootstrap and a network.
# Usage: Tests/godot-cross.sh FOLDER
set -eu
mkdir -p "$1"
tree=$(cd "$1" && pwd)
cd "$(dirname "$0")/.."
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_cross_packages debootstrap
if [ ! -e "$tree/usr/bin/godot" ]; then
    debootstrap --arch=arm64 --foreign --variant=minbase --include=godot sid "$tree" >"$tree.log"
    for deb in "$tree"/var/cache/apt/archives/*.deb; do dpkg-deb -x "$deb" "$tree"; done
fi
mkdir -p build/godot
godot=$PWD/build/godot/godot-arm64
printf '#!/bin/sh\nexec qemu-aarch64 -L "%s" "%s/usr/bin/godot" "$@"\n' "$tree" "$tree" >"$godot"
chmod +x "$godot"
Source/Api/Godot/build-addon.sh "$godot" arm64 windows
bin=build/godot/addons/physvib/bin
failed=0

# needs WHAT LIBRARY KNOWN-LIST: the names that LIBRARY needs, all of them known.
needs() {
    printf '%s needs %s\n' "${2##*/}" "$(echo "$1" | xargs)"
    for name in $1; do
        case " $3 " in *" $name "*) ;; *) printf 'WRONG: %s is not of the system\n' "$name" && failed=1 ;; esac
    done
}

for library in "$bin"/linux.arm64/*; do
    needs "$(readelf -d "$library" | sed -n 's/.*NEEDED.*\[\(.*\)\]/\1/p')" "$library" "libphysvib.so.1 libstdc++.so.6 libgcc_s.so.1 libm.so.6 libc.so.6 ld-linux-aarch64.so.1"
    printf '    and the versions %s\n' "$(for kind in GLIBC GLIBCXX; do readelf -V "$library" | grep -o "${kind}_[0-9.]*" | sort -uV | tail -n 1; done | xargs)"
done
for library in "$bin"/windows.x86_64/*; do
    needs "$(x86_64-w64-mingw32-objdump -p "$library" | sed -n 's/.*DLL Name: //p')" "$library" "libphysvib.dll KERNEL32.dll msvcrt.dll SHELL32.dll"
done
# shows LIBRARY NAME...: the entry alone.
shows() {
    library=$1
    shift
    printf '%s shows %d: %s\n' "$library" $# "${1:-}"
    [ "$*" = physvib_godot_init ] || failed=1
}
# shellcheck disable=SC2046 # lists of words
{
    shows libphysvib-godot.dll $(x86_64-w64-mingw32-objdump -p "$bin/windows.x86_64/libphysvib-godot.dll" | sed -n '/Ordinal\/Name Pointer/,/^$/s/.*\] *//p' | tail -n +2)
    for system in arm64 x86_64; do
        shows $system/libphysvib-godot.so $(readelf --dyn-syms -W "$bin/linux.$system/libphysvib-godot.so" | awk '$5 ~ /GLOBAL|WEAK/ && $7 != "UND" { print $8 }')
    done
}

aarch64-linux-gnu-gcc -O1 -Wall Tests/Godot/load.c -o build/godot/load -ldl
x86_64-w64-mingw32-gcc -O1 -Wall Tests/Godot/load.c -o build/godot/load.exe
printf 'arm64: '
qemu-aarch64 -L /usr/aarch64-linux-gnu build/godot/load "$bin/linux.arm64/libphysvib-godot.so" 2>build/godot/said || failed=1
grep -q "expected Godot 4.4 or newer" build/godot/said || failed=1
export WINEDEBUG=-all WINEPREFIX="$PWD/build/windows/wine" WINEDLLOVERRIDES="mscoree=;mshtml="
unset DISPLAY
[ -e "$WINEPREFIX/system.reg" ] || timeout 300 wine wineboot --init >/dev/null 2>&1
trap 'wineserver -k >/dev/null 2>&1 || true' EXIT
printf 'windows: '
wine build/godot/load.exe "$(winepath -w "$bin/windows.x86_64/libphysvib-godot.dll" 2>/dev/null)" 2>build/godot/said || failed=1
grep -q "expected Godot 4.4 or newer" build/godot/said || failed=1

project=build/godot/project
rm -rf "$project"
mkdir -p "$project"
cp -r build/godot/addons Tests/Godot/. "$project"
rm -r "$project/Editor"
export HOME="$PWD/$project"
mkdir "$project/.godot"
echo "res://addons/physvib/physvib.gdextension" >"$project/.godot/extension_list.cfg" # which an import would write, in ten minutes
for space in 2 3; do
    timeout 600 "$godot" --headless --path "$project" -s bounce.gd --fixed-fps 60 -- space=$space hz=60 ball >"$project/out" 2>&1 || failed=1
    sed -n 's/^| /| arm64, /p' "$project/out" | grep . || { cat "$project/out" && failed=1; }
done
exit $failed
