// SPDX-License-Identifier: GPL-3.0-or-later
// The file of --movie: an animated WebP by libwebp; GIF and MP4 by the program ffmpeg, if it is there.
#pragma once
#include "Io/Disk/AtomicFile.h"
#include "Pictures/RenderMovie.h"
#include "Scene/World/SceneRun.h"
#include <optional>

namespace physvib {

/// Errors are one line each; after one, or without commit(), nothing is left behind. M only.
class MovieOutput {
public:
    MovieOutput(const std::string& path, int sampleRateHz); ///< makes sure that it can be written: error()
    const std::string& error() const noexcept { return movie_.error(); }

    bool hasSound() const noexcept { return path_.ends_with(".mp4"); }
    bool takeSound(const float* samples, int frames); ///< the next frames of one channel

    /// All pictures, with the bodies of `picture.scene` on their way. Returns an error or "".
    std::string draw(const PictureInput& picture, const SceneRun& run);
    [[nodiscard]] const std::string& commit() { return movie_.commit(); }

private:
    std::string drawWebp(const RenderMovie& movie, const PictureInput& picture, const SceneRun& run);
    std::string drawByFfmpeg(const RenderMovie& movie, const PictureInput& picture, const SceneRun& run);

    std::string path_;
    int sampleRateHz_;
    AtomicFile movie_;
    std::optional<AtomicFile> pictures_, sound_; // what ffmpeg reads, beside the movie while it is made
    std::int64_t pictureBytes_ = 0, soundBytes_ = 0;
};

} // namespace physvib
