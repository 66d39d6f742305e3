// SPDX-License-Identifier: GPL-3.0-or-later
// Stream buffers for std::cout and std::cerr that pass on complete lines.
#include "System/StandardStreams.h"
#include "System/OutputWriter.h"
#include <array>
#include <cstdio>
#include <iostream>
#include <memory>
#include <streambuf>
#include <utility>

namespace physvib {
namespace {

/// Collects the text of each thread until its line is complete.
class LineBuffer final : public std::streambuf {
public:
    LineBuffer(OutputWriter& writer, Standard standard)
        : writer_{writer}
        , standard_{standard} {}

private:
    static std::string& begunOn(Standard standard) {
        thread_local std::array<std::string, 2> begun;
        return begun[standard == Standard::error];
    }
    std::streamsize xsputn(const char* text, std::streamsize size) override {
        std::string& begun = begunOn(standard_);
        begun.append(text, static_cast<std::size_t>(size));
        for (auto end = begun.find('\n'); end != std::string::npos; end = begun.find('\n')) {
            writer_.say(standard_, begun.substr(0, end + 1));
            begun.erase(0, end + 1);
        }
        return size;
    }
    int overflow(int c) override {
        const char one = static_cast<char>(c);
        if (c != EOF) xsputn(&one, 1);
        return c == EOF ? 0 : c;
    }
    int sync() override {
        if (std::string& begun = begunOn(standard_); !begun.empty())
            writer_.say(standard_, std::exchange(begun, {}));
        return 0;
    }

    OutputWriter& writer_;
    const Standard standard_;
};

class ErrorVoice {
public:
    ErrorVoice() {
        std::cout.flush();
        out_ = std::cout.rdbuf(&outLines_);
        error_ = std::cerr.rdbuf(&errorLines_);
        std::cerr << std::nounitbuf;
    }
    ~ErrorVoice() {
        std::cout.flush();
        std::cerr.flush();
        std::cout.rdbuf(out_);
        std::cerr.rdbuf(error_);
        std::cerr << std::unitbuf;
        writer.finish(Standard::error);
    }
    OutputWriter writer;

private:
    LineBuffer outLines_{writer, Standard::output}, errorLines_{writer, Standard::error};
    std::streambuf *out_ = nullptr, *error_ = nullptr;
};

std::unique_ptr<ErrorVoice> voice; // changed by the message thread only, while no other thread prints

} // namespace

void sayWithoutWaiting() {
    if (!voice) voice = std::make_unique<ErrorVoice>();
}

std::uint64_t droppedLines(Standard standard) { return voice ? voice->writer.dropped(standard) : 0; }

std::optional<std::string> finishOutput() {
    return voice ? std::optional{voice->writer.finish(Standard::output)} : std::nullopt;
}

void endOutput() { voice.reset(); }

} // namespace physvib
