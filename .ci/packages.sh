# SPDX-License-Identifier: MIT
# What PhysVib needs from Debian, and how it gets there. Sourced by run.sh and test.sh.

# Packages that are not in each of Debian 12, 13 and sid by one name: the lists below have the first. The first that is installed, or that apt
# knows, is taken; "-": done without, and Tests/House/skips.txt says what is not tested then (jackd2 of Debian 12 has its example tools in it).
physvib_other_names="
clang-format-14 | -
clang-tidy-14 | clang-tidy
jack-example-tools | -
libnewlib-arm-none-eabi | picolibc-arm-none-eabi
libstdc++-arm-none-eabi-newlib | libstdc++-arm-none-eabi
mono-mcs | mono-devel
libasound2 | libasound2t64
libssl3 | libssl3t64"

# What the first picture is made with: physvib-render, and nothing else (preset "first"; Tests/House/first-build.sh
# holds its size). A compiler cache that came later would change every rule, and compile all of it again.
physvib_first_packages="g++ cmake ninja-build libbox2d-dev nlohmann-json3-dev libcli11-dev libhwy-dev libfreetype-dev libpng-dev fonts-dejavu-core ccache"
# What the programs, the library and the plug-ins are made with, beside a compiler.
physvib_build_packages="cmake ninja-build juce-modules-source libbox2d-dev nlohmann-json3-dev libcli11-dev libhwy-dev libeigen3-dev \
    pkg-config libfreetype-dev libpng-dev libasound2-dev libjack-jackd2-dev libserialport-dev libsamplerate0-dev libsndfile1-dev liblo-dev libaubio-dev libsdl2-dev libwebp-dev libqrcodegen-dev"
# Configuring covers the tests as well, so the mixer that run.sh opens needs their libraries too.
physvib_run_packages="$physvib_build_packages g++ ccache fonts-dejavu-core libgtest-dev libbenchmark-dev"
# Of the four-channel board's image and its virtual board.
physvib_board_packages="gcc-arm-none-eabi libnewlib-arm-none-eabi libstdc++-arm-none-eabi-newlib libunicorn-dev libcapstone-dev"
physvib_test_packages="$physvib_run_packages locales fonts-nanum jackd2 jack-example-tools xvfb xauth xdotool zbar-tools clang libclang-rt-dev clang-format-14 \
    liblo-tools python3-numpy python3-pandas r-base-core luajit doxygen cmark-gfm \
    $physvib_board_packages"
