// SPDX-License-Identifier: MIT
// The parts of a render's picture, each drawn into a given panel, and their colours, lights and field map.
#pragma once
#include "Core/EventShaping.h"
#include "Pictures/PictureCanvas.h"
#include "Pictures/RenderPicture.h"
#include <algorithm>
#include <cmath>

namespace physvib::picture {
/// True for an impact, false for a grain of rolling or sliding.
inline bool isHit(const CollisionEvent& event) noexcept { return event.source.kind == ContactKind::hit; }

/// The input with contacts alone: what compensates the mean of a hit (see EventShaper) is none.
struct ContactInput : PictureInput {
    std::vector<CollisionEvent> contacts{events.begin(), events.end()};
    explicit ContactInput(const PictureInput& all)
        : PictureInput{all} {
        std::erase_if(contacts, isMeanCompensation);
        events = contacts;
    }
};

/// What the colour of a hit means: its material if the scene tells it, else the part of the body on which
/// every hit is felt, as that part's first actuator is drawn, else its frequency.
class HitColours {
public:
    struct Class {
        std::string name;
        Colour colour;
    };
    explicit HitColours(const PictureInput& input);
    Colour colourOf(const CollisionEvent& event) const;
    const std::vector<Class>& classes() const noexcept { return classes_; } ///< those that occur
    const char* meaning() const noexcept { return meaning_; }

private:
    void classifyByMaterial(const PictureInput& input);
    bool classifyByBodyPart(const PictureInput& input); ///< false: a hit is on no known part
    void classifyByFrequency(const PictureInput& input);

    struct Rule {                            // first match wins
        double minHz, maxHz, decayPerSecond; // decay < 0: any
        Colour colour;
        PartNumber part = 0; // 0: any
    };
    std::vector<Rule> rules_;
    std::vector<Class> classes_;
    const char* meaning_ = "frequency";
};

constexpr int headingHeight = 24, axisHeight = 22;
constexpr int peakWidth = 92; ///< right of every lane: its peak in dBFS

/// The label of an actuator: the caller's, else A..Z for up to 26, else its number.
std::string actuatorLabel(const PictureInput& input, int channel);

/// The built-in name of a part of a body; empty of others.
std::string_view builtInPart(PartNumber part) noexcept;

/// The label beside a lane: with the built-in part of a body that the actuator is on ("A thumb").
std::string laneLabel(const PictureInput& input, int channel);

/// The area of a lane in `row`: between the labels, as wide as they need within reason, and the peak.
Area laneArea(const Canvas& canvas, const PictureInput& input, Area row);

/// Height of the lanes of `channels` channels; each is lower if there are more.
int lanesHeight(int channels) noexcept;

/// The amplitude scale that all lanes of a window share, as text.
std::string fullScaleText(const WaveformEnvelope& wave);

std::vector<int> allChannels(const WaveformEnvelope& wave);

/// Lanes of `channels` from top to bottom in `axis.lane`, labels and peaks beside them; above 16 strips whose
/// brightness is the level, labelled in groups.
void drawLanes(const Canvas& canvas, const PictureInput& input, const WaveformEnvelope& wave,
               const std::vector<int>& channels, const Axis& axis, const std::vector<double>& grid);

/// A stem per hit on `axis`, as high as its amplitude in dB.
void drawHits(const Canvas& canvas, const PictureInput& input, const HitColours& colours, const Axis& axis);

/// What the colours of hits mean, right-aligned; if the names are too long, each gets its share of the row.
void drawLegend(const Canvas& canvas, const HitColours& colours, Area row);

/// The field to scale, bodies, hits as glows, traces as lines, actuators, a sentence on the strongest hit.
void drawWorld(const Canvas& canvas, const PictureInput& input, const HitColours& colours, Area panel);

/// 100 ms around the strongest hit, a lane per channel; the eight loudest if there are more.
void drawZoom(const Canvas& canvas, const PictureInput& input, Area panel);

/// A lane per channel, a lane of hits below them, and the time axis of both.
void drawSignals(const Canvas& canvas, const PictureInput& input, const HitColours& colours, Area panel);

// Draws many impacts as accumulated light on one background.

/// Light of all hits, summed before it is made visible, so that twenty thousand neither clip nor vanish.
class Light {
public:
    explicit Light(Area area)
        : area_(area)
        , rgb_(3 * static_cast<std::size_t>(area.width) * static_cast<std::size_t>(area.height), 0.0f) {}

