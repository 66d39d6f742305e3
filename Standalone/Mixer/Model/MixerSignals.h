// SPDX-License-Identifier: GPL-3.0-or-later
// What the mixer displays of its output: a snapshot of the session, peaks, and traces of the samples (the
// last second, their spectrum, and the whole scene run).
#pragma once
#include "Core/Limits.h"
#include "Live/Devices/AudioOutput.h"
#include "Live/Devices/DeviceMeters.h"
#include "Live/Devices/SinkTable.h"
#include "Live/Session/SessionSetup.h"
#include "Pictures/WaveformEnvelope.h"
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
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
    bool isHeadphones = false;        ///< its first two outputs, L and R, are the ears, in place of actuators
    std::vector<int> beforeEars{};    ///< then: the outputs of the strips before; -1: none

    static constexpr int ears = 2;
    /// Outputs of listeners and measuring devices, which are not given to actuators.
    std::vector<int> inUse() const {
        std::vector<int> outputs = monitor;
        outputs.push_back(marker);
        return outputs;
    }
    /// As the mixer's strips name an output, from 0.
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

/// The last second of every channel, as minimum and maximum of each scope column. Message thread.
class ScopeTrace {
public:
    static constexpr int columns = 800;
    static constexpr double seconds = 1.0;

    ScopeTrace() { clear(); }

    /// Restarts the current column.
    void setRate(int sampleRateHz) {
        framesPerColumn_ = std::max(1, static_cast<int>(seconds * sampleRateHz / columns));
        filled_ = 0;
    }
    void clear() {
        for (auto& lane : lanes_) lane.assign(columns, {});
        newest_ = 0;
        filled_ = 0;
        begun_ = 0;
    }

    /// Appends frames of the first `count` channels.
    void add(const float* const* channels, int count, int frames) {
        for (int done = 0; done < frames;) {
            const int part = std::min(frames - done, framesPerColumn_ - filled_);
            for (int j = 0; j < count; ++j) {
                const auto [low, high] = std::minmax_element(channels[j] + done, channels[j] + done + part);
                SampleRange& column = lanes_[static_cast<std::size_t>(j)][static_cast<std::size_t>(newest_)];
                column = filled_ == 0
                             ? SampleRange{*low, *high}
                             : SampleRange{std::min(column.lowest, *low), std::max(column.highest, *high)};
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
        return lanes_[static_cast<std::size_t>(channel)]
                     [static_cast<std::size_t>((newest_ + 1 + index) % columns)];
    }

    /// What a trace of so many pixels has at pixel `x`: all of its columns, and the one before, since half a
    /// wave of 400 Hz is a column.
    SampleRange shown(int channel, int x, int width) const {
        const auto columnOf = [width](int pixel) { return pixel * (columns - 1) / std::max(1, width); };
        const int first = columnOf(x), last = std::max(first, columnOf(x + 1) - 1);
        SampleRange range = at(channel, first);
        for (int k = std::max(0, first - 1); k <= last; ++k)
            range = {std::min(range.lowest, at(channel, k).lowest),
                     std::max(range.highest, at(channel, k).highest)};
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
    static constexpr int keptRateHz = 8000; ///< minimum rate after decimation; sufficient for 1 kHz at an
                                            ///< eighth of the cost

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
                column = {std::min(column.lowest, *low), std::max(column.highest, *high)};
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
            const SampleRange& column = lanes_[static_cast<std::size_t>(channel)][i];
            all = {std::min(all.lowest, column.lowest), std::max(all.highest, column.highest)};
        }
        return all;
    }

private:
    void widen() {
        columnSeconds_ *= 2.0;
        for (auto& lane : lanes_) {
            for (std::size_t i = 0; i < columns / 2; ++i)
                lane[i] = {std::min(lane[2 * i].lowest, lane[2 * i + 1].lowest),
                           std::max(lane[2 * i].highest, lane[2 * i + 1].highest)};
            std::fill(lane.begin() + columns / 2, lane.end(), SampleRange{});
        }
    }

    std::array<std::vector<SampleRange>, limits::maxEnchanters> lanes_;
    std::size_t run_ = 0;
    double columnSeconds_ = firstSeconds, seconds_ = 0.0;
};

/// Message thread.
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

} // namespace physvib
