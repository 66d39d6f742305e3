#!/bin/sh
# SPDX-License-Identifier: MIT
# Prints the tables of Docs/timings.md: every hit of every built-in scene under `onset` timing beside its like under
# `release`, how much later and how many dB more (hard: within 20 dB of the scene's hardest); and oblique hits beside what Eq. 5.2 makes of them.
# Usage: timings.sh PHYSVIB [SECONDS [SCENE...]]
set -eu
physvib=$1 seconds=${2:-60}
shift
[ $# = 0 ] || shift
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# hits SCENE TIMING RATE [--set ...]: time, amplitude, fixture, other, x, y.
hits() {
    scene=$1 timing=$2 rate=$3
    shift 3
    "$physvib" render "$scene" "$@" --timing "$timing" --steps-per-second "$rate" --seconds "$seconds" \
        --events "$folder/$timing.csv" >"$folder/report"
    awk -F, '!/^[#t]/ { print $1, $4, $8, $9, $5, $6 }' "$folder/$timing.csv" >"$folder/$timing"
}

# Each onset takes the first free release of the same two fixtures within 50 ms and a step, less than 0.2 m away.
compare() {
    awk -v rate="$2" '
        FNR == NR { t[++n] = $1; a[n] = $2; pair[n] = $3 " " $4; x[n] = $5; y[n] = $6; next }
        { ++onsets; key = $3 " " $4
          while (first <= n && t[first] < $1 - 0.1) ++first
          for (i = first; i <= n && t[i] <= $1 + 0.0501 + 1 / rate; ++i)
              if (!taken[i] && pair[i] == key && t[i] >= $1 - 1e-9 && (x[i] - $5) ^ 2 + (y[i] - $6) ^ 2 < 0.04) {
                  taken[i] = 1; print 1000 * (t[i] - $1), 20 * log(a[i] / $2) / log(10), $2 > pairs; ++matched; break
              } }
        END { print onsets + 0, n + 0, matched + 0 }' pairs="$folder/pairs" "$folder/release" "$folder/onset" >"$folder/counts"
    cut -d' ' -f1 "$folder/pairs" | sort -g >"$folder/late"
    cut -d' ' -f2 "$folder/pairs" | sort -g >"$folder/louder"
    hard=$(cut -d' ' -f3 "$folder/pairs" | sort -g | tail -n 1)
    awk -v hard="$hard" '$3 > hard / 10 { print $2 }' "$folder/pairs" | sort -g >"$folder/hard"
    awk -v name="$1" -v rate="$2" '
        FILENAME ~ /counts$/ { onsets = $1; releases = $2; next }
        FILENAME ~ /late$/ { late[++n] = $1; next }
        FILENAME ~ /louder$/ { louder[++m] = $1; next }
        { hard[++k] = $1 }
        function at(list, size, q) { return list[1 + int(q * (size - 1) + 0.5)] }
        END {
            if (n) printf "| %s | %d | %d | %d | %d | %.1f | %+.1f, %+.1f, %+.1f | %d | %+.1f, %+.1f, %+.1f |\n", name, rate, onsets, releases, n,
                at(late, n, 0.5), at(louder, n, 0.05), at(louder, n, 0.5), at(louder, n, 0.95), k, at(hard, k, 0.05), at(hard, k, 0.5), at(hard, k, 0.95)
        }' "$folder/counts" "$folder/late" "$folder/louder" "$folder/hard"
}

row() {
    label=$1 scene=$2
    shift 2
    for rate in 100 1000; do
        hits "$scene" onset $rate "$@"
        hits "$scene" release $rate "$@"
        : >"$folder/pairs"
        compare "$label" $rate
    done
}

echo '| scene | steps/s | onset hits | release hits | pairs | later, ms | dB: 5 %, half, 95 % | hard pairs | dB: 5 %, half, 95 % |'
echo '| --- | --- | --- | --- | --- | --- | --- | --- | --- |'
[ $# -gt 0 ] || set -- $("$physvib" scenes | awk '{ print $1 }')
for scene in "$@"; do
    name=$(basename "$scene" .json)
    case $name in
        drop | box-study) for pair in rubber-concrete wood-wood steel-steel; do row "$name $pair" "$scene" --set pair=$pair; done ;;
        *) row "$name" "$scene" ;;
    esac
done

printf '\nA stick of 0.8 x 0.2 m, the camera on it, meets a plate with one corner; no gravity, no friction:\n\n'
echo '| tilt, rad | s | onset N s | release N s | ratio | sqrt(1 + 3 s^2) |'
echo '| --- | --- | --- | --- | --- | --- |'
for tilt in 0.1 0.3 0.5 0.7 1.0 1.2; do
    cat >"$folder/stick.json" <<END
{ "physvib_scene": 1, "name": "stick", "field_m": [4, 4],
  "materials": [{ "name": "m", "density_kg_per_m2": 500, "friction": 0, "restitution": 0.5, "frequency_hz": 100, "decay_per_s": 30 }],
  "bodies": [
    { "name": "plate", "type": "static", "position_m": [2, 0.15], "mass_kg": 100, "fixtures": [{ "shape": "box", "size_m": [3, 0.3], "material": "m" }] },
    { "name": "stick", "position_m": [2, 1.5], "angle_rad": $tilt, "velocity_m_per_s": [0, -3],
      "fixtures": [{ "shape": "box", "size_m": [0.8, 0.2], "material": "m", "camera": true }] }] }
END
    for timing in onset release; do
        "$physvib" render "$folder/stick.json" --timing $timing --steps-per-second 1000 --seed 0 --seconds 0.5 \
            --events "$folder/$timing.csv" >"$folder/report"
    done
    cat "$folder/onset.csv" "$folder/release.csv" | awk -F, -v a=$tilt '
        /^[#t]/ { ++lists[$1 ~ /^#/]; next }
        !seen[lists[1]]++ { j[lists[1]] = $10 }
        END {
            x = 0.4 * cos(a) - 0.1 * sin(a); y = 0.4 * sin(a) + 0.1 * cos(a); s = x / sqrt(x * x + y * y)
            printf "| %.1f | %.3f | %.1f | %.1f | %.3f | %.3f |\n", a, s, j[1], j[2], j[2] / j[1], sqrt(1 + 3 * s * s)
        }'
done
