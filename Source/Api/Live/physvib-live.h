/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file
 * PhysVib on a device or a board, for any language: strikes and contacts in, haptics out; and its session files. C89 and later, C++.
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

#define PHYSVIB_ERROR_DEVICE (-9) /**< not there, or does not start; also of a board */

typedef struct physvib_live_name *physvib_live;       /**< a device, a board or both, open */
typedef struct physvib_session_name *physvib_session; /**< a session that can be rendered; it does not change */

/** How it is opened. */
typedef struct physvib_live_settings {
    size_t size;          /**< set by init */
    int rate_hz;          /**< 0: as the device stands (0) */
    int block_frames;     /**< 0: as the device stands (0) */
    int steps_per_s;      /**< of your world: 20 to 1,000 (100) */
    double longest_gap_s; /**< for which the thread that strikes may be silent and be in time: 0 to 1 (0.026) */
    double level_db;      /**< of all: -90 to 0 (-12) */
    char save[1024];      /**< a session file (.json, UTF-8) of all that is struck, written while it plays, a list of its events beside it; "": none ("") */
} physvib_live_settings;

#define PHYSVIB_BOARD_NONE 0   /**< none was asked for */
#define PHYSVIB_BOARD_SOUGHT 1 /**< it has gone, and is looked for */
#define PHYSVIB_BOARD_PLAYS 2  /**< what is struck */

/** What it does, and what is wrong. */
typedef struct physvib_live_status {
    size_t size;            /**< set by init */
    int is_running;         /**< 1: the device asks for blocks */
    int is_silent;          /**< 1: by physvib_live_silence() */
    int rate_hz;            /**< of the device */
    int block_frames;       /**< of the device */
    int live_modes;         /**< that ring */
    int losses;             /**< times the device had gone and was opened again */
    int xruns;              /**< as the device counts them; -1: it does not */
    double load;            /**< of the last block: time taken by time that it lasts */
    double worst_load;      /**< of all blocks */
    physvib_int64 played;   /**< events struck */
    physvib_int64 late;     /**< of these: after their time, at once */
    physvib_int64 rejected; /**< could not be played */
    char trouble[256];      /**< what is missing, one line; "": nothing */
    int board;              /**< PHYSVIB_BOARD_NONE and so on */
    int unused;             /**< 0 */
    physvib_int64 board_sent; /**< strikes on their way to the board, so far */
    physvib_int64 board_lost; /**< of what was struck: more than the line carries, too old, or not playable there */
} physvib_live_status;

/** As physvib_error(), of the functions here. Any thread. */
PHYSVIB_API const char *physvib_live_error(void);

/** As it begins; `size`: sizeof *settings. Any thread. */
PHYSVIB_API int physvib_live_settings_init(physvib_live_settings *settings, size_t size);
/** Empty; `size`: sizeof *status. Any thread. */
PHYSVIB_API int physvib_live_status_init(physvib_live_status *status, size_t size);

/** Opens "JACK:system", for instance: that device and no other (`physvib devices` lists them), enchanter j being its output j. Or a
 * four-channel board, "BOARD:auto" or "BOARD:/dev/ttyACM0"; or both, felt at the same moment: "JACK:system+BOARD:auto". "None:no device" plays in time for nobody. Of
 * `renderer` the layout, channels, law, exponent, field and limiter are taken; it and `settings` may be NULL: as init has them. One live at
 * a time. A device or board that goes is waited for, and opened again. PHYSVIB_ERROR_DEVICE, PHYSVIB_ERROR_FULL. Any thread; waits for
 * the device, and for a board that starts. */
PHYSVIB_API int physvib_live_open(const char *device, const physvib_renderer_settings *renderer, const physvib_live_settings *settings, physvib_live *live);
/** Silent within two blocks, then closed, also if an error is returned: PHYSVIB_ERROR_FILE, not all of the session is saved. Waits for both. At
 * the end of a program what is open is closed. Any thread. */
PHYSVIB_API int physvib_live_close(physvib_live live);

/** Session time. Any thread. */
PHYSVIB_API physvib_int64 physvib_live_now_ns(physvib_live live);
/** L: how long after their session times events leave for the device. Any thread. */
PHYSVIB_API physvib_int64 physvib_live_latency_ns(physvib_live live);

