// SPDX-License-Identifier: GPL-3.0-or-later
// Entries of the table as host parameters, each one atomic float, and a block's sample-accurate changes.
#pragma once
#include "Parameters.h"
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <juce_audio_processors/juce_audio_processors.h>
#include <limits>
#include <utility>

namespace physvib {

class HostParameter final : public juce::RangedAudioParameter { // LV2 tells real ranges of this kind only
public:
    explicit HostParameter(const ParameterRow& row)
        : RangedAudioParameter{juce::ParameterID{text(row.id), row.version}, text(row.name)}
        // no label: texts have the unit, and hosts append it
        , row_{row}
        , range_{rangeOf(row)}
        , normal_{static_cast<float>(normalised(row, row.initial))} {}

    const ParameterRow& row() const noexcept { return row_; }

    /// In the parameter's unit. Any thread, wait-free.
    double value() const noexcept { return denormalised(row_, normal_); }

    /// By a MIDI controller: acts at once; the host is told when notifyHost() is called. R, wait-free.
    void setByController(float normal) noexcept {
        normal_ = normal;
        sentToHost_ = false;
    }
    /// M.
    void notifyHost() {
        if (!sentToHost_.exchange(true)) sendValueChangedMessageToListeners(normal_);
    }

    /// The short name where the long one has no room: cut off, those of strikes would be alike.
    juce::String getName(int longest) const override {
        const auto& fits = static_cast<int>(row_.name.size()) <= longest ? row_.name : row_.shortName;
        return text(fits).substring(0, longest);
    }
    float getValue() const override { return normal_; }
    void setValue(float normal) override {
        normal_ = std::isfinite(normal) ? juce::jlimit(0.0f, 1.0f, normal) : getDefaultValue();
    }
    float getDefaultValue() const override { return static_cast<float>(normalised(row_, row_.initial)); }
    bool isDiscrete() const override { return !row_.choices.empty(); }
    bool isBoolean() const override { return row_.scale == ParameterScale::toggle; }
    int getNumSteps() const override {
        return isDiscrete() ? static_cast<int>(row_.choices.size()) : AudioProcessorParameter::getNumSteps();
    }
    const juce::NormalisableRange<float>& getNormalisableRange() const override { return range_; }
    juce::String getText(float normal, int longest) const override {
        const auto words = text(valueText(row_, denormalised(row_, normal)));
        return longest > 0 ? words.substring(0, longest) : words;
    }
    float getValueForText(const juce::String& words) const override {
        return static_cast<float>(normalised(row_, valueOf(row_, words.toStdString())));
    }

private:
    static juce::NormalisableRange<float> rangeOf(const ParameterRow& row) {
        if (!row.choices.empty()) return {0.0f, 1.0f}; // the LV2 wrapper numbers choices from 0 to 1
        const auto from = [&row](float, float, float normal) {
            return static_cast<float>(denormalised(row, normal));
        };
        const auto to = [&row](float, float, float value) {
            return static_cast<float>(normalised(row, value));
        };
        const auto snap = [from, to](float least, float most, float value) {
            return from(least, most, to(least, most, value));
        };
        return {static_cast<float>(row.least), static_cast<float>(row.most), from, to, snap};
    }
    static juce::String text(std::string_view words) {
        return juce::String::fromUTF8(words.data(), static_cast<int>(words.size()));
    }
    const ParameterRow& row_;
    const juce::NormalisableRange<float> range_;
    std::atomic<float> normal_;
    std::atomic<bool> sentToHost_{true};
};

/// A value from 0 to 1 at a frame of the coming block.
struct ParameterPoint {
    int frame = 0;
    double normal = 0.0;
};

/// The points of a block as a format hands them over. R, wait-free; valid until that block has been rendered.
class PointSource {
public:
    /// The next of that parameter, in frame order; false: there are no more.
    virtual bool next(std::size_t parameter, ParameterPoint& point) noexcept = 0;

