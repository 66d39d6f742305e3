// SPDX-License-Identifier: GPL-3.0-or-later
// Tab with the scene's materials: sets frequency, decay and surface grains, measures a dropped recording, and
// plays the material at a spot of the field. Also two plots of an impact, and the controls of the grains.
#pragma once
#include "Contacts/Grains.h"
#include "Host/Views/WorldView.h"
#include "Measure/MaterialExtractor.h"
#include "Mixer/Widgets/MixerWidgets.h"
#include <filesystem>
#include <map>

namespace physvib {

/// An impact from its onset, as the plots show it: of a recording, or of a material's mode.
struct HitWaveform {
    double rateHz = 0.0;
    std::vector<float> samples; ///< normalised to a peak of 1
    SpectrumLevels levels{};    ///< normalised to a peak of 0 dB
    double seconds() const noexcept { return static_cast<double>(samples.size()) / rateHz; }
};

/// A contact recording and its fitted mode.
struct RecordedHit {
    std::string name; ///< file name
    ContactSound sound;
    HitWaveform waveform;
    double amplitude = 0.0; ///< of the fitted mode at the onset, in units of the waveform
};

/// Measures the strongest impact of a sound file, which takes up to two seconds. The error is one line with
/// the file's name. Any thread but the render thread.
Result<RecordedHit> measureHit(const std::filesystem::path& path);

/// sin(2 pi f t) exp(-tau t) until a decay of 60 dB, at most one second.
HitWaveform makeModeWaveform(double frequencyHz, double decayPerSecond);

/// Input of both plots; they redraw when it changes.
struct PlottedHit {
    double frequencyHz = 0.0, decayPerSecond = 0.0; ///< 0 Hz: empty plot
    juce::Colour colour;
    const RecordedHit* recording = nullptr; ///< must stay valid until the next show()
    bool operator==(const PlottedHit&) const = default;
};

class SpectrumPlot final : public juce::Component, public juce::SettableTooltipClient {
public:
    SpectrumPlot() { setTitle("Spectrum of the material"); }
    void show(const PlottedHit& hit, const HitWaveform& waveform);
    void paint(juce::Graphics& g) override;

private:
    PlottedHit hit_;
    SpectrumLevels levels_{};
};

class WaveformPlot final : public juce::Component, public juce::SettableTooltipClient {
public:
    WaveformPlot() { setTitle("Decay of the material"); }
    void show(const PlottedHit& hit, const HitWaveform& waveform);
    void paint(juce::Graphics& g) override;

private:
    PlottedHit hit_;
    HitWaveform waveform_;
};

/// Controls for the surface grains of a material: distance, strength, pattern, and share when rolling.
/// Message thread.
class TextureRow final : public juce::Component {
public:
    TextureRow();

    /// Shows a texture; nullopt: disables the controls, as no material is selected.
    void show(const std::optional<Texture>& texture);
    /// Called with the new texture; `valueName` names the changed value, and `continuesEdit` is true during a
    /// drag (see onSliderChange).
    std::function<void(const Texture& texture, const juce::String& valueName, bool continuesEdit)> onChange;

    void resized() override;

private:
    void prepare(juce::Slider& bar, const juce::String& title, const juce::String& tooltip);
    void notifyChange(const juce::String& valueName, bool continuesEdit);

