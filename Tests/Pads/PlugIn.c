/* SPDX-License-Identifier: MIT
 * Preloaded into a program, it plugs a virtual controller in once the program knows of controllers, and
 * writes what its motors are told to the file PHYSVIB_PAD_LOG: "MILLISECONDS low high", of the steady clock.
 * PHYSVIB_PAD_EVERY=SECONDS: unplugged and plugged in by turns. PHYSVIB_PADS=N: so many of them (1).
 * PHYSVIB_PAD_FIRST: it is there before the program asks. */
#include <SDL2/SDL.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

static int logFile = -1;

static double nowMs(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static void note(const char* words) {
    char line[120];
    const int n = snprintf(line, sizeof line, "%.3f %s\n", nowMs(), words);
    if (write(logFile, line, (size_t)n) != n) abort();
}

static void* of(const char* name) {
    static void* sdl;
    if (!sdl) sdl = dlopen("libSDL2-2.0.so.0", RTLD_NOW | RTLD_NOLOAD);
    return sdl ? dlsym(sdl, name) : NULL;
}
#define SDL(name) ((__typeof__(&SDL_##name))of("SDL_" #name))

static int SDLCALL told(void* which, Uint16 low, Uint16 high) {
    char words[80];
    snprintf(words, sizeof words, "%d %.4f %.4f", (int)(size_t)which, low / 65535.0, high / 65535.0);
    note(words);
    SDL_version version = {0};
    SDL(GetVersion)(&version);
    return version.patch < 50 ? 0 : 1; /* sdl2-compat asks SDL 3, to which 0 is a failure */
}

static SDL_JoystickID plugIn(int which) {
    SDL_VirtualJoystickDesc pad = {0};
    char* const name = malloc(20);
    snprintf(name, 20, "virtual %d", which);
    pad.version = SDL_VIRTUAL_JOYSTICK_DESC_VERSION;
    pad.type = SDL_JOYSTICK_TYPE_GAMECONTROLLER;
    pad.naxes = 6;
    pad.nbuttons = 15;
    pad.name = name;
    pad.userdata = (void*)(size_t)which;
    pad.Rumble = told;
    return SDL(JoystickGetDeviceInstanceID)(SDL(JoystickAttachVirtualEx)(&pad));
}

static void pullOut(SDL_JoystickID id) {
    SDL(LockJoysticks)();
    for (int i = SDL(NumJoysticks)() - 1; i >= 0; --i)
        if (SDL(JoystickGetDeviceInstanceID)(i) == id) SDL(JoystickDetachVirtual)(i);
    SDL(UnlockJoysticks)();
}

static void* run(void* unused) {
    const char *every = getenv("PHYSVIB_PAD_EVERY"), *pads = getenv("PHYSVIB_PADS");
    SDL_JoystickID last = -1;
    if (getenv("PHYSVIB_PAD_FIRST") && dlopen("libSDL2-2.0.so.0", RTLD_NOW))
        SDL(Init)(SDL_INIT_GAMECONTROLLER);
    while (!of("SDL_WasInit") || !SDL(WasInit)(SDL_INIT_GAMECONTROLLER)) usleep(1000);
    for (int i = 1; i <= (pads ? atoi(pads) : 1); ++i) last = plugIn(i);
    note("plugged in");
    for (int isIn = 1; every; isIn = !isIn) {
        usleep((useconds_t)(1e6 * atof(every)));
        if (!SDL(WasInit)(SDL_INIT_GAMECONTROLLER)) return unused;
        if (isIn)
            pullOut(last), note("pulled out");
        else
            last = plugIn(1), note("plugged in");
    }
    return unused;
}

__attribute__((constructor)) static void begin(void) {
    pthread_t thread;
    const char* path = getenv("PHYSVIB_PAD_LOG");
    unsetenv("LD_PRELOAD"); /* not for the program's children */
    if (!path) return;
    logFile = open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
    if (logFile < 0 || pthread_create(&thread, NULL, run, NULL) != 0) abort();
    pthread_detach(thread);
}
