# SPDX-License-Identifier: MIT
# What godot.sh and godot-sanitized.sh share: a tree of Debian's unstable with Godot, and the addon of a build in a project within it. Sourced.
# They say first: root (this repository), build, and tree (a folder).
project=$tree/physvib

make_tree() {
    [ ! -x "$tree/usr/bin/godot-template-release" ] || return 0
    [ -x "$tree/usr/bin/apt-get" ] || debootstrap --variant=minbase sid "$tree" >"$tree.log"
    chroot "$tree" apt-get install -y --no-install-recommends godot godot-template-release xvfb xauth libgl1-mesa-dri jackd2 >>"$tree.log"
}

# within FOLDER COMMAND...: in a folder of the tree, which has a /proc meanwhile.
within() {
    # shellcheck disable=SC2016 # for the inner shells
    unshare -m sh -c 'mount -t proc proc "$1/proc" && shift 1 && exec chroot "$@"' sh "$tree" "$tree" env HOME="/$1" LD_LIBRARY_PATH="/$1/libraries" \
        sh -c 'cd "$HOME" && shift && exec timeout 600 "$@"' sh "$@"
}
godot() { within physvib godot --headless "$@"; }

# fill_project TARGET...: builds the addon, and these, and begins the project with it.
fill_project() {
    rm -rf "$project"
    mkdir -p "$project/libraries" "$project/pictures"
    godot --dump-gdextension-interface >"$project/log"
    trap 'cmake -UPHYSVIB_GODOT_HEADER "$build" >/dev/null' EXIT # who builds next wants no header of this tree
    cmake -DPHYSVIB_GODOT_HEADER="$project" "$build" >>"$project/log"
    cmake --build "$build" --target physvib-godot "$@" >>"$project/log" || { cat "$project/log" && exit 1; }
    cp -r "$build/godot/addons" "$root"/Tests/Godot/. "$project"
    rm -r "$project/Editor"
    # What this Debian has in other versions than the tree: beside it, as a game would bring it.
    ldd "$build"/godot/addons/physvib/bin/linux.x86_64/* | sed -n 's/.*=> \(\/[^ ]*\) .*/\1/p' | sort -u | while read -r library; do
        [ -e "$tree/usr/lib/x86_64-linux-gnu/${library##*/}" ] || cp -L "$library" "$project/libraries"
    done
    rm -f "$project"/libraries/libphysvib* "$project"/libraries/libhwy.so*
}
