// SPDX-License-Identifier: MIT
// The audio of contacts: a render of it is what is played live, to the bit.
#include "Live/Session/ContactAudio.h"
#include "Core/Units.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace physvib {
namespace {

CollisionEvent hitAt(std::int64_t timeNs, double x) {
    CollisionEvent hit;
    hit.timeNs = timeNs;
    hit.x = x;
    hit.frequencyHz = 250.0;
    hit.decayPerSecond = 40.0;
    hit.amplitude = 0.4;
    return hit;
}

TEST(ContactAudio, ARenderIsWhatIsPlayedAtItsLevelWithFieldsAndStops) {
    constexpr int frames = 24'000;
    const PhantomPanner field{EnchanterLayout{1.0, 1.0, 1, {}}, PanningLaw::linear, 1.0, 2.0, 1.0};
    const std::vector events{hitAt(0, 0.2), hitAt(100'000'000, 1.8), hitAt(300'000'000, 1.0)};
    RenderControl wider{200'000'000, RenderControl::Kind::panner, 0, 0.0f, {}}, gain = wider, stop = wider;
    const PhantomPanner wide{EnchanterLayout{1.0, 1.0, 1, {}}, PanningLaw::linear, 1.0, 8.0, 1.0};
    wider.panner = &wide;
    gain.kind = RenderControl::Kind::gain; // of an actuator
    stop.kind = RenderControl::Kind::stopAll;
    stop.timeNs = 400'000'000;
    const std::vector<RenderControl> controls{gain, wider, stop};

    ContactAudio live{{}, 2, field};
    live.prepare(48'000);
    for (const auto& event : events) live.mirror(event);
    for (const auto& control : controls) live.mirror(control);
    const int latency = HapticRenderer::latencyFramesAt(48'000);
    std::vector<float> played[2];
    for (int done = 0; done < frames + latency; done += 480) {
        float block[2][480];
        float* const at[] = {block[0], block[1]};
        live.render(at, 480);
        for (int c = 0; c < 2; ++c) played[c].insert(played[c].end(), block[c], block[c] + 480);
    }

    ContactAudioRender heard{48'000, frames};
    heard.ears = 2;
    heard.field = field;
    heard.levelDb = -20.0;
    const auto scale = static_cast<float>(fromDecibels(-20.0));
    int done = 0, wrong = 0;
    float most = 0.0f, apart = 0.0f, last = 0.0f;
    renderContactAudio(events, controls, heard, [&](const float* const* channels, int n) {
        for (int k = 0; k < n; ++k, ++done) {
            for (int c = 0; c < 2; ++c)
                wrong += channels[c][k] != played[c][static_cast<std::size_t>(done + latency)] * scale;
            most = std::max(most, std::abs(channels[0][k]));
            apart = std::max(apart, std::abs(channels[0][k] - channels[1][k]));
            last = std::abs(channels[0][k]);
        }
        return true;
    });
    EXPECT_EQ(done, frames);
    EXPECT_EQ(wrong, 0) << "samples";
    EXPECT_GT(most, 0.01f);
    EXPECT_LE(most, 0.1f);
    EXPECT_GT(apart, 0.01f);
    EXPECT_LT(last, 1e-6f) << "stopped";
}

} // namespace
} // namespace physvib
