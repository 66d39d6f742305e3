// SPDX-License-Identifier: MIT
// Draws the frames of a movie: the static part is drawn once, then copied and completed with the world, the
// light of recent impacts and the time.
#include "Pictures/RenderMovie.h"
#include "Pictures/PictureParts.h"
#include <stdexcept>
#include <webp/encode.h>
#include <webp/mux.h>

namespace physvib {
using namespace picture;

namespace {

constexpr int margin = 16, headerHeight = 40, lanesHeightPixels = 150;
constexpr double glowSeconds = 0.5; // after which an impact's light is gone
constexpr double fadePerSecond = 7.0;
constexpr float rangeDb = 40.0f; // an impact weaker than the strongest by this has no light

std::string clockText(double seconds) { return number(seconds, 2) + " s"; }

} // namespace

/// The panels, the still part of every picture, and the strongest impact's level, to which others compare.
struct RenderMovie::Parts {
    const ContactInput input;
    Letters letters;
    HitColours colours;
    Image background{width, height};
    Area header, world, lanes;
    Axis time;
    double loudestDb = 0.0; // dB

    explicit Parts(const PictureInput& picture)
        : input{picture}
        , colours{input} {
        Area page = background.bounds().reduced(margin, 0);
        header = page.removeFromTop(headerHeight + 6).withTrimmedTop(6);
        lanes =
            page.removeFromBottom(lanesHeightPixels + headingHeight + axisHeight + 12).withTrimmedBottom(8);
        world = page.withTrimmedBottom(4);
        if (const auto* const strongest = strongestEvent(input.events))
            loudestDb = decibels(strongest->amplitude);
        Painter painter{background};
        painter.fillAll(palette::ground);
        const Canvas canvas{painter, letters};
        canvas.text(cleanLine(input.title), header, Align::left, palette::text, largeText, true);
        drawBackgroundLanes(canvas);
    }

    void drawBackgroundLanes(const Canvas& canvas) {
        Area area = lanes;
        const Area heading = area.removeFromTop(headingHeight), axisRow = area.removeFromBottom(axisHeight);
        time = {0.0, input.durationSeconds, laneArea(canvas, input, area)};
        const auto grid = ticks(0.0, input.durationSeconds, 10);
        canvas.heading("ACTUATORS", input.waveform != nullptr ? fullScaleText(*input.waveform) : "", heading);
        if (input.waveform != nullptr)
            drawLanes(canvas, input, *input.waveform, allChannels(*input.waveform), time, grid);
        time.drawLabels(canvas, grid, "s", axisRow);
    }

    /// Level of channel `c` at that time, from 0 to 1 (the peak of the whole render).
    float levelAt(int c, double seconds) const {
        if (input.waveform == nullptr || c >= input.waveform->channels() || input.waveform->peak() <= 0.0f)
            return 0.0f;
        const double from = seconds / std::max(input.durationSeconds, 1e-9) * WaveformEnvelope::columns,
                     columns = WaveformEnvelope::columns / std::max(input.durationSeconds, 1e-9) /
                               picturesPerSecond;
        float peak = 0.0f;
        for (int i = static_cast<int>(from - columns); i <= static_cast<int>(from); ++i) {
            if (i < 0 || i >= WaveformEnvelope::columns) continue;
            const SampleRange range = input.waveform->column(c, i);
            peak = std::max({peak, std::abs(range.lowest), std::abs(range.highest)});
        }
        return std::min(1.0f, peak / input.waveform->peak());
    }

    void drawHalos(const Canvas& canvas, const PictureInput& moving, const FieldMap& map,
                   double seconds) const {
        for (int c = 0; c < input.layout.count; ++c) {
            const float level = std::sqrt(levelAt(c, seconds)), radius = 18.0f + 60.0f * level;
            const Point centre = channelPoint(moving, map, c);
            const Colour colour = palette::actuator(c);
            canvas.graphics.setGradient(
                {centre, radius, colour.withAlpha(0.7f * level), colour.withAlpha(0.0f)});
            canvas.graphics.fillEllipse(boxAround(centre, 2.0f * radius, 2.0f * radius));
        }
    }

    void drawImpacts(const Canvas& canvas, const FieldMap& map, std::int64_t momentNs) const {
        Light light{world};
        std::int64_t runStartNs = INT64_MIN;
        for (const std::int64_t startNs : input.runStartsNs)
            if (startNs <= momentNs) runStartNs = startNs;
        for (const CollisionEvent& event : input.events) {
            const double age = static_cast<double>(momentNs - event.timeNs) * 1e-9;
            if (event.timeNs < runStartNs || age < 0.0 || age > glowSeconds) continue;
            const float level = 1.0f + static_cast<float>(decibels(event.amplitude) - loudestDb) / rangeDb;
            if (level <= 0.0f) continue;
            const auto fade = static_cast<float>(std::exp(-fadePerSecond * age));
            light.add(project(input, map, event.x, event.y, event.z),
                      (isHit(event) ? 10.0f : 5.0f) + 36.0f * level * level * fade,
                      1.8f * level * level * fade, colours.colourOf(event));
        }
        light.draw(canvas.graphics);
    }

