// SPDX-License-Identifier: GPL-3.0-or-later
// Files that were made to do harm: refused in one clean line, in little memory, and at once.
#include "CommandLine/Calls.h"
#include "Io/Text/CleanText.h"
#include "Support/WavBytes.h"
#include <algorithm>
#include <cmath>
#include <sys/stat.h>

namespace physvib::hostile_files_test {

using namespace test;

#if defined(PHYSVIB_SANITIZED)
constexpr const char* little = ""; // a sanitizer takes memory of its own
#else
constexpr const char* little = "ulimit -d 300000; "; // kB
#endif

class HostileFiles : public CommandLine {
protected:
    /// Refuses in little memory, with exit code 1 and words that are fit for a terminal.
    void refusesInLittle(const std::string& arguments, const std::string& words, std::size_t kept) const {
        const Outcome outcome = call(arguments, little);
        EXPECT_EQ(outcome.exitCode, 1) << arguments << "\nsaid: " << outcome.err;
        EXPECT_TRUE(has(outcome.err, words)) << arguments;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_EQ(cleanLine(outcome.err), outcome.err.substr(0, outcome.err.size() - 1) + "\\x0a");
        EXPECT_EQ(files().size(), kept) << arguments;
    }
    /// The same wherever a recording is read.
    void refusesRecording(const std::string& file, const std::string& words, std::size_t kept) const {
        for (const std::string before :
             {"material ", "attenuation ", "stimulus wav --at 0.5,0.5 --out o.wav ",
              "render drop --method SV --seconds 0.1 --out o.wav --sound 80="})
            refusesInLittle(before + file + (before.starts_with("att") ? " " + file : ""), words, kept);
    }
};

TEST_F(HostileFiles, ARecordingIsARegularFile) {
    mkdir((folder_ / "folder.wav").c_str(), 0700);
    ASSERT_EQ(mkfifo((folder_ / "pipe.wav").c_str(), 0600), 0);
    for (const std::string file : {"folder.wav", "pipe.wav", "/dev/zero"})
        refusesRecording(
            file, file + ": cannot be read: expected a regular file, found a folder, a device or a pipe", 2);
}

TEST_F(HostileFiles, HeadersOfRecordingsAreNotBelieved) {
    write("long.wav", wavBytes({.channels = 8, .dataBytes = 590u * 48000 * 16}, std::string(2000, '\1')));
    refusesRecording(
        "long.wav",
        "long.wav: expected 453120000 bytes of samples, as its header says, found 2000: it ends early", 1);
    write("fast.wav", wavBytes({.rateHz = 1'000'000'000}, std::string(2000, '\1')));
    refusesRecording("fast.wav", "fast.wav: expected a rate of 100 to 768000 Hz, found 1000000000 Hz", 2);
    write("empty.wav", wavBytes({}, std::string(2000, '\1')));
    std::filesystem::resize_file(folder_ / "empty.wav", 1'500'000'000);
    refusesRecording("empty.wav", "empty.wav: expected at most 256000000 bytes, found more", 3);
}

TEST_F(HostileFiles, ALengthThatWasNotKnownIsWhatIsThere) {
    std::string samples;
    for (int n = 0; n < 24'000; ++n) {
        const int value =
            n < 4800 ? 0 : static_cast<int>(20'000 * std::sin(0.03 * n) * std::exp(-0.002 * (n - 4800)));
        samples.append({static_cast<char>(value & 255), static_cast<char>(value >> 8 & 255)});
    }
    write("piped.wav", wavBytes({.dataBytes = 0xffffffff}, samples));
    write("whole.wav", wavBytes({}, samples));
    const Outcome piped = runs("material piped.wav", little);
    EXPECT_EQ(piped.out, call("material whole.wav").out);
    EXPECT_EQ(call("material whole.wav <&-").out, piped.out)
        << "without a standard input, its descriptor is the file's";
}

TEST_F(HostileFiles, NamesAreToldInCleanWords) {
    refusesInLittle(R"sh(material "$(printf 'no\377\033[2J\n.wav')")sh",
                    "no\\xff\\x1b[2J\\x0a.wav: cannot be read", 0);
    runs(R"sh(render drop --seconds 0.1 --out "$(printf 'x\303.wav')")sh"); // but any name will do
    write("scene.json", "{\"physvib_scene\": 1, \"name\": \"\xff\x1b[2J\"}");
    refusesInLittle("render scene.json --out o.wav", "scene.json: line 1, column", 2);
}

TEST_F(HostileFiles, TablesAreBoundedWhileTheyAreRead) {
    std::string text = "stimulus,response";
    for (int c = 2; c < 256; ++c) text += ",c" + std::to_string(c);
    text += '\n';
    for (int r = 0; r < 150'000; ++r) text.append(255, ',').append("\n");
    write("cells.csv", text);
    refusesInLittle("analyse confusion cells.csv", "cells.csv:11720: expected at most 3000000 cells in all",
                    1);
}

TEST_F(HostileFiles, AnEventListIsNotHeldBeforeItIsRefused) {
    write("events.csv", "");
    std::filesystem::resize_file(folder_ / "events.csv", 1'999'999'999);
    refusesInLittle("render --from-events events.csv --out o.wav",
                    "events.csv:1: expected lines of at most 1000000 bytes", 1);
}

TEST_F(HostileFiles, SessionsAreBoundedWhileTheyAreRead) {
    std::string text = "{\"physvib_session\": 1, \"takes\": [[]";
    for (int i = 0; i < 20'000'000; ++i) text += ",[]";
    write("lists.json", text + "]}");
    refusesInLittle("render lists.json --out o.wav",
                    "lists.json: expected at most 8500004 values and fields in so many bytes, found more", 1);
}

TEST_F(HostileFiles, AWorldThatNeverEndsIsGivenUp) {
    std::string bodies;
    for (int i = 0; i < 2000; ++i)
        bodies +=
            (i > 0 ? "," : "") + std::string(R"({"name":"b)") + std::to_string(i) +
            R"(","position_m":[2,1],"fixtures":[{"shape":"circle","radius_m":0.2,"material":"wood","camera":true}]})";
    write(
        "heap.json",
        R"({"physvib_scene":1,"name":"heap","field_m":[4,2],"materials":[{"name":"wood","density_kg_per_m2":850,"friction":0.4,"restitution":0.6,"frequency_hz":80,"decay_per_s":30}],"bodies":[)" +
            bodies + "]}");
    refusesInLittle("render heap.json --seconds 100 --patience 0 --out o.wav",
                    "heap.json: expected a world that is simulated as fast as it lasts, found 0", 1);
}

TEST_F(HostileFiles, ACallOfAProtocolRendersOrIsRefused) {
    const auto protocol = [this](const std::string& call) {
        write(
            "p.json",
            R"({"physvib_protocol":1,"name":"p","conditions":[{"name":"c","stimuli":"calls","factors":[{"name":"a","values":["1"]}],"call":")" +
                call + R"("}],"sessions":[{"name":"s"}]})");
    };
    protocol("frobnicate {a}; touch x");
    refusesInLittle("study run p.json --observer simulated",
                    "p.json: conditions[0].call: expected render or stimulus, and what they take", 1);
    protocol("render drop --frobnicate {a}");
    refusesInLittle("study run p.json --observer simulated",
                    "p.json: condition c: call: render drop --frobnicate 1: ", 1);
}

TEST_F(HostileFiles, AnEventBeyondAllPicturesIsNotDrawn) {
    writeHits("far.csv", "0.01,100,50,0.5,1e9,-1e300\n");
    runs("render --from-events far.csv --seconds 0.1 --picture p.png");
}

// Protocols and trial files of others: none of their calls writes a file, whatever option it takes,
// and no link leads them out of their folder.

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
        EXPECT_TRUE(has(read(".err"), "a link that leads elsewhere")) << arguments;
        EXPECT_FALSE(has(read(".err"), "physvib_protocol")) << "and nothing of what is there";
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
    runs("render drop --seconds 0.1 --out theirs/latest.wav"); // within it, they are followed
}

} // namespace physvib::hostile_files_test
