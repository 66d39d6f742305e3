// SPDX-License-Identifier: MIT
// Painter, Path, Canvas, ticks and Axis: converts outlines for FreeType and paints the pixels that it finds.
#include "Pictures/PictureCanvas.h"
#include "Pictures/FreeType.h"
#include <algorithm>
#include <cmath>
#include FT_OUTLINE_H
#include FT_STROKER_H

namespace physvib::picture {

namespace {

constexpr float maxCoordinatePixels = 100000.0f; // pixels; FreeType refuses outlines that reach further
constexpr int maxCorners = 1000,
              maxPartPixels = 128;           // of an outline: if it has more, it is filled in pieces
constexpr std::size_t maxStrokeSteps = 1000; // steps at once: an outline has at most 32767 points

FT_Vector toFtVector(Point p) {
    const auto part = [](float value) {
        return static_cast<FT_Pos>(
            std::lround(64.0f * (value > maxCoordinatePixels    ? maxCoordinatePixels
                                 : value > -maxCoordinatePixels ? value
                                                                : -maxCoordinatePixels)));
    };
    return {part(p.x), part(p.y)};
}

/// The arrays of an FT_Outline. FreeType 2.13.3 made tags, ends and their counts unsigned.
struct Outline {
    using Count = decltype(FT_Outline::n_points);
    using End = std::remove_pointer_t<decltype(FT_Outline::contours)>;
    std::vector<FT_Vector> points;
    std::vector<std::remove_pointer_t<decltype(FT_Outline::tags)>> tags;
    std::vector<End> ends;

    void add(const Path& path, const Transform& transform) {
        for (const Path::Part& part : path.parts()) {
            std::size_t position = 0;
            for (const Path::Kind kind : part.steps) {
                const auto count = std::max<std::size_t>(static_cast<std::size_t>(kind), 1);
                for (std::size_t i = 0; i < count; ++i) {
                    points.push_back(toFtVector(transform.apply(part.points[position++])));
                    tags.push_back(i + 1 == count              ? FT_CURVE_TAG_ON
                                   : kind == Path::Kind::cubic ? FT_CURVE_TAG_CUBIC
                                                               : FT_CURVE_TAG_CONIC);
                }
            }
            ends.push_back(static_cast<End>(points.size() - 1));
        }
    }
    bool fits() const { return points.size() < 32768; }
    FT_Outline view() {
        return {static_cast<Count>(ends.size()),
                static_cast<Count>(points.size()),
                points.data(),
                tags.data(),
                ends.data(),
                FT_OUTLINE_NONE};
    }
};

} // namespace

struct Painter::Raster {
    FreeType library;
    FT_Stroker stroker = nullptr;

    Raster() {
        if (FT_Stroker_New(library, &stroker) != 0) throw std::runtime_error{"FreeType has no stroker"};
    }
    ~Raster() { FT_Stroker_Done(stroker); }

    struct Span {
        int y;
        FT_Span pixels;
    };
    std::vector<Span> spans; // of an outline; painted once all were found

    static void addSpans(int y, int count, const FT_Span* found, void* user) {
        for (int i = 0; i < count; ++i) static_cast<Raster*>(user)->spans.push_back({y, found[i]});
    }

