/* SPDX-License-Identifier: MIT */
/** @file
 * PhysVib for any language: contacts in, vibration out. C89 and later, C++.
 *
 * A haptic source (is_camera in fields) is a body whose impacts are felt. An impact becomes an event, a
 * decaying sinusoid that is panned over 1 to 64 actuators (the thesis and some names here call an actuator an
 * enchanter).
 *
 * Link libphysvib (MIT). No function throws, ends the program, or keeps a pointer of the caller's after it
 * has returned.
 *
 * Results. A function that returns int, or a count, returns PHYSVIB_OK (0) or the count, or one of the errors
 * below, which are less than 0; then nothing has changed, and physvib_error() says in one line what was
 * expected. Handles are not addresses: one that is null, invented, of another kind or freed gives
 * PHYSVIB_ERROR_HANDLE.
 *
 * Units are SI and part of the names. Times are whole nanoseconds; a renderer's time 0 is its first frame.
 *
 * Threads. "Any thread": any, several at once. "One at a time": any, and a second one waits for the first.
 * "R": for the audio callback; wait-free: it never allocates, frees, locks, waits or calls the system; one
 * thread at a time.
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
#define PHYSVIB_UNUSED                                                                                       \
    __attribute__((unused)) /**< of functions in headers of engines, of which a program may call a few */
#else
#define PHYSVIB_UNUSED
#endif

#if defined(__GNUC__)
/** A function that goes: what to call instead. */
#define PHYSVIB_DEPRECATED(instead) __attribute__((deprecated(instead)))
#elif defined(_MSC_VER)
#define PHYSVIB_DEPRECATED(instead) __declspec(deprecated(instead))
#else
#define PHYSVIB_DEPRECATED(instead)
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define PHYSVIB_OK 0                /**< done */
#define PHYSVIB_ERROR_HANDLE (-1)   /**< not a handle of this library, or freed */
#define PHYSVIB_ERROR_ARGUMENT (-2) /**< NULL, NaN, out of range */
#define PHYSVIB_ERROR_ORDER (-3)    /**< not now: outside a step, within one, time going back */
#define PHYSVIB_ERROR_FILE (-4)     /**< cannot be read, or written */
#define PHYSVIB_ERROR_MEMORY (-5)   /**< out of memory */
#define PHYSVIB_ERROR_FULL (-6)     /**< no room: a queue, 256 handles of a kind */
#define PHYSVIB_ERROR_BUSY (-7)     /**< another thread is pulling from this renderer */
#define PHYSVIB_ERROR_INTERNAL (-8) /**< an error of this library: please report it */

#define PHYSVIB_UNKNOWN (-1.0e300) /**< value of a number that may be left out; NaN is an error */
#define PHYSVIB_MAX_ENCHANTERS 64  /**< actuators of a layout */

typedef struct physvib_renderer_name* physvib_renderer; /**< events in, samples out */
typedef struct physvib_world_name* physvib_world;       /**< contacts in, events out */
typedef struct physvib_pads_name* physvib_pads;         /**< events in, motor commands out */

#define PHYSVIB_HIT 0   /**< kind of an event: two bodies met */
#define PHYSVIB_ROLL 1  /**< a body rolled over a grain of a surface */
#define PHYSVIB_SLIDE 2 /**< a body slid over a grain of a surface */

/* Structures that may grow begin with their size in bytes, as the program knows them, and grow at their end
 * only: of a program that was built with a shorter one, only that part is read and written. Fill one with its
 * ..._init(&it, sizeof it), then change what you like; one whose size was left 0 is refused. Functions step
 * through a list of events by its first one's size: all that are read must have that size; of those that are
 * written, only the first one's counts, and all get it. */

/** An event: amplitude * sin(2 pi frequency_hz t) * exp(-decay_per_s t), t = time since time_ns. */
typedef struct physvib_event {
    size_t size;               /**< set by init */
    physvib_int64 time_ns;     /**< onset, from 0 on */
    physvib_int64 duration_ns; /**< 0: until it has decayed; a decay of 0 needs a duration, and 5 Hz or more;
                                  below, it is at least 1 */
    double frequency_hz;       /**< above 0, to 20,000 */
    double decay_per_s;        /**< 0 to 2,000 */
    double amplitude;          /**< 1: full scale of an actuator */
    double x_m;                /**< place in the field, from its lower left corner, to the right */
    double y_m;                /**< the same, upwards */
    double impulse_n_s; /**< of the impact; 0: unknown. This and what follows is not needed for samples */
    double mass_kg;     /**< of the haptic source; 0: unknown */
    int fixture;        /**< the haptic source; -1: unknown */
    int other;          /**< the body that it collided with; -1: unknown */
    int kind;           /**< PHYSVIB_HIT (0) and so on */
    int sound;          /**< number of its sound's name, 0: none; lists give it the number of a material */
    double z_m;         /**< place across the plane of x and y, towards the viewer; 0 in a plane */
    int part;   /**< physvib_part() of the part of the body on whose actuators it is felt; 0: on all */
    int unused; /**< 0; so that no byte of an array of them is padding, which numpy does not copy */
} physvib_event;

