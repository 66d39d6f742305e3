// SPDX-License-Identifier: GPL-3.0-or-later
// Tab with the scene's materials: sets frequency, decay and surface grains, measures them from a dropped
// recording, and plays the material at a spot of the field. Its plots: spectrum and waveform of an impact.
#pragma once
#include "Contacts/Grains.h"
#include "Host/Views/WorldView.h"
#include "Measure/MaterialExtractor.h"
#include "Mixer/Widgets/Parts.h"
#include <filesystem>
#include <map>

namespace physvib {

/// An impact from its onset for display, of a recording or of a material's mode.
struct HitCourse {
    double rateHz = 0.0;
    std::vector<float> samples; ///< normalised to a peak of 1
    SpectrumLevels levels{};    ///< normalised to a peak of 0 dB
    double seconds() const noexcept { return static_cast<double>(samples.size()) / rateHz; }
};

/// A contact recording and its fitted mode.
struct RecordedHit {
    std::string name; ///< file name
    ContactSound sound;
    HitCourse course;
    double amplitude = 0.0; ///< of the fitted mode at the onset, in units of the course
};

/// Measures the strongest impact of a file, on any thread but the render thread; or one line with the file's
/// name. Takes up to two seconds.
Result<RecordedHit> measureHit(const std::filesystem::path& path);

/// sin(2 pi f t) exp(-tau t) until a decay of 60 dB, at most one second.
HitCourse courseOf(double frequencyHz, double decayPerSecond);

/// Input of both plots; they redraw when it changes.
struct ShownHit {
    double frequencyHz = 0.0, decayPerSecond = 0.0; ///< 0 Hz: empty plot
    juce::Colour colour;
    const RecordedHit* recording = nullptr; ///< must stay valid until the next show()
    bool operator==(const ShownHit&) const = default;
};

class SpectrumPlot final : public juce::Component, public juce::SettableTooltipClient {
public:
    SpectrumPlot() { setTitle("Spectrum of the material"); }
    void show(const ShownHit& hit, const HitCourse& course);
    void paint(juce::Graphics& g) override;

private:
    ShownHit hit_;
    SpectrumLevels levels_{};
};

class CoursePlot final : public juce::Component, public juce::SettableTooltipClient {
public:
    CoursePlot() { setTitle("Decay of the material"); }
    void show(const ShownHit& hit, const HitCourse& course);
    void paint(juce::Graphics& g) override;

private:
    ShownHit hit_;
    HitCourse course_;
};

/// Controls for the surface grains of a material: distance, strength, pattern, and share when rolling.
/// Message thread.
class TextureRow final : public juce::Component {
public:
    TextureRow();

    /// nullopt: no surface to edit.
    void show(const std::optional<Texture>& texture);
    /// Called with the new texture; `what` names the changed value, and `continuesEdit` is true during a drag
    /// (see onSlide).
    std::function<void(const Texture& texture, const juce::String& what, bool continuesEdit)> onChange;

    void resized() override;

private:
    void prepare(juce::Slider& bar, const juce::String& title, const juce::String& tooltip);
    void change(const juce::String& what, bool continuesEdit);

    juce::Slider grain_, roughness_, rolling_;
    juce::ComboBox pattern_;
};

/// Logarithmic range: the middle 90 % of the slider cover the perceivable values from `low` to `high`, and
/// its ends the rest of the possible ones.
inline juce::NormalisableRange<double> feltRange(double least, double low, double high, double most) {
    constexpr double end = 0.05;
    const auto part = [](double from, double to, double share) { return from * std::pow(to / from, share); };
    const auto shareOf = [](double from, double to, double value) {
        return std::log(value / from) / std::log(to / from);
    };
    return {least, most,
            [=](double, double, double s) {
                return s < end         ? part(least, low, s / end)
                       : s > 1.0 - end ? part(high, most, (s - 1.0 + end) / end)
                                       : part(low, high, (s - end) / (1.0 - 2.0 * end));
            },
            [=](double, double, double v) {
                return v < low    ? end * shareOf(least, low, v)
                       : v > high ? 1.0 - end + end * shareOf(high, most, v)
                                  : end + (1.0 - 2.0 * end) * shareOf(low, high, v);
            }};
}

/// The same, with 0 at the left end.
inline juce::NormalisableRange<double> feltRangeWithZero(double least, double low, double high, double most) {
    const auto felt = feltRange(least, low, high, most);
    return {0.0, most, [=](double, double, double s) { return s <= 0.0 ? 0.0 : felt.convertFrom0to1(s); },
            [=](double, double, double v) { return v < least ? 0.0 : felt.convertTo0to1(v); }};
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
    // one row per material; materials with a frequency first
    int getNumRows() override { return static_cast<int>(order_.size()); }
    void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) override;
    void listBoxItemClicked(int row, const juce::MouseEvent& e) override;
    void listBoxItemDoubleClicked(int row, const juce::MouseEvent& e) override;
    void returnKeyPressed(int) override { typeFrequency(); }
    void selectedRowsChanged(int) override { showChosen(); }
    juce::String getNameForRow(int row) override;
    juce::String getTooltipForRow(int) override {
        return "A double click on its name, or its dot: name and colour";
    }
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

    juce::ListBox list_{"Materials", this};
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
