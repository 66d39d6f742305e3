/* SPDX-License-Identifier: MIT */
/** @file
 * PhysVib for any language: contacts in, haptics out. C89 and later, C++.
 *
 * Link libphysvib (MIT). Nothing here throws, ends the program or keeps a pointer of yours beyond the call.
 *
 * Results. A function that returns int, or a count, returns PHYSVIB_OK (0) or the count, or one of the errors below, which are less
 * than 0; then nothing has changed, and physvib_error() says in one line what was expected. Handles are names, not addresses: what
 * is null, invented, of another kind or has been freed is PHYSVIB_ERROR_HANDLE.
 *
 * Units are SI, and stand in the names. Times are whole nanoseconds; a renderer's time 0 is its first frame.
 *
 * Threads. "Any thread": any, several at once. "One at a time": any, and a second one waits for the first. "R": the audio callback; wait-free:
 * never allocates, frees, locks, waits or calls the system; one thread at a time.
 *
 * What may change, and what not: Docs/stable.md. */
#ifndef PHYSVIB_PHYSVIB_H
#define PHYSVIB_PHYSVIB_H
#include <stddef.h>

#if defined(_MSC_VER)
typedef __int64 physvib_int64; /**< of 64 bits */
#elif defined(__GNUC__)
__extension__ typedef long long physvib_int64; /**< of 64 bits */
#else
typedef long long physvib_int64; /**< of 64 bits */
#endif

#if defined(PHYSVIB_IS_BEING_BUILT) /* on Windows, by us */
#define PHYSVIB_API __declspec(dllexport)
#elif defined(__GNUC__)
#define PHYSVIB_API __attribute__((visibility("default"))) /**< shown by the library */
#else
#define PHYSVIB_API
#endif

#if defined(__GNUC__)
#define PHYSVIB_UNUSED __attribute__((unused)) /**< of functions in headers of engines, of which a program may call a few */
#else
#define PHYSVIB_UNUSED
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define PHYSVIB_OK 0                /**< done */
#define PHYSVIB_ERROR_HANDLE (-1)   /**< none of ours, or freed */
#define PHYSVIB_ERROR_ARGUMENT (-2) /**< NULL, NaN, out of range */
#define PHYSVIB_ERROR_ORDER (-3)    /**< not now: outside a step, within one, time going back */
#define PHYSVIB_ERROR_FILE (-4)     /**< cannot be read, or written */
#define PHYSVIB_ERROR_MEMORY (-5)   /**< there is no more */
#define PHYSVIB_ERROR_FULL (-6)     /**< no room: a queue, 256 handles of a kind */
#define PHYSVIB_ERROR_BUSY (-7)     /**< another thread is pulling from this renderer */
#define PHYSVIB_ERROR_INTERNAL (-8) /**< ours: please tell us */

#define PHYSVIB_UNKNOWN (-1.0e300) /**< of a number that need not be told; NaN is an error */
#define PHYSVIB_MAX_ENCHANTERS 64  /**< of a layout */

typedef struct physvib_renderer_name *physvib_renderer; /**< strikes in, samples out */
typedef struct physvib_world_name *physvib_world;       /**< contacts in, events out */

#define PHYSVIB_HIT 0   /**< an event came of bodies that met */
#define PHYSVIB_ROLL 1  /**< of a grain of a surface that something rolled over */
#define PHYSVIB_SLIDE 2 /**< of a grain of a surface that something slid over */

/** A collision as it is felt: amplitude * sin(2 pi frequency_hz t) * exp(-decay_per_s t), t counted from time_ns. */
typedef struct physvib_event {
    physvib_int64 time_ns;     /**< onset, from 0 on */
    physvib_int64 duration_ns; /**< 0: until it has decayed; a decay of 0 needs a duration, and 5 Hz or more; below, it is at least 1 */
    double frequency_hz;       /**< above 0, to 20,000 */
    double decay_per_s;        /**< 0 to 2,000 */
    double amplitude;          /**< 1: full scale of an enchanter */
    double x_m;                /**< in the field, from its lower left corner */
    double y_m;                /**< the same upwards */
    double impulse_n_s;        /**< that it came from; 0: unknown. Not needed for samples, as what follows */
    double mass_kg;            /**< of the body that feels; 0: unknown */
    int fixture;               /**< the body that feels; -1: unknown */
    int other;                 /**< what struck it; -1: unknown */
    int kind;                  /**< PHYSVIB_HIT (0) and so on */
    int unused;                /**< 0 */
} physvib_event;

