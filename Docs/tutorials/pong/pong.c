/* SPDX-License-Identifier: MIT */
/* Pong for two: in your own controller you feel where the ball meets your paddle. Sticks, or W, S and the
 * arrow keys. ./pong SECONDS plays by itself for so long. */
#include <SDL.h>
#include <math.h>
#include <physvib/physvib.h>
#include <stdio.h>
#include <stdlib.h>

enum { left, right, ball, pixels = 600 }; /* the bodies; pixels of a metre */
static const double width = 1.6, high = 0.9, reach = 0.1, radius = 0.015, dt = 1.0 / 60.0; /* m, s */

static void failed(const char* what) {
    fprintf(stderr, "%s: %s%s\n", what, SDL_GetError(), physvib_error());
    exit(1);
}

static void addBodies(physvib_world world) {
    physvib_body body;
    physvib_body_init(&body, sizeof body);
    body.mass_kg = 0.05;
    physvib_world_set_body(world, ball, &body);
    body.mass_kg = 0.0, body.static_mass_kg = 0.1; /* the ball does not move a paddle */
    body.is_camera = 1;                            /* its impacts are felt */
    body.frequency_hz = 120.0, body.decay_per_s = 25.0;
    physvib_world_set_body(world, left, &body);
    physvib_world_set_body(world, right, &body);
}

static double stick(SDL_GameController* pad, int up, int down) { /* -1: down, 1: up */
    const Uint8* keys = SDL_GetKeyboardState(NULL);
    const double tilt = SDL_GameControllerGetAxis(pad, SDL_CONTROLLER_AXIS_LEFTY) / -32768.0;
    return keys[up] - keys[down] + (fabs(tilt) > 0.2 ? tilt : 0.0);
}

static void draw(SDL_Renderer* to, double x, double y, double w, double h) {
    const SDL_FRect box = {(float)(x - w), (float)(high - y - h), (float)(2 * w), (float)(2 * h)};
    SDL_RenderFillRectF(to, &box);
}

int main(int count, char** words) {
    const double seconds = count > 1 ? atof(words[1]) : INFINITY;
    double paddle[2] = {0.45, 0.45}, x = 0.8, y = 0.45, vx = 1.0, vy = 0.3, strongest[2] = {0, 0};
    SDL_GameController* controllers[2] = {NULL, NULL};
    int hits[2] = {0, 0}, j;
    physvib_world world;
    physvib_pads pads;
    SDL_Window* window;
    SDL_Renderer* to;
    if (SDL_Init(SDL_INIT_VIDEO | SDL_INIT_GAMECONTROLLER) != 0) failed("SDL");
    if (SDL_CreateWindowAndRenderer((int)(width * pixels), (int)(high * pixels), 0, &window, &to) != 0)
        failed("window");
    if (physvib_world_create(NULL, &world) || physvib_pads_create(2, 2 * reach, high, NULL, &pads))
        failed("world and pads");
    addBodies(world);
    SDL_RenderSetScale(to, pixels, pixels);
    for (; (double)physvib_world_time_ns(world) * 1e-9 < seconds && !SDL_QuitRequested(); SDL_Delay(16)) {
        physvib_motors motors[2];
        physvib_event event;
        SDL_SetRenderDrawColor(to, 0, 0, 0, 255);
        SDL_RenderClear(to);
        SDL_SetRenderDrawColor(to, 255, 255, 255, 255);
        x += vx * dt, y += vy * dt;
        if (y < radius || y > high - radius) vy = copysign(vy, high / 2 - y);
        physvib_world_begin_step(world, dt, 0.0);
        for (j = left; j <= right; ++j) {
            const double face = j == left ? 0.05 : width - 0.05, away = j == left ? 1.0 : -1.0;
            const double speed = seconds < INFINITY ? 20.0 * (y - paddle[j])
                                 : j == left        ? stick(controllers[j], SDL_SCANCODE_W, SDL_SCANCODE_S)
                                             : stick(controllers[j], SDL_SCANCODE_UP, SDL_SCANCODE_DOWN);
            if (controllers[j] == NULL) controllers[j] = SDL_GameControllerOpen(j);
            paddle[j] += 1.2 * dt * fmax(-1.0, fmin(1.0, speed));
            paddle[j] = fmax(reach, fmin(high - reach, paddle[j]));
            draw(to, face - 0.01 * away, paddle[j], 0.01, reach);
            if ((x - face) * away < radius && vx * away < 0 && fabs(y - paddle[j]) < reach + radius) {
                physvib_contact contact;
                physvib_contact_init(&contact, sizeof contact);
                contact.a = j, contact.b = ball;
                contact.approach_m_per_s = fabs(vx), contact.restitution = 1.0;
                contact.x_m = reach + paddle[j] - y; /* the upper end is felt on the left */
                if (physvib_world_touch(world, &contact) != PHYSVIB_OK) failed("touch");
                vx = away * fmin(2.5, 1.05 * fabs(vx)), vy += 4.0 * (y - paddle[j]);
            }
        }
        physvib_world_end_step(world);
        physvib_event_init(&event, sizeof event);
        for (; physvib_world_take(world, &event, 1, 1) == 1; ++hits[event.fixture])
            physvib_pads_strike(pads, event.fixture, &event);
        physvib_pads_pull(pads, physvib_world_time_ns(world), motors, 2);
        for (j = left; j <= right; ++j) { /* a command ends after 200 ms, so it stops if the game does */
            SDL_GameControllerRumble(controllers[j], (Uint16)(motors[j].low * 65535),
                                     (Uint16)(motors[j].high * 65535), 200);
            strongest[j] = fmax(strongest[j], fmax(motors[j].low, motors[j].high));
        }
        if (x < 0 || x > width) x = 0.8, y = 0.45, vx = copysign(1.0, -vx), vy = 0.3;
        draw(to, x, y, radius, radius);
        SDL_RenderPresent(to);
    }
    printf("%d + %d hits, strongest %.2f, %.2f\n", hits[0], hits[1], strongest[0], strongest[1]);
    return 0;
}
