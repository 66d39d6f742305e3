// SPDX-License-Identifier: MIT
// What a WAV file says of itself is not believed: bounded by the bytes that are there, refused by its limit.
#include "Support/FileTesting.h"
#include "Support/ReadWav.h"
#include "Support/WavBytes.h"
#include <cstdio>
#include <memory>

namespace physvib {
namespace {

using test::wavBytes;
using test::WavHeader;

Result<SampledSound> readBytes(const std::string& bytes) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), std::fclose);
    std::fwrite(bytes.data(), 1, bytes.size(), file.get());
    return readWav(*file);
}

TEST(WavFile, GivesSamplesOfEveryWidth) {
    const auto first = [](WavHeader header, const std::string& samples) {
        const auto sound = readBytes(wavBytes(header, samples));
        EXPECT_EQ(sound.error, "");
        return sound.value.channels.empty() ? 9.0f : sound.value.channels[0][0];
    };
    using namespace std::string_literals;
    EXPECT_EQ(first({.bits = 8}, "\x40"s), -0.5f);
    EXPECT_EQ(first({.bits = 16}, "\x00\x40"s), 0.5f);
    EXPECT_EQ(first({.bits = 24}, "\x00\x00\xc0"s), -0.5f);
    EXPECT_EQ(first({.bits = 32}, "\x00\x00\x00\x20"s), 0.25f);
    EXPECT_EQ(first({.format = 3, .bits = 32}, "\x00\x00\x80\xbf"s), -1.0f);
}

TEST(WavFile, KeepsChannelsApartAcrossBlocks) {
    std::string samples;
    for (int n = 0; n < 10'000; ++n)
        for (const int value : {n, -n})
            samples.append({static_cast<char>(value & 255), static_cast<char>(value >> 8)});
    const auto sound = readBytes(wavBytes({.channels = 2}, samples));
    ASSERT_EQ(sound.error, "");
    ASSERT_EQ(sound.value.channels.size(), 2u);
    EXPECT_EQ(sound.value.sampleRateHz, 48000);
    for (std::size_t n = 0; n < 10'000; ++n) {
        ASSERT_EQ(sound.value.channels[0][n], static_cast<float>(n) / 32768.0f);
        ASSERT_EQ(sound.value.channels[1][n], static_cast<float>(n) / -32768.0f);
    }
}

TEST(WavFile, TellsThatAFileEndsEarly) {
    EXPECT_EQ(readBytes(wavBytes({.dataBytes = 56'640'000}, std::string(2000, '\1'))).error,
              "expected 56640000 bytes of samples, as its header says, found 2000: it ends early");
}

TEST(WavFile, TakesWhatIsThereOfALengthThatWasNotKnown) {
    for (const std::uint32_t unknown : {0x7ffff000u, 0xffffffffu}) {
        const auto sound = readBytes(wavBytes({.dataBytes = unknown}, std::string(2001, '\1')));
        ASSERT_EQ(sound.error, "");
        EXPECT_EQ(sound.value.channels[0].size(), 1000u);
    }
}

TEST(WavFile, RefusesByTheLimit) {
    const std::string second(96'000, '\1');
    EXPECT_EQ(readBytes(wavBytes({.rateHz = 1'000'000'000}, second)).error,
              "expected a rate of 100 to 768000 Hz, found 1000000000 Hz");
    EXPECT_EQ(readBytes(wavBytes({.rateHz = 0}, second)).error,
              "expected a rate of 100 to 768000 Hz, found 0 Hz");
    EXPECT_EQ(readBytes(wavBytes({.rateHz = 0x80000000u}, second)).error,
              "expected a rate of 100 to 768000 Hz, found 2147483648 Hz");
    EXPECT_EQ(readBytes(wavBytes({.channels = 200}, second)).error, "expected 1 to 64 channels, found 200");
    EXPECT_EQ(readBytes(wavBytes({.rateHz = 100, .bits = 8}, std::string(60'101, '\1'))).error,
              "expected at most 600 s, found 601 s");
    EXPECT_EQ(soundFault({192'000, 2, 16'000'001}),
              "expected at most 32000000 samples in all channels, found 32000002");
    EXPECT_EQ(soundFault({48'000, 1, 600 * 48'000}), "");
}

TEST(WavFile, RefusesWhatIsNoWav) {
    const std::string whole = wavBytes({}, std::string(2000, '\1'));
    EXPECT_EQ(readBytes("").error, "expected a WAV file");
    EXPECT_EQ(readBytes(whole.substr(0, 11)).error, "expected a WAV file");
    EXPECT_EQ(readBytes(whole.substr(0, 20)).error, "expected PCM of 8, 16, 24 or 32 bits, or float of 32");
    EXPECT_EQ(readBytes(whole.substr(0, 40)).error, "expected samples, found none");
    EXPECT_EQ(readBytes(wavBytes({.bits = 12}, "1234")).error,
              "expected PCM of 8, 16, 24 or 32 bits, or float of 32");
    EXPECT_EQ(readBytes(wavBytes({.channels = 0}, "1234")).error,
              "expected PCM of 8, 16, 24 or 32 bits, or float of 32");
    EXPECT_EQ(readBytes(wavBytes({}, "")).error, "expected samples, found none");
    EXPECT_EQ(readBytes(whole.substr(0, 12) + whole.substr(36)).error,
              "expected a format before the samples");
}

TEST(WavFile, PassesOverChunksThatItDoesNotKnow) {
    const std::string whole = wavBytes({}, "\1\2\3\4");
    const auto with = [&](const std::string& chunk) {
        return readBytes(whole.substr(0, 36) + chunk + whole.substr(36));
    };
    using namespace std::string_literals;
    EXPECT_EQ(with("LIST\3\0\0\0abc\0"s).error, "") << "of an odd length";
    EXPECT_EQ(with("LIST\xff\xff\xff\xff"s).error, "expected samples, found none")
        << "that is longer than the file";
    EXPECT_EQ(with("LIST\0\0\0\0"s).error, "");
}

TEST(WavFile, SurvivesAnything) {
    std::mt19937 random(7);
    const std::string whole = wavBytes({.format = 0xfffe, .channels = 2}, std::string(400, '\3'));
    for (int i = 0; i < 3000; ++i) {
        const auto sound = readBytes(mutated(whole, "RIFdatfm\xff", random));
        ASSERT_EQ(sound.error.empty(), !sound.value.channels.empty());
    }
}

} // namespace
} // namespace physvib