/** Places of the actuators: channel j at x_m[j], y_m[j] from the lower left corner of the extent, onto which
 * the field is mapped. z is scaled as x is. */
typedef struct physvib_layout {
    size_t size;                        /**< set by init */
    double extent_width_m;              /**< above 0 */
    double extent_height_m;             /**< above 0 */
    double x_m[PHYSVIB_MAX_ENCHANTERS]; /**< of each actuator */
    double y_m[PHYSVIB_MAX_ENCHANTERS]; /**< of each actuator */
    int count;                          /**< 1 to PHYSVIB_MAX_ENCHANTERS */
    double z_m[PHYSVIB_MAX_ENCHANTERS]; /**< of each actuator: 0 of all in a plane (Docs/space.md) */
    int part[PHYSVIB_MAX_ENCHANTERS];   /**< of each: physvib_part() of the part of the body it is on, or 0 */
} physvib_layout;

#define PHYSVIB_LAW_LINEAR 0     /**< of panning: see Docs/panning.md */
#define PHYSVIB_LAW_LOG 1        /**< of panning: see Docs/panning.md */
#define PHYSVIB_LAW_LOG_OUTER 2  /**< of panning: see Docs/panning.md */
#define PHYSVIB_LAW_ENERGY 3     /**< of panning: see Docs/panning.md */
#define PHYSVIB_LAW_NEIGHBOURS 4 /**< of panning: only the actuators around the place */
#define PHYSVIB_LAW_AUTO 5       /**< by the layout's shape: NEIGHBOURS, LINEAR, TRIANGLES or DISTANCE */
#define PHYSVIB_LAW_DISTANCE 6   /**< of panning: all actuators, by their distance in space */
#define PHYSVIB_LAW_TRIANGLES 7  /**< of panning: three actuators of a layout in space, around the place */

/** Settings of a renderer; defaults in brackets. */
typedef struct physvib_renderer_settings {
    size_t size;  /**< set by init */
    int rate_hz;  /**< 5,000 to 192,000 (48,000) */
    int channels; /**< 0: as many as the layout has actuators; more are silent, to PHYSVIB_MAX_ENCHANTERS */
    int law;     /**< (PHYSVIB_LAW_AUTO); with LINEAR, named or chosen by AUTO, and exponent 1, events of kind
                    PHYSVIB_ROLL and PHYSVIB_SLIDE are panned by PHYSVIB_LAW_ENERGY, so that what travels is
                    felt where it is; any other law is that of all */
    int limiter; /**< (1); 0: samples may exceed 1 */
    double exponent;       /**< of the law (1) */
    double field_width_m;  /**< that x spans; 0: the layout's extent (0) */
    double field_height_m; /**< that y spans; 0: the layout's extent (0) */
    physvib_layout layout; /**< (phone4) */
} physvib_renderer_settings;

/** Status of a renderer. */
typedef struct physvib_renderer_status {
    size_t size;            /**< set by init */
    int live_modes;         /**< modes that sound */
    int pending;            /**< events whose time is still to come */
    physvib_int64 frames;   /**< pulled so far */
    physvib_int64 played;   /**< events played */
    physvib_int64 late;     /**< of these: played at once, after their time */
    physvib_int64 rejected; /**< could not be played */
    physvib_int64 refused;  /**< because the queue was full */
} physvib_renderer_status;

/** Of full_scale_impulse_n_s: the hardest usual hit comes near half of full scale. The level rises at once,
 * and falls by a time constant of 10 s; see Docs/actuators.md. */
#define PHYSVIB_AUTOMATIC (-1.0)

