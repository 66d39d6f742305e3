// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings from files that nobody vouches for: read whole, or refused in one line. Tests/Live/sounds.py has
// many more.
#include "Live/Recordings/ReadRecording.h"
#include "Support/FileTesting.h"
#include "Support/WavBytes.h"
#include "Support/WriteSound.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <sys/stat.h>
#include <unistd.h>

namespace physvib::read_recording_test {

namespace fs = std::filesystem;
using test::numberBytes;
using test::wavBytes;
using test::WavHeader;
using namespace std::string_literals;

class ReadRecording : public FolderTest {
protected:
    fs::path write(const std::string& name, const std::string& bytes) const {
        std::ofstream{folder / name, std::ios::binary} << bytes;
        return folder / name;
    }
    static std::string bytesOf(const fs::path& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>{file}, {}};
    }
    /// Two tones, whole numbers of 16 bits.
    static SampledSound tones(double seconds, int channels) {
        SampledSound sound{44100, std::vector<std::vector<float>>(static_cast<std::size_t>(channels))};
        for (int j = 0; j < channels; ++j)
            for (int n = 0; n < static_cast<int>(seconds * 44100.0); ++n)
                sound.channels[static_cast<std::size_t>(j)].push_back(
                    static_cast<float>(std::round(22000.0 * std::sin(0.01 * (j + 1) * n)) / 32768.0));
        return sound;
    }
    std::string written(int format, const SampledSound& sound) const {
        EXPECT_TRUE(test::writeSound(folder / "by-library", format, sound)) << std::hex << format;
        return bytesOf(folder / "by-library");
    }
    Result<SampledSound> readBytes(const std::string& bytes) const {
        return readRecording(write("sound", bytes));
    }
    /// What is wrong with these bytes, without the name.
    std::string fault(const std::string& bytes) const {
        const std::string error = readBytes(bytes).error, name = (folder / "sound").string() + ": ";
        return error.starts_with(name) ? error.substr(name.size()) : error;
    }
};

TEST_F(ReadRecording, GivesSamplesOfEveryWidthToTheBit) {
    for (const char* kind : {"RIFF", "RIFX", "RF64", "BW64"})
        for (const std::uint32_t format : {1u, 0xfffeu})
            for (const std::uint32_t bits : {8u, 12u, 16u, 20u, 24u, 32u})
                for (const std::uint32_t channels : {1u, 3u}) {
                    std::string samples;
                    std::vector<float> wanted;
                    const auto room = (bits + 7) / 8 * 8;
                    for (std::int64_t n = 0; n < 9000; ++n) { // more than a block
                        const std::int64_t x =
                            n * 123'456'789 % (std::int64_t{1} << bits) - (std::int64_t{1} << (bits - 1));
                        wanted.push_back(static_cast<float>(x) *
                                         std::ldexp(1.0f, 1 - static_cast<int>(bits)));
                        const auto stored = static_cast<std::uint64_t>(x) << (room - bits);
                        samples += numberBytes(bits == 8 ? stored ^ 128 : stored, static_cast<int>(room / 8),
                                               kind == "RIFX"s);
                    }
                    const auto sound = readBytes(wavBytes(
                        {.format = format, .channels = channels, .bits = bits, .kind = kind}, samples));
                    ASSERT_EQ(sound.error, "") << kind << format << ' ' << bits;
                    ASSERT_EQ(sound.value.channels.size(), channels);
                    ASSERT_EQ(sound.value.channels[0].size(), wanted.size() / channels);
                    for (std::size_t i = 0; i < wanted.size(); ++i)
                        ASSERT_EQ(sound.value.channels[i % channels][i / channels], wanted[i])
                            << kind << format << ' ' << bits << ' ' << i;
                }
}

TEST_F(ReadRecording, GivesFloatsAsTheyAre) {
    const std::vector<double> wanted{0.0, -1.0, 0.1, 327.5, 1e-30};
    std::string narrow, wide;
    for (const double x : wanted) {
        narrow += numberBytes(std::bit_cast<std::uint32_t>(static_cast<float>(x)), 4);
        wide += numberBytes(std::bit_cast<std::uint64_t>(x), 8);
    }
    for (const auto& bytes :
         {wavBytes({.format = 3, .bits = 32}, narrow), wavBytes({.format = 3, .bits = 64}, wide)}) {
        const auto sound = readBytes(bytes);
        ASSERT_EQ(sound.error, "");
        EXPECT_TRUE(std::ranges::equal(sound.value.channels[0], wanted, {}, {},
                                       [](double x) { return static_cast<float>(x); }));
    }
}

