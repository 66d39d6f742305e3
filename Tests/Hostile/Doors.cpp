// SPDX-License-Identifier: GPL-3.0-or-later
// Packets and lines of any kind to the doors of a session: physvib-hostile-doors COUNT [SEED]. For the
// sanitizers; prints the one that broke a promise, or before which the program ended (the last line of a log
// of all would be it: run again with its number as COUNT).
#include "Osc/DoorGrammar.h"
#include <chrono>
#include <cstdio>

using namespace physvib;

int main(int argc, char** argv) {
    const long count = argc > 1 ? std::atol(argv[1]) : 20'000;
    const auto seed = static_cast<std::uint32_t>(argc > 2 ? std::atol(argv[2]) : 1);
    test::DoorGrammar grammar{seed};
    test::DoorTrial trial;
    const auto begin = std::chrono::steady_clock::now();
    for (long k = 0; k < count; ++k) {
        const bool isPacket = k % 2 == 0;
        const auto packet = isPacket ? grammar.packet() : std::vector<char>{};
        const auto line = isPacket ? std::string{} : grammar.line();
        try {
            isPacket ? trial.packet(packet) : trial.line(line);
            if (k % 100 == 0) trial.demandThatSilenceSilences();
        } catch (const std::exception& broken) {
            std::printf("%ld: %s\n", k, broken.what());
            std::fwrite(packet.data(), 1, packet.size(), stdout);
            std::printf("%s\n", line.c_str());
            return 1;
        }
        if (k % 100'000 == 99'999) std::printf("%ld\n", k + 1), std::fflush(stdout);
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    std::printf("%ld packets and lines, seed %u: silence silences, nothing else broken; %.0f s\n", count,
                seed, took.count());
    return 0;
}
