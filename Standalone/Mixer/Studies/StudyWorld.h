// SPDX-License-Identifier: GPL-3.0-or-later
// A world that a participant watches, feels and may play with: a session of its own on the desk's output,
// which becomes a file that renders what was felt, to the bit.
#pragma once
#include "Host/Devices/SimulationDriver.h"
#include "Host/Views/WorldView.h"
#include "Live/Session/SessionJournal.h"
#include "Mixer/Desk/Desk.h"
#include "Studies/StudyCalls.h"
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace physvib {

/// One after the other, while nobody edits the desk's mix. Strips give polarity, delay and ceiling; their
/// levels are the study's business. M only.
class StudyWorld {
public:
    explicit StudyWorld(Desk& desk)
        : desk_{desk} {}
    ~StudyWorld() { finish(); }
    StudyWorld(const StudyWorld&) = delete;
    StudyWorld& operator=(const StudyWorld&) = delete;

    /// Why it cannot be felt on that desk; empty if it can.
    static std::string refusal(const Desk& desk, const FeltWorld& world);

    /// The world begins to move. With hands, what its script does of what hands do is left out, and it goes
    /// on until end(); else it ends after the call's seconds. `file` (.json) keeps it. Empty, or the reason.
    std::string begin(FeltWorld world, bool hasHands, const std::filesystem::path& file);

    bool isPlaying() const noexcept { return session_ != nullptr; } ///< it moves, or fades out
    bool isMoving() const noexcept { return isPlaying() && stoppedNs_ < 0; }
    /// of this one, or the last, while it was not silent
    double feltSeconds() const noexcept { return 1e-9 * static_cast<double>(feltNs_); }

    /// It stands still, and what rings fades out.
    void end();
    /// A hand's doing; nothing while none moves. Empty, or what is wrong with it.
    std::string act(const Action& action);

    /// Time goes on; what is new, to be drawn. About 30 times a second.
    WorldMoment look();

    const Scene& scene() const noexcept { return setup_.scene; }
    const std::string& fault() const noexcept { return fault_; } ///< empty, or why the last one is not kept

private:
    void tellStrips();
    void finish();

    Desk& desk_;
    SessionSetup setup_;
    std::unique_ptr<Session> session_;
    std::unique_ptr<SessionJournal> journal_;
    std::unique_ptr<SimulationDriver> driver_;
    std::string fault_;
    double seconds_ = 0.0;                                  // of a world without hands
    std::int64_t feltNs_ = 0, seenNs_ = 0, stoppedNs_ = -1; // the latter: session time of what stops it
};

} // namespace physvib
