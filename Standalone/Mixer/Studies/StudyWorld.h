// SPDX-License-Identifier: GPL-3.0-or-later
// A world that a participant sees, feels and can act in: a session of its own on the mixer's output, saved as
// a file that renders exactly what was felt.
#pragma once
#include "Host/Views/WorldView.h"
#include "Live/Devices/SimulationDriver.h"
#include "Live/Session/SessionJournal.h"
#include "Mixer/Studies/StudySound.h"
#include "Studies/StudyCalls.h"
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace physvib {

/// One at a time, and the mixer state must not be edited meanwhile. Strips give polarity, delay and ceiling;
/// the study sets levels. Message thread only.
class StudyWorld {
public:
    explicit StudyWorld(Desk& desk)
        : desk_{desk} {}
    ~StudyWorld() { finish(); }
    StudyWorld(const StudyWorld&) = delete;
    StudyWorld& operator=(const StudyWorld&) = delete;

    /// Empty, or why the world cannot be played in that mixer.
    static std::string refusal(const Desk& desk, const FeltWorld& world);

    /// Starts the world. With `hasHands`, scripted user input is disabled and the world runs until end();
    /// otherwise it ends after the call's seconds. The session is saved to `file` (.json). Empty, or an
    /// error.
    std::string begin(FeltWorld world, bool hasHands, const std::filesystem::path& file);

    /// Of the current or last world; a world has no planned level, so it is never `unlike`.
    Course course() const noexcept { return course_; }
    bool isPlaying() const noexcept { return session_ != nullptr; } ///< it runs or fades out
    bool isMoving() const noexcept { return isPlaying() && stoppedNs_ < 0; }
    /// Duration of the current or last world, without silences.
    double feltSeconds() const noexcept { return 1e-9 * static_cast<double>(feltNs_); }
    /// What the levels are measured over: a set length, or what was felt.
    double measuredSeconds() const noexcept { return seconds_ > 0.0 ? seconds_ : feltSeconds(); }

    /// Stops the world; sounding modes fade out.
    void end();
    /// Applies user input if the world runs. Empty, or an error.
    std::string act(const Action& action);

    /// Advances time and returns the changes to draw. To be called about 30 times a second.
    WorldMoment look();

    const Scene& scene() const noexcept { return setup_.scene; }
    const std::string& fault() const noexcept { return fault_; } ///< why the last one was not saved

private:
    void tellStrips();
    void askReceipts(std::int64_t untilNs);
    void finish();

    Desk& desk_;
    SessionSetup setup_;
    std::unique_ptr<Session> session_;
    std::unique_ptr<SessionJournal> journal_;
    std::unique_ptr<ThreadDriver> driver_;
    std::string fault_;
    double seconds_ = 0.0; // of a world without user input
    Course course_ = Course::none;
    std::uint32_t number_ = 0;                              // of the session, for receipts
    int actuators_ = 0;                                     // of its layout
    std::int64_t checkedNs_ = 0;                            // receipts were asked for up to there
    std::int64_t feltNs_ = 0, seenNs_ = 0, stoppedNs_ = -1; // stoppedNs_: session time of the stop
};

} // namespace physvib
