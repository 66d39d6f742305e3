// SPDX-License-Identifier: GPL-3.0-or-later
// Lays the panels out on the page, draws it, and writes it as a PNG.
#include "Host/Pictures/RenderPicture.h"
#include "Host/Pictures/PictureParts.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

using namespace picture;
using J = juce::Justification;

constexpr int width = 1600;
constexpr int height = 1000;
constexpr int margin = 24;
constexpr int gap = 14;
constexpr int headerHeight = 60;
constexpr int footerHeight = 34;
constexpr int besideLanes = 200; // headings, the lane of hits, the axis

void drawHeader(const Canvas& canvas, const PictureInput& input, Area row) {
    canvas.text(wordsOf(input.title), row.removeFromTop(36), J::centredLeft,
                palette::text, largeText, true);
    canvas.text(wordsOf(input.subtitle), row, J::centredLeft, palette::muted);
}

juce::String dot() {
    return "  " + juce::String::charToString(0x00b7) + "  ";
}

juce::String eventNumbers(const PictureInput& input) {
    const auto count = static_cast<double>(input.events.size());
    const auto hits = std::ranges::count_if(input.events, isHit), grains = std::ranges::ssize(input.events) - hits;
    auto words = number(static_cast<double>(hits), 0) + (hits == 1 ? " hit" : " hits");
    if (grains > 0) words += ", " + number(static_cast<double>(grains), 0) + (grains == 1 ? " grain" : " grains");
    return input.durationSeconds > 0.0
               ? words + ", " + shortNumber(count / input.durationSeconds) + " per second"
               : words;
}

juce::String soundNumbers(const PictureInput& input) {
    if (input.waveform == nullptr) return "no sound";
    const int channels = input.waveform->channels();
    return "peak " + decibelText(input.waveform->peak()) + dot() + juce::String(channels) +
           (channels == 1 ? " channel" : " channels") + dot() + number(input.sampleRateHz, 0) + " Hz";
}

void drawFooter(const Canvas& canvas, const PictureInput& input, Area row) {
    auto words =
        eventNumbers(input) + dot() + soundNumbers(input) + dot() + shortNumber(input.durationSeconds) + " s";
    if (!input.law.empty()) words += dot() + wordsOf(input.law);
    canvas.text(words, row.removeFromLeft(textWidth(words, smallText) + 40), J::centredLeft, palette::text);
    canvas.text(wordsOf(input.provenance), row, J::centredRight, palette::muted);
}

} // namespace

std::ptrdiff_t strongestEvent(std::span<const CollisionEvent> events) noexcept {
    const auto found =
        std::ranges::max_element(events, {}, [](const auto& e) { return std::abs(e.amplitude); });
    return found == events.end() ? -1 : found - events.begin();
}

FrameWindow zoomWindow(std::span<const CollisionEvent> events, int sampleRateHz) noexcept {
    const auto index = strongestEvent(events);
    if (index < 0) return {};
    const double onset = static_cast<double>(events[static_cast<std::size_t>(index)].timeNs) * 1e-9;
    return {std::llround((onset - 0.010) * sampleRateHz), std::llround(0.100 * sampleRateHz)};
}

juce::Image drawPicture(const PictureInput& input) {
    juce::Image image(juce::Image::RGB, width, height, true, juce::SoftwareImageType());
    juce::Graphics graphics(image);
    graphics.fillAll(palette::ground);
    const Canvas canvas{graphics};
    const HitColours colours(input);
    Area page = Area(width, height).reduced(margin, 0);
    page.removeFromTop(16);
    drawHeader(canvas, input, page.removeFromTop(headerHeight));
    page.removeFromTop(8);
    drawFooter(canvas, input, page.removeFromBottom(footerHeight + 6).withTrimmedBottom(6));
    const int channels = input.waveform != nullptr ? input.waveform->channels() : 0;
    drawSignals(canvas, input, colours, page.removeFromBottom(lanesHeight(channels) + besideLanes));
    page.removeFromBottom(gap);
    drawWorld(canvas, input, colours, page.removeFromLeft((page.getWidth() - gap) / 2));
    page.removeFromLeft(gap);
    drawZoom(canvas, input, page);
    return image;
}

juce::MemoryBlock picturePng(const PictureInput& input) {
    juce::MemoryOutputStream bytes;
    juce::PNGImageFormat().writeImageToStream(drawPicture(input), bytes);
    return bytes.getMemoryBlock();
}

} // namespace physvib
