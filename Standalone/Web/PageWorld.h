// SPDX-License-Identifier: MIT
// A running scene and its haptic output, on the thread that renders the audio.
#pragma once
#include "Core/ClockLaw.h"
#include "Core/CollisionEvent.h"
#include "Core/ControlQueue.h"
#include "Core/HapticRenderer.h"
#include "Core/PanningLaws.h"
#include "Io/Result.h"
#include "Scene/SceneFile.h"
#include "Scene/World/InputCheck.h"
#include "Scene/World/ScenePlayer.h"
#include "Scene/World/Simulation.h"
#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

// File that a page opens: a scene, an event list or a clip, selected by its name.

/// A world and the events played in it: none for a scene, its events for a list, and one event that stands
/// for the samples of a clip.
struct PageFile {

    Scene scene;
    std::vector<CollisionEvent> strikes; ///< sorted by time
    std::vector<float> samples;          ///< at the renderer's rate
};

/// `name` ends in .csv, .haptic or .ahap; otherwise it is a scene. A list without a field gets one of the
/// given size, m. A clip plays in the centre of all actuators, as in `physvib render`.
Result<PageFile> readPageFile(std::string_view name, std::string_view text, const SceneSettings& settings,
                              Vector fieldMetres, int sampleRateHz);

/// The output equals the rendered file, delayed by outputLatencyFrames(). One thread has all roles of
/// Live/Session/Session.h, and steps the world in the block that needs it.
class PageWorld {
public:
    static constexpr int stepsPerSecond = 100;
    static constexpr int fingers = 10; ///< maximum number of bodies held at once

    /// Throws the exceptions of Simulation, or std::invalid_argument for a sample rate or number of outputs
    /// that cannot be rendered.
    PageWorld(PageFile file, std::uint32_t seed, int sampleRateHz, int outputs);

    /// The next frames, channel by channel.
    const float* render(int frames);
    std::int64_t outputLatencyFrames() const noexcept { return law_.outputLatencyFrames(); }

    /// x, y, angle and presence (1 or 0) of each body of cast(), consecutively.
    const std::vector<float>& poses();
    const std::vector<BodyDescription>& cast() const noexcept { return cast_; }
    const Scene& scene() const noexcept { return simulation_.scene(); }

    /// The next impact played since the last call, and its time in seconds of the output; false if there is
    /// none. Clips are not reported.
    bool takeHit(CollisionEvent& hit, double& atSeconds);

    void act(const Action& action); ///< applies now; fault() has its error
    void steer(int way);
    bool isPlayed() const noexcept { return player_.isThere(); }
    const std::string& fault() const noexcept { return fault_; } ///< of the last input; empty: none

    void grip(int finger, std::size_t body, Vector toMetres); ///< pulls the body there until letGo()
    void letGo(int finger);

    /// At most as many actuators as outputs; placed() applies changes.
    EnchanterLayout& layout() noexcept { return layout_; }
    /// Index in panningLaws; any other value: PanningLaw::automatic.
    void placed(int law);

    bool pop(CollisionEvent& event) noexcept { return take(events_, event); } // for the renderer, as the next
    bool pop(RenderControl& change) noexcept { return controls_.pop(change); }
    void done(const RenderControl& change) noexcept { controls_.done(change); }

private:
    struct Hand {
        std::size_t body;
        Vector to;
    };
    template <class T>
    static bool take(std::deque<T>& from, T& one) noexcept {
        if (from.empty()) return false;
        one = from.front();
        from.pop_front();
        return true;
    }
    PhantomPanner panner() const noexcept;
    // Frame 0 of the renderer.
    std::int64_t firstFrame() const noexcept { return law_.outputLatencyFrames() - law_.limiterFrames; }
    std::int64_t nsOf(std::int64_t frame) const noexcept;
    void pull(const Hand& hand);
    void stepTo(std::int64_t frame);

    const PageFile file_;
    RecordedContact clip_;   // its samples
    std::size_t struck_ = 0; // of the file's strikes
    Simulation simulation_;
    InputCheck check_;
    ScenePlayer player_;
    std::vector<BodyDescription> cast_;
    Vector fieldMetres_;
    ClockLaw law_;
    EnchanterLayout layout_;
    std::unique_ptr<HapticRenderer> renderer_ = std::make_unique<HapticRenderer>();
    std::vector<CollisionEvent> made_;
    std::deque<CollisionEvent> events_;
    ControlQueue<256> controls_;
    std::vector<float> samples_, poses_;
    std::array<std::optional<Hand>, fingers> hands_;
    PanningLaw panningLaw_ = PanningLaw::automatic;
    std::string fault_;
    std::size_t outputs_;
    std::int64_t done_ = 0; // in frames
};

} // namespace physvib
