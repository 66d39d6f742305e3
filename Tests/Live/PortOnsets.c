/* SPDX-License-Identifier: GPL-3.0-or-later */
/* When a hit leaves a JACK server, in the session time of what plays it: a library, for programs in any
 * language. */
#include <jack/jack.h>
#include <math.h>
#include <physvib/physvib-live.h>
#include <stdio.h>

enum { ports = 4, most = 4096, silent = 2400 }; /* frames of silence before an onset: 50 ms */

static jack_client_t* client;
static jack_port_t* inputs[ports];
static physvib_int64 times[most];
static physvib_live heard;
static volatile int count;
static int quiet, device;

/* The cycle's order is the graph's: the session has just rendered these frames. */
static int process(jack_nframes_t frames, void* rate) {
    const physvib_int64 end = physvib_live_now_ns(heard);
    jack_nframes_t n;
    int j;
    for (n = 0; n < frames; ++n) {
        int loud = 0;
        for (j = 0; j < ports; ++j)
            loud |= fabsf(((const float*)jack_port_get_buffer(inputs[j], frames))[n]) > 0.0005f;
        if (loud && quiet >= silent && count < most)
            times[count++] = end - (physvib_int64)((frames - n) * 1e9 / *(const double*)rate);
        quiet = loud ? 0 : quiet + 1;
    }
    return 0;
}

/* 0: from now on it is heard, on the server's first outputs. */
int door_listen(physvib_live live) {
    static double rate;
    jack_latency_range_t range;
    char name[64];
    int j;
    client = jack_client_open("onsets", JackNoStartServer, NULL);
    if (client == NULL) return 1;
    heard = live, rate = jack_get_sample_rate(client);
    for (j = 0; j < ports; ++j) {
        snprintf(name, sizeof name, "in_%d", j + 1);
        inputs[j] = jack_port_register(client, name, JACK_DEFAULT_AUDIO_TYPE, JackPortIsInput, 0);
    }
    if (jack_set_process_callback(client, process, &rate) != 0 || jack_activate(client) != 0) return 1;
    for (j = 0; j < ports; ++j) {
        snprintf(name, sizeof name, "physvib:out_%d", j + 1);
        if (jack_connect(client, name, jack_port_name(inputs[j])) != 0) return 1;
    }
    jack_port_get_latency_range(jack_port_by_name(client, "system:playback_1"), JackPlaybackLatency, &range);
    device = (int)(range.max * 1e9 / rate);
    return 0;
}

/* Before the session is closed, whose clock is read. */
void door_leave(void) { jack_client_close(client); }

/* The k-th onset, with the device's own latency; 0: not yet. */
physvib_int64 door_onset(int k) { return k < count ? times[k] + device : 0; }
