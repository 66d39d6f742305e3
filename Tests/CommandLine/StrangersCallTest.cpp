// SPDX-License-Identifier: GPL-3.0-or-later
// Protocols and trial files of others: none of their calls writes a file, whatever option it takes,
// and no link leads them out of their folder.
#include "CommandLine/Calls.h"
#include <algorithm>

namespace physvib {
namespace {

using namespace test;
namespace fs = std::filesystem;

constexpr const char* mine = "a year's work\n";

class StrangersCall : public CommandLine {
protected:
    void SetUp() override {
        CommandLine::SetUp();
        write("thesis.tex", mine);
    }
    void writeProtocol(const std::string& words, const std::string& a = R"("1")",
                       const std::string& b = R"("1")", const std::string& more = {}) const {
        write(
            "p.json",
            R"({"physvib_protocol": 1, "name": "p", )" + more +
                R"("conditions": [{"name": "c", "stimuli": "calls", "factors": [{"name": "a", "values": [)" +
                a + R"(]}, {"name": "b", "values": [)" + b + R"(]}], "call": ")" + words +
                R"("}], "sessions": [{"name": "s"}]})");
    }
    /// The long options of a command, and of those within it.
    std::set<std::string> optionsOf(const std::string& command) const {
        const std::string help = call(command + " --help").out;
        auto options = wordsIn(help, "\n +(?:-[a-z], *)?--([a-z][a-z-]*)");
        if (const auto begin = subcommandsIn(help); begin != std::string::npos)
            for (const std::string& inner : wordsIn(help.substr(begin), "\n  ([a-z][a-z-]*)"))
                options.merge(optionsOf(command + ' ' + inner));
        return options;
    }
    /// The last call was refused in one line that says so.
    bool isRefusedAsWriting(const Outcome& outcome, const std::string& word) const {
        return outcome.exitCode == 1 &&
               outcome.err.find("expected no file to be written, found " + word) != std::string::npos &&
               std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1;
    }
};

TEST_F(StrangersCall, NoOptionOfAnyCommandLetsAProtocolWrite) {
    const auto rendered = optionsOf("render"), made = optionsOf("stimulus");
    int refused = 0;
    for (const std::string& option : optionsOf("")) {
        if (option == "help") continue;
        const std::string word = "--" + option + "=thesis.tex";
        const auto runs = [&](const std::string& words) {
            writeProtocol(words);
            const auto ran = call("study run p.json --observer simulated --out rows");
            fs::remove_all(folder_ / "rows");
            if (ran.exitCode == 0) call(words); // as somebody would copy it out of a row
            ASSERT_EQ(read("thesis.tex"), mine) << words;
            refused += isRefusedAsWriting(ran, words.substr(words.find(word.substr(0, word.find('='))))) ||
                               isRefusedAsWriting(ran, "--" + option)
                           ? 1
                           : 0;
        };
        if (rendered.contains(option))
            runs("render drop --seconds 0.1 --rate 8000 --" + option + " thesis.tex");
        if (made.contains(option)) runs("stimulus phantom --at 0.5,0.5 --seconds 0.1 " + word);
    }
    EXPECT_EQ(refused, 7 + 2) << "render writes seven files, stimulus two";
}

TEST_F(StrangersCall, AMarkerIsAFileAsWell) {
    writeProtocol("render drop --marker thesis.tex");
    for (const std::string command : {"study run p.json --observer simulated", "study show p.json"})
        refuses(command, 1, "p.json: conditions[0].call: expected no file to be written, found --marker", 2);
    EXPECT_EQ(read("thesis.tex"), mine);
}

TEST_F(StrangersCall, NoOptionIsPutTogetherOutOfValues) {
    writeProtocol("render drop --{a}{b} y", R"("out=", "ou")", R"("x")");
    refuses("study run p.json --observer simulated", 1,
            "p.json: conditions[0].call: expected no file to be written, found --out=x", 2);
    writeProtocol("render {a} {b}", R"("--set", "--limiter=on")",
                  R"("drop", "--marker=thesis.tex")"); // each alone is a value, and no option
    refuses("study run p.json --observer simulated", 1,
            "expected no file to be written, found --marker=thesis.tex", 2);
}

