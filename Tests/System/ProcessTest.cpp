// SPDX-License-Identifier: GPL-3.0-or-later
// What the programs need of the system, by this program run again.
#include "System/Process.h"
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <thread>

namespace physvib {
namespace {

std::string self; // this program
constexpr const char* spokenTo = "--hears-hello-and-the-end";
constexpr const char* hangs = "--hangs-after-a-signal";
constexpr const char* threeWords = "with three words";

/// Whether standard input says hello, and then ends.
bool hearsHello() {
    std::string heard;
    for (int looks = 0; looks < 1'000; ++looks) {
        char bytes[4];
        const auto count = readInput(bytes, 20);
        if (count && *count == 0) return heard.starts_with("hello");
        if (count) heard.append(bytes, *count);
    }
    return false;
}

std::string shellWord(const std::string& text) { return '"' + text + '"'; }

TEST(Processes, StandardInputIsReadAsItComesAndEnds) {
    EXPECT_EQ(std::system(("echo hello| " + shellWord(self) + ' ' + spokenTo).c_str()), 0);
    EXPECT_NE(std::system(("echo goodbye| " + shellWord(self) + ' ' + spokenTo).c_str()), 0)
        << "it is this test that hears";
}

TEST(Processes, AProgramSaysWhetherAllIsWell) {
    EXPECT_NE(self.find("physvib-system-tests"), std::string::npos);
    const auto well = runProgram(self, {threeWords}), ill = runProgram(self, {"--no-such-option"}),
               none = runProgram("physvib-no-such-program", {""});
    EXPECT_TRUE(well && well.value) << well.error << ": its argument came as one";
    EXPECT_TRUE(ill && !ill.value) << ill.error;
    EXPECT_TRUE(none.error.starts_with("physvib-no-such-program: ")) << none.error;
}

#if !defined(_WIN32) // which has no such shell, and waits for what it runs
TEST(Processes, AWatchedProgramsLastWordsAreTheReasonAndItIsEndedWhenNobodyWantsIt) {
    const auto run = [](const char* script, bool isWanted = true) {
        return runWatched("sh", {"-c", script}, [isWanted] { return isWanted; });
    };
    const auto why = [&](const char* script) { return run(script).value; };
    EXPECT_EQ(why("echo only a warning >&2"), "");
    EXPECT_EQ(why("exit 3"), "it ended with code 3");
    EXPECT_EQ(why("echo first >&2; echo 'no room' >&2; exit 1"), "no room");
    EXPECT_EQ(why("i=0; while [ $i -lt 20000 ]; do echo line $i; i=$((i+1)); done >&2; exit 1"), "line 19999")
        << "more than a pipe holds";
    EXPECT_EQ(why("kill -9 $$"), "it was ended by signal 9");
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(run("exec sleep 60", false).value, "it was ended by signal 9");
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds{20});
    EXPECT_TRUE(runWatched("physvib-no-such-program", {}, [] {
                    return true;
                }).error.starts_with("physvib-no-such-program: "));
    const auto before = std::signal(SIGCHLD, SIG_IGN); // as some leave it: nobody knows how a child ended
    EXPECT_EQ(run("exit 0").error, "sh: the system does not tell how it ended");
    std::signal(SIGCHLD, before);
}
#endif

/// Gets a signal, and does not end for a minute.
int hangAfterSignal() {
    installInterruptHandlers();
    std::raise(SIGTERM);
    if (!interrupted) return 2;
    std::this_thread::sleep_for(std::chrono::seconds{60});
    return 0;
}

TEST(Processes, WhatHangsAfterASignalIsEnded) {
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_NE(std::system((shellWord(self) + ' ' + hangs).c_str()), 0)
        << "it would end by itself, and say that all is well";
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds{20});
}

TEST(Processes, WhatWasWrittenArrives) {
    std::printf("words\n");
    EXPECT_EQ(outputError(), "");
}

} // namespace
} // namespace physvib

int main(int count, char** words) {
    const std::string_view first = count > 1 ? words[1] : "";
    if (first == physvib::hangs) return physvib::hangAfterSignal();
    if (first == physvib::spokenTo) return physvib::hearsHello() ? 0 : 1;
    if (first == physvib::threeWords) return 0;
    if (first == "--no-such-option") return 3;
    physvib::self = std::filesystem::absolute(words[0]).string();
    testing::InitGoogleTest(&count, words);
    return RUN_ALL_TESTS();
}
