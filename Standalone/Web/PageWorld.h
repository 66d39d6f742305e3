// SPDX-License-Identifier: MIT
// A scene in motion and what is felt of it, all on the one thread that makes its sound.
#pragma once
#include "Core/ClockLaw.h"
#include "Core/HapticRenderer.h"
#include "Core/PanningLaws.h"
#include "PageFile.h"
#include "Scene/World/InputCheck.h"
#include "Scene/World/ScenePlayer.h"
#include "Scene/World/Simulation.h"
#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace physvib {

/// The live output is the rendered file, playOutFrames() later: Docs/threads.md, where one thread holds every
/// role. The world is stepped in the block that needs it.
class PageWorld {
public:
    static constexpr int stepsPerSecond = 100;
    static constexpr int fingers = 10; ///< that hold bodies at once

    /// Throws what Simulation throws, or std::invalid_argument at a rate or number of outputs that cannot be
    /// rendered.
    PageWorld(PageFile file, std::uint32_t seed, int sampleRateHz, int outputs);

    /// The next frames, channel by channel.
    const float* render(int frames);
    std::int64_t playOutFrames() const noexcept { return law_.playOutFrames(); }

    /// x, y, angle and presence (1 or 0) of each body of cast(), one after the other.
    const std::vector<float>& poses();
    const std::vector<BodyDescription>& cast() const noexcept { return cast_; }
    const Scene& scene() const noexcept { return simulation_.scene(); }

    /// The next hit that has been played since the last call, and when, in seconds of the output; false:
    /// none. Of a clip none is told.
    bool takeHit(CollisionEvent& hit, double& atSeconds);

    void act(const Action& action); ///< now; what is wrong with it is told by fault()
    void steer(int way);
    bool isPlayed() const noexcept { return player_.isThere(); }
    const std::string& fault() const noexcept { return fault_; } ///< of the last input; empty: none

    void grip(int finger, std::size_t body, Vector toMetres); ///< pulled there until it is let go
    void letGo(int finger);

    /// at most as many as outputs; placed() makes it audible
    EnchanterLayout& layout() noexcept { return layout_; }
    /// of panningLaws; another: none was asked for, so linear, and grains by grainSpread
    void placed(int law);

    bool pop(CollisionEvent& event) noexcept { return take(events_, event); } // these two: for the renderer
    bool pop(RenderControl& change) noexcept { return take(controls_, change); }

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
    // the renderer's frame 0
    std::int64_t firstFrame() const noexcept { return law_.playOutFrames() - law_.limiterFrames; }
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
    std::deque<RenderControl> controls_;
    std::vector<float> samples_, poses_;
    std::array<std::optional<Hand>, fingers> hands_;
    std::optional<PanningLaw> panningLaw_;
    std::string fault_;
    std::size_t outputs_;
    std::int64_t done_ = 0; // frames
};

} // namespace physvib
