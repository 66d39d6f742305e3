// SPDX-License-Identifier: GPL-3.0-or-later
// A minute of "shake the box" from scene to WAV file, and its parts; the counter `times_real_time` is the figure.
#include "Host/OfflineRender.h"
#include "Host/WavSink.h"
#include "Files/SceneCatalogue.h"
#include "Physics/SceneRun.h"
#include <benchmark/benchmark.h>
#include <filesystem>

namespace {

using namespace physvib;

constexpr int seconds = 60, rateHz = 48000;
constexpr std::int64_t lengthNs = seconds * 1'000'000'000LL;

const Scene& scene() { return *findBuiltInScene("shake-the-box"); }

OfflineSettings settings() {
    EnchanterLayout layout;
    layoutPreset("phone4", layout);
    const PhantomPanner panner{layout, PanningLaw::linear, 1.0, scene().fieldWidthMetres, scene().fieldHeightMetres};
    return {{rateHz, 4, panner, true}, static_cast<std::int64_t>(seconds) * rateHz};
}

void count(benchmark::State& state) {
    state.counters["times_real_time"] = benchmark::Counter(seconds, benchmark::Counter::kIsIterationInvariantRate);
}

void sceneToWav(benchmark::State& state) {
    const auto path = (std::filesystem::temp_directory_path() / "physvib-bench.wav").string();
    for (auto _ : state) {
        const SceneEvents made = runScene(scene(), {}, lengthNs);
        WavSink wav{path, 4, rateHz};
        renderOffline(made.events, settings(), [&](const float* const* block, int frames) { return wav.write(block, frames); });
        if (!wav.finish().empty()) state.SkipWithError("the file could not be written");
        state.counters["events"] = static_cast<double>(made.events.size());
    }
    std::filesystem::remove(path);
    count(state);
}
BENCHMARK(sceneToWav)->Unit(benchmark::kMillisecond);

void physicsOnly(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(runScene(scene(), {}, lengthNs));
    count(state);
}
BENCHMARK(physicsOnly)->Unit(benchmark::kMillisecond);

void samplesOnly(benchmark::State& state) {
    const SceneEvents made = runScene(scene(), {}, lengthNs);
    for (auto _ : state) renderOffline(made.events, settings(), [](const float* const*, int) { return true; });
    count(state);
}
BENCHMARK(samplesOnly)->Unit(benchmark::kMillisecond);

} // namespace
