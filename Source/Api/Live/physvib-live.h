/* SPDX-License-Identifier: GPL-3.0-or-later */
/* PhysVib on a device, for any language: strikes and contacts in, haptics out. C89 and later, C++.
 *
 * Link libphysvib-live, which is GPL (it has JUCE in it), and libphysvib. Results, units and the words "any thread" and "one at a time" are those
 * of physvib.h; what an error was about is told by physvib_live_error(). Nothing here is for an audio callback: the device has one of
 * its own, in which nothing allocates, locks or waits.
 *
 * Time. physvib_live_now_ns() is session time, and goes on by the device's blocks. What is struck at session time t leaves for the device
 * at t + L, always, to a fraction of a frame; L is physvib_live_latency_ns(). A device comes up silent and in a ramp, at -12 dB. */
#ifndef PHYSVIB_LIVE_H
#define PHYSVIB_LIVE_H
#include <physvib/physvib.h>

#ifdef __cplusplus
extern "C" {
#endif

#define PHYSVIB_ERROR_DEVICE (-9) /* not there, or does not start */

typedef struct physvib_live_name *physvib_live;

typedef struct physvib_live_settings {
    size_t size;
    int rate_hz, block_frames; /* 0: as the device stands (0) */
    int steps_per_s;           /* of your world: 20 to 1,000 (100) */
    double longest_gap_s;      /* for which the thread that strikes may be silent and be in time: 0 to 1 (0.026) */
    double level_db;           /* of all: -90 to 0 (-12) */
} physvib_live_settings;

typedef struct physvib_live_status {
    size_t size;
    int is_running, is_silent, rate_hz, block_frames, live_modes;
    int losses; /* times the device had gone and was opened again */
    int xruns;  /* as the device counts them; -1: it does not */
    double load, worst_load; /* of a block: time taken by time that it lasts */
    physvib_int64 played;    /* events struck */
    physvib_int64 late;      /* of these: after their time, at once */
    physvib_int64 rejected;  /* could not be played */
    char trouble[256];       /* what is missing, one line; "": nothing */
} physvib_live_status;

/* As physvib_error(), of the functions here. Any thread. */
PHYSVIB_API const char *physvib_live_error(void);

PHYSVIB_API int physvib_live_settings_init(physvib_live_settings *settings);
PHYSVIB_API int physvib_live_status_init(physvib_live_status *status);

/* Opens that device, "JACK:system" for instance, and no other (`physvib devices` lists them); enchanter j is its output j. Of `renderer`
 * the layout, channels, law, exponent, field and limiter are taken; it and `settings` may be NULL: as init has them. One live at a time.
 * A device that goes is waited for, and opened again. Any thread; waits for the device. */
PHYSVIB_API int physvib_live_open(const char *device, const physvib_renderer_settings *renderer, const physvib_live_settings *settings, physvib_live *live);
/* Silent within two blocks, then closed; waits for both. At the end of a program what is open is closed. Any thread. */
PHYSVIB_API int physvib_live_close(physvib_live live);

/* Session time, and L. Any thread. */
PHYSVIB_API physvib_int64 physvib_live_now_ns(physvib_live live);
PHYSVIB_API physvib_int64 physvib_live_latency_ns(physvib_live live);

/* Events at session times; those that are over are played at once, and counted as late if L is over too. Any thread. */
PHYSVIB_API int physvib_live_strike(physvib_live live, const physvib_event *events, physvib_int64 count);
/* The events of a world (as physvib_world_take), whose time 0 is session time `start_ns`. How many. Any thread; one at a time per world. */
PHYSVIB_API physvib_int64 physvib_live_send(physvib_live live, physvib_world world, physvib_int64 start_ns, int at_once);

/* At session time; felt L later. Gains from 0 to 10,000; they glide for 10 ms. PHYSVIB_ERROR_FULL: 256 changes are waiting. Any thread. */
PHYSVIB_API int physvib_live_set_gain(physvib_live live, int channel, double gain);
PHYSVIB_API int physvib_live_set_mute(physvib_live live, int channel, int is_muted);
/* At most as many enchanters as channels. Of `renderer` the layout, law, exponent and field are taken. */
PHYSVIB_API int physvib_live_set_layout(physvib_live live, const physvib_renderer_settings *renderer);

/* At once, in a ramp: the level of all, -90 to 0 dB; silence within a block. Any thread, wait-free. */
PHYSVIB_API int physvib_live_set_level(physvib_live live, double level_db);
PHYSVIB_API int physvib_live_silence(physvib_live live, int is_silent);

/* As it was 20 ms ago at most. Any thread. */
PHYSVIB_API int physvib_live_get_status(physvib_live live, physvib_live_status *status);

#ifdef __cplusplus
}
#endif
#endif
