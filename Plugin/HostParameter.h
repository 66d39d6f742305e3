// SPDX-License-Identifier: GPL-3.0-or-later
// An entry of the parameter table as a host parameter; its value is one atomic float.
#pragma once
#include "Parameters.h"
#include <atomic>
#include <juce_audio_processors/juce_audio_processors.h>

namespace physvib {

class HostParameter final : public juce::RangedAudioParameter { // LV2 tells real ranges of this kind only
public:
    explicit HostParameter(const ParameterRow& row)
        : RangedAudioParameter{juce::ParameterID{text(row.id), row.version}, text(row.name),
                               juce::AudioProcessorParameterWithIDAttributes{}.withLabel(text(row.unit))}
        , row_{row}
        , range_{rangeOf(row)}
        , normal_{static_cast<float>(normalised(row, row.initial))} {}

    const ParameterRow& row() const noexcept { return row_; }

    /// In the parameter's unit. Any thread, wait-free.
    double value() const noexcept { return denormalised(row_, normal_); }

    /// By a MIDI controller: acts at once; the host is told when tellHost() is called. R, wait-free.
    void setByController(float normal) noexcept {
        normal_ = normal;
        toldToHost_ = false;
    }
    /// M.
    void tellHost() {
        if (!toldToHost_.exchange(true)) sendValueChangedMessageToListeners(normal_);
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
    std::atomic<bool> toldToHost_{true};
};

} // namespace physvib
