# SPDX-License-Identifier: GPL-3.0-or-later
# A JACK server without hardware, for the scripts beside this one, which source it: a folder that goes with the script,
# a server of its own name, and `serve`. What else is to end with the script stands in `playing`.
folder=$(mktemp -d)
export HOME="$folder" JACK_DEFAULT_SERVER="physvib-$$" JACK_NO_AUDIO_RESERVATION=1
unset DISPLAY || true
server= playing=
stop() {
    for process in $playing $server; do kill "$process" 2>/dev/null || true; done
    wait 2>/dev/null || true
    reclaim "$$"
    rm -rf "$folder"
}
trap stop EXIT
trap "exit 1" HUP INT TERM

# reclaim [OWN]: a server that was killed keeps its place among the eight of a machine until one of the same name ends by itself. Those of scripts
# and tests that are gone, and of the process OWN, are taken back; a machine where eight were left would start no other.
reclaim() {
    for owner in $(grep -aoE 'physvib-[0-9]+' /dev/shm/jack-shm-registry 2>/dev/null | sed 's/.*-//'); do
        [ "$owner" = "${1:-}" ] || ! [ -e "/proc/$owner" ] || continue
        timeout 1 jackd -n "physvib-$owner" -r -d dummy >/dev/null 2>&1 || true
    done
}

# serve RATE BLOCK_FRAMES PORTS [-s]: synchronous unless told. A server that ends, or does not answer in 20 s, is told with what it said.
serve() {
    reclaim
    jackd -n "$JACK_DEFAULT_SERVER" -r "${4:--S}" -d dummy -r "$1" -p "$2" -C 0 -P "$3" >>"$folder/jackd.log" 2>&1 &
    server=$!
    for _ in $(seq 20); do
        jack_wait -w -t 1 >/dev/null 2>&1 && return
        kill -0 "$server" 2>/dev/null || break
    done
    echo "the JACK server $JACK_DEFAULT_SERVER did not start; it said:" >&2
    grep -aE . "$folder/jackd.log" >&2
    return 1
}

# close_server: another may be started then.
close_server() {
    kill "$server" 2>/dev/null || true
    wait "$server" 2>/dev/null || true
    server=
}

# rows EVENTS.csv: without the comment, which names the file's origin, and as a list of hits in a plane has them: a session's has every column.
rows() { grep -v '^#' "$1" | sed 's/,kind,material,z_m,part$/,material/; s/,hit,\([^,]*\),0,$/,\1/'; }

# raw FILE.wav: its samples, interleaved; the data chunk is what follows the word "data" and its length.
raw() { tail -c +"$(($(grep -abo data "$1" | head -n 1 | cut -d: -f1) + 9))" "$1"; }

# First byte that is not zero, as a frame of four floats; the renders start with the same sound.
first() { echo $(($(cmp "$1" /dev/zero | sed 's/.*: [a-z]* \([0-9]*\),.*/\1/' ) / 16)); }

# own_is_render FRAMES: own.wav, what a program recorded of itself, is render.wav to the bit, some frames later, over more than so many.
own_is_render() {
    raw "$folder/render.wav" >"$folder/render.raw"
    raw "$folder/own.wav" >"$folder/own.raw"
    offset=$(($(first "$folder/own.raw") - $(first "$folder/render.raw")))
    frames=$(($(stat -c %s "$folder/own.raw") / 16 - offset))
    longest=$(($(stat -c %s "$folder/render.raw") / 16))
    [ "$frames" -gt "$longest" ] && frames=$longest
    [ "$frames" -gt "$1" ] || { echo "only $frames frames recorded"; exit 1; }
    tail -c +$((offset * 16 + 1)) "$folder/own.raw" | cmp -n $((frames * 16)) - "$folder/render.raw"
    echo "own recording: $frames frames bit-equal to the render, $offset frames later"
}
