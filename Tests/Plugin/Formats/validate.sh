#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Public validators, by hand: lv2_validate on each LV2 bundle; and, if it is given, the validator of Steinberg's VST3 SDK
# (samples/vst-hosting/validator there) on each VST3, with all its tests.
# Usage: validate.sh BUILD_FOLDER [VST3_VALIDATOR]; 77: lv2_validate is not installed (physvib_validator_packages in .ci/packages.sh)
set -eu
plugins=$(realpath "$1")/plugins
command -v lv2_validate >/dev/null || { echo "skipped: lv2_validate (Debian package lv2-dev) is not installed"; exit 77; }
for bundle in "$plugins"/*.lv2; do
    printf '%s: ' "$(basename "$bundle")"
    lv2_validate "$bundle"/*.ttl 2>&1 | grep '^Found\|rror'
done
[ $# -ge 2 ] || exit 0
for module in "$plugins"/*.vst3; do
    printf '%s: ' "$(basename "$module")"
    "$2" -e "$module" 2>&1 | grep '^Result' || { echo "no result"; exit 1; }
done
