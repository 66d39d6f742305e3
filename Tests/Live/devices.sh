#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Two worlds on four devices at once: what the sound device got is a render of its own events to the bit; devices.py judges the others.
# Usage: devices.sh LIBPHYSVIB_LIVE BIN_FOLDER SECONDS VIRTUAL_BOARD IMAGE.elf
exec "$(dirname "$0")/library.sh" "$1" "$2" "$3" sh -c 'exec /usr/bin/python3 "$0" "$3" "$4" "$1" "$2"' "$(dirname "$0")/devices.py" "$4" "$5"
