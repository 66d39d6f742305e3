// SPDX-License-Identifier: GPL-3.0-or-later
// The output of the mixer: the chosen device with its additional sinks and errors, who uses which of its
// outputs, and the vibration exposure.
#pragma once
#include "Live/Devices/AudioOutput.h"
#include "Live/Documents/Mix.h"
#include "Live/Rig/Rig.h"
#include "Mixer/Model/MixerSignals.h"
#include "Scene/LayoutFile.h"
#include "Stimuli/Stimulus.h"
#include <cstddef>
#include <functional>
#include <juce_core/juce_core.h>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace physvib {

class MixerModel;

constexpr const char* noDeviceTitle = "No device: seen, not felt"; ///< in lists of devices

/// Audio for ears and machines (monitor, noise, markers), on outputs without an actuator. Message thread.
class MixerListening {
public:
    /// All references outlive it. Requested settings are stored in `choice`, and `onChange` is called when
    /// they change.
    MixerListening(AudioOutput& output, const Mix& mix, DeviceChoice& choice, std::function<void()> onChange)
        : output_{output}
        , mix_{mix}
        , choice_{choice}
        , onChange_{std::move(onChange)} {}

    const ListeningSettings& settings() const noexcept { return sent_; } ///< of the output

    /// Sets the outputs of the contact sound (left and right), or the marker output. Outputs with an actuator
    /// are not allowed. Empty, or an error, and then nothing changes.
    std::string monitor(std::vector<int> outputs, double db);
    std::string mark(int output);

    /// Starts a study: noise on headphones, and no monitor, which would reveal the stimuli by ear. Result as
    /// monitor().
    std::string hear(const ListeningSettings& ofStudy);
    void endStudy();

    /// Settings of a study only; applied first, because the actuators have priority.
    const ListeningSettings& ofStudyOnly() { return sent_ = ofStudy_.value_or(ListeningSettings{}); }
    std::string hearWanted(); ///< then applies the settings for which there are outputs

    bool isFree(int output) const;

private:
    ListeningSettings wanted() const;
    std::string listen(const ListeningSettings& wanted, const DeviceChoice& choice);

    AudioOutput& output_;
    const Mix& mix_;
    DeviceChoice& choice_;
    std::function<void()> onChange_;
    std::optional<ListeningSettings> ofStudy_;
    ListeningSettings sent_;
};

/// Message thread.
class MixerDevice {
public:
    /// Both references outlive it. `onChange` as for MixerListening.
    MixerDevice(Rig& rig, AudioDrivers drivers, const Mix& mix, std::function<void()> onChange)
        : rig_{rig}
        , drivers_{std::move(drivers)}
        , mix_{mix}
        , listening_{rig.output(), mix, choice_, std::move(onChange)} {}

    /// Opens a device. Empty, or an error, which troubles() has too.
    std::string open(const DeviceChoice& choice);

    /// The chosen device and the available ones. outputs(): number of its outputs.
    const DeviceChoice& choice() const noexcept { return choice_; }
    const AudioDrivers& drivers() const noexcept { return drivers_; }
    int outputs() const { return rig_.output().deviceOutputs(); }
    bool isNone() const; ///< what is open is no device: what happens is seen alone
    /// False: it has no output that plays, so nothing of it is felt. Of no device at all, all are seen.
    bool isPlayed(std::size_t actuator) const;

    MixerListening& listening() noexcept { return listening_; }
    const MixerListening& listening() const noexcept { return listening_; }

    double outputLatencySeconds() const noexcept {
        const int rateHz = rig_.output().sampleRateHz();
        return rateHz > 0 ? static_cast<double>(rig_.session().timeline().outputLatencyFrames()) / rateHz
                          : 0.0;
    }

    /// Applies changed actuators or output assignments of the mixer state. Empty, or why that failed.
    std::string assign();

    /// Name of a sink that cannot play clips; empty if all can.
    juce::String withoutClips() const;
    /// Called if the choice has other sinks. They change the output latency, so the session must be
    /// restarted.
    std::function<void(const DeviceChoice&)> onSinksWanted;

    /// Checks the sinks; to be called often.
    void maintain();
    std::vector<RigTrouble> troubles() const; ///< see Rig
    /// Why the device, or else a sink, does not play, whatever message is shown; empty: it plays.
    juce::String trouble() const;

    std::vector<int> outputMap() const; ///< of the strips

private:
    Rig& rig_;
    AudioDrivers drivers_;
    const Mix& mix_;
    DeviceChoice choice_;
    MixerListening listening_;
    double maintainedAtMs_ = 0.0;
};

/// Sets the strips' outputs to those that are played, by actuator. Any thread.
void showPlayedOutputs(const std::vector<int>& played, std::span<Strip> strips);

/// Leaves to listeners and measuring devices what they use: strips from number `first` on, which are new, get
/// other outputs. Headphones have two. Returns the strips without one. Any thread.
std::vector<std::size_t> placeNew(const DeviceChoice& choice, std::span<Strip> strips, std::size_t first);

/// If the layout has more actuators than `outputs`, replaces it by a preset that fits. A Pico gets its own
/// preset, unless the user has chosen a layout. Message thread.
void fitLayoutTo(int outputs, Mix& mix, std::string_view device = {});

/// Opens a device as headphones: the first actuator is heard left and the second right, at the level at which
/// a monitor begins, or lower. Result as MixerModel::open(). Message thread.
/// `before`: the outputs that the strips get back after them; none: those of now.
std::string useHeadphones(MixerModel& model, DeviceChoice choice,
                          std::optional<std::vector<int>> before = {});

/// After headphones: strips that are as useHeadphones() left them get the outputs of before, if the device
/// has them, and those that came meanwhile a free one; the level stays low. takeOffHeadphones(): strips from
/// number `first` on; any thread. Message thread.
void takeOffHeadphones(const DeviceChoice& choice, int outputs, std::span<Strip> strips,
                       std::size_t first = 0);
void leaveHeadphones(MixerModel& model, const DeviceChoice& ears);

/// Reports strips for which headphones have no output, with a button that leaves two actuators. Message
/// thread.
void reportNoEar(MixerModel& model, const std::vector<std::size_t>& strips);
constexpr const char *noEarLabel = "ears", *noOutputLabel = "outputs"; ///< of that message, and the next

/// Reports strips that lost their output to another one, with a button that gives them free outputs. Message
/// thread only.
void reportWithout(MixerModel& model, const std::vector<std::size_t>& strips);

/// Vibration exposure of the mixer's output in g, from sums in full scales and the current layout. Actuators
/// are treated like the axes in ISO 5349-1, as if all were in one hand: their squares add up. Message thread.
class MixerExposure {
public:
    explicit MixerExposure(AudioOutput& output)
        : output_{output} {}

    /// Sets the layout of the channels from now on.
    void use(const LayoutDescription& layout);

    /// Adds the output since the last call. Call it often, and before the layout changes.
    void update();

    /// Adds earlier exposure.
    void goOnFrom(double squareGSeconds) noexcept { squareGSeconds_ += squareGSeconds; }
    double squareGSeconds() const noexcept { return squareGSeconds_; } ///< weighted, of today
    /// A(8), if there was no other exposure that day
    double daily() const noexcept { return dailyExposure(squareGSeconds_); }

private:
    AudioOutput& output_;
    std::array<double, limits::maxEnchanters> fullScaleG_{};
    ExposureSums sums_;
    double squareGSeconds_ = 0.0;
};

} // namespace physvib
