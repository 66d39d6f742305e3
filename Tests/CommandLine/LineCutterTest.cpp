// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of `play --listen`, however they arrive.
#include "CommandLine/Play/InputListener.h"
#include <gtest/gtest.h>
#include <vector>

namespace physvib {
namespace {

const std::string tooLong = "(too long)";

std::vector<std::string> linesOf(const std::string& text, std::size_t atOnce) {
    std::vector<std::string> lines;
    const auto take = [&](std::string_view line, bool isWhole) {
        lines.push_back(isWhole ? std::string{line} : tooLong + std::string{line});
    };
    LineCutter cutter;
    for (std::size_t at = 0; at < text.size(); at += atOnce)
        cutter.add(std::string_view{text}.substr(at, atOnce), take);
    cutter.end(take);
    return lines;
}

TEST(LineCutter, HandsOverEachLineAndTheLastWithoutANewline) {
    for (const std::size_t atOnce : {1u, 3u, 4096u}) {
        EXPECT_EQ(linesOf("a\n\nbc\nlast", atOnce), (std::vector<std::string>{"a", "", "bc", "last"}));
        EXPECT_EQ(linesOf("a\n", atOnce), std::vector<std::string>{"a"});
    }
}

TEST(LineCutter, NothingOfALineThatIsTooLongIsTakenForAnother) {
    const std::string control = R"({"control": "silence", "on": true})";
    for (const std::size_t atOnce : {1000u, 4096u, 69'652u, 1'000'000u}) { // one of them cuts the word in two
        EXPECT_EQ(linesOf(std::string(69'632, 'x') + control + "\n" + control + "\n", atOnce),
                  (std::vector<std::string>{tooLong + "silence", control}));
        EXPECT_EQ(linesOf(control + std::string(69'632, 'x') + "\n", atOnce)[0], tooLong + "silence");
        EXPECT_EQ(linesOf(control + "\n" + std::string(200'000, 'x'), atOnce),
                  (std::vector<std::string>{control, tooLong}));
        EXPECT_EQ(linesOf(std::string(LineCutter::longest, 'x') + "\n", atOnce)[0].size(),
                  LineCutter::longest);
    }
}

} // namespace
} // namespace physvib
