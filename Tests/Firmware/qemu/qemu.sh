#!/bin/sh
# SPDX-License-Identifier: MIT
# A second emulator, written by others, on the kernel's bits: the same list on this computer and on QEMU's Cortex-M4F (netduinoplus2).
# Needs qemu-system-arm and gcc-arm-none-eabi.
set -eu
cd "$(dirname "$0")/../../.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
sources="Tests/Firmware/qemu/kernel.cpp Source/Core/BoardRenderer.cpp Source/Core/Modes/MovingSegments.cpp Source/Core/Modes/PhasorBank.cpp"
common="-std=c++20 -O2 -ffp-contract=off -ISource -Wno-register"
# shellcheck disable=SC2086 # lists of words
g++ $common $sources -o "$folder/here"
# shellcheck disable=SC2086
arm-none-eabi-g++ $common -mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard -ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics \
    -fno-math-errno -nostartfiles --specs=nano.specs -Wl,--no-warn-rwx-segments -Wl,-T,Tests/Firmware/qemu/netduinoplus2.ld $sources -o "$folder/there.elf"
"$folder/here" >"$folder/here.txt"
timeout 120 qemu-system-arm -machine netduinoplus2 -nographic -semihosting -kernel "$folder/there.elf" >"$folder/there.txt" 2>&1 </dev/null
echo "this computer: $(cat "$folder/here.txt")"
echo "QEMU:          $(cat "$folder/there.txt")"
cmp "$folder/here.txt" "$folder/there.txt"