TEST_F(ReadRecording, GivesSamplesOfG711) {
    const std::string mu = wavBytes({.format = 7, .bits = 8}, "\x7e\xfe\x80"s),
                      a = wavBytes({.format = 6, .bits = 8}, "\x55\xd5\xaa");
    EXPECT_EQ(readBytes(mu).value.channels.at(0), (std::vector{-0x8p-15f, 0x8p-15f, 0x7d7cp-15f}));
    EXPECT_EQ(readBytes(a).value.channels.at(0), (std::vector{-0x8p-15f, 0x8p-15f, 0x7e00p-15f}));
}

// ALSA's arecord writes 24 bits into the lower part of 32; others, as WAVE has it, into the upper one.
TEST_F(ReadRecording, ReadsSamplesThatHaveMoreRoom) {
    for (const std::uint32_t bits : {12u, 16u, 20u, 24u})
        for (const std::uint32_t room : {24u, 32u})
            for (const bool isUpper : {false, true}) {
                if (room <= bits) continue;
                std::string samples;
                std::vector<float> wanted;
                for (int n = 0; n < 2000; ++n) {
                    const auto x = static_cast<std::int64_t>(
                        std::round(0.3 * std::sin(0.02 * n) * std::ldexp(1.0, static_cast<int>(bits) - 1)));
                    wanted.push_back(std::ldexp(static_cast<float>(x), 1 - static_cast<int>(bits)));
                    samples += numberBytes(static_cast<std::uint64_t>(x) << (isUpper ? room - bits : 0),
                                           static_cast<int>(room / 8));
                }
                const auto sound = readBytes(wavBytes({.bits = bits, .frameBytes = room / 8}, samples));
                ASSERT_EQ(sound.error, "") << bits << ' ' << room;
                EXPECT_EQ(sound.value.channels[0], wanted)
                    << bits << " of " << room << ", upper: " << isUpper;
            }
    EXPECT_EQ(fault(wavBytes({.channels = 2, .bits = 24, .frameBytes = 7}, std::string(7000, '\1'))),
              "expected blocks of 6 bytes, found 7");
    EXPECT_EQ(fault(wavBytes({.format = 3, .bits = 32, .frameBytes = 8}, std::string(8000, '\1'))),
              "expected blocks of 4 bytes, found 8");
    const std::string negative = numberBytes(0x00ff'0001, 4), positive = numberBytes(0x1234, 4);
    EXPECT_EQ(fault(wavBytes({.bits = 24, .frameBytes = 4}, positive + negative)),
              "expected the upper or the lower 24 bits, found others")
        << "what is above them is not their sign";
    EXPECT_EQ(fault(wavBytes({.channels = 2, .frameBytes = 2}, std::string(8000, '\1'))), "")
        << "too small for its samples: a slip of who wrote it";
}

TEST_F(ReadRecording, ReadsAllOrTellsWhy) {
    const std::string samples(2000, '\1'), whole = wavBytes({}, samples);
    const auto told = [&](std::uint32_t bytes) { return wavBytes({.dataBytes = bytes}, samples); };
    for (const std::uint32_t unknown : {0x7fff'f000u, 0x7fff'ffdbu, 0x8000'0000u, 0xffff'ffffu})
        EXPECT_EQ(readBytes(told(unknown)).value.channels.at(0).size(), 1000u) << unknown;
    std::string killed = whole; // a recorder that was killed has not written its sizes yet
    killed.replace(40, 4, 4, '\0');
    EXPECT_EQ(readBytes(killed).value.channels.at(0).size(), 1000u);
    EXPECT_EQ(fault(killed.substr(0, 44) + "LIST" + numberBytes(4, 4) + "INFO"),
              "expected samples, found none");
    EXPECT_EQ(fault(told(56'640'000)),
              "expected 56640000 bytes of samples, as its header says, found 2000: it ends early");
    EXPECT_EQ(fault(told(3'000'000'000)),
              "expected 3000000000 bytes of samples, as its header says, found 2000: it ends early")
        << "no length that is unknown";
    EXPECT_EQ(
        fault(told(200)),
        "expected 200 bytes of samples, as its header says, found 1800 more, which are no other chunks");
    const std::string list = "LIST"s + numberBytes(3, 4) + "abc\0"s;
    for (const std::string& behind :
         {list, list + list, list.substr(0, 11), std::string(500, '\0'), "TAG" + std::string(125, 'x')})
        EXPECT_EQ(fault(whole + behind), "") << behind;
    EXPECT_EQ(fault(whole + "more"),
              "expected 2000 bytes of samples, as its header says, found 4 more, which are no other chunks");
    EXPECT_EQ(fault(whole + "data" + numberBytes(2, 4) + "ab"),
              "expected 2000 bytes of samples, as its header says, found 10 more, which are no other chunks");
    EXPECT_EQ(fault(wavBytes({.before = "ds64"s + numberBytes(28, 4) + std::string(28, '\1')}, samples)), "")
        << "means nothing in RIFF";
    for (const char* kind : {"RF64", "BW64"}) {
        std::string head = wavBytes({.kind = kind}, samples);
        const auto sized = [&](std::uint64_t bytes) {
            return std::string{head}.replace(28, 8, numberBytes(bytes, 8));
        };
        for (const std::uint64_t unknown : {std::uint64_t{0}, std::uint64_t{1} << 60, ~std::uint64_t{0}})
            EXPECT_EQ(readBytes(sized(unknown)).value.channels.at(0).size(), 1000u) << unknown;
        EXPECT_EQ(fault(sized(5'000'000'000)),
                  "expected 5000000000 bytes of samples, as its header says, found 2000: it ends early");
        EXPECT_EQ(
            fault(sized(200)),
            "expected 200 bytes of samples, as its header says, found 1800 more, which are no other chunks");
    }
    EXPECT_EQ(fault("ID3\4\0\0\0\0\1\0"s + std::string(128, '\0') + whole), "");
}

/// Counts, and keeps nothing.
struct Counter final : SoundReceiver {
    std::string begin(const SoundFormat& shape) override { return streamError(shape); }
    std::string receive(const float* const*, int frames) override { return count += frames, std::string{}; }
    std::int64_t count = 0;
};

TEST_F(ReadRecording, TellsThatASizeHasWrappedAtFourGigabytes) {
    const auto path = write("long.wav", wavBytes({}, std::string(96'000, '\1')));
    fs::resize_file(path, 44 + 96'000 + (std::uintmax_t{1} << 32)); // a hole
    Counter counter;
    EXPECT_EQ(streamRecording(path, counter),
              path.string() + ": expected 96000 bytes of samples, as its header says, found 4294967296 more, "
                              "which are no other chunks");
    std::fstream{path, std::ios::in | std::ios::out | std::ios::binary}.seekp(40).write("\0\0\0\0", 4);
    EXPECT_EQ(streamRecording(path, counter), path.string() + ": expected at most 4 GiB of samples, or RF64");
}

TEST_F(ReadRecording, RefusesWhatIsNoWav) {
    const std::string whole = wavBytes({}, std::string(2000, '\1')),
                      no = "expected a WAV, AIFF, FLAC, Ogg Vorbis or Opus file",
                      width = "expected PCM of 8 to 32 bits, float of 32 or 64, or G.711";
    EXPECT_EQ(fault(""), no);
    EXPECT_EQ(fault("Not a sound, but some words."), no);
    EXPECT_EQ(fault(whole.substr(0, 11)), no);
    EXPECT_EQ(fault(whole.substr(0, 40)), "expected samples, found none");
    EXPECT_EQ(fault(wavBytes({.bits = 33}, "12345")), width);
    EXPECT_EQ(fault(wavBytes({.bits = 0}, "12345")), width);
    EXPECT_EQ(fault(wavBytes({.channels = 0}, "1234")), width);
    EXPECT_EQ(fault(wavBytes({.format = 2}, "1234")), width) << "ADPCM";
    EXPECT_EQ(fault(wavBytes({}, "")), "expected samples, found none");
    EXPECT_EQ(fault(whole.substr(0, 12) + whole.substr(36)),
              "expected a format before the samples, of 16 bytes or more");
    EXPECT_EQ(fault(wavBytes({.before = "LIST\xff\xff\xff\xff"s}, "1234")), "expected samples, found none")
        << "a chunk that is longer than the file";
}

TEST_F(ReadRecording, RefusesByTheLimit) {
    const std::string second(96'000, '\1'), rate = "expected a rate of 100 to 768000 Hz, found ";
    EXPECT_EQ(fault(wavBytes({.rateHz = 1'000'000'000}, second)), rate + "1000000000 Hz");
    EXPECT_EQ(fault(wavBytes({.rateHz = 0}, second)), rate + "0 Hz");
    EXPECT_EQ(fault(wavBytes({.rateHz = 0x80000000u}, second)), rate + "2147483648 Hz");
    EXPECT_EQ(fault(wavBytes({.channels = 200}, second)), "expected 1 to 64 channels, found 200");
    EXPECT_EQ(fault(wavBytes({.rateHz = 100, .bits = 8}, std::string(60'101, '\1'))),
              "expected at most 600 s, found 601 s");
    EXPECT_EQ(soundError({192'000, 2, 16'000'001}),
              "expected at most 32000000 samples in all channels, found 32000002");
    EXPECT_EQ(soundError({48'000, 1, 600 * 48'000}), "");
}

TEST_F(ReadRecording, RefusesWhatIsNotFinite) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
        std::string samples;
        for (int n = 0; n < 20'000; ++n)
            samples += numberBytes(std::bit_cast<std::uint32_t>(n == 14'401 ? bad : 0.5f), 4);
        const auto bytes = wavBytes({.format = 3, .channels = 2, .bits = 32}, samples);
        EXPECT_EQ(fault(bytes), "expected finite samples, found "s + (std::isnan(bad) ? "NaN" : "infinity") +
                                    " at 0.1500 s in channel 2");
        Counter counter;
        EXPECT_NE(streamRecording(write("sound", bytes), counter), "") << "nor block by block";
    }
    EXPECT_EQ(fault(wavBytes({.format = 3, .bits = 64}, numberBytes(std::bit_cast<std::uint64_t>(1e300), 8))),
              "expected finite samples, found infinity at 0.0000 s in channel 1");
}

TEST_F(ReadRecording, TakesARegularFileOnly) {
    const std::string why = ": cannot be read: expected a regular file, found a folder, a device or a pipe";
    EXPECT_EQ(readRecording(folder).error, folder.string() + why);
    EXPECT_EQ(readRecording("/dev/zero").error, "/dev/zero" + why);
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_EQ(readRecording(folder / "pipe").error, (folder / "pipe").string() + why)
        << "nobody writes to it: opening it would wait";
    EXPECT_EQ(readRecording(folder / "no.wav").error,
              (folder / "no.wav").string() + ": cannot be read: No such file or directory");
}

TEST_F(ReadRecording, RefusesAFileThatIsTooLongBeforeReadingIt) {
    const auto path = write("hole.wav", wavBytes({}, std::string(2000, '\1')));
    fs::resize_file(path, 1'500'000'000);
    EXPECT_EQ(readRecording(path).error, path.string() + ": expected at most 256000000 bytes, found more");
}

TEST_F(ReadRecording, NamesAFileInCleanWords) {
    const fs::path path = folder / "\xff\x1b[2J\n.wav";
    EXPECT_EQ(readRecording(path).error,
              folder.string() + "/\\xff\\x1b[2J\\x0a.wav: cannot be read: No such file or directory");
    write(path.filename().string(), wavBytes({}, std::string(2000, '\1')));
    EXPECT_EQ(readRecording(path).error, "") << "a name that is no UTF-8 is no fault of what it holds";
}

TEST_F(ReadRecording, ReadsWhatOthersWrite) {
    const SampledSound sound = tones(2.0, 2);
    for (const int format :
         {SF_FORMAT_WAV | SF_FORMAT_PCM_16, SF_FORMAT_WAVEX | SF_FORMAT_PCM_24,
          SF_FORMAT_RF64 | SF_FORMAT_FLOAT, SF_FORMAT_WAV | SF_FORMAT_DOUBLE,
          SF_FORMAT_AIFF | SF_FORMAT_PCM_16, SF_FORMAT_AIFF | SF_FORMAT_PCM_24,
          SF_FORMAT_AIFF | SF_FORMAT_FLOAT, SF_FORMAT_AIFF | SF_ENDIAN_LITTLE | SF_FORMAT_PCM_16,
          SF_FORMAT_FLAC | SF_FORMAT_PCM_16, SF_FORMAT_FLAC | SF_FORMAT_PCM_24}) {
        const auto read = readBytes(written(format, sound));
        ASSERT_EQ(read.error, "") << std::hex << format;
        EXPECT_EQ(read.value.sampleRateHz, 44100);
        EXPECT_TRUE(read.value.channels == sound.channels) << std::hex << format;
    }
    for (const int format : {SF_FORMAT_OGG | SF_FORMAT_VORBIS, SF_FORMAT_OGG | SF_FORMAT_OPUS}) {
        SampledSound of48 = sound;
        of48.sampleRateHz = 48000; // of which Opus is
        const auto read = readBytes(written(format, of48));
        ASSERT_EQ(read.error, "") << std::hex << format;
        ASSERT_EQ(read.value.channels[1].size(), sound.channels[1].size());
        double off = 0.0;
        for (std::size_t n = 0; n < sound.channels[1].size(); ++n)
            off += std::pow(read.value.channels[1][n] - sound.channels[1][n], 2.0);
        EXPECT_LT(std::sqrt(off / static_cast<double>(sound.channels[1].size())), 0.02) << std::hex << format;
    }
    for (const int format : {SF_FORMAT_WAV | SF_FORMAT_MS_ADPCM, SF_FORMAT_AIFF | SF_FORMAT_IMA_ADPCM,
                             SF_FORMAT_W64 | SF_FORMAT_PCM_16, SF_FORMAT_CAF | SF_FORMAT_PCM_16})
        EXPECT_TRUE(fault(written(format, tones(1.0, 1))).starts_with("expected ")) << std::hex << format;
}

/// With another number of samples in its description: 36 bits, the last five bytes but half of the first.
std::string flacOfLength(std::string bytes, std::uint64_t samples) {
    bytes[21] = static_cast<char>((bytes[21] & 0xf0) | (samples >> 32 & 15));
    for (std::size_t i = 0; i < 4; ++i) bytes[22 + i] = static_cast<char>(samples >> (24 - 8 * i) & 255);
    return bytes;
}

TEST_F(ReadRecording, DoesNotBelieveTheLengthOfAFlac) {
    const std::string whole = written(SF_FORMAT_FLAC | SF_FORMAT_PCM_16, tones(2.0, 2)),
                      expected = "expected ", says = " samples in each channel, as its header says, found ";
    const auto lies = [&](std::uint64_t samples) { return fault(flacOfLength(whole, samples)); };
    EXPECT_EQ(lies(88'200), "");
    EXPECT_EQ(lies(15'000'000), expected + "15000000" + says + "damage or the end after 88200");
    EXPECT_EQ(lies(5000), expected + "5000" + says + "more");
    EXPECT_EQ(lies(25'000'000), "expected at most 32000000 samples in all channels, found 50000000");
    EXPECT_EQ(lies((1ull << 32) + 88'200), "expected at most 600 s, found 97393 s");
    const auto unknown = readBytes(flacOfLength(whole, 0));
    ASSERT_EQ(unknown.error, "") << "as one that was written to a pipe";
    EXPECT_TRUE(unknown.value.channels == tones(2.0, 2).channels);
    EXPECT_EQ(fault("ID3\4\0\0\0\0\1\0"s + std::string(128, '\0') + whole + "TAG" + std::string(125, 'x')),
              "");
}

TEST_F(ReadRecording, TellsWhatIsMissingOrDamaged) {
    const std::string flac = written(SF_FORMAT_FLAC | SF_FORMAT_PCM_16, tones(5.0, 1)),
                      ogg = written(SF_FORMAT_OGG | SF_FORMAT_VORBIS, tones(5.0, 1)),
                      aiff = written(SF_FORMAT_AIFF | SF_FORMAT_PCM_16, tones(1.0, 1));
    const auto damaged = [](std::string bytes, std::size_t at) {
        return bytes[at] = static_cast<char>(bytes[at] ^ 0x55), bytes;
    };
    for (const double part : {0.2, 0.4, 0.6, 0.8, 0.99}) {
        const auto inFlac = static_cast<std::size_t>(part * static_cast<double>(flac.size())),
                   inOgg = static_cast<std::size_t>(part * static_cast<double>(ogg.size()));
        EXPECT_TRUE(
            fault(damaged(flac, inFlac))
                .starts_with("expected 220500 samples in each channel, as its header says, found damage"))
            << part;
        EXPECT_TRUE(fault(flac.substr(0, inFlac)).starts_with("expected 220500 samples")) << part;
        EXPECT_TRUE(fault(flacOfLength(flac.substr(0, inFlac), 0))
                        .starts_with("expected samples to the end, found damage"))
            << part;
        EXPECT_TRUE(fault(damaged(ogg, inOgg)).starts_with("expected whole pages, found damage at byte "))
            << part;
        EXPECT_EQ(fault(ogg.substr(0, inOgg)), "expected the last page of its stream: it ends early") << part;
    }
    EXPECT_TRUE(fault(aiff.substr(0, 40'000)).ends_with(": it ends early"));
    EXPECT_EQ(fault(ogg.substr(0, ogg.rfind("OggS"))), "expected the last page of its stream: it ends early");
    std::vector<std::size_t> pages;
    for (auto at = ogg.find("OggS"); at != std::string::npos; at = ogg.find("OggS", at + 1))
        pages.push_back(at);
    ASSERT_GE(pages.size(), 4u);
    EXPECT_EQ(fault(ogg.substr(0, pages[2]) + ogg.substr(pages[3])),
              "expected whole pages, found damage at byte " + std::to_string(pages[2]));
}

TEST_F(ReadRecording, RefusesSeveralStreams) {
    const std::string flac = written(SF_FORMAT_FLAC | SF_FORMAT_PCM_16, tones(0.5, 2)),
                      ogg = written(SF_FORMAT_OGG | SF_FORMAT_VORBIS, tones(1.0, 2));
    std::string second = flacOfLength(flac, 0).substr(4, 38);
    second[0] = '\x80'; // of its kind, and the last block
    EXPECT_EQ(fault(flac.substr(0, 42) + second + flac.substr(42)), "expected one description of the stream");
    EXPECT_EQ(fault(ogg + written(SF_FORMAT_OGG | SF_FORMAT_VORBIS, tones(1.0, 1))),
              "expected one stream of sound, found several");
    std::string bits = flac;
    bits[20] = static_cast<char>(bits[20] | 1), bits[21] = static_cast<char>((bits[21] & 15) | 0x70); // 24
    EXPECT_EQ(fault(bits), "expected 8, 12, 16, 20, 24 or 32 bits, in its description as in its frames");
}

TEST_F(ReadRecording, SurvivesAnything) {
    std::mt19937 random(7);
    for (const std::string& whole :
         {wavBytes({.format = 0xfffe, .channels = 2, .frameBytes = 8}, std::string(400, '\3')),
          wavBytes({.kind = "RF64"}, std::string(400, '\3')),
          written(SF_FORMAT_FLAC | SF_FORMAT_PCM_16, tones(0.05, 1)),
          written(SF_FORMAT_AIFF | SF_FORMAT_PCM_16, tones(0.02, 1)),
          written(SF_FORMAT_OGG | SF_FORMAT_VORBIS, tones(0.05, 1))})
        for (int i = 0; i < 100; ++i) {
            const auto sound = readBytes(mutated(whole, "RIFdatfmSNOg\xff", random));
            ASSERT_EQ(sound.error.empty(), !sound.value.channels.empty());
        }
}

} // namespace physvib::read_recording_test
