#!/bin/busybox sh
# SPDX-License-Identifier: MIT
# Runs in the machine that pico-linux.sh starts: attaches the board by USB/IP, asks the system what it sees, plays.
/bin/busybox --install -s /bin
mount -t proc p /proc
mount -t sysfs s /sys
mount -t devtmpfs d /dev
export PATH=/bin:/sbin:/usr/bin:/usr/sbin
mkdir -p /var/run
uname -sr
for module in e1000 vhci-hcd snd-usb-audio; do /sbin/modprobe $module; done
ifconfig lo up
ifconfig eth0 10.0.2.15 netmask 255.255.255.0 up
sleep 1
usbip attach -r 10.0.2.2 -b 1-1
for _ in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do [ ! -e /proc/asound/card0/stream0 ] || break; sleep 1; done
cat /proc/asound/cards /proc/asound/card0/stream0
lsusb -v -d cafe: 2>&1 || lsusb
amixer -c 0 contents
# Another volume for each channel (half a decibel per step below full), then all full again. Linux calls the one with a value per channel PCM.
channels=$(sed -n 's/.*Channels: //p' /proc/asound/card0/stream0 | head -1)
volumes=$(seq -s , 101 $((100 + channels)))
amixer -c 0 cset 'name=PCM Playback Volume' "$volumes" && amixer -c 0 cget 'name=PCM Playback Volume' | grep "values=$volumes" && echo "amixer: set"
amixer -q -c 0 cset 'name=PCM Playback Volume' 120
aplay -D hw:0 /play.wav
echo "aplay: $?"
dmesg | grep -i -E 'usb 1|usb-audio|vhci|snd' | tail -20
usbip detach -p 0
sync
poweroff -f
