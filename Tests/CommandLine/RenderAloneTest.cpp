// SPDX-License-Identifier: GPL-3.0-or-later
// physvib-render, which has no JUCE: the same events and samples as the whole program, the same care with files.
#include "Calls.h"
#include "TestPlaces.h"
#include <algorithm>

namespace physvib {
namespace {

class RenderAlone : public test::CommandLine {
protected:
    /// What `physvib-render` says; 0 if it is content.
    int alone(const std::string& arguments) const {
        const int status = std::system(("cd '" + folder_.string() + "' && '" PHYSVIB_RENDER_PROGRAM "' " + arguments + " >.out 2>.err").c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    /// What stands behind the head of a WAV file.
    std::string samplesOf(const std::string& name) const {
        const std::string bytes = read(name);
        return bytes.substr(std::min(bytes.size(), bytes.find("data") + 8));
    }
};

TEST_F(RenderAlone, GivesTheEventsAndSamplesOfTheWholeProgram) {
    for (const std::string scene : {"shake-the-box", "marbles", "drop"})
        for (const std::string options : {" --seconds 2 --seed 3", " --seconds 1 --layout ring2 --rate 44100 --steps-per-second 200 --instructions scalar"}) {
            ASSERT_EQ(call("render " + scene + options + " --out a.wav --events a.csv --picture a.png").exitCode, 0);
            ASSERT_EQ(alone(scene + options + " --out b.wav --events b.csv --picture b.png"), 0) << read(".err");
            EXPECT_EQ(read("a.csv"), read("b.csv")) << scene;
            EXPECT_GE(samplesOf("b.wav").size(), 8 * 44100u);
            EXPECT_TRUE(samplesOf("a.wav") == samplesOf("b.wav")) << scene << options;
            EXPECT_GE(read("b.png").size(), 10000u);
            EXPECT_TRUE(read("a.png") == read("b.png")) << scene << options;
        }
    ASSERT_EQ(alone("a.csv --seconds 1 --out again.wav"), 0) << read(".err");
}

TEST_F(RenderAlone, RefusesInOneLineAndLeavesNothing) {
    for (const auto& [arguments, code] : std::vector<std::pair<std::string, int>>{
             {"drop", 2}, {"drop --out x.wav --seconds -1", 2}, {"drop --out x.wav --seconds nan", 2}, {"drop --out x.wav --events x.wav", 2}, {"nothing --out x.wav", 1}, {"drop --layout no --out x.wav", 1},
             {"drop --seconds 86400 --rate 192000 --out x.wav", 1}, {"drop --out no/x.wav", 1},
             {"drop --out x.png --picture x.png", 2}, {"drop --picture x.svg", 2}, {"drop --out x.wav --events x.csv --picture no/x.png", 1}}) {
        EXPECT_EQ(alone(arguments), code) << arguments;
        const std::string said = read(".err");
        EXPECT_TRUE(said.starts_with("physvib-render: ")) << said;
        EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
        EXPECT_TRUE(files().empty()) << arguments;
    }
}

} // namespace
} // namespace physvib
