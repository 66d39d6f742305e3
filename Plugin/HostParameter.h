// SPDX-License-Identifier: GPL-3.0-or-later
// HostParameter: an entry of the table as a host's parameter, one atomic float; ParameterPoints: the
// sample-accurate changes of a block. R: the host's audio thread; M: the message thread.
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

inline juce::String fromUtf8(std::string_view utf8) {
    return juce::String::fromUTF8(utf8.data(), static_cast<int>(utf8.size()));
}

class HostParameter final : public juce::RangedAudioParameter { // LV2 publishes the ranges of this kind only
public:
    explicit HostParameter(const ParameterRow& row)
        : RangedAudioParameter{juce::ParameterID{fromUtf8(row.id), row.version}, fromUtf8(row.name)}
        // no label, which hosts would append, because texts have the unit
        , row_{row}
        , range_{makeRange(row)}
        , normal_{static_cast<float>(normalised(row, row.initial))} {}

    const ParameterRow& row() const noexcept { return row_; }

    /// The present value, in the parameter's unit. Any thread, wait-free.
    double value() const noexcept { return denormalised(row_, normal_); }

    /// Sets it as by a MIDI controller, at once; notifyHost() reports it to the host later. R, wait-free.
    void setByController(float normal) noexcept {
        normal_ = normal;
        sentToHost_ = false;
    }
    /// Reports changes by a controller since the last call to the host. M.
    void notifyHost() {
        if (!sentToHost_.exchange(true)) sendValueChangedMessageToListeners(normal_);
    }

    /// The short name if the long one does not fit: the names of strikes begin alike.
    juce::String getName(int maxLength) const override {
        const auto& fits = static_cast<int>(row_.name.size()) <= maxLength ? row_.name : row_.shortName;
        return fromUtf8(fits).substring(0, maxLength);
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
    juce::String getText(float normal, int maxLength) const override {
        const auto words = fromUtf8(valueText(row_, denormalised(row_, normal)));
        return maxLength > 0 ? words.substring(0, maxLength) : words;
    }
    float getValueForText(const juce::String& words) const override {
        return static_cast<float>(normalised(row_, valueFromText(row_, words.toStdString())));
    }

private:
    static juce::NormalisableRange<float> makeRange(const ParameterRow& row) {
        if (!row.choices.empty()) return {0.0f, 1.0f}; // the LV2 wrapper numbers choices from 0 to 1
        const auto from = [&row](float, float, float normal) {
            return static_cast<float>(denormalised(row, normal));
        };
        const auto to = [&row](float, float, float value) {
            return static_cast<float>(normalised(row, value));
        };
        const auto snap = [from, to](float minimum, float maximum, float value) {
            return from(minimum, maximum, to(minimum, maximum, value));
        };
        return {static_cast<float>(row.minimum), static_cast<float>(row.maximum), from, to, snap};
    }
    const ParameterRow& row_;
    const juce::NormalisableRange<float> range_;
    std::atomic<float> normal_;
    std::atomic<bool> sentToHost_{true};
};

/// A value, 0 to 1, at a frame of the next block.
struct ParameterPoint {
    int frame = 0;
    double normal = 0.0;
};

/// The points of a block from a plug-in format. R, wait-free; valid until that block has been rendered.
class PointSource {
public:
    /// Reads the next point of that parameter, in frame order; false if there is none.
    virtual bool next(std::size_t parameter, ParameterPoint& point) noexcept = 0;

    /// The frame of its last point, if hosts of this format may draw lines; -1: each point is a step.
    virtual int lastPointFrame(std::size_t parameter) noexcept = 0;

protected:
    ~PointSource() = default;
};

/// Reads the points of all parameters, block by block. R only.
/// A point is a step at its frame, so that the size of the host's blocks does not matter. A host that sends a
/// parameter's value at the first frame of a block and at the last one or one beyond means a line (VST3 lets
/// it omit points on lines). Between points of such a block that are more than `maxStepFrames` apart, values
/// on the line are added, at multiples of `maxStepFrames` since it was made.
class ParameterPoints {
public:
    static constexpr int noFrame = std::numeric_limits<int>::max();
    static constexpr int maxStepFrames = 64; ///< well below the ramps of level and law, 10 ms

