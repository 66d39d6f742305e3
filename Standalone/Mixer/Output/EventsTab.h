// SPDX-License-Identifier: GPL-3.0-or-later
// Tab that lists the played contacts, newest first; writes selected ones to files, also for drags to others.
#pragma once
#include "Formats/ClipFile.h"
#include "Mixer/Widgets/Parts.h"
#include <set>

namespace physvib {

/// File extensions for impacts: samples, or a clip format.
inline const juce::StringArray& hitEndings() {
    static const juce::StringArray all = [] {
        juce::StringArray endings{".wav"}; // what most programs take
        for (const auto ending : writtenEndings) endings.add(ending.data());
        return endings;
    }();
    return all;
}

struct WrittenHits {
    std::vector<std::string> paths;  ///< one, or one per actuator if the format is mono
    std::vector<std::string> losses; ///< data that the format cannot store
};

/// Writes the impacts (in any order) from the first one on, panned over the actuators by the law of `mix`, in
/// the format of the extension of `path`; or one error line. Several files never replace existing ones.
/// Message thread.
Result<WrittenHits> writeHits(std::vector<CollisionEvent> hits, const Mix& mix, int sampleRateHz,
                              const juce::File& path);

/// Files dragged to other programs. Some of these copy them late, so they exist until the mixer ends. Message
/// thread only.
class DraggedFiles {
public:
    ~DraggedFiles() { folder_.deleteRecursively(); }

    /// Creates an empty folder for the files of one drag; or one error line.
    Result<juce::File> makeFolder();

    /// Selected format of drags, an index of hitEndings(); kept when another document is opened.
    int ending() const noexcept { return ending_; }
    void setEnding(int ending) noexcept { ending_ = ending; }

private:
    juce::File folder_;
    int drags_ = 0, ending_ = 0;
};

class EventsTab final : public Tab, private juce::ListBoxModel {
public:
    static constexpr const char* dragged = "chosen contacts"; ///< description of a drag

    explicit EventsTab(MixerModel& model);
    void refresh(const MixerMoment& moment) override;
    void paint(juce::Graphics& g) override;
    void resized() override;

    /// Writes the selected contacts to new files and returns their URLs. If there are none, the mixer reports
    /// why.
    juce::StringArray filesToDrag();
    /// Saves them to that file in the format of its extension, or without one in the format of drags. The
    /// mixer reports the result.
    void saveTo(const juce::File& file) {
        write(file.getFileExtension().isEmpty() ? file.withFileExtension(hitEndings()[files_->ending()])
                                                : file,
              true);
    }

private:
    int getNumRows() override { return static_cast<int>(shown_.size()); }
    void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) override;
    juce::String getNameForRow(int row) override;
    void selectedRowsChanged(int row) override;
    void listBoxItemClicked(int, const juce::MouseEvent& e) override {
        if (e.mods.isPopupMenu()) showMenu();
    }
    void backgroundClicked(const juce::MouseEvent&) override { list_.deselectAllRows(); }
    void returnKeyPressed(int) override { saveAs(); }
    juce::var getDragSourceDescription(const juce::SparseSet<int>&) override { return dragged; }
    void listRecent();
    void listChosen();
    int rowOf(std::uint64_t number) const;
    bool isChosen(const RecentContact& contact) const { return chosen_.contains(contact.number); }
    void describeChoice();
    bool isNarrow() const { return getWidth() < 420; }
    void showMenu();
    void saveAs();
    juce::String fileName() const;
    std::vector<juce::File> write(const juce::File& file, bool saysHow);

    MixerModel& model_;
    std::vector<RecentContact> shown_;
    std::set<std::uint64_t> chosen_; // selected contacts, regardless of their rows
    std::uint64_t last_ = 0;         // the selected contact that was clicked last
    bool isListing_ = false;
    juce::ListBox list_{"Events", this};
    Caption choice_;
    juce::ComboBox format_;
    std::unique_ptr<juce::TextButton> save_;
    juce::SharedResourcePointer<DraggedFiles> files_;
    std::uint64_t seen_ = 0;
    double shownAtMs_ = 0.0;
};

} // namespace physvib
