// SPDX-License-Identifier: GPL-3.0-or-later
// Files that were made to do harm: refused in one clean line, in little memory, and at once.
#include "CommandLine/Calls.h"
#include "Io/Text/CleanText.h"
#include "Support/WavBytes.h"
#include <algorithm>
#include <cmath>
#include <sys/stat.h>

namespace physvib {
namespace {

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
        EXPECT_NE(outcome.err.find(words), std::string::npos) << arguments << "\nsaid: " << outcome.err;
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
    const Outcome piped = call("material piped.wav", little);
    EXPECT_EQ(piped.exitCode, 0) << piped.err;
    EXPECT_EQ(piped.out, call("material whole.wav").out);
    EXPECT_EQ(call("material whole.wav <&-").out, piped.out)
        << "without a standard input, its descriptor is the file's";
}

TEST_F(HostileFiles, NamesAreToldInCleanWords) {
    refusesInLittle(R"sh(material "$(printf 'no\377\033[2J\n.wav')")sh",
                    "no\\xff\\x1b[2J\\x0a.wav: cannot be read", 0);
    EXPECT_EQ(call(R"sh(render drop --seconds 0.1 --out "$(printf 'x\303.wav')")sh").exitCode, 0)
        << "but any name will do";
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
    write("far.csv", "time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m\n0.01,100,50,0.5,1e9,-1e300\n");
    const Outcome outcome = call("render --from-events far.csv --seconds 0.1 --picture p.png");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
}

} // namespace
} // namespace physvib
