// SPDX-License-Identifier: GPL-3.0-or-later
// Tab with the gain lanes of all strips and groups over the scene's time.
#pragma once
#include "Mixer/Widgets/Parts.h"

namespace physvib {

/// View of the gain lane of a strip or group over its played waveform; points can be added, moved and
/// removed.
class LaneRow final : public juce::Component, public juce::SettableTooltipClient {
public:
    /// `number` counts strips, then groups. `model` outlives it.
    LaneRow(MixerModel& model, std::size_t number);

    void mixChanged();
    void show(double spanSeconds); ///< duration shown in its width
    bool keyPressed(const juce::KeyPress& key) override;
    void mouseDown(const juce::MouseEvent& e) override;
    void mouseDrag(const juce::MouseEvent& e) override;
    void mouseUp(const juce::MouseEvent&) override { isDragging_ = false; }
    void focusGained(FocusChangeType) override { repaint(); }
    void paint(juce::Graphics& g) override;

    static juce::NormalisableRange<double> scale(); ///< of gains, upwards, as for a fader

private:
    bool isThere() const {
        return number_ < model_.mix().strips.size() + model_.mix().groups.size();
    } // false after the strip was removed, until the view follows
    bool isGroup() const { return number_ >= model_.mix().strips.size(); }
    std::size_t group() const { return number_ - model_.mix().strips.size(); }
    const GainLane& lane() const;
    std::vector<int> channels() const;
    juce::Point<float> placeOf(const GainPoint& point) const;
    GainPoint pointAt(juce::Point<float> place) const;
    int nearest(juce::Point<float> place) const;
    void edit(const GainLane& lane, bool continuesEdit = false);
    void add(const GainPoint& point);
    void move(GainPoint point, bool continuesEdit);
    void removeChosen();
    void showMenu();
    void describeChosen();
    void drawWave(juce::Graphics& g) const;
    void drawLine(juce::Graphics& g) const;

    MixerModel& model_;
    const std::size_t number_;
    juce::String name_;
    double spanSeconds_ = 10.0;
    int chosen_ = -1;
    bool isDragging_ = false, isMoved_ = false;
};

class LanesTab final : public Tab {
public:
    explicit LanesTab(MixerModel& model);

    void mixChanged() override;
    void refresh(const MixerMoment&) override;
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    /// Labels beside the lanes; scrolls with them.
    struct Rows final : juce::Component {
        explicit Rows(MixerModel& of)
            : model{of} {}
        void paint(juce::Graphics& g) override;

        MixerModel& model;
        std::vector<std::unique_ptr<LaneRow>> lanes;
    };
    double spanSeconds() const;

    MixerModel& model_;
    juce::Viewport viewport_;
    Rows rows_{model_};
    double shownSeconds_ = -1.0, spanSeconds_ = 0.0;
    juce::Rectangle<int> foot_;
};

} // namespace physvib
