#!/bin/sh
# SPDX-License-Identifier: MIT
# next.sh ROOT BIN_FOLDER: what run.sh tells to type next is typed, with programs that are built already, and is what it says: the same is felt. With a
# display it ends in the mixer, without one it says how to get to `physvib`. Who cannot install is told what to do, and asked for a password once.
set -eu
root=$1 bin=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/.ci" "$folder/build/first/bin" "$folder/build/release/bin" "$folder/sudo"
cp "$root/run.sh" "$folder"
printf '%s\n' ". '$root/.ci/packages.sh'" 'ensure_packages() { :; }' 'ensure_build_packages() { :; }' 'build() { :; }' 'say() { :; }' >"$folder/.ci/packages.sh"
cp "$bin/physvib-render" "$folder/build/first/bin"
printf '#!/bin/sh\necho "the mixer is open"\n' >"$folder/build/release/bin/physvib-mixer"
chmod +x "$folder/build/release/bin/physvib-mixer"
cp "$folder/build/release/bin/physvib-mixer" "$folder/build/release/bin/physvib"
cd "$folder"
DISPLAY='' ./run.sh >told
next=$(sed -n 's/  renders a list of impacts.*//p' told)
[ -n "$next" ] || { cat told && echo "run.sh names no line to type next" && exit 1; }
sh -euc "$next"
for file in shake-the-box again; do python3 "$root/Tests/Docs/felt.py" out/$file.wav 0.148 0.092 0.295 0.235; done
grep -q 'the mixer was not built. ./run.sh physvib' told
DISPLAY=:0 ./run.sh | tail -n 1 | grep -qx 'the mixer is open'
./run.sh physvib | grep -qx 'build/release/bin/physvib'

cat >sudo/sudo <<'SUDO'
#!/bin/sh
[ "$1" = -n ] || echo "password?" >&2
exit 1
SUDO
printf '#!/bin/sh\necho 1000\n' >sudo/id # nobody's
chmod +x sudo/sudo sudo/id
# shellcheck disable=SC2016 # of the inner shell
if PATH="$folder/sudo:$PATH" sh -c '. "$1/.ci/packages.sh"; ensure_packages no-such-package' sh "$root" 2>refused; then exit 1; fi
[ "$(grep -c 'password?' refused)" = 1 ] && grep -q 'apt-get install --no-install-recommends no-such-package' refused || { cat refused && exit 1; }
