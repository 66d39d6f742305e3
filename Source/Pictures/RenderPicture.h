// SPDX-License-Identifier: MIT
// A picture of a render: the world and its impacts, each actuator's signal, the strongest impact enlarged.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/EnchanterLayout.h"
#include "Pictures/Image.h"
#include "Pictures/Letters.h"
#include "Pictures/WaveformEnvelope.h"
#include "Scene/Scene.h"
#include "Scene/World/Simulation.h"
#include <span>
#include <string>
#include <vector>

namespace physvib {

/// What the picture shows. Every part may be empty: no scene, no bodies, no events, no sound.
struct PictureInput {
    std::string title;
    std::string subtitle;
    double fieldWidthMetres = 0.0; ///< mapped on the layout's extent
    double fieldHeightMetres = 0.0;
    const Scene* scene = nullptr;               ///< null: events without a world
    WorldPoses poses;                           ///< at the strongest event; without bodies: as it began
    std::span<const CollisionEvent> events;     ///< in any order
    std::vector<std::int64_t> runStartsNs;      ///< of a session's scene runs: in a movie they end all light
    ActuatorLayout layout;                      ///< channel j of the waveforms is place j
    std::vector<std::string> labels;            ///< of the actuators; missing ones are A, B, ... or numbers
    const WaveformEnvelope* waveform = nullptr; ///< of the whole render
    const WaveformEnvelope* zoom = nullptr;     ///< of zoomWindow()
    int sampleRateHz = 0;
    double durationSeconds = 0.0;
    std::string law;        ///< the panning law as the picture's footer names it: "linear law"
    std::string provenance; ///< version, seed, source: all that is needed to render this again
};

/// The event with the largest |amplitude|, the first of equals; null without events. Any thread.
const CollisionEvent* strongestEvent(std::span<const CollisionEvent> events) noexcept;

/// Where the bodies of a scene stand at its strongest event; none if nothing was struck. Any thread.
WorldPoses posesAtStrongest(const Scene& scene, const RunSettings& run,
                            std::span<const CollisionEvent> events);

/// Frames of a render, which may reach beyond its ends.
struct FrameWindow {
    std::int64_t firstFrame = 0;
    std::int64_t frameCount = 0;
};

/// What the picture enlarges of a render: 10 ms before to 90 ms after the strongest onset. Any thread.
FrameWindow zoomWindow(std::span<const CollisionEvent> events, int sampleRateHz) noexcept;

/// The picture, 1600 x 1000 pixels. Without any font it is drawn without its text. Any thread.
picture::Image drawPicture(const PictureInput& input, const picture::Letters& letters = picture::Letters{});

/// drawPicture as the bytes of a PNG, the same bytes for the same input and fonts. Any thread.
std::string picturePng(const PictureInput& input);

} // namespace physvib
