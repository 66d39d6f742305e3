// SPDX-License-Identifier: GPL-3.0-or-later
// Tab with the gain lanes of all strips and groups over the scene's time (LanesTab), each in a LaneRow.
#pragma once
#include "Mixer/Widgets/MixerWidgets.h"

namespace physvib {

/// View of the gain lane of a strip or group over its played waveform; points can be added, moved and
/// removed.
class LaneRow final : public juce::Component, public juce::SettableTooltipClient {
public:
    /// `index` counts strips, then groups. `model` outlives it.
    LaneRow(MixerModel& model, std::size_t index);

    void mixChanged();
    void setSpan(double spanSeconds); ///< duration shown in its width
    bool keyPressed(const juce::KeyPress& key) override;
    void mouseDown(const juce::MouseEvent& e) override;
    void mouseDrag(const juce::MouseEvent& e) override;
    void mouseUp(const juce::MouseEvent&) override { isDragging_ = false; }
    void focusGained(FocusChangeType) override { repaint(); }
    void paint(juce::Graphics& g) override;

    static juce::NormalisableRange<double> scale(); ///< vertical scale of gains in dB, as of a fader

private:
    /// False between the removal of a strip and the update of the view.
    bool isValid() const { return index_ < model_.mix().strips.size() + model_.mix().groups.size(); }
    bool isGroup() const { return index_ >= model_.mix().strips.size(); }
    std::size_t groupIndex() const { return index_ - model_.mix().strips.size(); }
    const GainLane& lane() const;
    std::vector<int> channels() const;
    juce::Point<float> toPixel(const GainPoint& point) const;
    GainPoint pointAt(juce::Point<float> pixel) const;
    int nearestPoint(juce::Point<float> pixel) const;
    void edit(const GainLane& lane, bool continuesEdit = false);
    void add(const GainPoint& point);
    void move(GainPoint point, bool continuesEdit);
    void removeSelectedPoint();
    void showMenu();
    void describeSelectedPoint();
    void drawWave(juce::Graphics& g) const;
    void drawLine(juce::Graphics& g) const;

    MixerModel& model_;
    const std::size_t index_;
    juce::String name_;
    double spanSeconds_ = 10.0;
    int selectedPoint_ = -1;
    bool isDragging_ = false, hasMoved_ = false;
    double lastKeyMs_ = 0.0; // of the last key that moved a point; 0: something else was edited since
};

/// All gain lanes over one time axis, which grows with the scene. Message thread.
class LanesTab final : public Tab {
public:
    explicit LanesTab(MixerModel& model);

    void mixChanged() override;
    void refresh(const MixerSnapshot&) override;
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    /// Labels beside the lanes; scrolls with them.
    struct Rows final : juce::Component {
        explicit Rows(MixerModel& mixerModel)
            : model{mixerModel} {}
        void paint(juce::Graphics& g) override;

        MixerModel& model;
        std::vector<std::unique_ptr<LaneRow>> lanes;
    };
    double spanSeconds() const;

    MixerModel& model_;
    juce::Viewport viewport_;
    Rows rows_{model_};
    double shownSeconds_ = -1.0, spanSeconds_ = 0.0;
    juce::Rectangle<int> axisArea_;
};

} // namespace physvib
