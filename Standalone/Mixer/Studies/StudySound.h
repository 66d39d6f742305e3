// SPDX-License-Identifier: GPL-3.0-or-later
// Borrows the mixer's session for a study: its world is paused, its channels are the stimulus' actuators, and
// only the trial's stimuli play. Master level, ceilings, outputs and the silence button stay unchanged.
#pragma once
#include "Mixer/Desk/Desk.h"
#include "Studies/StudyCalls.h"

namespace physvib {

/// How what was played last fared, by the receipts of the output.
enum class Course {
    none,   ///< nothing was played yet, or it was stopped
    plays,  ///< it is not over
    left,   ///< every actuator got all of it, in one piece and within 1 dB of the plan
    lost,   ///< it was cut off, silenced, or missed an actuator
    unlike, ///< it left as a whole, at another level than planned
};

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
    /// Looks at the receipts. To be called often; isPlaying() changes here alone.
    void update();
    Course course() const noexcept { return course_; }
    bool isPlaying() const noexcept { return course_ == Course::plays; }
    /// Of the strongest actuator, of the last stimulus that is over.
    const FeltLevel& felt() const noexcept { return felt_; }
    double feltSeconds() const;     ///< of the last stimulus, so far
    double startsInSeconds() const; ///< time until the last stimulus is felt; negative afterwards
    /// Fades out sounding modes and mutes pending events until the next stimulus or the mixer's return.
    void stop();

private:
    void useRecordings(const std::vector<ContactRecording>& recordings);
    void post(RenderControl::Kind kind, int channel, float value, const PhantomPanner* panner = nullptr);

    std::vector<double> plannedPeaks(const FeltStimulus& stimulus) const;
    Course judged();

    Desk& desk_;
    int slowness_;
    double beganAtMs_ = 0.0, ranAtMs_ = 0.0, seconds_ = 0.0, heldSeconds_ = 0.0; // held: felt when it was
                                                                                 // over
    std::vector<float> gains_;                                                   // last posted values
    Course course_ = Course::none;
    bool isMuted_ = false;                  // by stop()
    bool wasSilent_ = false;                // at any time of it
    std::int64_t fromNs_ = 0, untilNs_ = 0; // of the last stimulus, in session time
    std::uint32_t session_ = 0;
    std::vector<EnchanterDescription> actuators_; // of its layout
    FeltLevel felt_;
    std::vector<double> planned_; // peak of each actuator at its output; empty: not known
};

} // namespace physvib
