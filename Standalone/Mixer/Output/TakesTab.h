// SPDX-License-Identifier: GPL-3.0-or-later
// The recordings in the user's folder: a list with what can be done with each.
#pragma once
#include "Mixer/Desk/UserFolder.h"
#include "Mixer/Output/TakeTrim.h"
#include "Mixer/Window/TabPanel.h"

namespace physvib {

/// Message thread only.
class TakesTab final : public Tab, private juce::ListBoxModel {
public:
    explicit TakesTab(Desk& desk);

    void refresh(const DeskMoment&) override;
    void visibilityChanged() override { look(); }
    void resized() override;

    void look(); ///< reads the folder again
    int chosen() const { return list_.getSelectedRow(); }
    void choose(int row) { list_.selectRow(row); }
    /// On the device, each channel on the actuator of its number, as a clip of the session.
    void play();
    /// With the events beside it, of a trimmed take that part; nothing is replaced.
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

    Desk& desk_;
    juce::SharedResourcePointer<UserFolder> folder_;
    std::vector<Take> takes_; // the newest first
    juce::Time seenAt_;       // last change of the folder that is listed
    double lookedAtMs_ = 0.0;
    juce::ListBox list_{"Takes", this};
    juce::Label none_;
    TakeTrim trimmer_;
    std::unique_ptr<juce::TextButton> play_, trim_, export_, show_, erase_;
};

} // namespace physvib