    void drawMoment(const Canvas& canvas, const PictureInput& moving, std::int64_t momentNs) const {
        const double seconds = static_cast<double>(momentNs) * 1e-9;
        const FieldMap map = fittedFieldMap(moving, world.reduced(14, 14));
        {
            const Painter::ClipScope clipScope(canvas.graphics);
            canvas.graphics.reduceClip(world);
            canvas.well(map.field.rounded());
            drawHalos(canvas, moving, map, seconds);
            drawBodies(canvas, moving, map);
            drawImpacts(canvas, map, momentNs);
            drawActuators(canvas, moving, map, world);
        }
        canvas.text(clockText(seconds), header, Align::right, palette::highlight, mediumText, true);
        const float x = time.x(std::min(seconds, time.to));
        const Box lane = time.lane.toFloat();
        canvas.graphics.setColour(palette::ground.withAlpha(0.72f)); // dims the lanes after this moment
        canvas.graphics.fillRect({x, lane.y, std::max(0.0f, lane.right() - x), lane.height});
        canvas.graphics.setColour(palette::highlight);
        canvas.graphics.fillRect({x - 1.0f, lane.y, 2.0f, lane.height});
    }
};

RenderMovie::RenderMovie(const PictureInput& input)
    : parts_{std::make_unique<Parts>(input)} {}
RenderMovie::~RenderMovie() = default;

std::int64_t RenderMovie::count() const noexcept {
    return std::max<std::int64_t>(1,
                                  std::llround(std::ceil(parts_->input.durationSeconds * picturesPerSecond)));
}

Image RenderMovie::draw(std::int64_t momentNs, const WorldPoses& poses, const Scene* scene) const {
    Image image = parts_->background;
    Painter painter{image};
    PictureInput moving = parts_->input;
    moving.poses = poses;
    if (scene != nullptr && scene != moving.scene) {
        moving.scene = scene;
        moving.fieldWidthMetres = scene->fieldWidthMetres;
        moving.fieldHeightMetres = scene->fieldHeightMetres;
    }
    parts_->drawMoment({painter, parts_->letters}, moving, momentNs);
    return image;
}

namespace {

constexpr float quality = 78.0f; // libwebp's, 0 to 100: text is sharp; ten seconds take about a megabyte
constexpr int method = 3;        // libwebp's, 0 to 6: higher is slower, and the file a few per cent smaller

[[noreturn]] void fail(const std::string& why) { throw std::runtime_error{"no WebP could be made: " + why}; }

} // namespace

struct WebpMovie::Encoder {
    WebPAnimEncoder* animation = nullptr;
    WebPConfig config{};
    int width, height;

    Encoder(int w, int h)
        : width{w}
        , height{h} {
        WebPAnimEncoderOptions options{};
        if (!WebPAnimEncoderOptionsInit(&options) || !WebPConfigInit(&config))
            fail("another version of libwebp");
        config.quality = quality, config.method = method;
        animation = WebPAnimEncoderNew(w, h, &options);
        if (animation == nullptr) fail("memory");
    }
    ~Encoder() { WebPAnimEncoderDelete(animation); }
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;
};

WebpMovie::WebpMovie(int width, int height)
    : encoder_{std::make_unique<Encoder>(width, height)} {}
WebpMovie::~WebpMovie() = default;

void WebpMovie::add(const picture::Image& image, std::int64_t timeMs) {
    WebPPicture picture{};
    if (!WebPPictureInit(&picture)) fail("another version of libwebp");
    picture.use_argb = 1, picture.width = encoder_->width, picture.height = encoder_->height;
    const bool isAdded =
        WebPPictureImportRGB(&picture, image.rgb(), 3 * image.width()) &&
        WebPAnimEncoderAdd(encoder_->animation, &picture, static_cast<int>(timeMs), &encoder_->config);
    WebPPictureFree(&picture);
    if (!isAdded) fail(WebPAnimEncoderGetError(encoder_->animation));
}

std::string WebpMovie::bytes(std::int64_t endMs) {
    WebPData data{};
    WebPDataInit(&data);
    if (!WebPAnimEncoderAdd(encoder_->animation, nullptr, static_cast<int>(endMs), nullptr) ||
        !WebPAnimEncoderAssemble(encoder_->animation, &data))
        fail(WebPAnimEncoderGetError(encoder_->animation));
    std::string all(reinterpret_cast<const char*>(data.bytes), data.size);
    WebPDataClear(&data);
    return all;
}

} // namespace physvib
