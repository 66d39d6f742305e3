// SPDX-License-Identifier: GPL-3.0-or-later
// One render from its inputs to its events: what the renderer and the outputs need to know.
#pragma once
#include "CommandLine/RenderOptions.h"
#include "Files/LayoutFile.h"
#include "Physics/SceneRun.h"
#include <cmath>
#include <cstdint>

namespace physvib {

/// A preset, or the layout file at that path.
inline Result<LayoutDescription> layoutNamed(const std::string& name) {
    EnchanterLayout preset;
    if (layoutPreset(name, preset)) return describeLayout(name, preset);
    return loadLayout(name);
}

struct RenderJob {
    const RenderOptions& options;
    const Scene* scene = nullptr; ///< null: events come from a list
    LayoutDescription layout;
    SceneEvents made;

    SceneRun run() const { return {options.seed, options.stepsPerSecond}; }
    int channels() const { return layout.geometry.count; }
    std::int64_t frames() const { return std::llround(options.seconds * options.sampleRateHz); }
    std::int64_t endNs() const { return std::llround(options.seconds * 1e9); }
    double fieldWidthMetres() const {
        if (options.fieldWidthMetres > 0) return options.fieldWidthMetres;
        return scene ? scene->fieldWidthMetres : layout.geometry.extentWidthMetres;
    }
    double fieldHeightMetres() const {
        if (options.fieldHeightMetres > 0) return options.fieldHeightMetres;
        return scene ? scene->fieldHeightMetres : layout.geometry.extentHeightMetres;
    }
};

} // namespace physvib