TEST_F(StrangersCall, AReportShowsNoCallThatWrites) {
    write("trials.csv", "participant,condition,stimulus,response,render\nP,A,1,1,render drop --seconds 1 ; "
                        "render drop --marker=thesis.tex\n");
    refuses("report trials.csv --out page", 1,
            "trials.csv:2: column render: expected calls that write no file", 2);
}

TEST_F(StrangersCall, NoLinkLeadsOutOfTheFolder) {
    const std::string scene = call("study show patterns").out; // any file of somebody's own
    fs::create_directories(folder_ / "theirs");
    write("secret.json", scene);
    fs::create_symlink(folder_ / "secret.json", folder_ / "theirs/scene.json");
    fs::create_symlink("..", folder_ / "theirs/up");
    const std::string here = "cd theirs && '" PHYSVIB_PROGRAM "' ";
    const auto refusesThere = [&](const std::string& arguments) {
        const int status = std::system(("cd '" + (folder_ / "theirs").string() +
                                        "' && '" PHYSVIB_PROGRAM "' " + arguments + " >../.out 2>../.err")
                                           .c_str());
        EXPECT_EQ(WEXITSTATUS(status), 1) << arguments;
        EXPECT_NE(read(".err").find("a link that leads elsewhere"), std::string::npos)
            << arguments << "\nsaid: " << read(".err");
        EXPECT_EQ(read(".err").find("physvib_protocol"), std::string::npos) << "and nothing of what is there";
    };
    for (const std::string path : {"scene.json", "up/secret.json"}) {
        writeProtocol("render " + path + " --set a={a}{b}");
        fs::rename(folder_ / "p.json", folder_ / "theirs/p.json");
        refusesThere("study run p.json --observer simulated --out rows");
        write("theirs/q.json",
              R"({"physvib_protocol": 1, "name": "q", "conditions": [{"name": "c", "layout": ")" + path +
                  R"(", "stimuli": "grid", "columns": 2, "rows": 2}], "sessions": [{"name": "s"}]})");
        refusesThere("study run q.json --observer simulated --out rows");
    }
}

TEST_F(StrangersCall, NothingIsWrittenThroughALinkThatLeadsElsewhere) {
    fs::create_directories(folder_ / "theirs");
    const auto isMineStill = [&](const std::string& words) { EXPECT_EQ(read("thesis.tex"), mine) << words; };
    fs::create_symlink(folder_ / "thesis.tex", folder_ / "theirs/o.wav");
    const auto rendered = call("render drop --seconds 0.1 --out theirs/o.wav");
    EXPECT_EQ(rendered.exitCode, 1);
    EXPECT_EQ(rendered.err, "physvib: theirs/o.wav: cannot be written: expected a file in its own folder or "
                            "below, found a link that leads elsewhere\n");
    isMineStill("render");
    fs::create_symlink(folder_ / "new.csv", folder_ / "theirs/patterns-P01.csv"); // nothing is there yet
    const auto ran = call("study run patterns --observer simulated --out theirs");
    EXPECT_EQ(ran.exitCode, 1);
    EXPECT_EQ(ran.err, "physvib: theirs/patterns-P01.csv: cannot be written: expected a file in its own "
                       "folder or below, found a link that leads elsewhere\n");
    EXPECT_FALSE(fs::exists(folder_ / "new.csv"));
    fs::create_symlink("inner.wav", folder_ / "theirs/latest.wav");
    EXPECT_EQ(call("render drop --seconds 0.1 --out theirs/latest.wav").exitCode, 0)
        << "within it, they are followed";
}

} // namespace
} // namespace physvib
