// SPDX-License-Identifier: GPL-3.0-or-later
// What instructions.sh counts of physics, for so many STEPS:
//   box BODIES CAMERAS STEPS  a shaken box; cameras: 0: none, 4: the walls, more: all bodies as well,
//                             below 0: Box2D alone
//   balls COUNT GRAIN_MM STEPS  balls roll; grains of 0: a smooth floor, below 0: Box2D alone
#include "Worlds.h"
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

using namespace physvib;

std::size_t shake(int bodies, int cameras, int steps) {
    bench::ShakenBox box{bodies};
    Attachment attachment{box.world, {.fieldWidthMetres = 6.4}};
    if (cameras < 0)
        attachment.detach();
    else
        box.setAll(attachment, cameras);
    std::vector<CollisionEvent> events;
    std::size_t count = 0;
    for (int i = 0; i < steps; ++i) {
        box.shake(i);
        if (cameras < 0)
            box.world.Step(bench::stepSeconds, 8, 3);
        else
            attachment.step(bench::stepSeconds);
        events.clear();
        attachment.take(events);
        count += events.size();
    }
    return count;
}

std::size_t roll(int balls, double grainMetres, int steps) {
    bench::RollingBalls world{balls, grainMetres};
    std::size_t count = 0;
    for (int i = 0; i < steps; ++i) {
        world.step(i);
        count += world.events.size();
    }
    return count;
}

} // namespace

int main(int count, char** arguments) {
    if (count != 5) return 2;
    const int bodies = std::atoi(arguments[2]), steps = std::atoi(arguments[4]);
    const double option = std::atof(arguments[3]);
    const bool isBox = std::string_view{arguments[1]} == "box";
    const std::size_t events =
        isBox ? shake(bodies, static_cast<int>(option), steps) : roll(bodies, 1.0e-3 * option, steps);
    std::printf("events %zu\n", events);
    return 0;
}
