// SPDX-License-Identifier: GPL-3.0-or-later
// What every command that writes keeps to: inputs stay, one file is written once, words arrive or their loss
// is told, and an end by a signal leaves nothing half done.
#include "Calls.h"
#include "TestPlaces.h"
#include <algorithm>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <thread>

namespace physvib::outputs_test {

using namespace std::chrono_literals;

class Outputs : public test::CommandLine {
protected:
    const std::string program_ = "'" PHYSVIB_PROGRAM "' ";

    void SetUp() override {
        CommandLine::SetUp();
        write("scene.json", call("scenes").exitCode == 0 ? readSource("Source/Scene/Scenes/drop.json") : "");
        runs("render drop --seconds 2 --out hit.wav --events hits.csv");
        write("trials.csv", "stimulus,response\na,a\nb,b\na,b\n");
        std::filesystem::create_symlink("scene.json", folder_ / "link.json");
        std::filesystem::create_directory(folder_ / "sub");
    }
    static std::string readSource(const std::string& path) {
        std::ifstream file{std::filesystem::path{PHYSVIB_SOURCE_DIR} / path, std::ios::binary};
        return {std::istreambuf_iterator<char>{file}, {}};
    }
    /// How a shell's line in the folder ends: an exit code, or 128 and a signal's number.
    int shell(const std::string& line) const {
        const int status =
            std::system(("cd '" + folder_.string() + "' && exec 2>.err; env -u DISPLAY " + line).c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    /// A call that goes on by itself, with standard output to .out.
    pid_t start(const std::vector<std::string>& arguments) const {
        const pid_t process = fork();
        if (process != 0) return process;
        std::vector<char*> words{const_cast<char*>(PHYSVIB_PROGRAM)};
        for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
        words.push_back(nullptr);
        for (const int standard : {STDOUT_FILENO, STDERR_FILENO})
            dup2(open((folder_ / ".out").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600), standard);
        // whoever runs the tests may ignore some
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
        if (chdir(folder_.c_str()) == 0) execv(words.front(), words.data());
        _exit(127);
    }
    static int waitFor(pid_t process) {
        int status = 0;
        waitpid(process, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    bool waitForPart() const {
        for (int i = 0; i < 1000; ++i, std::this_thread::sleep_for(10ms))
            for (const auto& name : files())
                if (name.ends_with(".part")) return true;
        return false;
    }
};

TEST_F(Outputs, NoInputIsWrittenOver) {
    const std::size_t kept = files().size();
    const std::string scene = read("scene.json"), wav = read("hit.wav"), trials = read("trials.csv");
    for (const char* spelling : {"scene.json", "./scene.json", "sub/../scene.json", "link.json"})
        refuses("render scene.json --out new.wav --events " + std::string{spelling}, 2,
                "expected another file to write, this is the input scene.json", kept);
    refuses("render --from-events hits.csv --out hits.csv", 2, "the input hits.csv", kept);
    refuses("render drop --layout layout.json --picture new.png --pattern new.png", 2, "the output new.png",
            kept);
    refuses("render drop --method SV --sound 80=hit.wav --out hit.wav", 2, "the input hit.wav", kept);
    refuses("analyse confusion trials.csv --export ./trials.csv", 2, "the input trials.csv", kept);
    refuses("stimulus wav hit.wav --out hit.wav", 2, "the input hit.wav", kept);
    refuses("stimulus pattern ABA-250 --out new.png --picture sub/../new.png", 2, "the output new.png", kept);
    refuses("calibrate --played hit.wav --recorded hit.wav --out new.json --layout scene.json "
            "--layout-out sub/../scene.json --g-per-unit 1",
            2, "the input scene.json", kept);
    refuses("play scene.json --device none --save scene.json", 2, "the input scene.json", kept);
    refuses("play drop --device none --record take.events.csv --save take.json", 2,
            "the output take.events.csv", kept);
    EXPECT_EQ(read("scene.json"), scene);
    EXPECT_EQ(read("hit.wav"), wav);
    EXPECT_EQ(read("trials.csv"), trials);
}

TEST_F(Outputs, WhatInputsNameIsNotWrittenOverEither) {
    write(
        "layout.json",
        R"({"name": "one", "extent_m": [0.1, 0.1], "enchanters": [{"label": "A", "x_m": 0.05, "y_m": 0.05, "actuator": "mine.json", "full_scale_g": 1.0}]})");
    write("mine.json", readSource("Source/Scene/Actuators/lra-205.json"));
    const std::size_t kept = files().size();
    refuses(
        "render drop --layout layout.json --actuator layout --equalise off --out new.wav --events mine.json",
        2, "the input mine.json", kept);
}

TEST_F(Outputs, WhatAFolderOfRecordingsHoldsIsNotWrittenOver) {
    std::filesystem::copy(folder_ / "hit.wav", folder_ / "sub/a.csv");
    write("sub/conditions.csv", "file,driven,frequency_hz,material,axis\na.csv,A,100,reference,x\n");
    for (const std::string words : {"attenuation sub --export ", "coupling sub --layout phone4 --out "})
        for (const std::string input : {"sub/conditions.csv", "sub/a.csv"})
            refuses(words + input, 2, "the input " + input, files().size());
}

TEST_F(Outputs, WordsThatDoNotArriveAreAFailure) {
    for (const char* words :
         {"scenes", "actuators", "study list", "study show patterns", "material --list",
          "analyse confusion trials.csv", "stimulus list", "--help", "--version", "render --help",
          "render drop --seconds 0.1 --out new.wav", "play drop --device 'None:no device' --seconds 0.1"}) {
        EXPECT_EQ(shell(program_ + words + " >/dev/full"), 1) << words;
        EXPECT_TRUE(has(read(".err"), "physvib: standard output: cannot be written")) << words;
        EXPECT_EQ(shell(program_ + words + " >&-"), 1) << words;
        EXPECT_TRUE(has(read(".err"), "physvib: standard output: cannot be written")) << words;
    }
    shell(program_ + "study show patterns >/dev/full");
    EXPECT_EQ(read(".err"), "physvib: standard output: cannot be written: No space left on device\n");
    runs("study show patterns");
}

TEST_F(Outputs, ClosedDescriptorsAreNotTakenForFiles) {
    runs("render scene.json --seconds 0.5 --out whole.wav");
    runs("material hit.wav --rule two-peaks");
    const std::string whole = read("whole.wav");
    for (const char* closed : {"<&-", "<&- >&-", "<&- 2>&-", "<&- >&- 2>&-"}) {
        std::filesystem::remove(folder_ / "new.wav");
        shell(program_ + "render scene.json --seconds 0.5 --out new.wav " + closed);
        EXPECT_EQ(read("new.wav"), whole) << closed;
        EXPECT_EQ(shell(program_ + "material hit.wav --rule two-peaks " + closed + " >/dev/null"), 0)
            << closed;
    }
}

TEST_F(Outputs, ASignalLeavesNothingBehind) {
    write("old.wav", "old");
    const auto kept = files().size();
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const pid_t process = start({"render", "scene.json", "--seconds", "86000", "--layout", "phone1",
                                     "--rate", "8000", "--out", "old.wav", "--events", "old.csv"});
        ASSERT_TRUE(waitForPart());
        kill(process, signal);
        EXPECT_EQ(waitFor(process), 128 + signal) << "as it is expected of a program that a signal ended";
        EXPECT_EQ(files().size(), kept);
        EXPECT_EQ(read("old.wav"), "old");
    }
}

TEST_F(Outputs, TwoStudiesOfOneParticipantAtOnceAreToldApart) {
    runs("study run magnitudes --observer simulated --out sub");
    const pid_t first = start({"study", "run", "magnitudes", "--observer", "simulated", "--pace", "0.02"});
    for (int i = 0; i < 1000 && read("magnitudes-P01.csv").empty(); ++i) std::this_thread::sleep_for(10ms);
    const auto second = call("study run magnitudes --observer simulated");
    kill(first, SIGTERM);
    waitFor(first);
    EXPECT_EQ(second.exitCode, 1);
    EXPECT_TRUE(has(second.err, "magnitudes-P01.csv: another program is writing it"));
    runs("study run magnitudes --observer simulated"); // what was cut off goes on
    EXPECT_EQ(read("magnitudes-P01.csv"), read("sub/magnitudes-P01.csv"));
}

TEST_F(Outputs, TwoRendersToOneFileAtOnceAreToldApart) {
    const pid_t first = start({"render", "scene.json", "--seconds", "86000", "--layout", "phone1", "--rate",
                               "8000", "--out", "long.wav"});
    ASSERT_TRUE(waitForPart());
    const auto second = call("render scene.json --seconds 0.1 --out sub/../long.wav");
    kill(first, SIGKILL);
    waitFor(first);
    EXPECT_EQ(second.exitCode, 1);
    EXPECT_TRUE(has(second.err, "long.wav: cannot be written: it is being written already"));
    runs("render scene.json --seconds 0.1 --out long.wav"); // what was killed left nothing in the way
    for (const auto& name : files()) EXPECT_FALSE(name.ends_with(".part")) << name;
}

// What a file is stands in its name: other programs, and people, go by it.
TEST_F(Outputs, APictureIsNamedAsWhatItIs) {
    const std::size_t kept = files().size();
    const auto expects = [&](const std::string& call, const std::string& option, const std::string& ending,
                             const std::string& name) {
        refuses(call + " " + option + " " + name, 2,
                option + ": expected a name that ends in " + ending + ", found \"" + name + "\"", kept);
    };
    expects("analyse confusion trials.csv", "--picture", ".svg", "x.png");
    expects("analyse psychometric trials.csv", "--picture", ".svg", "x.png");
    expects("render drop --seconds 0.2", "--picture", ".png", "x.svg");
    expects("stimulus pattern ABA-250", "--picture", ".png", "x");
    expects("attenuation sub", "--picture", ".svg", "x.jpg");
    expects("render drop --seconds 0.2", "--movie", ".webp, .gif or .mp4", "x.avi");
    expects("play drop --device none", "--save", ".json", "x.txt");
    runs("analyse confusion trials.csv --picture x.svg");
    EXPECT_EQ(read("x.svg").rfind("<svg ", 0), 0u);
}

// A file system that fills up after so many bytes of each file: the limit on a file's size behaves like that.
TEST_F(Outputs, AFullDiskIsToldAndLeavesTheOldFiles) {
    const struct {
        std::string call;
        std::vector<std::string> outputs;
    } calls[] = {
        {"render scene.json --seconds 0.2 --out o.wav --events o.csv --picture o.png --pattern p.csv",
         {"o.wav", "o.csv", "o.png", "p.csv"}},
        {"stimulus pattern ABA-250 --out o.wav --picture o.png", {"o.wav", "o.png"}},
        {"calibrate --sweep o.wav --seconds 1", {"o.wav"}},
        {"analyse confusion trials.csv --export o.csv --picture o.svg", {"o.csv", "o.svg"}}};
    for (const auto& [words, outputs] : calls) {
        runs(words);
        std::size_t most = 0;
        for (const auto& name : outputs) most = std::max(most, read(name).size()), write(name, "old");
        for (std::size_t blocks = 0; blocks * 512 < most; blocks = blocks * 2 + 1) {
            // words go through a pipe
            shell("sh -c \"(ulimit -f " + std::to_string(blocks) + "; " + program_ + words +
                  "; echo \\$?) 2>&1 | cat >.out\"");
            EXPECT_TRUE(read(".out").ends_with("cannot be written: File too large\n1\n"))
                << words << ' ' << blocks << read(".out");
            for (const auto& name : outputs) EXPECT_EQ(read(name), "old") << words << ' ' << blocks;
        }
        for (const auto& name : files()) EXPECT_FALSE(name.ends_with(".part")) << name;
    }
}

} // namespace physvib::outputs_test
