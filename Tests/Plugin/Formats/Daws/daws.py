# SPDX-License-Identifier: GPL-3.0-or-later
"""Sessions for qtractor 0.9 and MuSE 4, and what their exports hold. `daws.py session DAW FILE URI NAME` writes one with a track of notes and that LV2 instrument, for the
folder of FILE; for qtractor it may be a file .clap, and CHANNELS and physvib-plugin-bounce's FOLDER, whose state it has, may follow NAME. `daws.py compare FRAMES PROBE EXPORT...` exits 1 unless
the exports are equal and each note sounds FRAMES after the probe's. `daws.py notes PROBE` prints the frame, pitch and velocity of each note as the host plays it;
`daws.py stems OURS.raw STEM...` exits 1 unless these files of a channel each are ours."""
import base64
import struct
import sys
import zlib
from pathlib import Path

import numpy as np

RATE_HZ, BEATS_PER_SECOND, NOTES, SECONDS = 48000, 2, 24, 8
VELOCITY = 100
MOST_APART = 1e-6  # times are whole nanoseconds, a third of a frame's is not: a start at another frame turns a 300 Hz sine by 6e-7
RISE = 5  # frames until a sine that begins at 0 stands out of what still sounds
TICKS = 384  # of a quarter note, as MuSE has them: 62.5 frames each
ONSETS = [2 * (192 + 96 * k + k * 37 % 40) for k in range(NOTES)]  # in ticks; even: whole frames


def pitch(k):
    return 60 + k % 12


