// SPDX-License-Identifier: MIT
// physvib-virtual-board: runs the firmware image in real time, with its serial line on a pseudo-terminal that
// can be unplugged. Logs when it sounds, and writes its output as a WAV file.
#include "Peripherals.h"
#include "PseudoTerminal.h"
#include "VirtualBoard.h"
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
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
class Plug {
public:
    /// Connects. `link`: a symbolic link that stays the same between connections, or empty. Throws what
    /// PseudoTerminal and std::filesystem throw.
    explicit Plug(std::string link)
        : link_{std::move(link)} {
        move();
    }
    ~Plug() {
        if (line_) pull();
    }
    Plug(const Plug&) = delete;
    Plug& operator=(const Plug&) = delete;

    /// Disconnects if connected, and vice versa; returns whether it is connected now.
    bool move() {
        if (line_)
            pull();
        else
            putIn();
        return line_.has_value();
    }

    /// Path of the port.
    const std::string& path() const { return link_.empty() ? line_->path() : link_; }

    std::vector<std::uint8_t> read() { return line_ ? line_->read() : std::vector<std::uint8_t>{}; }
    void write(std::span<const std::uint8_t> bytes) {
        if (line_) line_->write(bytes);
    }

private:
    void putIn() {
        line_.emplace();
        if (link_.empty()) return;
        std::filesystem::remove(link_);
        std::filesystem::create_symlink(line_->path(), link_);
    }
    void pull() {
        if (!link_.empty()) std::filesystem::remove(link_);
        line_.reset();
    }

    std::string link_;
    std::optional<PseudoTerminal> line_;
};

/// Logs when the converters leave and reach silence (20 ms), and notes, as a CSV file of `steady_ns,what`.
/// Other programs share the steady clock, so the log can be compared with devices that play beside the board.
class SoundLog {
public:
    /// With an empty path nothing is written. Throws std::runtime_error.
    explicit SoundLog(const std::string& path) {
        if (path.empty()) return;
        file_.open(path);
        if (!file_) throw std::runtime_error(path + ": cannot be written");
        file_ << "steady_ns,what" << std::endl;
    }

    /// Sets the time 0 of the board.
    void begin(std::chrono::steady_clock::time_point at) { began_ = at; }

    void note(const char* what, double seconds) {
        const auto at = began_.time_since_epoch() + std::chrono::nanoseconds(std::llround(seconds * 1e9));
        if (file_.is_open())
            file_ << std::chrono::duration_cast<std::chrono::nanoseconds>(at).count() << ',' << what
                  << std::endl;
    }

    /// Evaluates the frames since the last call.
    void follow(const Peripherals& io) {
        for (; seen_ < io.frames.size(); ++seen_) {
            const bool isSilent =
                std::ranges::all_of(io.frames[seen_], [](int code) { return code == midScale; });
            if (!isSilent && silent_ >= pause) note("sound", secondsOf(io, seen_));
            silent_ = isSilent ? silent_ + 1 : 0;
            if (silent_ == pause) note("silence", secondsOf(io, seen_ + 1 - pause));
        }
    }

private:
    static constexpr std::size_t pause = 160; // frames
    static constexpr int midScale = 128;
    static double secondsOf(const Peripherals& io, std::size_t frame) {
        return static_cast<double>(io.frameCycles[frame]) / io.hz();
    }

    std::ofstream file_;
    std::chrono::steady_clock::time_point began_;
    std::size_t seen_ = 0, silent_ = pause;
};

// Writes the converter codes as a WAV file: 8 bit, four channels, one sample per frame.

/// False if the file cannot be written. `rate`: frames per second.
inline bool writeWav(const std::string& path, const std::vector<Converters::Frame>& frames,
                     std::uint32_t rate) {
    std::ofstream out(path, std::ios::binary);
    const auto number = [&out](std::uint32_t value, int bytes) {
        for (int i = 0; i < bytes; ++i) out.put(static_cast<char>(value >> (8 * i)));
    };
    const auto size = static_cast<std::uint32_t>(frames.size() * 4);
    out << "RIFF";
    number(36 + size, 4);
    out << "WAVEfmt ";
    number(16, 4), number(1, 2), number(4, 2), number(rate, 4), number(rate * 4, 4), number(4, 2),
        number(8, 2);
    out << "data";
    number(size, 4);
    for (const auto& frame : frames)
        for (const std::uint8_t code : frame) out.put(static_cast<char>(code));
    out.flush();
    return out.good();
}
} // namespace physvib::virtualboard
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
