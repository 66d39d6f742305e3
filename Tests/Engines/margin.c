/* SPDX-License-Identifier: MIT */
/* MuJoCo's geoms with a margin, which push before they overlap: balls fall from 0.05 to 2 m, and each landing
 * is felt as hard as its speed at the margin says. */
#include <physvib/engines/physvib_mujoco.h>
#include <stdio.h>

static const double mass_kg = 0.3, radius = 0.1;

/* The impulse that is felt first, N s; 0: nothing is. */
static double felt(double height, double margin, double seconds) {
    char xml[1000], fault[300] = "";
    FILE* file = fopen("margin.xml", "w");
    mjModel* m;
    mjData* d;
    physvib_world world;
    physvib_world_settings settings;
    physvib_body body;
    physvib_event event;
    int count;
    sprintf(xml,
            "<mujoco><option timestep='%g'/><default><geom margin='%g'/></default><worldbody><geom "
            "type='plane' size='9 9 .1'/><body pos='0 0 %g'><freejoint/>"
            "<geom type='sphere' size='%g' mass='%g'/></body></worldbody></mujoco>",
            seconds, margin, radius + height, radius, mass_kg);
    fputs(xml, file);
    fclose(file);
    m = mj_loadXML("margin.xml", NULL, fault, sizeof fault);
    d = mj_makeData(m);
    physvib_world_settings_init(&settings, sizeof settings);
    settings.full_scale_impulse_n_s = 1;
    physvib_world_create(&settings, &world);
    physvib_body_init(&body, sizeof body);
    physvib_world_set_body(world, 0, &body);
    body.mass_kg = mass_kg, body.is_camera = 1, body.frequency_hz = 200, body.decay_per_s = 30;
    physvib_world_set_body(world, 1, &body);
    while (d->time < sqrt(2 * height / 9.81) + 0.3) physvib_mujoco_step(m, d, world, 0);
    physvib_event_init(&event, sizeof event);
    count = (int)physvib_world_take(world, &event, 1, 1);
    physvib_world_free(world);
    mj_deleteData(d);
    mj_deleteModel(m);
    return count > 0 ? event.impulse_n_s : 0;
}

int main(void) {
    static const double margins[] = {0, 0.001, 0.01}, steps[] = {0.002, 0.01};
    int wrong = 0, k;
    for (k = 0; k < 6; ++k) {
        double height, worst = 0;
        for (height = 0.05; height < 2; height *= 1.2) {
            const double due = mass_kg * sqrt(2 * 9.81 * (height - margins[k / 2])),
                         off = felt(height, margins[k / 2], steps[k % 2]) / due - 1;
            if (fabs(off) > fabs(worst)) worst = off;
        }
        printf("margin %g m, steps of %g s: at worst %+.1f %%\n", margins[k / 2], steps[k % 2], 100 * worst);
        wrong += fabs(worst) > 0.08;
    }
    return wrong;
}
