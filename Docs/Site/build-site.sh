#!/bin/sh
# SPDX-License-Identifier: MIT
# All pages and the reference as one folder of static files, which any browser opens from the disk. A link that leads nowhere is an error.
# With PAGE, what Standalone/Web/build-web.sh has built, the first screen leads to it; it needs a web server.
# usage: Docs/Site/build-site.sh FOLDER [PAGE]
set -eu
into=$(realpath -m "${1:?usage: Docs/Site/build-site.sh FOLDER [PAGE]}")
page=${2:+$(realpath "$2")}
cd "$(dirname "$0")/../.."
. .ci/packages.sh
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_site_packages
python3 Docs/Site/site.py "$into" ${page:+"$page"}
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
{ # as the tests make it; without the moment of its making
    cat Docs/Doxyfile
    echo "OUTPUT_DIRECTORY=$made"
    echo "HTML_TIMESTAMP=NO"
} | doxygen -
mkdir -p "$into/reference"
cp -r "$made/html/." "$into/reference"
say "$into/index.html"
