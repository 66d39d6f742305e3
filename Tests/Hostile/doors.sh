#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Tries the doors by which somebody ends what he feels, in the states in which that is hard, on a JACK server without hardware: prints
# a table of door, state, and milliseconds to zero (or to the end), and fails if one is later than it may be, or a file is not whole.
# Usage: doors.sh BIN_FOLDER [GROUP...]: silence, overtake, readers, ends, commands, mixer (on a display), pauses, answers, complaints; all unless told.
set -eu
bin=$(realpath "$1")
shift
here=$(cd "$(dirname "$0")" && pwd)
physvib=$bin/physvib
groups=${*:-silence overtake readers ends commands mixer pauses answers complaints}
display=${DISPLAY:-}
. "$here/../Live/jack.sh"
cd "$folder"
port=$((20000 + $$ % 20000))
failed=0 listener= victim= helpers=

# A shell's background ignores these, and they are what is tried.
as_in_a_terminal() { exec env --default-signal=INT,HUP,TERM,PIPE "$@"; }
now() { date +%s%3N; }
alive() { [ -r "/proc/$1/stat" ] && [ "$(sed 's/.*) \(.\).*/\1/' "/proc/$1/stat" 2>/dev/null)" != Z ]; }
# until_true MS COMMAND...: 1 if it never is.
until_true() {
    end=$(($(now) + $1))
    shift
    until "$@"; do
        [ "$(now)" -lt "$end" ] || return 1
        sleep 0.02
    done
}
# row DOOR STATE MS MOST: a line of the table; MS that is no number is a failure told in words.
row() {
    verdict=ok
    case $3 in '' | *[!0-9]*) verdict=FAILED ;; *) [ "$3" -le "$4" ] || verdict="FAILED, at most $4" ;; esac
    [ "$verdict" = ok ] || failed=$((failed + 1))
    printf '%-34s %-44s %8s  %s\n' "$1" "$2" "$3" "$verdict"
}

# ---- what listens, and what is listened to
listen() {
    : >heard
    "$bin/physvib-jack-silence" 4 >heard &
    listener=$!
}
begin_server() { # RATE
    serve "$1" 256 8
    listen
    playing="$listener $helpers"
}
end_server() {
    kill "$listener" 2>/dev/null || true
    close_server
}
is_now() { [ "$(tail -n 1 heard | cut -d ' ' -f 1)" = "$1" ]; }
sounds() { is_now sound; }
quiet() { is_now silent; }
# zero DOOR STATE T0 MOST: since T0, on what is now playing.
zero() {
    if until_true 5000 quiet; then row "$1" "$2" $(($(tail -n 1 heard | cut -d ' ' -f 2) - $3 > 0 ? $(tail -n 1 heard | cut -d ' ' -f 2) - $3 : 0)) "$4"; else row "$1" "$2" never "$4"; fi
}
cat >still.json <<'SCENE'
{ "physvib_scene": 1, "name": "still", "description": "nothing moves", "field_m": [2, 1], "gravity_m_per_s2": [0, 0],
  "materials": [{ "name": "wood", "density_kg_per_m2": 850, "friction": 0.4, "restitution": 0.6, "frequency_hz": 205, "decay_per_s": 30 }], "bodies": [] }
