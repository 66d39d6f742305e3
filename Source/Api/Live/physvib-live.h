/* SPDX-License-Identifier: MIT */
/** @file
 * PhysVib on audio devices, game controllers and boards, for any language: events and contacts in, vibration
 * out; and session files. C89 and later, C++.
 *
 * Link libphysvib-live (MIT) and libphysvib. Results, units and the words "any
 * thread" and "one at a time" are those of physvib.h; physvib_live_error() returns the text of an error. No
 * function here is for an audio callback: the library has one of its own, which never allocates, locks or
 * waits.
 *
 * Time. physvib_live_now_ns() is the session time, which advances with the device's blocks. An event at
 * session time t leaves for the device at t + L, always, to a fraction of a frame; the output latency L is
 * physvib_live_latency_ns(). A device starts with a ramp from silence, at -12 dB. */
#ifndef PHYSVIB_LIVE_H
#define PHYSVIB_LIVE_H
#include <physvib/physvib.h>

#ifdef __cplusplus
extern "C" {
#endif

#define PHYSVIB_ERROR_DEVICE (-9) /**< a device or board is missing or does not start */

typedef struct physvib_live_name* physvib_live;       /**< an open device, controller or board, or several */
typedef struct physvib_session_name* physvib_session; /**< a session that can be rendered; it does not change
                                                       */

/** Settings of a device; defaults in brackets. */
typedef struct physvib_live_settings {
    size_t size;          /**< set by init */
    int rate_hz;          /**< 0: the device default (0) */
    int block_frames;     /**< 0: the device default (0) */
    int steps_per_s;      /**< of your world: 20 to 1,000 (100) */
    double longest_gap_s; /**< by how much an event may be told later than a step after its time, and still be
                             on time: 0 to 1 (0.001) */
    double level_db;      /**< of all channels: -90 to 0 (-12) */
    char save[1024];  /**< a session file (.json, UTF-8) of all events, written while it plays, a list of its
                         events beside it; "": none (""). What a file cannot hold is refused: gains above
                         1,000, exponents beyond 0.001 to 100, actuators outside the extent, sizes beyond
                         0.001 to 10^6 m */
    int first_output; /**< actuator j is output first_output + j of the device, from 0 (0) */
    int sound_output; /**< this output and the next are the left and right loudspeaker or ear: each hit is
                         heard there by its place, on the frame on which it is felt; -1: none (-1) */
    double sound_db;  /**< there, of a hit at full scale: -90 to 0; the level above does not count (-20) */
} physvib_live_settings;

#define PHYSVIB_BOARD_NONE 0   /**< no board was opened */
#define PHYSVIB_BOARD_SOUGHT 1 /**< disconnected; the library is searching for it */
#define PHYSVIB_BOARD_PLAYS 2  /**< the board is playing */

/** Status of a device. */
typedef struct physvib_live_status {
    size_t size;              /**< set by init */
    int is_running;           /**< 1: the device asks for blocks */
    int is_silent;            /**< 1: by physvib_live_silence() */
    int rate_hz;              /**< of the device */
    int block_frames;         /**< of the device */
    int live_modes;           /**< modes that sound */
    int losses;               /**< times the device was disconnected and opened again */
    int xruns;                /**< as the device counts them; -1: it does not */
    double load;              /**< of the last block: processing time / duration */
    double worst_load;        /**< of all blocks */
    physvib_int64 played;     /**< events played */
    physvib_int64 late;       /**< of these: played at once, after their time */
    physvib_int64 rejected;   /**< could not be played */
    char trouble[256];        /**< one-line error; "": none */
    int board;                /**< PHYSVIB_BOARD_NONE and so on */
    physvib_int64 board_sent; /**< events sent to the board so far */
    physvib_int64 board_lost; /**< of these: dropped, because the line was full, they were late or the board
                                 cannot play them */
    physvib_int64 dropped; /**< events that came while the device did not ask for blocks, or waited for it */
} physvib_live_status;

/** What left for an actuator in a span of session time, measured at the device's buffer. */
typedef struct physvib_live_receipt {
    size_t size;          /**< set by init */
    physvib_int64 frames; /**< that went to the actuator's output; 0: it has none, or nothing was asked for */
    double peak;          /**< of these frames, 0 to 1 of the output's full scale */
    double mean_square;   /**< the same */
    int running; /**< 1: every frame of the span left, in one piece, while one device asked for blocks */
    int opening; /**< number of the last start of a device in the span, from 1; a return after a pause counts
                    too; 0: nothing left */
    int over;    /**< 0: the device has not asked for the end of the span yet */
    int kept;    /**< 0: parts of the span are too old to be known */
} physvib_live_receipt;

#define PHYSVIB_DEVICE_SOUND 0 /**< an output of sound */
#define PHYSVIB_DEVICE_PAD 1   /**< a game controller */
#define PHYSVIB_DEVICE_BOARD 2 /**< a board, or a serial port that may be one */

/** Something that can be opened. */
typedef struct physvib_device {
    size_t size;     /**< sizeof(physvib_device) of the caller */
    char name[256];  /**< for physvib_live_open(): "JACK:system", "PAD:Xbox Controller" */
    char about[256]; /**< what is known of it, for users; "": nothing */
    int kind;        /**< PHYSVIB_DEVICE_SOUND and so on */
    int channels;    /**< outputs, or motors; 0: the driver could not be asked */
} physvib_device;

/** As physvib_error(), for the functions of this header. Any thread. */
PHYSVIB_API const char* physvib_live_error(void);

/** The defaults; `size`: sizeof *settings. Any thread. */
PHYSVIB_API int physvib_live_settings_init(physvib_live_settings* settings, size_t size);
/** Empty; `size`: sizeof *status. Any thread. */
PHYSVIB_API int physvib_live_status_init(physvib_live_status* status, size_t size);

/** Empty; `size`: sizeof *receipt. Any thread. */
PHYSVIB_API int physvib_live_receipt_init(physvib_live_receipt* receipt, size_t size);

/** Lists what can be opened now: the first `capacity` of it in `devices`, which may be NULL if that is 0.
 * `size`: sizeof *devices. Returns how many there are. It asks the system each time, which takes up to
 * seconds; what is disconnected or comes back while it is open is told by physvib_live_get_status(). Any
 * thread. */
PHYSVIB_API int physvib_live_devices(physvib_device* devices, int capacity, size_t size);

/** Opens "JACK:system", for instance: that device and no other (`physvib devices` lists them); actuator j is
 * its output j. "pico" is the first Raspberry Pi Pico with PhysVib's firmware (layout pico4 or pico8). Or a
 * four-channel board, "BOARD:auto" or "BOARD:/dev/ttyACM0"; or both, felt at the same moment:
 * "JACK:system+BOARD:auto". "None:no device" plays in time without a device. Of `renderer` the layout,
 * channels, law, exponent, field and limiter are taken; it and `settings` may be NULL: the defaults. Several
 * may be open, each with a layout, level, silence, status and time of its own; also on one device, on other
 * outputs. "PAD:auto" and "BOARD:auto" take one that is free. A device or board that is disconnected is
 * opened again when it returns. An error leaves `*live` as it was. PHYSVIB_ERROR_DEVICE; PHYSVIB_ERROR_FULL:
 * these outputs are open, or 256 devices. Any thread, one after the other; waits for the device, and for a
 * board that starts. */
PHYSVIB_API int physvib_live_open(const char* device, const physvib_renderer_settings* renderer,
                                  const physvib_live_settings* settings, physvib_live* live);
/** Silences the device within two blocks and closes it, also if it returns an error: PHYSVIB_ERROR_FILE, the
 * session is not wholly saved. Waits for both. An open device is closed when the program ends. Any thread. */
PHYSVIB_API int physvib_live_close(physvib_live live);

/** Session time. Any thread. */
PHYSVIB_API physvib_int64 physvib_live_now_ns(physvib_live live);
/** The output latency L: time from an event's session time until it leaves for the device. Any thread. */
PHYSVIB_API physvib_int64 physvib_live_latency_ns(physvib_live live);

/** Plays events at session times, in any order. Events in the past play at once; they count as late if the
 * output latency has passed too. If one event cannot be played, none is. While the device asks for no blocks
 * (for longer than three of them, and 100 ms), session time stands still and events are dropped, which is no
 * error: status and explanation tell. PHYSVIB_ERROR_FULL: 65,536 events
 * are waiting for their time. Any thread. */
PHYSVIB_API int physvib_live_strike(physvib_live live, const physvib_event* events, physvib_int64 count);
/** Plays one impact now: at that place of the field, as strong as `strength`, 0 to 1 of full scale, with the
 * default vibration of physvib_event_of(). As physvib_live_strike() of that event. Any thread. */
PHYSVIB_API int physvib_live_impact(physvib_live live, double x_m, double y_m, double strength);
/** The same of a built-in material, see physvib_material_name(). Any thread. */
PHYSVIB_API int physvib_live_impact_of(physvib_live live, const char* material, double x_m, double y_m,
                                       double strength);
/** For a world that is stepped as time goes on, after each step, which is taken to begin now: `*start_ns`, at
 * first 0, becomes the session time of the world's time 0, and stays so for as long as the world lags behind
 * that by at most the output latency, or runs ahead by at most that less a step. Else it is set again. Any
 * thread; one at a time per world. */
PHYSVIB_API int physvib_live_align(physvib_live live, physvib_world world, physvib_int64* start_ns);
/** Takes the events of a world, whose time 0 is session time `start_ns`, and plays them in time order, final
 * or not; `at_once` is not looked at. Returns their number. Any thread; one at a time per world. */
PHYSVIB_API physvib_int64 physvib_live_send(physvib_live live, physvib_world world, physvib_int64 start_ns,
                                            int at_once);

/** As physvib_live_align() and physvib_live_send() for a world whose bodies are felt on several devices: the
 * events of a body whose `device` is k are played on lives[k]; of any other number, on the first.
 * starts_ns[k], at first 0, belongs to lives[k]. Returns the number of events. Any thread; one at a time per
 * world. */
PHYSVIB_API physvib_int64 physvib_live_send_each(const physvib_live* lives, int count, physvib_world world,
                                                 physvib_int64* starts_ns);

/** Sets the gain of a channel, 0 to 10,000, from session time on, so it is felt after the output latency;
 * with a ramp of 10 ms. PHYSVIB_ERROR_FULL: 256 changes are waiting. Any thread. */
PHYSVIB_API int physvib_live_set_gain(physvib_live live, int channel, double gain);
/** Mutes a channel, like physvib_live_set_gain(). Any thread. */
PHYSVIB_API int physvib_live_set_mute(physvib_live live, int channel, int is_muted);
/** Changes the layout from session time on; it has at most as many actuators as there are channels. Only
 * layout, law, exponent and field of `renderer` are used. PHYSVIB_ERROR_FULL. Any thread. */
PHYSVIB_API int physvib_live_set_layout(physvib_live live, const physvib_renderer_settings* renderer);

/** Sets the level of all channels, -90 to 0 dB, at once, with a ramp. Any thread. */
PHYSVIB_API int physvib_live_set_level(physvib_live live, double level_db);
/** Silences the device within a block; 0 ends the silence with a ramp. An unknown `live` is an error, but
 * silences all open devices all the same. Any thread. */
PHYSVIB_API int physvib_live_silence(physvib_live live, int is_silent);

/** The status, at most 20 ms old. Any thread. */
PHYSVIB_API int physvib_live_get_status(physvib_live live, physvib_live_status* status);
/** What left for an actuator, from 0, from `from_ns` on and before `to_ns`, session times of events: ask for
 * it a latency after that. Rounded outwards to 5 ms; the last minute is known. PHYSVIB_ERROR_ARGUMENT: no
 * such actuator. Any thread; wait-free, but not for an audio callback. */
PHYSVIB_API int physvib_live_left(physvib_live live, physvib_int64 from_ns, physvib_int64 to_ns, int actuator,
                                  physvib_live_receipt* receipt);
/** As physvib_world_explain(), also of this device: missing, silenced (by whom), level, muted channels,
 * layout, field, late events. Any thread; one at a time per world. */
PHYSVIB_API int physvib_live_explain(physvib_live live, physvib_world world, char* text, size_t size);

/* ---- Session files: what the mixer, the plug-in, `physvib play --save` and `save` above write. No device is
 * needed. ---- */

/** Loads a session file (JSON; `path` is UTF-8) or an incomplete journal. PHYSVIB_ERROR_FILE;
 * PHYSVIB_ERROR_FULL: 256 sessions are open. Any thread. */
PHYSVIB_API int physvib_session_load(const char* path, physvib_session* session);
/** Creates a session of events only, without a world, in time order at session times. `renderer` as for
 * physvib_live_open(). Any thread. */
PHYSVIB_API int physvib_session_create(const physvib_renderer_settings* renderer, const physvib_event* events,
                                       physvib_int64 count, physvib_int64 length_ns,
                                       physvib_session* session);
/** Frees a session; waits for calls on other threads to finish. Any thread. */
PHYSVIB_API int physvib_session_free(physvib_session session);
/** Saves a session as a file that these programs read; the whole file or none. Any thread. */
PHYSVIB_API int physvib_session_save(physvib_session session, const char* path);

/** Length of the session, in nanoseconds. Any thread. */
PHYSVIB_API physvib_int64 physvib_session_length_ns(physvib_session session);
/** Channels, limiter, layout, law, exponent and field at the start of the session; `renderer` must have been
 * initialised. Any thread. */
PHYSVIB_API int physvib_session_get_renderer(physvib_session session, physvib_renderer_settings* renderer);
/** Simulates the session again and returns the number of events before `end_ns`, which takes a while. The
 * first `capacity` of them are written to `events`, which may be NULL if that is 0. Any thread. */
PHYSVIB_API physvib_int64 physvib_session_events(physvib_session session, physvib_int64 end_ns,
                                                 physvib_event* events, physvib_int64 capacity);
/** Renders the session: samples[channel * frames + n], with frame n at n / rate_hz, the same samples as
 * `physvib render SESSION.json`. PHYSVIB_ERROR_FILE: a recording is missing. Any thread. */
PHYSVIB_API int physvib_session_render(physvib_session session, int rate_hz, physvib_int64 frames,
                                       float* samples);

#ifdef __cplusplus
}
#endif
#endif