/** Where the enchanters sit: channel j at x_m[j], y_m[j] from the lower left corner of the extent, onto which the field is mapped. */
typedef struct physvib_layout {
    double extent_width_m;              /**< above 0 */
    double extent_height_m;             /**< above 0 */
    double x_m[PHYSVIB_MAX_ENCHANTERS]; /**< of each enchanter */
    double y_m[PHYSVIB_MAX_ENCHANTERS]; /**< of each enchanter */
    int count;                          /**< 1 to PHYSVIB_MAX_ENCHANTERS */
} physvib_layout;

#define PHYSVIB_LAW_LINEAR 0    /**< of panning: see Docs/panning.md */
#define PHYSVIB_LAW_LOG 1       /**< of panning: see Docs/panning.md */
#define PHYSVIB_LAW_LOG_OUTER 2 /**< of panning: see Docs/panning.md */
#define PHYSVIB_LAW_ENERGY 3    /**< of panning: see Docs/panning.md */

/* Structures with a `size` are filled by their ..._init(&it, sizeof it), and then changed. They grow at their end only: a program that was
 * built when they were shorter is read, and written to, as far as its own go. */

/** How a renderer is made. */
typedef struct physvib_renderer_settings {
    size_t size;  /**< set by init */
    int rate_hz;  /**< 5,000 to 192,000 (48,000) */
    int channels; /**< 0: as many as the layout has enchanters; more are silent, to PHYSVIB_MAX_ENCHANTERS */
    int law;      /**< (PHYSVIB_LAW_LINEAR; with it and exponent 1, events of kind PHYSVIB_ROLL and PHYSVIB_SLIDE are panned by
                       PHYSVIB_LAW_ENERGY, so that what travels is felt where it is; any other law is that of all) */
    int limiter;  /**< (1); 0: samples may exceed 1 */
    double exponent;        /**< of the law (1) */
    double field_width_m;   /**< that x spans; 0: the layout's extent (0) */
    double field_height_m;  /**< that y spans; 0: the layout's extent (0) */
    physvib_layout layout;  /**< (phone4) */
} physvib_renderer_settings;

/** What a renderer has done. */
typedef struct physvib_renderer_status {
    size_t size;            /**< set by init */
    int live_modes;         /**< that ring */
    int pending;            /**< events whose time has not come */
    physvib_int64 frames;   /**< pulled so far */
    physvib_int64 played;   /**< events struck */
    physvib_int64 late;     /**< of these: after their time, at once */
    physvib_int64 rejected; /**< could not be played */
    physvib_int64 refused;  /**< by a full queue */
} physvib_renderer_status;

/** How contacts become events. */
typedef struct physvib_world_settings {
    size_t size;               /**< set by init */
    int is_muted;              /**< 1: nothing is felt (0) */
    int hits_per_step;         /**< at most so many become events in a step, the strongest; -1: all (-1) */
    int at_body;               /**< 1: a hit is felt at the body's centre, see physvib_world_move; 0: at the point of contact (0) */
    int drops_hits_of_removed; /**< 1: events not yet taken go with a body (0) */
    double field_width_m;      /**< v_max of Eq. 5.7 is one field width per second (1) */
    double field_x_m;          /**< where its lower left corner is in the world (0) */
    double field_y_m;          /**< where its lower left corner is in the world (0) */
    double field_radians;      /**< how it is turned (0) */
    double normalisation_s_per_m; /**< A* of Eq. 5.4 (PHYSVIB_UNKNOWN: by the field's width) */
    double hand_mass_kg;          /**< m_h of Eq. 5.4 (PHYSVIB_UNKNOWN: the largest mass in the world) */
    double drive_gain;            /**< (1) */
    double threshold_m_per_s;     /**< a hit changes the velocity of the lighter body by as much (0.15) */
} physvib_world_settings;

