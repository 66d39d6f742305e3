// SPDX-License-Identifier: MIT
// Writes the samples first and the header, of known length, last, when their number is known.
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

void WavSink::setComment(const std::string& comment) { infoChunk_ = wavInfoChunk(comment); }

bool WavSink::write(const float* const* channels, int frames) {
    if (!error().empty() || isComplete_) return false;
    const std::size_t oldSize = buffer_.size();
    buffer_.resize(oldSize +
                   static_cast<std::size_t>(frames) * static_cast<std::size_t>(channels_) * sizeof(float));
    char* next = buffer_.data() + oldSize;
    for (int n = 0; n < frames; ++n)
        for (int j = 0; j < channels_; ++j, next += sizeof(float))
            std::memcpy(next, channels[j] + n, sizeof(float));
    if (buffer_.size() >= bufferBytes) flushBuffer();
    return error().empty();
}

void WavSink::flushBuffer() {
    if (file_.writeAt(wavHeaderBytes + std::ssize(infoChunk_) + dataBytes_, buffer_))
        dataBytes_ += std::ssize(buffer_);
    buffer_.clear();
}

// Written after the samples, so that the header never claims more than the file has.
void WavSink::writeHeader() {
    flushBuffer();
    file_.writeAt(0, wavHeader(channels_, sampleRateHz_, dataBytes_, infoChunk_));
}

const std::string& WavSink::publish() {
    if (isComplete_) return error();
    writeHeader();
    return file_.publish();
}

const std::string& WavSink::complete() {
    if (std::exchange(isComplete_, true)) return error();
    writeHeader();
    return error();
}

} // namespace physvib
