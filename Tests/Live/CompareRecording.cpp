// SPDX-License-Identifier: GPL-3.0-or-later
// Tells whether a recording is the render, block by block, but for the breaks that the server's own xruns
// explain. Usage: physvib-compare-recording RECORDING.raw RENDER.raw CHANNELS BLOCK_FRAMES XRUNS
#include "RecordingRuns.h"
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

using namespace physvib::test;

namespace {

Recording read(const char* path, int channels) {
    std::ifstream file{path, std::ios::binary};
    const std::vector<char> bytes{std::istreambuf_iterator<char>{file}, {}};
    Recording signal{std::vector<float>(bytes.size() / sizeof(float)), channels};
    std::memcpy(signal.samples.data(), bytes.data(), signal.samples.size() * sizeof(float));
    return signal;
}

int sum(const std::vector<Break>& breaks, int (*part)(const Break&)) {
    int total = 0;
    for (const auto& b : breaks) total += part(b);
    return total;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 6) return 2;
    const int channels = std::atoi(argv[3]), block = std::atoi(argv[4]), xruns = std::atoi(argv[5]);
    const Recording recording = read(argv[1], channels), render = read(argv[2], channels);
    const auto result = RecordingRuns{recording, render, block}.compare();
    if (!result.isAligned) {
        std::puts("recording: no block of the recording is found in the render");
        return 1;
    }
    const auto count = static_cast<int>(result.breaks.size());
    std::printf("recording: %lld of %lld blocks of %d frames bit-equal to the render, %lld frames later, in "
                "%d run%s\n",
                static_cast<long long>(result.equal), static_cast<long long>(result.blocks), block,
                static_cast<long long>(result.offset), count + 1, count == 0 ? "" : "s");
    if (count > 0 || xruns > 0)
        std::printf(
            "recording: %d breaks (%d blocks skipped, %d too many, %d blank or torn); server: %d xruns\n",
            count, sum(result.breaks, [](const Break& b) { return std::max(b.skipped, 0); }),
            sum(result.breaks, [](const Break& b) { return std::max(-b.skipped, 0); }),
            sum(result.breaks, [](const Break& b) { return b.foreign; }), xruns);
    const bool isExplained = count <= xruns;
    if (!isExplained) std::puts("recording: more breaks than xruns");
    return isExplained && result.equal > 0 ? 0 : 1;
}
