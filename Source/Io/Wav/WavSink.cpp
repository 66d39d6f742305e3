// SPDX-License-Identifier: MIT
// Writes the samples first, and the header before them at the end; it has equal length for RIFF and RF64.
#include "Io/Wav/WavSink.h"
#include <bit>
#include <cstring>
#include <utility>

namespace physvib {
namespace {

static_assert(std::endian::native == std::endian::little, "samples are written as they are");

constexpr std::size_t bufferBytes = 1 << 18; // a quarter of a megabyte per system call

} // namespace

WavSink::WavSink(const std::filesystem::path& path, int channels, int sampleRateHz,
                 const std::string& comment)
    : file_{path}
    , channels_{channels}
    , sampleRateHz_{sampleRateHz} {
    setComment(comment);
}

void WavSink::setComment(const std::string& comment) { info_ = wavInfo(comment); }

bool WavSink::write(const float* const* channels, int frames) {
    if (!error().empty() || isComplete_) return false;
    const std::size_t before = waiting_.size();
    waiting_.resize(before +
                    static_cast<std::size_t>(frames) * static_cast<std::size_t>(channels_) * sizeof(float));
    char* to = waiting_.data() + before;
    for (int n = 0; n < frames; ++n)
        for (int j = 0; j < channels_; ++j, to += sizeof(float))
            std::memcpy(to, channels[j] + n, sizeof(float));
    if (waiting_.size() >= bufferBytes) empty();
    return error().empty();
}

void WavSink::empty() {
    if (file_.writeAt(wavHeadBytes + std::ssize(info_) + dataBytes_, waiting_))
        dataBytes_ += std::ssize(waiting_);
    waiting_.clear();
}

// After the samples, so that it never claims more than was written.
void WavSink::writeHead() {
    empty();
    file_.writeAt(0, wavHead(channels_, sampleRateHz_, dataBytes_, info_));
}

const std::string& WavSink::show() {
    if (isComplete_) return error();
    writeHead();
    return file_.show();
}

const std::string& WavSink::complete() {
    if (std::exchange(isComplete_, true)) return error();
    writeHead();
    return error();
}

} // namespace physvib
