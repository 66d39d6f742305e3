// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings and exports on a disk that fails: nothing is told as saved that is not.
#include "Io/Wav/WavSink.h"
#include "Live/Recordings/HitExport.h"
#include "Live/Recordings/Recording.h"
#include "Support/FailingDisk.h"
#include <array>
#include <cmath>

namespace physvib::failing_disk_posix_test {

using namespace test;

class FailingDisksOfRecordings : public FolderTest {
protected:
    static std::array<std::vector<float>, 2> samples() {
        std::array<std::vector<float>, 2> all;
        for (auto& channel : all)
            for (int n = 0; n < 4800; ++n) channel.push_back(0.5f * std::sin(0.05f * static_cast<float>(n)));
        return all;
    }
};

TEST_F(FailingDisksOfRecordings, AreToldByAWavFile) {
    const auto channels = samples();
    const std::array at{channels[0].data(), channels[1].data()};
    for (const bool isThere : {false, true})
        expectToldByEachFault(
            folder,
            [&] {
                if (isThere) put(folder / "a.wav", "old");
            },
            [&] {
                WavSink sink{(folder / "a.wav").string(), 2, 48000};
                for (int i = 0; i < 3 && sink.error().empty(); ++i) sink.write(at.data(), 4800);
                return std::string{sink.finish()};
            },
            true);
}

TEST_F(FailingDisksOfRecordings, AreToldByARecordingAndItsList) {
    const auto channels = samples();
    const std::array at{channels[0].data(), channels[1].data()};
    expectToldByEachFault(
        folder, [] {},
        [&] {
            Recording recording{folder / "take.wav", 2, 48000};
            if (!recording.error().empty()) return recording.error();
            recording.recorder().onBlock({at.data(), 4800, 0, 48000});
            recording.addEvent(
                {{.timeNs = 1000, .frequencyHz = 200, .decayPerSecond = 30, .amplitude = 0.5}, 0, false});
            return recording.finish(0, {1.0, 1.0}, {}, {});
        },
        true);
}

TEST_F(FailingDisksOfRecordings, AreToldByEachPartOfAnExport) {
    for (const ClipFormat format : {ClipFormat::hjif, ClipFormat::ahap, ClipFormat::haptic}) {
        Clip clip;
        clip.channels.resize(3);
        for (std::size_t j = 0; j < 3; ++j) {
            clip.channels[j].label = std::string(1, static_cast<char>('A' + j));
            clip.channels[j].transients = {{0.1, 0.5, 100.0}};
        }
        const auto parts = splitClip(clip, (folder / "hits.x").string(), format);
        expectToldByEachFault(
            folder, [] {},
            [&] {
                const auto written = writeParts(parts, format);
                return written ? std::string{} : written.error;
            });
    }
}

} // namespace physvib::failing_disk_posix_test
