// SPDX-License-Identifier: GPL-3.0-or-later
#include "Io/Wav/WavSink.h"
#include "Live/Recordings/Recording.h"
#include "Support/FileTesting.h"
#include "Support/FullDisk.h"
#include "Support/ReadWav.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <juce_audio_formats/juce_audio_formats.h>
#include <thread>
#include <vector>

namespace physvib::wav_sink_test {

constexpr int rateHz = 48000;

std::string pathOf(const std::string& name) {
    return (std::filesystem::path(::testing::TempDir()) / name).string();
}

std::string bytesOf(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

template <typename Number>
Number numberAt(const std::string& bytes, std::size_t at) {
    Number value{};
    if (at + sizeof(value) <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof(value));
    return value;
}

// Where a chunk's content starts; 0 if there is no such chunk.
std::size_t chunkAt(const std::string& bytes, const std::string& name) {
    for (std::size_t at = 12; at + 8 <= bytes.size(); at += 8 + numberAt<std::uint32_t>(bytes, at + 4))
        if (bytes.compare(at, 4, name) == 0) return at + 8;
    return 0;
}

float sample(int channel, int frame) {
    return std::sin(0.01f * static_cast<float>(frame * (channel + 1))) / static_cast<float>(channel + 1);
}

std::string writeBlocks(const std::string& path, int channels, int frames, int blockFrames,
                        const std::string& comment = {}) {
    WavSink sink(path, channels, rateHz, comment);
    std::vector<std::vector<float>> block(static_cast<std::size_t>(channels));
    std::vector<const float*> pointers(block.size());
    for (int start = 0; start < frames; start += blockFrames) {
        const int count = std::min(blockFrames, frames - start);
        for (std::size_t c = 0; c < block.size(); ++c) {
            block[c].clear();
            for (int i = 0; i < count; ++i) block[c].push_back(sample(static_cast<int>(c), start + i));
            pointers[c] = block[c].data();
        }
        sink.write(pointers.data(), count);
    }
    return sink.finish();
}

TEST(WavSink, OneAndTwoChannelsArePlainFloat) {
    for (const int channels : {1, 2}) {
        const auto path = pathOf("plain.wav");
        ASSERT_EQ(writeBlocks(path, channels, 100, 32), "");
        const auto bytes = bytesOf(path);
        const auto format = chunkAt(bytes, "fmt ");
        ASSERT_NE(format, 0u);
        EXPECT_EQ(numberAt<std::uint16_t>(bytes, format), 3); // WAVE_FORMAT_IEEE_FLOAT
        EXPECT_EQ(numberAt<std::uint16_t>(bytes, format + 2), channels);
        EXPECT_EQ(numberAt<std::uint32_t>(bytes, format + 4), static_cast<std::uint32_t>(rateHz));
        EXPECT_EQ(numberAt<std::uint16_t>(bytes, format + 14), 32);
    }
}

TEST(WavSink, MoreChannelsAreExtensibleWithoutSpeakers) {
    for (const int channels : {3, 4, 8, 64}) {
        const auto path = pathOf("extensible.wav");
        ASSERT_EQ(writeBlocks(path, channels, 100, 32, "a comment"), "");
        const auto bytes = bytesOf(path);
        const auto format = chunkAt(bytes, "fmt "), data = chunkAt(bytes, "data");
        ASSERT_NE(format, 0u);
        ASSERT_NE(data, 0u);
        EXPECT_EQ(numberAt<std::uint32_t>(bytes, format - 4), 40u);
        EXPECT_EQ(numberAt<std::uint16_t>(bytes, format), 0xfffe); // WAVE_FORMAT_EXTENSIBLE
        EXPECT_EQ(numberAt<std::uint16_t>(bytes, format + 2), channels);
        EXPECT_EQ(numberAt<std::uint32_t>(bytes, format + 8),
                  static_cast<std::uint32_t>(rateHz * channels * 4));
        EXPECT_EQ(numberAt<std::uint16_t>(bytes, format + 12), channels * 4);
        EXPECT_EQ(numberAt<std::uint32_t>(bytes, format + 20), 0u); // dwChannelMask
        EXPECT_EQ(numberAt<std::uint32_t>(bytes, format + 24), 3u); // the float subformat
        EXPECT_EQ(numberAt<std::uint32_t>(bytes, data - 4), static_cast<std::uint32_t>(100 * channels * 4));
        EXPECT_EQ(data + static_cast<std::size_t>(100 * channels * 4), bytes.size());
        EXPECT_EQ(numberAt<std::uint32_t>(bytes, 4), bytes.size() - 8); // the RIFF size
    }
}

TEST(WavSink, ReadsBackToTheBit) {
    const auto path = pathOf("back.wav");
    constexpr int channels = 5, frames = 30000; // more than the buffer holds
    ASSERT_EQ(writeBlocks(path, channels, frames, 777), "");
    const std::unique_ptr<juce::AudioFormatReader> reader(
        juce::WavAudioFormat().createReaderFor(juce::File(path).createInputStream().release(), true));
    ASSERT_NE(reader, nullptr);
    ASSERT_EQ(reader->numChannels, static_cast<unsigned>(channels));
    ASSERT_EQ(reader->lengthInSamples, frames);
    ASSERT_EQ(reader->sampleRate, rateHz);
    juce::AudioBuffer<float> back(channels, frames);
    ASSERT_TRUE(reader->read(&back, 0, frames, 0, true, true));
    for (int c = 0; c < channels; ++c)
        for (int n = 0; n < frames; ++n) ASSERT_EQ(back.getSample(c, n), sample(c, n)) << c << " " << n;
}

TEST(WavSink, BytesDoNotDependOnTheBlocks) {
    const auto one = pathOf("one.wav"), other = pathOf("other.wav");
    ASSERT_EQ(writeBlocks(one, 4, 70000, 1), "");
    for (const int blockFrames : {64, 999, 70000}) {
        ASSERT_EQ(writeBlocks(other, 4, 70000, blockFrames), "");
        EXPECT_EQ(bytesOf(one), bytesOf(other)) << blockFrames;
    }
}

TEST(WavSink, ReplacesALongerFile) {
    const auto path = pathOf("replaced.wav"), fresh = pathOf("fresh.wav");
    std::filesystem::remove(fresh);
    ASSERT_EQ(writeBlocks(path, 4, 5000, 512), "");
    ASSERT_EQ(writeBlocks(path, 2, 10, 512), "");
    ASSERT_EQ(writeBlocks(fresh, 2, 10, 512), "");
    EXPECT_EQ(bytesOf(path), bytesOf(fresh));
}

TEST(WavSink, KeepsTheComment) {
    const auto path = pathOf("comment.wav");
    ASSERT_EQ(writeBlocks(path, 4, 10, 10, "shake-the-box, seed 1"), "");
    const auto bytes = bytesOf(path);
    EXPECT_NE(bytes.find("ICMT"), std::string::npos);
    EXPECT_NE(bytes.find("shake-the-box, seed 1"), std::string::npos);
    EXPECT_EQ(bytes.size(), chunkAt(bytes, "data") + 10 * 4 * sizeof(float)) << "behind it, whole";
}

// A header's sizes in bytes: of all behind the first eight, and of the samples; 64 bits from 4 GB on.
TEST(WavSink, SizesInTheHeaderAreThoseOfTheFile) {
    constexpr std::int64_t fourGb = std::int64_t{1} << 32;
    for (const int channels : {1, 2, 3, 64})
        for (const std::string comment : {"", "odd", "even", "of a length that no number of frames hides"})
            for (const std::int64_t data :
                 {std::int64_t{0}, std::int64_t{4000}, fourGb - 1024, fourGb - 4, fourGb, 3 * fourGb}) {
                const auto header = wavHeader(channels, rateHz, data, wavInfoChunk(comment));
                const std::int64_t riff = std::ssize(header) - 8 + data;
                const bool isLong = riff >= fourGb;
                const auto where = testing::Message()
                                   << channels << " channels, " << data << " bytes, " << comment;
                EXPECT_EQ(header.substr(0, 4), isLong ? "RF64" : "RIFF") << where;
                EXPECT_EQ(numberAt<std::uint32_t>(header, 4), isLong ? 0xffff'ffff : riff) << where;
                EXPECT_EQ(numberAt<std::uint32_t>(header, header.size() - 4), isLong ? 0xffff'ffff : data)
                    << where;
                EXPECT_EQ(chunkAt(header, "data"), header.size()) << where;
                if (!isLong) continue;
                EXPECT_EQ(numberAt<std::int64_t>(header, chunkAt(header, "ds64")), riff) << where;
                EXPECT_EQ(numberAt<std::int64_t>(header, chunkAt(header, "ds64") + 8), data) << where;
            }
}

/// 480 frames of 0.5 on a channel.
void render(PlayedRecorder& recorder, std::int64_t frame, int rate = rateHz) {
    const std::vector<float> block(480, 0.5f);
    const float* const channels[] = {block.data()};
    recorder.onBlock({channels, 480, frame, rate});
}

TEST(PlayedRecorder, SaysInTheFileAtWhichSessionTimeItBegins) {
    const auto path = pathOf("begins.wav");
    PlayedRecorder recorder{path, 1, rateHz};
    ASSERT_EQ(recorder.error(), "");
    recorder.setOutputLatency(2400);
    EXPECT_FALSE(recorder.startSeconds());
    for (int i = 0; i < 3; ++i) // the world has not begun, so time stands still
        render(recorder, -480);
    EXPECT_FALSE(recorder.startSeconds());
    render(recorder, 960);
    render(recorder, 1440);
    ASSERT_EQ(recorder.finish(), "");
    EXPECT_EQ(recorder.startSeconds(), -0.03);
    const auto bytes = bytesOf(path);
    EXPECT_NE(bytes.find("begins at session time -0.030000 s"), std::string::npos);
    EXPECT_EQ(numberAt<std::uint32_t>(bytes, chunkAt(bytes, "data") - 4), 960u * 4u);
}

/// Channels of the file as it stands, once it has so many frames; or after a while.
std::vector<std::vector<float>> channelsOnceThereAre(std::size_t frames, const std::string& path) {
    std::vector<std::vector<float>> channels;
    for (int i = 0; i < 1000 && (channels.empty() || channels[0].size() < frames); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds{10});
        if (std::FILE* const file = std::fopen(path.c_str(), "rb")) {
            if (auto read = readWav(*file)) channels = std::move(read.value.channels);
            std::fclose(file);
        }
    }
    return channels;
}

TEST(PlayedRecorder, IsAWholeFileInItsPlaceWhileItGrows) {
    const auto path = pathOf("grows.wav");
    ASSERT_EQ(writeBlocks(path, 4, 10, 10), "");
    PlayedRecorder recorder{path, 1, rateHz};
    EXPECT_EQ(channelsOnceThereAre(10, path).size(), 4u) << "the old one, until there is something to hear";
    for (const std::size_t frames : {480u, 960u, 1440u}) {
        render(recorder, static_cast<std::int64_t>(frames) - 480);
        std::vector<std::vector<float>> there;
        for (int i = 0; i < 50 && there.size() != 1; ++i) there = channelsOnceThereAre(frames, path);
        ASSERT_EQ(there.size(), 1u);
        EXPECT_EQ(there[0], std::vector<float>(frames, 0.5f));
    }
    EXPECT_NE(PlayedRecorder(path, 1, rateHz).error().find("it is being written already"), std::string::npos);
    ASSERT_EQ(recorder.finish(), "");
    EXPECT_FALSE(std::filesystem::exists(path + ".physvib.part"));
}

TEST(PlayedRecorder, EndsWhereAnotherRateComes) {
    PlayedRecorder recorder{pathOf("rates.wav"), 1, rateHz};
    render(recorder, 0);
    EXPECT_TRUE(recorder.isRateUnchanged());
    render(recorder, 480, 2 * rateHz);
    render(recorder, 960);
    EXPECT_FALSE(recorder.isRateUnchanged());
    ASSERT_EQ(recorder.finish(), "");
    EXPECT_EQ(recorder.frames(), 480);
}

TEST(WavSink, NoFramesAreAFileToo) {
    const auto path = pathOf("empty.wav");
    ASSERT_EQ(writeBlocks(path, 4, 0, 64), "");
    const auto bytes = bytesOf(path);
    const auto data = chunkAt(bytes, "data");
    ASSERT_NE(data, 0u);
    EXPECT_EQ(numberAt<std::uint32_t>(bytes, data - 4), 0u);
}

void expectOneLineWith(const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

/// A disk that takes so many bytes of a file, a part of the last write, and no more: the limit on a file's
/// size behaves like that.
std::string writeWithRoomFor(rlim_t bytes, const std::string& path, int channels, int frames) {
    const FileSizeLimit full(bytes);
    return writeBlocks(path, channels, frames, 512);
}

TEST(WavSink, AFullDiskLeavesTheOldFileWhereverItFills) {
    const auto path = pathOf("full.wav");
    const int channels = 3, frames = 30'000; // more than a buffer
    ASSERT_EQ(writeBlocks(path, channels, frames, 512), "");
    const auto whole = static_cast<std::int64_t>(bytesOf(path).size());
    ASSERT_EQ(writeBlocks(path, 1, 10, 10), "");
    const auto old = bytesOf(path);
    for (const std::int64_t bytes : {std::int64_t{0}, std::int64_t{1}, std::int64_t{50},
                                     std::int64_t{100'000}, std::int64_t{1 << 18}, whole - 1}) {
        expectOneLineWith(writeWithRoomFor(static_cast<rlim_t>(bytes), path, channels, frames),
                          path + ": cannot be written: File too large");
        EXPECT_EQ(bytesOf(path), old) << bytes;
    }
    EXPECT_EQ(writeWithRoomFor(static_cast<rlim_t>(whole), path, channels, frames), "");
    EXPECT_EQ(bytesOf(path).size(), static_cast<std::size_t>(whole));
}

TEST(PlayedRecorder, AFullDiskIsToldAndLeavesWhatFitted) {
    const auto path = pathOf("fitted.wav");
    std::filesystem::remove(path);
    PlayedRecorder recorder{path, 1, rateHz};
    render(recorder, 0);
    ASSERT_EQ(channelsOnceThereAre(480, path).size(), 1u);
    const auto fitted = bytesOf(path);
    const FileSizeLimit full(static_cast<rlim_t>(fitted.size() + 100));
    render(recorder, 480);
    for (int i = 0; i < 1000 && recorder.error().empty(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds{10});
    expectOneLineWith(recorder.error(), path + ": cannot be written: File too large");
    render(recorder, 960);
    EXPECT_EQ(recorder.finish(), recorder.error());
    EXPECT_EQ(bytesOf(path), fitted);
}

TEST(WavSink, RefusesBlocksAfterAnError) {
    WavSink sink(pathOf("no-such-folder/shake.wav"), 1, rateHz);
    const std::vector<float> block(200000, 0.5f);
    const float* channel = block.data();
    EXPECT_FALSE(sink.write(&channel, 200000));
    EXPECT_FALSE(sink.write(&channel, 1));
    EXPECT_NE(sink.finish(), "");
}

TEST(WavSink, TellsOfAPlaceItCannotOpen) {
    const auto path = pathOf("no-such-folder/file.wav");
    expectOneLineWith(writeBlocks(path, 4, 10, 10), path + ": cannot be written: the folder ");
    expectOneLineWith(writeBlocks(::testing::TempDir(), 4, 10, 10), "folder");
}

} // namespace physvib::wav_sink_test
