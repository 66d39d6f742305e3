// SPDX-License-Identifier: GPL-3.0-or-later
// The desk lent to a study: the world stands still, the channels are the stimulus' enchanters, and what is
// felt are the trial's own calls. Master level, ceilings, outputs and the silence button stay what they are.
#pragma once
#include "Mixer/Desk/Desk.h"
#include "Studies/StudyCalls.h"

namespace physvib {

/// M only. While it lives nobody edits the desk's mix.
class StudySound {
public:
    explicit StudySound(Desk& desk);
    ~StudySound(); ///< the mix and the world's pace are as they were
    StudySound(const StudySound&) = delete;
    StudySound& operator=(const StudySound&) = delete;

    /// Why it cannot be felt on that desk; empty if it can.
    static std::string refusal(const Desk& desk, const FeltStimulus& stimulus);
    /// What a trial is made by, at the desk's rate, if it can be felt there.
    static Result<FeltStimulus> make(Desk& desk, const TrialJob& job, const std::string& folder = {});

    /// Plays it; empty, or the reason. Not while another plays: what was begun is felt to its end, like in
    /// the file.
    std::string play(const FeltStimulus& stimulus);
    bool isPlaying() const;
    double feltSeconds() const;     ///< of the last one, so far
    double startsInSeconds() const; ///< until the last one is felt; below 0: it has been
    /// What rings fades out, and what is to come is mute until the desk is given back.
    void stop();

private:
    void useRecordings(const std::vector<ContactRecording>& recordings);
    void post(RenderControl::Kind kind, int channel, float value, const PhantomPanner& panner = {});

    Desk& desk_;
    int slowness_;
    double beganAtMs_ = 0.0, seconds_ = 0.0;
    std::vector<float> gains_; // as posted
};

} // namespace physvib
