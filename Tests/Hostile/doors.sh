#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Tries the doors by which somebody ends what he feels, in the states in which that is hard, on a JACK server without hardware: prints
# a table of door, state, and milliseconds to zero (or to the end), and fails if one is later than it may be, or a file is not whole.
# Usage: doors.sh BIN_FOLDER [GROUP...]: silence, overtake, readers, ends, commands, mixer, dialogs (on a display), pauses, answers, complaints, wrong, closed, dead, stops; all unless told.
set -eu
bin=$(realpath "$1")
shift
here=$(cd "$(dirname "$0")" && pwd)
physvib=$bin/physvib
groups=${*:-silence overtake readers ends commands mixer dialogs pauses answers complaints wrong closed dead stops}
display=${DISPLAY:-}
. "$here/../Live/jack.sh"
cd "$folder"
port=$((20000 + $$ % 20000))
failed=0 listener= victim= helpers=
trap "" PIPE # a player that ended is a row that failed, and what listens still ends with the script

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
    if until_true "${longest:-5000}" quiet; then row "$1" "$2" $(($(tail -n 1 heard | cut -d ' ' -f 2) - $3 > 0 ? $(tail -n 1 heard | cut -d ' ' -f 2) - $3 : 0)) "$4"; else row "$1" "$2" never "$4"; fi
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
    say "$tone"
    until_true 20000 sounds || { row play "$scene: a tone" never 20000; [ ! -f "$told" ] || head -n 2 "$told"; }
}
say() { printf '%s\n' "$*" >&3 2>/dev/null || true; }
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
# Just while a client leaves, a JACK server may take no other for seconds.
ended() { kill "$victim" 2>/dev/null || true; until_true 3000 gone "$victim" || kill -9 "$victim" 2>/dev/null || true; wait "$victim" 2>/dev/null || true; exec 3>&-; until_true 3000 quiet || true; sleep 0.5; }
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
    serve 48000 256 8 # and nobody who connects what plays to himself
    as_in_a_terminal "$physvib" play still.json --device JACK:system --seconds 8 </dev/null >out 2>err & victim=$!
    until_true 5000 eval 'jack_lsp | grep -q physvib' || true
    sleep 1
    t=$(now)
    for k in 1 2 3 4; do jack_disconnect "physvib:out_$k" "system:playback_$k" || true; done
    if until_true 30000 gone "$victim"; then row "--seconds 8" "nobody asks for blocks any more" $(($(now) - t)) 20000; else row "--seconds 8" "nobody asks for blocks any more" never 20000; kill -9 "$victim"; fi
    grep -q "4 of 4 actuators have no output" err || row "told" "nobody asks for blocks any more" no 0
    wait "$victim" 2>/dev/null || true
    close_server
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

