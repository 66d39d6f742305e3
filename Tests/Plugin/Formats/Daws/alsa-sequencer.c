/* SPDX-License-Identifier: GPL-3.0-or-later
   An ALSA sequencer that takes everything and plays nothing, for hosts that refuse to start without one
   (qtractor): where a kernel has none, LD_PRELOAD it. */
#include <alsa/asoundlib.h>
#include <errno.h>

static int sequencer, ports;

#define TAKES(name, ...)                                                                                     \
    int snd_seq_##name(snd_seq_t* seq, ##__VA_ARGS__) {                                                      \
        (void)seq;                                                                                           \
        return 0;                                                                                            \
    }
#define HAS_NONE(name, ...)                                                                                  \
    int snd_seq_##name(snd_seq_t* seq, ##__VA_ARGS__) {                                                      \
        (void)seq;                                                                                           \
        return -ENOENT;                                                                                      \
    }
#pragma GCC diagnostic ignored "-Wunused-parameter"

int snd_seq_open(snd_seq_t** seq, const char* name, int streams, int mode) {
    *seq = (snd_seq_t*)&sequencer;
    return 0;
}
int snd_seq_client_id(snd_seq_t* seq) { return 128; }
int snd_seq_alloc_queue(snd_seq_t* seq) { return 1; }
int snd_seq_create_simple_port(snd_seq_t* seq, const char* name, unsigned caps, unsigned type) {
    return ports++;
}
int snd_seq_event_input(snd_seq_t* seq, snd_seq_event_t** event) { return -EAGAIN; }

TAKES(close)
TAKES(free_queue, int queue)
TAKES(control_queue, int queue, int type, int value, snd_seq_event_t* event)
TAKES(delete_simple_port, int port)
TAKES(drain_output)
TAKES(drop_input)
TAKES(drop_output)
TAKES(event_input_pending, int fetch)
TAKES(event_output, snd_seq_event_t* event)
TAKES(event_output_direct, snd_seq_event_t* event)
TAKES(get_port_info, int port, snd_seq_port_info_t* info)
TAKES(set_port_info, int port, snd_seq_port_info_t* info)
TAKES(get_queue_status, int queue, snd_seq_queue_status_t* status)
TAKES(get_queue_tempo, int queue, snd_seq_queue_tempo_t* tempo)
TAKES(set_queue_tempo, int queue, snd_seq_queue_tempo_t* tempo)
TAKES(set_queue_timer, int queue, snd_seq_queue_timer_t* timer)
TAKES(poll_descriptors, struct pollfd* fds, unsigned count, short events)
TAKES(poll_descriptors_count, short events)
TAKES(remove_events, snd_seq_remove_events_t* events)
TAKES(set_client_name, const char* name)
TAKES(subscribe_port, snd_seq_port_subscribe_t* subscription)
TAKES(unsubscribe_port, snd_seq_port_subscribe_t* subscription)
HAS_NONE(get_any_client_info, int client, snd_seq_client_info_t* info)
HAS_NONE(get_any_port_info, int client, int port, snd_seq_port_info_t* info)
HAS_NONE(query_next_client, snd_seq_client_info_t* info)
HAS_NONE(query_next_port, snd_seq_port_info_t* info)
HAS_NONE(query_port_subscribers, snd_seq_query_subscribe_t* query)
