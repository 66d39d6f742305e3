// SPDX-License-Identifier: MIT
// What has to leave the Pico's pins, made on this computer: expected CHANNELS full|low <SENT >EXPECTED,
// frames of 16-bit samples. Playing starts with the first frame; nothing is missing.
#include "Signal/Player.h"
#include <cstdio>
#include <memory>
#include <string>

namespace {

template <int channels>
int play(bool isCeilingLow) {
    using namespace physvib::pico;
    const auto player = std::make_unique<Player<channels>>();
    player->setLowCeiling(isCeilingLow);
    for (int j = 0; j < channels; ++j) player->setVolume(j, unity);
    Tile<channels> tile;
    for (int k = 0; k < 300; ++k) player->render(tile); // volumes and ceiling have ramped up
    Frame<channels> frames[tileFrames];
    bool starts = false;
    while (std::fread(frames, sizeof frames, 1, stdin) == 1) {
        player->buffer.write(frames, tileFrames);
        starts = starts || player->buffer.level() >= FrameBuffer<channels>::targetFrames;
        if (!starts) continue;
        player->setAllowed(true);
        player->render(tile);
        if (std::fwrite(&tile, sizeof tile, 1, stdout) != 1) return 1;
    }
    return 0;
}

} // namespace

int main(int count, char** words) {
    const std::string channels = count == 3 ? words[1] : "", ceiling = count == 3 ? words[2] : "";
    if ((channels != "4" && channels != "8") || (ceiling != "full" && ceiling != "low")) {
        std::fputs("expected: expected 4|8 full|low <SENT >EXPECTED\n", stderr);
        return 2;
    }
    return channels == "4" ? play<4>(ceiling == "low") : play<8>(ceiling == "low");
}