def midi_file():
    def length(ticks):
        data = [ticks & 127]
        while ticks := ticks >> 7:
            data.insert(0, 128 | (ticks & 127))
        return bytes(data)
    track, now = length(0) + b"\xff\x51\x03" + (1000000 // BEATS_PER_SECOND).to_bytes(3, "big"), 0
    for k, onset in enumerate(ONSETS):
        track += length(onset - now) + bytes([0x90, pitch(k), VELOCITY]) + length(80) + bytes([0x80, pitch(k), 0])
        now = onset + 80
    track += length(0) + b"\xff\x2f\x00"
    return b"MThd" + struct.pack(">IHHH", 6, 0, 1, TICKS) + b"MTrk" + struct.pack(">I", len(track)) + track


def packed(data):
    """As qtractor has states in its sessions."""
    return base64.b64encode(struct.pack(">I", len(data)) + zlib.compress(data)).decode()


def state_of(uri, bounce):
    if uri.endswith(".clap"):
        preset = Path(bounce, "state.vstpreset").read_bytes()
        return f'<config key="state">{packed(preset[48:struct.unpack("<q", preset[40:48])[0]])}</config>'
    ttl = Path(bounce, "state.lv2/state.ttl").read_bytes().replace(b"<>", b"<urn:qtractor:state>")
    return f'<config key="urn:qtractor:state#key" type="urn:qtractor:state#type">{packed(ttl)}</config>'


def qtractor(folder, uri, channels=2, bounce=None):
    """As first-track.md has it: exports have as many channels as Master, which is always the first bus."""
    kind = "CLAP" if uri.endswith(".clap") else "LV2"
    state = state_of(uri, bounce) if bounce else ""
    (folder / "notes.mid").write_bytes(midi_file())
    return f"""<!DOCTYPE qtractor-session>
<session name="notes" version="0.9.31">
 <properties><directory>{folder}</directory><sample-rate>{RATE_HZ}</sample-rate><tempo>{60 * BEATS_PER_SECOND}</tempo><ticks-per-beat>960</ticks-per-beat>
  <beats-per-bar>4</beats-per-bar><beat-divisor>2</beat-divisor></properties>
 <devices>
  <audio-engine><audio-bus name="Master" mode="duplex"><channels>{channels}</channels><auto-connect>1</auto-connect></audio-bus></audio-engine>
  <midi-engine><midi-bus name="Master" mode="duplex"/></midi-engine>
 </devices>
 <tracks><track name="notes" type="midi">
  <properties><input-bus>Master</input-bus><output-bus>Master</output-bus><midi-channel>0</midi-channel></properties>
  <state><gain>1</gain><panning>0</panning></state>
  <clips><clip name="notes"><properties><name>notes</name><start>0</start><offset>0</offset><length>{SECONDS * RATE_HZ}</length><gain>1</gain></properties>
   <midi-clip><filename>notes.mid</filename><track-channel>0</track-channel></midi-clip></clip></clips>
  <plugins><plugin type="{kind}"><filename>{uri}</filename><index>0</index><activated>1</activated><configs>{state}</configs></plugin></plugins>
 </track></tracks>
</session>
"""


def muse(uri, name):
    notes = "".join(f'<event tick="{onset}" len="80" a="{pitch(k)}" b="{VELOCITY}"/>' for k, onset in enumerate(ONSETS))
    end = SECONDS * BEATS_PER_SECOND * TICKS
    return f"""<?xml version="1.0"?>
<muse version="3.3">
 <configuration><sequencer><midiport idx="0"><defaultInChans>1</defaultInChans><trackIdx>1</trackIdx><name>{name}-0</name></midiport></sequencer></configuration>
 <song><rpos>{end}</rpos><lpos>0</lpos><master>1</master><len>{2 * end}</len><midiDivision>{TICKS}</midiDivision><sampleRate>{RATE_HZ}</sampleRate>
  <AudioOutput><name>Out 1</name><channels>2</channels><gain>1</gain></AudioOutput>
  <SynthI><name>{name}-0</name><channels>2</channels><gain>1</gain><synthType>LV2 (synths)</synthType><uri>{uri}</uri><label>{name}</label><port>0</port></SynthI>
  <miditrack><name>notes</name><device>0</device><channel>0</channel><len>100</len><compression>100</compression>
   <part><name>notes</name><poslen tick="0" len="{end}"/>{notes}</part></miditrack>
  <Route><source track="1"/><dest track="0"/></Route>
  <tempolist fix="500000"><tempo at="21474837"><tick>0</tick><val>{1000000 // BEATS_PER_SECOND}</val></tempo></tempolist>
  <siglist><sig at="21474836"><tick>0</tick><nom>4</nom><denom>4</denom></sig></siglist>
 </song>
</muse>
"""


def samples(path):
    data, at, width = Path(path).read_bytes(), 12, 0
    while at + 8 <= len(data):
        kind, size = data[at:at + 4], struct.unpack("<I", data[at + 4:at + 8])[0]
        if kind == b"fmt ":
            channels, width = struct.unpack("<H", data[at + 10:at + 12])[0], struct.unpack("<H", data[at + 22:at + 24])[0]
        if kind == b"data":
            values = np.frombuffer(data[at + 8:at + 8 + size], "<f4" if width == 32 else "<i2").astype(float) / (1 if width == 32 else 32768)
            return values.reshape(-1, channels)
        at += 8 + size + size % 2
    sys.exit(f"{path}: expected samples")


def onsets(signal):
    """Frames at which it is anything but silent or falling: a sample above all of the 500 before it."""
    size = np.abs(signal).max(axis=1)
    loud = np.flatnonzero(size > 0.002)
    found = []
    for frame in loud:
        if not found or frame - found[-1] > 2000:
            if size[frame] > 1.02 * size[max(0, frame - 500):frame].max(initial=0):
                found.append(int(frame))
    return found


def notes(probe):
    for k, frame in enumerate(onsets(samples(probe))):
        print(frame, pitch(k), VELOCITY)


def stems(ours, paths):
    rendered = np.fromfile(ours, "<f4").reshape(-1, len(paths))
    failed = 0
    for channel, path in enumerate(paths):
        stem = samples(path)[:, 0]
        equal = np.count_nonzero(stem == rendered[:len(stem), channel])
        failed |= equal < len(stem)
        print(f"{Path(path).name}: {equal} of {len(stem)} samples are ours; peak {np.abs(stem).max():.3f}")
    return failed


def compare(told, probe, exports):
    host = onsets(samples(probe))
    behind = [h - o * RATE_HZ // (BEATS_PER_SECOND * TICKS) for h, o in zip(host, ONSETS)]
    print(f"{len(host)} of {NOTES} notes; the host plays them {min(behind)} to {max(behind)} frames behind their place")
    all_of_them = [samples(export) for export in exports]
    apart = max(np.abs(all_of_them[0] - other).max() for other in all_of_them)
    late = [found - played for found, played in zip(onsets(all_of_them[0]), host)]
    print(f"{len(exports)} exports differ by {apart:.1e}; heard {min(late)} to {max(late)} frames after the probe ({told} told); peak {np.abs(all_of_them[0]).max():.3f}")
    return 0 if len(host) == NOTES == len(late) and apart < MOST_APART and told <= min(late) and max(late) < told + RISE else 1


if __name__ == "__main__":
    task, *words = sys.argv[1:]
    if task == "session":
        daw, file, uri, name, *more = words
        text = qtractor(Path(file).resolve().parent, uri, *more) if daw == "qtractor" else muse(uri, name)
        Path(file).write_text(text, encoding="utf-8")
    elif task == "notes":
        notes(words[0])
    elif task == "stems":
        sys.exit(stems(words[0], words[1:]))
    else:
        sys.exit(compare(int(words[0]), words[1], words[2:]))
