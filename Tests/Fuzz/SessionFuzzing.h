// SPDX-License-Identifier: MIT
// What messages are fuzzed against: a small session without a log.
#pragma once
#include "Files/SceneCatalogue.h"
#include "Session/Session.h"
#include <memory>

namespace physvib::fuzz {

inline std::unique_ptr<Session> makeSession() {
    SessionSetup setup;
    setup.scene = *findBuiltInScene("drop");
    EnchanterLayout layout;
    layoutPreset("phone4", layout);
    setup.panner = {layout, PanningLaw::linear, 1.0, setup.scene.fieldWidthMetres, setup.scene.fieldHeightMetres};
    setup.log = LogUse::none;
    return std::make_unique<Session>(setup);
}

} // namespace physvib::fuzz
