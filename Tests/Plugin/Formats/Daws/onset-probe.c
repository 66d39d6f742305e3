/* SPDX-License-Identifier: GPL-3.0-or-later
   An LV2 instrument that answers each note with one sample of 0.5, at the very frame that the host names:
   when a host plays its notes. */
#include <lv2/atom/util.h>
#include <lv2/core/lv2.h>
#include <lv2/midi/midi.h>
#include <lv2/urid/urid.h>
#include <stdlib.h>
#include <string.h>

struct probe {
    const LV2_Atom_Sequence* notes;
    float* out[2];
    LV2_URID midi_event;
};

static LV2_Handle instantiate(const LV2_Descriptor* descriptor, double rate_hz, const char* bundle,
                              const LV2_Feature* const* features) {
    struct probe* probe = calloc(1, sizeof *probe);
    (void)descriptor, (void)rate_hz, (void)bundle;
    for (; *features; ++features)
        if (!strcmp((*features)->URI, LV2_URID__map)) {
            const LV2_URID_Map* map = (*features)->data;
            probe->midi_event = map->map(map->handle, LV2_MIDI__MidiEvent);
        }
    return probe;
}

static void connect_port(LV2_Handle handle, uint32_t port, void* data) {
    struct probe* probe = handle;
    if (port == 0)
        probe->notes = data;
    else
        probe->out[port - 1] = data;
}

static void run(LV2_Handle handle, uint32_t frames) {
    struct probe* probe = handle;
    for (int channel = 0; channel < 2; ++channel) memset(probe->out[channel], 0, frames * sizeof(float));
    LV2_ATOM_SEQUENCE_FOREACH(probe->notes, event) {
        const uint8_t* message = (const uint8_t*)(event + 1);
        if (event->body.type != probe->midi_event || (message[0] & 0xf0) != 0x90 || message[2] == 0) continue;
        if (event->time.frames >= frames) continue;
        for (int channel = 0; channel < 2; ++channel) probe->out[channel][event->time.frames] = 0.5F;
    }
}

static void cleanup(LV2_Handle handle) { free(handle); }

LV2_SYMBOL_EXPORT const LV2_Descriptor* lv2_descriptor(uint32_t index) {
    static const LV2_Descriptor probe = {
        "urn:physvib:test:onset-probe", instantiate, connect_port, 0, run, 0, cleanup, 0};
    return index == 0 ? &probe : 0;
}