SCENE
tone='{"message": "strike", "frequency_hz": 205, "decay_per_s": 0, "seconds": 3600, "level": 0.5, "law": "equal"}'
# play SAID TOLD SCENE OPTIONS...: with a tone that does not end, once that is heard; standard input is descriptor 3.
play() {
    said=$1 told=$2 scene=$3
    shift 3
    rm -f ./*.part felt.wav session.json session.events.csv in
    mkfifo in
    as_in_a_terminal "$physvib" play "$scene" --device JACK:system --seconds 3600 --listen --record felt.wav --save session.json "$@" <in >"$said" 2>"$told" &
    victim=$!
    playing="$victim $listener $helpers"
    exec 3>in
    echo "$tone" >&3
    until_true 20000 sounds || { row play "$scene: a tone" never 20000; [ ! -f "$told" ] || head -n 2 "$told"; }
}
say() { printf '%s\n' "$*" >&3; }
# whole: the recording has its place and length, the session renders, nothing half is left.
whole() {
    for part in ./*.part; do [ ! -e "$part" ] || { echo "left: $part"; return; }; done
    [ -e felt.wav ] || { echo "no recording"; return; }
    size=$(stat -c %s felt.wav)
    [ "$size" -gt 10000 ] && [ "$(od -An -tu4 -j4 -N4 felt.wav | tr -d ' ')" -eq $((size - 8)) ] || { echo "half a recording"; return; }
    "$physvib" render session.json --seconds 0.1 --out again.wav >rendered 2>&1 || { echo "half a session"; return; }
    [ "$(head -c 1 session.json)" = "{" ] && ! head -n 1 session.json | grep -q journal || echo "a journal, no session"
}
# end_by SIGNAL STATE PID: the signal, its row, and whether what is written is whole.
end_by() {
    t0=$(now)
    kill -s "$1" "$3" 2>/dev/null || true
    if until_true 6000 gone "$3"; then
        ms=$(($(now) - t0))
        fault=$(${4:-whole})
        row "SIG$1" "$2" "${fault:-$ms}" 1000
    else
        row "SIG$1" "$2" never 1000
        kill -9 "$3" 2>/dev/null || true
    fi
    wait "$3" 2>/dev/null || true
    exec 3>&-
}
gone() { ! alive "$1"; }
ended() { kill "$victim" 2>/dev/null || true; until_true 3000 gone "$victim" || kill -9 "$victim" 2>/dev/null || true; wait "$victim" 2>/dev/null || true; exec 3>&-; until_true 3000 quiet || true; }
osc() { python3 "$here/osc.py" "$port" "$@"; }
sent() { osc say "$@" | sed -n 's/^sent //p'; }

# ---- 1: silence is held by who asked, and lifted there or at the machine
try_silence() {
    begin_server 48000
    play out err still.json --osc "$port"
    t=$(now); say '{"control": "silence", "on": true}'; zero "--listen" "plays" "$t" 100
    osc say /physvib/silence si on 0 >/dev/null; sleep 0.4
    if quiet; then row "/physvib/silence 0" "held by --listen: stays silent" 0 0; else row "/physvib/silence 0" "held by --listen: stays silent" sounds 0; fi
    say '{"control": "silence", "on": false}'
    until_true 2000 sounds || row "--listen" "lifted by who asked" never 2000
    t=$(sent /physvib/silence si on 1); zero "/physvib/silence" "plays" "$t" 100
    say '{"control": "silence", "on": false}'; sleep 0.4
    if quiet; then row "--listen off" "held by OSC: stays silent" 0 0; else row "--listen off" "held by OSC: stays silent" sounds 0; fi
    osc say /physvib/silence si on 0 >/dev/null
    until_true 2000 sounds || row "/physvib/silence 0" "lifted by who asked" never 2000
    t=$(now); kill -s INT "$victim"; zero "Ctrl-C" "plays" "$t" 100
    ended
    end_server
}

# ---- 2: silence overtakes what waits
try_overtake() {
    begin_server 48000
    play out err still.json --osc "$port"
    osc flood 4 10000 & helpers=$!
    sleep 2; t=$(sent /physvib/silence si on 1); zero "/physvib/silence" "10,000 OSC messages a second" "$t" 150
    wait "$helpers" || true; helpers=
    ended
    play out err still.json --osc "$port"
    (for _ in $(seq 400); do yes '{"message": "strike", "frequency_hz": 100, "decay_per_s": 50, "level": 0.001}' | head -n 100; sleep 0.005; done) >&3 & helpers=$!
    sleep 1; t=$(now); say '{"control": "silence", "on": true}'; zero "--listen" "10,000 lines a second on standard input" "$t" 300
    kill "$helpers" 2>/dev/null || true; wait "$helpers" 2>/dev/null || true; helpers=
    ended
    end_server
}

# ---- 3: nobody waits for a reader
try_readers() {
    begin_server 48000
    mkfifo full
    exec 4<>full
    play full err still.json
    yes '{"message": "status"}' | head -n 2000 >&3 & helpers=$!
    sleep 1; (printf '%s\n' '{"control": "silence", "on": true}' >&3) & silencing=$!
    t=$(now); zero "--listen" "answers that nobody reads" "$t" 500
    kill "$helpers" "$silencing" 2>/dev/null || true; helpers=
    end_by TERM "standard output that nobody reads" "$victim"
    play out full still.json
    yes 'nonsense' | head -n 5000 >&3 & helpers=$!
    sleep 1
    kill "$helpers" 2>/dev/null || true; helpers=
    end_by TERM "standard error that nobody reads" "$victim"
    exec 4<&-
    end_server
}

# ---- 4: ends
crowd() { # bodies N: that many balls in a box that is shaken
    awk -v n="$1" 'BEGIN {
        printf "{ \"physvib_scene\": 1, \"name\": \"crowd\", \"description\": \"many\", \"field_m\": [40, 40], \"gravity_m_per_s2\": [0, -9.8], \"drive_gain\": 1,"
        printf "\"materials\": [{ \"name\": \"wood\", \"density_kg_per_m2\": 100, \"friction\": 0.4, \"restitution\": 0.8, \"frequency_hz\": 205, \"decay_per_s\": 30 }],"
        printf "\"bodies\": [{ \"name\": \"floor\", \"type\": \"static\", \"position_m\": [20, 0.5], \"mass_kg\": 900, \"fixtures\": [{ \"shape\": \"box\", \"size_m\": [40, 1], \"material\": \"wood\", \"camera\": true }] }"
        for (i = 0; i < n; ++i) printf ", { \"name\": \"b%d\", \"position_m\": [%.2f, %.2f], \"fixtures\": [{ \"shape\": \"circle\", \"radius_m\": 0.2, \"material\": \"wood\" }] }", i, 1 + 0.5 * (i % 76) + 0.01 * (i % 3), 2 + 0.5 * int(i / 76)
        print "], \"script\": [{ \"time_s\": 2, \"input\": \"gravity\", \"gravity_m_per_s2\": [5, -9.8], \"times\": 1000, \"every_s\": 2 }] }" }' >crowd.json
}
try_ends() {
    begin_server 48000
    for signal in TERM INT HUP; do
        play out err still.json
        sleep 0.5
        end_by $signal "plays" "$victim"
    done
    crowd 2000
    for driver in message thread; do
        play out err crowd.json --driver $driver
        sleep 3
        end_by TERM "2,000 bodies, driver $driver" "$victim"
    done
    for signal in TERM INT HUP; do
        play out err still.json
        kill -STOP "$server"
        sleep 3.5
        end_by $signal "the JACK server is stopped for 3.5 s" "$victim"
        kill -CONT "$server"
        end_server
        begin_server 48000
    done
    play out err still.json
    kill -STOP "$server"
    sleep 0.1
    end_by TERM "the JACK server is stopped for 0.1 s" "$victim"
    kill -CONT "$server"; end_server; begin_server 48000
    play out err still.json
    kill -9 "$server"
    sleep 2
    end_by TERM "the JACK server is gone" "$victim"
    end_server
    begin_server 48000
    kill -STOP "$server"
    as_in_a_terminal "$physvib" play still.json --device JACK:system --seconds 60 >out 2>err & victim=$!
    sleep 1
    end_by TERM "the JACK server is stopped before play begins" "$victim" true
    kill -CONT "$server"
    end_server
}

# ---- 4: every other command
# command_ends NAME OUTPUT WORDS...: begins it, ends it a second later by each signal; OUTPUT, if it has a name, stays away.
command_ends() {
    name=$1 output=$2
    shift 2
    for signal in TERM INT HUP; do
        [ "$output" = - ] || rm -rf "$output"
        as_in_a_terminal "$@" </dev/null >out 2>err &
        victim=$!
        sleep "${patience:-1}"
        alive "$victim" || { row "SIG$signal" "$name" "over before" 1000; continue; }
        children=$(pgrep -P "$victim" || true)
        absent=$output
        end_by $signal "$name" "$victim" nothing_left
    done
}
nothing_left() {
    for child in $children; do until_true 500 gone "$child" || { echo "a process is left"; return; }; done
    [ "$absent" = - ] || [ ! -f "$absent" ] || { echo "half a file"; return; }
    [ -z "$(find . -name '*.part')" ] || echo "left: $(find . -name '*.part')"
}
try_commands() {
    python3 -c 'import pty, os, time; master, slave = pty.openpty(); print(os.ttyname(slave), flush=True); time.sleep(600)' >mute &
    helpers=$!
    playing=$helpers
    until_true 5000 test -s mute
    command_ends "render" never.wav "$physvib" render shake-the-box --seconds 86000 --layout phone1 --rate 8000 --out never.wav
    echo '{"physvib_sweep": 1, "name": "long", "scenes": ["shake-the-box", "drop"], "seeds": {"from": 1, "count": 4}, "layouts": ["phone1"], "options": {"seconds": 80000, "rate": 8000}}' >design.json
    command_ends "sweep, two processes" cut/index.csv "$physvib" sweep design.json --out cut --jobs 2
    command_ends "study run" - "$physvib" study run magnitudes --observer simulated --out . --pace 5
    patience=0.2
    command_ends "stimulus" never.wav "$physvib" stimulus phantom --at 0.5,0.5 --seconds 600 --rate 192000 --layout ring4 --out never.wav
    patience=1
    command_ends "board info, no answer" - "$physvib" board "$(cat mute)" info
    command_ends "board test, no answer" - "$physvib" board "$(cat mute)" test
    command_ends "play on a board alone, no answer" - "$physvib" play drop --board "$(cat mute)"
    begin_server 48000
    playing="$listener $helpers"
    "$bin/physvib-jack-actuator" 204 12 0.4 700 >ready &
    helpers="$helpers $!"
    until_true 5000 grep -qs ready ready
    command_ends "calibrate" never.json "$physvib" calibrate --device JACK:actuator --channel 1 --input 1 --seconds 30 --out never.json
    command_ends "play beside a board, no answer" never.wav "$physvib" play still.json --device JACK:system --board "$(cat mute)" --record never.wav
    kill -STOP "$server"
    command_ends "calibrate, the JACK server is stopped" never.json "$physvib" calibrate --device JACK:system --channel 1 --input 1 --out never.json
    command_ends "devices, the JACK server is stopped" - "$physvib" devices
    kill -CONT "$server"
    end_server
    # shellcheck disable=SC2086 # several
    kill $helpers 2>/dev/null || true
    helpers=
}

# The mixer's process; with-display.sh makes it a display.
try_mixer() {
    [ -n "$display" ] || { echo "mixer: skipped, there is no display"; return 0; }
    export XDG_CONFIG_HOME="$folder"
    patience=5
    begin_server 48000
    for device in "None:no device" JACK:system; do
        command_ends "mixer on $device" - env DISPLAY="$display" "$bin/physvib-mixer" --device "$device"
    done
    as_in_a_terminal env DISPLAY="$display" "$bin/physvib-mixer" --device JACK:system >out 2>err & victim=$!
    sleep 5
    kill -STOP "$server"
    sleep 4
    end_by TERM "mixer, the JACK server is stopped for 4 s" "$victim" true
    kill -CONT "$server"
    end_server
}

# ---- 5: a pause is not a loss
# back STATE T0 MOST: sound is there again.
back() { if until_true 15000 sounds; then row "sounds again" "$1" $(($(now) - $2)) "$3"; else row "sounds again" "$1" never "$3"; fi; }
try_pauses() {
    begin_server 48000
    play out err still.json
    for pause in 2.2 2.2 3.1 5; do
        kill -STOP "$victim"; sleep $pause; t=$(now); kill -CONT "$victim"
        back "play was stopped for $pause s" "$t" 1000
        sleep 0.5
    done
    if [ -s err ]; then row "no device was lost" "$(head -n 1 err)" told 0; fi
    end_by TERM "after four pauses" "$victim"
    timeout 5 jack_lsp >/dev/null || row "the JACK server" "after four pauses" "is wedged" 0

    play out err still.json
    kill -STOP "$server"; sleep 6
    grep -q "its driver does not answer" err || row "told" "the JACK server is stopped for 6 s" no 0
    kill -CONT "$server"; t=$(now)
    back "the JACK server was stopped for 6 s" "$t" 6000
    end_by TERM "after that" "$victim"
    end_server; begin_server 48000

    play out err still.json
    kill -9 "$server"; until_true 5000 grep -q "no such device" err || row "told" "the JACK server is killed" no 0
    kill "$listener" 2>/dev/null || true
    begin_server 44100; playing="$victim $playing"; t=$(now)
    # 80 to 190 ms; or 6.93 to 6.96 s, if the program asks for the device while the server starts: it is answered only then.
    back "the JACK server is back at 44.1 kHz" "$t" 8000
    end_by TERM "after that" "$victim" session_whole
    grep -q "the recording ends where" err || row "told" "the recording ends with its rate" no 0
    end_server
}
session_whole() { whole | grep -v "half a recording" || true; }

# ---- 6: every door answers
try_answers() {
    begin_server 48000
    play out err still.json --osc "$port"
    for wrong in "/physvib/strike ss material lead" "/physvib/strike sf level 7" "/physvib/nonsense" "/physvib/strike" "/physvib/strike s material" \
        "/physvib/silence ss on maybe" "/physvib/pattern ss pattern AZ" "/physvib/gain sisf channel 99 value 0.5" "/elsewhere si on 1"; do
        t=$(now)
        # shellcheck disable=SC2086 # words
        if osc say $wrong | grep -q /physvib/error; then row "/physvib/error" "$wrong" $(($(now) - t)) 1000; else row "/physvib/error" "$wrong" never 1000; fi
        sleep 0.15
    done
    say '{"control": "silence", "on": true, "id": 7}'
    if until_true 1000 grep -q '"id": 7' out; then row '"id"' "accepted" 0 0; else row '"id"' "accepted" never 0; fi
    say '{"message": "strike", "material": "lead", "id": 8}'
    if until_true 1000 grep -q '"answer": "error".*"id": 8' out; then row '"id"' "refused" 0 0; else row '"id"' "refused" never 0; fi
    ended
    end_server
}

# ---- 7: complaints are few
try_complaints() {
    begin_server 48000
    play out err still.json
    yes 'nonsense' | head -n 100000 >&3
    say '{"message": "status"}'
    until_true 20000 grep -q status out || row "--listen" "100,000 wrong lines before" never 20000
    row "lines on standard error" "of 100,000 wrong lines" "$(wc -l <err)" 1000
    ended
    end_server
}

printf '%-34s %-44s %8s\n' door state ms
for group in $groups; do "try_$group"; done
[ "$failed" -eq 0 ] || { echo "$failed of these failed"; exit 1; }
