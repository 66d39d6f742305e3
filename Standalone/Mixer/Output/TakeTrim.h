// SPDX-License-Identifier: GPL-3.0-or-later
// The levels of a take over time, with its start and end to drag.
#pragma once
#include "Mixer/Window/Parts.h"
#include <atomic>
#include <mutex>

namespace physvib {

/// Message thread only.
class TakeTrim final : public juce::Component,
                       public juce::SettableTooltipClient,
                       private juce::AsyncUpdater {
public:
    TakeTrim();
    ~TakeTrim() override;

    /// Shows a take; its levels come when they have been read.
    void show(const juce::File& take, double seconds, juce::Range<double> part);
    /// Cuts the silence at both ends, as soon as the levels are there.
    void trimSilence();
    void showAll() { changeAtOnce({0.0, seconds_}); }
    std::function<void(juce::Range<double> part)> onChange;
    std::function<void()> onEnd; ///< after one or more changes: no more come

    void paint(juce::Graphics& g) override;
    void mouseDown(const juce::MouseEvent& e) override;
    void mouseDrag(const juce::MouseEvent& e) override { moveTo(seconds_ * e.position.x / getWidth()); }
    void mouseUp(const juce::MouseEvent& e) override;
    void mouseDoubleClick(const juce::MouseEvent&) override { showAll(); }
    bool keyPressed(const juce::KeyPress& key) override;

private:
    void moveTo(double seconds);
    void change(juce::Range<double> part);
    void changeAtOnce(juce::Range<double> part);
    void end();
    float pixelOf(double seconds) const;
    void handleAsyncUpdate() override;

    juce::File take_;
    double seconds_ = 0.0;
    juce::Range<double> part_;
    bool movesEnd_ = false, isWaiting_ = false; // for levels, to cut the silence
    std::vector<float> levels_;                 // empty: not read yet
    std::mutex mutex_;                          // guards what is read
    std::vector<float> read_;
    std::atomic<int> reading_{0}; // number of the take that is to be read
    juce::ThreadPool reader_{1};  // destroyed first, because its thread uses the other members
};

} // namespace physvib
