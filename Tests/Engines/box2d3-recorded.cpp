// SPDX-License-Identifier: MIT
// The adapter for Box2D 3 where there is no Box2D 3: from contacts that were recorded.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <physvib/engines/physvib_box2d3.h>

const RecordedStep recorded[] = {
#include "Recorded/drop.inc"
};
const RecordedStep* recordedStep = recorded;
bool hasRecordedStepped = false;

namespace {

int failures = 0;
void demand(bool isTrue, const char* what) {
    if (isTrue) return;
    std::printf("FAILED: %s\n", what);
    ++failures;
}

/// The ball's hits, or how many; `numbered`: the floor has a number.
int play(bool numbered, physvib_event* events, physvib_box2d3& haptics) {
    physvib_world_settings settings;
    physvib_world_settings_init(&settings, sizeof settings);
    settings.normalisation_s_per_m = 1.0, settings.hand_mass_kg = 0.0;
    std::memset(&haptics, 0, sizeof haptics);
    demand(physvib_world_create(&settings, &haptics.world) == PHYSVIB_OK, "a world");
    physvib_body body;
    physvib_body_init(&body, sizeof body);
    if (numbered)
        demand(physvib_box2d3_set(&haptics, recordedFloor, 0, body) == PHYSVIB_OK, "the floor's number");
    body.is_camera = 1, body.frequency_hz = 200.0;
    demand(physvib_box2d3_set(&haptics, recordedBall, 1, body) == PHYSVIB_ERROR_ARGUMENT &&
               std::strncmp(physvib_error(), "decay:", 6) == 0,
           "a decay that is missing is refused");
    body.decay_per_s = 30.0;
    demand(physvib_box2d3_set(&haptics, recordedBall, 1, body) == PHYSVIB_OK, "the ball's number");
    for (const RecordedStep& step : recorded) {
        recordedStep = &step, hasRecordedStepped = false;
        physvib_box2d3_step(&haptics, 0.01, 4);
    }
    return static_cast<int>(physvib_world_take(haptics.world, events, 8, 1));
}

} // namespace

int main() {
    physvib_event events[8];
    physvib_box2d3 haptics;
    demand(play(true, events, haptics) == 2 && haptics.code == PHYSVIB_OK, "two hits, and no error");
    demand(physvib_box2d3_id(&haptics, recordedBall) == 1, "the ball is body 1");
    // The recording's own motion: the parabola of the step in which they meet.
    int hit = 0;
    for (int i = 0; i < static_cast<int>(sizeof recorded / sizeof *recorded) && hit < 2; ++i) {
        const RecordedStep& step = recorded[i];
        if (!(step.before < -0.5F && step.after > 0.0F)) continue;
        const double g = 9.81, v = -static_cast<double>(step.before),
                     gap = static_cast<double>(step.height) - 0.1, meets = std::sqrt(v * v + 2.0 * g * gap);
        const double offMs =
                         static_cast<double>(events[hit].time_ns) * 1e-6 - (10.0 * i + 1e3 * (meets - v) / g),
                     part = events[hit].impulse_n_s / (1.5 * meets) - 1.0;
        std::printf("hit %d: onset %+.3f ms, level %+.1f %%\n", hit + 1, offMs, 100.0 * part);
        demand(std::fabs(offMs) <= 0.15 && std::fabs(part) <= 0.03,
               "onset within 0.15 ms and level within 3 %");
        ++hit;
    }
    demand(hit == 2, "two landings in the recording");
    demand(physvib_box2d3_remove(&haptics, recordedBall) == PHYSVIB_OK &&
               physvib_box2d3_id(&haptics, recordedBall) == -1,
           "a number that is taken away");
    physvib_box2d3_free(&haptics);
    physvib_world_free(haptics.world);

    demand(play(false, events, haptics) == 0 && haptics.code == PHYSVIB_ERROR_ARGUMENT,
           "a floor without a number is an error");
    char why[256];
    physvib_box2d3_explain(&haptics, why, sizeof why);
    demand(std::strstr(why, "physvib_box2d3_set") != nullptr, "which names the call that is missing");
    physvib_box2d3_free(&haptics);
    physvib_world_free(haptics.world);
    return failures == 0 ? 0 : 1;
}
