// SPDX-License-Identifier: GPL-3.0-or-later
// The library with devices and sessions as a program in another language sees it, without a device.
#include "Support/BegunStructs.h"
#include "Support/RandomLiveCalls.h"
#include <limits>
#include <random>

namespace physvib {
namespace {

TEST(LiveCalls, AnOlderProgramsStructureIsBegunAndToldAsFarAsItGoes) {
    test::expectBegunWithin(physvib_live_settings_init);
    test::expectBegunWithin(physvib_live_status_init);
    physvib_live_settings settings;
    constexpr std::size_t size = offsetof(physvib_live_settings, save),
                          told = offsetof(physvib_live_status, board);
    std::memset(&settings, 0xAB, sizeof settings); // which would be a path
    ASSERT_EQ(physvib_live_settings_init(&settings, size), PHYSVIB_OK);
    physvib_live live = nullptr;
    ASSERT_EQ(physvib_live_open("None:no device", nullptr, &settings, &live), PHYSVIB_OK)
        << physvib_live_error();
    physvib_live_status status;
    std::memset(&status, 0xAB, sizeof status);
    ASSERT_EQ(physvib_live_status_init(&status, told), PHYSVIB_OK);
    ASSERT_EQ(physvib_live_get_status(live, &status), PHYSVIB_OK);
    EXPECT_EQ(status.size, told);
    EXPECT_EQ(status.is_running, 1);
    EXPECT_EQ(status.board, static_cast<int>(0xABABABABu));
    const physvib_live open = live;
    EXPECT_EQ(physvib_live_open("None:no device", nullptr, nullptr, &live), PHYSVIB_ERROR_FULL);
    EXPECT_EQ(live, open) << "which could not be closed any more";
    EXPECT_EQ(physvib_live_close(live), PHYSVIB_OK);
    EXPECT_EQ(physvib_live_close(live), PHYSVIB_ERROR_HANDLE);
}

TEST(LiveCalls, AnythingButZeroSilencesAlsoByAWrongName) {
    physvib_live live = nullptr;
    ASSERT_EQ(physvib_live_open("None:no device", nullptr, nullptr, &live), PHYSVIB_OK)
        << physvib_live_error();
    const auto isSilent = [&] {
        physvib_live_status status;
        physvib_live_status_init(&status, sizeof status);
        EXPECT_EQ(physvib_live_get_status(live, &status), PHYSVIB_OK);
        return status.is_silent;
    };
    for (const int odd : {1, -1, 2, 256, 65'536, std::numeric_limits<int>::min()}) {
        EXPECT_EQ(physvib_live_silence(live, odd), PHYSVIB_OK);
        EXPECT_EQ(isSilent(), 1) << odd;
        EXPECT_EQ(physvib_live_silence(live, 0), PHYSVIB_OK);
        EXPECT_EQ(isSilent(), 0);
        EXPECT_EQ(physvib_live_silence(nullptr, odd), PHYSVIB_ERROR_HANDLE);
        EXPECT_EQ(isSilent(), 1) << odd;
        EXPECT_EQ(physvib_live_silence(nullptr, 0), PHYSVIB_ERROR_HANDLE);
        EXPECT_EQ(isSilent(), 1) << "nobody lifts it by a wrong name";
        EXPECT_EQ(physvib_live_silence(live, 0), PHYSVIB_OK);
    }
    EXPECT_EQ(physvib_live_close(live), PHYSVIB_OK);
    EXPECT_EQ(physvib_live_silence(live, 1), PHYSVIB_ERROR_HANDLE);
}

TEST(LiveCalls, AnyOrderOfCallsWithAnythingIsAnsweredByACode) {
    std::mt19937 random{7};
    test::RandomLiveCalls calls;
    int made = 0;
    while (made < 20'000) {
        std::vector<std::uint8_t> bytes(4096);
        for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
        made += calls.run(bytes.data(), bytes.size());
    }
}

} // namespace
} // namespace physvib