/** Events at session times, in any order; those that are over are played at once, and counted as late if L is over too. All of them or, if one
 * cannot be played, none. PHYSVIB_ERROR_FULL: 65,536 wait for their time. Any thread. */
PHYSVIB_API int physvib_live_strike(physvib_live live, const physvib_event *events, physvib_int64 count);
/** For a world that is stepped as time goes on: `*start_ns`, at first 0, becomes the session time of the world's time 0, and stays so for as long
 * as the world is within `longest_gap_s` of session time. If it has been held up, or runs ahead, it is set anew. Any thread; one at a time per world. */
PHYSVIB_API int physvib_live_align(physvib_live live, physvib_world world, physvib_int64 *start_ns);
/** The events of a world (as physvib_world_take), whose time 0 is session time `start_ns`. How many. Any thread; one at a time per world. */
PHYSVIB_API physvib_int64 physvib_live_send(physvib_live live, physvib_world world, physvib_int64 start_ns, int at_once);

/** From session time on, felt L later: `gain` from 0 to 10,000, in a glide of 10 ms. PHYSVIB_ERROR_FULL: 256 changes are waiting. Any thread. */
PHYSVIB_API int physvib_live_set_gain(physvib_live live, int channel, double gain);
/** From session time on, felt L later; as physvib_live_set_gain(). Any thread. */
PHYSVIB_API int physvib_live_set_mute(physvib_live live, int channel, int is_muted);
/** From session time on: at most as many enchanters as channels. Of `renderer` the layout, law, exponent and field are taken. PHYSVIB_ERROR_FULL. Any thread. */
PHYSVIB_API int physvib_live_set_layout(physvib_live live, const physvib_renderer_settings *renderer);

/** At once, in a ramp: the level of all, -90 to 0 dB. Any thread. */
PHYSVIB_API int physvib_live_set_level(physvib_live live, double level_db);
/** Within a block; back in a ramp. Any thread. */
PHYSVIB_API int physvib_live_silence(physvib_live live, int is_silent);

/** As it was 20 ms ago at most. Any thread. */
PHYSVIB_API int physvib_live_get_status(physvib_live live, physvib_live_status *status);

/* ---- Session files: what the mixer, the plug-in, `physvib play --save` and `save` above write. No device is wanted. ---- */

/** A session file (JSON, `path` is UTF-8), also a journal that was cut off. PHYSVIB_ERROR_FILE, PHYSVIB_ERROR_FULL: 256 of them. Any thread. */
PHYSVIB_API int physvib_session_load(const char *path, physvib_session *session);
/** One of strikes alone, in time order, at session times, without a world. Of `renderer` as in physvib_live_open(). Any thread. */
PHYSVIB_API int physvib_session_create(const physvib_renderer_settings *renderer, const physvib_event *events, physvib_int64 count,
                                       physvib_int64 length_ns, physvib_session *session);
/** Waits until calls that are under way on other threads are over. Any thread. */
PHYSVIB_API int physvib_session_free(physvib_session session);
/** As a file that the programs above read, whole or not at all. Any thread. */
PHYSVIB_API int physvib_session_save(physvib_session session, const char *path);

/** How long it was played, in nanoseconds. Any thread. */
PHYSVIB_API physvib_int64 physvib_session_length_ns(physvib_session session);
/** Its channels, limiter, layout, law, exponent and field, as they were at the start; `renderer` as init has left it. Any thread. */
PHYSVIB_API int physvib_session_get_renderer(physvib_session session, physvib_renderer_settings *renderer);
/** What was felt before `end_ns`: its worlds are simulated again, which takes a while. How many there are; the first `capacity` of them are
 * written to `events`, which may be NULL if that is 0. Any thread. */
PHYSVIB_API physvib_int64 physvib_session_events(physvib_session session, physvib_int64 end_ns, physvib_event *events, physvib_int64 capacity);
/** samples[channel * frames + n] for each of its channels, frame n at n / rate_hz: those of `physvib render SESSION.json`. PHYSVIB_ERROR_FILE: a
 * recording is missing. Any thread. */
PHYSVIB_API int physvib_session_render(physvib_session session, int rate_hz, physvib_int64 frames, float *samples);

#ifdef __cplusplus
}
#endif
#endif
