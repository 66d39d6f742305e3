/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A world that is stepped as time goes on, felt by the library's default call: door SECONDS STEPS_PER_S.
 * Every 150 ms a hit, somewhere within its step, which is taken to begin when it is told. Prints the session
 * times of contacts, then, in another column, of onsets. */
#define _POSIX_C_SOURCE 200809L
#include <physvib/physvib-live.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

int door_listen(physvib_live live);
void door_leave(void);
physvib_int64 door_onset(int k);

static int failed(void) { return fprintf(stderr, "%s %s\n", physvib_live_error(), physvib_error()), 1; }

int main(int count, char** words) {
    const int rate = count > 2 ? atoi(words[2]) : 100, steps = (count > 1 ? atoi(words[1]) : 5) * rate;
    physvib_renderer_settings renderer;
    physvib_live_status status;
    physvib_int64 start = 0;
    physvib_contact contact;
    struct timespec due;
    physvib_world world;
    physvib_body body;
    physvib_live live;
    int step;

    physvib_renderer_settings_init(&renderer, sizeof renderer);
    renderer.field_width_m = renderer.field_height_m = 1.0;
    physvib_body_init(&body, sizeof body);
    physvib_contact_init(&contact, sizeof contact);
    contact.a = 0, contact.b = 1, contact.x_m = contact.y_m = 0.5, contact.approach_m_per_s = 3.0;
    if (physvib_live_open("JACK:system", &renderer, NULL, &live) != PHYSVIB_OK || door_listen(live) != 0 ||
        physvib_world_create(NULL, &world) != PHYSVIB_OK ||
        physvib_world_set_body(world, 0, &body) != PHYSVIB_OK)
        return failed();
    body.is_camera = 1, body.mass_kg = 1.0, body.frequency_hz = 1000.0, body.decay_per_s = 200.0;
    if (physvib_world_set_body(world, 1, &body) != PHYSVIB_OK) return failed();
    clock_gettime(CLOCK_MONOTONIC, &due);
    for (step = 0; step < steps; ++step) {
        const double fraction = step * 37 % 100 / 100.0;
        due.tv_nsec += 1000000000 / rate;
        due.tv_sec += due.tv_nsec / 1000000000, due.tv_nsec %= 1000000000;
        clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, NULL);
        physvib_world_begin_step(world, 1.0 / rate, 9.81);
        contact.fraction = fraction;
        if (step > rate / 2 && step % (rate * 15 / 100) == 0) {
            printf("%lld\n", (long long)(physvib_live_now_ns(live) + fraction * 1e9 / rate));
            if (physvib_world_touch(world, &contact) != PHYSVIB_OK) return failed();
        }
        physvib_world_end_step(world);
        if (physvib_live_align(live, world, &start) != PHYSVIB_OK ||
            physvib_live_send(live, world, start, 1) < 0)
            return failed();
    }
    for (step = 0; door_onset(step) != 0; ++step) printf("- %lld\n", (long long)door_onset(step));
    physvib_live_status_init(&status, sizeof status);
    physvib_live_get_status(live, &status);
    fprintf(stderr, "L %.1f ms, %d played, %d late, %d xruns\n", (double)physvib_live_latency_ns(live) * 1e-6,
            (int)status.played, (int)status.late, status.xruns);
    door_leave();
    return physvib_live_close(live);
}
