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

inline EnchanterLayout gridLayout(int columns, int rows) {
    EnchanterLayout layout{1.0, 1.0, columns * rows, {}};
    for (int j = 0; j < layout.count; ++j)
        layout.places[static_cast<std::size_t>(j)] = {columns > 1 ? double(j % columns) / (columns - 1) : 0.5,
                                                      rows > 1 ? double(j / columns) / (rows - 1) : 0.5};
    return layout;
}

struct Rendered {
    Channels channels;
    RenderStatus status;
};

/// Renders `frames` without the limiter's latency; block sizes are taken from `blocks` in turn.
inline Rendered renderEvents(const std::vector<CollisionEvent>& events, const RendererSettings& settings,
                             int frames, const std::vector<int>& blocks = {256}) {
    auto renderer = std::make_unique<HapticRenderer>();
    renderer->prepare(settings);
    const int latency = renderer->latencyFrames(), total = frames + latency;
    Channels all(static_cast<std::size_t>(settings.channels),
                 std::vector<float>(static_cast<std::size_t>(total)));
    ListSource source{events};
    for (int done = 0, turn = 0; done < total; ++turn) {
        const int block = std::min(blocks[static_cast<std::size_t>(turn) % blocks.size()], total - done);
        std::vector<float*> at;
        for (auto& channel : all) at.push_back(channel.data() + done);
        renderer->render(source, at.data(), block);
        done += block;
    }
    for (auto& channel : all) channel.erase(channel.begin(), channel.begin() + latency);
    return {std::move(all), renderer->status()};
}

} // namespace physvib::test
