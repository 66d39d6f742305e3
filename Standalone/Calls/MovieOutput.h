// SPDX-License-Identifier: GPL-3.0-or-later
// Movie files: animated WebP by libwebp; GIF and MP4 by the program ffmpeg, if installed.
#pragma once
#include "Io/Disk/AtomicFile.h"
#include "Pictures/RenderMovie.h"
#include "Scene/World/SceneRun.h"
#include <functional>
#include <optional>

namespace physvib {

/// Body poses at 0, everyNs, 2 everyNs... before `endNs`; empty for events without a world.
using PoseSource = std::function<void(std::int64_t everyNs, std::int64_t endNs, const TakeWatch& see)>;

/// Errors are one line each. After an error, or without commit(), no file remains. One thread at a time.
class MovieOutput {
public:
    MovieOutput(const std::string& path, int sampleRateHz); ///< checks that the file can be written: error()
    const std::string& error() const noexcept { return movie_.error(); }

    bool hasSound() const noexcept { return path_.ends_with(".mp4"); }
    bool takeSound(const float* samples, int frames); ///< next frames of the mono sound track

    /// Draws all pictures, with the bodies' poses. `goesOn` gets progress from 0 to 1; if it returns false,
    /// drawing stops with the error "cancelled". Returns an error or "".
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
    std::optional<AtomicFile> pictures_, sound_; // temporary input files of ffmpeg, beside the movie
    std::int64_t pictureBytes_ = 0, soundBytes_ = 0;
};

} // namespace physvib
