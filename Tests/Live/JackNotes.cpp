// SPDX-License-Identifier: GPL-3.0-or-later
// A JACK client that rolls the transport from its beginning, and sends a pattern of notes at their frames of
// the transport to a MIDI port that it waits for. Usage: physvib-jack-notes PORT SECONDS
#include "NotePattern.h"
#include <atomic>
#include <chrono>
#include <cstdio>
#include <jack/jack.h>
#include <jack/midiport.h>
#include <thread>

namespace {

struct Sender {
    jack_client_t* client = nullptr;
    jack_port_t* port = nullptr;
    std::atomic<std::int64_t> rolled{0};
    int next = 0;

    int process(jack_nframes_t count) {
        void* const out = jack_port_get_buffer(port, count);
        jack_midi_clear_buffer(out);
        jack_position_t position;
        if (jack_transport_query(client, &position) != JackTransportRolling) return 0;
        const std::int64_t first = position.frame, end = first + count;
        for (auto note = physvib::test::patternNote(next); note.frame < end;
             note = physvib::test::patternNote(++next)) {
            const jack_midi_data_t bytes[]{0x90, note.note, note.velocity};
            if (note.frame >= first)
                jack_midi_event_write(out, static_cast<jack_nframes_t>(note.frame - first), bytes,
                                      sizeof bytes);
        }
        rolled = end;
        return 0;
    }
};

void shortPause() { std::this_thread::sleep_for(std::chrono::milliseconds{5}); }

} // namespace

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    Sender sender;
    sender.client = jack_client_open("notes", JackNoStartServer, nullptr);
    if (sender.client == nullptr) return 1;
    sender.port = jack_port_register(sender.client, "out", JACK_DEFAULT_MIDI_TYPE, JackPortIsOutput, 0);
    jack_transport_stop(sender.client);
    jack_transport_locate(sender.client, 0);
    jack_set_process_callback(
        sender.client,
        [](jack_nframes_t frames, void* self) { return static_cast<Sender*>(self)->process(frames); },
        &sender);
    jack_activate(sender.client);
    int tries = 4000;
    while (jack_connect(sender.client, jack_port_name(sender.port), argv[1]) != 0 && --tries > 0)
        shortPause();
    if (tries == 0) return 1;
    std::this_thread::sleep_for(std::chrono::seconds{1}); // the host's own set-up
    jack_transport_start(sender.client);
    const auto end = static_cast<std::int64_t>(std::atof(argv[2]) * jack_get_sample_rate(sender.client));
    while (sender.rolled < end) shortPause();
    jack_transport_stop(sender.client);
    std::printf("notes sent: %d\n", sender.next);
    jack_client_close(sender.client);
    return 0;
}
