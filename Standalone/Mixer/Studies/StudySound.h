// SPDX-License-Identifier: GPL-3.0-or-later
// Borrows the mixer's session for a study: its world is paused, its channels are the stimulus' actuators, and
// only the trial's stimuli play. Master level, ceilings, outputs and the silence button stay unchanged.
#pragma once
#include "Mixer/Desk/Desk.h"
#include "Studies/StudyCalls.h"

namespace physvib {

/// Message thread only. The mixer state must not be edited during its lifetime.
class StudySound {
public:
    explicit StudySound(Desk& desk);
    ~StudySound(); ///< restores mixer state and world speed
    StudySound(const StudySound&) = delete;
    StudySound& operator=(const StudySound&) = delete;

    /// Empty, or why the stimulus cannot be played in that mixer.
    static std::string refusal(const Desk& desk, const FeltStimulus& stimulus);
    /// Renders a trial's stimulus at the mixer's sample rate, or returns why it cannot be played.
    static Result<FeltStimulus> make(Desk& desk, const TrialJob& job, const std::string& folder = {});

    /// Plays it; empty, or an error. Not while another plays: stimuli play to their end, as in the rendered
    /// file.
    std::string play(const FeltStimulus& stimulus);
    bool isPlaying() const;
    double feltSeconds() const;     ///< of the last stimulus, so far
    double startsInSeconds() const; ///< time until the last stimulus is felt; negative afterwards
    /// Fades out sounding modes and mutes pending events until the mixer is returned.
    void stop();

private:
    void useRecordings(const std::vector<ContactRecording>& recordings);
    void post(RenderControl::Kind kind, int channel, float value, const PhantomPanner& panner = {});

    Desk& desk_;
    int slowness_;
    double beganAtMs_ = 0.0, seconds_ = 0.0;
    std::vector<float> gains_; // last posted values
};

} // namespace physvib
