// SPDX-License-Identifier: GPL-3.0-or-later
// The output of the mixer: the chosen device with its sinks (MixerDevice), its outputs for ears and triggers
// (MixerListening), and the vibration exposure (MixerExposure). MixerSignals reads the samples for display:
// peaks, the last second, its spectrum, and the whole scene run.
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

/// Snapshot for display; lists hold what is new since the last one.
struct MixerMoment {
    std::vector<BodyPose> poses;
    std::int64_t sessionNs = 0; ///< of the poses
    std::int64_t aheadNs = 0;   ///< output latency after that time
    std::vector<CollisionEvent> hits;
    ChannelMeters meters;
    std::array<float, limits::maxEnchanters> holds{}; ///< peak hold values
    float masterPeak = 0.0f;                          ///< after the master level
    double dailyExposure = 0.0;                       ///< A(8) of the mixer's output today, m/s^2
    SessionStatus session;
    AudioOutputStatus device;
};

struct MixerHistory;

/// How a session begins.
struct MixerStart {
    bool isSilent = false;                   ///< nothing is felt until the silence is lifted
    bool isPaused = false;                   ///< the world stands still
    std::shared_ptr<MixerHistory> history{}; ///< of the session before; null: none
};

/// The requested device.
struct DeviceChoice {
    std::string name;     ///< type:name
    int sampleRateHz = 0; ///< 0: device default
    int blockFrames = 0;
    std::vector<SinkName> sinks{};    ///< additional sinks
    std::vector<int> monitor{};       ///< its outputs for left and right ear, from 0; empty: no monitor
    double monitorDb = safeContactDb; ///< as ListeningSettings::contactDb
    int marker = -1;                  ///< its marker output, from 0; -1: none
    bool isHeadphones = false;        ///< its first two outputs are headphones (L, R), not actuators
    std::vector<int> beforeEars{};    ///< the outputs that the strips had before them; -1: none

    static constexpr int ears = 2;
    /// Outputs of listeners and measuring devices, which are not given to actuators.
    std::vector<int> inUse() const {
        std::vector<int> outputs = monitor;
        outputs.push_back(marker);
        return outputs;
    }
    /// Name of an output, counted from 0, as strips show it.
    std::string nameOf(int output) const {
        if (isHeadphones && output < ears) return output == 0 ? "L" : "R";
        return "out " + std::to_string(output + 1);
    }

    /// Address of the requested sink of that kind; empty: none.
    std::string placeOf(const SinkKind& kind) const {
        for (const SinkName& sink : sinks)
            if (sink.kind == kind.name) return sink.where;
        return {};
    }
    /// Sets the sink of that kind; empty: none.
    void want(const SinkKind& kind, const std::string& where) {
        std::erase_if(sinks, [&](const SinkName& sink) { return sink.kind == kind.name; });
        if (!where.empty()) sinks.push_back({std::string{kind.name}, where});
    }
};

/// The smallest range that contains both. Any thread.
inline SampleRange united(const SampleRange& a, const SampleRange& b) {
    return {std::min(a.lowest, b.lowest), std::max(a.highest, b.highest)};
}

/// The last second of every channel, as minimum and maximum of each scope column. Message thread.
class ScopeTrace {
public:
    static constexpr int columns = 800;
    static constexpr double seconds = 1.0;

    ScopeTrace() {
        for (auto& lane : lanes_) lane.assign(columns, {});
    }

    /// Restarts the current column.
    void setRate(int sampleRateHz) {
        framesPerColumn_ = std::max(1, static_cast<int>(seconds * sampleRateHz / columns));
        filled_ = 0;
    }

    /// Appends frames of the first `count` channels.
    void add(const float* const* channels, int count, int frames) {
        for (int done = 0; done < frames;) {
            const int part = std::min(frames - done, framesPerColumn_ - filled_);
            for (int j = 0; j < count; ++j) {
                const auto [low, high] = std::minmax_element(channels[j] + done, channels[j] + done + part);
                SampleRange& column = nth(nth(lanes_, j), newest_);
                column = filled_ == 0 ? SampleRange{*low, *high} : united(column, {*low, *high});
            }
            done += part;
            filled_ += part;
            if (filled_ < framesPerColumn_) continue;
            filled_ = 0;
            newest_ = (newest_ + 1) % columns;
            ++begun_;
        }
    }

    /// Column `index` of a channel; 0 is the oldest.
    SampleRange at(int channel, int index) const {
        return nth(nth(lanes_, channel), (newest_ + 1 + index) % columns);
    }

