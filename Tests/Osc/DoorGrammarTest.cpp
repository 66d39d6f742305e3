// SPDX-License-Identifier: GPL-3.0-or-later
// Twenty thousand packets and lines of any kind; Tests/Hostile/Doors.cpp tries a million under the
// sanitizers.
#include "Osc/DoorGrammar.h"
#include <gtest/gtest.h>

namespace physvib::door_grammar_test {

TEST(OscReceivers, KeepWhatTheyPromiseWhateverComes) {
    test::DoorGrammar grammar{1};
    test::DoorTrial trial;
    for (int k = 0; k < 10'000; ++k) {
        const auto packet = grammar.packet();
        const auto line = grammar.line();
        try {
            trial.packet(packet);
            trial.line(line);
            if (k % 50 == 0) trial.demandThatSilenceSilences();
        } catch (const std::exception& broken) {
            FAIL() << broken.what() << "\nafter " << k << ", by "
                   << testing::PrintToString(std::string{packet.begin(), packet.end()}) << "\nor " << line;
        }
    }
}

// So that the test above can fail: most is understood, and all kinds are among it.
TEST(OscReceivers, AreTriedWithEveryKindOfMessage) {
    test::DoorGrammar grammar{2};
    std::array<int, 4> lines{};
    int bad = 0, refused = 0;
    for (int k = 0; k < 3000; ++k) {
        const auto read = readInputLine(grammar.line(), {}, 4);
        if (read) ++lines[read.value.index()];
        refused += read ? 0 : 1;
        bad += readOscPacket(grammar.packet()) ? 0 : 1;
    }
    for (const int kind : lines) EXPECT_GT(kind, 15);
    EXPECT_GT(refused, 300);
    EXPECT_GT(bad, 100);
    EXPECT_LT(bad, 1000);
}

} // namespace physvib::door_grammar_test