    void add(Point centre, float radius, float strength, Colour colour) {
        if (!area_.toFloat().expanded(radius).contains(centre))
            return; // first, because a coordinate far outside would overflow an int
        const Area box = boxAround(centre, 2.0f * radius, 2.0f * radius).outerPixels().intersection(area_);
        for (int y = box.y; y < box.bottom(); ++y)
            for (int x = box.x; x < box.right(); ++x) {
                const float dx = static_cast<float>(x) + 0.5f - centre.x,
                            dy = static_cast<float>(y) + 0.5f - centre.y;
                const float inside = 1.0f - (dx * dx + dy * dy) / (radius * radius);
                if (inside > 0.0f) addPixel(x, y, strength * inside * inside * inside, colour);
            }
    }

    // Scales the light by the brightest pixel, and applies a film's curve: 1 - exp(-light).
    void draw(Painter& g) const {
        const float brightest = rgb_.empty() ? 0.0f : *std::max_element(rgb_.begin(), rgb_.end());
        const float exposure = brightest > 2.0f ? 2.0f / brightest : 1.0f;
        if (area_.empty() || brightest <= 0.0f) return;
        for (int y = 0; y < area_.height; ++y)
            for (int x = 0; x < area_.width; ++x) g.blend(area_.x + x, area_.y + y, colourAt(x, y, exposure));
    }

private:
    std::size_t index(int x, int y) const {
        return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(area_.width) +
                    static_cast<std::size_t>(x));
    }
    void addPixel(int x, int y, float light, Colour colour) {
        float* pixel = rgb_.data() + index(x - area_.x, y - area_.y);
        pixel[0] += light * static_cast<float>(colour.red) / 255.0f;
        pixel[1] += light * static_cast<float>(colour.green) / 255.0f;
        pixel[2] += light * static_cast<float>(colour.blue) / 255.0f;
    }
    Colour colourAt(int x, int y, float exposure) const {
        const float* pixel = rgb_.data() + index(x, y);
        const float brightest = std::max({pixel[0], pixel[1], pixel[2]});
        if (brightest <= 0.0f) return {};
        return Colour::of(pixel[0] / brightest, pixel[1] / brightest, pixel[2] / brightest,
                          1.0f - std::exp(-exposure * brightest));
    }

    Area area_;
    std::vector<float> rgb_;
};

// Parts of the world panel that pictures and movies share.

/// Metres of the field, origin lower left, to pixels.
struct FieldMap {
    Box field;
    double pixelsPerMetre;
    Point pointAt(double xMetres, double yMetres) const {
        return {field.x + pixels(xMetres), field.bottom() - pixels(yMetres)};
    }
    float pixels(double metres) const { return static_cast<float>(metres * pixelsPerMetre); }
};

/// The field to scale, in the middle of `room`.
FieldMap fittedFieldMap(const PictureInput& input, Area room);

/// A place of the field. A layout in space is seen obliquely: nearer places are further down and to the left.
Point project(const PictureInput& input, const FieldMap& map, double x, double y, double z);

/// Where actuator `channel` stands, the layout being mapped on the field.
Point channelPoint(const PictureInput& input, const FieldMap& map, int channel);

/// All bodies that are present, and the joints between them, at `input.poses`; nothing without a scene.
void drawBodies(const Canvas& canvas, const PictureInput& input, const FieldMap& map);

/// A badge per actuator, within `panel`.
void drawActuators(const Canvas& canvas, const PictureInput& input, const FieldMap& map, Area panel);

} // namespace physvib::picture