#define PHYSVIB_VOICE_OWN 0   /**< what is struck sounds */
#define PHYSVIB_VOICE_OTHER 1 /**< what strikes it sounds */
#define PHYSVIB_VOICE_BOTH 2  /**< both sound */

/** A body, and how it feels and sounds. */
typedef struct physvib_body {
    size_t size;   /**< set by init */
    int is_camera; /**< 1: its collisions are felt (0) */
    int voice;     /**< (PHYSVIB_VOICE_OWN) */
    int surface;   /**< its kind, above 0, for physvib_world_pair (0: none) */
    double mass_kg;         /**< 0: what strikes it does not move it */
    double inertia_kg_m2;   /**< about its centre of mass; 0: blows are taken as if they went through it */
    double gravity_scale;   /**< (1) */
    double frequency_hz;    /**< at which it vibrates; 0: not at all (0) */
    double decay_per_s;     /**< of its vibration (0) */
    double static_mass_kg;  /**< mass for Eq. 5.4 of a camera whose mass_kg is 0 */
    double gain;            /**< of what it sends out as a camera (1) */
    double hand_mass_kg;    /**< m_h for this camera (PHYSVIB_UNKNOWN: the world's) */
    double overtone_hz[3];          /**< further modes; 0: none (0) */
    double overtone_decay_per_s[3]; /**< of these (0) */
    double overtone_amplitude[3];   /**< relative to the first mode (1) */
    double grain_m;   /**< what rolls or slides along it passes a grain every so often (0: smooth, silent), see Docs/lasting-contacts.md */
    double roughness; /**< strength of its grains, 0 to 1000 (1) */
    double rolling;   /**< share that is felt of what rolls, 0 to 1 (0.2) */
    int is_ridged;    /**< 1: grains at equal distances, a tone (0) */
} physvib_body;

#define PHYSVIB_POINT_NONE (-1)     /**< of point_id: not told apart */
#define PHYSVIB_POINT_BY_PLACE (-2) /**< of point_id: told apart by place; physvib_world_move tells how far a point may have slid */

#define PHYSVIB_SOFT 1       /**< of is_soft: the impulse of one step is a load, and no measure of an impact */
#define PHYSVIB_SOFT_WHOLE 2 /**< of is_soft: the same, but it is all that the bodies were given in the step. Where it is clearly more than speed and
                                  masses say (what is struck is supported, or hangs in joints), it is the impact */

/** Two bodies touch. Tell the impulse, or how fast they near each other, or neither if physvib_world_move tells the motions. */
typedef struct physvib_contact {
    size_t size;               /**< set by init */
    int a;                     /**< a body */
    int b;                     /**< the other */
    double x_m;                /**< where, in the plane of the field */
    double y_m;                /**< where, in the plane of the field */
    double normal_x;           /**< of length 1, from a to b (0) */
    double normal_y;           /**< of length 1, from a to b (1) */
    double impulse_n_s;        /**< along the normal, in this step (PHYSVIB_UNKNOWN) */
    double tangential_n_s;     /**< across it (0) */
    double approach_m_per_s;   /**< before the engine's solver (PHYSVIB_UNKNOWN) */
    double restitution;        /**< 0 to 1; where no impulse is told (0) */
    double effective_mass_kg;  /**< where no impulse is told (PHYSVIB_UNKNOWN: by masses, inertias and places) */
    double fraction;           /**< when they touched, in steps after this one's start, -1 to 1 (PHYSVIB_UNKNOWN: by gap and approach) */
    double gap_m;              /**< between the surfaces when the engine looked; below 0: they overlap (0) */
    double gap_fraction;       /**< when that was, in steps after this one's start, 0 to 1 (0) */
    double along_a_m_per_s;    /**< of what goes on touching a rough body, with its impulse: how fast the point moves along a's surface. Rolling: as
                                  along b's; sliding: 0 along what drags its own point (PHYSVIB_UNKNOWN) */
    double along_b_m_per_s;    /**< the same along b's (PHYSVIB_UNKNOWN) */
    int is_soft;               /**< PHYSVIB_SOFT or PHYSVIB_SOFT_WHOLE: what the engine pushes in one step is no measure of a blow, which is told by speed and restitution;
                                  the impulse is what a pair that goes on touching hands on (0) */
    int unused;                /**< 0 */
    int point_id;              /**< which point of its pair it is: a number of yours, from 0 on, or PHYSVIB_POINT_BY_PLACE. A point that was not
                                  there in the step before and nears fast is a blow even while its pair touches (PHYSVIB_POINT_NONE: the pair is
                                  told as a whole) */
    int is_impulse_of_pair;    /**< 1: the impulses are the whole pair's, told with each of its points (0) */
} physvib_contact;

