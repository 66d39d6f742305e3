# SPDX-License-Identifier: MIT
# What arm64.sh and windows.sh share: libraries for the other system, the house built on them, tests counted. Sourced.
# They say first: system (whose toolchain is Tests/Cross/$system.cmake), folder (build/$system), run (the words before a program), suffix
# of programs, and roots (where else there are libraries).

# quietly LOG COMMAND...: all of its output if it fails.
quietly() {
    log=$1
    shift
    "$@" >"$log" 2>&1 && return 0
    cat "$log" >&2
    return 1
}

# library FOLDER OPTION...: a library's own CMake, into the prefix, with the options of physvib-same-bits.
library() {
    from=$1
    shift
    name=$(basename "$from")
    say "building $name"
    quietly "$folder/$name.log" cmake -S "$from" -B "$folder/$name" -G Ninja --toolchain "$PWD/Tests/Cross/$system.cmake" -DCMAKE_BUILD_TYPE=Release \
        -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_CXX_FLAGS="-ffp-contract=off -fno-ipa-ra" -DBUILD_SHARED_LIBS=OFF "$@"
    quietly "$folder/$name.log" cmake --build "$folder/$name" -j2 --target install
}

# Box2D, Highway and GoogleTest from Debian's sources; what is headers only is this machine's own.
libraries() {
    prefix=$PWD/$folder/prefix
    [ -e "$prefix/whole" ] && return 0
    mkdir -p "$prefix/include" "$prefix/share/cmake" build/sources
    if [ ! -d build/sources/highway-1.0.3 ]; then
        say "taking sources from Debian"
        from_debian build/sources source box2d highway
    fi
    library "$PWD/build/sources/box2d-2.4.1" -DBOX2D_BUILD_TESTBED=OFF -DBOX2D_BUILD_UNIT_TESTS=OFF
    library "$PWD/build/sources/highway-1.0.3" -DHWY_ENABLE_TESTS=OFF -DHWY_ENABLE_EXAMPLES=OFF -DHWY_ENABLE_CONTRIB=OFF
    library /usr/src/googletest -DBUILD_GMOCK=OFF
    for headers in nlohmann eigen3 CLI; do ln -sfn "/usr/include/$headers" "$prefix/include/$headers"; done
    for package in nlohmann_json CLI11; do ln -sfn "/usr/share/cmake/$package" "$prefix/share/cmake/$package"; done
    ln -sfn /usr/share/eigen3 "$prefix/share/eigen3"
    : >"$prefix/whole"
}

# house OPTION...: the rooms without JUCE, their tests and physvib-render.
house() {
    prefix=$PWD/$folder/prefix
    say "building the rooms without JUCE (log: $folder/house.log)"
    quietly "$folder/house.log" cmake -S . -B "$folder/house" -G Ninja --toolchain "$PWD/Tests/Cross/$system.cmake" -DCMAKE_BUILD_TYPE=Release \
        -DCMAKE_FIND_ROOT_PATH="$prefix${roots:+;$roots}" -DPHYSVIB_HOST=OFF -DPHYSVIB_PICTURES=OFF -DPHYSVIB_FIRMWARE=OFF -DPHYSVIB_INSTALL=OFF -DPHYSVIB_GODOT_HEADER= \
        -DCMAKE_GTEST_DISCOVER_TESTS_DISCOVERY_MODE=PRE_TEST "$@"
    # shellcheck disable=SC2086 # a list of words
    quietly "$folder/house.log" cmake --build "$folder/house" -j2 --target ${targets:-all}
}

# errors FILE.json: the largest error of each instruction set against the closed form, as the tests of Core note them.
errors() {
    grep -o '"error_[a-z0-9]*_[0-9]*_[0-9]*": "[^"]*"' "$1" | sed 's/"error_\([a-z0-9]*\)_.*": "\(.*\)"/\1 \2/' | sort -k1,1 -k2,2gr |
        awk '!seen[$1]++ { print "physvib: " $1 ": worst error against the closed form " $2 }' >&2
}

# tests PROGRAM...: runs each program of tests once, and says how many tests there were.
tests() {
    ran=0
    failed=0
    for room in "$@"; do
        program=$folder/house/bin/physvib-$room-tests$suffix
        # shellcheck disable=SC2086 # a list of words
        timeout 5400 $run "$program" --gtest_brief=1 --gtest_output=json:"$folder/$room.json" ${PHYSVIB_CROSS_FILTER:+--gtest_filter=$PHYSVIB_CROSS_FILTER} >"$folder/$room.txt" 2>"$folder/$room.err" </dev/null || true
        tr -d '\r' <"$folder/$room.txt" >"$folder/$room.log"
        passed=$(sed -n 's/^\[  PASSED  \] \([0-9]*\) test.*/\1/p' "$folder/$room.log")
        wrong=$(grep -c '^\[  FAILED  \].*(' "$folder/$room.log" || true)
        skipped=$(sed -n 's/^\[  SKIPPED \] \([0-9]*\) test.*/\1/p' "$folder/$room.log")
        [ "$room" != engine ] || errors "$folder/$room.json"
        if [ -z "$passed" ]; then # it did not come to its end
            tail -n 5 "$folder/$room.log" "$folder/$room.err" >&2
            wrong=$((wrong + 1))
        fi
        say "$room: ${passed:-0} passed, $wrong failed, ${skipped:-0} skipped"
        grep -B 8 '^\[  FAILED  \].*(' "$folder/$room.log" >&2 || true
        ran=$((ran + ${passed:-0} + wrong))
        failed=$((failed + wrong))
    done
    say "$system: $ran tests run, $((ran - failed)) passed"
    [ "$failed" -eq 0 ]
}

# compare PATH/physvib-render SCENE...: scenes rendered here and there. Says which event lists and which samples are the same bytes, and
# by how much the others differ; these scenes, round worlds, must be the same (Docs/platforms.md says why the others need not be).
compare() {
    here=$1
    shift
    renders=$folder/renders
    mkdir -p "$renders"
    other=$folder/house/bin/physvib-render$suffix
    for scene in marbles fruit-basket shake-the-box driving drawing; do
        for set in scalar best; do
            "$here" $scene --seconds 10 --seed 3 --instructions $set --out "$renders/$scene-$set-here.wav" --events "$renders/$scene-$set-here.csv" >/dev/null
            # shellcheck disable=SC2086 # a list of words
            timeout 300 $run "$other" $scene --seconds 10 --seed 3 --instructions $set --out "$renders/$scene-$set-there.wav" --events "$renders/$scene-$set-there.csv" </dev/null >/dev/null
        done
    done
    python3 Tests/Cross/compare.py "$renders" "$@"
    say "hashes of the same renders on every machine:"
    # shellcheck disable=SC2086 # a list of words
    Tests/Cross/hashes.sh "$other" $run
}
