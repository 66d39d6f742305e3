#!/bin/sh
# SPDX-License-Identifier: MIT
# A project by Meson, in C and C++, which has PhysVib as a subproject (wrap) and builds it by its CMake files.
# usage: meson.sh FOLDER   (a new one)
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$1/subprojects"
cd "$1"
git clone --quiet --shared "$root" subprojects/physvib
cp "$root/Tests/Api/drop.c" "$root/Tests/Example/main.cpp" .
cat >meson.build <<'END'
project('felt', 'cpp', 'c', default_options: ['cpp_std=c++20'])
cmake = import('cmake')
options = cmake.subproject_options()
options.add_cmake_defines({'CMAKE_BUILD_TYPE': 'Release', 'PHYSVIB_API': true})
foreach part: ['HOST', 'SESSION', 'LAB', 'RENDER', 'PICTURES', 'FIRMWARE', 'TESTS']
  options.add_cmake_defines({'PHYSVIB_' + part: false})
endforeach
physvib = cmake.subproject('physvib', options: options)
rooms = []
foreach room: ['physics', 'contacts', 'core']
  rooms += physvib.dependency('physvib-' + room)
endforeach
executable('drop', 'drop.c', dependencies: physvib.dependency('physvib-c'))
executable('example', 'main.cpp', dependencies: rooms)
END
meson setup build
ninja -C build drop example
build/drop | grep "hits, the first at 0.4038 s"
build/example | grep "events, 0 late"