/** What became of contacts, since the world was made. */
typedef struct physvib_world_counts {
    size_t size;                   /**< set by init */
    physvib_int64 contacts;        /**< pairs that began to touch, and new points of pairs */
    physvib_int64 below_threshold; /**< of haptic sources (is_camera): slower than the threshold */
    physvib_int64 no_source;       /**< neither of the two bodies is a haptic source */
    physvib_int64 unplayable;      /**< impacts without a frequency, a mass, or outside of what can be played */
    physvib_int64 muted;           /**< by is_muted, or a gain of 0 */
    physvib_int64 dropped;         /**< more in a step than there is room for, or than hits_per_step */
    physvib_int64 events;          /**< made */
    double threshold_m_per_s;      /**< in effect: threshold_m_per_s, and at least 1.5 times what gravity adds in the last step */
} physvib_world_counts;

/** "0.1.0". Any thread. */
PHYSVIB_API const char *physvib_version(void);

/** The name of a panning law, as options and files have it; they are counted from 0 (PHYSVIB_LAW_...), and behind the last NULL. Any thread. */
PHYSVIB_API const char *physvib_law_name(int law);

/** What the last error of this thread was about, in one line; "" before the first. Valid until this thread's next call. pull says
 * nothing: it returns its code alone. Any thread. */
PHYSVIB_API const char *physvib_error(void);

/** As it begins, in brackets above; `size`: sizeof *settings. Any thread, as the five that follow. */
PHYSVIB_API int physvib_renderer_settings_init(physvib_renderer_settings *settings, size_t size);
/** Empty; `size`: sizeof *status. */
PHYSVIB_API int physvib_renderer_status_init(physvib_renderer_status *status, size_t size);
/** As it begins; `size`: sizeof *settings. */
PHYSVIB_API int physvib_world_settings_init(physvib_world_settings *settings, size_t size);
/** As it begins; `size`: sizeof *body. */
PHYSVIB_API int physvib_body_init(physvib_body *body, size_t size);
/** As it begins; `size`: sizeof *contact. */
PHYSVIB_API int physvib_contact_init(physvib_contact *contact, size_t size);
/** Empty; `size`: sizeof *counts. */
PHYSVIB_API int physvib_world_counts_init(physvib_world_counts *counts, size_t size);

/* ---- Layouts and files. Any thread; they allocate, and read or write files. ---- */

/** By its name, "phone4": they stand in Docs/panning.md. */
PHYSVIB_API int physvib_layout_preset(const char *name, physvib_layout *layout);
/** Layout files (JSON), see README.md. `path` is UTF-8. */
PHYSVIB_API int physvib_layout_load(const char *path, physvib_layout *layout);
/** The same from text in memory, which ends with 0. */
PHYSVIB_API int physvib_layout_parse(const char *text, physvib_layout *layout);
/** The same; PHYSVIB_ERROR_ARGUMENT if nobody could load it. */
PHYSVIB_API int physvib_layout_save(const char *path, const char *name, const physvib_layout *layout);

/** Event lists (CSV), see Docs/events.md. How many there are; the first `capacity` of them are written to `events`, which may be NULL if
 * that is 0. */
