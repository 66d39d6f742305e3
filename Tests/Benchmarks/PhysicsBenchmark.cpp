// SPDX-License-Identifier: GPL-3.0-or-later
// What catching collisions costs on top of Box2D's own step: two equal shaken boxes, one attached to, step by
// turns.
#include "Physics/Attachment.h"
#include "Timing.h"
#include "Worlds.h"
#include <algorithm>
#include <benchmark/benchmark.h>
#include <vector>

namespace {

using namespace physvib;
using bench::median;
using bench::secondsOf;
using bench::ShakenBox;
using bench::stepSeconds;

constexpr HapticFixture wall{349.0, 107.0, true, 340.0, Voice::own};

constexpr int warmUpSteps(int bodies) { return bodies <= 1000 ? 200 : 75; }
constexpr int timedSteps(int bodies) { return bodies <= 100 ? 2000 : bodies <= 1000 ? 200 : 24; }

/// Arguments: bodies; cameras (0: none, 4: the walls, more: all bodies as well); whether the timing is
/// release.
void stepOfAShakenBox(benchmark::State& state) {
    const int bodies = static_cast<int>(state.range(0));
    ShakenBox plain(bodies), felt(bodies);
    const auto cameras = state.range(1);
    Attachment attachment(felt.world,
                          {.fieldWidthMetres = 6.4,
                           .timing = state.range(2) != 0 ? ImpactTiming::release : ImpactTiming::onset});
    felt.setAll(attachment, static_cast<int>(cameras));

    std::vector<double> without, with;
    std::vector<CollisionEvent> events;
    std::size_t count = 0;
    int step = 0;
    const auto run = [&] {
        plain.shake(step);
        felt.shake(step);
        const auto stepPlain = [&] { return secondsOf([&] { plain.world.Step(stepSeconds, 8, 3); }); };
        const bool isPlainFirst = step++ % 2 == 0; // whoever comes second finds the code in the caches
        const double first = isPlainFirst ? stepPlain() : 0.0;
        const double all = secondsOf([&] {
            attachment.step(stepSeconds);
            events.clear();
            attachment.take(events);
        });
        const double own = isPlainFirst ? first : stepPlain();
        without.push_back(own);
        with.push_back(all);
        count += events.size();
        return own + all;
    };
    for (int i = 0; i < warmUpSteps(bodies); ++i) run();
    without.clear();
    with.clear();
    count = 0;
    for (auto _ : state) state.SetIterationTime(run());
    const auto steps = static_cast<double>(state.iterations());
    const double box2d = median(without), attached = median(with);
    state.counters["box2d_us"] = 1.0e6 * box2d;
    state.counters["attached_us"] = 1.0e6 * attached;
    state.counters["overhead_%"] = 100.0 * (attached / box2d - 1.0);
    state.counters["touching"] = plain.touching();
    state.counters["events_per_step"] = static_cast<double>(count) / steps;
    state.counters["drops"] = static_cast<double>(attachment.drops());
}
const int registered = [] {
    const auto add = [](int bodies, int cameras, int release) {
        benchmark::RegisterBenchmark("stepOfAShakenBox", stepOfAShakenBox)
            ->ArgNames({"bodies", "cameras", "release"})
            ->Args({bodies, cameras, release})
            // one run each: setting up costs more than stepping
            ->Iterations(timedSteps(bodies))
            ->UseManualTime()
            ->Unit(benchmark::kMicrosecond);
    };
    for (const int bodies : {10, 100, 1000})
        for (const int cameras : {0, 4, 5000}) add(bodies, cameras, 0);
    for (const int cameras : {4, 5000}) add(5000, cameras, 0);
    for (const int cameras : {0, 4, 5000}) add(1000, cameras, 1);
    return 0;
}();

/// A map of still tiles on which ten balls bounce. Arguments: tiles; whether all are cameras; whether the
/// timing is release.
void stepAmongTiles(benchmark::State& state) {
    const int tiles = static_cast<int>(state.range(0));
    struct Map {
        explicit Map(int count) {
            const b2BodyDef def;
            b2Body* const ground = world.CreateBody(&def);
            const int columns = std::max(20, count / 20);
            for (int i = 0; i < count; ++i) {
                b2PolygonShape tile;
                tile.SetAsBox(0.5F, 0.5F, {static_cast<float>(i % columns), -static_cast<float>(i / columns)},
                              0.0F);
                fixtures.push_back(ground->CreateFixture(&tile, 0.0F));
            }
            for (int i = 0; i < 10; ++i) {
                b2BodyDef ball;
                ball.type = b2_dynamicBody;
                ball.allowSleep = false;
                ball.position = {1.5F * static_cast<float>(i) + 1.0F, 2.0F + 0.3F * static_cast<float>(i)};
                b2CircleShape circle;
                circle.m_radius = 0.3F;
                fixtures.push_back(world.CreateBody(&ball)->CreateFixture(&circle, 10.0F));
                fixtures.back()->SetRestitution(1.0F);
            }
        }
        b2World world{{0.0F, -9.8F}};
        std::vector<b2Fixture*> fixtures;
    } plain(tiles), felt(tiles);
    ImpactSettings settings;
    settings.timing = state.range(2) != 0 ? ImpactTiming::release : ImpactTiming::onset;
    Attachment attachment(felt.world, settings);
    for (b2Fixture* fixture : felt.fixtures)
        if (state.range(1) != 0 || fixture->GetBody()->GetType() == b2_dynamicBody)
            (void)attachment.set(*fixture, wall);
    std::vector<double> without, with;
    std::vector<CollisionEvent> events;
    for (auto _ : state) {
        without.push_back(secondsOf([&] { plain.world.Step(stepSeconds, 8, 3); }));
        with.push_back(secondsOf([&] {
            attachment.step(stepSeconds);
            attachment.take(events);
        }));
        state.SetIterationTime(without.back() + with.back());
    }
    const double box2d = median(without), attached = median(with);
    state.counters["box2d_us"] = 1.0e6 * box2d;
    state.counters["attached_us"] = 1.0e6 * attached;
    state.counters["added_us"] = 1.0e6 * (attached - box2d);
    state.counters["events"] = static_cast<double>(events.size());
}
BENCHMARK(stepAmongTiles)
    ->ArgNames({"tiles", "cameras", "release"})
    ->ArgsProduct({{50000}, {0, 1}, {0, 1}})
    ->Iterations(500)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

} // namespace
