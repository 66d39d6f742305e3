// SPDX-License-Identifier: MIT
// The guards that a signal passes on its way to an actuator, for GuardAttack.
#pragma once
#include "Core/Actuators/OutputGuard.h"
#include "Support/GuardAttack.h"
#include <memory>
#include <string>

namespace physvib::test {

struct GuardPath {
    std::string name;
    int rate; ///< of the search: low, since it takes thousands of renders
    std::function<std::vector<float>(std::vector<float>)> leaves;
};

inline SlowFigures figuresBehind(const GuardPath& path, const GuardAttack& attack) {
    return slowFigures(path.leaves(attack.samples(path.rate)), path.rate);
}

/// An OutputGuard whose rate changes (here: to the same) after so many frames, by turns; none: never.
inline GuardPath outputGuardPath(const std::string& name, int rate, GuardPlace place,
                                 std::vector<std::size_t> changes = {}) {
    return {name, rate, [=](std::vector<float> samples) {
                const auto guard = std::make_unique<OutputGuard>();
                guard->prepare(rate, 1, place);
                std::size_t next = 0;
                for (std::size_t n = 0, count; n < samples.size(); n += count) {
                    count = changes.empty() ? samples.size() : changes[next++ % changes.size()];
                    count = std::min(count, samples.size() - n);
                    float* at = samples.data() + n;
                    guard->process(&at, static_cast<int>(count));
                    guard->changeRate(rate);
                }
                return samples;
            }};
}

/// The rule alone, in tiles of the board's half millisecond.
inline GuardPath boardGuardPath() {
    constexpr int rate = 2000;
    return {"board", rate, [](std::vector<float> samples) {
                GuardLaw<1> law;
                law.prepare(1, GuardPlace::last);
                law.setTile(1.0f / rate);
                for (float& x : samples) law.take({(x *= law.to(0)) / rate});
                return samples;
            }};
}

inline std::vector<GuardPath> guardPaths() {
    return {outputGuardPath("rendered", 6000, GuardPlace::rendered),
            outputGuardPath("last", 6000, GuardPlace::last),
            outputGuardPath("last, periods change", 6000, GuardPlace::last, {127, 611, 1400, 305}),
            boardGuardPath()};
}

} // namespace physvib::test
