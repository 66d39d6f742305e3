// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the work on its own thread with its own copy of the data.
#include "Mixer/Window/RenderTask.h"

namespace physvib {
namespace {

constexpr int looksPerSecond = 15;

} // namespace

RenderTask::RenderTask(const juce::File& file, Work work, Done done)
    : juce::Thread{"PhysVib render"}
    , file_{file}
    , work_{std::move(work)}
    , done_{std::move(done)} {
    juce::Component::setTitle("Progress");
    cancel_.setTitle("Cancel the making of the file");
    cancel_.onClick = [this] {
        cancel_.setEnabled(false);
        signalThreadShouldExit();
    };
    addAndMakeVisible(cancel_);
    prepareControls(*this);
    setSize(wide, high);
    startThread();
    startTimerHz(looksPerSecond);
}

RenderTask::~RenderTask() {
    constexpr int untilItHasEnded = -1;
    stopThread(untilItHasEnded);
}

void RenderTask::run() {
    error_ = work_([this](double share) {
        share_ = share;
        return !threadShouldExit();
    });
}

void RenderTask::timerCallback() {
    repaint();
    if (isThreadRunning()) return;
    stopTimer();
    const auto done = done_; // which may destroy this object and its error
    const auto error = error_;
    done(error, threadShouldExit());
}

void RenderTask::paint(juce::Graphics& g) {
    drawCard(g, *this);
    auto area = getLocalBounds().reduced(12, 8).withTrimmedRight(92);
    g.setColour(shade(*this, Shade::text));
    g.setFont(juce::Font{text::medium});
    const double share = juce::jlimit(0.0, 1.0, share_.load());
    g.drawText(file_.getFileName() + "  " + juce::String{juce::roundToInt(100.0 * share)} + " %",
               area.removeFromTop(24), juce::Justification::centredLeft, true);
    const auto bar = area.removeFromBottom(8).toFloat();
    g.setColour(shade(*this, Shade::line));
    g.fillRoundedRectangle(bar, 4.0f);
    g.setColour(shade(*this, Shade::accent));
    g.fillRoundedRectangle(bar.withWidth(bar.getWidth() * static_cast<float>(share)), 4.0f);
}

void RenderTask::resized() { cancel_.setBounds(getLocalBounds().reduced(12, 13).removeFromRight(84)); }

} // namespace physvib
