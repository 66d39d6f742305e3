#!/bin/sh
# SPDX-License-Identifier: MIT
# names.sh ROOT: packages by the names that a Debian has for them, and what cannot be had is told before anything is installed: with an apt of our own
# that knows what a file names, and installs nothing.
set -eu
root=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/bin"
cat >"$folder/bin/apt-cache" <<'APT'
#!/bin/sh
shift # policy
for name in "$@"; do ! grep -qxF -e "$name" known || printf '%s:\n  Installed: (none)\n  Candidate: 1\n' "$name"; done
APT
cat >"$folder/bin/apt-get" <<'APT'
#!/bin/sh
echo "$*" >>asked
APT
printf '#!/bin/sh\necho 0\n' >"$folder/bin/id"
chmod +x "$folder"/bin/*
cd "$folder"
export PATH="$folder/bin:$PATH"
. "$root/.ci/packages.sh"
is_installed() { [ "$1" = there ]; }
# expect WANTED-INSTALL-WORDS WANTED-SAYS KNOWN -- NAME...
expect() {
    install=$1 says=$2
    printf '%s\n' $3 >known
    shift 3
    : >asked
    ensure_packages "$@" 2>said || :
    found=$(sed -n 's/.*--no-install-recommends *//p' asked | tail -n 1)
    [ "$found" = "$install" ] && echo "end" >>said && grep -q -e "$says" said || { echo "of $*: installed \"$found\", not \"$install\"; said:" && cat said && exit 1; }
}
expect "clang-format-14 plain" "to be installed: clang-format-14 plain" "clang-format-14 plain" clang-format-14 there plain
expect "plain" "to be installed: plain" "plain clang-format-19" clang-format-14 plain
expect "mono-devel" "to be installed: mono-devel" "mono-devel" mono-mcs
expect "" "no package mono-mcs or mono-devel here" "plain" plain mono-mcs
expect "" "no package libone here" "" libone
expect "" "" "" there clang-format-14
