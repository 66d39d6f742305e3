// SPDX-License-Identifier: MIT
// Prints what a controller with coils is sent in simulated minutes, for coils.py to judge: each report after
// its time in ns, both little-endian. usage: physvib-coil-reports dualsense|steam|switch SECONDS PPM
//
// The device's blocks come with up to 5 ms of delay and its clock is off by PPM; the controller's thread
// looks every millisecond. All clocks are the test's own.
#include "Live/Pads/CoilFeed.h"
#include "Live/Pads/ToneFeed.h"
#include <numbers>

using namespace physvib;

namespace {

constexpr int rateHz = 48000, blockFrames = 512;
constexpr HidFeedKind anyKind{{}, "test"};

/// The signal that coils.py expects: two tones on each side.
CoilFrame signalAt(std::int64_t frame) {
    const double t = static_cast<double>(frame) / rateHz;
    const auto tone = [t](double amplitude, double hz) {
        return amplitude * std::sin(2.0 * std::numbers::pi * std::fmod(hz * t, 1.0));
    };
    return {static_cast<float>(tone(0.5, 90.0) + tone(0.3, 310.0)),
            static_cast<float>(tone(0.6, 47.0) + tone(0.2, 700.0))};
}

void print(std::int64_t ns, const PadReport& report) {
    std::fwrite(&ns, sizeof ns, 1, stdout);
    std::fwrite(report.bytes.data(), 1, report.size, stdout);
}

/// Every quarter second a hit that coils.py knows, by turns on the left and on the right, every third with a
/// second partial.
void playHits(double seconds, const PhantomPanner& panner) {
    ToneFeed feed{anyKind, panner};
    int made = 0;
    for (std::int64_t ns = 1'000'000; ns < static_cast<std::int64_t>(seconds * 1e9); ns += 1'000'000) {
        for (; made * 250'000'000LL < ns + 40'000'000; ++made) {
            CollisionEvent hit;
            hit.timeNs = made * 250'000'000LL;
            hit.frequencyHz = 60.0 * std::pow(1.13, made % 20);
            hit.decayPerSecond = 3.0 + made % 7 * 5.0;
            hit.amplitude = 0.1 + 0.1 * (made % 10);
            hit.x = made % 2;
            hit.y = 0.5;
            feed.onCollision(hit);
            if (made % 3 != 0) continue;
            hit.frequencyHz *= 2.0;
            hit.amplitude *= 0.5;
            feed.onCollision(hit);
        }
        if (const auto report = feed.next(ns, ns, 1.0f)) print(ns, *report);
    }
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 4) return 2;
    const CoilFormat& format = std::string{argv[1]} == "steam" ? steamSamples() : dualSenseSamples();
    const double seconds = std::atof(argv[2]), clock = 1.0 + 1e-6 * std::atof(argv[3]);
    ActuatorLayout layout;
    layoutPreset("phone2", layout);
    const PhantomPanner panner{layout, PanningLaw::linear, 1.0, 1.0, 1.0};
    if (std::string{argv[1]} == "switch") return playHits(seconds, panner), 0;
    const auto feed = std::make_unique<CoilFeed>(anyKind, format, panner);
    std::vector<float> left(blockFrames), right(blockFrames);
    const float* const channels[] = {left.data(), right.data()};
    std::int64_t frame = 0;
    unsigned chance = 1;
    std::int64_t blockNs = 0;
    for (std::int64_t ns = 1'000'000; ns < static_cast<std::int64_t>(seconds * 1e9); ns += 1'000'000) {
        for (; blockNs <= ns; chance = chance * 1664525u + 1013904223u) {
            for (std::size_t n = 0; n < left.size(); ++n) {
                const CoilFrame now = signalAt(frame + static_cast<std::int64_t>(n));
                left[n] = now[0], right[n] = now[1];
            }
            feed->onBlock({channels, blockFrames, frame, rateHz, 2});
            frame += blockFrames;
            blockNs = static_cast<std::int64_t>(1e9 * static_cast<double>(frame) / rateHz / clock) +
                      chance % 5'000'000u;
        }
        if (const auto report = feed->next(ns, ns, 1.0f)) print(ns, *report);
    }
    return 0;
}