/** How contacts become events; defaults in brackets. */
typedef struct physvib_world_settings {
    size_t size;       /**< set by init */
    int is_muted;      /**< 1: no events (0) */
    int hits_per_step; /**< maximum of impacts that become events in a step, the strongest first; -1: all (-1)
                        */
    int at_body; /**< 1: events are at the body's centre, see physvib_world_move; 0: at the point of contact
                    (0) */
    int drops_hits_of_removed; /**< 1: removing a body also removes its events that have not been taken (0) */
    double field_width_m;      /**< v_max of Eq. 5.7 is one field width per second (1) */
    double field_x_m;          /**< where its lower left corner is in the world (0) */
    double field_y_m;          /**< where its lower left corner is in the world (0) */
    double field_radians;      /**< its rotation, counter-clockwise (0) */
    double normalisation_s_per_m; /**< A* of Eq. 5.4 (PHYSVIB_UNKNOWN: by the field's width) */
    double hand_mass_kg;          /**< m_h of Eq. 5.4 (PHYSVIB_UNKNOWN: the largest mass in the world) */
    double drive_gain;            /**< (1) */
    double threshold_m_per_s; /**< an impact that changes the velocity of the lighter body by less is ignored
                                 (0.15) */
    double full_scale_impulse_n_s; /**< an impact of this impulse gives amplitude 1, whatever masses and A*
                                      are; drive_gain and gains still multiply. PHYSVIB_AUTOMATIC: learned
                                      from the world's hits. 0: off, Eq. 5.4 (0) */
    double settling_s; /**< impacts before this time of the world are not felt, and are counted as muted (0)
                        */
} physvib_world_settings;

#define PHYSVIB_VOICE_OWN 0   /**< the haptic source vibrates with its own values */
#define PHYSVIB_VOICE_OTHER 1 /**< with those of the body that strikes it */
#define PHYSVIB_VOICE_BOTH 2  /**< with both */

/** A body: its mass, its vibration, whether it is a haptic source; defaults in brackets. */
typedef struct physvib_body {
    size_t size;                    /**< set by init */
    int is_camera;                  /**< 1: it is a haptic source, its impacts are felt (0) */
    int voice;                      /**< (PHYSVIB_VOICE_OWN) */
    int surface;                    /**< number of its surface, above 0, for physvib_world_pair (0: none) */
    double mass_kg;                 /**< 0: it does not move, as a floor or a wall */
    double inertia_kg_m2;           /**< about its centre of mass, in space about every axis (see
                                       physvib_world_move_in_space); 0: every impact is taken to go through it */
    double gravity_scale;           /**< (1) */
    double frequency_hz;            /**< at which it vibrates; 0: not at all (0) */
    double decay_per_s;             /**< of its vibration (0) */
    double static_mass_kg;          /**< mass for Eq. 5.4 of a haptic source whose mass_kg is 0 */
    double gain;                    /**< of its events as a haptic source (1) */
    double hand_mass_kg;            /**< m_h for this haptic source (PHYSVIB_UNKNOWN: the world's) */
    double overtone_hz[3];          /**< further modes; 0: none (0) */
    double overtone_decay_per_s[3]; /**< of these (0) */
    double overtone_amplitude[3];   /**< relative to the first mode (1) */
    double grain_m; /**< distance of the grains of its surface, each of which excites it when a body rolls or
                       slides over it (0: smooth, silent), see Docs/lasting-contacts.md */
    double roughness; /**< strength of its grains, 0 to 1000 (1) */
    double rolling;   /**< amplitude of rolling, as a share of that of sliding, 0 to 1 (0.2) */
    int is_ridged;    /**< 1: grains at equal distances, a tone (0) */
    int device; /**< number of the device on which it is felt, see physvib_live_send_each (0: the first) */
    int part;   /**< number of the part of a body (a palm, a chest) on whose actuators it is felt as a haptic
                   source; 0: on all, by place (0) */
} physvib_body;

#define PHYSVIB_POINT_NONE (-1) /**< of point_id: the points of a pair are not distinguished */
/** of point_id: points are distinguished by place; physvib_world_move says how far a point may have slid */
#define PHYSVIB_POINT_BY_PLACE (-2)

#define PHYSVIB_SOFT 1 /**< of is_soft: the impulse of one step is a load, and no measure of an impact */
/** of is_soft: the same, but it is all that the bodies were given in the step. Where it is clearly more than
 * speed and masses say (what is struck is supported, or hangs in joints), it is the impact */
#define PHYSVIB_SOFT_WHOLE 2

/** Two bodies touch. Set the impulse, or the approach speed, or neither if physvib_world_move reports the
 * motions. */
