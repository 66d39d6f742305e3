// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes from their start to a WAV file, a minute of "shake the box" also in its parts; the counter
// `times_real_time` is the figure.
#include "Io/Wav/WavSink.h"
#include "Live/Session/OfflineRender.h"
#include "Scene/SceneFile.h"
#include "Scene/World/Simulation.h"
#include <benchmark/benchmark.h>
#include <filesystem>

namespace {

using namespace physvib;

constexpr int rateHz = 48000;

OfflineSettings settingsFor(const Scene& scene, int seconds) {
    ActuatorLayout layout;
    layoutPreset("phone4", layout);
    const PhantomPanner panner{layout, PanningLaw::linear, 1.0, scene.fieldWidthMetres,
                               scene.fieldHeightMetres};
    return {{rateHz, 4, panner, true}, static_cast<std::int64_t>(seconds) * rateHz};
}

std::int64_t nanoseconds(int seconds) { return seconds * 1'000'000'000LL; }

void count(benchmark::State& state, int seconds) {
    state.counters["times_real_time"] =
        benchmark::Counter(seconds, benchmark::Counter::kIsIterationInvariantRate);
}

/// Any scene, physics and samples and file.
void sceneToWav(benchmark::State& state, const Scene& scene, int seconds) {
    const auto path = (std::filesystem::temp_directory_path() / "physvib-bench.wav").string();
    for (auto _ : state) {
        const SceneEvents made = simulateScene(scene, {}, nanoseconds(seconds));
        WavSink wav{path, 4, rateHz};
        renderOffline(made.events, settingsFor(scene, seconds),
                      [&](const float* const* block, int frames) { return wav.write(block, frames); });
        if (!wav.finish().empty()) state.SkipWithError("the file could not be written");
        state.counters["events"] = static_cast<double>(made.events.size());
    }
    std::filesystem::remove(path);
    count(state, seconds);
}

const int registered = [] {
    for (const Scene& scene : builtInScenes()) {
        const int seconds = scene.name == "shake-the-box" ? 60 : 10;
        benchmark::RegisterBenchmark(("sceneToWav/" + scene.name).c_str(), sceneToWav, scene, seconds)
            ->Unit(benchmark::kMillisecond);
    }
    return 0;
}();

const Scene& shakeTheBox() { return *findBuiltInScene("shake-the-box"); }

void physicsOnly(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(simulateScene(shakeTheBox(), {}, nanoseconds(60)));
    count(state, 60);
}
BENCHMARK(physicsOnly)->Unit(benchmark::kMillisecond);

void samplesOnly(benchmark::State& state) {
    const SceneEvents made = simulateScene(shakeTheBox(), {}, nanoseconds(60));
    for (auto _ : state)
        renderOffline(made.events, settingsFor(shakeTheBox(), 60),
                      [](const float* const*, int) { return true; });
    count(state, 60);
}
BENCHMARK(samplesOnly)->Unit(benchmark::kMillisecond);

} // namespace
