# SPDX-License-Identifier: MIT
# PulseAudio that plays to nobody, for tests: sourced by scripts that have a folder $work and .ci/packages.sh. It is unpacked only, so nothing else on this machine
# finds it. start_sound ARGUMENT...: of pulseaudio, such as -L "module-null-sink ..."; then $sound_pid runs, and $PULSE_SERVER names it.
sound=$work/sound
mkdir "$sound"
# shellcheck disable=SC2086 # a list of words
from_debian "$sound" download $physvib_sound_files
for archive in "$sound"/*.deb; do dpkg-deb -x "$archive" "$sound"; done
sound_libraries=$(ls -d "$sound"/usr/lib/*-linux-gnu) sound_modules=$(ls -d "$sound"/usr/lib/pulse-*/modules)
sound_libraries=$sound_libraries:$sound_libraries/pulseaudio:$sound_modules
export PULSE_SERVER="unix:$sound/socket"

start_sound() {
    # Eight channels of 48 kHz are the server's default: Chromium takes these, whatever the device has.
    mkdir -p "$sound/.config/pulse"
    printf 'default-sample-channels = 8\ndefault-sample-rate = 48000\n' >"$sound/.config/pulse/daemon.conf"
    HOME=$sound XDG_RUNTIME_DIR=$sound LD_LIBRARY_PATH=$sound_libraries "$sound/usr/bin/pulseaudio" -n -p "$sound_modules" --use-pid-file=no --disable-shm=yes \
        --exit-idle-time=-1 --disallow-exit --daemonize=no "$@" -L "module-native-protocol-unix auth-anonymous=1 socket=$sound/socket" >"$sound/log" 2>&1 &
    sound_pid=$!
    tries=0
    until [ -S "$sound/socket" ]; do
        tries=$((tries + 1))
        [ "$tries" -lt 100 ] || { cat "$sound/log" >&2; return 1; }
        sleep 0.1
    done
}
