// SPDX-License-Identifier: MIT
// Draws the picture of a render from samples collected during rendering.
#pragma once
#include "Io/Disk/AtomicFile.h"
#include "Pictures/RenderPicture.h"

namespace physvib {

/// Receives the samples as they are rendered. Message thread.
class RenderedPicture {
public:
    /// Checks that the file can be written; see error(). `events` outlive this object.
    RenderedPicture(const std::string& path, std::span<const CollisionEvent> events, int channels,
                    int sampleRateHz, std::int64_t frames);

    /// Empty, or one line with file and reason.
    const std::string& error() const noexcept { return file_.error(); }

    /// Appends frames of each channel.
    void take(const float* const* channels, int frames) {
        whole_.add(channels, frames);
        zoom_.add(channels, frames);
    }

    /// Draws the picture with the texts of `words`; adds events and samples. Returns error().
    const std::string& draw(PictureInput words);

    /// Moves the file to its final name. Returns error().
    const std::string& commit() { return file_.commit(); }

private:
    AtomicFile file_;
    std::span<const CollisionEvent> events_;
    int sampleRateHz_;
    WaveformEnvelope whole_, zoom_;
};

} // namespace physvib
