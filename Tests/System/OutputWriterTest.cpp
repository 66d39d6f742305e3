// SPDX-License-Identifier: GPL-3.0-or-later
// Who says something never waits for who reads it.
#include "System/Process.h"
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <future>
#include <gtest/gtest.h>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <thread>

namespace physvib::output_writer_test {

/// Reads as much as it is told to, of each stream.
class Reader {
public:
    OutputWriter::Sink sink() {
        return [this](StdStream standard, std::string_view text) -> std::optional<std::size_t> {
            const std::lock_guard lock{mutex_};
            std::size_t& room = room_[standard == StdStream::error];
            const std::size_t taken = std::min({text.size(), room, std::size_t{5}});
            room -= taken;
            read_[standard == StdStream::error].append(text.substr(0, taken));
            both_.append(text.substr(0, taken));
            return taken;
        };
    }
    void give(StdStream standard, std::size_t room) {
        const std::lock_guard lock{mutex_};
        room_[standard == StdStream::error] = room;
    }
    std::string read(StdStream standard) {
        const std::lock_guard lock{mutex_};
        return read_[standard == StdStream::error];
    }
    std::string both() {
        const std::lock_guard lock{mutex_};
        return both_;
    }

private:
    std::mutex mutex_;
    std::array<std::size_t, 2> room_{};
    std::array<std::string, 2> read_;
    std::string both_;
};

constexpr std::size_t plenty = SIZE_MAX / 2;
constexpr const char* line = "a line of thirty-two characters\n";

TEST(OutputWriters, WhatNobodyReadsIsDroppedAndCounted) {
    Reader nobody;
    OutputWriter writer{nobody.sink()};
    constexpr std::uint64_t said = 100'000, kept = OutputWriter::maxQueuedBytes / 32;
    for (std::uint64_t k = 0; k < said; ++k) writer.writeLine(StdStream::output, line);
    EXPECT_EQ(writer.dropped(StdStream::output), said - kept);
    EXPECT_EQ(writer.dropped(StdStream::error), 0U) << "each has room of its own";
    EXPECT_EQ(writer.finish(StdStream::output), std::to_string(said) + " lines were not read");
    EXPECT_EQ(writer.finish(StdStream::error), "");
}

TEST(OutputWriters, AReaderThatTakesAllGetsAllInOrder) {
    Reader reader;
    reader.give(StdStream::output, plenty);
    reader.give(StdStream::error, plenty);
    OutputWriter writer{reader.sink()};
    std::string all;
    for (int k = 0; k < 1000; ++k) {
        const std::string text = std::to_string(k) + '\n';
        all += text;
        writer.writeLine(k % 3 == 0 ? StdStream::error : StdStream::output, text);
    }
    EXPECT_EQ(writer.finish(StdStream::output), "");
    EXPECT_EQ(writer.finish(StdStream::error), "");
    EXPECT_EQ(reader.both(), all);
}

TEST(OutputWriters, OneThatIsFullHoldsUpNoOther) {
    Reader reader;
    reader.give(StdStream::error, plenty);
    OutputWriter writer{reader.sink()};
    writer.writeLine(StdStream::output, "first\n");
    writer.writeLine(StdStream::error, "second\n");
    EXPECT_EQ(writer.finish(StdStream::error), "");
    EXPECT_EQ(reader.read(StdStream::error), "second\n");
    EXPECT_EQ(reader.read(StdStream::output), "");
    reader.give(StdStream::output, plenty);
    EXPECT_EQ(writer.finish(StdStream::output), "");
    EXPECT_EQ(reader.read(StdStream::output), "first\n");
}

TEST(OutputWriters, StandardErrorTellsWhatItLacks) {
    Reader reader;
    OutputWriter writer{reader.sink()};
    for (std::size_t k = 0; k < OutputWriter::maxQueuedBytes / 32 + 3; ++k)
        writer.writeLine(StdStream::error, line);
    reader.give(StdStream::error, plenty);
    EXPECT_NE(writer.finish(StdStream::error), "");
    writer.writeLine(StdStream::error, "last\n");
    writer.finish(StdStream::error);
    EXPECT_TRUE(
        reader.read(StdStream::error).ends_with("\nphysvib: standard error: 3 lines were not read\nlast\n"));
}

TEST(OutputWriters, OneThatCannotBeWrittenSaysWhy) {
    OutputWriter writer{[](StdStream, std::string_view) -> std::optional<std::size_t> {
        errno = ENOSPC;
        return std::nullopt;
    }};
    writer.writeLine(StdStream::output, line);
    const std::string reason = std::generic_category().message(ENOSPC);
    EXPECT_EQ(writer.finish(StdStream::output), reason);
    writer.writeLine(StdStream::output, line);
    EXPECT_EQ(writer.finish(StdStream::output), reason);
    EXPECT_EQ(writer.dropped(StdStream::output), 2U);
}

// As a terminal or a socket may.
TEST(OutputWriters, OneThatHoldsTheThreadDoesNotHoldTheEnd) {
    const auto isHeld = std::make_shared<std::promise<void>>();
    const auto keepGoing = std::make_shared<std::promise<void>>();
    {
        OutputWriter writer{
            [isHeld, keepGoing](StdStream, std::string_view text) -> std::optional<std::size_t> {
                isHeld->set_value();
                keepGoing->get_future().wait();
                return text.size();
            }};
        writer.writeLine(StdStream::output, line);
        isHeld->get_future().wait();
        writer.writeLine(StdStream::error, line);
        EXPECT_EQ(writer.finish(StdStream::output), "1 line was not read");
    }
    keepGoing->set_value();
}

// That lines were lost is told once, with their number, and what follows is told as it is.

TEST(ToldOnce, LinesThatNobodyReadAreCountedOnce) {
    std::mutex mutex;
    std::string read;
    std::atomic<bool> isOpen{false};
    OutputWriter writer{[&](StdStream, std::string_view text) -> std::optional<std::size_t> {
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
    constexpr std::uint64_t kept = OutputWriter::maxQueuedBytes / 1024;
    for (int round = 0; round < 2; ++round) {
        isOpen = false;
        for (std::uint64_t i = 0; i < kept + 7; ++i) writer.writeLine(StdStream::error, line + '\n');
        const std::uint64_t dropped = writer.dropped(StdStream::error);
        isOpen = true;
        awaitEnd(line + '\n');
        while (!writer.finish(StdStream::error).empty() && writer.dropped(StdStream::error) == 0) {
        }
        for (const char* after : {"a\n", "b\n", "c\n"}) {
            writer.writeLine(StdStream::error, after);
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

} // namespace physvib::output_writer_test