typedef struct physvib_contact {
    size_t size;              /**< set by init */
    int a;                    /**< a body */
    int b;                    /**< the other */
    double x_m;               /**< where, in the plane of the field; z_m: across it */
    double y_m;               /**< where, in the plane of the field */
    double normal_x;          /**< of length 1, from a to b (0); normal_z: across the plane */
    double normal_y;          /**< of length 1, from a to b (1) */
    double impulse_n_s;       /**< along the normal, in this step (PHYSVIB_UNKNOWN) */
    double tangential_n_s;    /**< across the normal, to its left, in the plane (0) */
    double approach_m_per_s;  /**< approach speed before the engine's solver (PHYSVIB_UNKNOWN) */
    double restitution;       /**< 0 to 1; used where no impulse is set (0) */
    double effective_mass_kg; /**< used where no impulse is set (PHYSVIB_UNKNOWN: from masses, inertias and
                                 places) */
    double fraction; /**< when they touch, in steps after this one's start: -1 (start of the step before) to 2
                        (an engine pushed before they meet) (PHYSVIB_UNKNOWN: by gap and approach) */
    double gap_m;    /**< between the surfaces when the engine looked; below 0: they overlap (0) */
    double gap_fraction;    /**< when that was, in steps after this one's start, 0 to 1 (0) */
    double along_a_m_per_s; /**< for a contact that lasts on a body with grains, with its impulse: how fast
                               the point moves along a's surface. Rolling: as along b's; sliding: 0 along what
                               drags its own point (PHYSVIB_UNKNOWN) */
    double along_b_m_per_s; /**< the same along b's (PHYSVIB_UNKNOWN) */
    int is_soft;  /**< PHYSVIB_SOFT or PHYSVIB_SOFT_WHOLE: the impulse of one step is no measure of an impact,
                     which follows from speed and restitution;  the impulse is the load of a pair that keeps
                     touching (0) */
    int point_id; /**< identifies the point within its pair: a number from 0 on, or PHYSVIB_POINT_BY_PLACE. A
                     point that was not there in the step before and approaches fast is an impact even while
                     its pair touches, and so is a sudden approach of one that lasts (PHYSVIB_POINT_NONE: the
                     pair is reported as a whole) */
    int is_impulse_of_pair; /**< 1: the impulses are those of the whole pair, repeated with each of its points
                               (0) */
    double z_m;             /**< where, across the plane of the field (0) */
    double normal_z;        /**< of length 1 with normal_x and normal_y, from a to b (0) */
    double friction_x_n_s;  /**< impulse on b across the normal, in space, instead of tangential_n_s (0) */
    double friction_y_n_s;  /**< the same (0) */
    double friction_z_n_s;  /**< the same (0) */
} physvib_contact;

/** What became of the contacts of a world, since it was created. */
typedef struct physvib_world_counts {
    size_t size;                   /**< set by init */
    physvib_int64 contacts;        /**< pairs that began to touch, and new points of touching pairs */
    physvib_int64 below_threshold; /**< of haptic sources (is_camera): slower than the threshold */
    physvib_int64 no_source;       /**< neither of the two bodies is a haptic source */
    physvib_int64 unplayable; /**< impacts without a frequency, a mass, or outside of what can be played */
    physvib_int64 muted;      /**< by is_muted, or a gain of 0 */
    physvib_int64 dropped;    /**< more in a step than there is room for, or than hits_per_step */
    physvib_int64 events;     /**< events that were created */
    double threshold_m_per_s; /**< in effect: threshold_m_per_s, and at least 1.5 times what gravity adds in
                                 the last step */
} physvib_world_counts;

/** What plays a world's events, for physvib_world_explain_output; defaults in brackets. No pointer is kept.
 */
typedef struct physvib_output_facts {
    size_t size;                  /**< set by init */
    int is_missing;               /**< 1: no device asks for samples (0) */
    int is_silent;                /**< 1: silence is held (0) */
    int channels;                 /**< that the device has; 0: as many as the layout has actuators (0) */
    double level;                 /**< gain of all channels (1) */
    physvib_int64 muted_channels; /**< bit j: channel j is muted, or its gain is 0 (0) */
    physvib_int64 late;           /**< events played after their time, so far (0) */
    physvib_int64 dropped;        /**< events for which there was no room, so far (0) */
    physvib_int64 rejected;       /**< events that cannot be played, so far (0) */
    const char* silent_by;        /**< who holds the silence; NULL: unknown (NULL) */
    const char* trouble;          /**< error of the device, in one line; NULL: none (NULL) */
    const physvib_renderer_settings* renderer; /**< layout and field; NULL: unknown (NULL) */
    physvib_int64 without_part; /**< events of a part of the body that no actuator is on, so far (0) */
} physvib_output_facts;

#define PHYSVIB_NOTE_SENSOR 0   /**< of physvib_world_note: it is a sensor, which touches nothing */
#define PHYSVIB_NOTE_FILTERED 1 /**< of physvib_world_note: a filter lets it touch no other body */
#define PHYSVIB_NOTE_DISABLED 2 /**< of physvib_world_note: the engine does not simulate it */
#define PHYSVIB_NOTE_ASLEEP 3   /**< of physvib_world_note: it rests until something wakes it */

/** The version, as "1.0.0" or "1.0.0-rc.1". Any thread. */
PHYSVIB_API const char* physvib_version(void);

/** The name of a panning law, as options and files have it; they are numbered from 0 (PHYSVIB_LAW_...); NULL
 * after the last one. Any thread. */
