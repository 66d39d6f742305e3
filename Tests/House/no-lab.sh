#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds what plays without the laboratory, where the headers of Eigen cannot be seen: both C libraries, the plug-in, the
# mixer's model and physvib-render. Prints what each links. Usage, as root (it hides folders from itself alone): no-lab.sh BUILD_FOLDER
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$1"
build=$(cd "$1" && pwd)
if [ "${PHYSVIB_HIDDEN:-}" != yes ]; then
    exec unshare --mount env PHYSVIB_HIDDEN=yes "$0" "$build"
fi
[ ! -d /usr/include/eigen3 ] || mount -t tmpfs none /usr/include/eigen3
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DPHYSVIB_UNITY=ON -DPHYSVIB_LAB=OFF -DPHYSVIB_TESTS=OFF -DPHYSVIB_FIRMWARE=OFF \
    -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON >"$build/log" 2>&1 || { tail -n 20 "$build/log"; exit 1; }
cmake --build "$build" >>"$build/log" 2>&1 || { tail -n 20 "$build/log"; exit 1; }
for target in bin/physvib bin/physvib-mixer; do
    [ ! -e "$build/$target" ] || { echo "expected no $target without the laboratory"; exit 1; }
done
find "$build/lib" "$build/plugins" -name '*.so*' -type f -o -name physvib-render -type f | sort | while read -r module; do
    echo "${module#"$build"/}: $(readelf -d "$module" | sed -n 's/.*NEEDED.*\[\(.*\)\]/\1/p' | tr '\n' ' ')"
done
[ -e "$build/lib/libphysvib-mixer-model.a" ] || { echo "expected lib/libphysvib-mixer-model.a"; exit 1; }