# Of .ci/pico-sources.sh alone, and of Tests/Firmware/pico.sh.
physvib_pico_packages="cmake ninja-build gcc-arm-none-eabi libnewlib-arm-none-eabi libstdc++-arm-none-eabi-newlib python3"
physvib_pico_test_packages="nodejs npm" # where they are not there from elsewhere
# Of Tests/Firmware/pico-linux.sh alone; and what its machine in QEMU has, beside a kernel.
physvib_pico_linux_packages="qemu-system-x86 cpio kmod g++ python3"
physvib_pico_linux_guest="busybox-static kmod usbip alsa-utils usbutils usb.ids libc6 libudev1 libusb-1.0-0 libasound2 libasound2-data libzstd1 liblzma5 libssl3"
# Of tests with the label engines alone: physics engines and languages of others (Tests/passed.sh says when).
physvib_engine_packages="nodejs love mono-mcs libchipmunk-dev libbullet-dev libode-dev libmujoco-dev"
# Of Standalone/Web/build-web.sh, Source/Api/JavaScript/build-package.sh, Tests/web.sh and Tests/javascript.sh alone.
physvib_web_packages="binaryen clang-19 lld-19 libc++-19-dev-wasm32 libc++abi-19-dev-wasm32 libclang-rt-19-dev-wasm32 wasi-libc cmake ninja-build nlohmann-json3-dev dpkg-dev python3"
physvib_web_test_packages="$physvib_web_packages chromium zbar-tools"
# Of Tests/JavaScript/bundlers.sh, browsers.sh and outputs.sh alone; WebKitGTK brings its MiniBrowser. What the latter two unpack, and never install.
physvib_browser_packages="chromium firefox-esr libwebkit2gtk-4.1-0 gstreamer1.0-plugins-good xvfb xauth"
physvib_sound_files="pulseaudio pulseaudio-utils liborc-0.4-0 libtdb1 libwrap0 libltdl7 libspeexdsp1 libsoxr0"
# Of Standalone/Packaging/release.sh, and of Tests/Release.
physvib_release_packages="$physvib_build_packages libgtest-dev g++ git debhelper dh-python python3 dpkg-dev"
physvib_release_test_packages="$physvib_release_packages lintian piuparts debootstrap desktop-file-utils appstream"
# Of Tests/Release/abi.sh alone, and of Tests/House/tidy.sh.
physvib_abi_packages="abigail-tools python3"
physvib_tidy_packages="$physvib_test_packages $physvib_engine_packages clang-tidy-14"
# Of Tests/CommandLine/movies.sh alone: what makes .gif and .mp4 of pictures.
physvib_movie_packages="ffmpeg"
# Of Tests/Studies/screens.sh alone: windows with title bars, and pictures of them.
physvib_screens_packages="xvfb xauth xdotool openbox ffmpeg python3"
# Of Tests/Plugin/Formats/ardour.sh and ardour-song.sh alone, and of validate.sh there.
physvib_host_packages="ardour jackd2 jack-example-tools"
# Of Tests/Plugin/Formats/apply.sh alone.
physvib_apply_packages="lilv-utils ecasound python3"
# Of Tests/Plugin/Formats/Daws/daws.sh alone.
physvib_daw_packages="qtractor muse openbox xdotool imagemagick xvfb jackd2 lv2-dev libasound2-dev libqt5svg5 sndfile-programs gcc python3-numpy"
physvib_validator_packages="lv2-dev sordi"
# Of the library alone (preset "library"), for Tests/Benchmarks.
physvib_library_packages="g++ cmake ninja-build nlohmann-json3-dev libbox2d-dev libhwy-dev"
# Of Tests/Osc/run.sh alone.
physvib_osc_packages="jackd2 jack-example-tools liblo-tools puredata-core python3"
# Of Tests/arm64.sh and Tests/windows.sh alone: compilers, what runs their programs, libraries that are headers only.
physvib_cross_packages="g++-aarch64-linux-gnu qemu-user g++-mingw-w64-x86-64-posix wine64 wine cmake ninja-build ccache dpkg-dev \
    googletest nlohmann-json3-dev libcli11-dev libeigen3-dev pkg-config python3"
# Of Docs/Site/build-site.sh alone, and of Tests/site.sh.
physvib_site_packages="cmark-gfm doxygen python3"
physvib_site_test_packages="$physvib_site_packages chromium"
# Of Tests/Sweep/sweeps.sh alone.
physvib_sweep_packages="snakemake python3-numpy slurm-wlm munge"

say() { printf 'physvib: %s\n' "$*" >&2; }

is_installed() { [ "$(dpkg-query -W -f='${db:Status-Abbrev}' "$1" 2>/dev/null)" = "ii " ]; }

as_root() { if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi; }

# may_install: whether as_root will work. Asks for a password here, where it is seen and asked for once; says what to do if it will not.
may_install() {
    [ "$(id -u)" -ne 0 ] || return 0
    if command -v sudo >/dev/null 2>&1; then
        sudo -n true 2>/dev/null && return 0
        say "sudo, which installs them, asks for your password"
        sudo -v && return 0
    fi
    say "this user cannot install packages. Type this as root (su -), then the same command here again:"
    printf '  apt-get update && apt-get install --no-install-recommends%s\n' "$1" >&2
    return 1
}