PHYSVIB_API const char* physvib_law_name(int law);

/** The last error of this thread, in one line; "" before the first. Valid until this thread's next call.
 * physvib_renderer_pull sets no text: it only returns its code. Any thread. */
PHYSVIB_API const char* physvib_error(void);

/** The defaults, in brackets above; `size`: sizeof *settings. Any thread, as the five functions below. */
PHYSVIB_API int physvib_renderer_settings_init(physvib_renderer_settings* settings, size_t size);
/** Empty; `size`: sizeof *status. */
PHYSVIB_API int physvib_renderer_status_init(physvib_renderer_status* status, size_t size);
/** The defaults; `size`: sizeof *settings. */
PHYSVIB_API int physvib_world_settings_init(physvib_world_settings* settings, size_t size);
/** The defaults; `size`: sizeof *body. */
PHYSVIB_API int physvib_body_init(physvib_body* body, size_t size);
/** The defaults; `size`: sizeof *contact. */
PHYSVIB_API int physvib_contact_init(physvib_contact* contact, size_t size);
/** Empty; `size`: sizeof *counts. */
PHYSVIB_API int physvib_world_counts_init(physvib_world_counts* counts, size_t size);
/** The defaults; `size`: sizeof *facts. */
PHYSVIB_API int physvib_output_facts_init(physvib_output_facts* facts, size_t size);

/** No event yet: fixture and other are -1, the rest is 0; `size`: sizeof *event. Any thread. */
PHYSVIB_API int physvib_event_init(physvib_event* event, size_t size);
/** All 0; `size`: sizeof *layout. Any thread. */
PHYSVIB_API int physvib_layout_init(physvib_layout* layout, size_t size);

/* ---- Layouts and files. Any thread; they allocate, and read or write files. ---- */

/** By its name, such as "phone4"; Docs/panning.md lists them. */
PHYSVIB_API int physvib_layout_preset(const char* name, physvib_layout* layout);
/** Layout files (JSON), see Docs/render.md. `path` is UTF-8. */
PHYSVIB_API int physvib_layout_load(const char* path, physvib_layout* layout);
/** The same from text in memory, zero-terminated. */
PHYSVIB_API int physvib_layout_parse(const char* text, physvib_layout* layout);
/** The same; PHYSVIB_ERROR_ARGUMENT if it could not be loaded again. */
PHYSVIB_API int physvib_layout_save(const char* path, const char* name, const physvib_layout* layout);
/** The number (physvib_event.part, physvib_layout.part; above 0) of the part of a body of that name, such as
 * "thumb"; Docs/space.md. Any name has one. Any thread. */
PHYSVIB_API int physvib_part(const char* name);

/** Event lists (CSV), see Docs/events.md. Returns how many there are; writes the first `capacity` of them to
 * `events`, which may be NULL if `capacity` is 0. */
PHYSVIB_API physvib_int64 physvib_events_load(const char* path, physvib_event* events,
                                              physvib_int64 capacity);
/** The same from text in memory, zero-terminated. */
PHYSVIB_API physvib_int64 physvib_events_parse(const char* text, physvib_event* events,
                                               physvib_int64 capacity);
/** The field that the list says its places span, in metres, for a renderer's settings; 0 and 0 if it says
 * none. */
PHYSVIB_API int physvib_events_load_field(const char* path, double* width_m, double* height_m);
/** The same from text in memory, zero-terminated. */
PHYSVIB_API int physvib_events_parse_field(const char* text, double* width_m, double* height_m);
/** Writes playable events, in time order, at most 10,000,000. */
PHYSVIB_API int physvib_events_save(const char* path, const physvib_event* events, physvib_int64 count);
/** The same, and the field that their places span: 0.001 to 1e6 m, or 0 and 0 to say none. */
PHYSVIB_API int physvib_events_save_field(const char* path, const physvib_event* events, physvib_int64 count,
                                          double width_m, double height_m);

/** Writes 32-bit float samples; channel j's frame n is samples[j * frames + n]. */
PHYSVIB_API int physvib_wav_save(const char* path, const float* samples, int channels, physvib_int64 frames,
                                 int rate_hz);

/** Renders events, in time order, to samples[channel * frames + n], frame n at n / rate_hz; the same samples
 * as `physvib render --from-events`. */
PHYSVIB_API int physvib_render(const physvib_renderer_settings* settings, const physvib_event* events,
                               physvib_int64 count, physvib_int64 frames, float* samples);

/* ---- Materials by name, and single impacts. ---- */

