// SPDX-License-Identifier: MIT
// Lays out the panels of a render's picture, draws it, and encodes it as PNG.
#include "Pictures/RenderPicture.h"
#include "Pictures/PictureParts.h"
#include <png.h>
#include <stdexcept>

namespace physvib {
namespace {

using namespace picture;

constexpr int width = 1600, height = 1000, margin = 24, gap = 14, headerHeight = 60, footerHeight = 34;
constexpr int besideLanes = 200; // headings, the lane of hits, the axis

void drawHeader(const Canvas& canvas, const PictureInput& input, Area row) {
    canvas.text(cleanLine(input.title), row.removeFromTop(36), Align::left, palette::text, largeText, true);
    canvas.text(cleanLine(input.subtitle), row, Align::left, palette::muted);
}

std::string dot() { return "  \xc2\xb7  "; }

std::string eventNumbers(const PictureInput& input) {
    const auto count = static_cast<double>(input.events.size());
    const auto hits = std::ranges::count_if(input.events, isHit),
               grains = std::ranges::ssize(input.events) - hits;
    auto words = number(static_cast<double>(hits), 0) + (hits == 1 ? " hit" : " hits");
    if (grains > 0)
        words += ", " + number(static_cast<double>(grains), 0) + (grains == 1 ? " grain" : " grains");
    return input.durationSeconds > 0.0
               ? words + ", " + shortNumber(count / input.durationSeconds) + " per second"
               : words;
}

std::string soundNumbers(const PictureInput& input) {
    if (input.waveform == nullptr) return "no sound";
    const int channels = input.waveform->channels();
    return "peak " + decibelText(input.waveform->peak()) + dot() + std::to_string(channels) +
           (channels == 1 ? " channel" : " channels") + dot() + number(input.sampleRateHz, 0) + " Hz";
}

void drawFooter(const Canvas& canvas, const PictureInput& input, Area row) {
    auto words =
        eventNumbers(input) + dot() + soundNumbers(input) + dot() + shortNumber(input.durationSeconds) + " s";
    if (!input.law.empty()) words += dot() + cleanLine(input.law);
    canvas.text(words, row.removeFromLeft(canvas.textWidth(words, smallText) + 40), Align::left,
                palette::text);
    canvas.text(cleanLine(input.provenance), row, Align::right, palette::muted);
}

} // namespace

const CollisionEvent* strongestEvent(std::span<const CollisionEvent> events) noexcept {
    const auto found =
        std::ranges::max_element(events, {}, [](const auto& e) { return std::abs(e.amplitude); });
    return found == events.end() ? nullptr : &*found;
}

WorldPoses posesAtStrongest(const Scene& scene, const RunSettings& run,
                            std::span<const CollisionEvent> events) {
    const auto* const strongest = strongestEvent(events);
    return strongest ? posesAt(scene, run, strongest->timeNs) : WorldPoses{};
}

FrameWindow zoomWindow(std::span<const CollisionEvent> events, int sampleRateHz) noexcept {
    const auto* const strongest = strongestEvent(events);
    if (!strongest) return {};
    const double onset = static_cast<double>(strongest->timeNs) * 1e-9;
    return {std::llround((onset - 0.010) * sampleRateHz), std::llround(0.100 * sampleRateHz)};
}

std::string picture::Image::png() const {
    png_image head{};
    head.version = PNG_IMAGE_VERSION;
    head.width = static_cast<png_uint_32>(width_);
    head.height = static_cast<png_uint_32>(height_);
    head.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(head);
    std::string bytes(size, '\0');
    if (!png_image_write_to_memory(&head, bytes.data(), &size, 0, rgb_.data(), 0, nullptr))
        throw std::runtime_error{std::string{"no PNG could be made: "} + head.message};
    bytes.resize(size);
    return bytes;
}

Image drawPicture(const PictureInput& all, const Letters& letters) {
    const ContactInput input{all};
    Image image(width, height);
    Painter graphics(image);
    graphics.fillAll(palette::ground);
    const Canvas canvas{graphics, letters};
    const HitColours colours(input);
    Area page = image.bounds().reduced(margin, 0);
    page.removeFromTop(16);
    drawHeader(canvas, input, page.removeFromTop(headerHeight));
    page.removeFromTop(8);
    drawFooter(canvas, input, page.removeFromBottom(footerHeight + 6).withTrimmedBottom(6));
    const int channels = input.waveform != nullptr ? input.waveform->channels() : 0;
    drawSignals(canvas, input, colours, page.removeFromBottom(lanesHeight(channels) + besideLanes));
    page.removeFromBottom(gap);
    drawWorld(canvas, input, colours, page.removeFromLeft((page.width - gap) / 2));
    page.removeFromLeft(gap);
    drawZoom(canvas, input, page);
    return image;
}

std::string picturePng(const PictureInput& input) { return drawPicture(input).png(); }

} // namespace physvib