    void paint(Painter& painter) const {
        const RadialGradient& g = painter.gradient_;
        const bool isPlain = g.inner == g.outer;
        for (const auto& [y, span] : spans)
            for (int x = span.x; x < span.x + span.len; ++x) {
                const Point pixel{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
                const Colour colour =
                    isPlain
                        ? g.inner
                        : g.inner.mixedWith(g.outer, std::min(g.centre.distanceTo(pixel) / g.radius, 1.0f));
                painter.image_.blend(x, y, colour, span.coverage);
            }
    }

    /// The pixels within `clip` that an outline can reach.
    static Area paintedArea(const FT_Outline& outline, Area clip) {
        FT_BBox box;
        FT_Outline_Get_CBox(&outline, &box);
        const auto left = static_cast<int>(box.xMin >> 6), top = static_cast<int>(box.yMin >> 6);
        return clip.intersection({left, top, static_cast<int>(box.xMax >> 6) + 1 - left,
                                  static_cast<int>(box.yMax >> 6) + 1 - top});
    }

    // FreeType's rasteriser has little memory: an outline with many corners is filled in narrow pieces.
    void fill(Painter& painter, FT_Outline& outline, Area part) {
        if (outline.n_points == 0 || part.empty()) return;
        FT_Raster_Params params{};
        params.flags = FT_RASTER_FLAG_AA | FT_RASTER_FLAG_DIRECT | FT_RASTER_FLAG_CLIP;
        params.gray_spans = addSpans;
        params.user = this;
        params.clip_box = {part.x, part.y, part.right(), part.bottom()};
        spans.clear();
        const bool fitsMemory = outline.n_points < maxCorners || part.width <= maxPartPixels;
        if (fitsMemory && FT_Outline_Render(library, &outline, &params) == 0) return paint(painter);
        if (part.width == 1) return;
        const Area left = part.removeFromLeft(part.width / 2);
        fill(painter, outline, left);
        fill(painter, outline, part);
    }

    /// Fills the outline of the lines that were given to the stroker.
    void fillStroke(Painter& painter) {
        FT_UInt points = 0, ends = 0;
        FT_Stroker_GetCounts(stroker, &points, &ends);
        Outline data;
        data.points.resize(points), data.tags.resize(points), data.ends.resize(ends);
        FT_Outline outline{0, 0, data.points.data(), data.tags.data(), data.ends.data(), FT_OUTLINE_NONE};
        FT_Stroker_Export(stroker, &outline);
        FT_Stroker_Rewind(stroker);
        fill(painter, outline, paintedArea(outline, painter.clip_));
    }

    // A long part is stroked in pieces.
    void stroke(Painter& painter, const Path::Part& part, const Transform& transform) {
        const bool isLong = part.steps.size() > maxStrokeSteps, closes = part.isClosed && !isLong;
        FT_Vector p[3]{toFtVector(transform.apply(part.points[0]))}; // the last is where the line is
        const FT_Vector start = p[0];
        FT_Vector position = start;
        begin(position, !closes);
        for (std::size_t step = 1, next = 1; step < part.steps.size(); ++step) {
            const auto count = static_cast<std::size_t>(part.steps[step]); // of points: see Kind
            for (std::size_t i = 0; i < count; ++i) p[i] = toFtVector(transform.apply(part.points[next++]));
            add(position, p, count);
            position = p[count - 1];
            if (step % maxStrokeSteps != 0) continue;
            end(painter);
            begin(position, true);
        }
        if (part.isClosed && isLong) add(position, &start, 1);
        end(painter);
    }

private:
    void begin(FT_Vector position, bool isOpen) {
        FT_Stroker_BeginSubPath(stroker, &position, isOpen);
        hasLength_ = false;
    }
    void add(FT_Vector last, const FT_Vector* p, std::size_t count) {
        FT_Vector points[3]{};
        std::copy_n(p, count, points);
        for (std::size_t i = 0; i < count; last = points[i++]) hasLength_ |= differ(last, points[i], count);
        if (count == 1)
            FT_Stroker_LineTo(stroker, &points[0]);
        else if (count == 2)
            FT_Stroker_ConicTo(stroker, &points[0], &points[1]);
        else
            FT_Stroker_CubicTo(stroker, &points[0], &points[1], &points[2]);
    }
    // FreeType's stroker skips lines without length; a path of them alone makes it write outside its memory.
    void end(Painter& painter) {
        if (!hasLength_) return FT_Stroker_Rewind(stroker);
        FT_Stroker_EndSubPath(stroker);
        fillStroke(painter);
    }
    static bool differ(FT_Vector a, FT_Vector b, std::size_t count) noexcept {
        const FT_Pos minDistance = count == 1 ? 1 : 2; // in 64ths of a pixel; 2 for curves
        return std::abs(a.x - b.x) >= minDistance || std::abs(a.y - b.y) >= minDistance;
    }
    bool hasLength_ = false;
};

Painter::Painter(Image& image)
    : image_{image}
    , clip_{image.bounds()}
    , raster_{std::make_unique<Raster>()} {}

Painter::~Painter() = default;

void Painter::fillAll(Colour colour) {
    for (int y = 0; y < image_.height(); ++y)
        for (int x = 0; x < image_.width(); ++x) image_.blend(x, y, colour);
}

void Painter::fillPath(const Path& path, const Transform& transform) {
    Outline outline;
    outline.add(path, transform);
    if (!outline.fits()) return; // no shape that we draw has so many corners
    auto view = outline.view();
    raster_->fill(*this, view, Raster::paintedArea(view, clip_));
}

void Painter::strokePath(const Path& path, float width, const Transform& transform) {
    FT_Stroker_Set(raster_->stroker, std::lround(32.0f * width), FT_STROKER_LINECAP_BUTT,
                   FT_STROKER_LINEJOIN_MITER_FIXED, 4 << 16);
    for (const Path::Part& part : path.parts()) raster_->stroke(*this, part, transform);
}

void Painter::blend(int x, int y, Colour colour) {
    if (clip_.contains({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f}))
        image_.blend(x, y, colour);
}

namespace {
constexpr float quarterCircleHandle = 0.5522848f; // a quarter of a circle as a cubic: the length of
                                                  // its handles, relative to the radius
}

Path& Path::addRectangle(float x, float y, float width, float height) {
    return startNewSubPath(x, y)
        .lineTo(x + width, y)
        .lineTo(x + width, y + height)
        .lineTo(x, y + height)
        .closeSubPath();
}

Path& Path::addEllipse(float x, float y, float width, float height) {
    const float a = 0.5f * width, b = 0.5f * height, cx = x + a, cy = y + b;
    return startNewSubPath(cx + a, cy)
        .cubicTo({cx + a, cy + quarterCircleHandle * b}, {cx + quarterCircleHandle * a, cy + b}, {cx, cy + b})
        .cubicTo({cx - quarterCircleHandle * a, cy + b}, {cx - a, cy + quarterCircleHandle * b}, {cx - a, cy})
        .cubicTo({cx - a, cy - quarterCircleHandle * b}, {cx - quarterCircleHandle * a, cy - b}, {cx, cy - b})
        .cubicTo({cx + quarterCircleHandle * a, cy - b}, {cx + a, cy - quarterCircleHandle * b}, {cx + a, cy})
        .closeSubPath();
}

Path& Path::addRoundedRectangle(Box box, float radius) {
    const float r = std::min({radius, 0.5f * box.width, 0.5f * box.height}),
                k = (1.0f - quarterCircleHandle) * r;
    const float left = box.x, top = box.y, right = box.right(), bottom = box.bottom();
    return startNewSubPath(left + r, top)
        .lineTo(right - r, top)
        .cubicTo({right - k, top}, {right, top + k}, {right, top + r})
        .lineTo(right, bottom - r)
        .cubicTo({right, bottom - k}, {right - k, bottom}, {right - r, bottom})
        .lineTo(left + r, bottom)
        .cubicTo({left + k, bottom}, {left, bottom - k}, {left, bottom - r})
        .lineTo(left, top + r)
        .cubicTo({left, top + k}, {left + k, top}, {left + r, top})
        .closeSubPath();
}

void Path::move(const Transform& transform) {
    for (Part& part : parts_)
        for (Point& p : part.points) p = transform.apply(p);
}

namespace {

/// As many letters of `words` as fit into `room` with three dots behind them.
std::string truncated(const Letters& letters, std::string_view words, float height, bool bold, float room) {
    const auto start = [words](std::size_t bytes) { return std::string{words.substr(0, bytes)} + "..."; };
    std::size_t fits = 0, tooMany = words.size();
    while (tooMany - fits > 1) {
        const std::size_t half = (fits + tooMany) / 2;
        (letters.width(start(half), height, bold) <= room ? fits : tooMany) = half;
    }
    while (fits > 0 && (static_cast<unsigned char>(words[fits]) & 0xc0) == 0x80) --fits; // a whole letter
    return fits > 0 ? start(fits) : std::string{};
}

} // namespace

void Canvas::text(std::string_view words, Area area, Align align, Colour colour, float height,
                  bool bold) const {
    std::string shown{words};
    const auto room = static_cast<float>(area.width);
    float width = letters.width(shown, height, bold);
    if (width > room)
        shown = truncated(letters, words, height, bold, room), width = letters.width(shown, height, bold);
    const float share = align == Align::left ? 0.0f : align == Align::centre ? 0.5f : 1.0f;
    const float left = static_cast<float>(area.x) + share * (room - width),
                top = area.centre().y - 0.5f * height;
    graphics.setColour(colour);
    graphics.fillPath(letters.outline(shown, height, bold),
                      Transform{}.translated(left, std::round(top + letters.ascent(height, bold))));
}

std::vector<double> ticks(double from, double to, int maxCount) {
    if (!(to > from) || maxCount < 1) return {from};
    double step = std::pow(10.0, std::floor(std::log10((to - from) / maxCount)));
    for (const double factor : {1.0, 2.0, 5.0, 10.0, 20.0})
        if ((to - from) / (step * factor) <= maxCount) {
            step *= factor;
            break;
        }
    const double slack = 1e-3 * (to - from); // at most two pixels, so that a tick at the edge is kept
    std::vector<double> places;
    for (double i = std::ceil((from - slack) / step); i * step <= to + slack; ++i) places.push_back(i * step);
    return places;
}

void Axis::drawLabels(const Canvas& canvas, const std::vector<double>& places, const std::string& unit,
                      Area row) const {
    const double step = places.size() > 1 ? places[1] - places[0] : 1.0;
    const int decimals = step >= 1.0 ? 0 : static_cast<int>(std::ceil(-std::log10(step) - 1e-9));
    for (const double t : places) {
        const auto words = number(t, decimals) + (t == places.back() ? " " + unit : std::string());
        const int width = canvas.textWidth(words, smallText) + 2;
        const int left = std::min(roundToInt(x(t)) - width / 2, row.right() - width);
        canvas.text(words, {left, row.y, width, row.height}, Align::centre, palette::muted);
    }
}

} // namespace physvib::picture
