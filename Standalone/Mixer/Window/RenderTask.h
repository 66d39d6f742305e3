// SPDX-License-Identifier: GPL-3.0-or-later
// Creates a file in the background while the session plays, with a progress bar and a cancel button in a
// corner of the window.
#pragma once
#include "Mixer/Window/Parts.h"
#include <atomic>
#include <functional>
#include <string>

namespace physvib {

/// A small card that shows the progress; it reports the result to `done`. Message thread.
class RenderTask final : public juce::Component, private juce::Thread, private juce::Timer {
public:
    /// Runs on its own thread, reports progress from 0 to 1, and stops when that returns false. Empty, or one
    /// error line; "cancelled".
    using Work = std::function<std::string(const std::function<bool(double)>& progress)>;
    /// May destroy the card.
    using Done = std::function<void(const std::string& error, bool isCancelled)>;

    RenderTask(const juce::File& file, Work work, Done done);
    ~RenderTask() override;

    const juce::File& file() const noexcept { return file_; }
    void paint(juce::Graphics& g) override;
    void resized() override;

    static constexpr int wide = 340, high = 58;

private:
    void run() override;
    void timerCallback() override;

    const juce::File file_;
    const Work work_;
    const Done done_;
    std::atomic<double> share_{0.0};
    std::string error_; // read after the thread has ended
    juce::TextButton cancel_{"Cancel"};
};

} // namespace physvib