PHYSVIB_API physvib_int64 physvib_events_load(const char *path, physvib_event *events, physvib_int64 capacity);
/** The same from text in memory, which ends with 0. */
PHYSVIB_API physvib_int64 physvib_events_parse(const char *text, physvib_event *events, physvib_int64 capacity);
/** Playable events, in time order. */
PHYSVIB_API int physvib_events_save(const char *path, const physvib_event *events, physvib_int64 count);

/** 32-bit float, channel j's frame n is samples[j * frames + n]. */
PHYSVIB_API int physvib_wav_save(const char *path, const float *samples, int channels, physvib_int64 frames, int rate_hz);

/** Events, in time order, to samples[channel * frames + n], frame n at n / rate_hz; the same samples as `physvib render --from-events`. */
PHYSVIB_API int physvib_render(const physvib_renderer_settings *settings, const physvib_event *events, physvib_int64 count,
                               physvib_int64 frames, float *samples);

/* ---- A renderer: strikes in, samples out. ---- */

/** 13 to 25 MB, by its channels. PHYSVIB_ERROR_FULL: 256 of them. Any thread. */
PHYSVIB_API int physvib_renderer_create(const physvib_renderer_settings *settings, physvib_renderer *renderer);
/** Waits until a call that is under way, on another thread, is over. Any thread but R. */
PHYSVIB_API int physvib_renderer_free(physvib_renderer renderer);

/** Plays an event at its time; one whose time is over, at once. PHYSVIB_ERROR_FULL: 8,192 events are waiting to be pulled. One at a time. */
PHYSVIB_API int physvib_renderer_strike(physvib_renderer renderer, const physvib_event *event);

/** The next `frames` (1 or more) of each channel, in channels[channel][0..frames). `channel_count`: the renderer's. PHYSVIB_ERROR_BUSY. R. */
PHYSVIB_API int physvib_renderer_pull(physvib_renderer renderer, float *const *channels, int channel_count, int frames);
/** The same frame by frame. R. */
PHYSVIB_API int physvib_renderer_pull_interleaved(physvib_renderer renderer, float *samples, int channel_count, int frames);

/** From that time on. Gains from 0 to 10,000; they glide for 10 ms. PHYSVIB_ERROR_FULL: 256 changes are waiting. One at a time. */
PHYSVIB_API int physvib_renderer_set_gain(physvib_renderer renderer, physvib_int64 time_ns, int channel, double gain);
/** The same: 1 is silent. One at a time. */
PHYSVIB_API int physvib_renderer_set_mute(physvib_renderer renderer, physvib_int64 time_ns, int channel, int is_muted);
/** The same of all channels, on top. One at a time. */
PHYSVIB_API int physvib_renderer_set_level(physvib_renderer renderer, physvib_int64 time_ns, double gain);
/** At most as many enchanters as channels. What rings, rings out where it is. Of `settings` the layout, law, exponent and field are taken. One
 * at a time. */
PHYSVIB_API int physvib_renderer_set_layout(physvib_renderer renderer, physvib_int64 time_ns, const physvib_renderer_settings *settings);
/** Whatever rings at that time fades within 10 ms, and no event before `until_ns` is played. One at a time. */
PHYSVIB_API int physvib_renderer_silence(physvib_renderer renderer, physvib_int64 time_ns, physvib_int64 until_ns);

/** Frames by which samples lag the events' times: the limiter's look-ahead. Any thread. */
PHYSVIB_API int physvib_renderer_latency_frames(physvib_renderer renderer);
/** Of the last pull. One at a time. */
PHYSVIB_API int physvib_renderer_get_status(physvib_renderer renderer, physvib_renderer_status *status);

/** L, see Docs/threads.md: what happens at world time w, struck at w + L, comes in time whatever block (frames) and step it falls into,
 * if the world's thread is never silent for longer than `longest_gap_s`. Nanoseconds. Any thread. */
PHYSVIB_API physvib_int64 physvib_play_out_ns(int rate_hz, int block_frames, int steps_per_s, double longest_gap_s);

/* ---- A world: contacts in, events out. One at a time. ----
 * Each step: begin_step, move (only what was told above), touch every pair that touches, end_step; then take, or send. Bodies are
 * numbers of yours, from 0 on, and stand in the events. */

