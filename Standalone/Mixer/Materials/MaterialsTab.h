// SPDX-License-Identifier: GPL-3.0-or-later
// Tab with the scene's materials: sets frequency, decay and surface grains, measures them from a dropped
// recording, and plays the material at a spot of the field.
#pragma once
#include "Host/Views/WorldView.h"
#include "Mixer/Materials/MaterialParts.h"
#include "Mixer/Widgets/Parts.h"
#include <deque>
#include <map>

namespace physvib {

class MaterialsTab final : public Tab, public juce::FileDragAndDropTarget, private juce::AsyncUpdater {
public:
    /// While the tab is visible, a click in `world` plays the selected material there.
    MaterialsTab(MixerModel& model, WorldView& world);
    ~MaterialsTab() override;

    /// Sets frequency and decay of the selected material from a recording, asynchronously. Reports errors.
    void measure(const juce::File& file);
    bool isMeasuring() const noexcept { return measuring_ != nullptr; }
    void finishMeasuring();    ///< waits for the result
    void browse();             ///< asks for the recording
    void choose(int material); ///< index in the scene
    void feelAt(FieldShare spot);
    /// Measurement of a material; null if there is none.
    const RecordedHit* recordingOf(int material) const;

    // the window handles session files
    bool isInterestedInFileDrag(const juce::StringArray& files) override {
        return !files[0].endsWithIgnoreCase(".json");
    }
    void fileDragEnter(const juce::StringArray&, int, int) override { setDropping(true); }
    void fileDragMove(const juce::StringArray&, int x, int y) override;
    void fileDragExit(const juce::StringArray&) override { setDropping(false); }
    void filesDropped(const juce::StringArray& files, int x, int y) override;

    void mixChanged() override;
    void visibilityChanged() override;
    void paint(juce::Graphics& g) override;
    void paintOverChildren(juce::Graphics& g) override;
    void resized() override;
    int minHeight(int) const override { return 260; } // with the plots of a recording

private:
    /// One row per material; materials with a frequency first.
    class Rows final : public juce::ListBoxModel {
    public:
        explicit Rows(MaterialsTab& tab)
            : tab_{tab} {}
        int getNumRows() override { return static_cast<int>(tab_.order_.size()); }
        void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) override;
        void listBoxItemClicked(int row, const juce::MouseEvent& e) override;
        void listBoxItemDoubleClicked(int row, const juce::MouseEvent& e) override;
        void returnKeyPressed(int) override { tab_.typeFrequency(); }
        void selectedRowsChanged(int) override { tab_.showChosen(); }
        juce::String getNameForRow(int row) override;
        juce::String getTooltipForRow(int) override {
            return "A double click on its name, or its dot: name and colour";
        }

    private:
        MaterialsTab& tab_;
    };
    /// Arrow keys change the value by 1 %.
    class RatioSlider final : public juce::Slider {
    public:
        bool keyPressed(const juce::KeyPress& key) override;
    };
    class Measuring;
    struct Job {
        juce::File file;
        int material;
        std::shared_ptr<const Scene> scene;
    };

    const Material* chosen() const;
    int chosenIndex() const;
    void prepareSlider(RatioSlider& slider, const juce::String& title, double least, double low, double high,
                       double most);
    void setSound(bool isFrequency, bool continuesEdit);
    void setTexture(const Texture& texture, const juce::String& what, bool continuesEdit);
    void setDropping(bool isDropping);
    void typeFrequency();
    void showChosen();
    void showSpot();
    void askName(bool isCopy);
    void measureNext();
    void handleAsyncUpdate() override;
    void finish(const Job& job, const Result<RecordedHit>& hit);

    MixerModel& model_;
    WorldView& world_;
    std::shared_ptr<const Scene> scene_; // scene of the recordings
    std::vector<int> order_;
    std::map<int, RecordedHit> recordings_;
    FieldShare spot_{0.5, 0.5};
    bool isDropping_ = false;

    Rows rows_{*this};
    juce::ListBox list_{"Materials", &rows_};
    RatioSlider frequency_, decay_;
    TextureRow texture_;
    juce::Slider spotX_, spotY_;
    Caption frequencyName_{"Frequency"}, decayName_{"Decay"}, spotXName_{"x"}, spotYName_{"y"};
    juce::TextButton feel_{juce::String::fromUTF8("Feel it \xe2\x96\xb8")};
    std::unique_ptr<juce::TextButton> new_, browse_;
    std::optional<ShownHit> shown_;
    SpectrumPlot spectrum_;
    CoursePlot course_;
    juce::Rectangle<int> headArea_;
    std::deque<Job> waiting_;
    std::unique_ptr<Measuring> measuring_;
};

} // namespace physvib