/** The name of a built-in material that vibrates, counted from 0; NULL after the last one. Any thread. */
PHYSVIB_API const char* physvib_material_name(int index);
/** Sets how a body vibrates to a built-in material: frequency, decay, overtones, grains. `body` must have
 * been initialised; its other members stay. Any thread. */
PHYSVIB_API int physvib_material(const char* name, physvib_body* body);
/** The same from a file of materials (JSON, Docs/materials.md). `path` is UTF-8. Any thread; reads the file.
 */
PHYSVIB_API int physvib_material_load(const char* path, const char* name, physvib_body* body);
/** The number (physvib_event.sound, above 0) of the sound of that name, such as a material's; Docs/events.md.
 * Any name has one. Any thread. */
PHYSVIB_API int physvib_sound(const char* name);

/** Writes the event of one impact at time 0: at that place of the field, as strong as `strength`, 0 to 1 of
 * full scale, with the vibration of a built-in material, or, if that is NULL, of 200 Hz and a decay of 30 per
 * second. Any thread. */
PHYSVIB_API int physvib_event_of(const char* material, double x_m, double y_m, double strength,
                                 physvib_event* event);

/* ---- A renderer: events in, samples out. ---- */

/** Creates a renderer; it takes 13 to 25 MB, depending on its channels. PHYSVIB_ERROR_FULL: there are 256.
 * Any thread. */
PHYSVIB_API int physvib_renderer_create(const physvib_renderer_settings* settings,
                                        physvib_renderer* renderer);
/** Frees it; waits for a call that is running on another thread. Any thread but R. */
PHYSVIB_API int physvib_renderer_free(physvib_renderer renderer);

/** Plays an event at its time, or at once if that has passed. PHYSVIB_ERROR_FULL: 8,192 events are waiting to
 * be pulled. One at a time. */
PHYSVIB_API int physvib_renderer_strike(physvib_renderer renderer, const physvib_event* event);
/** Plays one impact at the next pull: physvib_event_of(NULL, ...), then physvib_renderer_strike(). One at a
 * time. */
PHYSVIB_API int physvib_renderer_impact(physvib_renderer renderer, double x_m, double y_m, double strength);
/** The same of a built-in material. One at a time. */
PHYSVIB_API int physvib_renderer_impact_of(physvib_renderer renderer, const char* material, double x_m,
                                           double y_m, double strength);

/** The next `frames` (1 or more) of each channel, in channels[channel][0..frames). `channel_count`: the
 * renderer's. PHYSVIB_ERROR_BUSY. R. */
PHYSVIB_API int physvib_renderer_pull(physvib_renderer renderer, float* const* channels, int channel_count,
                                      int frames);
/** The same frame by frame. R. */
PHYSVIB_API int physvib_renderer_pull_interleaved(physvib_renderer renderer, float* samples,
                                                  int channel_count, int frames);

/** Sets the gain of a channel from that time on: 0 to 10,000, with a ramp of 10 ms. PHYSVIB_ERROR_FULL: 256
 * changes are waiting. One at a time. */
PHYSVIB_API int physvib_renderer_set_gain(physvib_renderer renderer, physvib_int64 time_ns, int channel,
                                          double gain);
/** Mutes a channel (1) or not (0), in the same way. One at a time. */
PHYSVIB_API int physvib_renderer_set_mute(physvib_renderer renderer, physvib_int64 time_ns, int channel,
                                          int is_muted);
/** Sets a gain of all channels, on top of their own, in the same way. One at a time. */
PHYSVIB_API int physvib_renderer_set_level(physvib_renderer renderer, physvib_int64 time_ns, double gain);
/** Changes the layout, law, exponent and field of later events; the other `settings` are ignored. At most as
 * many actuators as channels. What sounds already stays where it is. One at a time. */
PHYSVIB_API int physvib_renderer_set_layout(physvib_renderer renderer, physvib_int64 time_ns,
                                            const physvib_renderer_settings* settings);
/** What sounds at that time fades out within 10 ms, and no event before `until_ns` is played. One at a time.
 */
PHYSVIB_API int physvib_renderer_silence(physvib_renderer renderer, physvib_int64 time_ns,
                                         physvib_int64 until_ns);

/** The latency of the limiter's look-ahead, in frames. Any thread. */
PHYSVIB_API int physvib_renderer_latency_frames(physvib_renderer renderer);
/** The status after the last pull. One at a time. */
PHYSVIB_API int physvib_renderer_get_status(physvib_renderer renderer, physvib_renderer_status* status);

/** The output latency L (Docs/timings.md), in nanoseconds: an event of world time w that is played at w + L
 * is in time, whatever block and step it falls into, if the world's thread never pauses for longer than
 * `longest_gap_s`. Any thread. */
PHYSVIB_API physvib_int64 physvib_play_out_ns(int rate_hz, int block_frames, int steps_per_s,
                                              double longest_gap_s);

