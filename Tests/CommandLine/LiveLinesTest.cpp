// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib play --listen` as a script meets it: its lines are answered, and whether somebody reads the
// answers changes nothing that is felt.
#include "Calls.h"
#include "CommandLine/Play/InputListener.h"
#include <array>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <functional>
#include <gtest/gtest.h>
#include <poll.h>
#include <thread>
#include <vector>

namespace physvib::live_lines_test {

using namespace std::chrono_literals;

/// A player of a scene where nothing happens, on no device, with pipes for its three streams.
class LiveLines : public test::CommandLine {
protected:
    enum : std::size_t { in, out, err };

    void SetUp() override {
        CommandLine::SetUp();
        std::signal(SIGPIPE, SIG_IGN);
        for (auto& pair : pipes_) ASSERT_EQ(pipe2(pair.data(), O_CLOEXEC | O_NONBLOCK), 0);
    }
    void TearDown() override {
        if (player_ > 0) kill(player_, SIGKILL), waitpid(player_, nullptr, 0);
        for (auto& pair : pipes_)
            for (const int end : pair) close(end);
        CommandLine::TearDown();
    }

    void play() {
        for (auto& pair : pipes_)
            fcntl(pair[&pair == &pipes_[in] ? 0 : 1], F_SETFL, 0); // as a program finds them
        player_ = fork();
        ASSERT_GE(player_, 0);
        if (player_ > 0) return;
        for (int standard = 0; standard < 3; ++standard)
            dup2(pipes_[static_cast<std::size_t>(standard)][standard == 0 ? 0 : 1], standard);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_DFL);
        if (chdir(folder_.c_str()) == 0)
            execl(PHYSVIB_PROGRAM, PHYSVIB_PROGRAM, "play",
                  PHYSVIB_SOURCE_DIR "/Standalone/Examples/quiet.json", "--device", "None:no device",
                  "--listen", "--seconds", "600", "--save", "s.json", nullptr);
        _exit(127);
    }

    /// So that the player finds no room in it.
    void fill(std::size_t stream) {
        const std::string much(4096, '.');
        while (::write(pipes_[stream][1], much.data(), much.size()) > 0) {
        }
    }

