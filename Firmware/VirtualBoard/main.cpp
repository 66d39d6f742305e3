// SPDX-License-Identifier: MIT
// physvib-virtual-board: runs the firmware image in real time, with its serial line on a pseudo-terminal that
// can be unplugged (PluggableLine). Logs when it sounds (SoundLog), and can write its output as a WAV file.
#include "Peripherals.h"
#include "PseudoTerminal.h"
#include "SoundLog.h"
#include "VirtualBoard.h"
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace physvib::virtualboard {

/// Connects and disconnects the virtual board's serial port, like pulling a USB cable.
class PluggableLine {
public:
    /// Connects. `link`: a symbolic link that stays the same between connections, or empty. Throws what
    /// PseudoTerminal and std::filesystem throw.
    explicit PluggableLine(std::string link)
        : link_{std::move(link)} {
        toggle();
    }
    ~PluggableLine() {
        if (line_) disconnect();
    }
    PluggableLine(const PluggableLine&) = delete;
    PluggableLine& operator=(const PluggableLine&) = delete;

    /// Disconnects if connected, and vice versa; returns whether it is connected now.
    bool toggle() {
        if (line_)
            disconnect();
        else
            connect();
        return line_.has_value();
    }

    /// Path of the port.
    const std::string& path() const { return link_.empty() ? line_->path() : link_; }

    std::vector<std::uint8_t> read() { return line_ ? line_->read() : std::vector<std::uint8_t>{}; }
    void write(std::span<const std::uint8_t> bytes) {
        if (line_) line_->write(bytes);
    }

private:
    void connect() {
        line_.emplace();
        if (link_.empty()) return;
        std::filesystem::remove(link_);
        std::filesystem::create_symlink(line_->path(), link_);
    }
    void disconnect() {
        if (!link_.empty()) std::filesystem::remove(link_);
        line_.reset();
    }

    std::string link_;
    std::optional<PseudoTerminal> line_;
};

/// Writes the converter codes as a WAV file (8 bit, four channels), `rate` per second; false: an error.
inline bool writeWav(const std::string& path, const std::vector<Converters::Frame>& frames,
                     std::uint32_t rate) {
    std::ofstream out(path, std::ios::binary);
    const auto putInt = [&out](std::uint32_t value, int bytes) {
        for (int i = 0; i < bytes; ++i) out.put(static_cast<char>(value >> (8 * i)));
    };
    const auto size = static_cast<std::uint32_t>(frames.size() * 4);
    out << "RIFF";
    putInt(36 + size, 4);
    out << "WAVEfmt ";
    putInt(16, 4), putInt(1, 2), putInt(4, 2), putInt(rate, 4), putInt(rate * 4, 4), putInt(4, 2),
        putInt(8, 2);
    out << "data";
    putInt(size, 4);
    for (const auto& frame : frames)
        for (const std::uint8_t code : frame) out.put(static_cast<char>(code));
    out.flush();
    return out.good();
}
} // namespace physvib::virtualboard
namespace {

using namespace physvib::virtualboard;

std::atomic<bool> isInterrupted{false}, isPlugToggled{false};

struct Options {
    std::string image, wav, link, log;
    double seconds = 0; // 0: until SIGINT
    CostModel model = CostModel::optimistic;
    bool hasCrystal = true, isValid = true;
};

Options parse(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const bool hasValue = i + 1 < argc;
        if (word == "--wav" && hasValue)
            options.wav = argv[++i];
        else if (word == "--link" && hasValue)
            options.link = argv[++i];
        else if (word == "--log" && hasValue)
            options.log = argv[++i];
        else if (word == "--seconds" && hasValue)
            options.seconds = std::strtod(argv[++i], nullptr);
        else if (word == "--pessimistic")
            options.model = CostModel::pessimistic;
        else if (word == "--no-crystal")
            options.hasCrystal = false;
        else if (!word.starts_with("--") && options.image.empty())
            options.image = word;
        else
            options.isValid = false;
    }
    options.isValid = options.isValid && !options.image.empty();
    return options;
}

void runLive(VirtualBoard& board, PluggableLine& line, SoundLog& log, double seconds) {
    const auto start = std::chrono::steady_clock::now();
    log.begin(start);
    while (!isInterrupted && (seconds <= 0 || board.seconds() < seconds)) {
        // Bytes are timed by when they are read. If the emulation paused for lack of processor time, they are
        // not sent into the past, so the board's clock stays steady.
        const auto bytes = line.read();
        const double nowSeconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (isPlugToggled.exchange(false)) log.write(line.toggle() ? "plugged" : "unplugged", nowSeconds);
        board.send(bytes, nowSeconds);
        board.runUntil(nowSeconds);
        log.writeFrames(board.peripherals());
        std::vector<std::uint8_t> answer;
        for (const auto& byte : board.received()) answer.push_back(byte.value);
        if (!answer.empty()) line.write(answer);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

void report(VirtualBoard& board) {
    const auto& times = board.peripherals().converters.observedTimes();
    const double load =
        100.0 - 100.0 * static_cast<double>(board.idleCycles()) / static_cast<double>(board.cycle());
    std::cerr << board.seconds() << " s, " << board.peripherals().frames.size() << " frames, load " << load
              << " %, " << times.writes << " writes to the converters (shortest pulse " << times.writePulse
              << " ns, set-up " << times.selectSetUp << " ns), " << times.violations
              << " against their times, " << board.peripherals().timerOverruns << " samples missed, "
              << board.resets() << " restarts, " << board.faults() << " faults\n";
}

} // namespace

int main(int argc, char** argv) {
    const Options options = parse(argc, argv);
    if (!options.isValid) {
        std::cerr << "usage: physvib-virtual-board IMAGE.elf [--seconds S] [--wav CONVERTERS.wav] [--link "
                     "PORT] [--log SOUND.csv] [--pessimistic] [--no-crystal]\n"
                     "SIGUSR1 pulls the plug of its serial line, and puts it back\n";
        return 2;
    }
    try {
        VirtualBoard board(readElf(options.image), options.model, options.hasCrystal);
        PluggableLine line{options.link};
        SoundLog log{options.log};
        std::signal(SIGINT, [](int) { isInterrupted = true; });
        std::signal(SIGTERM, [](int) { isInterrupted = true; });
        std::signal(SIGUSR1, [](int) { isPlugToggled = true; });
        std::cout << line.path() << std::endl; // port to connect to; scripts wait for this line
        runLive(board, line, log, options.seconds);
        report(board);
        if (!options.wav.empty() && !writeWav(options.wav, board.peripherals().frames, 8000))
            throw std::runtime_error(options.wav + ": cannot be written");
    } catch (const std::exception& e) {
        std::cerr << "physvib-virtual-board: " << e.what() << '\n';
        return 1;
    }
    return 0;
}
