// SPDX-License-Identifier: GPL-3.0-or-later
// The output of the mixer: the chosen device with its sinks (MixerDevice), its outputs for headphones and
// trigger boxes (MixerListening), and the vibration exposure (MixerExposure). MixerSignals reads the samples
// for display: peaks, the last second, its spectrum, and the whole scene run.
#pragma once
#include "Core/Limits.h"
#include "Live/Devices/AudioOutput.h"
#include "Live/Devices/DeviceMeters.h"
#include "Live/Devices/SinkTable.h"
#include "Live/Documents/Mix.h"
#include "Live/Rig/Rig.h"
#include "Live/Session/SessionSetup.h"
#include "Mixer/Model/MixerMessages.h"
#include "Pictures/WaveformEnvelope.h"
#include "Scene/LayoutFile.h"
#include "Stimuli/Stimulus.h"
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace physvib {

/// State of session and device for display; `hits` are those played since the previous snapshot.
struct MixerSnapshot {
    std::vector<BodyPose> poses;
    std::int64_t posesNs = 0;   ///< session time of the poses
    std::int64_t latencyNs = 0; ///< output latency after that time
    std::vector<CollisionEvent> hits;
    ChannelMeters meters;
    std::array<float, limits::maxActuators> heldPeaks{}; ///< peak hold values
    float masterPeak = 0.0f;                             ///< after the master level
    double dailyExposure = 0.0;                          ///< A(8) of the mixer's output today, m/s^2
    SessionStatus session;
    AudioOutputStatus device;
};

struct MixerHistory;

/// How a session begins.
struct MixerStart {
    bool isSilent = false;                   ///< the output is muted until the user lifts the silence
    bool isPaused = false;                   ///< the world stands still
    std::shared_ptr<MixerHistory> history{}; ///< undo steps of the previous session; null: none
};

/// The requested device.
struct DeviceChoice {
    std::string name;     ///< type:name
    int sampleRateHz = 0; ///< 0: device default
    int blockFrames = 0;
    std::vector<SinkName> sinks{};       ///< additional sinks
    std::vector<int> monitorOutputs{};   ///< its outputs for left and right ear, from 0; empty: no monitor
    double monitorDb = defaultContactDb; ///< as ListeningSettings::contactDb
    int markerOutput = -1;               ///< its marker output, from 0; -1: none
    bool isHeadphones = false;           ///< its first two outputs are headphones (L, R), not actuators
    std::vector<int> outputsBeforeHeadphones{}; ///< the outputs that the strips had before them; -1: none

    static constexpr int earCount = 2;
    /// Outputs of listeners and measuring devices, which are not given to actuators.
    std::vector<int> reservedOutputs() const {
        std::vector<int> outputs = monitorOutputs;
        outputs.push_back(markerOutput);
        return outputs;
    }
    /// Name of an output, counted from 0, as strips show it.
    std::string outputName(int output) const {
        if (isHeadphones && output < earCount) return output == 0 ? "L" : "R";
        return "out " + std::to_string(output + 1);
    }

    /// Address of the requested sink of that kind; empty: none.
    std::string sinkAddress(const SinkKind& kind) const {
        for (const SinkName& sink : sinks)
            if (sink.kind == kind.name) return sink.address;
        return {};
    }
    /// Sets the sink of that kind; empty: none.
    void setSink(const SinkKind& kind, const std::string& address) {
        std::erase_if(sinks, [&](const SinkName& sink) { return sink.kind == kind.name; });
        if (!address.empty()) sinks.push_back({std::string{kind.name}, address});
    }
};

/// The smallest range that contains both. Any thread.
inline SampleRange unite(const SampleRange& a, const SampleRange& b) {
    return {std::min(a.lowest, b.lowest), std::max(a.highest, b.highest)};
}

/// The last second of every channel, as minimum and maximum of each scope column. Message thread.
class ScopeTrace {
public:
    static constexpr int columnCount = 800;
    static constexpr double seconds = 1.0;

    ScopeTrace() {
        for (auto& lane : lanes_) lane.assign(columnCount, {});
    }

    /// Restarts the current column.
    void setRate(int sampleRateHz) {
        framesPerColumn_ = std::max(1, static_cast<int>(seconds * sampleRateHz / columnCount));
        framesInColumn_ = 0;
    }

    /// Appends frames of the first `channelCount` channels.
    void add(const float* const* channels, int channelCount, int frames) {
        for (int done = 0; done < frames;) {
            const int part = std::min(frames - done, framesPerColumn_ - framesInColumn_);
            for (int j = 0; j < channelCount; ++j) {
                const auto [low, high] = std::minmax_element(channels[j] + done, channels[j] + done + part);
                SampleRange& column = nth(nth(lanes_, j), newestColumn_);
                column = framesInColumn_ == 0 ? SampleRange{*low, *high} : unite(column, {*low, *high});
            }
            done += part;
            framesInColumn_ += part;
            if (framesInColumn_ < framesPerColumn_) continue;
            framesInColumn_ = 0;
            newestColumn_ = (newestColumn_ + 1) % columnCount;
            ++columnsBegun_;
        }
    }

    /// Column `index` of a channel; 0 is the oldest.
    SampleRange columnAt(int channel, int index) const {
        return nth(nth(lanes_, channel), (newestColumn_ + 1 + index) % columnCount);
    }

    /// Minimum and maximum at pixel `x` of a trace that is `width` pixels wide, over the pixel's columns and
    /// the one before: a single column may hold only the upper or lower half of a wave of 400 Hz.
    SampleRange pixelRange(int channel, int x, int width) const {
        const auto toColumn = [width](int pixel) { return pixel * (columnCount - 1) / std::max(1, width); };
        const int first = toColumn(x), last = std::max(first, toColumn(x + 1) - 1);
        SampleRange range = columnAt(channel, first);
        for (int k = std::max(0, first - 1); k <= last; ++k) range = unite(range, columnAt(channel, k));
        return range;
    }

    /// Number of columns begun so far.
    std::int64_t columnsBegun() const noexcept { return columnsBegun_; }

private:
    std::array<std::vector<SampleRange>, limits::maxActuators> lanes_;
    int framesPerColumn_ = 60, newestColumn_ = 0, framesInColumn_ = 0;
    std::int64_t columnsBegun_ = 0;
};

/// Recent samples of every channel at a rate that suffices for spectra of vibration. Message thread.
class SpectrumTrace {
public:
    /// A quarter of a second, which gives a resolution of 8 Hz.
    static constexpr int windowSize = 2048;
    static constexpr int minRateHz = 8000; ///< lowest rate of the samples; sufficient for 1 kHz

    SpectrumTrace() { setRate(48000); }
    /// Clears the buffers.
    void setRate(int sampleRateHz);
    /// Appends frames of the first `channelCount` channels.
    void add(const float* const* channels, int channelCount, int frames);
    /// Samples of the last window, oldest first; empty if none reaches 1e-4 of full scale (not perceptible).
    std::vector<double> windowSamples(int channel) const;
    double rateHz() const noexcept { return rateHz_; } ///< of these samples

private:
    struct Lane {
        std::vector<float> ring;
        float sum = 0.0f;
    };
    std::vector<Lane> lanes_;
    double rateHz_ = minRateHz;
    int framesPerSample_ = 1, writeIndex_ = 0, framesSummed_ = 0;
};

/// Waveform of a whole scene run, as minimum and maximum of each column over the scene's time. When the
/// columns are full, their duration doubles. Message thread.
class RunTrace {
public:
    static constexpr std::size_t columnCount = 1024;
    static constexpr double initialColumnSeconds = 0.01; ///< initial duration of a column

    RunTrace() { begin(0); }

    /// Starts another scene run.
    void begin(std::size_t runNumber) {
        runNumber_ = runNumber;
        columnSeconds_ = initialColumnSeconds;
        seconds_ = 0.0;
        for (auto& lane : lanes_) lane.assign(columnCount, {});
    }
    std::size_t runNumber() const noexcept { return runNumber_; }

    /// Sets the scene time of the frames that follow.
    void seek(double seconds) { seconds_ = std::max(0.0, seconds); }

    /// Appends frames of the first `channelCount` channels, which last `sceneSeconds` of scene time.
    void add(const float* const* channels, int channelCount, int frames, double sceneSeconds) {
        for (int done = 0; done < frames;) {
            while (seconds_ >= columnSeconds_ * static_cast<double>(columnCount)) doubleColumns();
            const double frameSeconds = sceneSeconds / frames;
            const int part = frameSeconds > 0.0 ? std::clamp(static_cast<int>(columnSeconds_ / frameSeconds),
                                                             1, frames - done)
                                                : frames - done;
            const auto columnIndex = static_cast<std::size_t>(seconds_ / columnSeconds_);
            for (std::size_t j = 0; j < static_cast<std::size_t>(channelCount); ++j) {
                const auto [low, high] = std::minmax_element(channels[j] + done, channels[j] + done + part);
                SampleRange& column = lanes_[j][columnIndex];
                column = unite(column, {*low, *high});
            }
            done += part;
            seconds_ += part * frameSeconds;
        }
    }

    double seconds() const noexcept { return seconds_; } ///< scene time so far

    /// Minimum and maximum over the columns of [fromSeconds, toSeconds).
    SampleRange range(int channel, double fromSeconds, double toSeconds) const {
        SampleRange all;
        const auto first = static_cast<std::size_t>(std::max(0.0, fromSeconds / columnSeconds_));
        for (std::size_t i = first;
             i < columnCount && (i == first || static_cast<double>(i) * columnSeconds_ < toSeconds); ++i) {
            const SampleRange& column = nth(lanes_, channel)[i];
            all = unite(all, column);
        }
        return all;
    }

private:
    void doubleColumns() {
        columnSeconds_ *= 2.0;
        for (auto& lane : lanes_) {
            for (std::size_t i = 0; i < columnCount / 2; ++i) lane[i] = unite(lane[2 * i], lane[2 * i + 1]);
            std::fill(lane.begin() + columnCount / 2, lane.end(), SampleRange{});
        }
    }

    std::array<std::vector<SampleRange>, limits::maxActuators> lanes_;
    std::size_t runNumber_ = 0;
    double columnSeconds_ = initialColumnSeconds, seconds_ = 0.0;
};

/// Reads the samples of the output for display. Message thread.
class MixerSignals {
public:
    SignalTap& tap() noexcept { return tap_; } ///< filled by the output
    const ScopeTrace& scopeTrace() const noexcept { return scope_; }
    const SpectrumTrace& spectrumTrace() const noexcept { return spectrum_; }
    const RunTrace& runTrace() const noexcept { return run_; }
    std::uint64_t framesLost() const noexcept { return tap_.framesLost(); }

    void setRate(int sampleRateHz);

    /// Sets the scene-run time of the samples read next; the world runs `slowness` times slower (0: paused).
    void setSceneTime(std::size_t runNumber, double seconds, int slowness);

    /// Updates peaks and holds of `snapshot`, which must be the same object each time. Returns the loudest
    /// peak of the first `actuators`. Signals of those that are not played are shown as zeros.
    using PlayedFlags = std::array<bool, limits::maxActuators>;
    float updatePeaks(MixerSnapshot& snapshot, int actuators, const PlayedFlags& isPlayed);

private:
    void addBlock(const float* const* block, int frames, MixerSnapshot& snapshot, int actuators);

    SignalTap tap_{limits::maxActuators, 1 << 14};
    ScopeTrace scope_;
    SpectrumTrace spectrum_;
    RunTrace run_;
    double sceneSecondsPerFrame_ = 0.0;
    int sampleRateHz_ = 48000;
    std::array<double, limits::maxActuators> heldAtMs_{};
    double readAtMs_ = 0.0;
    std::vector<float> zeros_;
};

class MixerModel;

constexpr const char* noDeviceTitle = "No device: seen, not felt"; ///< in lists of devices

/// Signals on outputs without an actuator: contact sound on headphones (the monitor), noise that masks the
/// actuators' own sound, and pulses at onsets for trigger boxes (the markers). Message thread.
class MixerListening {
public:
    /// All references outlive it. Requested settings are stored in `choice`, and `onChange` is called when
    /// they change.
    MixerListening(AudioOutput& output, const Mix& mix, DeviceChoice& choice, std::function<void()> onChange)
        : output_{output}
        , mix_{mix}
        , choice_{choice}
        , onChange_{std::move(onChange)} {}

    const ListeningSettings& settings() const noexcept { return appliedSettings_; } ///< in use

    /// Sets the outputs of the contact sound (left and right), or the marker output. Outputs with an actuator
    /// are not allowed. Empty, or an error, and then nothing changes.
    std::string setMonitor(std::vector<int> outputs, double levelDb);
    std::string setMarker(int output);

    /// Starts a study: noise on headphones, and no monitor, which would reveal the stimuli by ear. Empty, or
    /// an error.
    std::string beginStudy(const ListeningSettings& studySettings);
    void endStudy();

    /// Drops monitor and markers until applyRequested(): actuators have priority. Returns the study settings.
    const ListeningSettings& resetToStudySettings() {
        return appliedSettings_ = studySettings_.value_or(ListeningSettings{});
    }
    std::string applyRequested(); ///< applies what has free outputs; empty, or an error

    bool isFree(int output) const; ///< the device has it, and no strip uses it

private:
    ListeningSettings requestedSettings() const;
    std::string applyAndStore(const ListeningSettings& requested, const DeviceChoice& choice);

    AudioOutput& output_;
    const Mix& mix_;
    DeviceChoice& choice_;
    std::function<void()> onChange_;
    std::optional<ListeningSettings> studySettings_;
    ListeningSettings appliedSettings_;
};

/// The chosen device, its sinks and the outputs of the strips. Message thread.
class MixerDevice {
public:
    /// Both references outlive it. `onChange` as for MixerListening.
    MixerDevice(Rig& rig, AudioDrivers drivers, const Mix& mix, std::function<void()> onChange)
        : rig_{rig}
        , drivers_{std::move(drivers)}
        , mix_{mix}
        , listening_{rig.output(), mix, choice_, std::move(onChange)} {}

    /// Opens a device. Empty, or an error, which Rig::errors() has too.
    std::string open(const DeviceChoice& choice);

    /// The chosen device, the available ones, and the number of outputs of the open one.
    const DeviceChoice& choice() const noexcept { return choice_; }
    const AudioDrivers& drivers() const noexcept { return drivers_; }
    int outputCount() const { return rig_.output().deviceOutputs(); }
    bool hasNoDevice() const; ///< no real device is open, so nothing can be felt
    /// Whether the actuator has an output that plays. Without a device all count as played, for display.
    bool isPlayed(std::size_t actuator) const;

    MixerListening& listening() noexcept { return listening_; }
    const MixerListening& listening() const noexcept { return listening_; }

    double outputLatencySeconds() const noexcept {
        const int rateHz = rig_.output().sampleRateHz();
        return rateHz > 0 ? static_cast<double>(rig_.session().timeline().outputLatencyFrames()) / rateHz
                          : 0.0;
    }

    /// Applies changed actuators or output assignments of the mixer state. Empty, or an error.
    std::string assignOutputs();

    juce::String sinkWithoutClips() const; ///< name of a sink that cannot play clips; empty: all can
    /// Called if the choice has other sinks. They change the output latency, so the session must be
    /// restarted.
    std::function<void(const DeviceChoice&)> onSinksRequested;

    /// Checks the sinks; to be called often.
    void maintain();
    /// Why the device, or else a sink, does not play; empty: it plays. It may differ from the message line.
    juce::String error() const;

    std::vector<int> outputMap() const; ///< output of each strip; -1: none

private:
    Rig& rig_;
    AudioDrivers drivers_;
    const Mix& mix_;
    DeviceChoice choice_;
    MixerListening listening_;
    double maintainedAtMs_ = 0.0;
};

/// Sets the strips' outputs to those that are played, by actuator. Any thread.
void setStripOutputs(const std::vector<int>& outputs, std::span<Strip> strips);

/// Gives new strips, from number `firstNew` on, outputs that no listener and no measuring device uses;
/// headphones have two. Returns the strips for which there is none. Any thread.
std::vector<std::size_t> assignNewStrips(const DeviceChoice& choice, std::span<Strip> strips,
                                         std::size_t firstNew);

/// If the layout has more actuators than outputs, replaces it by a preset that fits. A Pico gets its own
/// preset, unless the user has chosen a layout. Message thread.
void fitLayoutTo(int outputCount, Mix& mix, std::string_view device = {});

/// Opens a device as headphones: the first actuator is heard left and the second right, at the level at which
/// a monitor begins, or lower. Result as MixerModel::open(). Message thread.
/// `oldOutputs`: those that leaveHeadphones() restores; none: the present ones.
std::string openHeadphones(MixerModel& model, DeviceChoice choice,
                           std::optional<std::vector<int>> oldOutputs = {});

/// Undoes the outputs that openHeadphones() has set: strips get back their former outputs if the device has
/// them, and strips added since then get free ones; the level stays low. restoreOutputs() does this from
/// strip `first` on, on any thread; leaveHeadphones() does it for the model, on the message thread.
void restoreOutputs(const DeviceChoice& choice, int outputCount, std::span<Strip> strips,
                    std::size_t first = 0);
void leaveHeadphones(MixerModel& model, const DeviceChoice& headphones);

/// Reports strips for which headphones have no output, with a button that leaves two. Message thread.
void reportNoHeadphoneOutput(MixerModel& model, const std::vector<std::size_t>& strips);
constexpr const char *noHeadphoneOutputLabel = "ears", *noOutputLabel = "outputs"; ///< message labels

/// Reports strips that lost their output to another one, with a button that gives them free outputs. Message
/// thread only.
void reportNoOutput(MixerModel& model, const std::vector<std::size_t>& strips);

/// Vibration exposure of the mixer's output in g, from sums in full scales and the current layout. Actuators
/// are treated like the axes in ISO 5349-1, as if all were in one hand: their squares add up. Message thread.
class MixerExposure {
public:
    explicit MixerExposure(AudioOutput& output)
        : output_{output} {}

    /// Sets the layout of the channels from now on.
    void setLayout(const LayoutDescription& layout);

    /// Adds the output since the last call. Call it often, and before the layout changes.
    void update();

    /// Adds the exposure of the day before this session, frequency-weighted.
    void addEarlierExposure(double squareGSeconds) noexcept { squareGSeconds_ += squareGSeconds; }
    double squareGSeconds() const noexcept { return squareGSeconds_; } ///< weighted, g^2 s of today
    /// A(8) in m/s^2 of today; exposure from other sources is not included.
    double dailyA8() const noexcept { return dailyExposure(squareGSeconds_); }

private:
    AudioOutput& output_;
    std::array<double, limits::maxActuators> fullScaleG_{};
    ExposureSums lastSums_;
    double squareGSeconds_ = 0.0;
};

} // namespace physvib
