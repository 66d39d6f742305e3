# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=sh
# Programs and windows of a display of one's own, for the scripts beside this one, which source it after they have made $folder. What `background` starts
# ends with the script.
started=''
trap 'kill $started 2>/dev/null || :' EXIT
trap 'exit 1' HUP INT TERM
background() {
    "$@" >>"$folder/log" 2>&1 &
    started="$started $!"
}
window() { # TITLE: waits for it, and prints its number
    for _ in $(seq 60); do
        xdotool search --onlyvisible --name "$1" 2>/dev/null | tail -n 1 | grep . && return
        sleep 0.5
    done
    import -window root "$folder/no-window.png"
    echo "expected a window \"$1\"; the screen is $folder/no-window.png" >&2 && exit 1
}
press() { for key in "$@"; do xdotool key "$key" && sleep 0.5; done; }
