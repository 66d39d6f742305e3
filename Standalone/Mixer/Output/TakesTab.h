// SPDX-License-Identifier: GPL-3.0-or-later
// Tab of the recordings (takes) in the user's folder: it plays, trims, copies and deletes them. TakeTrimmer
// shows a take's levels and selects a part, which a file of its own stores (loadPart).
#pragma once
#include "Mixer/Widgets/MixerWidgets.h"
#include <atomic>

namespace physvib {

/// The levels of a take over time, with handles for start and end. Message thread.
class TakeTrimmer final : public juce::Component,
                          public juce::SettableTooltipClient,
                          private juce::AsyncUpdater {
public:
    TakeTrimmer();
    ~TakeTrimmer() override;

    /// Shows a take of that length with the selected part, in s; a thread reads its levels.
    void setTake(const juce::File& take, double seconds, juce::Range<double> part);
    /// Deselects the silence at both ends, as soon as the levels have been read.
    void trimSilence();
    void selectAll() { setPartAndEnd({0.0, seconds_}); }
    /// Position of playback in s; below 0: the take does not play.
    void setPlayhead(double seconds) {
        if (std::exchange(playheadSeconds_, seconds) != seconds) repaint();
    }
    std::function<void(juce::Range<double> part)> onChange;
    std::function<void()> onEnd; ///< after the last change of a drag, a key or a click

    void paint(juce::Graphics& g) override;
    void mouseDown(const juce::MouseEvent& e) override {
        isDraggingEnd_ = e.position.x > 0.5f * (toPixel(part_.getStart()) + toPixel(part_.getEnd()));
    }
    void mouseDrag(const juce::MouseEvent& e) override { moveEdgeTo(seconds_ * e.position.x / getWidth()); }
    void mouseUp(const juce::MouseEvent& e) override {
        if (e.mouseWasDraggedSinceMouseDown()) notifyEnd();
    }
    void mouseDoubleClick(const juce::MouseEvent&) override { selectAll(); }
    bool keyPressed(const juce::KeyPress& key) override;

private:
    void moveEdgeTo(double seconds);
    void setPart(juce::Range<double> part);
    void setPartAndEnd(juce::Range<double> part);
    void notifyEnd() {
        if (onEnd) onEnd();
    }
    float toPixel(double seconds) const {
        return static_cast<float>(seconds / std::max(seconds_, 1e-9) * getWidth());
    }
    void handleAsyncUpdate() override;

    juce::File take_;
    double seconds_ = 0.0, playheadSeconds_ = -1.0;
    juce::Range<double> part_;
    bool isDraggingEnd_ = false, trimsSilenceWhenRead_ = false; // the latter calls trimSilence()
    std::vector<float> levels_;                                 // empty: not read yet
    std::mutex mutex_;                                          // guards newLevels_
    std::vector<float> newLevels_;
    std::atomic<int> requestedReadNumber_{0}; // increments with each take; cancels reading of earlier ones
    juce::ThreadPool reader_{1};              // destroyed first, because its thread uses the other members
};

/// List of the takes, with buttons to play, trim, copy and delete the selected one. Message thread.
class TakesTab final : public Tab, private juce::ListBoxModel {
public:
    explicit TakesTab(MixerModel& model);

    void refresh(const MixerSnapshot&) override;
    void visibilityChanged() override { rescan(); }
    void resized() override;

    void rescan(); ///< reads the folder again
    void choose(int row) { list_.selectRow(row); }
    /// Plays the selected take as a clip of the session, each channel on the actuator of its number. Stops
    /// what plays; the same take does not start again then.
    void play();
    /// Copies the take, or its selected part, with its events. Those of a replaced recording are deleted; a
    /// list of events without a recording is not replaced, which is reported as an error.
    void exportTo(const juce::File& file);
    /// Deselects the silence at both ends; a trimmed take is selected as a whole. The recording is unchanged.
    void trim();
    void erase(); ///< both files go to the system's bin

private:
    struct Take {
        juce::File file;
        juce::Time modifiedAt;
        double seconds = 0.0;
        int channels = 0;
        juce::Range<double> part; // selected part, s
        bool isTrimmed() const { return part != juce::Range{0.0, seconds}; }
        juce::String length() const; ///< as shown
    };
    int getNumRows() override { return static_cast<int>(takes_.size()); }
    void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) override;
    void selectedRowsChanged(int) override { showSelection(); }
    void listBoxItemDoubleClicked(int, const juce::MouseEvent&) override { play(); }
    void returnKeyPressed(int) override { play(); }
    void deleteKeyPressed(int) override { askErase(); }
    juce::String getNameForRow(int row) override;
    Take* selectedTake();
    void showSelection();
    void askExport();
    void askErase();

    MixerModel& model_;
    juce::SharedResourcePointer<UserFolder> folder_;
    std::vector<Take> takes_;                               // the newest first
    juce::Time folderChangedAt_;                            // last change of the folder that is listed
    std::pair<juce::File, juce::Range<double>> lastPlayed_; // file and part of the last play()
    double playsUntilMs_ = 0.0, folderCheckedAtMs_ = 0.0;
    juce::ListBox list_{"Takes", this};
    Caption emptyHint_{"No recordings yet: Record, or Ctrl+R, makes one", Shade::text};
    TakeTrimmer trimmer_;
    std::unique_ptr<juce::TextButton> playButton_, trimButton_, exportButton_, showButton_, eraseButton_;
};

/// The part of a take from its first to its last perceptible level, s; all of it if there is none. Any
/// thread.
juce::Range<double> perceptiblePart(const std::vector<float>& levels, double seconds);

/// The selected part of a take, s, from its file in the folder `parts`; all of it without such a file, or if
/// the file is for a take of another length. Message thread.
juce::Range<double> loadPart(const juce::File& take, double seconds);

} // namespace physvib
