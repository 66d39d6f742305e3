// SPDX-License-Identifier: GPL-3.0-or-later
// Calls of the `physvib` program inside a folder of the test's own, and what they left.
#pragma once
#include "Io/Disk/ReadFile.h"
#include "Support/Has.h"
#include "Support/ReadWav.h"
#include "TestPlaces.h"
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace physvib::test {

struct Outcome {
    int exitCode = -1;
    std::string out, err;
};

/// Where a help text lists subcommands, if it does; CLI11 2.6 has capitals.
inline std::size_t subcommandsIn(const std::string& help) {
    return std::min(help.find("\nSubcommands:\n"), help.find("\nSUBCOMMANDS:\n"));
}

/// What the first group of the pattern matched, each once.
inline std::set<std::string> wordsIn(const std::string& text, const char* pattern) {
    const std::regex wanted{pattern};
    std::set<std::string> words;
    for (auto at = std::sregex_iterator{text.begin(), text.end(), wanted}; at != std::sregex_iterator{}; ++at)
        words.insert(at->str(1));
    return words;
}

/// A table without the spaces that make its columns.
inline std::string squeezed(std::string text) {
    text.erase(std::unique(text.begin(), text.end(), [](char a, char b) { return a == ' ' && b == ' '; }),
               text.end());
    return text;
}

/// A fresh folder per test; paths in calls are relative to it.
class CommandLine : public ::testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (std::filesystem::temp_directory_path() / "physvib-test-XXXXXX").string();
        ASSERT_NE(mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    /// `before`: words of a shell that come first.
    Outcome call(const std::string& arguments, const std::string& before = {},
                 const char* program = PHYSVIB_PROGRAM) const {
        const std::string command = before + "cd '" + folder_.string() + "' && env -u DISPLAY '" + program +
                                    "' " + arguments + " >.out 2>.err";
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(".out"), read(".err")};
    }
    std::string read(const std::string& name) const {
        std::ifstream file{folder_ / name, std::ios::binary};
        return {std::istreambuf_iterator<char>{file}, {}};
    }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream{folder_ / name, std::ios::binary} << text;
    }

    /// A list of events, by its rows.
    void writeHits(const std::string& name, const std::string& rows) const {
        write(name, "time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m\n" + rows);
    }

    /// Names of all files but the captured output.
    std::vector<std::string> files() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator{folder_})
            if (const auto name = entry.path().filename().string(); name != ".out" && name != ".err")
                names.push_back(name);
        return names;
    }
    /// The same of a call that has to succeed.
    Outcome runs(const std::string& arguments, const std::string& before = {}) const {
        Outcome outcome = call(arguments, before);
        EXPECT_EQ(outcome.exitCode, 0) << arguments << "\nsaid: " << outcome.out << outcome.err;
        return outcome;
    }
    /// Samples of a WAV of floats, as `render` writes it, by channel.
    std::vector<std::vector<float>> channelsOf(const std::string& name) const {
        const FileHandle file{std::fopen((folder_ / name).c_str(), "rb")};
        if (!file) return {};
        const auto sound = readWav(*file);
        EXPECT_EQ(sound.error, "") << name;
        return sound.value.channels;
    }
    /// The call fails with that code, says one line that holds `words`, and leaves no file but `kept`.
    void refuses(const std::string& arguments, int exitCode, const std::string& words,
                 std::size_t kept = 0) const {
        const Outcome outcome = call(arguments);
        EXPECT_EQ(outcome.exitCode, exitCode) << arguments;
        EXPECT_NE(outcome.err.find(words), std::string::npos) << arguments << "\nsaid: " << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_EQ(files().size(), kept) << arguments;
    }

    std::filesystem::path folder_;
};

} // namespace physvib::test
