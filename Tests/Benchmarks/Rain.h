// SPDX-License-Identifier: GPL-3.0-or-later
// Events for benchmarks that come as they do live: in time order, at random, 20 ms before they are due.
#pragma once
#include "Core/HapticRenderer.h"
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

namespace physvib::bench {

constexpr int rate = 48000, blockFrames = 64;

/// Actuators in two rows.
inline RendererSettings settingsFor(int channels, InstructionSet set) {
    ActuatorLayout layout{1, 1, channels, {}};
    for (int j = 0; j < channels; ++j)
        layout.places[static_cast<std::size_t>(j)] = {static_cast<double>(j / 2), static_cast<double>(j % 2)};
    return {.sampleRateHz = rate,
            .channels = channels,
            .panner = {layout, PanningLaw::linear, 1, 1, 1},
            .instructions = set};
}

/// A second of strikes, over and over; also the Source of HapticRenderer::render.
class Rain {
public:
    /// `strikes` a second, spread over `materials` of 20 to 1000 Hz that ring for seconds.
    Rain(int strikes, int materials) {
        std::mt19937 random{7};
        const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
        std::vector<CollisionEvent> kinds(static_cast<std::size_t>(materials));
        for (auto& kind : kinds) {
            kind.frequencyHz = 20 * std::pow(50.0, uniform());
            kind.decayPerSecond = 0.5 + uniform();
        }
        for (int i = 0; i < strikes; ++i) {
            CollisionEvent e = kinds[static_cast<std::size_t>(i) % kinds.size()];
            e.timeNs = static_cast<std::int64_t>(1e9 * (i + uniform()) / strikes);
            e.amplitude = 0.1 / std::sqrt(strikes);
            e.x = uniform();
            e.y = uniform();
            second_.push_back(e);
        }
    }
    bool pop(CollisionEvent& event) noexcept {
        if (next_ == second_.size()) {
            next_ = 0;
            offset_ += 1'000'000'000;
        }
        if (second_.empty() || second_[next_].timeNs + offset_ > horizon_) return false;
        event = second_[next_++];
        event.timeNs += offset_;
        return true;
    }
    /// Events up to 20 ms after that frame are there.
    void reach(std::int64_t frame) noexcept { horizon_ = frame * 1'000'000'000 / rate + 20'000'000; }

private:
    std::vector<CollisionEvent> second_;
    std::size_t next_ = 0;
    std::int64_t offset_ = 0, horizon_ = 0;
};

/// The whole chain under rain, block by block.
class RainedOn {
public:
    RainedOn(int channels, int strikes, int materials, InstructionSet set = InstructionSet::best)
        : rain_(strikes, materials)
        , memory_(static_cast<std::size_t>(channels * blockFrames)) {
        renderer_->prepare(settingsFor(channels, set));
        for (int j = 0; j < channels; ++j) at_.push_back(memory_.data() + j * blockFrames);
    }
    void block() noexcept {
        rain_.reach(frame_);
        renderer_->render(rain_, at_.data(), blockFrames);
        frame_ += blockFrames;
        PlayedEvent told;
        while (renderer_->played().pop(told)) {
        }
    }
    void seconds(double s) noexcept {
        for (int i = 0; i < s * rate / blockFrames; ++i) block();
    }
    RenderStatus status() const noexcept { return renderer_->status(); }

private:
    std::unique_ptr<HapticRenderer> renderer_ = std::make_unique<HapticRenderer>();
    Rain rain_;
    std::vector<float> memory_;
    std::vector<float*> at_;
    std::int64_t frame_ = 0;
};

} // namespace physvib::bench
