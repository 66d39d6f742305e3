// SPDX-License-Identifier: GPL-3.0-or-later
// Tabs of the output: actuators and panning (layout presets, panning law, exponent, gain maps); device,
// sample rate, block size and the resulting latency, additional sinks; and real-time statistics of the
// session: late and lost events, processor load of rendering.
#pragma once
#include "Host/Views/WorldView.h"
#include "Mixer/Widgets/Parts.h"

namespace physvib {

/// A line of a FactList.
struct Fact {
    juce::String name, value;
    Shade shade = Shade::text;
    bool operator==(const Fact&) const = default;
};

/// List of names and values in columns, fewer where they are narrow; redraws only on changes.
class FactList final : public ReadOut {
public:
    FactList(const juce::String& title, int maxColumns);

    void set(std::vector<Fact> facts);
    const std::vector<Fact>& facts() const noexcept { return facts_; }
    int heightFor(int width) const; ///< at which all of it is seen
    void paint(juce::Graphics& g) override;

private:
    struct Places {
        int columns = 1, nameWidth = 0, rows = 0, lines = 0; // lines: of the highest column
        std::vector<int> linesOf;                            // of each fact
    };
    Places placesIn(int width) const;

    const int maxColumns_;
    std::vector<Fact> facts_;
};

class TelemetryTab final : public Tab {
public:
    explicit TelemetryTab(MixerModel& model);
    void refresh(const MixerMoment& moment) override;
    int minHeight(int width) const override { return facts_.heightFor(width); }
    void resized() override { facts_.setBounds(getLocalBounds()); }

private:
    float medianLoad() const;

    MixerModel& model_;
    FactList facts_{"Telemetry", 2};
    std::deque<float> loads_; // load of recent blocks
    double shownAtMs_ = 0.0;
};

/// Status of session, device and board as text; `medianLoad` is a share of a block's duration.
std::vector<Fact> telemetryFacts(const MixerModel& model, const MixerMoment& moment, float medianLoad);

class OutputTab final : public Tab {
public:
    explicit OutputTab(MixerModel& model);
    void mixChanged() override;
    void refresh(const MixerMoment& moment) override;
    void resized() override;
    int minHeight(int width) const override {
        constexpr int controls = 18 + rowHeight + 3 * (28 + rowHeight) + 12; // as resized() places them
        return controls + facts_.heightFor(width);
    }
    void visibilityChanged() override {
        if (isVisible() && !isScanned_) scan();
    }
    /// Sets the receiver HOST:PORT as if typed; empty: none.
    void sendHitsTo(const juce::String& receiver);

private:
    void scan();
    void open();

    MixerModel& model_;
    struct SinkRow { // of the list of outputs
        const SinkKind& kind;
        std::string where; ///< empty: to be typed
        bool isThere, isUsed;
    };
    void findSinks();
    void listSinks();
    void choose(const SinkRow& row);
    void use(const SinkKind& kind, const std::string& where);
    void listen();
    void chooseReceiver();
    void useOsc(const OscChoice& choice, const juce::String& what);
    void showOsc();
    void ask(const juce::String& title, const juce::String& what, const juce::String& now,
             std::function<void(const juce::String&)> use);
    std::vector<Fact> sinkFacts() const;
    juce::String oscState(Shade& shade) const;
    void listHeard();
    void chooseMonitor();
    juce::String ownersOf(int output, bool isMuteTold = false) const;
    juce::String heardWords() const;

    juce::ComboBox device_, rate_, block_, osc_, hits_, phone_, monitor_, monitorLevel_, marks_;
    Caption deviceName_{"Outputs"}, rateName_{"Rate"}, blockName_{"Block of"}, oscName_{"Messages by OSC"},
        hitsName_{"Hits by OSC to"}, phoneName_{"A phone's top is"}, monitorName_{"Monitor outputs"},
        monitorLevelName_{"Monitor level"}, marksName_{"Trigger output"};
    std::unique_ptr<juce::TextButton> scan_;
    FactList facts_{"What follows from it", 1};
    std::vector<AudioDeviceName> found_;
    std::string worn_; // device of the item Headphones: the last one in use, else the first with two outputs
    std::vector<std::vector<SinkPlace>> sinks_; // available ones of each kind, in the order of sinkKinds()
    std::vector<SinkRow> rows_;
    std::ptrdiff_t ready_ = 0; // how many sinks are there
    bool isScanned_ = false;
};

class EnchantersTab final : public Tab, private juce::ListBoxModel {
public:
    /// `world` shows the gain map of the actuator selected here.
    EnchantersTab(MixerModel& model, WorldView& world);
    void mixChanged() override;
    void editRow(int enchanter); ///< asks for name, profile and full scale
    void resized() override;
    int minHeight(int) const override { return 224; } // two rows of the list
    void visibilityChanged() override {
        world_.showGainsOf(isVisible() && maps_.getToggleState() ? chosen_ : -1);
    }

private:
    /// Actuator symbol that is dragged onto the field.
    struct Module final : AttachButton {
        using AttachButton::AttachButton;
        void paintButton(juce::Graphics& g, bool isOver, bool isDown) override;
    };
    // one row per actuator
    int getNumRows() override { return model_.mix().count(); }
    void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) override;
    void selectedRowsChanged(int row) override;
    void deleteKeyPressed(int row) override { model_.detach(row); }
    void listBoxItemDoubleClicked(int row, const juce::MouseEvent&) override { editRow(row); }
    void returnKeyPressed(int row) override { editRow(row); }
    juce::String getNameForRow(int row) override;
    void usePreset();
    void applyRow(std::size_t i, const std::string& label, const std::string& profile, double fullScaleG);

    MixerModel& model_;
    WorldView& world_;
    int chosen_ = -1;
    std::array<int, 3> widest_{}; // name, place and profile
    Module module_{model_, "New actuator",
                   "Drag it onto the field to attach it there; pressed, it is attached in the middle"};
    juce::ComboBox preset_, law_;
    juce::Slider exponent_;
    Caption presetName_{"Preset"}, lawName_{"Law"}, exponentName_{"Exponent"},
        hint_{"Drag a badge to move it; out of the field: detached."};
    juce::ToggleButton maps_{"Show on the field what it plays of a hit at each place"};
    juce::ListBox list_{"Actuators", this};
    std::unique_ptr<juce::TextButton> detach_, edit_;
};

} // namespace physvib
