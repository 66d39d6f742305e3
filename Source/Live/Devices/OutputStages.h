// SPDX-License-Identifier: MIT
// Stages of AudioOutput: the session that plays, on/off motors, and the signals of outputs that drive no
// actuator. Threads: M, the message thread; R, the render thread.
#pragma once
#include "Core/Actuators/GainRamp.h"
#include "Core/Actuators/VibrationConverter.h"
#include "Core/Units.h"
#include "Live/Devices/OutputMap.h"
#include "Live/Session/OutputClock.h"
#include "Live/Session/Session.h"
#include "Stimuli/PinkNoise.h"
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace physvib {

// Selects the session that a device plays, its own or a borrowed one, and holds its sample rate, block size
// and output buffers.

class PlayedSession {
public:
    explicit PlayedSession(Session& ownSession)
        : ownSession_{ownSession}
        , current_{&ownSession} {}

    Session& ownSession() const noexcept { return ownSession_; }
    /// Any thread.
    Session& currentSession() const noexcept { return *current_.load(); }
    bool isPlayingBorrowed() const noexcept { return &currentSession() != &ownSession_; }
    /// Identifies the session that plays: 0 is the own one, n the n-th borrowed one. Any thread.
    std::uint32_t borrowNumber() const noexcept { return isPlayingBorrowed() ? borrowCount_.load() : 0; }

    /// Sample rate and block size; 0 until a device has run. M and R, as blockFrames().
    int sampleRateHz() const noexcept { return rateHz_; }
    int blockFrames() const noexcept { return blockFrames_; }
    /// Buffers of blockFrames() frames for each output of the own session.
    float* const* samples() const noexcept { return channelPointers_.data(); }

    /// Starts or resumes the current session at that rate, on a device with that latency; its pauses count if
    /// it is real. M, while R does not run.
    void begin(int sampleRateHz, int maxBlockFrames, int latencyFrames, bool isReal) {
        if (rateHz_ == 0)
            currentSession().prepare(sampleRateHz, maxBlockFrames);
        else if (sampleRateHz != rateHz_ || maxBlockFrames != blockFrames_ || !coversSinks(currentSession()))
            currentSession().resume(sampleRateHz, maxBlockFrames);
        rateHz_ = sampleRateHz;
        blockFrames_ = maxBlockFrames;
        latencyNs_ = std::int64_t{1'000'000'000} * latencyFrames / rateHz_;
        maxPauseNs_ = isReal ? DevicePulse::maxPauseNs(std::int64_t{1'000'000'000} * blockFrames_ / rateHz_)
                             : DevicePulse::never;
        beginPulse();
        samples_.assign(static_cast<std::size_t>(ownSession_.rendered().count()),
                        std::vector<float>(static_cast<std::size_t>(blockFrames_)));
        channelPointers_.clear();
        for (auto& channel : samples_) channelPointers_.push_back(channel.data());
    }

    /// Call when no device is open any more. M, while R does not run.
    void end() noexcept {
        maxPauseNs_ = 0;
        if (rateHz_ != 0) currentSession().pulse().end();
    }

    /// Time at which the next block is felt, for a block requested at `steadyNs`. R.
    OutputMoment nextOutputMoment(std::int64_t steadyNs) const noexcept {
        const std::int64_t outNs = currentSession().timeline().nextOutputNs();
        return {outNs, steadyNs + latencyNs_, currentSession().timeline().nextNs(0) - outNs + latencyNs_,
                rateHz_};
    }

    /// Plays another session from the next block on; null returns to the own one. A device has run. M.
    void playInstead(Session* borrowed) {
        if (borrowed != nullptr)
            borrowed->prepare(rateHz_, blockFrames_);
        else if (isPlayingBorrowed() && (ownRateHz_ != rateHz_ || ownBlockFrames_ != blockFrames_))
            ownSession_.resume(rateHz_, blockFrames_);
        if (!isPlayingBorrowed()) ownRateHz_ = rateHz_, ownBlockFrames_ = blockFrames_;
        borrowCount_ += borrowed != nullptr ? 1 : 0;
        current_.store(borrowed != nullptr ? borrowed : &ownSession_);
        beginPulse();
    }

private:
    void beginPulse() noexcept { currentSession().pulse().begin(maxPauseNs_, steadyNs()); }

    Session& ownSession_;
    std::atomic<Session*> current_; // sequentially consistent, as the calls of DeviceSession: after a change,
                                    // M can see whether R may still use the old session
    std::atomic<std::uint32_t> borrowCount_{0};
    int ownRateHz_ = 0, ownBlockFrames_ = 0; // of the own session when another was borrowed
    std::int64_t maxPauseNs_ = DevicePulse::never;

    // R; set while the device is stopped
    int rateHz_ = 0, blockFrames_ = 0;
    std::int64_t latencyNs_ = 0; // of the device
    std::vector<std::vector<float>> samples_;
    std::vector<float*> channelPointers_;
};

// Converts the signals of on/off motors (ERMs without speed control) into switching signals.

class OnOffMotors {
public:
    /// Sets which `actuators` (from 0) are such motors. M, while R does not run.
    void prepare(const std::vector<int>& actuators, int sampleRateHz, double threshold) {
        motors_.clear();
        for (const int j : actuators)
            motors_.push_back({static_cast<std::size_t>(j), OnOffSteps{sampleRateHz, threshold}});
    }

    /// Replaces each motor's samples by 1 (on) or 0, one step late, because a step is judged by all its
    /// samples. Ceiling and master level set the on level later. R, wait-free.
    void apply(float* const* channels, int frames) noexcept {
        for (Motor& motor : motors_)
            for (int n = 0; n < frames; ++n) {
                float& sample = channels[motor.actuator][n];
                motor.steps.add(sample, [](long long, bool) {});
                sample = motor.steps.isOn() ? 1.0f : 0.0f;
            }
    }

    /// R.
    bool has(int actuator) const noexcept {
        return std::ranges::find(motors_, static_cast<std::size_t>(actuator), &Motor::actuator) !=
               motors_.end();
    }

private:
    struct Motor {
        std::size_t actuator;
        OnOffSteps steps;
    };
    std::vector<Motor> motors_;
};

// Signals on outputs that drive no actuator: masking noise and contact sounds for headphones, onset marks for
// measuring devices.

/// Limits to -limit..limit; NaN becomes -limit, which OutputGuard then takes away. R, wait-free.
inline void clip(float* samples, float limit, int frames) noexcept {
    std::transform(samples, samples + frames, samples,
                   [limit](float x) { return std::min(limit, std::max(-limit, x)); });
}

/// Adds noise, contact sounds and marks to listening outputs, at the levels of ListeningSettings.
class MonitorMix {
public:
    /// `map` assigns the outputs; it outlives this object.
    explicit MonitorMix(const OutputMap& map)
        : map_{map} {}

    /// Sets the gains of noise and contact sounds from their levels in dB. M.
    void setLevels(const ListeningSettings& l) {
        const auto toGain = [](const std::vector<int>& outputs, double db, double minDb, double maxDb) {
            return outputs.empty() ? 0.0 : fromDecibels(std::clamp(db, minDb, maxDb));
        };
        // the noise generator has a level of its own, so the gain is relative to it
        noiseGain_ = static_cast<float>(toGain(l.noise, l.noiseDb, PinkNoise::minDb, PinkNoise::maxDb) /
                                        PinkNoise::rootMeanSquare);
        contactGain_ = static_cast<float>(toGain(l.contacts, l.contactDb, minContactDb, maxContactDb));
    }
    /// M, while R does not run.
    void prepare(int sampleRateHz, int blockFrames) {
        noiseScratch_.assign(static_cast<std::size_t>(blockFrames), 0.0f);
        noiseRamp_.prepare(sampleRateHz, noiseFadeSeconds, 0.0f);
        contactRamp_.prepare(sampleRateHz, fadeInSeconds, 0.0f);
    }

    /// Starts a block of `frames`; `isSilenced`: it is silent. R, wait-free, as render().
    void begin(bool isSilenced, int frames) noexcept {
        isSilenced_ = isSilenced;
        for (auto [ramp, gain] : {std::pair{&noiseRamp_, &noiseGain_}, {&contactRamp_, &contactGain_}}) {
            if (isSilenced)
                ramp->moveTo(0.0f, frames);
            else
                ramp->moveTo(gain->load(std::memory_order_relaxed));
        }
        if (isSilenced) isNextPulseWhole_ = false;
    }
    /// Writes `frames` of the block to `out`, from `first` on. `signals` are the outputs of `session`:
    /// contact sounds and marks follow its channels. The contact sounds are scaled in place.
    void render(const Session& session, float* const* signals, float* const* out, int outputs, int first,
                int frames) noexcept {
        if (noiseGain_.load(std::memory_order_relaxed) > 0.0f) {
            float* noise = noiseScratch_.data();
            std::generate_n(noise, frames, [this] { return noise_.next(); });
            noiseRamp_.apply(&noise, 1, frames);
            addTo(ListeningSource::noise, &noise, 1, out, outputs, first, frames);
        } else {
            noiseRamp_.jumpTo(0.0f); // it has no outputs; once it has, it fades in
        }
        if (session.rendered().contactAudioChannels() > 0) {
            float* const* const sounds = signals + session.channels();
            contactRamp_.apply(sounds, session.rendered().contactAudioChannels(), frames);
            addTo(ListeningSource::contacts, sounds, session.rendered().contactAudioChannels(), out, outputs,
                  first, frames);
        }
        if (session.rendered().marks())
            renderMarks(signals[session.rendered().count() - 1], out, outputs, first, frames);
    }

private:
    static constexpr double fadeInSeconds = 0.005;
    static constexpr double noiseFadeSeconds = 2.0; // ramp to full scale, slow enough not to startle

    // A silenced output gets no marks. If the silence ends within a pulse, the rest of that pulse is left
    // out, because its rising edge was silenced.
    void renderMarks(float* marks, float* const* out, int outputs, int first, int frames) noexcept {
        int begin = isSilenced_ ? frames : 0;
        while (begin < frames && !isNextPulseWhole_)
            isNextPulseWhole_ = marks[begin] == 0.0f, begin += isNextPulseWhole_ ? 0 : 1;
        marks += begin;
        addTo(ListeningSource::marks, &marks, 1, out, outputs, first + begin, frames - begin);
    }
    // Two signals alternate over the outputs: left, right, left... Nothing else plays on these outputs, and
    // the sum of noise and contact sounds is clipped to full scale.
    void addTo(ListeningSource source, float* const* signals, int count, float* const* out, int outputs,
               int first, int frames) noexcept {
        for (int i = 0; i < OutputMap::maxListeningOutputs; ++i) {
            const int k = map_.listeningChannel(source, i);
            if (k < 0 || k >= outputs) continue;
            float* const samples = out[k] + first;
            std::transform(samples, samples + frames, signals[i % count], samples, std::plus{});
            clip(samples, 1.0f, frames);
        }
    }

    const OutputMap& map_;
    std::atomic<float> noiseGain_{0.0f}, contactGain_{0.0f};

    // R; set while R does not run
    GainRamp noiseRamp_, contactRamp_;
    PinkNoise noise_;
    std::vector<float> noiseScratch_;
    bool isSilenced_ = false, isNextPulseWhole_ = true; // the next pulse starts with its edge
};

} // namespace physvib
