// SPDX-License-Identifier: GPL-3.0-or-later
// Tab that lists the played contacts, newest first, and writes selected ones to files, also to drag them out.
#pragma once
#include "Formats/ClipFile.h"
#include "Mixer/Widgets/MixerWidgets.h"
#include <set>

namespace physvib {

/// File extensions in which impacts can be written: .wav for samples, and the clip formats.
inline const juce::StringArray& hitFileExtensions() {
    static const juce::StringArray all = [] {
        juce::StringArray endings{".wav"}; // most programs read it
        for (const auto ending : writableEndings) endings.add(ending.data());
        return endings;
    }();
    return all;
}

struct WrittenHits {
    std::vector<std::string> paths;  ///< one, or one per actuator if the format is mono
    std::vector<std::string> losses; ///< data that the format cannot store
};

/// Writes the impacts (in any order) with the first at 0 s, panned over the actuators by the law of `mix`, in
/// the format of the extension of `path`; or one error line. Several files never replace existing ones.
/// Message thread.
Result<WrittenHits> writeHits(std::vector<CollisionEvent> hits, const Mix& mix, int sampleRateHz,
                              const juce::File& path);

/// Files dragged to other programs. Some programs copy them late, so the files exist until the mixer ends.
/// Message thread only.
class DraggedFiles {
public:
    ~DraggedFiles() { folder_.deleteRecursively(); }

    /// Creates an empty folder for the files of one drag; or one error line.
    Result<juce::File> makeFolder();

    /// Selected format of drags, an index of hitFileExtensions(); kept when another document is opened.
    int formatIndex() const noexcept { return formatIndex_; }
    void setFormatIndex(int index) noexcept { formatIndex_ = index; }

private:
    juce::File folder_;
    int dragCount_ = 0, formatIndex_ = 0;
};

/// List of played contacts, from which files are saved and dragged. Message thread.
class EventsTab final : public Tab, private juce::ListBoxModel {
public:
    static constexpr const char* dragDescription = "chosen contacts"; ///< description of a drag

    explicit EventsTab(MixerModel& model);
    void refresh(const MixerSnapshot& snapshot) override;
    void paint(juce::Graphics& g) override;
    void resized() override;

    /// Writes the selected contacts to new files and returns their URLs. If that fails, the list is empty and
    /// the mixer reports why.
    juce::StringArray filesToDrag();
    /// Saves the selected contacts to the file in the format of its extension; without an extension, in the
    /// format of drags. The mixer reports the result.
    void saveTo(const juce::File& file) {
        writeSelection(file.getFileExtension().isEmpty()
                           ? file.withFileExtension(hitFileExtensions()[files_->formatIndex()])
                           : file,
                       true);
    }

private:
    int getNumRows() override { return static_cast<int>(contacts_.size()); }
    void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) override;
    juce::String getNameForRow(int row) override;
    void selectedRowsChanged(int row) override;
    void listBoxItemClicked(int, const juce::MouseEvent& e) override {
        if (e.mods.isPopupMenu()) showMenu();
    }
    void backgroundClicked(const juce::MouseEvent&) override { list_.deselectAllRows(); }
    void returnKeyPressed(int) override { saveAs(); }
    juce::var getDragSourceDescription(const juce::SparseSet<int>&) override { return dragDescription; }
    void updateRows();
    void restoreSelection();
    int findRow(std::uint64_t contactId) const;
    bool isContactSelected(const RecentContact& contact) const { return selectedIds_.contains(contact.id); }
    void showSelection();
    bool isNarrow() const { return getWidth() < 420; }
    void showMenu();
    void saveAs();
    juce::String fileName() const;
    std::vector<juce::File> writeSelection(const juce::File& file, bool announcesResult);

    MixerModel& model_;
    std::vector<RecentContact> contacts_;
    std::set<std::uint64_t> selectedIds_; // selected contacts, regardless of their rows
    std::uint64_t lastClickedId_ = 0;     // the selected contact that was clicked last
    bool isUpdatingRows_ = false;
    juce::ListBox list_{"Events", this};
    Caption selectionLabel_;
    juce::ComboBox format_;
    std::unique_ptr<juce::TextButton> save_;
    juce::SharedResourcePointer<DraggedFiles> files_;
    std::uint64_t playedCount_ = 0;
    double updatedAtMs_ = 0.0;
};

} // namespace physvib
