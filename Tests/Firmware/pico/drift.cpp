// SPDX-License-Identifier: MIT
// Course of the Pico's buffer while the host's clock is off: drift PPM, then a line per second for ten
// minutes: least and most frames behind a packet.
#include "Pico/HostClock.h"
#include <algorithm>
#include <cstdio>
#include <cstdlib>

int main(int count, char** words) {
    if (count != 2) return std::fputs("drift: expected parts per million\n", stderr), 2;
    physvib::test::Stream<4> stream;
    std::uint32_t least = ~0U, most = 0;
    physvib::test::playByHostClock(stream, std::atof(words[1]), 600'000,
                                   [&](int ms, int, std::uint32_t level) {
                                       least = std::min(least, level), most = std::max(most, level);
                                       if (ms % 1000 != 999) return;
                                       std::printf("%u %u\n", least, most);
                                       least = ~0U, most = 0;
                                   });
    return 0;
}
