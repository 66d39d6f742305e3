// SPDX-License-Identifier: GPL-3.0-or-later
// Manual pages and completions hold all that --help holds, of every command.
#include "Calls.h"
#include "CommandLine/Calls.h"
#include <algorithm>
#include <iterator>
#include <regex>
#include <sstream>

namespace physvib::test {
namespace {

class Reference : public CommandLine {
protected:
    void SetUp() override {
        CommandLine::SetUp();
        runs("--reference told");
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
            EXPECT_TRUE(has(manual, option)) << command;
            EXPECT_TRUE(has(zsh_, "'" + option + "[")) << command << ' ' << option;
            EXPECT_TRUE(has(fish_, " -l " + option.substr(2) + " ")) << command << ' ' << option;
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
        EXPECT_TRUE(has(page("physvib"), "physvib-" + command));
        for (const std::string& inner : commandsOf(call(command + " --help").out))
            holdsAllOf(command + ' ' + inner, "physvib-" + command);
    }
}

TEST_F(Reference, ProgramsAreDescribed) {
    for (const char* name :
         {"physvib", "physvib-render", "physvib-play", "physvib-study", "physvib-analyse", "physvib-board"})
        EXPECT_TRUE(has(page(name), "\n.SH DESCRIPTION\n")) << name;
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

// Options that take a number of a range: whatever is not in it is refused in one line, and so is what is no
// number at all.

using Ranges = test::CommandLine;

/// Long names of the options that take a number, as the command's own help has them.
std::vector<std::string> numbersOf(const std::string& help) {
    static const std::regex option{R"(^ .*(--[a-z-]+) [A-Z]+:(POSITIVE|[-0-9.e]+ to ).*)"};
    std::vector<std::string> names;
    std::istringstream lines{help};
    std::smatch found;
    for (std::string line; std::getline(lines, line);)
        if (std::regex_match(line, found, option)) names.push_back(found[1]);
    return names;
}

TEST_F(Ranges, NoOptionTakesWhatIsNoNumber) {
    std::size_t count = 0;
    for (const std::string command :
         {"play", "export drop --to x.hjif", "stimulus phantom", "stimulus pattern A-100",
          "study run patterns", "board none info", "material", "calibrate"})
        for (const auto& option : numbersOf(call(command + " --help").out)) {
            SCOPED_TRACE(command + ' ' + option);
            refuses(command + ' ' + option + " nan", 2, option + ": expected ");
            ++count;
        }
    EXPECT_GE(count, 35u);
}

// Every option of `render` counts for itself alone: it changes what is written, in the file that it is about;
// and those that must change no sample do not.

class EveryOption : public CommandLine {
protected:
    /// What a call leaves: samples without the head, which tells options; lists without their first line.
    std::string left(const std::string& arguments, const std::string& file) const {
        for (const std::string& name : files())
            if (name.starts_with("out.")) std::filesystem::remove(folder_ / name);
        const Outcome outcome = call("render " + arguments);
        EXPECT_EQ(outcome.exitCode, 0) << arguments << "\n" << outcome.err;
        if (file == "said") return outcome.out;
        const std::string text = read(file);
        EXPECT_NE(text, "") << arguments;
        if (file.ends_with(".wav")) return text.substr(std::min(text.size(), text.find("data", 12)));
        return text.substr(text.find('\n') + 1);
    }
};

TEST_F(EveryOption, OfARenderCountsOrIsPromisedNotTo) {
    struct Row {
        std::string option, value, base, file;
        bool counts = true;
    };
    writeHits("loud.csv", "0.02,60,10,0.9,0.5,0.5\n0.05,200,30,0.9,0.3,0.8\n0.1,300,30,0.7,1.6,0.1\n");
    const std::string scene = "shake-the-box --seconds 0.9 --rate 8000 --out out.wav ",
                      list = "--from-events loud.csv --field 2,1 --seconds 0.3 --rate 8000 --out out.wav ",
                      events = scene + "--events out.csv ";
    const std::vector<Row> rows{
        {"--seconds", "1", "shake-the-box --rate 8000 --out out.wav ", "out.wav"},
        {"--seed", "2", scene, "out.wav"},
        {"--layout", "phone2", scene, "out.wav"},
        {"--field", "3,3", "--from-events loud.csv --seconds 0.3 --rate 8000 --out out.wav ", "out.wav"},
        {"--law", "energy", list, "out.wav"},
        {"--exponent", "2", list + "--law linear ", "out.wav"},
        {"--limiter", "off", list + "--level-db 30 ", "out.wav"},
        {"--steps-per-second", "200", scene, "out.wav"},
        {"--location", "fixture", events, "out.csv"},
        {"--timing", "release", events, "out.csv"},
        {"--method", "AF-FV-DRV", list, "out.wav"},
        {"--method", "AV-FF-DRV", list, "out.wav"},
        {"--fixed-level", "each", scene + "--method AF-FF-DRV ", "out.wav"},
        {"--method", "AV-FV-DRF", list, "out.wav"},
        {"--level-db", "-3", list, "out.wav"},
        {"--gamma", "0.5", list, "out.wav"},
        {"--perceived-level", "on", list, "out.wav"},
        {"--marker-of", "messages", scene + "--marker out.marks.wav ", "out.marks.wav"},
        {"--rate", "16000", "--from-events loud.csv --field 2,1 --seconds 0.3 --out out.wav ", "out.wav"},
        {"--threshold", "0.02", list + "--pattern out.pattern.csv ", "out.pattern.csv"},
        {"--contact-sound-db", "-6", scene + "--contact-sound out.sound.wav ", "out.sound.wav"},
        {"--explain", " ", scene, "said"},
        {"--block", "64", scene, "out.wav", false},
        {"--block", "1", list, "out.wav", false},
        {"--patience", "100", scene, "out.wav", false},
        {"--events", "out.csv", scene, "out.wav", false},
        {"--picture", "out.png", list, "out.wav", false},
        {"--pattern", "out.pattern.csv", list, "out.wav", false},
        {"--contact-sound", "out.sound.wav", scene, "out.wav", false},
        {"--contact-sound-channels", "2", scene + "--contact-sound out.sound.wav ", "out.sound.wav"},
        {"--marker", "out.marks.wav", scene, "out.wav", false},
    };
    for (const Row& row : rows) {
        const std::string before = left(row.base, row.file),
                          after = left(row.base + row.option + " " + row.value, row.file);
        EXPECT_EQ(before != after, row.counts) << row.option << " " << row.value << " with " << row.base;
    }
}

} // namespace
} // namespace physvib::test
