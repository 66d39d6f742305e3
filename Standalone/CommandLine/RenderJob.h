// SPDX-License-Identifier: GPL-3.0-or-later
// One render from its inputs to its events: what the renderer and the outputs need to know.
#pragma once
#include "CommandLine/ExitCode.h"
#include "CommandLine/RenderOptions.h"
#include "Files/LayoutFile.h"
#include "Files/SceneCatalogue.h"
#include "Physics/SceneRun.h"
#include "Physics/SceneValidation.h"
#include <cmath>
#include <cstdint>
#include <iostream>
#include <optional>

namespace physvib {

/// A preset, or the layout file at that path.
inline Result<LayoutDescription> layoutNamed(const std::string& name) {
    EnchanterLayout preset;
    if (layoutPreset(name, preset)) return describeLayout(name, preset);
    return loadLayout(name);
}

struct RenderJob {
    const RenderOptions& options;
    std::optional<Scene> scene; ///< none: events come from a list
    LayoutDescription layout;
    SceneEvents made;

    SceneRun run() const {
        const auto timing = options.timing == "release" ? ImpactTiming::release : ImpactTiming::onset;
        const auto location = options.location == "fixture" ? ImpactLocation::fixture : ImpactLocation::contact;
        return {options.seed, options.stepsPerSecond, timing, location};
    }
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
    PhantomPanner panner() const {
        return {layout.geometry, options.panningLaw, options.exponent, fieldWidthMetres(), fieldHeightMetres()};
    }
};

/// Takes the scene that the options name into `job`, with warnings on what it simulates badly: exitDone, or
/// the code to leave with after a line on stderr.
inline int takeScene(RenderJob& job) {
    const std::string& name = job.options.scene;
    auto scene = findScene(name, job.options.settings);
    if (!scene) return leave(isScenePath(name) ? exitFailed : exitUsage, scene.error);
    job.scene = std::move(scene.value);
    for (const std::string& warning : sceneWarnings(*job.scene))
        std::cerr << "physvib: warning: " << name << ": " << warning << '\n';
    return exitDone;
}

} // namespace physvib
