// SPDX-License-Identifier: MIT
// Depth and parts of a body through the C functions: layouts, event lists and samples.
#include "Core/NameNumbers.h"
#include "Support/SizedEvents.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <physvib/physvib.h>
#include <vector>

namespace physvib::space_calls_test {

physvib_event tapAt(double x, double y, double z, const char* part = nullptr) {
    auto event = test::begun(physvib_event_init);
    event.frequency_hz = 1000.0;
    event.duration_ns = 2'000'000;
    event.amplitude = 0.5;
    event.x_m = x, event.y_m = y, event.z_m = z;
    event.part = part == nullptr ? 0 : physvib_part(part);
    return event;
}

/// The largest sample of each channel over that of a gain of 1.
std::vector<double> gainsOf(const physvib_layout& layout, const physvib_event& event, int law) {
    auto settings = test::begun(physvib_renderer_settings_init);
    settings.layout = layout;
    settings.law = law;
    settings.limiter = 0;
    constexpr int frames = 480;
    std::vector<float> samples(static_cast<std::size_t>(layout.count * frames));
    EXPECT_EQ(physvib_render(&settings, &event, 1, frames, samples.data()), PHYSVIB_OK) << physvib_error();
    std::vector<double> gains;
    for (auto channel = samples.begin(); channel != samples.end(); channel += frames)
        gains.push_back(
            std::abs(*std::max_element(channel, channel + frames,
                                       [](float a, float b) { return std::abs(a) < std::abs(b); })) /
            0.5);
    return gains;
}

TEST(SpaceCalls, APartHasTheNumberOfItsName) {
    EXPECT_EQ(physvib_part("thumb"), partNamed("thumb"));
    EXPECT_EQ(physvib_part("part-923368111"), 923368111); // as lists write a number without a name
    EXPECT_EQ(physvib_part(""), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_part(nullptr), PHYSVIB_ERROR_ARGUMENT);
}

TEST(SpaceCalls, AnEventIsFeltAtItsDepthOrOnItsPart) {
    auto vest = test::sized<physvib_layout>();
    ASSERT_EQ(physvib_layout_preset("vest16", &vest), PHYSVIB_OK);
    EXPECT_EQ(vest.part[0], physvib_part("chest"));
    const auto back = gainsOf(vest, tapAt(vest.x_m[9], vest.y_m[9], vest.z_m[9]), PHYSVIB_LAW_AUTO);
    const auto chest =
        gainsOf(vest, tapAt(vest.x_m[9], vest.y_m[9], vest.z_m[9], "chest"), PHYSVIB_LAW_TRIANGLES);
    for (std::size_t j = 0; j < 16; ++j) {
        EXPECT_NEAR(back[j], j == 9 ? 1.0 : 0.0, 1e-6) << j;
        EXPECT_NEAR(chest[j], j == 1 ? 1.0 : 0.0, 1e-6)
            << j << ": the chest's one at the same height and side";
    }
}

TEST(SpaceCalls, WrongDepthsAndPartsAreRefused) {
    auto settings = test::begun(physvib_renderer_settings_init);
    std::array<float, 4> sample{};
    auto event = tapAt(0.0, 0.0, std::numeric_limits<double>::infinity());
    EXPECT_EQ(physvib_render(&settings, &event, 1, 1, sample.data()), PHYSVIB_ERROR_ARGUMENT);
    event = tapAt(0.0, 0.0, 0.0);
    event.part = -1;
    EXPECT_EQ(physvib_render(&settings, &event, 1, 1, sample.data()), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_STREQ(physvib_error(), "part: expected 0, or a number of physvib_part()");
    settings.layout.z_m[1] = std::nan("");
    EXPECT_EQ(physvib_render(&settings, &event, 0, 1, sample.data()), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_STREQ(physvib_error(),
                 "layout: expected an extent above 0 m, places that are numbers and parts from 0 on");
}

} // namespace physvib::space_calls_test
