// SPDX-License-Identifier: MIT
// Two threads that render at once: one of them is told, and the renderer has rendered what the other asked.
#include "Support/SizedEvents.h"
#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <physvib/physvib.h>
#include <thread>
#include <vector>

namespace physvib {
namespace {

TEST(Busy, ASecondThreadIsToldAndEachFrameIsRenderedOnce) {
    auto settings = test::begun(physvib_renderer_settings_init);
    physvib_renderer renderer = nullptr;
    ASSERT_EQ(physvib_renderer_create(&settings, &renderer), PHYSVIB_OK) << physvib_error();
    constexpr int frames = 4096;
    const int channels = settings.channels > 0 ? settings.channels : settings.layout.count;
    std::atomic<int> done{0}, busy{0}, others{0};
    std::atomic<bool> ends{false};
    const auto render = [&] {
        std::vector<float> samples(static_cast<std::size_t>(channels) * frames);
        while (!ends) {
            const int code = physvib_renderer_pull_interleaved(renderer, samples.data(), channels, frames);
            ++(code == PHYSVIB_OK ? done : code == PHYSVIB_ERROR_BUSY ? busy : others);
        }
    };
    std::thread one{render}, two{render};
    // as long as it takes until they meet, which on any machine is soon
    for (int i = 0; i < 30'000 && busy == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds{1});
    ends = true;
    one.join();
    two.join();
    EXPECT_GT(busy, 0) << "two threads rendered at once " << done << " times";
    EXPECT_EQ(others, 0);
    auto status = test::begun(physvib_renderer_status_init);
    ASSERT_EQ(physvib_renderer_get_status(renderer, &status), PHYSVIB_OK);
    EXPECT_EQ(status.frames, static_cast<physvib_int64>(done) * frames);
    EXPECT_EQ(physvib_renderer_free(renderer), PHYSVIB_OK);
}

} // namespace
} // namespace physvib