apt_install() { as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@"; }

# spelled NAME: it, and what it is called elsewhere.
spelled() { printf '%s\n' "$physvib_other_names" | awk -v name="$1" 'BEGIN { printf "%s", name } $1 == name { for (i = 3; i <= NF; i += 2) printf " %s", $i }'; }

# known NAME...: those that apt can install here.
known() { LC_ALL=C apt-cache policy "$@" | awk '/^[^ ]/ { name = substr($1, 1, length($1) - 1) } /^  Candidate: [^(]/ { print name }'; }

# called NAME...: what these packages are called here; one that is not to be had comes with a "?" before it.
called() {
    # shellcheck disable=SC2046 # a list of words
    there=$(known $(for name in "$@"; do spelled "$name" && echo; done))
    for name in "$@"; do
        for other in $(spelled "$name"); do
            [ "$other" = - ] && continue 2
            printf '%s\n' "$there" | grep -xF -e "$other" && continue 2
        done
        echo "?$name"
    done
}

# here NAME...: as called, of those that are not installed: in $names, and what is not to be had in $unknown.
here() {
    names="" unknown="" asked=""
    for name in "$@"; do
        for other in $(spelled "$name"); do is_installed "$other" && continue 2; done
        asked="$asked $name"
    done
    # shellcheck disable=SC2046,SC2086 # lists of words
    [ -z "$asked" ] || for name in $(called $asked); do
        case $name in "?"*) unknown="$unknown ${name#?}" ;; *) names="$names $name" ;; esac
    done
}

# without_apt NAME...: what holds the same elsewhere, and the ways on.
without_apt() {
    say "this is not a Debian system. Please install what these hold (names of others are untried; Box2D has to be 2.4):"
    awk -F ' *[|] *' -v wanted=" Debian $* " 'index(wanted, " " $1 " ") { printf "  %-22s %-42s %-16s %s\n", $1, $2, $3, $4 }' .ci/other-systems.txt >&2
    say "then type: PHYSVIB_INSTALLED=yes $0. Or use a container, with these two lines (docker does it too):"
    # shellcheck disable=SC2016 # of the reader's shell
    printf '  podman run -it -v "$PWD:/physvib:z" -w /physvib docker.io/debian:13\n  %s\n' "$0" >&2
}

# ensure_packages NAME...: installs those that are missing; silent if none is. What cannot be had is told before anything is installed.
ensure_packages() {
    [ -z "${PHYSVIB_INSTALLED:-}" ] || return 0
    command -v apt-get >/dev/null 2>&1 || { without_apt "$@" && return 1; }
    here "$@"
    [ -n "$names$unknown" ] || return 0
    say "to be installed:$names$unknown"
    may_install "$names$unknown" || return 1
    log=$(mktemp)
    # A list of packages that is old or absent is the usual reason for a first failure.
    # shellcheck disable=SC2086 # lists of words
    if ! { { [ -z "$unknown" ] && apt_install $names; } || { as_root apt-get update -qq && here "$@" && [ -z "$unknown" ] && apt_install $names; }; } >"$log" 2>&1; then
        tail -n 5 "$log" >&2
        rm -f "$log"
        for name in $unknown; do say "apt knows no package $(spelled "$name" | sed 's/ / or /g') here"; done
        [ -n "$unknown" ] || for name in $names; do is_installed "$name" || say "could not install the package $name"; done
        return 1
    fi
    rm -f "$log"
}

# from_debian FOLDER source|download PACKAGE...: apt checks them against Debian's signatures. The lists, for the processor that
# PHYSVIB_ARCHITECTURE names or this one, of bookworm or the suite that PHYSVIB_SUITE names, are its own: the machine's stay as they are.
from_debian() (
    into=$1
    shift
    fetched=$(mktemp -d)
    trap 'rm -rf "$fetched"' EXIT
    mkdir -p "$fetched/lists/partial"
    [ "$1" = source ] && kind=deb-src || kind=deb
    echo "$kind [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian ${PHYSVIB_SUITE:-bookworm} main" >"$fetched/sources.list"
    architecture=${PHYSVIB_ARCHITECTURE:-$(dpkg --print-architecture)}
    from="-q -q -o Dir::Etc::sourcelist=$fetched/sources.list -o Dir::Etc::sourceparts=/dev/null -o Dir::State::lists=$fetched/lists
        -o Dir::Cache=$fetched -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache= -o APT::Sandbox::User=
        -o APT::Architecture=$architecture -o APT::Architectures=$architecture"
    cd "$into"
    # shellcheck disable=SC2086 # a list of words
    { apt-get $from update && apt-get $from "$@"; } >"$fetched/log" 2>&1 || { cat "$fetched/log" >&2; exit 1; }
)

# What JUCE's sources are compiled with here. Their package also wants a web browser's library and GTK, 184 packages that our build does not use.
juce_needs="libx11-dev libxext-dev libxinerama-dev libxrandr-dev libxcursor-dev libxrender-dev libjpeg-dev zlib1g-dev fontconfig-config"
juce_folder=$PWD/build/juce # where Source/Host/CMakeLists.txt finds it

