// SPDX-License-Identifier: GPL-3.0-or-later
// Tabs of the output: actuators and panning (layout presets, panning law, exponent, gain maps); device,
// sample rate, block size and the resulting latency, additional sinks; and real-time statistics of the
// session: late and lost events, processor load of rendering. StatusTable is their table of values.
#pragma once
#include "Host/Views/WorldView.h"
#include "Mixer/Widgets/MixerWidgets.h"

namespace physvib {

/// A line of a StatusTable.
struct StatusRow {
    juce::String name, value;
    Shade shade = Shade::text;
    bool operator==(const StatusRow&) const = default;
};

/// List of names and values in columns, fewer where they are narrow; redraws only on changes.
class StatusTable final : public ReadOnlyText {
public:
    StatusTable(const juce::String& title, int maxColumns);

    void set(std::vector<StatusRow> rows);
    const std::vector<StatusRow>& rows() const noexcept { return rows_; }
    int heightFor(int width) const; ///< pixels that all rows need at that width
    void paint(juce::Graphics& g) override;

private:
    struct Layout {
        int columns = 1, nameWidth = 0, rows = 0, lines = 0; // lines: of the highest column
        std::vector<int> rowLines;                           // number of lines of each row
    };
    Layout layoutFor(int width) const;

    const int maxColumns_;
    std::vector<StatusRow> rows_;
};

/// Counters of session, device and board as a table. Message thread.
class TelemetryTab final : public Tab {
public:
    explicit TelemetryTab(MixerModel& model);
    void refresh(const MixerSnapshot& snapshot) override;
    int minHeight(int width) const override { return statusTable_.heightFor(width); }
    void resized() override { statusTable_.setBounds(getLocalBounds()); }

private:
    float medianLoad() const;

    MixerModel& model_;
    StatusTable statusTable_{"Telemetry", 2};
    std::deque<float> loads_; // load of recent blocks
    double updatedAtMs_ = 0.0;
};

/// Status of session, device and board as text; `medianLoad` is a share of a block's duration.
std::vector<StatusRow> telemetryRows(const MixerModel& model, const MixerSnapshot& snapshot,
                                     float medianLoad);

/// Choice of device, sinks, monitor, trigger output and OSC, with their state. Message thread.
class OutputTab final : public Tab {
public:
    explicit OutputTab(MixerModel& model);
    void mixChanged() override;
    void refresh(const MixerSnapshot& snapshot) override;
    void resized() override;
    static constexpr int titleHeight = 18, cellTitleHeight = 28, tableGap = 12;
    static constexpr int controlsHeight =
        titleHeight + rowHeight + 3 * (cellTitleHeight + rowHeight) + tableGap; // three rows of cells
    int minHeight(int width) const override { return controlsHeight + statusTable_.heightFor(width); }
    void visibilityChanged() override {
        if (isVisible() && !isScanned_) scan();
    }
    /// Sets the receiver HOST:PORT as if typed; empty: none.
    void sendHitsTo(const juce::String& receiver);

private:
    void scan();
    void open();

    MixerModel& model_;
    struct SinkRow { // an item of the list of outputs
        const SinkKind& kind;
        std::string address; ///< empty: the user types it
        bool isAvailable, isInUse;
    };
    void findSinks();
    void listSinks();
    void chooseSink(const SinkRow& row);
    void setSink(const SinkKind& kind, const std::string& address);
    void applyOsc();
    void chooseReceiver();
    void configureOsc(const OscChoice& choice, const juce::String& errorPrefix);
    void showOsc();
    void askForText(const juce::String& title, const juce::String& field, const juce::String& initial,
                    std::function<void(const juce::String&)> onAccept);
    std::vector<StatusRow> sinkStatusRows() const;
    juce::String oscText(Shade& tone) const;
    void fillMonitorLists();
    void chooseMonitor();
    juce::String actuatorLabelsAt(int output, bool marksMuted = false) const;
    juce::String monitorText() const;

    juce::ComboBox device_, rate_, block_, osc_, receiver_, phone_, monitor_, monitorLevel_, marker_;
    Caption deviceLabel_{"Outputs"}, rateLabel_{"Rate"}, blockLabel_{"Block of"},
        oscLabel_{"Messages by OSC"}, receiverLabel_{"Hits by OSC to"}, phoneLabel_{"A phone's top is"},
        monitorLabel_{"Monitor outputs"}, monitorLevelLabel_{"Monitor level"}, markerLabel_{"Trigger output"};
    std::unique_ptr<juce::TextButton> scan_;
    StatusTable statusTable_{"What follows from it", 1};
    std::vector<AudioDeviceName> devices_;
    std::string headphoneDevice_; // for the item Headphones: last used, else the first with two outputs
    std::vector<std::vector<SinkUnit>> sinks_; // available units of each kind, in the order of sinkKinds()
    std::vector<SinkRow> sinkRows_;
    std::ptrdiff_t readySinkCount_ = 0; // as last displayed
    bool isScanned_ = false;
};

/// List of actuators, layout presets and the panning law. Message thread.
class ActuatorsTab final : public Tab, private juce::ListBoxModel {
public:
    /// `world` shows the gain map of the actuator selected here.
    ActuatorsTab(MixerModel& model, WorldView& world);
    void mixChanged() override;
    void editRow(int actuator); ///< asks for name, profile and full scale
    void resized() override;
    int minHeight(int) const override { return 224; } // two rows of the list
    void visibilityChanged() override {
        world_.showGainMap(isVisible() && mapToggle_.getToggleState() ? selectedRow_ : -1);
    }

private:
    /// Actuator symbol that is dragged onto the field.
    struct NewActuatorButton final : AttachButton {
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
    void applyPreset();
    void applyRow(std::size_t row, const std::string& label, const std::string& profile, double fullScaleG);

    MixerModel& model_;
    WorldView& world_;
    int selectedRow_ = -1;
    std::array<int, 3> columnWidths_{}; // name, place and profile
    NewActuatorButton newActuator_{
        model_, "New actuator",
        "Drag it onto the field to attach it there; pressed, it is attached in the middle"};
    juce::ComboBox preset_, law_;
    juce::Slider exponent_;
    Caption presetLabel_{"Preset"}, lawLabel_{"Law"}, exponentLabel_{"Exponent"},
        hint_{"Drag a badge to move it; out of the field: detached."};
    juce::ToggleButton mapToggle_{"Show on the field what it plays of a hit at each place"};
    juce::ListBox list_{"Actuators", this};
    std::unique_ptr<juce::TextButton> detach_, edit_;
};

} // namespace physvib