    /// False if the player does not take it all.
    bool say(std::string_view text) {
        while (!text.empty()) {
            pollfd room{pipes_[in][1], POLLOUT, 0};
            if (poll(&room, 1, 20'000) <= 0) return false;
            const ssize_t count = ::write(room.fd, text.data(), text.size());
            if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
        }
        return true;
    }

    /// What has come on a stream so far.
    const std::string& heard(std::size_t stream) {
        char bytes[4096];
        for (ssize_t count; (count = ::read(pipes_[stream][0], bytes, sizeof bytes)) > 0;)
            heard_[stream].append(bytes, static_cast<std::size_t>(count));
        return heard_[stream];
    }
    static std::size_t count(const std::string& text, std::string_view what) {
        std::size_t found = 0;
        for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
        return found;
    }

    /// Half a minute at most.
    static bool comes(const std::function<bool()>& isTrue) {
        for (int k = 0; k < 3000; ++k, std::this_thread::sleep_for(10ms))
            if (isTrue()) return true;
        return false;
    }

    /// An exit code after SIGTERM; -1: it did not end.
    int end() {
        kill(player_, SIGTERM);
        int status = 0;
        if (!comes([&] { return waitpid(player_, &status, WNOHANG) == player_; })) return -1;
        player_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

    std::array<std::array<int, 2>, 3> pipes_{};
    std::array<std::string, 3> heard_;
    pid_t player_ = 0;
};

std::string times(int count, const std::string& line) {
    std::string all;
    for (int k = 0; k < count; ++k) all += line;
    return all;
}

TEST_F(LiveLines, AnswersThatNobodyReadsHoldUpNothing) {
    play();
    ASSERT_TRUE(say(times(20'000, "{\"message\": \"status\"}\n")));
    ASSERT_TRUE(say("{\"control\": \"gain\", \"channel\": 1, \"value\": 0.2718}\n"));
    EXPECT_TRUE(comes([this] { return read("s.json").find("0.2718") != std::string::npos; }))
        << "the line after them acts";
    EXPECT_EQ(end(), 1) << "words were lost";
    EXPECT_TRUE(has(heard(err), "physvib: standard output: cannot be written: "));
    EXPECT_TRUE(has(read("s.json"), "0.2718")) << "saved";
}

TEST_F(LiveLines, AFullStandardErrorHoldsUpNothing) {
    fill(out);
    fill(err);
    play();
    ASSERT_TRUE(
        say(times(2'000, "{\"message\": \"status\"}\n{\"message\": \"strike\", \"level\": 2}\nno line\n")));
    ASSERT_TRUE(say("{\"control\": \"gain\", \"channel\": 1, \"value\": 0.2718}\n"));
    EXPECT_TRUE(comes([this] { return read("s.json").find("0.2718") != std::string::npos; }));
    EXPECT_EQ(end(), 1);
}

TEST_F(LiveLines, WhatWasNotReadIsCountedInTheStatus) {
    play();
    ASSERT_TRUE(say(times(20'000, "{\"message\": \"layout\"}\n") +
                    "{\"control\": \"gain\", \"channel\": 1, \"value\": 0.2718}\n"));
    ASSERT_TRUE(comes([this] { return read("s.json").find("0.2718") != std::string::npos; }));
    ASSERT_TRUE(comes([this] { return heard(out).size() > 65'536; }));
    ASSERT_TRUE(say("{\"message\": \"status\", \"id\": 1}\n"));
    ASSERT_TRUE(comes([this] { return heard(out).find("\"id\": 1,") != std::string::npos; }));
    const auto read = heard(out).find("\"unread\": ");
    ASSERT_NE(read, std::string::npos);
    EXPECT_EQ(count(heard(out), "\"layout\"") + std::stoul(heard(out).substr(read + 10)), 20'000U);
}

TEST_F(LiveLines, ALineWithANumberIsAnsweredWithIt) {
    play();
    const std::pair<const char*, const char*> lines[] = {
        {R"({"message": "strike", "frequency_hz": 205, "seconds": 0.1, "id": 1})",
         R"({ "answer": "done", "id": 1 })"},
        {R"({"id": 2, "control": "gain", "channel": 1, "value": 0.5})", R"({ "answer": "done", "id": 2 })"},
        {R"({"input": "tilt", "angle_rad": 0.1, "id": 3})", R"({ "answer": "done", "id": 3 })"},
        {R"({"control": "silence", "on": true, "id": 4})", R"({ "answer": "done", "id": 4 })"},
        {R"({"message": "latency", "id": 5})", R"({ "answer": "latency", "id": 5, "play_out_s": )"},
        {R"({"message": "strike", "frequency_hz": 205, "seconds": 1, "level": 2, "id": 6})",
         R"({ "answer": "error", "id": 6, "reason": "strike: level: expected 0 to 1, found 2" })"},
        {R"({"control": "gain", "channel": 9, "value": 1, "id": -7})",
         R"({ "answer": "error", "id": -7, "reason": "channel: expected a channel from 1 to 4, found 9" })"},
        {R"({"input": "impulse", "body": "nobody", "impulse_ns": [0, 1], "id": 8})",
         R"({ "answer": "error", "id": 8, "reason": ")"},
        {R"({"message": "strike", "id": 9, "level": )", R"({ "answer": "error", "id": 9, "reason": ")"},
        {R"({"message": "leap", "id": 9007199254740991})",
         R"({ "answer": "error", "id": 9007199254740991, "reason": ")"},
        {R"({"message": "stop", "id": 11})", R"({ "answer": "done", "id": 11 })"}};
    std::string all;
    for (const auto& [line, answer] : lines) all.append(line).append("\n");
    ASSERT_TRUE(say(all));
    ASSERT_TRUE(comes([this] { return heard(out).find("\"id\": 11") != std::string::npos; }))
        << heard(out) << heard(err);
    std::size_t at = 0;
    for (const auto& [line, answer] : lines) {
        EXPECT_EQ(heard(out).find(answer, at), at) << line << '\n' << heard(out).substr(at);
        at = heard(out).find('\n', at) + 1;
    }
    EXPECT_EQ(at, heard(out).size()) << "one answer to each";
    ASSERT_TRUE(say("{\"message\": \"strike\", \"id\": 1.5}\n{\"message\": \"stop\", \"id\": "
                    "\"a\"}\n{\"message\": \"stop\", \"id\": 12}\n"));
    ASSERT_TRUE(comes([this] { return heard(out).find("\"id\": 12") != std::string::npos; }));
    EXPECT_TRUE(has(heard(err), "id: expected a whole number"));
    EXPECT_EQ(heard(out).substr(at), "{ \"answer\": \"done\", \"id\": 12 }\n")
        << "what is no number cannot be given back";
    EXPECT_EQ(end(), 0);
}

TEST_F(LiveLines, ComplaintsOfACauseAreOneASecondAndTheRestIsCounted) {
    play();
    constexpr int lines = 100'000;
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_TRUE(
        say(times(lines, "{\"message\": \"strike\", \"level\": 2}\n") + "{\"message\": \"latency\"}\n"));
    ASSERT_TRUE(comes([this] { return heard(out).find("latency") != std::string::npos; }));
    const auto most = static_cast<std::size_t>(std::chrono::duration_cast<std::chrono::seconds>(
                                                   std::chrono::steady_clock::now() - begin)
                                                   .count()) +
                      1;
    EXPECT_EQ(end(), 0);
    const std::string& told = heard(err);
    EXPECT_LE(count(told, "strike:"), most) << told;
    std::uint64_t all = count(told, "physvib: standard input:1: strike: level: expected 0 to 1, found 2\n");
    EXPECT_EQ(all, 1U) << "the first at once";
    all = count(told, "strike:");
    constexpr std::string_view before = "physvib: standard input: ";
    for (auto at = told.find(before); at != std::string::npos; at = told.find(before, at + 1))
        all += std::stoul(told.substr(at + before.size()));
    EXPECT_EQ(all, static_cast<std::uint64_t>(lines)) << told;
}

// Lines of `play --listen`, however they arrive.

const std::string markOfLong = "(too long)";

std::vector<std::string> linesOf(const std::string& text, std::size_t atOnce) {
    std::vector<std::string> lines;
    const auto take = [&](std::string_view line, bool isWhole) {
        lines.push_back(isWhole ? std::string{line} : markOfLong + std::string{line});
    };
    LineSplitter cutter;
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
                  (std::vector<std::string>{markOfLong + "silence", control}));
        EXPECT_EQ(linesOf(control + std::string(69'632, 'x') + "\n", atOnce)[0], markOfLong + "silence");
        EXPECT_EQ(linesOf(control + "\n" + std::string(200'000, 'x'), atOnce),
                  (std::vector<std::string>{control, markOfLong}));
        EXPECT_EQ(linesOf(std::string(LineSplitter::maxLineBytes, 'x') + "\n", atOnce)[0].size(),
                  LineSplitter::maxLineBytes);
    }
}

} // namespace physvib::live_lines_test