    /// Minimum and maximum at pixel `x` of a trace that is `width` pixels wide: of the pixel's columns and
    /// the one before, since a column is half a wave of 400 Hz.
    SampleRange shown(int channel, int x, int width) const {
        const auto columnOf = [width](int pixel) { return pixel * (columns - 1) / std::max(1, width); };
        const int first = columnOf(x), last = std::max(first, columnOf(x + 1) - 1);
        SampleRange range = at(channel, first);
        for (int k = std::max(0, first - 1); k <= last; ++k) range = united(range, at(channel, k));
        return range;
    }

    /// Number of columns begun so far.
    std::int64_t columnsBegun() const noexcept { return begun_; }

private:
    std::array<std::vector<SampleRange>, limits::maxEnchanters> lanes_;
    int framesPerColumn_ = 60, newest_ = 0, filled_ = 0;
    std::int64_t begun_ = 0;
};

/// Recent samples of every channel at a rate that suffices for spectra of vibration. Message thread.
class SpectrumTrace {
public:
    /// A quarter of a second, which gives a resolution of 8 Hz.
    static constexpr int window = 2048;
    static constexpr int keptRateHz = 8000; ///< at least; enough for 1 kHz at an eighth of the cost

    SpectrumTrace() { setRate(48000); }
    /// Clears the buffers.
    void setRate(int sampleRateHz);
    /// Appends frames of the first `count` channels.
    void add(const float* const* channels, int count, int frames);
    /// The last window, oldest first; empty if nothing in it can be felt.
    std::vector<double> recent(int channel) const;
    double rateHz() const noexcept { return keptRateHz_; } ///< of these samples

private:
    struct Lane {
        std::vector<float> kept;
        float sum = 0.0f;
    };
    std::vector<Lane> lanes_;
    double keptRateHz_ = keptRateHz;
    int framesPerSample_ = 1, newest_ = 0, summed_ = 0;
};

/// Waveform of a whole scene run, as minimum and maximum of each column over the scene's time. When the
/// columns are full, their duration doubles. Message thread.
class RunTrace {
public:
    static constexpr std::size_t columns = 1024;
    static constexpr double firstSeconds = 0.01; ///< initial duration of a column

    RunTrace() { begin(0); }

    /// Starts another scene run.
    void begin(std::size_t run) {
        run_ = run;
        columnSeconds_ = firstSeconds;
        seconds_ = 0.0;
        for (auto& lane : lanes_) lane.assign(columns, {});
    }
    std::size_t run() const noexcept { return run_; }

    /// Sets the scene time of the frames that follow.
    void moveTo(double seconds) { seconds_ = std::max(0.0, seconds); }

    /// Appends frames of the first `count` channels, which last `sceneSeconds` of scene time.
    void add(const float* const* channels, int count, int frames, double sceneSeconds) {
        for (int done = 0; done < frames;) {
            while (seconds_ >= columnSeconds_ * static_cast<double>(columns)) widen();
            const double perFrame = sceneSeconds / frames;
            const int part = perFrame > 0.0
                                 ? std::clamp(static_cast<int>(columnSeconds_ / perFrame), 1, frames - done)
                                 : frames - done;
            const auto at = static_cast<std::size_t>(seconds_ / columnSeconds_);
            for (std::size_t j = 0; j < static_cast<std::size_t>(count); ++j) {
                const auto [low, high] = std::minmax_element(channels[j] + done, channels[j] + done + part);
                SampleRange& column = lanes_[j][at];
                column = united(column, {*low, *high});
            }
            done += part;
            seconds_ += part * perFrame;
        }
    }

    double seconds() const noexcept { return seconds_; } ///< scene time so far

    /// Minimum and maximum over the columns of [from, to).
    SampleRange range(int channel, double from, double to) const {
        SampleRange all;
        const auto first = static_cast<std::size_t>(std::max(0.0, from / columnSeconds_));
        for (std::size_t i = first;
             i < columns && (i == first || static_cast<double>(i) * columnSeconds_ < to); ++i) {
            const SampleRange& column = nth(lanes_, channel)[i];
            all = united(all, column);
        }
        return all;
    }

private:
    void widen() {
        columnSeconds_ *= 2.0;
        for (auto& lane : lanes_) {
            for (std::size_t i = 0; i < columns / 2; ++i) lane[i] = united(lane[2 * i], lane[2 * i + 1]);
            std::fill(lane.begin() + columns / 2, lane.end(), SampleRange{});
        }
    }

