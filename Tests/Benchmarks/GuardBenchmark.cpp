// SPDX-License-Identifier: GPL-3.0-or-later
// What the last point costs, beside the renderer that it ends, in the same run by turns: OutputGuard as a
// share of a block's time, and as the renderer with it by the renderer without it, idle, loud, and while it
// acts; receipts as shares of a block's time and of its rendering.
#include "Live/Devices/Receipts.h"
#include "Rain.h"
#include "Timing.h"
#include <benchmark/benchmark.h>

namespace {

using namespace physvib;

enum Case { idle, loud, acting };

/// Arguments: channels, case.
void outputGuard(benchmark::State& state) {
    const int channels = static_cast<int>(state.range(0));
    const auto which = static_cast<Case>(state.range(1));
    EnchanterLayout layout{1.0, 1.0, channels, {}};
    for (int j = 0; j < channels; ++j)
        layout.places[static_cast<std::size_t>(j)] = {channels > 1 ? double(j) / (channels - 1) : 0.5, 0.5};
    const auto renderer = std::make_unique<HapticRenderer>();
    renderer->prepare({.sampleRateHz = bench::rate, .panner = {layout, PanningLaw::linear, 1.0, 1.0, 1.0}});
    const auto guard = std::make_unique<OutputGuard>();
    guard->prepare(bench::rate, channels, GuardPlace::rendered);
    bench::Rain rain{which == loud ? 1000 : 0, 64};
    std::vector<float> memory(static_cast<std::size_t>(channels * bench::blockFrames));
    std::vector<float*> out;
    for (int j = 0; j < channels; ++j) out.push_back(memory.data() + j * bench::blockFrames);
    std::int64_t frame = 0;
    constexpr int blocks = 200;
    std::vector<double> shares, ratios;
    for (auto _ : state) {
        double rendered = 0, guarded = 0;
        for (int b = 0; b < blocks; ++b) {
            rain.reach(frame);
            rendered += bench::secondsOf([&] { renderer->render(rain, out.data(), bench::blockFrames); });
            frame += bench::blockFrames;
        }
        if (which == acting) std::fill(memory.begin(), memory.end(), 0.5f);
        guarded = bench::secondsOf([&] {
            for (int b = 0; b < blocks; ++b) guard->process(out.data(), bench::blockFrames, which == idle);
        });
        const double block = static_cast<double>(bench::blockFrames) / bench::rate;
        shares.push_back(100.0 * guarded / (blocks * block));
        ratios.push_back(rendered / std::max(1e-12, rendered - guarded));
        state.SetIterationTime(guarded / blocks);
    }
    state.counters["percent_of_block"] = bench::median(shares);
    state.counters["with_by_without"] = which == acting ? 0.0 : bench::median(ratios);
}
BENCHMARK(outputGuard)
    ->ArgNames({"channels", "case"})
    ->ArgsProduct({{4, 16, 64}, {idle, loud, acting}})
    ->UseManualTime()
    ->Unit(benchmark::kNanosecond)
    ->Iterations(200);

/// Argument: channels.
void receipts(benchmark::State& state) {
    const int channels = static_cast<int>(state.range(0));
    bench::RainedOn chain{channels, 1000, 64};
    chain.seconds(1);
    Receipts kept{channels};
    kept.begin();
    const std::vector<float> samples(static_cast<std::size_t>(bench::blockFrames), 0.3f);
    const std::vector<const float*> outputs(static_cast<std::size_t>(channels), samples.data());
    constexpr int blocks = 200;
    std::int64_t frame = 0;
    std::vector<double> ofBlock, ofRendering;
    for (auto _ : state) {
        const double rendered = bench::secondsOf([&] {
            for (int b = 0; b < blocks; ++b) chain.block();
        });
        const double written = bench::secondsOf([&] {
            for (int b = 0; b < blocks; ++b, frame += bench::blockFrames)
                kept.take(0, frame, bench::rate, outputs.data(), bench::blockFrames);
        });
        ofBlock.push_back(100.0 * written * bench::rate / (blocks * bench::blockFrames));
        ofRendering.push_back(100.0 * written / rendered);
        state.SetIterationTime(written / blocks);
    }
    state.counters["percent_of_block"] = bench::median(ofBlock);
    state.counters["percent_of_rendering"] = bench::median(ofRendering);
}
BENCHMARK(receipts)
    ->ArgName("channels")
    ->Arg(4)
    ->Arg(16)
    ->Arg(64)
    ->UseManualTime()
    ->Unit(benchmark::kNanosecond)
    ->Iterations(200);

} // namespace
