// SPDX-License-Identifier: MIT
// A host in virtual time: blocks of random size, and a driver that comes after random gaps.
#pragma once
#include "Live/Documents/SessionFile.h"
#include "Live/Session/Session.h"
#include "Scene/SceneFile.h"
#include "Support/ClosedForm.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

namespace physvib::test {

constexpr int hostRate = 48000, hostChannels = 4;
using Interleaved = std::vector<float>;

inline SessionSetup shakeTheBoxSetup(double longestGapSeconds, int stepsPerSecond = 100) {
    SessionSetup s;
    s.scene = *findBuiltInScene("shake-the-box");
    s.stepsPerSecond = stepsPerSecond;
    s.longestGapSeconds = longestGapSeconds;
    ActuatorLayout layout;
    layoutPreset("phone4", layout);
    s.panner =
        PhantomPanner{layout, PanningLaw::linear, 1, s.scene.fieldWidthMetres, s.scene.fieldHeightMetres};
    return s;
}

/// The same field and materials, and nothing that moves: what is felt is what comes from outside.
inline SessionSetup emptyBoxSetup(double longestGapSeconds) {
    SessionSetup s = shakeTheBoxSetup(longestGapSeconds);
    s.scene.bodies.clear();
    s.scene.script.clear();
    s.scene.joints.clear();
    return s;
}

inline SavedSession saved(const SessionSetup& setup, const SessionLog& log, std::int64_t lengthNs) {
    return {setup.run(), setup.panner, setup.channels,  setup.limiterEnabled, setup.ceilings, lengthNs,
            log,         {},           setup.equalised, setup.shaping};
}

/// `text` with `to` in place of the first `from`.
inline std::string textWith(std::string text, std::string_view from, std::string_view to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

inline void append(Interleaved& to, const float* const* block, int frames) {
    for (int n = 0; n < frames; ++n)
        for (int j = 0; j < hostChannels; ++j) to.push_back(block[j][n]);
}

struct Block {
    std::vector<std::vector<float>> samples{hostChannels, std::vector<float>(8192)};
    std::vector<float*> at;
    Block() {
        for (auto& channel : samples) at.push_back(channel.data());
    }
};

inline std::vector<CollisionEvent> drain(Session& session) {
    std::vector<CollisionEvent> events;
    for (PlayedEvent played; session.played().pop(played);) events.push_back(played.event);
    return events;
}

/// `frames` of a realtime session; what it played is appended to `played`.
inline Interleaved playLive(Session& session, std::int64_t frames, int largestBlock, double largestGapSeconds,
                            std::uint32_t seed, std::vector<CollisionEvent>& played) {
    Random random{seed};
    Block block;
    Interleaved signal;
    session.prepare(hostRate, largestBlock);
    for (std::int64_t done = 0, nextTick = 0; done < frames;) {
        if (done >= nextTick) {
            session.advance();
            nextTick = done + random.below(static_cast<int>(largestGapSeconds * hostRate - largestBlock) + 1);
        }
        const int size =
            static_cast<int>(std::min<std::int64_t>(frames - done, 1 + random.below(largestBlock)));
        session.render(block.at.data(), size, RenderMode::realtime);
        append(signal, block.at.data(), size);
        done += size;
        for (const auto& e : drain(session)) played.push_back(e);
    }
    return signal;
}

} // namespace physvib::test
