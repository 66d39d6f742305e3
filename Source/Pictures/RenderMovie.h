// SPDX-License-Identifier: MIT
// A render as a movie: the world and its impacts over time, and the signal of each actuator so far.
#pragma once
#include "Pictures/Image.h"
#include "Pictures/RenderPicture.h"
#include <cstdint>
#include <memory>
#include <string>

namespace physvib {
/// The pictures of one render, in any order; equal pixels for equal input and fonts. One thread at a time.
class RenderMovie {
public:
    static constexpr int picturesPerSecond = 20;
    static constexpr int width = 960, height = 640; ///< pixels; even, as video formats require

    /// `input` and what it names outlive this object. Its bodies and its zoom are not used.
    explicit RenderMovie(const PictureInput& input);
    ~RenderMovie();
    RenderMovie(const RenderMovie&) = delete;
    RenderMovie& operator=(const RenderMovie&) = delete;

    /// Number of pictures, at least one.
    std::int64_t count() const noexcept;
    /// When picture `index` is shown, in nanoseconds of the render.
    static std::int64_t timeNs(std::int64_t index) noexcept {
        return index * (1'000'000'000 / picturesPerSecond);
    }

    /// The picture of that moment with these poses; `scene`, if not null, replaces the input's scene.
    picture::Image draw(std::int64_t momentNs, const WorldPoses& poses, const Scene* scene = nullptr) const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

// Encoder of movies as animated WebP, by libwebp.

/// Pictures of one size, by time. One thread at a time. Throws std::runtime_error if libwebp fails.
class WebpMovie {
public:
    WebpMovie(int width, int height);
    ~WebpMovie();
    WebpMovie(const WebpMovie&) = delete;
    WebpMovie& operator=(const WebpMovie&) = delete;

    void add(const picture::Image& image, std::int64_t timeMs); ///< shown from then on

    /// The whole file, which repeats endlessly; the last picture is shown until `endMs`. Call it once.
    std::string bytes(std::int64_t endMs);

private:
    struct Encoder;
    std::unique_ptr<Encoder> encoder_;
};

} // namespace physvib
