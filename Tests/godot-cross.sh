#!/bin/sh
# SPDX-License-Identifier: MIT
# The addon for Godot on other systems: Linux arm64 and 64-bit Windows, cross-built; what each library needs of its system,
# what it shows, and its entry called under qemu and Wine. Takes a header of Godot (Tests/godot.sh leaves FOLDER/physvib).
# Usage: Tests/godot-cross.sh HEADER-FOLDER
set -eu
header=$(cd "$1" && pwd)/gdextension_interface.h
cd "$(dirname "$0")/.."
mkdir -p build/godot
godot=build/godot/header-of-godot
printf '#!/bin/sh\ncp "%s" .\n' "$header" >$godot
chmod +x $godot
Source/Api/Godot/build-addon.sh $godot arm64 windows
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
    needs "$(readelf -d "$library" | sed -n 's/.*NEEDED.*\[\(.*\)\]/\1/p')" "$library" "libphysvib.so.0 libstdc++.so.6 libgcc_s.so.1 libm.so.6 libc.so.6 ld-linux-aarch64.so.1"
    printf '    and the versions %s\n' "$(for kind in GLIBC GLIBCXX; do readelf -V "$library" | grep -o "${kind}_[0-9.]*" | sort -uV | tail -n 1; done | xargs)"
done
for library in "$bin"/windows.x86_64/*; do
    needs "$(x86_64-w64-mingw32-objdump -p "$library" | sed -n 's/.*DLL Name: //p')" "$library" "libphysvib.dll KERNEL32.dll msvcrt.dll SHELL32.dll"
done
shown=$(x86_64-w64-mingw32-objdump -p "$bin/windows.x86_64/libphysvib-godot.dll" | sed -n '/Ordinal\/Name Pointer/,/^$/s/.*\] *//p' | tail -n +2 | xargs)
printf 'libphysvib-godot.dll shows: %s\n' "$shown"
[ "$shown" = physvib_godot_init ] || failed=1
shown=$(readelf --dyn-syms -W "$bin/linux.arm64/libphysvib-godot.so" | awk '$5 == "GLOBAL" && $7 != "UND" { print $8 }' | xargs)
printf 'libphysvib-godot.so shows: %s\n' "$shown"
[ "$shown" = physvib_godot_init ] || failed=1

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
exit $failed
