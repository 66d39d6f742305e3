// SPDX-License-Identifier: MIT
// The loop of an offline render: the list is the source, the limiter's look-ahead is rendered first and
// dropped.
#include "Session/OfflineRender.h"
#include <algorithm>
#include <memory>
#include <vector>

namespace physvib {

namespace {

template <class T>
bool popFront(std::span<const T>& rest, T& item) noexcept {
    if (rest.empty()) return false;
    item = rest.front();
    rest = rest.subspan(1);
    return true;
}

struct ListSource {
    std::span<const CollisionEvent> events;
    std::span<const RenderControl> controls;
    bool pop(CollisionEvent& event) noexcept { return popFront(events, event); }
    bool pop(RenderControl& control) noexcept { return popFront(controls, control); }
};

} // namespace

RenderStatus renderOffline(std::span<const CollisionEvent> events, const OfflineSettings& settings,
                           const BlockConsumer& consume) {
    const auto renderer = std::make_unique<HapticRenderer<DesktopProfile>>();
    if (!renderer->prepare(settings.renderer)) return {};
    renderer->setContacts(settings.contacts, settings.othersAreModes);
    const auto channels = static_cast<std::size_t>(settings.renderer.outputs());
    const auto block = static_cast<std::size_t>(settings.blockFrames);
    std::vector<float> samples(channels * block);
    std::vector<float*> out(channels), kept(channels);
    for (std::size_t j = 0; j < channels; ++j) out[j] = samples.data() + j * block;

    ListSource source{events, settings.controls};
    const std::int64_t latency = renderer->latencyFrames(), end = settings.frames + latency;
    for (std::int64_t done = 0; done < end;) {
        const int frames = static_cast<int>(std::min<std::int64_t>(settings.blockFrames, end - done));
        renderer->render(source, out.data(), frames);
        const int dropped = static_cast<int>(std::clamp<std::int64_t>(latency - done, 0, frames));
        std::transform(out.begin(), out.end(), kept.begin(),
                       [=](float* channel) { return channel + dropped; });
        done += frames;
        if (frames > dropped && !consume(kept.data(), frames - dropped)) break;
    }
    return renderer->status();
}

} // namespace physvib