/* ---- A world: contacts in, events out. One at a time. ----
 * In each step call begin_step, move (where speeds or places are needed), touch for every pair that touches,
 * end_step; then take or send. Bodies are identified by numbers of the caller's, from 0 on, which events
 * contain. */

/** `settings` may be NULL: the defaults. PHYSVIB_ERROR_FULL: there are 256. Any thread. */
PHYSVIB_API int physvib_world_create(const physvib_world_settings* settings, physvib_world* world);
/** Frees it; waits for a call that is running on another thread. Any thread. */
PHYSVIB_API int physvib_world_free(physvib_world world);
/** Changes the settings from the next step on. */
PHYSVIB_API int physvib_world_configure(physvib_world world, const physvib_world_settings* settings);

/** Adds a body, or changes its values. */
PHYSVIB_API int physvib_world_set_body(physvib_world world, int body, const physvib_body* values);
/** Sets the mass that the engine gives a body now, 0: it does not move; its inertia changes by as much.
 * Nothing is done where it is the same. */
PHYSVIB_API int physvib_world_set_mass(physvib_world world, int body, double mass_kg);
/** `device` of a body, also after it was removed; 0: of one that was never added. */
PHYSVIB_API int physvib_world_device(physvib_world world, int body);
/** Removes a body; not within a step. */
PHYSVIB_API int physvib_world_remove_body(physvib_world world, int body);
/** Sets centre of mass, velocity and spin before the engine's solver. */
PHYSVIB_API int physvib_world_move(physvib_world world, int body, double x_m, double y_m, double vx_m_per_s,
                                   double vy_m_per_s, double spin_rad_per_s);
/** Sets velocity and spin after the engine's solver, within a step and before its contacts, for engines that
 * report no impulses: those of contacts that are soft, or have none, then follow from the momentum of their
 * two bodies. Give physvib_world_move the velocity without contacts, so including what gravity adds in the
 * step. Impacts are passed on along a row of bodies; a landing on a supported body is within 20 %; friction
 * and joints are unknown. */
PHYSVIB_API int physvib_world_moved(physvib_world world, int body, double vx_m_per_s, double vy_m_per_s,
                                    double spin_rad_per_s);
/** physvib_world_move in space: the field is the plane of the first two coordinates, the third goes across
 * it. Spin: about each axis, counter-clockwise seen from its end. `inverse_inertia_per_kg_m2`: the inverse of
 * its moments of inertia as it is turned now, a symmetric matrix in the world's axes (xx, yy, zz, xy, xz, yz;
 * 0: it cannot turn), as many engines have it; NULL: inertia_kg_m2 counts about every axis, as of a ball. */
PHYSVIB_API int physvib_world_move_in_space(physvib_world world, int body, const double centre_m[3],
                                            const double velocity_m_per_s[3], const double spin_rad_per_s[3],
                                            const double inverse_inertia_per_kg_m2[6]);
/** physvib_world_moved in space. */
PHYSVIB_API int physvib_world_moved_in_space(physvib_world world, int body, const double velocity_m_per_s[3],
                                             const double spin_rad_per_s[3]);
/** Sets the vibration of two kinds of surfaces that meet, whatever the haptic source's voice is. */
PHYSVIB_API int physvib_world_pair(physvib_world world, int surface, int other, double frequency_hz,
                                   double decay_per_s, double gain);

/** Begins a step of 0 to 3,600 seconds. Gravity: its magnitude, from which the load of resting bodies
 * follows. */
PHYSVIB_API int physvib_world_begin_step(physvib_world world, double seconds, double gravity_m_per_s2);
/** For engines that list what touches: a pair that was not listed in the step before begins, one that is not
 * listed again has ended. */
PHYSVIB_API int physvib_world_touch(physvib_world world, const physvib_contact* contact);
/** For engines with callbacks: shapes that were apart meet. */
PHYSVIB_API int physvib_world_begin(physvib_world world, const physvib_contact* contact);
/** For engines with callbacks: the impulse of a pair that keeps touching. */
PHYSVIB_API int physvib_world_push(physvib_world world, const physvib_contact* contact);
/** For engines with callbacks: a pair has separated. */
PHYSVIB_API int physvib_world_end(physvib_world world, int a, int b);
/** Ends the step. */
PHYSVIB_API int physvib_world_end_step(physvib_world world);

/** The world's time after the last step, in nanoseconds. */
PHYSVIB_API physvib_int64 physvib_world_time_ns(physvib_world world);
/** Writes the events that are final (a step later, in order; or, with `at_once`, all of them), at most
 * `capacity`; the others stay. Returns how many. */
