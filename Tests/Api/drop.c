/* SPDX-License-Identifier: MIT */
/* A ball of 0.2 kg falls from 0.8 m onto a floor, bounces and comes to rest: drop.wav, three seconds, four
 * channels. Any C since 1989. */
#include <physvib/physvib.h>
#include <stdio.h>
#include <stdlib.h>

static int failed(const char* what) {
    fprintf(stderr, "%s: %s\n", what, physvib_error());
    return 1;
}

int main(void) {
    const double g = 9.81, dt = 0.01, e = 0.6;
    const int frames = 3 * 48000;
    double height = 0.8, speed = -0.5 * g * dt; /* between two steps */
    float* samples = (float*)malloc(4 * frames * sizeof(float));
    physvib_event events[100];
    physvib_int64 count;
    physvib_renderer_settings settings;
    physvib_world_settings how;
    physvib_contact contact;
    physvib_world world;
    physvib_body body;
    int step;

    physvib_world_settings_init(&how, sizeof how);
    how.full_scale_impulse_n_s = PHYSVIB_AUTOMATIC; /* the hardest usual hit: half of full scale */
    if (physvib_world_create(&how, &world) != PHYSVIB_OK) return failed("world");
    physvib_body_init(&body, sizeof body);
    physvib_world_set_body(world, 0, &body); /* the floor: no mass, so nothing moves it */
    body.mass_kg = 0.2;
    body.is_camera = 1; /* it feels */
    body.frequency_hz = 200.0;
    body.decay_per_s = 30.0;
    physvib_world_set_body(world, 1, &body);

    physvib_contact_init(&contact, sizeof contact);
    contact.a = 0;
    contact.b = 1;
    contact.restitution = e;
    for (step = 0; step < 300; ++step) { /* your engine does this */
        speed += g * dt;
        physvib_world_begin_step(world, dt, g);
        if (height < speed * dt) {
            contact.x_m = 0.3;
            contact.approach_m_per_s = speed;
            contact.gap_m = height;
            if (physvib_world_touch(world, &contact) != PHYSVIB_OK) return failed("touch");
            if (speed > 0.3)
                speed = -e * speed;
            else
                speed = height = 0.0; /* it rests */
        }
        physvib_world_end_step(world);
        height -= speed * dt;
    }
    physvib_event_init(&events[0], sizeof events[0]);
    count = physvib_world_take(world, events, 100, 1);
    physvib_world_free(world);

    physvib_renderer_settings_init(&settings, sizeof settings); /* 48 kHz, an actuator at each corner */
    settings.field_width_m = settings.field_height_m = 1.0;
    if (samples == NULL || physvib_render(&settings, events, count, frames, samples) != PHYSVIB_OK)
        return failed("render");
    if (physvib_wav_save("drop.wav", samples, 4, frames, settings.rate_hz) != PHYSVIB_OK)
        return failed("drop.wav");
    printf("%d hits, the first at %.4f s: drop.wav\n", (int)count, (double)events[0].time_ns * 1e-9);
    free(samples);
    return 0;
}
