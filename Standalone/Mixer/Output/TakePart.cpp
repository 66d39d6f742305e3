// SPDX-License-Identifier: GPL-3.0-or-later
// Streams recordings, so that a long one takes no more memory than a short one.
#include "Mixer/Output/TakePart.h"
#include "Io/Wav/WavSink.h"
#include "Live/Recordings/ReadRecording.h"
#include "Scene/EventsCsv.h"
#include <algorithm>
#include <cmath>
#include <optional>

namespace physvib {
namespace {

constexpr float leastFelt = 0.001f; // -60 dB of full scale
constexpr double fadeSeconds = 0.005;

class Levels final : public SoundTaker {
public:
    Levels(int columns, const std::function<bool()>& goesOn)
        : levels(static_cast<std::size_t>(columns))
        , goesOn_{goesOn} {}
    std::string begin(const SoundShape& shape) override {
        shape_ = shape;
        return shape.frames > 0 ? std::string{} : "no samples";
    }
    std::string take(const float* const* channels, int frames) override {
        const auto columns = static_cast<std::int64_t>(levels.size());
        for (int k = 0; k < frames && at_ < shape_.frames; ++k, ++at_) {
            float& level = levels[static_cast<std::size_t>(at_ * columns / shape_.frames)];
            for (int c = 0; c < shape_.channels; ++c) level = std::max(level, std::abs(channels[c][k]));
        }
        return goesOn_() ? std::string{} : "cancelled";
    }
    std::vector<float> levels;

private:
    const std::function<bool()>& goesOn_;
    SoundShape shape_;
    std::int64_t at_ = 0;
};

class Part final : public SoundTaker {
public:
    Part(juce::Range<double> seconds, const juce::File& to, const std::string& comment)
        : seconds_{seconds}
        , to_{to}
        , comment_{comment} {}
    std::string begin(const SoundShape& shape) override {
        const auto frameOf = [&](double s) {
            return std::clamp<std::int64_t>(std::llround(s * static_cast<double>(shape.sampleRateHz)), 0,
                                            shape.frames);
        };
        from_ = frameOf(seconds_.getStart());
        end_ = frameOf(seconds_.getEnd());
        frames_ = shape.frames;
        fade_ = std::max<std::int64_t>(1, frameOf(fadeSeconds));
        rateHz_ = static_cast<int>(shape.sampleRateHz);
        block_.resize(static_cast<std::size_t>(shape.channels));
        sink_.emplace(to_.getFullPathName().toStdString(), static_cast<int>(shape.channels), rateHz_,
                      comment_);
        return sink_->error();
    }
    std::string take(const float* const* channels, int frames) override {
        for (auto& samples : block_) samples.clear();
        for (int k = 0; k < frames; ++k, ++at_)
            if (at_ >= from_ && at_ < end_)
                for (std::size_t c = 0; c < block_.size(); ++c)
                    block_[c].push_back(channels[c][k] * gainAt(at_));
        std::vector<const float*> pointers;
        for (const auto& samples : block_) pointers.push_back(samples.data());
        sink_->write(pointers.data(), static_cast<int>(block_[0].size()));
        return sink_->error();
    }
    std::string finish() { return sink_->finish(); }
    std::int64_t nsOf(std::int64_t frames) const { return frames * 1'000'000'000 / rateHz_; }
    std::int64_t fromNs() const { return nsOf(from_); }
    std::int64_t endNs() const { return nsOf(end_); }

private:
    float gainAt(std::int64_t frame) const {
        const auto in = from_ == 0 ? fade_ : frame - from_ + 1, out = end_ == frames_ ? fade_ : end_ - frame;
        return static_cast<float>(std::min({fade_, in, out})) / static_cast<float>(fade_);
    }
    const juce::Range<double> seconds_;
    const juce::File to_;
    const std::string comment_;
    std::optional<WavSink> sink_;
    std::vector<std::vector<float>> block_;
    int rateHz_ = 1;
    std::int64_t from_ = 0, end_ = 0, frames_ = 0, fade_ = 1, at_ = 0;
};

} // namespace

std::vector<float> takeLevels(const juce::File& take, int columns, const std::function<bool()>& goesOn) {
    Levels levels{columns, goesOn};
    const auto error = streamRecording(take.getFullPathName().toStdString(), levels);
    return error.empty() ? std::move(levels.levels) : std::vector<float>{};
}

juce::Range<double> soundingPart(const std::vector<float>& levels, double seconds) {
    const auto isFelt = [](float level) { return level >= leastFelt; };
    const auto first = std::ranges::find_if(levels, isFelt);
    if (first == levels.end()) return {0.0, seconds};
    const auto last = std::find_if(levels.rbegin(), levels.rend(), isFelt).base();
    const auto secondsOf = [&](auto at) {
        return seconds * static_cast<double>(at - levels.begin()) / static_cast<double>(levels.size());
    };
    return {secondsOf(first), secondsOf(last)};
}

std::string writeTakePart(const juce::File& take, juce::Range<double> seconds, const juce::File& to) {
    const Provenance provenance{PHYSVIB_VERSION, {{"part_of", take.getFileName().toStdString()}}};
    Part part{seconds, to, provenanceLine(provenance)};
    auto error = streamRecording(take.getFullPathName().toStdString(), part);
    if (error.empty()) error = part.finish();
    const auto from = take.withFileExtension("csv");
    if (!error.empty() || !from.existsAsFile()) return error;
    auto list = loadEventsCsv(from.getFullPathName().toStdString());
    if (!list) return {}; // a take without an event has a list that has none
    auto& events = list.value.events;
    std::erase_if(events, [&](const CollisionEvent& e) {
        return e.timeNs < part.fromNs() || e.timeNs >= part.endNs();
    });
    for (auto& event : events) event.timeNs -= part.fromNs();
    return writeFile(to.withFileExtension("csv").getFullPathName().toStdString(),
                     eventsCsv(events, list.value.field, provenance, list.value.names));
}

} // namespace physvib
