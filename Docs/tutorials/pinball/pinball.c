/* SPDX-License-Identifier: MIT */
/* A pinball whose cabinet has four exciters: what the ball strikes is felt where it is. Left and right arrow:
 * flippers. ./pinball [DEVICE [SECONDS]] plays on "JACK:system" or another device; with SECONDS by itself. */
#include <SDL.h>
#include <complex.h>
#include <math.h>
#include <physvib/physvib-live.h>
#include <stdio.h>

enum { bumper = 5, flipper = 8, ball = 10, parts = 10, pixels = 700 };           /* 0 to 4: walls */
static const double width = 0.56, high = 1.1, radius = 0.0135, dt = 1.0 / 480.0; /* m, s */
static const double gravity = 1.11; /* along a table that is tilted by 6.5 degrees, m/s^2 */
typedef double complex Vector;      /* x + I y, upwards */
/* Each part is a thick line and a body of its own. A flipper ends where its angle says. */
static Vector from[parts] = {0.00 + 0.00 * I, 0.00 + 1.10 * I, 0.56 + 1.10 * I, 0.00 + 0.30 * I,
                             0.56 + 0.30 * I, 0.16 + 0.81 * I, 0.39 + 0.86 * I, 0.27 + 0.63 * I,
                             0.16 + 0.15 * I, 0.40 + 0.15 * I};
static Vector to[parts] = {0.00 + 1.10 * I, 0.56 + 1.10 * I, 0.56 + 0.00 * I, 0.16 + 0.16 * I,
                           0.40 + 0.16 * I, 0.16 + 0.81 * I, 0.39 + 0.86 * I, 0.27 + 0.63 * I};
static double angle[parts];
static const struct {
    double thickness, restitution, frequency, decay;
} kinds[] = {{0.0, 0.4, 60.0, 25.0}, {0.037, 1.4, 150.0, 40.0}, {0.007, 0.3, 90.0, 30.0}};
static Vector place = -I, speed; /* of the ball */
static int kindOf(int part) { return (part >= bumper) + (part >= flipper); }
static double dot(Vector a, Vector b) { return creal(a * conj(b)); }
static double turn(int part, int isUp) { /* how fast, rad/s */
    const double before = angle[part], side = part == flipper ? 1.0 : -1.0;
    angle[part] = fmax(-0.45, fmin(0.5, before + (isUp ? 20.0 : -8.0) * dt));
    to[part] = from[part] + 0.09 * (side * cos(angle[part]) + I * sin(angle[part]));
    return side * (angle[part] - before) / dt;
}

/* The ball against a part: tells the world, and lets the ball bounce. */
static void collide(physvib_world world, int part, double spin) {
    const Vector along = to[part] - from[part];
    const double share = along == 0 ? 0 : dot(place - from[part], along) / dot(along, along);
    const Vector point = from[part] + fmax(0, fmin(1, share)) * along;
    const Vector normal = (place - point) / cabs(place - point);
    const double gap = cabs(place - point) - radius - kinds[kindOf(part)].thickness;
    physvib_contact contact;
    if (gap > 0) return;
    physvib_contact_init(&contact, sizeof contact);
    contact.a = part, contact.b = ball, contact.x_m = creal(point), contact.y_m = cimag(point);
    contact.normal_x = creal(normal), contact.normal_y = cimag(normal), contact.gap_m = gap;
    contact.approach_m_per_s = dot(I * spin * (point - from[part]) - speed, normal);
    contact.restitution = fmin(1.0, kinds[kindOf(part)].restitution);
    physvib_world_touch(world, &contact);
    place -= gap * normal;
    speed += (1 + kinds[kindOf(part)].restitution) * fmax(0, contact.approach_m_per_s) * normal;
}
static void draw(SDL_Renderer* screen, Vector a, Vector b, double half) {
    const int x = (int)(creal(a) * pixels), y = (int)((high - cimag(a)) * pixels), r = (int)(half * pixels);
    SDL_RenderDrawLine(screen, x, y, (int)(creal(b) * pixels), (int)((high - cimag(b)) * pixels));
    SDL_RenderFillRect(screen, &(SDL_Rect){x - r, y - r, 2 * r, 2 * r});
}
int main(int count, char** words) {
    const double seconds = count > 2 ? SDL_atof(words[2]) : INFINITY;
    physvib_renderer_settings settings;
    physvib_int64 start = 0, felt = 0;
    physvib_body body;
    physvib_world world;
    physvib_live live;
    SDL_Window* window;
    SDL_Renderer* screen;
    int i, step, balls = 0;
    physvib_renderer_settings_init(&settings, sizeof settings);
    physvib_layout_preset("cabinet4", &settings.layout);
    settings.field_width_m = width, settings.field_height_m = high;
    if (physvib_world_create(NULL, &world) != PHYSVIB_OK ||
        physvib_live_open(count > 1 ? words[1] : "JACK:system", &settings, NULL, &live) != PHYSVIB_OK ||
        SDL_Init(SDL_INIT_VIDEO) != 0 || SDL_CreateWindowAndRenderer(392, 770, 0, &window, &screen) != 0)
        return fprintf(stderr, "pinball: %s %s\n", physvib_live_error(), SDL_GetError()), 1;
    physvib_body_init(&body, sizeof body);
    body.mass_kg = 0.08;
    physvib_world_set_body(world, ball, &body);
    body.mass_kg = 0.0, body.static_mass_kg = 0.3, body.is_camera = 1, body.gain = 4.0; /* felt */
    for (i = 0; i < parts; physvib_world_set_body(world, i++, &body))
        body.frequency_hz = kinds[kindOf(i)].frequency, body.decay_per_s = kinds[kindOf(i)].decay;
    while ((double)physvib_world_time_ns(world) * 1e-9 < seconds && !SDL_QuitRequested()) {
        const Uint8* keys = SDL_GetKeyboardState(NULL);
        for (step = 0; step < 8; ++step, physvib_world_end_step(world)) {
            if (cimag(place) < -0.05) place = 0.5 + I, speed = -0.4 - 0.05 * (++balls % 7);
            speed -= I * gravity * dt, place += speed * dt;
            physvib_world_begin_step(world, dt, gravity);
            for (i = 0; i < parts; ++i) {
                const int key = keys[i == flipper ? SDL_SCANCODE_LEFT : SDL_SCANCODE_RIGHT];
                const int isUp = seconds < INFINITY ? cimag(place) < 0.18 : key;
                collide(world, i, i < flipper ? 0.0 : turn(i, isUp));
            }
        }
        physvib_live_align(live, world, &start); /* world time to session time */
        felt += physvib_live_send(live, world, start, 1);
        SDL_SetRenderDrawColor(screen, 0, 0, 0, 255), SDL_RenderClear(screen);
        SDL_SetRenderDrawColor(screen, 255, 255, 255, 255);
        for (i = 0; i < parts; ++i) draw(screen, from[i], to[i], kinds[kindOf(i)].thickness);
        draw(screen, place, place, radius), SDL_RenderPresent(screen), SDL_Delay(16);
    }
    return printf("%d impacts, %d balls\n", (int)felt, balls) < 0 || physvib_live_close(live) != PHYSVIB_OK;
}