    juce::Slider grain_, roughness_, rolling_;
    juce::ComboBox pattern_;
};

/// Logarithmic range of a slider: its middle 90 % cover the perceptible values from `low` to `high`, its ends
/// the remaining ones from `minValue` to `maxValue`.
inline juce::NormalisableRange<double> perceptualRange(double minValue, double low, double high,
                                                       double maxValue) {
    constexpr double endShare = 0.05;
    const auto interpolate = [](double lower, double upper, double share) {
        return lower * std::pow(upper / lower, share);
    };
    const auto toShare = [](double lower, double upper, double value) {
        return std::log(value / lower) / std::log(upper / lower);
    };
    return {minValue, maxValue,
            [=](double, double, double s) {
                return s < endShare         ? interpolate(minValue, low, s / endShare)
                       : s > 1.0 - endShare ? interpolate(high, maxValue, (s - 1.0 + endShare) / endShare)
                                            : interpolate(low, high, (s - endShare) / (1.0 - 2.0 * endShare));
            },
            [=](double, double, double v) {
                return v < low    ? endShare * toShare(minValue, low, v)
                       : v > high ? 1.0 - endShare + endShare * toShare(high, maxValue, v)
                                  : endShare + (1.0 - 2.0 * endShare) * toShare(low, high, v);
            }};
}

/// As perceptualRange(), but with the value 0 at the left end.
inline juce::NormalisableRange<double> perceptualRangeWithZero(double minValue, double low, double high,
                                                               double maxValue) {
    const auto base = perceptualRange(minValue, low, high, maxValue);
    return {0.0, maxValue, [=](double, double, double s) { return s <= 0.0 ? 0.0 : base.convertFrom0to1(s); },
            [=](double, double, double v) { return v < minValue ? 0.0 : base.convertTo0to1(v); }};
}

class MaterialsTab final : public Tab,
                           public juce::FileDragAndDropTarget,
                           private juce::ListBoxModel,
                           private juce::AsyncUpdater {
public:
    /// While the tab is visible, a click in `world` plays the selected material there.
    MaterialsTab(MixerModel& model, WorldView& world);
    ~MaterialsTab() override;

    /// Sets frequency and decay of the selected material from a recording, asynchronously. Reports errors.
    void measure(const juce::File& file);
    bool isMeasuring() const noexcept { return measuringThread_ != nullptr; }
    void finishMeasuring();       ///< waits for the result
    void browse();                ///< asks the user for a recording and measures it
    void choose(int material);    ///< selects it by its index in the scene
    void playAt(FieldShare spot); ///< plays the selected material, and moves the cross there
    /// Measurement of a material; null if there is none.
    const RecordedHit* findRecording(int material) const;

    // the window handles session files
    bool isInterestedInFileDrag(const juce::StringArray& files) override {
        return !files[0].endsWithIgnoreCase(".json");
    }
    void fileDragEnter(const juce::StringArray&, int, int) override { setDragOver(true); }
    void fileDragMove(const juce::StringArray&, int x, int y) override;
    void fileDragExit(const juce::StringArray&) override { setDragOver(false); }
    void filesDropped(const juce::StringArray& files, int x, int y) override;

    void mixChanged() override;
    void visibilityChanged() override;
    void paint(juce::Graphics& g) override;
    void paintOverChildren(juce::Graphics& g) override;
    void resized() override;
    int minHeight(int) const override { return 260; } // with the plots of a recording

private:
    // one row per material; materials with a frequency first
    int getNumRows() override { return static_cast<int>(rowMaterials_.size()); }
    void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) override;
    void listBoxItemClicked(int row, const juce::MouseEvent& e) override;
    void listBoxItemDoubleClicked(int row, const juce::MouseEvent& e) override;
    void returnKeyPressed(int) override { editFrequency(); }
    void selectedRowsChanged(int) override { showSelected(); }
    juce::String getNameForRow(int row) override;
    juce::String getTooltipForRow(int) override {
        return "A double click on its name, or its dot: name and colour";
    }
    /// Arrow keys change the value by 1 %.
    class RatioSlider final : public juce::Slider {
    public:
        bool keyPressed(const juce::KeyPress& key) override;
    };
    class MeasuringThread;
    struct Job {
        juce::File file;
        int material;
        std::shared_ptr<const Scene> scene;
    };

    const Material* selected() const;
    int selectedIndex() const;
    void prepareSlider(RatioSlider& slider, const juce::String& title, double minValue, double low,
                       double high, double maxValue);
    void setSound(bool isFrequency, bool continuesEdit);
    void setDragOver(bool isDragOver);
    void editFrequency();
    void showSelected();
    void showSpot();
    void showMaterialEditor(bool isCopy);
    void measureNext();
    void handleAsyncUpdate() override;
    void applyMeasurement(const Job& job, const Result<RecordedHit>& hit);

    MixerModel& model_;
    WorldView& world_;
    std::shared_ptr<const Scene> scene_; // scene of the recordings
    std::vector<int> rowMaterials_;      // material of each row
    std::map<int, RecordedHit> recordings_;
    FieldShare spot_{0.5, 0.5};
    bool isDragOver_ = false;

    juce::ListBox list_{"Materials", this};
    RatioSlider frequency_, decay_;
    TextureRow texture_;
    juce::Slider spotX_, spotY_;
    Caption frequencyLabel_{"Frequency"}, decayLabel_{"Decay"}, spotXLabel_{"x"}, spotYLabel_{"y"};
    juce::TextButton playButton_{juce::String::fromUTF8("Feel it \xe2\x96\xb8")};
    std::unique_ptr<juce::TextButton> newButton_, browseButton_;
    std::optional<PlottedHit> plottedHit_;
    SpectrumPlot spectrum_;
    WaveformPlot waveform_;
    juce::Rectangle<int> listHeadArea_;
    std::deque<Job> pendingJobs_;
    std::unique_ptr<MeasuringThread> measuringThread_;
};

} // namespace physvib
