// SPDX-License-Identifier: MIT
// Offline rendering of an event list: makes the list the renderer's event source.
#include "Live/Session/OfflineRender.h"
#include <memory>
#include <new>
#include <vector>

namespace physvib {

namespace {

template <class T>
bool popFront(std::span<const T>& items, T& item) noexcept {
    if (items.empty()) return false;
    item = items.front();
    items = items.subspan(1);
    return true;
}

struct ListSource {
    std::span<const CollisionEvent> events;
    std::span<const RenderControl> controls;
    OnsetMarks* marks;
    bool pop(CollisionEvent& event) noexcept { return popFront(events, event); }
    bool pop(RenderControl& control) noexcept { return popFront(controls, control); }
    void struck(const CollisionEvent& event, std::int64_t frame) noexcept {
        if (marks != nullptr) marks->addOnset(event, frame);
    }
};

} // namespace

RenderStatus renderOffline(std::span<const CollisionEvent> events, const OfflineSettings& settings,
                           const BlockConsumer& consume) {
    const auto renderer = std::make_unique<HapticRenderer>();
    if (!renderer->prepare(settings.renderer)) throw std::bad_alloc{}; // otherwise the output is silent
    renderer->setContacts(settings.contacts);
    const auto channels = static_cast<std::size_t>(settings.renderer.outputs());
    const auto block = static_cast<std::size_t>(settings.blockFrames);
    std::vector<float> samples(channels * block);
    std::vector<float*> out(channels);
    for (std::size_t j = 0; j < channels; ++j) out[j] = samples.data() + j * block;

    ListSource source{events, settings.controls, settings.marks};
    std::vector<float> pulses(settings.marks != nullptr ? block : 0);
    std::vector<const float*> allChannels(channels + 1, pulses.data());
    if (settings.marks != nullptr) settings.marks->prepare(settings.renderer.sampleRateHz, 0);
    renderFromStart(*renderer, source, out.data(), static_cast<int>(channels), settings.frames,
                    settings.blockFrames, [&](const float* const* rendered, int frames) {
                        if (settings.marks == nullptr) return consume(rendered, frames);
                        settings.marks->render(pulses.data(), frames);
                        std::copy_n(rendered, channels, allChannels.begin());
                        return consume(allChannels.data(), frames);
                    });
    return renderer->status();
}

} // namespace physvib
