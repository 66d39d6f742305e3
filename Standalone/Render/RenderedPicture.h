// SPDX-License-Identifier: MIT
// The picture of a render: what it needs of the samples while they are made.
#pragma once
#include "Io/Disk/AtomicFile.h"
#include "Pictures/RenderPicture.h"

namespace physvib {

/// Takes the samples as they are rendered. M only.
class RenderedPicture {
public:
    /// Makes sure that the file can be written; see error(). `events` outlive this object.
    RenderedPicture(const std::string& path, std::span<const CollisionEvent> events, int channels,
                    int sampleRateHz, std::int64_t frames);

    /// Empty, or one line with the file and the reason.
    const std::string& error() const noexcept { return file_.error(); }

    /// The next frames of each channel.
    void take(const float* const* channels, int frames) {
        whole_.add(channels, frames);
        zoom_.add(channels, frames);
    }

    /// Draws `words`, to which this adds events, sound and its rate. Returns error().
    const std::string& draw(PictureInput words);

    /// Puts the file in its place. Returns error().
    const std::string& commit() { return file_.commit(); }

private:
    AtomicFile file_;
    std::span<const CollisionEvent> events_;
    int sampleRateHz_;
    WaveformEnvelope whole_, zoom_;
};

} // namespace physvib
