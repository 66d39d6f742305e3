// SPDX-License-Identifier: GPL-3.0-or-later
// A hit as Eq. 5.1 has it, and what a room and a microphone add.
#include "Mixer/Materials/MaterialShots.h"
#include "Io/Wav/WavSink.h"
#include "Mixer/Materials/MaterialsTab.h"
#include "Stimuli/SeededRandom.h"
#include <cmath>
#include <numbers>

namespace physvib {

bool writeKnock(const juce::File& file) {
    constexpr int rate = 48000, frames = rate / 2, onset = rate / 20;
    // Hz, 1/s, amplitude
    constexpr std::array<std::array<double, 3>, 3> partials{
        {{352.0, 98.0, 0.5}, {612.0, 210.0, 0.2}, {840.0, 260.0, 0.12}}};
    SeededRandom random{1};
    std::vector<float> samples(frames);
    for (int i = 0; i < frames; ++i) {
        double x = 0.004 * random.normal();
        for (const auto& [hz, decay, amplitude] : partials)
            if (const double t = static_cast<double>(i - onset) / rate; t >= 0.0)
                x += amplitude * std::sin(2.0 * std::numbers::pi * hz * t) * std::exp(-decay * t);
        samples[static_cast<std::size_t>(i)] = static_cast<float>(x);
    }
    WavSink sink{file.getFullPathName().toStdString(), 1, rate};
    const float* channels[]{samples.data()};
    return sink.write(channels, frames) && sink.finish().empty();
}

void showMaterials(Desk& desk, MixerView& view) {
    view.tabs().choose("Materials");
    auto* tab = dynamic_cast<MaterialsTab*>(view.tabs().find("Materials"));
    const auto folder = juce::File::createTempFile("physvib-knock");
    const auto file = folder.getChildFile("knock.wav");
    if (tab == nullptr || !folder.createDirectory() || !writeKnock(file)) return;
    tab->choose(4);
    tab->measure(file);
    tab->finishMeasuring();
    folder.deleteRecursively();
    desk.dispatchPendingMessages();
    tab->feelAt({0.3, 0.62});
}

} // namespace physvib