/** `settings` may be NULL: as init has them. PHYSVIB_ERROR_FULL: 256 of them. Any thread. */
PHYSVIB_API int physvib_world_create(const physvib_world_settings *settings, physvib_world *world);
/** Waits until a call that is under way, on another thread, is over. Any thread. */
PHYSVIB_API int physvib_world_free(physvib_world world);
/** From the next step on. */
PHYSVIB_API int physvib_world_configure(physvib_world world, const physvib_world_settings *settings);

/** A body, at first or again. */
PHYSVIB_API int physvib_world_set_body(physvib_world world, int body, const physvib_body *values);
/** Not within a step. */
PHYSVIB_API int physvib_world_remove_body(physvib_world world, int body);
/** Centre of mass, velocity and spin before the engine's solver. */
PHYSVIB_API int physvib_world_move(physvib_world world, int body, double x_m, double y_m, double vx_m_per_s, double vy_m_per_s, double spin_rad_per_s);
/** Velocity and spin behind the engine's solver, within a step and before its contacts are told, for engines that do not tell impulses: those of contacts
 * that are soft, or have none, follow from the momentum of their two bodies. physvib_world_move has the velocity without contacts then, so with what
 * gravity adds in the step. A row of bodies hands on by it, and what lands on what is supported is within 20 %; friction and joints are not known. */
PHYSVIB_API int physvib_world_moved(physvib_world world, int body, double vx_m_per_s, double vy_m_per_s, double spin_rad_per_s);
/** How two kinds of surfaces sound together, whatever the camera's voice is. */
PHYSVIB_API int physvib_world_pair(physvib_world world, int surface, int other, double frequency_hz, double decay_per_s, double gain);

/** The next step, of so many seconds (0 to 3,600); gravity says what resting bodies are pushed by. */
PHYSVIB_API int physvib_world_begin_step(physvib_world world, double seconds, double gravity_m_per_s2);
/** For engines that are asked what touches: a pair that did not in the step before begins, one that is not named again has ended. */
PHYSVIB_API int physvib_world_touch(physvib_world world, const physvib_contact *contact);
/** For engines that tell: parts that were apart meet. */
PHYSVIB_API int physvib_world_begin(physvib_world world, const physvib_contact *contact);
/** For engines that tell: a pair goes on pushing. */
PHYSVIB_API int physvib_world_push(physvib_world world, const physvib_contact *contact);
/** For engines that tell: a pair has parted. */
PHYSVIB_API int physvib_world_end(physvib_world world, int a, int b);
/** All that touches has been told. */
PHYSVIB_API int physvib_world_end_step(physvib_world world);

/** After the steps done, in nanoseconds. */
PHYSVIB_API physvib_int64 physvib_world_time_ns(physvib_world world);
/** Events that are final (a step later, in order; or, with `at_once`, all of them), at most `capacity`; the rest waits. How many. */
PHYSVIB_API physvib_int64 physvib_world_take(physvib_world world, physvib_event *events, physvib_int64 capacity, int at_once);
/** The same into a renderer, `later_ns` (L) after they happened. How many. Events that find its queue full are counted there, and gone. */
PHYSVIB_API physvib_int64 physvib_world_send(physvib_world world, physvib_renderer renderer, physvib_int64 later_ns, int at_once);
/** Hits lost so far because more came in a step than there is room for. */
PHYSVIB_API physvib_int64 physvib_world_drops(physvib_world world);
/** What became of all contacts so far. */
PHYSVIB_API int physvib_world_get_counts(physvib_world world, physvib_world_counts *counts);
/** Why nothing, or not everything, is felt: the most likely reason, one sentence, to `text` (its 0 included, at most `size`, 1 or more: 256 are
 * enough). How long the sentence is. */
PHYSVIB_API int physvib_world_explain(physvib_world world, char *text, size_t size);
/** Grains passed so far and left out, because they were more than 2,000 a second at one contact, or 50,000 in all; their power is in the others. */
PHYSVIB_API physvib_int64 physvib_world_thinned(physvib_world world);

#ifdef __cplusplus
}
#endif
#endif
