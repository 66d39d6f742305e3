// SPDX-License-Identifier: MIT
// The adapter for Box2D 3 where there is no Box2D 3: from contacts that were recorded.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <physvib/engines/physvib_box2d3.h>
#include <span>

const RecordedStep* recordedStep = nullptr;
bool hasRecordedStepped = false;
int recordedCopies = 1;

namespace {

constexpr double g = 9.81, radius = 0.1;
constexpr int subSteps = 4;
constexpr RecordedStep drop[] = {
#include "Recorded/drop.inc"
};
constexpr RecordedStep stopped[] = {
#include "Recorded/stopped.inc"
};
constexpr RecordedStep bullet[] = {
#include "Recorded/bullet.inc"
};
constexpr RecordedStep shallow[] = {
#include "Recorded/shallow.inc"
};

int failures = 0;
void demand(bool isTrue, const char* what) {
    if (isTrue) return;
    std::printf("FAILED: %s\n", what);
    ++failures;
}

physvib_body values(bool isSource) {
    physvib_body body;
    physvib_body_init(&body, sizeof body);
    body.is_camera = isSource ? 1 : 0, body.frequency_hz = isSource ? 200.0 : 0.0;
    body.decay_per_s = isSource ? 30.0 : 0.0;
    return body;
}

/// A world with the ball, which has a number; the floor has none yet.
struct Played {
    Played() {
        physvib_world_settings settings;
        physvib_world_settings_init(&settings, sizeof settings);
        settings.normalisation_s_per_m = 1.0, settings.hand_mass_kg = 0.0;
        demand(physvib_world_create(&settings, &haptics.world) == PHYSVIB_OK, "a world");
        demand(physvib_box2d3_set(&haptics, recordedBall, 1, values(true)) == PHYSVIB_OK,
               "the ball's number");
    }
    ~Played() {
        physvib_box2d3_free(&haptics);
        physvib_world_free(haptics.world);
    }
    Played(const Played&) = delete;
    Played& operator=(const Played&) = delete;
    void numberFloor() {
        demand(physvib_box2d3_set(&haptics, recordedFloor, 0, values(false)) == PHYSVIB_OK,
               "the floor's number");
    }
    int step(const RecordedStep& which, double seconds) {
        recordedStep = &which, hasRecordedStepped = false;
        return physvib_box2d3_step(&haptics, seconds, subSteps);
    }
    /// All but the last step, which says where the one before has ended.
    void play(std::span<const RecordedStep> steps, double seconds) {
        for (const RecordedStep& each : steps.first(steps.size() - 1))
            demand(step(each, seconds) == PHYSVIB_OK, "a step without an error");
        events[0].size = sizeof events[0];
        count = static_cast<int>(physvib_world_take(haptics.world, events, 8, 1));
    }
    physvib_box2d3 haptics{};
    physvib_event events[8]{};
    int count = 0;
};

/// How many steps after its start the ball of a step lands, on its parabola. Sub-steps change the velocity
/// before they move it.
double landsAfter(const RecordedStep& step, double seconds) {
    const double v = -static_cast<double>(step.before) + 0.5 * g * seconds / subSteps,
                 gap = static_cast<double>(step.height) - radius;
    return (std::sqrt(v * v + 2.0 * g * gap) - v) / g / seconds;
}

/// An event against the step from whose motion it follows, `index` steps after the first.
void judge(const char* name, const physvib_event& event, const RecordedStep& from, int index,
           double seconds) {
    const double after = landsAfter(from, seconds),
                 speed = -static_cast<double>(from.before) + g * after * seconds,
                 offMs = static_cast<double>(event.time_ns) * 1e-6 - 1e3 * seconds * (index + after),
                 part = event.impulse_n_s / ((speed > 1.0 ? 1.5 : 1.0) * speed) - 1.0;
    std::printf("%s: onset %+.3f ms, level %+.1f %%\n", name, offMs, 100.0 * part);
    demand(std::fabs(offMs) <= 0.15 && std::fabs(part) <= 0.03, "onset within 0.15 ms and level within 3 %");
}

void judgeFirst(const char* name, std::span<const RecordedStep> steps, double seconds) {
    Played played;
    played.numberFloor();
    played.play(steps, seconds);
    demand(played.count == 1, "one hit");
    judge(name, played.events[0], steps[0], 0, seconds);
}

/// Two landings, each against the step before it.
void judgeDrop() {
    Played played;
    played.numberFloor();
    played.play(drop, 0.01);
    demand(played.count == 2 && played.haptics.code == PHYSVIB_OK, "two hits, and no error");
    demand(physvib_box2d3_id(&played.haptics, recordedBall) == 1, "the ball is body 1");
    int hit = 0;
    for (int i = 0; i < static_cast<int>(std::size(drop)) && hit < 2; ++i)
        if (drop[i].before < -0.5F && drop[i].after > 0.0F)
            judge(hit == 0 ? "first hit" : "second hit", played.events[hit], drop[i], i, 0.01), ++hit;
    demand(hit == 2, "two landings in the recording");
    demand(physvib_box2d3_remove(&played.haptics, recordedBall) == PHYSVIB_OK &&
               physvib_box2d3_id(&played.haptics, recordedBall) == -1,
           "a number that is taken away");
}

/// The floor has no number for two steps of contact, then it gets one.
void judgeErrors() {
    Played played;
    demand(physvib_box2d3_set(&played.haptics, recordedBall, 1,
                              [] {
                                  physvib_body body = values(true);
                                  body.decay_per_s = 0.0;
                                  return body;
                              }()) == PHYSVIB_ERROR_ARGUMENT &&
               std::strncmp(physvib_error(), "decay:", 6) == 0,
           "a decay that is missing is refused");
    int told = 0, touching = 0;
    for (std::size_t i = 0; i + 1 < std::size(drop); ++i) {
        const bool isTouching = drop[i].isTouching != 0;
        if (isTouching && touching++ == 2) played.numberFloor();
        const int code = played.step(drop[i], 0.01);
        told += code != PHYSVIB_OK ? 1 : 0;
        const bool isWrong = isTouching && touching <= 2;
        demand(code == PHYSVIB_OK || code == played.haptics.code, "a code that stays for the step");
        demand(isWrong == (played.haptics.code == PHYSVIB_ERROR_ARGUMENT),
               "an error of the steps that make it");
        char why[256];
        physvib_box2d3_explain(&played.haptics, why, sizeof why);
        demand(isWrong == (std::strstr(why, "Box2D's body 1: ") != nullptr &&
                           std::strstr(why, "physvib_box2d3_set") != nullptr),
               "which names the body and the call that is missing");
    }
    demand(told == 1, "and is told once");
    played.events[0].size = sizeof played.events[0];
    demand(physvib_world_take(played.haptics.world, played.events, 8, 1) == 1, "the next hit is felt");
}

/// More contacts than there ever were of a body.
void judgeMany() {
    recordedCopies = 500;
    Played played;
    played.numberFloor();
    played.play(stopped, 1.0 / 60.0);
    demand(played.count == 1, "one hit of many points");
    recordedCopies = 1;
}

} // namespace

int main() {
    judgeDrop();
    judgeFirst("stopped by continuous collision", stopped, 1.0 / 60.0);
    judgeFirst("bullet", bullet, 1.0 / 60.0);
    judgeFirst("pushed before it lands", shallow, 1.0 / 60.0);
    judgeErrors();
    judgeMany();
    return failures == 0 ? 0 : 1;
}
