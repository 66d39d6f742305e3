# SPDX-License-Identifier: MIT
"""Puts frames of 16-bit samples into a WAV file: wav.py FRAMES.raw CHANNELS OUT.wav."""
import sys
import wave

with wave.open(sys.argv[3], "wb") as out, open(sys.argv[1], "rb") as frames:
    out.setnchannels(int(sys.argv[2]))
    out.setsampwidth(2)
    out.setframerate(48000)
    out.writeframes(frames.read())
