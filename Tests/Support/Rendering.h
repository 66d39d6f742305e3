// SPDX-License-Identifier: MIT
// A list of events through a renderer, block by block, as tests need it.
#pragma once
#include "Core/HapticRenderer.h"
#include <algorithm>
#include <memory>
#include <vector>

namespace physvib::test {

using Channels = std::vector<std::vector<float>>;

struct ListSource {
    const std::vector<CollisionEvent>& events;
    std::size_t next = 0;
    bool pop(CollisionEvent& event) noexcept {
        if (next == events.size()) return false;
        event = events[next++];
        return true;
    }
};

/// Events and controls, each in time order, as a session gives them.
struct Session {
    std::vector<CollisionEvent> events;
    std::vector<RenderControl> controls{};
    std::size_t nextEvent = 0, nextControl = 0;
    bool pop(CollisionEvent& event) noexcept { return popOf(events, nextEvent, event); }
    bool pop(RenderControl& control) noexcept { return popOf(controls, nextControl, control); }

private:
    template <class T>
    static bool popOf(const std::vector<T>& all, std::size_t& next, T& one) noexcept {
        if (next == all.size()) return false;
        one = all[next++];
        return true;
    }
};

inline ActuatorLayout gridLayout(int columns, int rows) {
    ActuatorLayout layout{1.0, 1.0, columns * rows, {}};
    for (int j = 0; j < layout.count; ++j)
        layout.places[static_cast<std::size_t>(j)] = {columns > 1 ? double(j % columns) / (columns - 1) : 0.5,
                                                      rows > 1 ? double(j / columns) / (rows - 1) : 0.5};
    return layout;
}

/// The next `frames` of a renderer that is prepared; block sizes are taken from `blocks` in turn.
template <class Source>
Channels renderBlocks(HapticRenderer& renderer, Source& source, int channels, int frames,
                      const std::vector<int>& blocks = {256}) {
    Channels all(static_cast<std::size_t>(channels), std::vector<float>(static_cast<std::size_t>(frames)));
    for (int done = 0, turn = 0; done < frames; ++turn) {
        const int block = std::min(blocks[static_cast<std::size_t>(turn) % blocks.size()], frames - done);
        std::vector<float*> at;
        for (auto& channel : all) at.push_back(channel.data() + done);
        renderer.render(source, at.data(), block);
        done += block;
    }
    return all;
}

struct Rendered {
    Channels channels;
    RenderStatus status;
};

/// `frames` without the limiter's latency.
inline Rendered renderEvents(const std::vector<CollisionEvent>& events, const RendererSettings& settings,
                             int frames, const std::vector<int>& blocks = {256}) {
    auto renderer = std::make_unique<HapticRenderer>();
    renderer->prepare(settings);
    const int latency = renderer->latencyFrames();
    ListSource source{events};
    Channels all = renderBlocks(*renderer, source, settings.channels, frames + latency, blocks);
    for (auto& channel : all) channel.erase(channel.begin(), channel.begin() + latency);
    return {std::move(all), renderer->status()};
}

} // namespace physvib::test
