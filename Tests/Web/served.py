# SPDX-License-Identifier: MIT
# What the tests of the page share: its server, what it renders without a device, what was missed.
import functools
import hashlib
import http.server
import struct
import threading

failures = []


def expect(holds, what):
    print(("ok     " if holds else "FAILED ") + what, flush=True)
    if not holds:
        failures.append(what)


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *words):
        pass


def serve(folder):
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=folder))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return server


def samples_of(path):
    data = open(path, "rb").read()
    start = data.index(b"data")
    return data[start + 8:start + 8 + struct.unpack_from("<I", data, start + 4)[0]]


def hash_of(path):
    return hashlib.sha256(samples_of(path)).hexdigest()


play_out_frames = 1007  # at 48 kHz: two steps of 10 ms, and the limiter's look-ahead


def hash_in_page(browser, first, seconds):
    """What the page's own thread renders of a world, an expression, without a device: frame n is time n / rate when the play-out delay is taken out."""
    return browser.value("""(async () => {
    const rate = 48000, first = %s, channels = first.places.length, frames = rate * %d, late = %d;
    const code = await (await fetch('physvib.wasm')).arrayBuffer();
    const context = new OfflineAudioContext(8, frames + late, rate);
    await context.audioWorklet.addModule('worklet.js');
    const node = new AudioWorkletNode(context, 'physvib', { numberOfInputs: 0, outputChannelCount: [8], processorOptions: { code, first } });
    node.connect(context.destination);
    const buffer = await context.startRendering(), samples = new Float32Array(channels * frames);
    for (let j = 0; j < channels; ++j) buffer.getChannelData(j).subarray(late).forEach((value, n) => { samples[n * channels + j] = value; });
    if (!samples.some(sample => sample !== 0)) throw new Error('silence');
    return [...new Uint8Array(await crypto.subtle.digest('SHA-256', samples))].map(b => b.toString(16).padStart(2, '0')).join('');
})()""" % (first, seconds, play_out_frames))
