// SPDX-License-Identifier: MIT
// What messages are fuzzed against: a small session without a log, and clips by any name.
#pragma once
#include "Live/Messages/MessageRouter.h"
#include "Live/Session/Session.h"
#include "Scene/SceneFile.h"
#include <array>
#include <memory>

namespace physvib::fuzz {

inline std::unique_ptr<Session> makeSession() {
    SessionSetup setup;
    setup.scene = *findBuiltInScene("drop");
    ActuatorLayout layout;
    layoutPreset("phone4", layout);
    setup.panner = {layout, PanningLaw::linear, 1.0, setup.scene.fieldWidthMetres,
                    setup.scene.fieldHeightMetres};
    setup.log = LogUse::none;
    return std::make_unique<Session>(setup);
}

/// Eight of them, by the length of their names: one to five channels, of the lowest rate and of others, some
/// with places of their own.
inline Result<LoadedClip> anyClip(const std::string& name) {
    constexpr std::array<int, 4> rates{100, 8000, 44'100, 192'000};
    const std::size_t kind = name.size() % 8;
    LoadedClip clip;
    for (std::size_t j = 0; j <= kind % 5; ++j) {
        clip.channels.push_back({0.0,
                                 rates[kind % 4],
                                 std::vector<float>(1 + 50 * kind, kind == 3 ? 0.0f : 0.9f),
                                 {.path = std::string(kind, 'x'), .hash = "0123456789abcdef"}});
        if (kind > 4) clip.places.push_back({0.25 * static_cast<double>(j), 0.5});
    }
    return clip;
}

} // namespace physvib::fuzz
