// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings from files that nobody vouches for.
#include "Live/Recordings/ReadRecording.h"
#include "Support/WavBytes.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <juce_audio_formats/juce_audio_formats.h>
#include <sys/stat.h>
#include <unistd.h>

namespace physvib {
namespace {

namespace fs = std::filesystem;

class ReadRecording : public ::testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (fs::temp_directory_path() / "physvib-recordings-XXXXXX").string();
        ASSERT_NE(mkdtemp(pattern.data()), nullptr);
        folder = pattern;
    }
    void TearDown() override { fs::remove_all(folder); }

    fs::path write(const std::string& name, const std::string& bytes) const {
        std::ofstream{folder / name, std::ios::binary} << bytes;
        return folder / name;
    }
    static std::string bytesOf(const fs::path& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>{file}, {}};
    }
    /// `seconds` of two tones, by JUCE.
    fs::path writeWith(const std::string& name, int bits, double seconds = 1.0, int channels = 2) const {
        juce::AudioFormatManager formats;
        formats.registerBasicFormats();
        juce::AudioFormat& format = *formats.findFormatForFileExtension(fs::path{name}.extension().string());
        juce::AudioBuffer<float> sound(channels, static_cast<int>(seconds * 44100.0));
        for (int j = 0; j < channels; ++j)
            for (int n = 0; n < sound.getNumSamples(); ++n)
                sound.setSample(j, n, 0.7f * std::sin(0.01f * static_cast<float>((j + 1) * n)));
        auto stream = std::make_unique<juce::FileOutputStream>(juce::File{(folder / name).string()});
        const std::unique_ptr<juce::AudioFormatWriter> writer{
            format.createWriterFor(stream.get(), 44100.0, static_cast<unsigned>(channels), bits, {}, 0)};
        EXPECT_NE(writer, nullptr);
        stream.release();
        writer->writeFromAudioSampleBuffer(sound, 0, sound.getNumSamples());
        return folder / name;
    }
    static SampledSound asJuceReads(const fs::path& path) {
        juce::AudioFormatManager formats;
        formats.registerBasicFormats();
        const std::unique_ptr<juce::AudioFormatReader> reader{
            formats.createReaderFor(juce::File{path.string()})};
        juce::AudioBuffer<float> all(static_cast<int>(reader->numChannels),
                                     static_cast<int>(reader->lengthInSamples));
        reader->read(&all, 0, all.getNumSamples(), 0, true, true);
        SampledSound sound{static_cast<int>(reader->sampleRate), {}};
        for (int j = 0; j < all.getNumChannels(); ++j)
            sound.channels.emplace_back(all.getReadPointer(j), all.getReadPointer(j) + all.getNumSamples());
        return sound;
    }
    static void expectAsJuceReads(const fs::path& path) {
        const auto sound = readRecording(path);
        ASSERT_EQ(sound.error, "");
        const SampledSound reference = asJuceReads(path);
        EXPECT_EQ(sound.value.sampleRateHz, reference.sampleRateHz);
        EXPECT_TRUE(sound.value.channels == reference.channels) << path << ": other samples";
    }

    fs::path folder;
};

TEST_F(ReadRecording, GivesTheSamplesThatJuceGives) {
    for (const int bits : {8, 16, 24, 32}) expectAsJuceReads(writeWith(std::to_string(bits) + ".wav", bits));
    expectAsJuceReads(writeWith("six.wav", 24, 0.3, 6));
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
    const auto path = write("hole.wav", test::wavBytes({}, std::string(2000, '\1')));
    fs::resize_file(path, 1'500'000'000);
    EXPECT_EQ(readRecording(path).error, path.string() + ": expected at most 256000000 bytes, found more");
}

TEST_F(ReadRecording, SaysWhatIsExpected) {
    const auto path = write("a.txt", "Not a sound, but some words.");
    EXPECT_EQ(readRecording(path).error, path.string() + ": expected a WAV, FLAC or Ogg Vorbis file");
}

TEST_F(ReadRecording, NamesAFileInCleanWords) {
    const fs::path path = folder / "\xff\x1b[2J\n.wav";
    EXPECT_EQ(readRecording(path).error,
              folder.string() + "/\\xff\\x1b[2J\\x0a.wav: cannot be read: No such file or directory");
    write(path.filename().string(), test::wavBytes({}, std::string(2000, '\1')));
    EXPECT_EQ(readRecording(path).error, "") << "a name that is no UTF-8 is no fault of what it holds";
}

TEST_F(ReadRecording, ReadsWhatIsCompressed) {
    expectAsJuceReads(writeWith("a.flac", 16, 5.0));
    expectAsJuceReads(writeWith("a.ogg", 16, 5.0));
}

TEST_F(ReadRecording, TellsThatAFlacEndsEarly) {
    const std::string whole = bytesOf(writeWith("a.flac", 16, 5.0));
    const auto path = write("cut.flac", whole.substr(0, whole.size() / 2));
    EXPECT_EQ(readRecording(path).error,
              path.string() + ": expected 220500 samples in each channel, as its header says: it ends early");
}

/// With another number of samples in its description: 36 bits, the last five bytes but the upper half of the
/// first.
std::string flacOfLength(std::string bytes, std::uint64_t samples) {
    bytes[21] = static_cast<char>((bytes[21] & 0xf0) | (samples >> 32 & 15));
    for (std::size_t i = 0; i < 4; ++i) bytes[22 + i] = static_cast<char>(samples >> (24 - 8 * i) & 255);
    return bytes;
}

TEST_F(ReadRecording, DoesNotBelieveTheLengthOfAFlac) {
    const std::string whole = bytesOf(writeWith("a.flac", 16, 0.5));
    const auto fault = [&](std::uint64_t samples) {
        const auto path = write("lies.flac", flacOfLength(whole, samples));
        const std::string error = readRecording(path).error;
        return error.substr(std::min(path.string().size(), error.size()));
    };
    EXPECT_EQ(fault(22050), "");
    EXPECT_EQ(fault(15'000'000),
              ": expected 15000000 samples in each channel, as its header says: it ends early");
    EXPECT_EQ(fault(25'000'000), ": expected at most 32000000 samples in all channels, found 50000000");
    EXPECT_EQ(fault((1ull << 32) + 22050),
              ": expected at most 4294967295 samples in each channel, found 4294989346")
        << "JUCE would take the lower 32 bits";
    EXPECT_EQ(fault(0), ": expected a FLAC file that says how long it is");
}

TEST_F(ReadRecording, RefusesSeveralDescriptionsInOneFlac) {
    const std::string whole = bytesOf(writeWith("a.flac", 16, 0.5));
    std::string second = flacOfLength(whole, 0).substr(4, 38);
    second[0] = '\x80'; // of its kind, and the last block
    const auto path = write("two.flac", whole.substr(0, 42) + second + whole.substr(42));
    EXPECT_EQ(readRecording(path).error, path.string() + ": expected one description of the stream");
}

TEST_F(ReadRecording, RefusesSeveralStreamsInOneOgg) {
    const auto path =
        write("two.ogg", bytesOf(writeWith("a.ogg", 16, 1.0, 2)) + bytesOf(writeWith("b.ogg", 16, 1.0, 1)));
    EXPECT_EQ(readRecording(path).error, path.string() + ": expected one stream of sound, found several")
        << "JUCE would read a second channel that is not there";
}

} // namespace
} // namespace physvib
