// SPDX-License-Identifier: MIT
// Stages of AudioOutput: the session that plays, motors that are either on or off, and what outputs that
// drive no actuator play.
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
    explicit PlayedSession(Session& own)
        : own_{own}
        , now_{&own} {}

    Session& own() const noexcept { return own_; }
    /// Any thread.
    Session& now() const noexcept { return *now_.load(); }
    bool isLent() const noexcept { return &now() != &own_; }
    /// Identifies the session that plays: 0 is the own one, n the n-th borrowed one. Any thread.
    std::uint32_t number() const noexcept { return isLent() ? lends_.load() : 0; }

    /// 0 until a device has run. M and R, as the next two.
    int sampleRateHz() const noexcept { return rate_; }
    int blockFrames() const noexcept { return block_; }
    /// Buffers of blockFrames() frames for each output of the own session.
    float* const* samples() const noexcept { return at_.data(); }

    /// Starts or resumes the current session at that rate, on a device with that latency; its pauses count if
    /// it is real. M, while R does not run.
    void begin(int sampleRateHz, int maxBlockFrames, int latencyFrames, bool isReal) {
        if (rate_ == 0)
            now().prepare(sampleRateHz, maxBlockFrames);
        else if (sampleRateHz != rate_ || maxBlockFrames != block_ || !coversSinks(now()))
            now().resume(sampleRateHz, maxBlockFrames);
        rate_ = sampleRateHz;
        block_ = maxBlockFrames;
        latencyNs_ = std::int64_t{1'000'000'000} * latencyFrames / rate_;
        pauseNs_ =
            isReal ? DevicePulse::limitNs(std::int64_t{1'000'000'000} * block_ / rate_) : DevicePulse::never;
        beginPulse();
        samples_.assign(static_cast<std::size_t>(own_.rendered().count()),
                        std::vector<float>(static_cast<std::size_t>(block_)));
        at_.clear();
        for (auto& channel : samples_) at_.push_back(channel.data());
    }

    /// Call when no device is open any more. M, while R does not run.
    void end() noexcept {
        pauseNs_ = 0;
        if (rate_ != 0) now().pulse().end();
    }

    /// Time at which the next block is felt, for a block requested at `steadyNs`. R.
    OutputMoment nextFelt(std::int64_t steadyNs) const noexcept {
        const std::int64_t felt = now().timeline().nextFeltNs();
        return {felt, steadyNs + latencyNs_, now().timeline().nextNs(0) - felt + latencyNs_, rate_};
    }

    /// Plays another session from the next block on; null returns to the own one. A device has run. M.
    void playInstead(Session* other) {
        if (other != nullptr)
            other->prepare(rate_, block_);
        else if (isLent() && (lentRate_ != rate_ || lentBlock_ != block_))
            own_.resume(rate_, block_);
        if (!isLent()) lentRate_ = rate_, lentBlock_ = block_;
        lends_ += other != nullptr ? 1 : 0;
        now_.store(other != nullptr ? other : &own_);
        beginPulse();
    }

private:
    void beginPulse() noexcept { now().pulse().begin(pauseNs_, steadyNs()); }

    Session& own_;
    std::atomic<Session*> now_; // sequentially consistent, as the calls of DeviceSession: after a change, M
                                // can see whether R may still use the old session
    std::atomic<std::uint32_t> lends_{0};
    int lentRate_ = 0, lentBlock_ = 0; // of the own session when another was borrowed
    std::int64_t pauseNs_ = DevicePulse::never;

    // R; set while the device is stopped
    int rate_ = 0, block_ = 0;
    std::int64_t latencyNs_ = 0; // of the device
    std::vector<std::vector<float>> samples_;
    std::vector<float*> at_;
};

// Converts the signals of on/off motors (ERMs without speed control) into switching signals.

class OnOffMotors {
public:
    /// `enchanters` from 0. M, while R does not run.
    void prepare(const std::vector<int>& enchanters, int sampleRateHz, double threshold) {
        motors_.clear();
        for (const int j : enchanters)
            motors_.push_back({static_cast<std::size_t>(j), OnOffSteps{sampleRateHz, threshold}});
    }

    /// The switch state follows one step late, because a step is judged by all samples in it. Ceiling and
    /// master level set the on level. R, wait-free.
    void apply(float* const* channels, int frames) noexcept {
        for (Motor& motor : motors_)
            for (int n = 0; n < frames; ++n) {
                float& sample = channels[motor.enchanter][n];
                motor.steps.take(sample, [](long long, bool) {});
                sample = motor.steps.isOn() ? 1.0f : 0.0f;
            }
    }

    /// R.
    bool has(int enchanter) const noexcept {
        return std::ranges::find(motors_, static_cast<std::size_t>(enchanter), &Motor::enchanter) !=
               motors_.end();
    }

private:
    struct Motor {
        std::size_t enchanter;
        OnOffSteps steps;
    };
    std::vector<Motor> motors_;
};

// Signals on outputs that drive no actuator: masking noise and contact sounds for headphones, onset marks for
// measuring devices.

/// Limits to -most..most; NaN becomes -most, which OutputGuard then takes away. R, wait-free.
inline void clip(float* samples, float most, int frames) noexcept {
    std::transform(samples, samples + frames, samples,
                   [most](float x) { return std::min(most, std::max(-most, x)); });
}

/// Levels come from ListeningSettings; the master level does not apply.
class MonitorMix {
public:
    /// `map` assigns the outputs; it outlives this object.
    explicit MonitorMix(const OutputMap& map)
        : map_{map} {}

    /// M.
    void setLevels(const ListeningSettings& l) {
        const auto gainOf = [](const std::vector<int>& outputs, double db, double leastDb, double mostDb) {
            return outputs.empty() ? 0.0 : fromDecibels(std::clamp(db, leastDb, mostDb));
        };
        // the noise generator has a level of its own, so the gain is relative to it
        noiseGain_ = static_cast<float>(gainOf(l.noise, l.noiseDb, PinkNoise::leastDb, PinkNoise::mostDb) /
                                        PinkNoise::rootMeanSquare);
        contactGain_ = static_cast<float>(gainOf(l.contacts, l.contactDb, leastContactDb, mostContactDb));
    }
    /// M, while R does not run.
    void prepare(int sampleRateHz, int blockFrames) {
        noiseScratch_.assign(static_cast<std::size_t>(blockFrames), 0.0f);
        noiseRamp_.prepare(sampleRateHz, noiseFadeSeconds, 0.0f);
        contactRamp_.prepare(sampleRateHz, fadeInSeconds, 0.0f);
    }

    /// Starts a block of `frames`; `rests`: it is silent. R, wait-free, as render().
    void begin(bool rests, int frames) noexcept {
        rests_ = rests;
        for (auto [ramp, gain] : {std::pair{&noiseRamp_, &noiseGain_}, {&contactRamp_, &contactGain_}}) {
            if (rests)
                ramp->moveTo(0.0f, frames);
            else
                ramp->moveTo(gain->load(std::memory_order_relaxed));
        }
        if (rests) areMarksOpen_ = false;
    }
    /// Writes `frames` of the block to `out`, from `first` on. `signals` are the outputs of `session`:
    /// contact sounds and marks follow its channels. The contact sounds are scaled in place.
    void render(const Session& session, float* const* signals, float* const* out, int outputs, int first,
                int frames) noexcept {
        if (noiseGain_.load(std::memory_order_relaxed) > 0.0f) {
            float* noise = noiseScratch_.data();
            std::generate_n(noise, frames, [this] { return noise_.next(); });
            noiseRamp_.apply(&noise, 1, frames);
            addTo(Heard::noise, &noise, 1, out, outputs, first, frames);
        }
        if (session.rendered().heard() > 0) {
            float* const* const ears = signals + session.channels();
            contactRamp_.apply(ears, session.rendered().heard(), frames);
            addTo(Heard::contacts, ears, session.rendered().heard(), out, outputs, first, frames);
        }
        if (session.rendered().marks())
            renderMarks(signals[session.rendered().count() - 1], out, outputs, first, frames);
    }

private:
    static constexpr double fadeInSeconds = 0.005;
    static constexpr double noiseFadeSeconds = 2.0; // ramp to full scale, slow enough not to startle

    // Output that is silenced gets no marks. If the silence ends within a pulse, the rest of that pulse is
    // skipped, because its edge was silenced.
    void renderMarks(float* marks, float* const* out, int outputs, int first, int frames) noexcept {
        int begin = rests_ ? frames : 0;
        while (begin < frames && !areMarksOpen_)
            areMarksOpen_ = marks[begin] == 0.0f, begin += areMarksOpen_ ? 0 : 1;
        marks += begin;
        addTo(Heard::marks, &marks, 1, out, outputs, first + begin, frames - begin);
    }
    // Two signals alternate over the outputs: left, right, left... Nothing else plays on these outputs, and
    // the sum of noise and contact sounds is clipped to full scale.
    void addTo(Heard source, float* const* signals, int count, float* const* out, int outputs, int first,
               int frames) noexcept {
        for (int i = 0; i < OutputMap::mostHeard; ++i) {
            const int k = map_.heardAt(source, i);
            if (k < 0 || k >= outputs) continue;
            float* const at = out[k] + first;
            std::transform(at, at + frames, signals[i % count], at, std::plus{});
            clip(at, 1.0f, frames);
        }
    }

    const OutputMap& map_;
    std::atomic<float> noiseGain_{0.0f}, contactGain_{0.0f};

    // R; set while R does not run
    GainRamp noiseRamp_, contactRamp_;
    PinkNoise noise_;
    std::vector<float> noiseScratch_;
    bool rests_ = false, areMarksOpen_ = true; // the next pulse is complete
};

} // namespace physvib
