// SPDX-License-Identifier: GPL-3.0-or-later
// What compare.sh times of two commits: figures of one instruction set, a line each: name, tab, value.
// Compiles against both.
#include "Core/Nonblocking.h"
#include "Rain.h"
#include "Timing.h"
#include <cstdio>
#include <malloc.h>
#include <string>
#include <string_view>

namespace {

using namespace physvib;
using bench::blockFrames;
using bench::median;
using bench::RainedOn;
using bench::rate;
using bench::secondsOf;
using bench::settingsFor;

void tell(const char* name, double value) { std::printf("%s\t%.6g\n", name, value); }

InstructionSet setNamed(std::string_view name) {
    const auto found = std::find(instructionSetNames.begin(), instructionSetNames.end(), name);
    return static_cast<InstructionSet>(found - instructionSetNames.begin());
}

std::vector<CollisionEvent> tones(int count, double decayPerSecond) {
    std::vector<CollisionEvent> events(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        auto& e = events[static_cast<std::size_t>(i)];
        e.frequencyHz = 20.0 * std::pow(50.0, (i + 0.5) / count);
        e.decayPerSecond = decayPerSecond;
        e.amplitude = 0.5 / count;
        e.x = e.y = 0.3;
    }
    return events;
}

/// A renderer with what it is given and what it writes to.
struct Chain {
    Chain(int channels, InstructionSet set, std::vector<CollisionEvent> given)
        : events{std::move(given)}
        , settings{settingsFor(channels, set)}
        , memory(static_cast<std::size_t>(channels * blockFrames)) {
        for (int j = 0; j < channels; ++j) out.push_back(memory.data() + j * blockFrames);
        renderer->prepare(settings);
    }
    bool pop(CollisionEvent& event) noexcept {
        if (next == events.size()) return false;
        event = events[next++];
        return true;
    }
    void blocks(int count) noexcept {
        for (int i = 0; i < count; ++i) renderer->render(*this, out.data(), blockFrames);
    }
    std::vector<CollisionEvent> events;
    std::size_t next = 0;
    RendererSettings settings;
    std::vector<float> memory;
    std::vector<float*> out;
    std::unique_ptr<HapticRenderer> renderer = std::make_unique<HapticRenderer>();
};

void strikes(InstructionSet set) {
    for (const int perSecond : {10, 100, 1000, 10'000, 100'000, 1'000'000}) {
        const int materials = std::min(16, perSecond);
        RainedOn flat{8, materials, materials, set}, rained{8, perSecond, materials, set};
        for (auto* chain : {&flat, &rained}) chain->seconds(2);
        std::vector<double> costs, whole;
        for (int i = 0; i < 15; ++i) {
            const double without = secondsOf([&] { flat.seconds(0.25); }),
                         with = secondsOf([&] { rained.seconds(0.25); });
            costs.push_back(4e9 * (with - without) / std::max(1, perSecond - materials));
            whole.push_back(4e6 * with);
        }
        const std::string name = std::to_string(perSecond) + " strikes a second, ";
        // too few to tell what one costs
        if (perSecond < 1000)
            tell((name + "us for all of it").c_str(), median(whole));
        else
            tell((name + "ns each").c_str(), median(costs));
    }
}

void chainAndBank(InstructionSet set) {
    constexpr int channels = 4, together = 1000;
    const auto voices = tones(64, 1e-4); // they sound for hours
    Chain chain{channels, set, voices};
    const auto bank = std::make_unique<ModeBank>();
    bank->prepare(rate, channels, set);
    PhantomPanner::Gains gains{};
    chain.settings.panner.gainsAt(0.3, 0.3, gains);
    for (const auto& e : voices)
        bank->strike({e.frequencyHz, e.decayPerSecond, e.amplitude, {}, Strike::never}, gains.data());
    std::int64_t frame = 0;
    std::vector<double> ratios, chains;
    for (int i = 0; i < 100; ++i) {
        const double alone = secondsOf([&] {
            for (int b = 0; b < together; ++b, frame += blockFrames)
                bank->render(chain.out.data(), frame, blockFrames);
        });
        const double whole = secondsOf([&] { chain.blocks(together); });
        ratios.push_back(whole / alone);
        chains.push_back(1e9 * whole / together);
    }
    tell("ns a block, 64 modes x 4 channels", median(chains));
    tell("whole chain over the bank alone", median(ratios));
}

void silence(InstructionSet set) {
    Chain chain{8, set, {}};
    std::vector<double> costs;
    for (int i = 0; i < 100; ++i) costs.push_back(1e9 * secondsOf([&] { chain.blocks(1000); }) / 1000);
    tell("ns a silent block, 8 channels", median(costs));
}

// The first block of a renderer just made, in which 64 modes begin, over the same block of one that has
// played already; and a block on empty caches over one on full ones.
void cold(InstructionSet set) {
    std::vector<double> first, again, empty, full;
    std::vector<char> other(96 << 20);
    for (int i = 0; i < 25; ++i) {
        Chain chain{4, set, tones(64, 1.0)};
        first.push_back(secondsOf([&] { chain.blocks(1); }));
        for (int k = 0; k < 3; ++k) {
            chain.blocks(100);
            chain.renderer->prepare(chain.settings);
            chain.next = 0;
            again.push_back(secondsOf([&] { chain.blocks(1); }));
        }
        for (std::size_t at = 0; at < other.size(); at += 64) ++other[at];
        empty.push_back(secondsOf([&] { chain.blocks(1); }));
        full.push_back(secondsOf([&] { chain.blocks(200); }) / 200);
    }
    tell("first block of all over the same later", median(first) / median(again));
    tell("block on empty caches over a warm one", median(empty) / median(full));
}

std::size_t bytesTaken() {
    const auto now = mallinfo2();
    return now.uordblks + now.hblkhd;
}

template <class Settings>
void memory(Settings settings) {
    const auto megabytes = [&] {
        const std::size_t before = bytesTaken();
        const auto renderer = std::make_unique<HapticRenderer>();
        renderer->prepare(settings);
        return 1e-6 * static_cast<double>(bytesTaken() - before);
    };
    tell("MB, 4 channels", megabytes());
    if constexpr (requires { settings.modes; }) settings.modes = 64;
    tell("MB, 4 channels and 64 modes", megabytes());
}

} // namespace

int main(int count, char** arguments) {
    const InstructionSet set = count == 2 ? setNamed(arguments[1]) : InstructionSet::best;
    if (!isAvailable(set)) return 3;
    const DenormalGuard guard; // as in an audio callback
    strikes(set);
    chainAndBank(set);
    silence(set);
    cold(set);
    memory(settingsFor(4, set));
    return 0;
}