    /// Called before a block of `frames` frames; `source` is null if it has no points.
    void begin(PointSource* source, int frames) noexcept;

    /// The frame of the next point of one parameter or of any; noFrame if there is none. A point beyond the
    /// block counts at the next block's first frame: Ardour sends the end of a line so.
    int nextFrame(Parameter which) const noexcept { return lines_[static_cast<std::size_t>(which)].next(); }
    int next() const noexcept {
        int first = noFrame;
        for (const Line& line : lines_) first = std::min(first, line.next());
        return first;
    }

    /// Calls `visit(std::size_t parameter, double normal)` for each point up to `frame`, and removes it.
    template <class Visit>
    void readPointsUntil(int frame, Visit visit) noexcept {
        for (std::size_t p = 0; p < lines_.size(); ++p)
            while (lines_[p].next() <= frame) visit(p, nextValue(p));
    }

    /// Called after the block, when readPointsUntil() has read all of its points.
    void end() noexcept;

private:
    struct Line {
        ParameterPoint last{noFrame, 0.0}, nextPoint{noFrame, 0.0}; // points of the host
        int stepFrame = noFrame;                   // the next frame between them with a value on the line
        bool isDrawn = false, hadEndPoint = false; // hadEndPoint: in the block before
        int next() const noexcept { return std::min(stepFrame, nextPoint.frame); }
    };
    double nextValue(std::size_t parameter) noexcept;
    ParameterPoint read(std::size_t parameter) noexcept;
    void setNextStep(Line& line, int after) const noexcept;

    PointSource* source_ = nullptr;
    int frames_ = 0;
    int phase_ = 0; // the block's first frame modulo maxStepFrames
    std::array<Line, parameterCount> lines_{};
};

inline void ParameterPoints::begin(PointSource* source, int frames) noexcept {
    source_ = source;
    const int before = std::exchange(frames_, frames);
    if (!source) return;
    for (std::size_t p = 0; p < lines_.size(); ++p) {
        Line& line = lines_[p];
        line.nextPoint = read(p);
        const bool hasEndPoint = source->lastPointFrame(p) >= frames - 1;
        line.isDrawn = hasEndPoint && allParameters()[p].choices.empty() &&
                       (line.hadEndPoint || line.nextPoint.frame == 0);
        if (line.hadEndPoint) {
            line.last.frame -= before;
            setNextStep(line, -1);
        }
        line.hadEndPoint = hasEndPoint;
    }
}

inline void ParameterPoints::end() noexcept {
    phase_ = (phase_ + frames_) % maxStepFrames;
    if (source_) return;
    for (Line& line : lines_) line.hadEndPoint = false;
}

inline double ParameterPoints::nextValue(std::size_t parameter) noexcept {
    Line& line = lines_[parameter];
    if (line.stepFrame < line.nextPoint.frame) {
        const int at = line.stepFrame;
        setNextStep(line, at);
        return line.last.normal + (line.nextPoint.normal - line.last.normal) * (at - line.last.frame) /
                                      (line.nextPoint.frame - line.last.frame);
    }
    line.last = line.nextPoint;
    line.nextPoint = read(parameter);
    setNextStep(line, line.last.frame);
    return line.last.normal;
}

inline ParameterPoint ParameterPoints::read(std::size_t parameter) noexcept {
    for (ParameterPoint point; source_->next(parameter, point);)
        if (std::isfinite(point.normal)) return {std::clamp(point.frame, 0, frames_), point.normal};
    return {noFrame, 0.0};
}

// Sets the step frame to the next multiple of maxStepFrames after `after`, if the line needs one.
inline void ParameterPoints::setNextStep(Line& line, int after) const noexcept {
    line.stepFrame = noFrame;
    if (!line.isDrawn || line.nextPoint.frame == noFrame ||
        line.nextPoint.frame - line.last.frame <= maxStepFrames)
        return;
    const int step = (phase_ + after + maxStepFrames) / maxStepFrames * maxStepFrames - phase_;
    if (step < line.nextPoint.frame) line.stepFrame = step;
}

} // namespace physvib
