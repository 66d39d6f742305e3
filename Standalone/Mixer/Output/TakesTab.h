// SPDX-License-Identifier: GPL-3.0-or-later
// The recordings in the user's folder: a list with what can be done with each.
#pragma once
#include "Mixer/Widgets/Parts.h"
#include <atomic>

namespace physvib {

/// The levels of a take over time, with its start and end to drag.
/// Message thread.
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
    /// How far it has been played, s; below 0: it does not play.
    void showPlayed(double seconds) {
        if (std::exchange(played_, seconds) != seconds) repaint();
    }
    std::function<void(juce::Range<double> part)> onChange;
    std::function<void()> onEnd; ///< after the last change of a drag, a key or a click

    void paint(juce::Graphics& g) override;
    void mouseDown(const juce::MouseEvent& e) override {
        movesEnd_ = e.position.x > 0.5f * (pixelOf(part_.getStart()) + pixelOf(part_.getEnd()));
    }
    void mouseDrag(const juce::MouseEvent& e) override { moveTo(seconds_ * e.position.x / getWidth()); }
    void mouseUp(const juce::MouseEvent& e) override {
        if (e.mouseWasDraggedSinceMouseDown()) end();
    }
    void mouseDoubleClick(const juce::MouseEvent&) override { showAll(); }
    bool keyPressed(const juce::KeyPress& key) override;

private:
    void moveTo(double seconds);
    void change(juce::Range<double> part);
    void changeAtOnce(juce::Range<double> part);
    void end() {
        if (onEnd) onEnd();
    }
    float pixelOf(double seconds) const {
        return static_cast<float>(seconds / std::max(seconds_, 1e-9) * getWidth());
    }
    void handleAsyncUpdate() override;

    juce::File take_;
    double seconds_ = 0.0, played_ = -1.0;
    juce::Range<double> part_;
    bool movesEnd_ = false, isWaiting_ = false; // for levels, to cut the silence
    std::vector<float> levels_;                 // empty: not read yet
    std::mutex mutex_;                          // guards what is read
    std::vector<float> read_;
    std::atomic<int> reading_{0}; // number of the take that is to be read
    juce::ThreadPool reader_{1};  // destroyed first, because its thread uses the other members
};

/// Message thread.
class TakesTab final : public Tab, private juce::ListBoxModel {
public:
    explicit TakesTab(MixerModel& model);

    void refresh(const MixerMoment&) override;
    void visibilityChanged() override { look(); }
    void resized() override;

    void look(); ///< reads the folder again
    int chosen() const { return list_.getSelectedRow(); }
    void choose(int row) { list_.selectRow(row); }
    /// Plays the selected take as a clip of the session, each channel on the actuator of its number. Stops
    /// what plays; the same take does not start again then.
    void play();
    /// Copies the take, or its selected part, with its events. Those of a replaced recording are deleted; a
    /// list of events without a recording is not replaced, which is reported as an error.
    void exportTo(const juce::File& file);
    /// Cuts the silence at both ends, or takes all of a trimmed take again. The recording stays as it is.
    void trim();
    void erase(); ///< both files go to the system's bin

private:
    struct Take {
        juce::File file;
        juce::Time at;
        double seconds = 0.0;
        int channels = 0;
        juce::Range<double> part; // that was chosen, s
        bool isTrimmed() const { return part != juce::Range{0.0, seconds}; }
        juce::String length() const; ///< as shown
    };
    int getNumRows() override { return static_cast<int>(takes_.size()); }
    void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) override;
    void selectedRowsChanged(int) override { showChosen(); }
    void listBoxItemDoubleClicked(int, const juce::MouseEvent&) override { play(); }
    void returnKeyPressed(int) override { play(); }
    void deleteKeyPressed(int) override { askErase(); }
    juce::String getNameForRow(int row) override;
    Take* take();
    void showChosen();
    void askExport();
    void askErase();

    MixerModel& model_;
    juce::SharedResourcePointer<UserFolder> folder_;
    std::vector<Take> takes_;                            // the newest first
    juce::Time seenAt_;                                  // last change of the folder that is listed
    std::pair<juce::File, juce::Range<double>> playing_; // of the last call
    double endsAtMs_ = 0.0, lookedAtMs_ = 0.0;
    juce::ListBox list_{"Takes", this};
    Caption none_{"No recordings yet: Record, or Ctrl+R, makes one", Shade::text};
    TakeTrim trimmer_;
    std::unique_ptr<juce::TextButton> play_, trim_, export_, show_, erase_;
};

/// From the first part of a take's levels that can be felt to the last, s; all of it if there is none. Any
/// thread.
juce::Range<double> soundingPart(const std::vector<float>& levels, double seconds);

/// The selected part of a take, s, from its file in the folder `parts`; all of it if there is none, or one
/// for another length. Message thread.
juce::Range<double> keptPart(const juce::File& take, double seconds);

} // namespace physvib
