// SPDX-License-Identifier: MIT
// The parts of a render's picture; each is drawn into a given panel.
#pragma once
#include "Pictures/PictureCanvas.h"
#include "Pictures/RenderPicture.h"

namespace physvib::picture {

/// Or a grain that was passed.
inline bool isHit(const CollisionEvent& event) noexcept { return event.source.kind == ContactKind::hit; }

/// What a colour of a hit means: its material where the scene tells, else the part of the body on which every
/// hit is felt, as that part's first actuator is drawn, else its frequency.
class HitColours {
public:
    struct Class {
        std::string name;
        Colour colour;
    };
    explicit HitColours(const PictureInput& input);
    Colour of(const CollisionEvent& event) const;
    const std::vector<Class>& classes() const noexcept { return classes_; } ///< those that occur
    const char* meaning() const noexcept { return meaning_; }

private:
    void takeMaterials(const PictureInput& input);
    bool takeParts(const PictureInput& input); ///< false, and nothing taken: a hit is felt on no part
    void takeFrequencies(const PictureInput& input);

    struct Rule {                                   // first match wins
        double lowestHz, highestHz, decayPerSecond; // decay < 0: any
        Colour colour;
        PartNumber part = 0; // 0: any
    };
    std::vector<Rule> rules_;
    std::vector<Class> classes_;
    const char* meaning_ = "frequency";
};

constexpr int headingHeight = 24;
constexpr int axisHeight = 22;
constexpr int peakWidth = 92; ///< right of every lane: its peak in dBFS

/// The label of an enchanter: the caller's, else A..Z for up to 26, else its number.
std::string labelOf(const PictureInput& input, int channel);

/// The built-in name of a part of a body; empty of others.
std::string_view builtInPart(PartNumber part) noexcept;

/// The label beside a lane: with the built-in part of a body that the actuator is on ("A thumb").
std::string laneLabelOf(const PictureInput& input, int channel);

/// What is left of `row` for a lane between the labels (as wide as they need, within reason) and the peaks.
Area laneOf(const Canvas& canvas, const PictureInput& input, Area row);

/// Height that the lanes of `channels` channels need; more channels, less each.
int lanesHeight(int channels) noexcept;

/// The scale that all lanes of a window share, in words.
std::string fullHeight(const WaveformEnvelope& wave);

/// Lanes of `channels` from top to bottom in `axis.lane`, labels and peaks beside them; above 16 strips whose
/// brightness is the level, labelled in groups.
void drawLanes(const Canvas& canvas, const PictureInput& input, const WaveformEnvelope& wave,
               const std::vector<int>& channels, const Axis& axis, const std::vector<double>& grid);

/// A stem per hit on `axis`, as high as its amplitude in dB.
void drawHits(const Canvas& canvas, const PictureInput& input, const HitColours& colours, const Axis& axis);

/// What the colours of hits mean, right-aligned; if the names are too long, each gets its share of the row.
void drawLegend(const Canvas& canvas, const HitColours& colours, Area row);

/// The field to scale, bodies, hits as glows, what rolls and slides as lines of light, enchanters, and one
/// sentence on the strongest hit.
void drawWorld(const Canvas& canvas, const PictureInput& input, const HitColours& colours, Area panel);

/// 100 ms around the strongest hit, a lane per channel; the eight loudest if there are more.
void drawZoom(const Canvas& canvas, const PictureInput& input, Area panel);

/// A lane per channel, a lane of hits below them, and the time axis of both.
void drawSignals(const Canvas& canvas, const PictureInput& input, const HitColours& colours, Area panel);

} // namespace physvib::picture
