// SPDX-License-Identifier: GPL-3.0-or-later
// Manual pages and completions hold all that --help holds, of every command.
#include "CommandLine/Calls.h"
#include <algorithm>
#include <iterator>
#include <sstream>

namespace physvib::test {
namespace {

class Reference : public CommandLine {
protected:
    void SetUp() override {
        CommandLine::SetUp();
        ASSERT_EQ(call("--reference told").exitCode, 0);
        zsh_ = read("told/zsh/_physvib");
        fish_ = read("told/fish/physvib.fish");
    }
    /// What --help lists as subcommands.
    std::set<std::string> commandsOf(const std::string& help) const {
        const auto begin = subcommandsIn(help);
        return begin == std::string::npos ? std::set<std::string>{}
                                          : wordsIn(help.substr(begin), "\n  ([a-z-]+)");
    }
    /// Lines of a page as a reader sees them, near enough.
    std::string page(const std::string& name) const {
        return std::regex_replace(read("told/man1/" + name + ".1"), std::regex{"\\\\-"}, "-");
    }

    std::string proposals(const std::string& words) const {
        const std::string script =
            "source told/bash/physvib; COMP_WORDS=(" + words +
            "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _physvib; echo \"${COMPREPLY[*]}\"";
        EXPECT_EQ(
            std::system(("cd '" + folder_.string() + "' && bash -c '" + script + "' >.proposals").c_str()),
            0);
        return read(".proposals");
    }
    void holdsAllOf(const std::string& command, const std::string& pageName) const {
        const std::string help = call(command + " --help").out, manual = page(pageName);
        const auto options = wordsIn(help, "\n +(?:-[a-z], *)?(--[a-z][a-z-]*)");
        EXPECT_TRUE(options.contains("--help")) << command;
        for (const std::string& option : options) {
            EXPECT_NE(manual.find(option), std::string::npos) << command << ' ' << option;
            EXPECT_NE(zsh_.find("'" + option + "["), std::string::npos) << command << ' ' << option;
            EXPECT_NE(fish_.find(" -l " + option.substr(2) + " "), std::string::npos)
                << command << ' ' << option;
        }
        std::istringstream proposed{proposals("physvib " + command + " -")};
        const std::set<std::string> words{std::istream_iterator<std::string>{proposed}, {}};
        EXPECT_TRUE(std::includes(words.begin(), words.end(), options.begin(), options.end())) << command;
    }

    std::string zsh_, fish_;
};

TEST_F(Reference, HoldsAllThatHelpHolds) {
    const auto commands = commandsOf(call("--help").out);
    EXPECT_GT(commands.size(), 10u);
    holdsAllOf("", "physvib");
    for (const std::string& command : commands) {
        holdsAllOf(command, "physvib-" + command);
        EXPECT_NE(page("physvib").find("physvib-" + command), std::string::npos);
        for (const std::string& inner : commandsOf(call(command + " --help").out))
            holdsAllOf(command + ' ' + inner, "physvib-" + command);
    }
}

TEST_F(Reference, ProgramsAreDescribed) {
    for (const char* name :
         {"physvib", "physvib-render", "physvib-play", "physvib-study", "physvib-analyse", "physvib-board"})
        EXPECT_NE(page(name).find("\n.SH DESCRIPTION\n"), std::string::npos) << name;
}

TEST_F(Reference, ProposesWhatMayFollow) {
    EXPECT_EQ(proposals("physvib rend"), "render\n");
    EXPECT_EQ(proposals("physvib render shake"), "shake-the-box\n");
    EXPECT_EQ(proposals("physvib render drop --limiter \"\""), "on off blocks\n");
    EXPECT_EQ(proposals("physvib analyse confu"), "confusion\n");
    EXPECT_EQ(proposals("physvib render --out rend"), "\n") << "a file";
}

TEST_F(Reference, SaysWhyItCannotBeWritten) {
    write("file", "");
    const Outcome outcome = call("--reference file");
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

} // namespace
} // namespace physvib::test
