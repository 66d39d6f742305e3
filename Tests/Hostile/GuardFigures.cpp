// SPDX-License-Identifier: GPL-3.0-or-later
// What reaches an actuator, measured as its coil is warmed by it: the worst mean over 250 ms, the worst rms
// below 5 Hz of a second. Usage: physvib-guard-figures FILE.raw CHANNELS RATE    of interleaved floats
//        physvib-guard-figures lists COUNT [SEED]        of random hostile lists of events, rendered
//        physvib-guard-figures attack COUNT [SEED [PATH]]    of what a search of so many evaluations finds,
//        per guard, or at the one of this name (as within all: their seeds are passed over)
#include "Host/OpeningsPath.h"
#include "Live/Session/OfflineRender.h"
#include "Pico/FixedGuardPath.h"
#include "Support/ClosedForm.h"
#include "Support/SlowFigures.h"
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

using namespace physvib;

namespace {

constexpr int rate = 8000, channels = 2;
constexpr double seconds = 6.0;

// What is slow, hardly decays, comes often, is cut where it hurts, or all of it; each may be played.
std::vector<CollisionEvent> hostileList(test::Random& random) {
    std::vector<CollisionEvent> events(static_cast<std::size_t>(random.uniform(2, 300)));
    const double slowest = random.uniform(0.05, 3.0), spread = std::pow(10.0, random.uniform(0, 2.5)),
                 loudest = std::pow(10.0, random.uniform(-2, 1));
    const double beat = random.uniform(0.02, 0.6),
                 duration = random.uniform(0, 1) < 0.5 ? random.uniform(0.005, 0.4) : 0.0;
    const bool inStep = random.uniform(0, 1) < 0.5;
    for (std::size_t i = 0; i < events.size(); ++i) {
        CollisionEvent& e = events[i];
        const double at =
            inStep ? std::fmod(beat * static_cast<double>(i), seconds) : random.uniform(0, seconds);
        e.timeNs = std::llround(1e9 * at);
        e.frequencyHz = std::min(3000.0, slowest * std::pow(spread, random.uniform(0, 1)));
        e.decayPerSecond = e.frequencyHz < 5.0 ? random.uniform(1, 3) : random.uniform(0, 20);
        e.durationNs = std::llround(1e9 * duration);
        e.amplitude = loudest * (inStep ? 1.0 : random.uniform(-1, 1));
        e.x = random.uniform(0, 1);
        e.y = 0.5;
    }
    std::ranges::stable_sort(events, {}, &CollisionEvent::timeNs);
    return events;
}

test::SlowFigures figuresOf(const std::vector<CollisionEvent>& events) {
    ActuatorLayout layout{1.0, 1.0, channels, {}};
    layout.places[0] = {0.0, 0.5};
    layout.places[1] = {1.0, 0.5};
    const PhantomPanner panner{layout, PanningLaw::linear, 1.0, 1.0, 1.0};
    std::vector<std::vector<float>> played(channels);
    renderOffline(events, {{rate, channels, panner, true}, static_cast<std::int64_t>(seconds * rate), 256},
                  [&](const float* const* at, int frames) {
                      for (std::size_t j = 0; j < channels; ++j)
                          played[j].insert(played[j].end(), at[j], at[j] + frames);
                      return true;
                  });
    test::SlowFigures worst;
    for (const auto& channel : played) worst.join(test::slowFigures(channel, rate));
    return worst;
}

int lists(int count, std::uint32_t seed) {
    test::SlowFigures worst;
    int above = 0;
    test::Random random{seed};
    for (int i = 0; i < count; ++i) {
        const auto one = figuresOf(hostileList(random));
        worst.join(one);
        above += one.mean > limits::guardShare || one.rms > limits::guardShare ? 1 : 0;
    }
    std::printf("%d lists: worst mean %.4f, worst rms below 5 Hz %.4f; above 0.05: %d\n", count, worst.mean,
                worst.rms, above);
    return above == 0 ? 0 : 1;
}

// Each guard, each strategy, for each of three figures; the worst input is then played at other rates. The
// project's filter is the bound; an ideal one, which looks ahead for ever, is told.
int attack(int count, std::uint32_t seed, const std::string& only) {
    using namespace test;
    auto paths = guardPaths();
    paths.push_back(fixedGuardPath());
    const PlayedTime time;
    paths.push_back(openingsPath(6000));
    bool isAbove = false;
    for (const auto& path : paths) {
        if (!only.empty() && path.name != only && (seed += 12) != 0) continue;
        SlowFigures worst;
        double ideal = 0.0;
        for (const std::size_t size : {6, 15, 40, 70})
            for (const int figure : {0, 1, 2}) {
                AttackSearch search{[&](const GuardAttack& a) {
                                        const auto left = path.leaves(a.samples(path.rate));
                                        if (figure == 1) return idealSlowRms(left, path.rate);
                                        const auto by = slowFigures(left, path.rate);
                                        return figure == 0 ? by.rms : by.mean;
                                    },
                                    seed++};
                size < 50 ? search.climb(count / 24, size) : void();
                search.shape(count / (size < 50 ? 24 : 12), size + 20);
                const auto take = [&](const GuardPath& by) {
                    const auto left = by.leaves(search.worst.samples(by.rate));
                    worst.join(slowFigures(left, by.rate));
                    ideal = std::max(ideal, idealSlowRms(left, by.rate));
                };
                take(path);
                for (const int rate : {8000, 44100, 192000})
                    if (path.name == "rendered") take(outputGuardPath("", rate, GuardPlace::rendered));
            }
        std::printf("%s: worst mean %.4f, worst rms below 5 Hz %.4f, by an ideal filter %.4f\n",
                    path.name.c_str(), worst.mean, worst.rms, ideal);
        std::fflush(stdout);
        isAbove = isAbove || worst.mean > limits::guardShare || worst.rms > limits::guardShare;
    }
    return isAbove ? 1 : 0;
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 3) return 2;
    const auto seed = argc > 3 ? static_cast<std::uint32_t>(std::atoi(argv[3])) : 1;
    if (std::string(argv[1]) == "lists") return lists(std::atoi(argv[2]), seed);
    if (std::string(argv[1]) == "attack") return attack(std::atoi(argv[2]), seed, argc > 4 ? argv[4] : "");
    const auto count = static_cast<std::size_t>(std::atoi(argv[2]));
    std::ifstream file{argv[1], std::ios::binary};
    std::vector<std::vector<float>> samples(count);
    for (std::vector<float> frame(count); file.read(reinterpret_cast<char*>(frame.data()),
                                                    static_cast<std::streamsize>(count * sizeof(float)));)
        for (std::size_t j = 0; j < count; ++j) samples[j].push_back(frame[j]);
    test::SlowFigures worst;
    float peak = 0.0f;
    for (const auto& channel : samples) {
        worst.join(test::slowFigures(channel, std::atoi(argv[3])));
        for (const float x : channel) peak = std::max(peak, std::abs(x));
    }
    std::printf("%.4f %.4f %.3f\n", worst.mean, worst.rms, static_cast<double>(peak));
    return worst.mean > limits::guardShare || worst.rms > limits::guardShare ? 1 : 0;
}
