// SPDX-License-Identifier: GPL-3.0-or-later
// The mode bank alone, per instruction set, modes, channels and block: its rate in mode-sample-channels, and
// as a share of the multiply-adds that the same core does at most, measured by turns in the same run. A share
// of 1 is the floor of one multiply-add per mode, sample and channel; low rank goes above it.
#include "Core/Modes/ModeBank.h"
#include "PeakRate.h"
#include "Timing.h"
#include <benchmark/benchmark.h>
#include <cmath>
#include <memory>
#include <random>
#include <string>

namespace {

using namespace physvib;
using bench::secondsOf;

constexpr int rate = 48000, tile = ModeBank::tile;

/// `modes` modes of log-uniform frequency that sound on for hours.
struct Sounding {
    std::unique_ptr<ModeBank> bank = std::make_unique<ModeBank>();
    std::vector<float> memory;
    std::vector<float*> channels;
    std::int64_t frame = 0;

    Sounding(InstructionSet set, int modes, int count, double lowHz, double highHz)
        : memory(static_cast<std::size_t>(count * tile)) {
        for (int j = 0; j < count; ++j) channels.push_back(memory.data() + j * tile);
        bank->prepare(rate, count, set);
        std::mt19937 random{1};
        const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
        std::vector<double> gains(channels.size());
        for (int i = 0; i < modes; ++i) {
            for (auto& g : gains) g = uniform();
            bank->strike({lowHz * std::pow(highHz / lowHz, uniform()),
                          1e-4 * (1 + uniform()),
                          0.01,
                          {0, uniform()},
                          Strike::never},
                         gains.data());
        }
    }
    void render(int blocks, int block) {
        for (int b = 0; b < blocks; ++b)
            for (int done = 0; done < block;) {
                const int part = std::min(block - done, tile - static_cast<int>(frame % tile));
                bank->render(channels.data(), frame, part);
                frame += part;
                done += part;
            }
        benchmark::DoNotOptimize(memory.data());
    }
};

/// Arguments: channels, modes, block.
void kernel(benchmark::State& state, InstructionSet set, double lowHz, double highHz) {
    if (!isAvailable(set)) return state.SkipWithError("this processor or program lacks it");
    const int channels = static_cast<int>(state.range(0)), modes = static_cast<int>(state.range(1)),
              block = static_cast<int>(state.range(2));
    Sounding sounding{set, modes, channels, lowHz, highHz};
    const double perBlock = static_cast<double>(channels) * modes * block;
    const int blocks = std::max(2, static_cast<int>(4e6 / perBlock));
    sounding.render(blocks, block);
    std::vector<double> shares, rates, peaks;
    for (auto _ : state) {
        double done = 0;
        const double before = secondsOf([&] { done = bench::multiplyAdds(set); });
        const double own = secondsOf([&] { sounding.render(blocks, block); });
        const double after = secondsOf([&] { done = bench::multiplyAdds(set); });
        const double peak = 2 * done / (before + after), rendered = perBlock * blocks / own;
        shares.push_back(rendered / peak);
        rates.push_back(rendered);
        peaks.push_back(peak);
        state.SetIterationTime(own);
    }
    state.counters["share"] = bench::median(shares);
    state.counters["share_p10"] = bench::quantile(shares, 0.1);
    state.counters["share_p90"] = bench::quantile(shares, 0.9);
    state.counters["Gmsc/s"] = 1e-9 * bench::median(rates);
    state.counters["peak_Gmadd/s"] = 1e-9 * bench::median(peaks);
    state.counters["x_real_time"] = bench::median(rates) / (static_cast<double>(channels) * modes * rate);
}

const int registered = [] {
    for (const auto set : {InstructionSet::scalar, InstructionSet::sse4, InstructionSet::avx2,
                           InstructionSet::avx512, InstructionSet::neon}) {
        const std::string name{nameOf(set)};
        const auto log = benchmark::RegisterBenchmark(("kernel/" + name).c_str(), kernel, set, 20.0, 1000.0);
        const auto high =
            benchmark::RegisterBenchmark(("kernel_800_1000Hz/" + name).c_str(), kernel, set, 800.0, 1000.0);
        for (auto* b : {log, high})
            b->ArgNames({"channels", "modes", "block"})
                ->UseManualTime()
                ->Unit(benchmark::kMicrosecond)
                ->Iterations(set == InstructionSet::scalar ? 20 : 200);
        for (const int channels : {1, 2, 4, 8, 16})
            for (const int modes : {4, 16, 64, 256, 1024, 4096}) log->Args({channels, modes, 64});
        for (const int block : {1, 16, 256, 4096}) log->Args({4, 64, block});
        for (const int modes : {64, 1024}) high->Args({4, modes, 64})->Args({8, modes, 64});
    }
    return 0;
}();

} // namespace
