// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the levels on a thread of its own, and moves start and end by mouse and keys.
#include "Mixer/Output/TakeTrim.h"
#include "Mixer/Output/TakePart.h"
#include <utility>

namespace physvib {
namespace {

constexpr int columns = 400;
constexpr double leastSeconds = 0.02, step = 0.01;

} // namespace

TakeTrim::TakeTrim() {
    setTitle("Start and end of the take");
    setTooltip(
        "Drag the start or the end; arrows move the start, with Shift the end; double click: all of it");
    setWantsKeyboardFocus(true);
    setMouseCursor(juce::MouseCursor::LeftRightResizeCursor);
}

TakeTrim::~TakeTrim() {
    ++reading_;
    constexpr int untilItHasStopped = -1;
    reader_.removeAllJobs(true, untilItHasStopped);
    cancelPendingUpdate();
}

void TakeTrim::show(const juce::File& take, double seconds, juce::Range<double> part) {
    part_ = part;
    seconds_ = seconds;
    repaint();
    if (take == take_) return;
    take_ = take;
    levels_.clear();
    isWaiting_ = false;
    const int number = ++reading_;
    reader_.addJob([this, take, number] {
        auto levels = takeLevels(take, columns, [&] { return number == reading_; });
        const std::lock_guard lock{mutex_};
        if (number != reading_) return;
        read_ = std::move(levels);
        triggerAsyncUpdate();
    });
}

void TakeTrim::handleAsyncUpdate() {
    {
        const std::lock_guard lock{mutex_};
        levels_ = std::exchange(read_, {});
    }
    if (std::exchange(isWaiting_, false)) trimSilence();
    repaint();
}

void TakeTrim::trimSilence() {
    if (levels_.empty())
        isWaiting_ = true;
    else
        changeAtOnce(soundingPart(levels_, seconds_));
}

float TakeTrim::pixelOf(double seconds) const {
    return static_cast<float>(seconds / std::max(seconds_, 1e-9) * getWidth());
}

void TakeTrim::change(juce::Range<double> part) {
    part_ = part;
    repaint();
    if (onChange) onChange(part_);
}

void TakeTrim::changeAtOnce(juce::Range<double> part) {
    change(part);
    end();
}

void TakeTrim::end() {
    if (onEnd) onEnd();
}

void TakeTrim::mouseUp(const juce::MouseEvent& e) {
    if (e.mouseWasDraggedSinceMouseDown()) end();
}

void TakeTrim::moveTo(double seconds) {
    const double least = std::min(leastSeconds, seconds_);
    auto part = part_;
    if (movesEnd_)
        part.setEnd(
            juce::jlimit(part.getStart() + least, std::max(part.getStart() + least, seconds_), seconds));
    else
        part.setStart(juce::jlimit(0.0, std::max(0.0, part.getEnd() - least), seconds));
    change(part);
}

void TakeTrim::mouseDown(const juce::MouseEvent& e) {
    movesEnd_ = e.position.x > 0.5f * (pixelOf(part_.getStart()) + pixelOf(part_.getEnd()));
}

bool TakeTrim::keyPressed(const juce::KeyPress& key) {
    const bool isLeft = key.isKeyCode(juce::KeyPress::leftKey);
    if (!isLeft && !key.isKeyCode(juce::KeyPress::rightKey)) return false;
    movesEnd_ = key.getModifiers().isShiftDown();
    moveTo((movesEnd_ ? part_.getEnd() : part_.getStart()) + (isLeft ? -step : step));
    end();
    return true;
}

void TakeTrim::paint(juce::Graphics& g) {
    g.setColour(shade(*this, Shade::well));
    g.fillRoundedRectangle(getLocalBounds().toFloat(), 3.0f);
    const float middle = 0.5f * static_cast<float>(getHeight()), from = pixelOf(part_.getStart()),
                to = pixelOf(part_.getEnd());
    for (std::size_t k = 0; k < levels_.size(); ++k) {
        const float x = static_cast<float>(k) * static_cast<float>(getWidth()) / columns,
                    half = std::max(0.5f, levels_[k] * (middle - 2.0f));
        g.setColour(shade(*this, x >= from && x < to ? Shade::accent : Shade::line));
        g.fillRect(x, middle - half, static_cast<float>(getWidth()) / columns + 0.2f, 2.0f * half);
    }
    g.setColour(shade(*this, Shade::now));
    for (const float x : {from, to})
        g.fillRect(juce::jlimit(0.0f, static_cast<float>(getWidth()) - 3.0f, x - 1.5f), 0.0f, 3.0f,
                   2.0f * middle);
}

} // namespace physvib
