// SPDX-License-Identifier: GPL-3.0-or-later
// What instructions.sh counts: CHANNELS, STRIKES a second on so many MODES, for so many SECONDS of sound.
#include "Rain.h"
#include <cstdlib>

int main(int count, char** arguments) {
    if (count != 5) return 2;
    physvib::bench::RainedOn chain{std::atoi(arguments[1]), std::atoi(arguments[2]), std::atoi(arguments[3])};
    chain.seconds(std::atof(arguments[4]));
    return 0;
}
