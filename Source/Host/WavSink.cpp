// SPDX-License-Identifier: GPL-3.0-or-later
// JUCE's WAV writer with the extensible header it leaves out and the write errors it swallows.
#include "Host/WavSink.h"
#include <filesystem>
#include <juce_audio_formats/juce_audio_formats.h>

namespace physvib {
namespace {

constexpr size_t bufferBytes = 1 << 18;  // a quarter of a megabyte per system call
constexpr std::int64_t junkChunkAt = 12; // behind RIFF, size and WAVE
constexpr std::int64_t rf64Bytes = std::int64_t{1} << 32;

// JUCE's writer deletes its stream, and with it the news of a failed last write.
struct BorrowedStream final : juce::OutputStream {
    explicit BorrowedStream(juce::OutputStream& s)
        : stream(s) {}
    void flush() override {} // would be an fsync; finish() says when it is time
    bool setPosition(juce::int64 position) override { return stream.setPosition(position); }
    juce::int64 getPosition() override { return stream.getPosition(); }
    bool write(const void* data, size_t bytes) override { return stream.write(data, bytes); }
    juce::OutputStream& stream;
};

void emptyRegularFile(const std::string& path) {
    std::error_code ignored; // opening will tell
    if (std::filesystem::is_regular_file(path, ignored)) std::filesystem::resize_file(path, 0, ignored);
}

juce::StringPairArray infoChunk(const std::string& comment) {
    juce::StringPairArray info;
    if (!comment.empty())
        info.set(juce::WavAudioFormat::riffInfoComment2, juce::String::fromUTF8(comment.c_str()));
    return info;
}

} // namespace

WavSink::WavSink(const std::string& path, int channels, int sampleRateHz, const std::string& comment,
                 const std::string& name)
    : path_(path)
    , name_(name.empty() ? path : name)
    , channels_(channels)
    , sampleRateHz_(sampleRateHz) {
    emptyRegularFile(path);
    const auto place =
        juce::File::getCurrentWorkingDirectory().getChildFile(juce::String::fromUTF8(path.c_str()));
    file_ = std::make_unique<juce::FileOutputStream>(place, bufferBytes);
    file_->setPosition(0);
    auto stream = std::make_unique<BorrowedStream>(*file_);
    writer_.reset(juce::WavAudioFormat().createWriterFor(stream.get(), sampleRateHz,
                                                         juce::AudioChannelSet::discreteChannels(channels),
                                                         32, infoChunk(comment), 0));
    if (writer_ != nullptr) stream.release(); // now the writer's
    headerBytes_ = file_->getPosition();
    if (file_->failedToOpen() || writer_ == nullptr) noteError();
}

WavSink::~WavSink() = default;

bool WavSink::write(const float* const* channels, int frames) {
    if (!error_.empty() || writer_ == nullptr) return false;
    if (frames <= 0) return true;
    if (!writer_->writeFromFloatArrays(channels, channels_, frames)) noteError();
    dataBytes_ += std::int64_t{frames} * channels_ * 4;
    return error_.empty();
}

std::string WavSink::finish() {
    if (file_ == nullptr) return error_;
    writer_.reset(); // its destructor writes the sizes into the header
    if (error_.empty() && channels_ > 2 && dataBytes_ < rf64Bytes) writeExtensibleHeader();
    file_->setPosition(file_->getPosition() == 0 ? 1 : 0); // empties the buffer without waiting for the disk
    if (file_->getStatus().failed()) noteError();
    std::error_code failed;
    const bool regular = std::filesystem::is_regular_file(path_, failed);
    const auto arrived = static_cast<std::int64_t>(regular ? std::filesystem::file_size(path_, failed) : 0);
    if (regular && arrived != headerBytes_ + dataBytes_) noteError(); // a short write is no error to JUCE
    file_.reset();
    return error_;
}

// JUCE writes the extensible form for speaker layouts and RF64 only. Its JUNK chunk (kept for RF64) is 24
// bytes longer before a plain format chunk, so the extensible pair fits into the same 84 bytes.
void WavSink::writeExtensibleHeader() {
    constexpr juce::uint8 floatFormat[] = {3, 0, 0, 0, 0, 0, 0x10, 0, 0x80, 0, 0, 0xaa, 0, 0x38, 0x9b, 0x71};
    const int frameBytes = channels_ * 4;
    file_->setPosition(junkChunkAt);
    file_->write("JUNK", 4);
    file_->writeInt(28);
    file_->writeRepeatedByte(0, 28);
    file_->write("fmt ", 4);
    file_->writeInt(40);
    file_->writeShort(static_cast<short>(0xfffe));
    file_->writeShort(static_cast<short>(channels_));
    file_->writeInt(sampleRateHz_);
    file_->writeInt(sampleRateHz_ * frameBytes);
    file_->writeShort(static_cast<short>(frameBytes));
    file_->writeShort(32);
    file_->writeShort(22); // bytes that follow
    file_->writeShort(32); // valid bits
    file_->writeInt(0);    // no speakers
    file_->write(floatFormat, sizeof(floatFormat));
}

void WavSink::noteError() {
    if (!error_.empty()) return;
    std::string reason = "not every byte was taken (disk full?)";
    if (headerBytes_ == 0)
        reason = std::to_string(channels_) + " channels at " + std::to_string(sampleRateHz_) +
                 " Hz are no WAV file";
    if (file_->getStatus().failed()) reason = file_->getStatus().getErrorMessage().toStdString();
    error_ = name_ + ": cannot be written: " + reason;
}

} // namespace physvib
