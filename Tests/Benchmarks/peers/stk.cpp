// SPDX-License-Identifier: GPL-3.0-or-later
// The Synthesis ToolKit: SineWave times Asymp per voice.
#include "Voices.h"
#include <memory>
#include <stk/Asymp.h>
#include <stk/SineWave.h>

int main(int, char** arguments) {
    stk::Stk::setSampleRate(rate);
    const auto voices = readVoices(arguments[1]);
    std::vector<std::unique_ptr<stk::SineWave>> sines;
    std::vector<std::unique_ptr<stk::Asymp>> decays;
    for (const Voice& v : voices) {
        sines.push_back(std::make_unique<stk::SineWave>());
        sines.back()->setFrequency(v.frequencyHz);
        decays.push_back(std::make_unique<stk::Asymp>());
        decays.back()->setValue(v.amplitude);
        decays.back()->setTau(1.0 / v.decayPerSecond);
        decays.back()->setTarget(0.0);
    }
    return play(arguments, [&](float* const* out, long) {
        for (int j = 0; j < channels; ++j)
            for (int k = 0; k < block; ++k) out[j][k] = 0.0f;
        for (std::size_t i = 0; i < voices.size(); ++i)
            for (int k = 0; k < block; ++k) {
                const auto x = static_cast<float>(sines[i]->tick() * decays[i]->tick());
                for (int j = 0; j < channels; ++j) out[j][k] += static_cast<float>(voices[i].gains[j]) * x;
            }
    });
}
