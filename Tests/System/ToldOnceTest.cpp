// SPDX-License-Identifier: GPL-3.0-or-later
// That lines were lost is told once, with their number, and what follows is told as it is.
#include "System/StandardStreams.h"
#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace physvib {
namespace {

TEST(ToldOnce, LinesThatNobodyReadAreCountedOnce) {
    std::mutex mutex;
    std::string read;
    std::atomic<bool> isOpen{false};
    OutputWriter writer{[&](Standard, std::string_view text) -> std::optional<std::size_t> {
        if (!isOpen) return 0;
        const std::lock_guard lock{mutex};
        read += text;
        return text.size();
    }};
    const auto soFar = [&] {
        const std::lock_guard lock{mutex};
        return read;
    };
    const auto awaitEnd = [&](const std::string& end) {
        while (!soFar().ends_with(end)) std::this_thread::sleep_for(std::chrono::milliseconds{1});
    };
    const std::string line(1023, 'x');
    constexpr std::uint64_t kept = OutputWriter::mostBytes / 1024;
    for (int round = 0; round < 2; ++round) {
        isOpen = false;
        for (std::uint64_t i = 0; i < kept + 7; ++i) writer.say(Standard::error, line + '\n');
        const std::uint64_t dropped = writer.dropped(Standard::error);
        isOpen = true;
        awaitEnd(line + '\n');
        while (!writer.finish(Standard::error).empty() && writer.dropped(Standard::error) == 0) {
        }
        for (const char* after : {"a\n", "b\n", "c\n"}) {
            writer.say(Standard::error, after);
            awaitEnd(after);
        }
        const std::string all = soFar();
        std::size_t told = 0;
        for (std::size_t at = 0; (at = all.find("were not read", at)) != std::string::npos; ++at) ++told;
        EXPECT_EQ(told, static_cast<std::size_t>(round + 1));
        EXPECT_GT(dropped, 0U);
        EXPECT_TRUE(all.ends_with("a\nb\nc\n")) << all.substr(all.size() - 100);
    }
}

} // namespace
} // namespace physvib