    /// The frame of its last one, if a host of this format may draw lines; -1: each point is a step.
    virtual int lastOfLine(std::size_t parameter) noexcept = 0;

protected:
    ~PointSource() = default;
};

/// The points of all parameters, one block after the other. R only.
///
/// A point is a step at its frame: then it does not matter how the host cuts its blocks. A host that tells
/// a parameter's value at a block's first and last frame, or one frame behind, draws lines (VST3 lets it
/// leave out what lies on them): between points of such a block that are further than `longestStep` apart,
/// values on the line are told as well, at multiples of `longestStep` from the start on.
class ParameterPoints {
public:
    static constexpr int none = std::numeric_limits<int>::max();
    static constexpr int longestStep = 64; ///< frames; level and law move in ramps of 10 ms

    void reset() noexcept { *this = {}; }

    /// A block of so many frames; without a source, or where it says nothing, there are no points.
    void begin(PointSource* source, int frames) noexcept;

    /// The frame of the next point, of one parameter or of any; none: there are no more. A point behind the
    /// block is one at the next block's first frame: Ardour says there where a line leads.
    int nextOf(Parameter which) const noexcept { return lines_[static_cast<std::size_t>(which)].next(); }
    int next() const noexcept {
        int first = none;
        for (const Line& line : lines_) first = std::min(first, line.next());
        return first;
    }

    /// Calls `act(std::size_t parameter, double normal)` for what is told of frames up to `frame`.
    template <class Act>
    void takeUntil(int frame, Act act) noexcept {
        for (std::size_t p = 0; p < lines_.size(); ++p)
            while (lines_[p].next() <= frame) act(p, take(p));
    }

    /// After the block, and after `takeUntil` its length.
    void end() noexcept;

private:
    struct Line {
        ParameterPoint from{none, 0.0}, corner{none, 0.0}; // the host's last point, and its next
        int step = none;                          // a frame between them at which the line's value is told
        bool isDrawn = false, wasEndTold = false; // the latter: of the block before
        int next() const noexcept { return std::min(step, corner.frame); }
    };
    double take(std::size_t parameter) noexcept;
    ParameterPoint read(std::size_t parameter) noexcept;
    void draw(Line& line, int after) const noexcept;

    PointSource* source_ = nullptr;
    int frames_ = 0;
    int phase_ = 0; // of the block's first frame, from the last multiple of longestStep on
    std::array<Line, parameterCount> lines_{};
};

inline void ParameterPoints::begin(PointSource* source, int frames) noexcept {
    source_ = source;
    const int before = std::exchange(frames_, frames);
    if (!source) return;
    for (std::size_t p = 0; p < lines_.size(); ++p) {
        Line& line = lines_[p];
        line.corner = read(p);
        const bool isEndTold = source->lastOfLine(p) >= frames - 1;
        line.isDrawn =
            isEndTold && allParameters()[p].choices.empty() && (line.wasEndTold || line.corner.frame == 0);
        if (line.wasEndTold) {
            line.from.frame -= before;
            draw(line, -1);
        }
        line.wasEndTold = isEndTold;
    }
}

inline void ParameterPoints::end() noexcept {
    phase_ = (phase_ + frames_) % longestStep;
    if (source_) return;
    for (Line& line : lines_) line.wasEndTold = false;
}

inline double ParameterPoints::take(std::size_t parameter) noexcept {
    Line& line = lines_[parameter];
    if (line.step < line.corner.frame) {
        const int at = line.step;
        draw(line, at);
        return line.from.normal + (line.corner.normal - line.from.normal) * (at - line.from.frame) /
                                      (line.corner.frame - line.from.frame);
    }
    line.from = line.corner;
    line.corner = read(parameter);
    draw(line, line.from.frame);
    return line.from.normal;
}

inline ParameterPoint ParameterPoints::read(std::size_t parameter) noexcept {
    for (ParameterPoint point; source_->next(parameter, point);)
        if (std::isfinite(point.normal)) return {std::clamp(point.frame, 0, frames_), point.normal};
    return {none, 0.0};
}

// The next multiple of the longest step behind `after`, if the line needs it.
inline void ParameterPoints::draw(Line& line, int after) const noexcept {
    line.step = none;
    if (!line.isDrawn || line.corner.frame == none || line.corner.frame - line.from.frame <= longestStep)
        return;
    const int step = (phase_ + after + longestStep) / longestStep * longestStep - phase_;
    if (step < line.corner.frame) line.step = step;
}

} // namespace physvib
