// SPDX-License-Identifier: MIT
// A render as a movie: the world and its impacts over time, and the signal of each actuator so far.
#pragma once
#include "Pictures/RenderPicture.h"
#include <memory>
#include <span>

namespace physvib {

/// The pictures of one render, in any order of time. One thread at a time; draws the same pixels for the same
/// input and fonts.
class RenderMovie {
public:
    static constexpr int picturesPerSecond = 20;
    static constexpr int width = 960, height = 640; ///< pixels; even, as video formats want

    /// `input` and what it names outlive this object. Its bodies and its zoom are not looked at.
    explicit RenderMovie(const PictureInput& input);
    ~RenderMovie();
    RenderMovie(const RenderMovie&) = delete;
    RenderMovie& operator=(const RenderMovie&) = delete;

    /// How many pictures the render has: one at least.
    std::int64_t count() const noexcept;
    /// When picture `index` is shown, in nanoseconds of the render.
    static std::int64_t timeNs(std::int64_t index) noexcept {
        return index * (1'000'000'000 / picturesPerSecond);
    }

    /// The picture of that moment, with bodies and joints where they are then; of another scene than the
    /// input's, if one is given.
    picture::Image at(std::int64_t momentNs, const WorldPoses& poses, const Scene* scene = nullptr) const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace physvib