PHYSVIB_API physvib_int64 physvib_world_take(physvib_world world, physvib_event* events,
                                             physvib_int64 capacity, int at_once);
/** Plays them with a renderer, `later_ns` (L) after their times. Returns how many. Events that do not fit
 * into its queue are lost and counted there. */
PHYSVIB_API physvib_int64 physvib_world_send(physvib_world world, physvib_renderer renderer,
                                             physvib_int64 later_ns, int at_once);
/** Impacts lost so far because there were more in a step than fit. */
PHYSVIB_API physvib_int64 physvib_world_drops(physvib_world world);
/** Counts what became of all contacts so far. */
PHYSVIB_API int physvib_world_get_counts(physvib_world world, physvib_world_counts* counts);
/** Writes one sentence to `text`: the most likely reason why nothing, or not everything, is felt of what
 * happened since the last explanation, and what to change. If nothing has happened since, the sentence is
 * about all time, and says so. `size` of `text`: 1 or more, 512 are enough. Returns the length of the
 * sentence.
 */
PHYSVIB_API int physvib_world_explain(physvib_world world, char* text, size_t size);
/** The same, also of what the world cannot see: the output that plays its events. */
PHYSVIB_API int physvib_world_explain_output(physvib_world world, const physvib_output_facts* facts,
                                             char* text, size_t size);
/** The same of a renderer that is pulled: its level, mutes, gains, layout, field and silence as they were set
 * last, its queue and its late events. */
PHYSVIB_API int physvib_renderer_explain(physvib_renderer renderer, physvib_world world, char* text,
                                         size_t size);
/** What the engine says of a body now, PHYSVIB_NOTE_...; call it before an explanation, which forgets it. It
 * counts if the body is a haptic source. */
PHYSVIB_API int physvib_world_note(physvib_world world, int body, int note);
/** Grains left out so far because there were more than 2,000 a second at one contact, or 50,000 in all; the
 * others are stronger by as much power. */
PHYSVIB_API physvib_int64 physvib_world_thinned(physvib_world world);

/* ---- Game controllers: events in, commands of their motors out. One at a time. ----
 * For programs that have a rumble call of their own; Docs/pads.md shows the calls of some engines.
 * Times are those of any clock of the program's that never goes back, such as physvib_world_time_ns. */

/** Commands of the two motors of a game controller. */
typedef struct physvib_motors {
    double low;  /**< of the heavy motor, in the left grip, 0 to 1 in steps of 0.01 */
    double high; /**< of the light motor, in the right grip, 0 to 1 in steps of 0.01 */
} physvib_motors;

/** Creates `count` controllers (1 to 64), numbered from 0, whose left and right grips are the left and right
 * ends of a field of that size. `profile`: NULL for "pad-generic", or the name or file of another
 * (Docs/pads.md). PHYSVIB_ERROR_FILE: there is no such profile. Any thread. */
PHYSVIB_API int physvib_pads_create(int count, double field_width_m, double field_height_m,
                                    const char* profile, physvib_pads* pads);
/** Frees them; waits for a call that is running on another thread. Any thread. */
PHYSVIB_API int physvib_pads_free(physvib_pads pads);

/** An event for a controller, at the time at which it is to be felt. Motors are slow, so the model wants it
 * 0.03 s (`lead_s` of the profile) before that; a later one begins at the next pull and is felt as strong.
 * Of more than 256 that wait the weakest is lost; PHYSVIB_ERROR_FULL: it is this one. */
PHYSVIB_API int physvib_pads_strike(physvib_pads pads, int pad, const physvib_event* event);
/** Takes a world's events, as physvib_world_take does, for one controller, `later_ns` after their times.
 * Returns how many; those for which there is no room are lost. */
PHYSVIB_API physvib_int64 physvib_pads_send(physvib_pads pads, int pad, physvib_world world,
                                            physvib_int64 later_ns, int at_once);
/** The commands to send now, once per frame: motors[j] is that of controller j. `until_ns`: the time now.
 * Per motor it is the strongest command since the last pull, so that a hit between two frames is not lost.
 * `capacity` of `motors`: at least the number of controllers, which is returned. PHYSVIB_ERROR_ORDER: the
 * time goes back. It does not allocate. */
PHYSVIB_API int physvib_pads_pull(physvib_pads pads, physvib_int64 until_ns, physvib_motors* motors,
                                  int capacity);
/** For a pause, or a new level: discards all events; the next pull gives 0, and its time may be any. */
PHYSVIB_API int physvib_pads_stop(physvib_pads pads);
/** A gain of all events, 0 to 10,000 (1); 0 stops the motors. */
PHYSVIB_API int physvib_pads_set_level(physvib_pads pads, double gain);

#ifdef __cplusplus
}
#endif
#endif
