#!/bin/sh
# SPDX-License-Identifier: MIT
# Within the tree of Tests/godot.sh: a JACK server without hardware, a recorder, and played.gd.
cd /physvib || exit 1
export HOME=/physvib JACK_DEFAULT_SERVER=physvib JACK_NO_AUDIO_RESERVATION=1
jackd -n physvib -r -S -d dummy -r 48000 -p 256 -C 0 -P 8 >jackd.log 2>&1 &
server=$!
sleep 4
./physvib-jack-recorder live.raw 4 7 >ready 2>&1 &
recording=$!
for _ in $(seq 100); do grep -qs ready ready && break; sleep 0.1; done
LD_LIBRARY_PATH=/physvib/libraries timeout 60 godot --headless -s played.gd -- seconds=5
wait $recording
kill $server
