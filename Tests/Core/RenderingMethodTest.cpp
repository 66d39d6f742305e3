// SPDX-License-Identifier: MIT
// RenderingMethod: each of the eight renders the closed form of what it fixes, and leaves the rest alone.
#include "Core/EventShaping.h"
#include "Support/ClosedForm.h"
#include "Support/Rendering.h"
#include <gtest/gtest.h>
#include <string>

namespace physvib {
namespace {

constexpr int rate = 48000;

RenderingMethod named(const std::string& name) {
    RenderingMethod method;
    EXPECT_TRUE(renderingMethodNamed(name, method)) << name;
    return method;
}

RendererSettings oneEnchanter() {
    EnchanterLayout layout;
    layoutPreset("phone1", layout);
    return {rate, 1, PhantomPanner{layout, PanningLaw::linear, 1.0, 1.0, 1.0}, false};
}

test::Channels rendered(std::vector<CollisionEvent> events, const RenderingMethod& method,
                        int frames = rate) {
    for (CollisionEvent& e : events) e = method(e);
    return test::renderEvents(events, oneEnchanter(), frames).channels;
}

TEST(RenderingMethod, EachOfTheEightIsItsClosedForm) {
    const auto physics = test::randomEvents(200, 0.9, 5);
    for (const char a : {'V', 'F'})
        for (const char f : {'V', 'F'})
            for (const char d : {'V', 'F'}) {
                const std::string name = std::string{"A"} + a + "-F" + f + "-DR" + d;
                auto wanted = physics; // by hand, from the letters
                for (auto& e : wanted) {
                    if (a == 'F') e.amplitude = 1.5;
                    if (f == 'F') e.frequencyHz = 250.0;
                    if (d == 'F') e.decayPerSecond = 0.0;
                    if (d == 'F') e.durationNs = 20'000'000;
                }
                const auto sum =
                    test::closedForm(wanted, rate, 1, rate, [](double, double, double* g) { g[0] = 1.0; });
                EXPECT_LE(test::relativeError(sum, rendered(physics, named(name))), 1e-6) << name;
            }
}

TEST(RenderingMethod, AllVariedIsTheDefaultRendererToTheBit) {
    const auto physics = test::randomEvents(500, 0.9, 6);
    EXPECT_EQ(named("AV-FV-DRV"), RenderingMethod{});
    EXPECT_EQ(rendered(physics, named("AV-FV-DRV")),
              test::renderEvents(physics, oneEnchanter(), rate).channels);
}

TEST(RenderingMethod, TheFixedPulseLastsExactlyTwentyMilliseconds) {
    CollisionEvent hit;
    hit.frequencyHz = 430;
    hit.decayPerSecond = 12;
    hit.amplitude = 0.01;
    for (const std::int64_t onset : {std::int64_t{10'000'000}, std::int64_t{10'007'301}}) { // on a frame, and
                                                                                            // between two
        hit.timeNs = onset;
        const auto samples = rendered({hit}, named("AF-FF-DRF"), 4800).front();
        // the first frame not before it
        const auto first = static_cast<std::size_t>((onset * rate + 999'999'999) / 1'000'000'000);
        for (std::size_t n = 0; n < samples.size(); ++n)
            if (n < first || n >= first + 960) ASSERT_EQ(samples[n], 0.0f) << n;
        EXPECT_NE(samples[first + 959], 0.0f) << "20 ms are 960 frames";
        EXPECT_NEAR(*std::max_element(samples.begin(), samples.end()), 1.5, 1e-3);
        EXPECT_NEAR(samples[first + 959 - 48 * 4], samples[first + 959], 1e-5)
            << "rectangular: the last period is the one before";
    }
}

TEST(RenderingMethod, OtherNamesAreNone) {
    RenderingMethod method{true, true, true, 7.0};
    const RenderingMethod before = method;
    for (const char* name : {"", "AV", "AV-FV-DR", "AV-FV-DRX", "AX-FV-DRV", "av-fv-drv", "AVFFVFDRV",
                             "AV-FV-DRVV", "FV-AV-DRV", "AV-FF-DFV", "SV"})
        EXPECT_FALSE(renderingMethodNamed(name, method)) << name;
    EXPECT_EQ(method, before);
}

} // namespace
} // namespace physvib
