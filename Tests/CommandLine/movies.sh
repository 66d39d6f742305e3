#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# What `render --movie` makes by ffmpeg itself: pictures, their rate, their length, and the audio of the contacts. Installs ffmpeg.
# Usage: movies.sh PHYSVIB [FOLDER, to keep the movies]
set -eu
. "$(dirname "$0")/../../.ci/packages.sh"
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_movie_packages
physvib=$(realpath "$1")
made=${2:-$(mktemp -d)}
[ $# -gt 1 ] || trap 'rm -rf "$made"' EXIT
cd "$made"
for kind in mp4 gif; do "$physvib" render drop --seconds 2 --movie drop.$kind >/dev/null; done
tell() { ffprobe -v error -show_entries "$2" -of csv=p=0 "$1" | tr '\n' ' '; }
expect() { [ "$1" = "$2" ] || { echo "movies: expected \"$2\", found \"$1\"" && exit 1; }; }
expect "$(tell drop.mp4 stream=codec_name,width,height,r_frame_rate)" "h264,960,640,20/1 aac,0/0 "
expect "$(tell drop.gif stream=codec_name,width,height,r_frame_rate)" "gif,960,640,20/1 "
expect "$(tell drop.gif format=duration)" "2.000000 "
ffmpeg -v error -nostdin -i drop.mp4 -ac 1 -f f32le -y heard # not silent: the object lands after 0.78 s
expect "$(od -An -v -t f4 -w4 heard | awk '{ if ($1 < 0) $1 = -$1; if ($1 > most) most = $1; if ($1 > 0.005 && !first) first = NR } END { print (most > 0.005 && first > 0.7 * 44100 && first < 0.9 * 48000) }')" 1
mkdir limited # for ffmpeg alone the disk is full
printf '#!/bin/sh\ntrap "" XFSZ\nulimit -f 40\nexec %s "$@"\n' "$(command -v ffmpeg)" >limited/ffmpeg
chmod +x limited/ffmpeg
for kind in mp4 gif; do
    expect "$(PATH="$PWD/limited:$PATH" "$physvib" render shake-the-box --seconds 3 --movie full.$kind 2>&1 >/dev/null | grep -c "full.$kind: ffmpeg failed: .*File too large")" 1
    expect "$(ls | grep full || :)" ""
done
echo "movies: an MP4 with audio and a GIF, two seconds each; none on a full disk"
