#!/bin/sh
# SPDX-License-Identifier: MIT
# Linux' own sound driver judges the Pico: Debian's kernel in QEMU uses the emulated board by USB/IP: pico-linux.sh [SECONDS (10)].
# It lists the card with its volume controls, which `amixer` sets; `lsusb` reads the descriptors; `aplay` plays the scene shake-the-box to its end,
# and every frame at the pins is compared with what was sent. Needs what pico.sh needs. All of it is kept: build/pico-linux-CHANNELS.log.
set -eu
cd "$(dirname "$0")/../.."
. .ci/packages.sh
. Tests/Firmware/pico/prepare.sh
port=3240
# shellcheck disable=SC2086 # a list of words
ensure_packages $physvib_pico_linux_packages

# A system in memory: the kernel, its modules for USB/IP and sound, and the programs that ask.
root=$folder/root
mkdir -p "$folder/debs" "$root/dev" "$root/proc" "$root/sys" "$root/tmp"
from_debian "$folder/debs" download linux-image-amd64
kernel=$(dpkg-deb -f "$folder"/debs/linux-image-amd64_*.deb Depends | sed 's/ .*//')
# shellcheck disable=SC2086 # a list of words
from_debian "$folder/debs" download "$kernel" $physvib_pico_linux_guest
for archive in "$folder"/debs/*.deb; do dpkg-deb -x "$archive" "$root"; done
mv "$root"/boot/vmlinuz-* "$folder/vmlinuz"
kernel=${kernel#linux-image-}

mkdir -p "$folder/all/lib" && mv "$root/lib/modules" "$folder/all/lib"
depmod -b "$folder/all" "$kernel"
for module in e1000 vhci-hcd snd-usb-audio; do /sbin/modprobe -d "$folder/all" -S "$kernel" --show-depends $module; done |
    sed -n "s|^insmod $folder/all||p" | sort -u | while read -r file; do install -D -m 644 "$folder/all$file" "$root$file"; done
depmod -b "$root" "$kernel" 2>/dev/null
rm -rf "$root/boot" "$root/usr/share/doc"
install -m 755 $here/guest.sh "$root/init"
for channels in 4 8; do
    image=$images/physvib-pico$channels.bin
    /usr/bin/python3 $here/wav.py "$folder/scene$channels.raw" $channels "$root/play.wav"
    (cd "$root" && find . | cpio -o -H newc --quiet | gzip -1) >"$folder/initrd"
    log=build/pico-linux-$channels.log
    qemu-system-x86_64 -machine pc -cpu max -accel tcg -smp 1 -m 768 -display none -serial "file:$log" -monitor none -no-reboot \
        -qmp "unix:$folder/qmp,server,nowait" -nic user,model=e1000 -kernel "$folder/vmlinuz" -initrd "$folder/initrd" -append "console=ttyS0 quiet" &
    guest=$!
    for _ in 1 2 3 4 5 6 7 8 9 10; do [ ! -S "$folder/qmp" ] || break; sleep 1; done
    is_equal=1
    timeout 1200 node $here/usbip.mjs "$image" $channels "$folder/expected" "$folder/qmp" $port >"$folder/result" || is_equal=0
    [ $is_equal = 1 ] || kill $guest
    wait $guest || :
    tee -a "$log" <"$folder/result"
    [ $is_equal = 1 ] || { say "$log: not all frames are equal at the pins"; exit 1; }
    # What has to stand in the log, and what is wrong if it does not.
    while IFS='|' read -r line wrong; do
        grep -q -E "$line" "$log" || { say "$log: $wrong"; exit 1; }
    done <<END
aplay: 0|aplay did not play to the end
Channels: $channels|Linux does not list $channels channels
iProduct .*PhysVib pico$channels|lsusb does not read the product's name
bInterfaceProtocol +32|lsusb does not find an Audio Class 2 interface
Synch Type +Asynchronous|lsusb does not find the asynchronous endpoint
Usage Type +Feedback|lsusb does not find the feedback endpoint
amixer: set|amixer does not set a volume for each channel
volumes set: 1 -9.5 dB.* $channels -$(awk "BEGIN { print (20 - $channels) / 2 }") dB|the board was not told each channel's volume
END
done
say "pico-linux.sh: all of it held"
