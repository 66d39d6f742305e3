// SPDX-License-Identifier: MIT
// physvib-virtual-board: runs the firmware image in real time, with its serial line on a pseudo-terminal.
#include "Plug.h"
#include "SoundLog.h"
#include "VirtualBoard.h"
#include "WavFile.h"
#include <atomic>
#include <chrono>
#include <csignal>
#include <iostream>
#include <string>
#include <thread>

namespace {

using namespace physvib::virtualboard;

std::atomic<bool> interrupted{false}, plugMoved{false};

struct Options {
    std::string image, wav, link, log;
    double seconds = 0; // 0: until interrupted
    CostModel model = CostModel::optimistic;
    bool hasCrystal = true, isValid = true;
};

Options parse(int argc, char** argv) {
    Options o;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const bool hasValue = i + 1 < argc;
        if (word == "--wav" && hasValue)
            o.wav = argv[++i];
        else if (word == "--link" && hasValue)
            o.link = argv[++i];
        else if (word == "--log" && hasValue)
            o.log = argv[++i];
        else if (word == "--seconds" && hasValue)
            o.seconds = std::strtod(argv[++i], nullptr);
        else if (word == "--pessimistic")
            o.model = CostModel::pessimistic;
        else if (word == "--no-crystal")
            o.hasCrystal = false;
        else if (!word.starts_with("--") && o.image.empty())
            o.image = word;
        else
            o.isValid = false;
    }
    o.isValid = o.isValid && !o.image.empty();
    return o;
}

void runLive(VirtualBoard& board, Plug& plug, SoundLog& log, double seconds) {
    const auto began = std::chrono::steady_clock::now();
    log.begin(began);
    while (!interrupted && (seconds <= 0 || board.seconds() < seconds)) {
        // Bytes are timed by when they are read. If the emulation paused for lack of processor time, they are
        // not sent into the past, so the board's clock stays steady.
        const auto bytes = plug.read();
        const double now = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
        if (plugMoved.exchange(false)) log.note(plug.move() ? "plugged" : "unplugged", now);
        board.send(bytes, now);
        board.runUntil(now);
        log.follow(board.io());
        std::vector<std::uint8_t> answer;
        for (const auto& byte : board.received()) answer.push_back(byte.value);
        if (!answer.empty()) plug.write(answer);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

void report(VirtualBoard& board) {
    const auto& t = board.io().converters.timings();
    const double load =
        100.0 - 100.0 * static_cast<double>(board.idleCycles()) / static_cast<double>(board.cycle());
    std::cerr << board.seconds() << " s, " << board.io().frames.size() << " frames, load " << load << " %, "
              << t.writes << " writes to the converters (shortest pulse " << t.writePulse << " ns, set-up "
              << t.selectSetUp << " ns), " << t.violations << " against their times, "
              << board.io().timerOverruns << " samples missed, " << board.resets() << " restarts, "
              << board.faults() << " faults\n";
}

} // namespace

int main(int argc, char** argv) {
    const Options o = parse(argc, argv);
    if (!o.isValid) {
        std::cerr << "usage: physvib-virtual-board IMAGE.elf [--seconds S] [--wav CONVERTERS.wav] [--link "
                     "PORT] [--log SOUND.csv] [--pessimistic] [--no-crystal]\n"
                     "SIGUSR1 pulls the plug of its serial line, and puts it back\n";
        return 2;
    }
    try {
        VirtualBoard board(readElf(o.image), o.model, o.hasCrystal);
        Plug plug{o.link};
        SoundLog log{o.log};
        std::signal(SIGINT, [](int) { interrupted = true; });
        std::signal(SIGTERM, [](int) { interrupted = true; });
        std::signal(SIGUSR1, [](int) { plugMoved = true; });
        std::cout << plug.path() << std::endl; // port to connect to; scripts wait for this line
        runLive(board, plug, log, o.seconds);
        report(board);
        if (!o.wav.empty() && !writeWav(o.wav, board.io().frames, 8000))
            throw std::runtime_error(o.wav + ": cannot be written");
    } catch (const std::exception& e) {
        std::cerr << "physvib-virtual-board: " << e.what() << '\n';
        return 1;
    }
    return 0;
}
