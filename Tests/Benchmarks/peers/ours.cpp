// SPDX-License-Identifier: GPL-3.0-or-later
// PhysVib itself: the mode bank (-DCHAIN=FRAMES: the whole renderer with panning, actuators and limiter, in
// which gains are put on the enchanters by one event per voice and enchanter). So many frames are rendered
// before the first that counts: 128, and blocks are tiles, as live; 47, the latency alone, and each block
// has parts of two tiles.
#include "Core/HapticRenderer.h"
#include "Voices.h"
#include <memory>

using namespace physvib;

#ifdef CHAIN
struct Source {
    std::vector<CollisionEvent> events;
    std::size_t next = 0;
    bool pop(CollisionEvent& event) noexcept {
        if (next == events.size()) return false;
        event = events[next++];
        return true;
    }
};

int main(int, char** arguments) {
    ActuatorLayout layout;
    layoutPreset("phone4", layout);
    const auto renderer = std::make_unique<HapticRenderer>();
    renderer->prepare(
        {.sampleRateHz = rate,
         .channels = channels,
         .panner = {layout, PanningLaw::linear, 1, layout.extentWidthMetres, layout.extentHeightMetres}});
    Source source;
    for (const Voice& v : readVoices(arguments[1]))
        for (int j = 0; j < channels; ++j) {
            CollisionEvent e;
            e.frequencyHz = v.frequencyHz;
            e.decayPerSecond = v.decayPerSecond;
            e.amplitude = v.amplitude * v.gains[j];
            e.x = layout.places[static_cast<std::size_t>(j)].xMetres;
            e.y = layout.places[static_cast<std::size_t>(j)].yMetres;
            e.timeNs = (CHAIN - renderer->latencyFrames()) * 1'000'000'000LL / rate; // exact for both
            source.events.push_back(e);
        }
    float scratch[channels][block];
    float* skipped[channels] = {scratch[0], scratch[1], scratch[2], scratch[3]};
    for (int left = CHAIN; left > 0; left -= block) renderer->render(source, skipped, std::min(left, block));
    return play(arguments, [&](float* const* out, long) { renderer->render(source, out, block); });
}
#else
int main(int, char** arguments) {
    const auto bank = std::make_unique<ModeBank>();
    bank->prepare(rate, channels);
    for (const Voice& v : readVoices(arguments[1]))
        bank->strike({v.frequencyHz, v.decayPerSecond, v.amplitude, {0, 0.0}, Strike::never}, v.gains);
    return play(arguments, [&](float* const* out, long first) { bank->render(out, first, block); });
}
#endif
