// SPDX-License-Identifier: GPL-3.0-or-later
// What instructions.sh counts: CHANNELS, STRIKES a second on so many MODES; of so many SECONDS the last one,
// in the function `counted`.
#include "Rain.h"
#include <cstdlib>

extern "C" [[gnu::noinline]] void counted(physvib::bench::RainedOn& chain) { chain.seconds(1.0); }

int main(int count, char** arguments) {
    if (count != 5) return 2;
    physvib::bench::RainedOn chain{std::atoi(arguments[1]), std::atoi(arguments[2]), std::atoi(arguments[3])};
    chain.seconds(std::atof(arguments[4]) - 1.0);
    counted(chain);
    return 0;
}
