// SPDX-License-Identifier: MIT
// A world that is felt while it moves: simulation, renderer and the time between them.
// Who may call what when, and why: Docs/threads.md, the threading model.
#pragma once
#include "Core/HapticRenderer.h"
#include "Core/LatestValue.h"
#include "Files/SessionLog.h"
#include "Physics/InputCheck.h"
#include "Session/HeardContacts.h"
#include "Session/OnsetMarks.h"
#include "Session/OwnBirths.h"
#include "Session/RecordingSets.h"
#include "Session/SessionTime.h"
#include "Session/SessionWorld.h"
#include "Session/SinkSet.h"
#include "Session/WaitingStrikes.h"
#include "Session/WantedTake.h"
#include "Session/WorldPace.h"
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace physvib {

/// What is asked of its time, its pace, its take and in the render call itself stands in the headers of these.
class Session : public SessionTime, public WorldPace, public WantedTake, public OwnBirths {
public:
    /// M. Throws std::invalid_argument if the scene is not valid.
    explicit Session(const SessionSetup& setup);

    /// Sets L; silence at session time 0, the scene at its start, the log empty. M, while nobody renders or drives.
    void prepare(int sampleRateHz, int maxBlockFrames);

    /// Goes on at another rate and block size: session time and world stay, L is set anew, what rings rings on.
    /// M, while nobody renders.
    void resume(int sampleRateHz, int maxBlockFrames);

    int channels() const noexcept { return setup_.channels; }

    /// What becomes of all collisions, and of strikes, before they are rendered. Any thread.
    const EventShaping& shaping() const noexcept { return setup_.shaping; }

    /// How many channels behind the enchanters' ones tell what is heard of each hit, in sync with them: 0, 1, or left and right.
    int heardChannels() const noexcept { return heard_ ? heard_->ears() : 0; }

    /// Whether render also writes the last of outputs(): a pulse at each onset. Neither gains nor ceilings nor delays act on it. Null: it does not.
    const OnsetMarks* marks() const noexcept { return marks_.get(); }

    /// Channels that render writes: the enchanters', what is heard, the marks.
    int outputs() const noexcept { return setup_.channels + heardChannels() + (marks_ ? 1 : 0); }

    /// The largest that a sample of that channel has been allowed to be while the limiter is on. Any thread.
    float ceiling(int channel) const noexcept { return ceilings_[static_cast<std::size_t>(channel)].load(std::memory_order_relaxed); }

    /// Steps the world up to session time, or until `goesOn` (asked after each step) says no; the number of steps made. D.
    int advance(const StepWatch& goesOn = {});

    /// Writes out[0..outputs())[0..frames). R; wait-free if `mode` is realtime.
    void render(float* const* out, int frames, RenderMode mode) noexcept;

    /// How many frames L is too short for the next `frames` to be in time, as far as the world has been stepped; 0 or less: it
    /// has as many to spare. R, wait-free.
    std::int64_t framesMissing(int frames) const noexcept;

    /// Instead of render: session time goes on by `frames`, and nothing of it is lost, since L grows by as much. What to play
    /// meanwhile is the caller's. R, wait-free.
    void wait(int frames) noexcept;

    /// Acts in the world at session time: it is felt L later, and logged. Empty, or what is wrong with it (see
    /// InputCheck), and nothing is done. Any thread but R.
    std::string act(Action action);

    /// Changes how later events are rendered: acts in the world's time at session time, so it is felt L later, is
    /// logged, and an offline render with the same controls is the same to the bit. The time it was given; -1 if the
    /// queue is full. Any thread but R.
    std::int64_t post(RenderControl control);

    /// From session time on, events play these recordings instead of modes; none: modes. Recordings that sound fade out. Felt
    /// and logged as a control; the time it was given, -1 if the queue is full. M.
    std::int64_t useRecordings(std::vector<ContactRecording> recordings);

    /// Keeps the channels of a clip, whose files tell its path and hash (their own frequencies say nothing), and says by which number:
    /// strikes of clipFrequencyHz() of it, and of those that follow, play them beside whatever sounds, which goes on undisturbed. Nothing
    /// if there is no room for all, of numbers or samples. A clip that is kept already is the same one. Logged. Any thread but R.
    std::optional<int> keepClip(std::span<const ContactRecording> channels);

    /// Strikes apart from the world (a test pulse, a material to be heard): each is felt L after session time plus its
    /// own time, and logged. False, and nothing is played, if one cannot be (see isPlayable). Any thread but R.
    bool play(std::span<const CollisionEvent> strikes);
    /// The same at session times of their own, of which those that are over are late.
    bool playAt(std::span<const CollisionEvent> strikes);

    /// The same, but each waits in the session until its time, up to which stopAt can take it back. False, and nothing is
    /// played, if one cannot be or too many wait.
    bool schedule(std::span<const CollisionEvent> strikes);

    /// At that session time, or now if it is over, what sounds fades out, and what was scheduled for then or later before this
    /// call is forgotten. Felt and logged as a control; false if too many stops wait. Any thread but R.
    bool stopAt(std::int64_t timeNs);

    /// How later strikes are spread, as far as has been posted. Any thread but R.
    PhantomPanner panner() const;

    /// Session time. Any thread but R.
    std::int64_t presentNs() const;

    /// L. Any thread but R.
    double playOutSeconds() const;
    /// Of what is rendered. Any thread but R.
    int sampleRateHz() const;

    /// How long after its time what is told is felt where a session is direct, and by how much of session time such a one lets it stand ahead:
    /// L is their sum, the latter 0 if it is not direct. Any thread but R.
    double directSeconds() const;
    std::int64_t toldAheadNs() const;

    /// Before the first block, as lengthen: what is born is felt as soon as before, the world begins so much later. R, or M.
    void startLater(std::int64_t frames) noexcept;

    /// The scene starts anew when frame `offset` of the next block is the present, as a new take. R, wait-free, or M.
    void restart(int offset = 0) noexcept;

    /// Moves what is new since the last call to the end of `log`, which is the same each time; at first, and after prepare, it is
    /// empty. Session time up to which it tells of the world. Nothing to move unless the setup has a log. Any thread but R, one reader.
    std::int64_t readLog(SessionLog& log);

    /// What has been played, in the renderer's frames (session frame - L). One reader.
    HapticRenderer::PlayedQueue& played() noexcept { return renderer_->played(); }

    /// What is played beside the device: L covers the latency of those that are there when it is set.
    SinkSet& sinks() noexcept { return sinks_; }
    const SinkSet& sinks() const noexcept { return sinks_; }

    /// Time that was given up after stalls. Any thread.
    std::int64_t slippedNs() const noexcept { return slippedNs_.load(std::memory_order_relaxed); }

    /// Live inputs and bodies that the world holds now: for those who watch that neither grows without end. Any thread but R.
    SessionSize size() const;

    /// Where the bodies of sceneCast() are, as far as the world has been stepped: the session time of that, L before it is
    /// felt. Without a log nobody knows what inputs have spawned, and what is gone is left out. Any thread but R.
    std::int64_t readPoses(std::vector<BodyPose>& poses) const;

    /// Collisions lost in the physics step. Any thread but R.
    std::uint64_t drops() const;

    /// The newest state. One reader (M).
    SessionStatus status() noexcept { return status_.read(); }

private:
    static constexpr std::int64_t never = INT64_MAX;
    static constexpr std::size_t mostStops = 256;
    struct LiveSource;
    struct OfflineSource;
    bool addStrikes(std::span<const CollisionEvent> strikes, std::int64_t startNs);
    void takeDue(std::int64_t untilNs);
    std::int64_t postNow(RenderControl control);
    std::int64_t toldNs() const noexcept { return std::max<std::int64_t>(0, nowNs() - leadNs()); }
    std::int64_t firstFrame() const noexcept { return setup_.direct == Direct::born ? playOutFrames() - law().limiterFrames : 0; }
    void postDueStops(std::int64_t untilNs);
    void takeDueStops();
    bool popControl(RenderControl& control) noexcept;
    void mark(const CollisionEvent& event, std::int64_t frame) noexcept {
        if (marks_) marks_->strike(event, frame);
    }
    ClockLaw lawAt(int sampleRateHz, int maxBlockFrames) const;
    void takeUp();
    int catchUp(const StepWatch& goesOn = {});
    void moveWorld(std::int64_t untilNs);
    bool handOver();
    bool hasRoomFor(std::span<const ClipSound> channels) const;
    int logClip(std::span<const ContactRecording> channels);
    void renderBehind(float* const* out, std::int64_t done, int frames, RenderMode mode) noexcept;
    void renderOwnWorld(float* const* out, int frames, std::int64_t endNs);

    SessionSetup setup_;
    std::unique_ptr<HapticRenderer> renderer_;
    RecordingSets recordings_; // under the input mutex
    std::vector<ClipFile> clips_; // as they are in recordings_; likewise
    const std::unique_ptr<HeardContacts> heard_;
    const std::unique_ptr<OnsetMarks> marks_;
    EventQueue<CollisionEvent, 4096> queue_; // from whoever holds the world, who keeps what finds no room
    EventQueue<RenderControl, 256> controls_;
    SinkSet sinks_;
    std::atomic<std::int64_t> steppedNs_{0}; // session time of the world up to which all is in the queue
    std::atomic<std::int64_t> slippedNs_{0};
    std::atomic<bool> offline_{false}, isDriven_{false}; // the latter: somebody has begun to step the world
    std::array<std::atomic<float>, limits::maxEnchanters> ceilings_;
    LatestValue<SessionStatus> status_;
    std::int64_t leastMarginFrames_ = noMargin; // R

    mutable std::mutex worldMutex_; // guards what follows
    SessionWorld world_;
    std::vector<CollisionEvent> made_; // events that the queue had no room for yet, from handed_ on
    std::size_t handed_ = 0;
    WaitingStrikes waiting_;
    std::vector<CollisionEvent> begun_; // of those that waited, for the log

    mutable std::mutex inputMutex_; // taken first; guards what follows, and the producer's side of controls_
    std::optional<InputCheck> check_;
    std::size_t checkedTake_ = 0;
    SessionLog controlLog_; // without takes, of what has not been read
    PhantomPanner panner_;
    std::int64_t lastControlNs_ = 0;
    std::vector<std::int64_t> stops_; // ahead, in time order
    std::atomic<std::int64_t> nextStopNs_{never}; // the first of them; to be read without the mutex
};

} // namespace physvib
