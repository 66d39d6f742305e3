// SPDX-License-Identifier: GPL-3.0-or-later
// JUCE's WAV writer with the extensible header it leaves out, into a file that is not JUCE's: that one swallows errors of
// writing, takes descriptor 0 for none, and opens by name.
#include "Host/Recordings/WavSink.h"
#include "Files/Text/CleanText.h"
#include "Files/WavHead.h"
#include <juce_audio_formats/juce_audio_formats.h>
#include <utility>

namespace physvib {
namespace {

constexpr size_t bufferBytes = 1 << 18;  // a quarter of a megabyte per system call
constexpr std::int64_t junkChunkAt = 12; // behind RIFF, size and WAVE
constexpr std::int64_t rf64Bytes = std::int64_t{1} << 32;

/// What JUCE's writer writes to; the file, which outlives it, remembers errors.
class FileStream final : public juce::OutputStream {
public:
    explicit FileStream(AtomicFile& file)
        : file_{file} {
        waiting_.reserve(bufferBytes);
    }
    ~FileStream() override { empty(); }
    void flush() override {} // the writer's wish at its end; then the buffer is emptied anyway
    juce::int64 getPosition() override { return at_ + static_cast<juce::int64>(waiting_.size()); }
    bool setPosition(juce::int64 position) override {
        empty();
        at_ = position;
        return file_.error().empty();
    }
    bool write(const void* data, size_t bytes) override {
        if (waiting_.size() + bytes > bufferBytes) empty();
        waiting_.append(static_cast<const char*>(data), bytes);
        return file_.error().empty();
    }

private:
    void empty() {
        file_.writeAt(at_, waiting_);
        at_ += static_cast<juce::int64>(waiting_.size());
        waiting_.clear();
    }

    AtomicFile& file_;
    juce::int64 at_ = 0;
    std::string waiting_;
};

juce::StringPairArray infoChunk(const std::string& comment) {
    juce::StringPairArray info;
    if (!comment.empty())
        info.set(juce::WavAudioFormat::riffInfoComment2, juce::String::fromUTF8(cleanLine(comment).c_str()));
    return info;
}

} // namespace

WavSink::WavSink(const std::filesystem::path& path, int channels, int sampleRateHz,
                 const std::string& comment)
    : file_{path}
    , channels_(channels)
    , sampleRateHz_(sampleRateHz)
    , comment_{comment} {}

void WavSink::begin() {
    if (writer_ != nullptr) return;
    auto stream = std::make_unique<FileStream>(file_);
    writer_.reset(juce::WavAudioFormat().createWriterFor(stream.get(), sampleRateHz_,
                                                         juce::AudioChannelSet::discreteChannels(channels_),
                                                         32, infoChunk(comment_), 0));
    stream.release(); // now the writer's, which there is for 32 bits
}

WavSink::~WavSink() = default;

bool WavSink::write(const float* const* channels, int frames) {
    if (!error().empty() || isComplete_) return false;
    if (frames <= 0) return true;
    begin();
    writer_->writeFromFloatArrays(channels, channels_, frames);
    dataBytes_ += std::int64_t{frames} * channels_ * 4;
    return error().empty();
}

const std::string& WavSink::complete() {
    if (std::exchange(isComplete_, true)) return error();
    begin();
    writer_.reset(); // its destructor writes the sizes into the header
    if (channels_ > 2 && dataBytes_ < rf64Bytes) file_.writeAt(junkChunkAt, extensibleHeader());
    return error();
}

const std::string& WavSink::finish() { return complete().empty() ? file_.commit() : error(); }

// JUCE writes the extensible form for speaker layouts and RF64 only. Its JUNK chunk (kept for RF64) is 24
// bytes longer before a plain format chunk, so the extensible pair fits into the same 84 bytes.
std::string WavSink::extensibleHeader() const {
    juce::MemoryOutputStream junk;
    junk.write("JUNK", 4);
    junk.writeInt(28);
    junk.writeRepeatedByte(0, 28);
    return std::string{static_cast<const char*>(junk.getData()), junk.getDataSize()} + wavFormatChunk(channels_, sampleRateHz_);
}

} // namespace physvib