# Esc and a press on SILENCE by the display's own keyboard and mouse, while something else of the mixer has
# them. Places are those of a window of 1440 x 900; stop-walk.sh tries every state there is.
try_dialogs() {
    [ -n "$display" ] || { echo "dialogs: skipped, there is no display"; return 0; }
    ! grep -q ':2328 ' /proc/net/udp || { row mixer "another program has the port 9000" never 0; return 0; }
    export XDG_CONFIG_HOME="$folder"
    mkdir -p physvib
    echo '<?xml version="1.0"?><PROPERTIES><VALUE name="osc" val="this-computer"/><VALUE name="hint-seen" val="1"/><VALUE name="mode" val="engineer 00 11"/></PROPERTIES>' >physvib/mixer.settings
    begin_server 48000
    as_in_a_terminal env DISPLAY="$display" "$bin/physvib-mixer" still.json --device JACK:system >out 2>err & victim=$!
    playing="$victim $listener"
    until_true 20000 window_is_there
    sleep 1
    port=9000
    osc say /physvib/strike sfsfsfsfss frequency_hz 205 decay_per_s 0 seconds 3600 level 0.5 law equal >/dev/null
    until_true 5000 sounds || row mixer "a tone by OSC" never 5000
    osc say /physvib/gain sisf channel 1 value 0.9 >/dev/null # an edit: closing asks
    stop_in "nothing open" true
    stop_in "main menu" x key F10
    stop_in "list of scenes" at 316 26
    stop_in "list of outputs" output_list
    stop_in "list of protocols" protocol_list
    stop_in "text field" at 537 25
    stop_in "Open (Save the session?)" x key ctrl+o
    stop_in "Open" open_chooser
    stop_in "Render" x key ctrl+e
    stop_in "Width of the display" x key F10 sleep 0.3 key Up key Up key Right sleep 0.3 key Up key Return
    x key F10 sleep 0.5; t=$(now); x keydown Escape sleep 1.2 keyup Escape; zero "Esc, held down" "main menu" "$t" 150; stays "Esc, held down"
    told "$mixer_door"
    ended
    end_server
}
x() { env DISPLAY="$display" xdotool "$@"; }
window_is_there() { x search --onlyvisible --name "PhysVib mixer" >window 2>/dev/null && [ -s window ]; }
over() {
    # shellcheck disable=SC2046 # X=.. Y=..
    eval $(x getwindowgeometry --shell "$(head -n 1 window)" | grep '^[XY]=')
    x mousemove $((X + $1)) $((Y + $2)) sleep 0.1
}
at() { over "$1" "$2"; x click 1; }
output_list() { at 1275 77; sleep 0.2; at 1131 138; }
protocol_list() { at 1367 77; sleep 0.2; at 1131 138; }
open_chooser() { x key ctrl+o sleep 0.5 key d; } # do not save
# stop_in STATE HOW...: brings it about; Esc, which closes it as well; then again, and a press.
mixer_door='mixer: SILENCE, Esc, whatever is open'
# From when key or click has been sent: how long xdotool takes to begin is a matter of the processor's share.
stop_in() {
    state=$1
    shift
    for by in Esc SILENCE; do
        "$@" || true
        sleep 0.6
        if [ $by = Esc ]; then x key Escape; else over 1353 26 && x click 1; fi
        t=$(now)
        zero $by "$state" "$t" 150; note_stop "$mixer_door" "$t"; stays $by
        again
    done
}
# stays DOOR: no pause of a loaded machine, but silence.
stays() { sleep 0.5; quiet || row "$1" "$state: silent for half a second" sounds 0; }
# again: whatever is open closes, and the button brings the tone back.
again() {
    for _ in 1 2 3 4; do
        x key Escape sleep 0.3
        at 1353 26
        ! until_true 1500 sounds || return 0
    done
    row "sounds again" "$state" never 0
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
    kill -9 "$server"; until_true 5000 grep -q "has stopped" err || row "told" "the JACK server is killed" no 0
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

# ---- 8: what names silence and is no off in its right form silences, and its sender is told so
# wrong DOOR STATE TOLD T0: silent since T0, told in that file by a line or an answer; then lifted in the right form.
wrong() {
    zero "$1" "$2" "$4" 100
    until_true 1000 grep -q "silenced all the same" "$3" || row "$1" "$2: told" never 1000
    say '{"control": "silence", "on": false}'
    osc say /physvib/silence si on 0 >/dev/null
    until_true 2000 sounds || row "$1" "$2: lifted" never 2000
}
try_wrong() {
    begin_server 48000
    longest=1000
    play out err still.json --osc "$port"
    long=$(head -c 70000 /dev/zero | tr '\0' ' ')
    for line in '{"control": "silence"}' '{"control": "silence", "on": "true"}' '{"control": "silence", "on": 1}' '{"control": "silence", "on": null}' \
        '{"control": "silence", "on": "false"}' '{"control": "silence", "on": true, "now": true}' '{"control": "silence", "on": false, "id": "a"}' \
        '{"control": "silence", "on": false, "on": false}' '{"control": "Silence", "on": true}' '{"message": "silence", "on": true}' '{"input": "silence"}' \
        '{"control": "silence", "on": tr' '{"control": "silence"' '{"control": "silence", "on": True}' "{'control': 'silence', 'on': True}" '{"silence": true}' \
        'silence' '["silence"]' '{"control": ["silence"]}' '{"control": "\u0073ilence"}' "{\"control\": \"silence\", $long \"on\": true}" "{ $long \"control\": \"silence\", \"on\": false}"; do
        : >err
        t=$(now); say "$line"; wrong "--listen" "$(printf %.44s "$line")" err "$t"
        sleep 1 # complaints of a cause are one a second
    done
    for words in /physvib/silence "/physvib/silence i 1" "/physvib/silence i 0" "/physvib/silence ss on 1" "/physvib/silence ss on false" "/physvib/silence si off 1" "/physvib/silence s on" \
        "/physvib/silence sisi on 1 id 7" "/physvib/silence sisi on 0 on 0" "/physvib/silence sii on 0 0" "/physvib/silence sb on blob" "/physvib/silence sf on nan" "/physvib/silence sN on -" \
        "/physvib/silence F -" "/physvib/silence/ si on 0" "/physvib/silence/on i 1" "/physvib/Silence si on 1" "/physvib/silences" \
        "/physvib/silence ss message stop" "/physvib/silence ss input tilt" "/physvib/sil* si on 0" "/*/{stop,silence}"; do
        # shellcheck disable=SC2086 # words
        osc say $words >answer; wrong "/physvib/silence" "${words#/physvib/}" answer "$(sed -n 's/^sent //p' answer)"
    done
    osc broken list >kinds
    while read -r kind; do
        osc broken "$kind" >answer; wrong "/physvib/silence" "$kind" answer "$(sed -n 's/^sent //p' answer)"
    done <kinds
    for other in '{"message": "clip", "file": "silence.wav"}' '{"input": "impulse", "body": "silence", "impulse_ns": [0, 1]}' '{"input": "spawn", "body": {"name": "silence"}}'; do
        say "$other"
    done
    osc say /physvib/answer/silence si on 1 >/dev/null
    osc say /physvib/clip ss file silence >/dev/null
    osc say /elsewhere/silence si on 1 >/dev/null
    sleep 0.3
    if sounds; then row "another line or address" "with the word in it: plays on" 0 0; else row "another line or address" "with the word in it" silent 0; fi
    longest=
    ended
    end_server
}

# ---- 9: standard input ends
# leaves DOOR STATE T0 MOST: zero, and the program ends by itself.
leaves() {
    zero "$1" "$2" "$3" "$4"
    if until_true 5000 gone "$victim"; then row "$1" "$2: ends" $(($(now) - $3)) "$5"; else row "$1" "$2: ends" never "$5"; kill -9 "$victim"; fi
    fault=$(whole)
    [ -z "$fault" ] || row "$1" "$2: files" "$fault" 0
}
try_closed() {
    begin_server 48000
    play out err still.json
    t=$(now); exec 3>&-; leaves "--listen" "standard input is closed" "$t" 800 2000
    grep -q -- "--keep-playing" err || row "--listen" "standard input is closed: told" never 0
    for again in 1 2 3; do # the program that controls it is killed in the middle of a line, with another that waits for its time
        rm -f felt.wav session.json session.events.csv
        python3 -c "import subprocess, sys, time
player = subprocess.Popen(sys.argv[1:], stdin=subprocess.PIPE)
player.stdin.write(b'$tone\n{\"message\": \"strike\", \"frequency_hz\": 100, \"decay_per_s\": 1, \"in\": 100}\n{\"message\": \"stri')
player.stdin.flush()
print(player.pid, flush=True)
time.sleep(600)" "$physvib" play still.json --device JACK:system --seconds 3600 --listen --osc "$port" --record felt.wav --save session.json >controls 2>err &
        control=$!
        playing="$control $listener"
        until_true 20000 sounds || row play "a tone" never 20000
        victim=$(head -n 1 controls)
        playing="$control $victim $listener"
        t=$(now); kill -9 "$control"; wait "$control" 2>/dev/null || true
        leaves "--listen" "who controls it is killed, $again" "$t" 800 2000
        "$physvib" play still.json --device JACK:system --seconds 0.2 --osc "$port" >out 2>told || row play "after that" failed 0
        grep -q "listening at 127.0.0.1:$port\$" told || row "--osc" "after that: its port" taken 0
    done
    play out err still.json --keep-playing
    exec 3>&-; sleep 1.5
    if sounds && alive "$victim"; then row "--keep-playing" "standard input is closed: plays on" 0 0; else row "--keep-playing" "standard input is closed" silent 0; fi
    end_by TERM "after that" "$victim"
    for k in 1 2 3; do # what was sent last is felt
        : >heard
        echo '{"message": "strike", "frequency_hz": 205, "decay_per_s": 30, "level": 0.5}' | "$physvib" play still.json --device JACK:system --seconds 5 --listen >out 2>err
        if until_true 500 grep -q sound heard; then row "one line, and the end" "felt, $k" 0 0; else row "one line, and the end" "felt, $k" no 0; fi
    done
    end_server
}

# ---- 10: a client that dies leaves nothing behind
try_dead() {
    begin_server 48000
    for signal in KILL TERM STOP; do
        python3 -c "import ctypes, sys, time
lib = ctypes.CDLL(sys.argv[1])
live = ctypes.c_void_p()
lib.physvib_live_open.argtypes = [ctypes.c_char_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p]
print(lib.physvib_live_open(b'JACK:system', None, None, ctypes.byref(live)), flush=True)
time.sleep(600)" "$bin/../lib/libphysvib-live.so" >opened 2>err & client=$!
        playing="$client $listener"
        until_true 20000 grep -q "^0" opened || row "live library" "opens" never 20000
        kill -s $signal "$client"
        [ $signal != STOP ] || { sleep 2; kill -s KILL "$client"; }
        wait "$client" 2>/dev/null || true
        sleep 1 # as in ended()
        play out err still.json --osc "$port"
        row "play" "after a live client and SIG$signal" 0 0
        ended
    done
    for signal in KILL TERM; do
        play out err still.json --osc "$port"
        kill -s $signal "$victim" || true
        exec 3>&-
        wait "$victim" 2>/dev/null || true
        sleep 1
        play out err still.json --osc "$port"
        if grep -q "listening at 127.0.0.1:$port\$" err; then row "play" "after play and SIG$signal, on its port" 0 0; else row "--osc" "after play and SIG$signal: its port" taken 0; fi
        ended
    done
    end_server
}

# ---- 11: the table of Docs/silence.md, whose last bound each door keeps
table=$here/../../Docs/silence.md
# stop_row DOOR T0: how long it was until zero, into a file of that door.
stop_row() {
    until_true 3000 quiet || { row "$1" plays never 0; return; }
    note_stop "$1" "$2"
}
note_stop() {
    ms=$(($(tail -n 1 heard | cut -d ' ' -f 2) - $2))
    echo $((ms > 0 ? ms : 0)) >>"stop $(echo "$1" | tr / -)"
}
back_again() {
    say '{"control": "silence", "on": false}'
    osc say /physvib/silence si on 0 >/dev/null
    until_true 3000 sounds || row "$1" "lifted" never 0
}
# told DOOR: its row as it may stand in the table, and whether it keeps the bound that stands there.
told() {
    file="stop $(echo "$1" | tr / -)"
    sort -n "$file" >sorted
    count=$(wc -l <sorted) worst=$(tail -n 1 sorted) median=$(sed -n "$((count / 2 + 1))p" sorted)
    most=$(awk -F ' *[|] *' -v door="$1" 'NF == 8 && $2 == door { print $6 }' "$table")
    row "$1" "median $median, worst of $count" "$worst" "${most:-0}"
    echo "| $1 | $median | $worst | $count | $most |"
}
try_stops() {
    begin_server 48000
    play out err still.json --osc "$port"
    for _ in $(seq 20); do
        t=$(now); say '{"control": "silence", "on": true}'; stop_row '`--listen`: silence on' "$t"; back_again
        t=$(now); say '{"control": "silence", "on": "tr'; stop_row '`--listen`: a line that is cut' "$t"; back_again
        t=$(sent /physvib/silence si on 1); stop_row '`/physvib/silence on 1`' "$t"; back_again
        t=$(osc broken "an off that is cut" | sed -n 's/^sent //p'); stop_row '`/physvib/silence`: a packet that is cut' "$t"; back_again
    done
    ended
    for _ in $(seq 10); do # each on a server of its own: see ended()
        end_server; begin_server 48000
        play out err still.json
        t=$(now); kill -s INT "$victim"; stop_row '`play`: Ctrl-C, `kill`' "$t"; ended
        end_server; begin_server 48000
        play out err still.json
        t=$(now); exec 3>&-; stop_row '`play --listen`: standard input ends' "$t"; ended
    done
    end_server; begin_server 48000
    # shellcheck disable=SC2016 # C
    python3 -c "import ctypes, sys, time
lib, live = ctypes.CDLL(sys.argv[1]), ctypes.c_void_p()
class Event(ctypes.Structure):
    _fields_ = [(n, ctypes.c_int64) for n in ('size', 'time_ns', 'duration_ns')] + [(n, ctypes.c_double) for n in ('hz', 'decay', 'amplitude', 'x', 'y', 'impulse', 'mass')] + [(n, ctypes.c_int) for n in ('fixture', 'other', 'kind', 'sound')] + [('z', ctypes.c_double), ('part', ctypes.c_int), ('unused', ctypes.c_int)]
lib.physvib_live_open.argtypes = [ctypes.c_char_p] + [ctypes.c_void_p] * 3
assert lib.physvib_live_open(b'JACK:system', None, None, ctypes.byref(live)) == 0
assert lib.physvib_live_strike(live, ctypes.byref(Event(ctypes.sizeof(Event), 0, 3600 * 10 ** 9, 205, 0, 0.5, 0.1, 0.1, 0, 0, -1, -1)), ctypes.c_int64(1)) == 0
print('open', flush=True)
for line in sys.stdin:
    print(time.time_ns() // 1_000_000, flush=True)
    lib.physvib_live_silence(live, int(line))" "$bin/../lib/libphysvib-live.so" <in >out 2>err & victim=$!
    playing="$victim $listener"
    exec 3>in
    until_true 20000 sounds || row "live library" "a tone" never 0
    for _ in $(seq 20); do
        say 1; sleep 0.3; stop_row '`physvib_live_silence`' "$(tail -n 1 out)"
        say 0; until_true 3000 sounds || row "live library" lifted never 0
    done
    ended
    for door in '`--listen`: silence on' '`--listen`: a line that is cut' '`/physvib/silence on 1`' '`/physvib/silence`: a packet that is cut' '`physvib_live_silence`' '`play`: Ctrl-C, `kill`' '`play --listen`: standard input ends'; do told "$door"; done
    end_server
}

printf '%-34s %-44s %8s\n' door state ms
for group in $groups; do "try_$group"; done
[ "$failed" -eq 0 ] || { echo "$failed of these failed"; exit 1; }