    std::array<std::vector<SampleRange>, limits::maxEnchanters> lanes_;
    std::size_t run_ = 0;
    double columnSeconds_ = firstSeconds, seconds_ = 0.0;
};

/// Reads the samples of the output for display. Message thread.
class MixerSignals {
public:
    SignalTap& tap() noexcept { return tap_; } ///< filled by the output
    const ScopeTrace& scope() const noexcept { return scope_; }
    const SpectrumTrace& spectrum() const noexcept { return spectrum_; }
    const RunTrace& run() const noexcept { return run_; }
    std::uint64_t framesLost() const noexcept { return tap_.framesLost(); }

    void setRate(int sampleRateHz);

    /// Sets the scene-run time of the samples read next; the world runs `slowness` times slower (0: paused).
    void follow(std::size_t run, double seconds, int slowness);

    /// Updates peaks and holds of `moment`, which must be the same object each time. Returns the loudest peak
    /// of the first `enchanters`. Signals of those that are not played are shown as zeros.
    using Played = std::array<bool, limits::maxEnchanters>;
    float read(MixerMoment& moment, int enchanters, const Played& played);

private:
    void measure(const float* const* block, int frames, MixerMoment& moment, int enchanters);

    SignalTap tap_{limits::maxEnchanters, 1 << 14};
    ScopeTrace scope_;
    SpectrumTrace spectrum_;
    RunTrace run_;
    double scenePerFrame_ = 0.0; // in seconds
    int sampleRateHz_ = 48000;
    std::array<double, limits::maxEnchanters> heldAtMs_{};
    double readAtMs_ = 0.0;
    std::vector<float> zeros_;
};

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

    /// Drops monitor and markers until hearWanted(), because actuators have priority. Returns what remains.
    const ListeningSettings& ofStudyOnly() { return sent_ = ofStudy_.value_or(ListeningSettings{}); }
    std::string hearWanted(); ///< applies what outputs are free for; empty, or an error

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

/// The chosen device, its sinks and the outputs of the strips. Message thread.
class MixerDevice {
public:
    /// Both references outlive it. `onChange` as for MixerListening.
    MixerDevice(Rig& rig, AudioDrivers drivers, const Mix& mix, std::function<void()> onChange)
        : rig_{rig}
        , drivers_{std::move(drivers)}
        , mix_{mix}
        , listening_{rig.output(), mix, choice_, std::move(onChange)} {}

    /// Opens a device. Empty, or an error, which Rig::troubles() has too.
    std::string open(const DeviceChoice& choice);

    /// The chosen device, the available ones, and the number of outputs of the open one.
    const DeviceChoice& choice() const noexcept { return choice_; }
    const AudioDrivers& drivers() const noexcept { return drivers_; }
    int outputs() const { return rig_.output().deviceOutputs(); }
    bool isNone() const; ///< no real device is open, so nothing can be felt
    /// Whether the actuator has an output that plays. Without a device all have, so that they are shown.
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

/// Gives new strips, from number `first` on, outputs that no listener and no measuring device uses;
/// headphones have two. Returns the strips for which there is none. Any thread.
std::vector<std::size_t> placeNew(const DeviceChoice& choice, std::span<Strip> strips, std::size_t first);

/// If the layout has more actuators than `outputs`, replaces it by a preset that fits. A Pico gets its own
/// preset, unless the user has chosen a layout. Message thread.
void fitLayoutTo(int outputs, Mix& mix, std::string_view device = {});

/// Opens a device as headphones: the first actuator is heard left and the second right, at the level at which
/// a monitor begins, or lower. Result as MixerModel::open(). Message thread.
/// `before`: the outputs that the strips get back after them; none: those of now.
std::string useHeadphones(MixerModel& model, DeviceChoice choice,
                          std::optional<std::vector<int>> before = {});

/// After headphones: strips whose outputs useHeadphones() has set get back their former ones, if the device
/// has them, and new strips a free one; the level stays low. takeOffHeadphones() does so from strip `first`
/// on, on any thread; leaveHeadphones() for the model, on the message thread.
void takeOffHeadphones(const DeviceChoice& choice, int outputs, std::span<Strip> strips,
                       std::size_t first = 0);
void leaveHeadphones(MixerModel& model, const DeviceChoice& ears);

/// Reports strips for which headphones have no output, with a button that leaves two. Message thread.
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
