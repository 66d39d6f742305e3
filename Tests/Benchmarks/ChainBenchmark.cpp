// SPDX-License-Identifier: GPL-3.0-or-later
// The whole chain: one 64-frame block, warm and cold; what a strike costs; how far from real time many modes.
#include "Rain.h"
#include "Timing.h"
#include <benchmark/benchmark.h>
#include <chrono>

namespace {

using namespace physvib;
using bench::RainedOn;

constexpr double blockSeconds = static_cast<double>(bench::blockFrames) / bench::rate;

/// More than any cache holds, written between two blocks.
void coolDown() {
    static std::vector<char> memory(96 << 20);
    for (std::size_t i = 0; i < memory.size(); i += 64) ++memory[i];
    benchmark::ClobberMemory();
}

/// Arguments: channels, modes (each struck about 15 times a second), cold. Wall clock: a block that another
/// program interrupts is late, and counts.
void block(benchmark::State& state) {
    const int channels = static_cast<int>(state.range(0)), modes = static_cast<int>(state.range(1));
    const bool isCold = state.range(2) != 0;
    RainedOn chain{channels, std::min(1000, 15 * modes), modes};
    chain.seconds(2);
    using Clock = std::chrono::steady_clock;
    std::vector<double> shares, processor;
    for (auto _ : state) {
        if (isCold) coolDown();
        const double before = bench::now();
        const auto start = Clock::now();
        chain.block();
        const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
        processor.push_back(100 * (bench::now() - before) / blockSeconds);
        shares.push_back(100 * seconds / blockSeconds);
        state.SetIterationTime(seconds);
    }
    state.counters["median_%"] = bench::quantile(shares, 0.5);
    state.counters["p99.9_%"] = bench::quantile(shares, 0.999);
    state.counters["worst_%"] = *std::max_element(shares.begin(), shares.end());
    state.counters["cpu_p99.9_%"] = bench::quantile(processor, 0.999);
    state.counters["cpu_worst_%"] = *std::max_element(processor.begin(), processor.end());
    state.counters["live"] = chain.status().liveModes;
}
BENCHMARK(block)
    ->ArgNames({"channels", "modes", "cold"})
    ->Args({8, 64, 0})
    ->Args({4, 64, 0})
    ->Args({8, 1024, 0})
    ->Iterations(200'000)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(block)
    ->ArgNames({"channels", "modes", "cold"})
    ->Args({8, 64, 1})
    ->Iterations(1000)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

/// Nothing sounds: what an idle renderer costs.
void silence(benchmark::State& state) {
    RainedOn chain{8, 0, 1};
    chain.seconds(1);
    for (auto _ : state) chain.block();
}
BENCHMARK(silence);

/// Argument: strikes a second on 16 materials, 8 channels. By turns with the same chain at 10 strikes a
/// second, all of whose modes sound as well: the flat part. `flat_%`: it in the same way, at 20 a second.
void strikes(benchmark::State& state) {
    const int rate = static_cast<int>(state.range(0));
    RainedOn flat{8, 16, 16}, rained{8, rate, 16};
    for (auto* chain : {&flat, &rained}) chain->seconds(2);
    std::vector<double> costs, flats, ratios;
    const double part = 0.25; // of a second
    for (auto _ : state) {
        const double without = bench::secondsOf([&] { flat.seconds(part); }) / part;
        const double with = bench::secondsOf([&] { rained.seconds(part); }) / part;
        costs.push_back(1e9 * (with - without) / (rate - 16));
        ratios.push_back(with / without);
        flats.push_back(1e3 * without);
        state.SetIterationTime(with * part);
    }
    state.counters["flat_ms_per_s"] = bench::median(flats);
    state.counters["to_flat"] = bench::median(ratios);
    state.counters["ns_per_strike"] = bench::median(costs);
    state.counters["live"] = rained.status().liveModes;
}
BENCHMARK(strikes)
    ->ArgName("per_second")
    ->RangeMultiplier(10)
    ->Range(10, 100'000)
    ->Iterations(40)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

/// Arguments: channels, modes that all sound: seconds rendered per second.
void headroom(benchmark::State& state) {
    const int modes = static_cast<int>(state.range(1));
    RainedOn chain{static_cast<int>(state.range(0)), modes, modes};
    chain.seconds(2);
    std::vector<double> speeds;
    for (auto _ : state) {
        const double seconds = bench::secondsOf([&] { chain.seconds(0.25); });
        speeds.push_back(0.25 / seconds);
        state.SetIterationTime(seconds);
    }
    state.counters["x_real_time"] = bench::median(speeds);
    state.counters["live"] = chain.status().liveModes;
}
BENCHMARK(headroom)
    ->ArgNames({"channels", "modes"})
    ->Args({4, 64})
    ->Args({8, 64})
    ->Args({8, 1024})
    ->Args({8, 4096})
    ->Args({64, 1024})
    ->Iterations(40)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

} // namespace
