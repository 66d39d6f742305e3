// SPDX-License-Identifier: GPL-3.0-or-later
// What rolling and sliding costs: balls that roll to and fro on a smooth floor and on a rough one, by turns;
// and the samples of it.
#include "Core/HapticRenderer.h"
#include "Timing.h"
#include "Worlds.h"
#include <benchmark/benchmark.h>
#include <memory>
#include <vector>

namespace {

using namespace physvib;
using bench::median;
using bench::RollingBalls;
using bench::secondsOf;
using bench::stepSeconds;

constexpr int rate = 48000, block = 480;

/// A step's events, played two steps later.
struct StepEvents {
    bool pop(CollisionEvent& event) {
        if (next == events.size()) return false;
        event = events[next++];
        event.timeNs += 20'000'000;
        return true;
    }
    const std::vector<CollisionEvent>& events;
    std::size_t next = 0;
};

/// Arguments: balls; grains' spacing in mm.
void stepOfRollingBalls(benchmark::State& state) {
    const int count = static_cast<int>(state.range(0));
    RollingBalls smooth(count, 0.0), rough(count, 1.0e-3 * static_cast<double>(state.range(1)));
    const auto renderer = std::make_unique<HapticRenderer>();
    EnchanterLayout layout;
    layoutPreset("phone4", layout);
    RendererSettings settings{
        .sampleRateHz = rate,
        .panner = {layout, PanningLaw::linear, 1.0, 2.0 * static_cast<double>(count), 1.0}};
    const int channels = settings.outputs();
    renderer->prepare(settings);
    std::vector<std::vector<float>> samples(static_cast<std::size_t>(channels), std::vector<float>(block));
    std::vector<float*> out;
    for (auto& channel : samples) out.push_back(channel.data());
    std::vector<double> plain, grained, rendered;
    std::size_t events = 0;
    int n = 0;
    for (auto _ : state) {
        plain.push_back(secondsOf([&] { smooth.step(n); }));
        grained.push_back(secondsOf([&] { rough.step(n); }));
        ++n;
        events += rough.events.size();
        rendered.push_back(secondsOf([&] {
            StepEvents source{rough.events};
            renderer->render(source, out.data(), block);
        }));
        state.SetIterationTime(plain.back() + grained.back());
    }
    state.counters["step_us"] = 1.0e6 * median(plain);
    state.counters["with_grains_us"] = 1.0e6 * median(grained);
    state.counters["overhead_%"] = 100.0 * (median(grained) / median(plain) - 1.0);
    state.counters["strikes_per_s"] =
        static_cast<double>(events) / (static_cast<double>(n) * static_cast<double>(stepSeconds));
    state.counters["samples_%_of_core"] = 100.0 * median(rendered) / static_cast<double>(stepSeconds);
}
BENCHMARK(stepOfRollingBalls)
    ->ArgNames({"balls", "grain_mm"})
    ->ArgsProduct({{100}, {2, 5, 20}})
    ->Iterations(1500)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

} // namespace
