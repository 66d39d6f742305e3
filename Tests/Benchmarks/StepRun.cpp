// SPDX-License-Identifier: GPL-3.0-or-later
// What instructions.sh counts of physics: of so many STEPS those from the 100th on, in the function
// `counted`.
//   box BODIES CAMERAS STEPS  a shaken box; cameras: 0: none, 4: the walls, more: all bodies as well,
//                             below 0: Box2D alone
//   balls COUNT GRAIN_MM STEPS  balls roll; grains of 0: a smooth floor, below 0: Box2D alone
#include "Worlds.h"
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

using namespace physvib;

constexpr int firstCounted = 100;

struct Shaken {
    Shaken(int bodies, int sources)
        : box{bodies}
        , isAlone{sources < 0} {
        if (isAlone)
            attachment.detach();
        else
            box.setAll(attachment, sources);
    }
    void step(int i) {
        box.shake(i);
        events.clear();
        if (isAlone) return box.world.Step(bench::stepSeconds, 8, 3);
        attachment.step(bench::stepSeconds);
        attachment.take(events);
    }
    bench::ShakenBox box;
    bool isAlone;
    Attachment attachment{box.world, {.fieldWidthMetres = 6.4}};
    std::vector<CollisionEvent> events;
};

template <class World>
std::size_t run(World& world, int from, int to) {
    std::size_t count = 0;
    for (int i = from; i < to; ++i) {
        world.step(i);
        count += world.events.size();
    }
    return count;
}

} // namespace

extern "C" [[gnu::noinline]] std::size_t plural(Shaken* box, bench::RollingBalls* balls, int steps) {
    return box != nullptr ? run(*box, firstCounted, steps) : run(*balls, firstCounted, steps);
}

int main(int count, char** arguments) {
    if (count != 5) return 2;
    const int bodies = std::atoi(arguments[2]), steps = std::atoi(arguments[4]);
    const double option = std::atof(arguments[3]);
    std::size_t events = 0;
    if (std::string_view{arguments[1]} == "box") {
        Shaken box{bodies, static_cast<int>(option)};
        events = run(box, 0, firstCounted) + plural(&box, nullptr, steps);
    } else {
        bench::RollingBalls balls{bodies, 1.0e-3 * option};
        events = run(balls, 0, firstCounted) + plural(nullptr, &balls, steps);
    }
    std::printf("events %zu\n", events);
    return 0;
}
