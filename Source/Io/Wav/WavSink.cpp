// SPDX-License-Identifier: MIT
// Samples first, behind the place of their head, which is as long for RIFF as for RF64.
#include "Io/Wav/WavSink.h"
#include "Io/Text/CleanText.h"
#include <bit>
#include <cstring>
#include <utility>

namespace physvib {
namespace {

static_assert(std::endian::native == std::endian::little, "samples are written as they are");

constexpr std::size_t bufferBytes = 1 << 18; // a quarter of a megabyte per system call
constexpr std::int64_t rf64Bytes = std::int64_t{1} << 32, headBytes = 104; // without the comment

void add(std::string& bytes, std::int64_t value, int width) {
    for (int i = 0; i < width; ++i) bytes += static_cast<char>(value >> (8 * i) & 255);
}

std::string chunk(const std::string& name, std::string content) {
    std::string bytes = name;
    content.append(content.size() & 1, '\0');
    add(bytes, std::ssize(content), 4);
    return bytes + content;
}

std::string formatChunk(int channels, int sampleRateHz, bool isExtensible) {
    constexpr char floatFormat[] = "\x03\0\0\0\0\0\x10\0\x80\0\0\xaa\0\x38\x9b\x71";
    const std::int64_t frameBytes = channels * 4;
    std::string content;
    add(content, isExtensible ? 0xfffe : 3, 2);
    add(content, channels, 2);
    add(content, sampleRateHz, 4);
    add(content, sampleRateHz * frameBytes, 4);
    add(content, frameBytes, 2);
    add(content, 32, 2);
    if (isExtensible) {
        add(content, 22, 2); // bytes that follow
        add(content, 32, 2); // valid bits
        add(content, 0, 4);  // no speakers
        content.append(floatFormat, 16);
    }
    return chunk("fmt ", content);
}

} // namespace

WavSink::WavSink(const std::filesystem::path& path, int channels, int sampleRateHz,
                 const std::string& comment)
    : file_{path}
    , channels_{channels}
    , sampleRateHz_{sampleRateHz} {
    setComment(comment);
}

void WavSink::setComment(const std::string& comment) {
    info_.clear();
    if (comment.empty()) return;
    std::string sampler(60, '\0'); // middle C and no loops: files with a comment have said so since JUCE
                                   // wrote them, and keep their bytes
    sampler[12] = 60;
    info_ =
        chunk("smpl", std::move(sampler)) + chunk("LIST", "INFO" + chunk("ICMT", cleanLine(comment) + '\0'));
}

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
    file_.writeAt(headBytes + std::ssize(info_) + dataBytes_, waiting_);
    dataBytes_ += std::ssize(waiting_);
    waiting_.clear();
}

const std::string& WavSink::complete() {
    if (std::exchange(isComplete_, true)) return error();
    empty();
    file_.writeAt(0, head());
    return error();
}

/// A chunk that counts in 64 bits comes first, or its room. A plain format is shorter: there is more room
/// then.
std::string WavSink::head() const {
    const bool isLong = dataBytes_ >= rf64Bytes, isExtensible = isLong || channels_ > 2;
    const std::int64_t riffBytes = headBytes - 8 + std::ssize(info_) + dataBytes_;
    std::string counts;
    if (isLong) {
        add(counts, riffBytes, 8);
        add(counts, dataBytes_, 8);
    }
    counts.resize(isExtensible ? 28 : 52);
    std::string bytes = isLong ? "RF64" : "RIFF";
    add(bytes, isLong ? -1 : riffBytes, 4);
    bytes += "WAVE" + chunk(isLong ? "ds64" : "JUNK", counts) +
             formatChunk(channels_, sampleRateHz_, isExtensible) + info_ + "data";
    add(bytes, isLong ? -1 : dataBytes_, 4);
    return bytes;
}

} // namespace physvib
