// SPDX-License-Identifier: GPL-3.0-or-later
// A render as a timed pattern of on and off, for motors that know nothing else.
#pragma once
#include "Core/Actuators/VibrationConverter.h"
#include "Io/Provenance.h"
#include "Io/Text/NumberText.h"
#include <string>
#include <vector>

namespace physvib {

/// Collects the pattern; csv() is `channel,on_s,off_s`, a line per pulse, channels from 1. M only.
class OnOffPattern final : public VibrationConverter {
public:
    OnOffPattern(int channels, int sampleRateHz, double threshold)
        : steps_(static_cast<std::size_t>(channels), OnOffSteps{sampleRateHz, threshold})
        , rows_(static_cast<std::size_t>(channels)) {}

    bool convert(const float* const* channels, int frames) override {
        for (std::size_t j = 0; j < steps_.size(); ++j)
            for (int n = 0; n < frames; ++n)
                steps_[j].take(channels[j][n], [&](long long step, bool isOn) { addEdge(j, step, isOn); });
        return true;
    }

    std::string csv(const Provenance& provenance) const {
        std::string text = provenanceComment(provenance) + "channel,on_s,off_s\n";
        for (std::size_t j = 0; j < rows_.size(); ++j)
            text += rows_[j] + (steps_[j].isOn() ? secondsOf(steps_[j].steps()) + "\n" : "");
        return text;
    }

private:
    static std::string secondsOf(long long step) {
        return fixedNumber(static_cast<double>(step) / OnOffSteps::stepsPerSecond, 2);
    }
    void addEdge(std::size_t channel, long long step, bool isOn) {
        rows_[channel] +=
            isOn ? std::to_string(channel + 1) + "," + secondsOf(step) + "," : secondsOf(step) + "\n";
    }

    std::vector<OnOffSteps> steps_;
    std::vector<std::string> rows_;
};

} // namespace physvib
