// SPDX-License-Identifier: GPL-3.0-or-later
// The file of a movie: an animated WebP by libwebp; GIF and MP4 by the program ffmpeg, if it is there.
#pragma once
#include "Io/Disk/AtomicFile.h"
#include "Pictures/RenderMovie.h"
#include "Scene/World/SceneRun.h"
#include <functional>
#include <optional>

namespace physvib {

/// Where bodies are at 0, everyNs, 2 everyNs... of a movie before `endNs`; none: events without a world.
using PoseSource = std::function<void(std::int64_t everyNs, std::int64_t endNs, const TakeWatch& see)>;

/// Errors are one line each; after one, or without commit(), nothing is left behind. One thread at a time.
class MovieOutput {
public:
    MovieOutput(const std::string& path, int sampleRateHz); ///< makes sure that it can be written: error()
    const std::string& error() const noexcept { return movie_.error(); }

    bool hasSound() const noexcept { return path_.ends_with(".mp4"); }
    bool takeSound(const float* samples, int frames); ///< the next frames of one channel

    /// All pictures, with the bodies on their way; `goesOn` gets shares of 0 to 1, and false from it ends
    /// that: "cancelled". Returns an error or "".
    std::string draw(const PictureInput& picture, const PoseSource& bodies,
                     const std::function<bool(double)>& goesOn = {});
    [[nodiscard]] const std::string& commit() { return movie_.commit(); }

private:
    using Pictures =
        std::function<void(const std::function<bool(std::int64_t momentNs, const picture::Image&)>& take)>;
    std::string drawWebp(const RenderMovie& movie, const Pictures& all);
    std::string drawByFfmpeg(const Pictures& all);

    std::string path_;
    int sampleRateHz_;
    AtomicFile movie_;
    std::optional<AtomicFile> pictures_, sound_; // what ffmpeg reads, beside the movie while it is made
    std::int64_t pictureBytes_ = 0, soundBytes_ = 0;
};

} // namespace physvib