# unpack_juce: puts JUCE's sources there without installing them. Its build files name the paths of an installed one: here those of whatever copy
# of this repository reads them.
unpack_juce() {
    unpacked=$juce_folder.new
    rm -rf "$unpacked" && mkdir -p "$unpacked" || return 1
    from_debian "$unpacked" download juce-modules-source juce-modules-source-data || return 1
    for archive in "$unpacked"/*.deb; do dpkg-deb -x "$archive" "$unpacked" || return 1; done
    rm "$unpacked"/*.deb
    # shellcheck disable=SC2016 # CMake's own variable
    find "$unpacked/usr/lib" -name '*.cmake' -exec sed -i 's|"/usr/|"${PROJECT_SOURCE_DIR}/build/juce/usr/|' {} + || return 1
    rm -rf "$juce_folder" && mv "$unpacked" "$juce_folder"
}

# unpack_pico: puts the Pico's SDK and TinyUSB in build/pico, where Firmware/CMakeLists.txt finds them. Debian has them from trixie on; they are
# sources alone, which bookworm's compiler takes.
unpack_pico() {
    unpacked=$PWD/build/pico.new
    rm -rf "$unpacked" && mkdir -p "$unpacked" || return 1
    PHYSVIB_SUITE=trixie from_debian "$unpacked" download pico-sdk-source tinyusb-source || return 1
    for archive in "$unpacked"/*.deb; do dpkg-deb -x "$archive" "$unpacked" || return 1; done
    rm "$unpacked"/*.deb
    rm -rf build/pico && mv "$unpacked" build/pico
}

# with_juce_unpacked NAME...: the packages that are then to be installed.
with_juce_unpacked() { printf '%s\n' "$@" | grep -vx juce-modules-source && echo "$juce_needs"; }

# ensure_build_packages NAME...: as ensure_packages, but JUCE's sources are unpacked where they are not installed, if that works.
ensure_build_packages() {
    if is_installed juce-modules-source; then
        ensure_packages "$@"
    elif [ -d "$juce_folder" ] || { command -v apt-get >/dev/null 2>&1 && say "unpacking JUCE's sources in $juce_folder" && unpack_juce; }; then
        # shellcheck disable=SC2046 # a list of words
        ensure_packages $(with_juce_unpacked "$@")
    else
        ensure_packages "$@"
    fi
}

# progress: copies ninja's lines, and says on the way how far it is: at every step on a terminal, else at each quarter. A few steps are
# those of a ninja within it (firmware) or of configuring again.
progress() {
    quarter=0
    while IFS= read -r line; do
        printf '%s\n' "$line"
        case $line in "["[0-9]*/*[0-9]"] "*) ;; *) continue ;; esac
        steps=${line%%]*}
        steps=${steps#[}
        [ "${steps#*/}" -ge 10 ] || continue
        now=$((4 * ${steps%/*} / ${steps#*/}))
        [ "$now" -ge "$quarter" ] || quarter=$now
        if [ -t 2 ]; then
            printf '\rphysvib: step %s of %s ' "${steps%/*}" "${steps#*/}" >&2
            [ "$now" -lt 4 ] || printf '\n' >&2
        elif [ "$now" -gt "$quarter" ]; then
            quarter=$now
            say "step ${steps%/*} of ${steps#*/}"
        fi
    done
}

# build PRESET TARGET...: configures and builds; all of the output if something goes wrong. A release's warnings are errors where PHYSVIB_STRICT=ON is exported.
build() {
    preset=$1 strict=OFF
    shift
    [ "$preset" != release ] || strict=${PHYSVIB_STRICT:-OFF}
    mkdir -p build
    log="build/$preset.log"
    say "building $preset (log: $log)"
    failed="build/$preset.failed"
    rm -f "$failed"
    { { cmake --preset "$preset" -DPHYSVIB_STRICT="$strict" && cmake --build --preset "$preset" --target "$@"; } 2>&1 || : >"$failed"; } | progress >"$log"
    if [ -e "$failed" ]; then
        rm -f "$failed"
        cat "$log" >&2
        say "the build failed"
        return 1
    fi
}
