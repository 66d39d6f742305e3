// SPDX-License-Identifier: GPL-3.0-or-later
// Tab that lists the played contacts, newest first; selected ones can be dragged to another program or saved.
#pragma once
#include "Mixer/Output/HitFiles.h"
#include "Mixer/Window/TabPanel.h"
#include <set>

namespace physvib {

class EventsTab final : public Tab {
public:
    static constexpr const char* dragged = "chosen contacts"; ///< description of a drag

    explicit EventsTab(Desk& desk);
    void takeMix() override;
    void refresh(const DeskMoment& moment) override;
    void paint(juce::Graphics& g) override;
    void resized() override;

    /// Writes the selected contacts to new files and returns their URLs. If there are none, the mixer reports
    /// why.
    juce::StringArray filesToDrag();
    /// Saves them to that file in the format of its extension, or without one in the format of drags. The
    /// mixer reports the result.
    void saveTo(const juce::File& file);

private:
    class Rows final : public juce::ListBoxModel {
    public:
        explicit Rows(EventsTab& tab)
            : tab_{tab} {}
        int getNumRows() override { return static_cast<int>(tab_.shown_.size()); }
        void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) override;
        juce::String getNameForRow(int row) override;
        void selectedRowsChanged(int row) override { tab_.takeChoice(row); }
        void listBoxItemClicked(int, const juce::MouseEvent& e) override {
            if (e.mods.isPopupMenu()) tab_.showMenu();
        }
        void backgroundClicked(const juce::MouseEvent&) override { tab_.list_.deselectAllRows(); }
        void returnKeyPressed(int) override { tab_.saveAs(); }
        juce::var getDragSourceDescription(const juce::SparseSet<int>&) override { return dragged; }

    private:
        EventsTab& tab_;
    };
    void takeChoice(int row);
    void listRecent();
    void listChosen();
    int rowOf(std::uint64_t number) const;
    bool isChosen(const RecentContact& contact) const { return chosen_.contains(contact.number); }
    void tellChoice();
    bool isNarrow() const { return getWidth() < 420; }
    void showMenu();
    void saveAs();
    juce::String fileName() const;
    std::vector<juce::File> write(const juce::File& file, bool tellsHow);

    Desk& desk_;
    std::vector<RecentContact> shown_;
    std::set<std::uint64_t> chosen_; // selected contacts, regardless of their rows
    std::uint64_t last_ = 0;         // the selected contact that was clicked last
    bool isListing_ = false;
    Rows rows_{*this};
    juce::ListBox list_{"Events", &rows_};
    juce::Label choice_;
    juce::ComboBox format_;
    std::unique_ptr<juce::TextButton> save_;
    juce::SharedResourcePointer<DraggedFiles> files_;
    std::uint64_t seen_ = 0;
    double shownAtMs_ = 0.0;
};

} // namespace physvib
