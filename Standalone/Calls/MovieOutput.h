// SPDX-License-Identifier: GPL-3.0-or-later
// Writes movie files: animated WebP by libwebp; GIF and MP4 by the program ffmpeg, if installed; also of
// sessions.
#pragma once
#include "Io/Disk/AtomicFile.h"
#include "Live/Documents/SessionFile.h"
#include "Pictures/RenderMovie.h"
#include "Scene/World/Simulation.h"
#include "System/Process.h"
#include <functional>
#include <optional>
#include <string>

namespace physvib {

/// Calls `watch` with the poses of bodies at 0, everyNs, 2 everyNs... before `endNs`; empty: no world.
using PoseSource = std::function<void(std::int64_t everyNs, std::int64_t endNs, const RunPoseWatch& watch)>;

/// Errors are one line each; after an error, or without commit(), no file remains. One thread at a time.
class MovieOutput {
public:
    /// Begins the file at `path`, whose ending gives the format; see error().
    MovieOutput(const std::string& path, int sampleRateHz, int soundChannels = 1)
        : path_{path}
        , sampleRateHz_{sampleRateHz}
        , soundChannels_{soundChannels}
        , movie_{path} {
        if (!path.ends_with(".webp")) pictures_.emplace(path + ".pictures");
        if (hasSound()) sound_.emplace(path + ".sound");
    }
    const std::string& error() const noexcept { return movie_.error(); }

    bool hasSound() const noexcept { return path_.ends_with(".mp4"); }
    /// Appends frames to the sound track; false after an error. Only if hasSound().
    bool writeSound(const float* const* channels, int frames) {
        frames_.clear();
        for (int k = 0; k < frames; ++k)
            for (int c = 0; c < soundChannels_; ++c) frames_.push_back(channels[c][k]);
        const std::string_view bytes{reinterpret_cast<const char*>(frames_.data()),
                                     sizeof(float) * frames_.size()};
        if (!sound_->writeAt(soundBytes_, bytes)) return false;
        soundBytes_ += static_cast<std::int64_t>(bytes.size());
        return true;
    }

    /// Draws all pictures and writes the movie. `keepGoing` is called with the progress from 0 to 1;
    /// returning false stops with the error "cancelled". Returns an error or "".
    std::string draw(const PictureInput& picture, const PoseSource& bodies,
                     const std::function<bool(double)>& keepGoing = {}) {
        const RenderMovie movie{picture};
        const std::int64_t everyNs = RenderMovie::timeNs(1), endNs = RenderMovie::timeNs(movie.count());
        bool isComplete = true;
        const Pictures forEachPicture = [&](const auto& receive) {
            const auto addPicture = [&](std::int64_t timeNs, const picture::Image& image) {
                isComplete =
                    !keepGoing || keepGoing(static_cast<double>(timeNs) / static_cast<double>(endNs));
                return isComplete && receive(timeNs, image);
            };
            if (bodies)
                return bodies(everyNs, endNs,
                              [&](std::int64_t timeNs, const Scene& scene, const WorldPoses& poses) {
                                  return addPicture(timeNs, movie.draw(timeNs, poses, &scene));
                              });
            for (std::int64_t timeNs = 0; timeNs < endNs; timeNs += everyNs)
                if (!addPicture(timeNs, movie.draw(timeNs, {}))) return;
        };
        const auto keepDrawing = [&] { return isComplete = isComplete && (!keepGoing || keepGoing(1.0)); };
        const std::string error =
            pictures_ ? writeByFfmpeg(forEachPicture, keepDrawing) : writeWebp(movie, forEachPicture);
        return isComplete ? error : "cancelled";
    }
    [[nodiscard]] const std::string& commit() { return movie_.commit(); }

private:
    using Pictures =
        std::function<void(const std::function<bool(std::int64_t momentNs, const picture::Image&)>& receive)>;
    std::string writeWebp(const RenderMovie& movie, const Pictures& forEachPicture) {
        WebpMovie webp{RenderMovie::width, RenderMovie::height};
        forEachPicture([&](std::int64_t momentNs, const picture::Image& image) {
            webp.add(image, momentNs / 1'000'000);
            return true;
        });
        return movie_.write(webp.bytes(RenderMovie::timeNs(movie.count()) / 1'000'000));
    }
    // ffmpeg reads finished files (concatenated PNGs, 32-bit samples) and writes a temporary file, which
    // commit() renames.
    std::string writeByFfmpeg(const Pictures& forEachPicture, const std::function<bool()>& keepGoing) {
        forEachPicture([&](std::int64_t, const picture::Image& image) {
            const std::string png = image.png();
            const bool isWritten = pictures_->writeAt(pictureBytes_, png);
            pictureBytes_ += static_cast<std::int64_t>(png.size());
            return isWritten;
        });
        for (const auto* input : {&pictures_, &sound_})
            if (*input && !(*input)->error().empty())
                return path_ + (*input)->error().substr((*input)->error().find(": cannot be written"));
        if (!keepGoing()) return {};
        std::vector<std::string> words;
        const auto add = [&words](std::initializer_list<const char*> moreWords) {
            words.insert(words.end(), moreWords.begin(), moreWords.end());
        };
        // without -xerror, ffmpeg reports success if the disk is full at the end of its file
        add({"-v", "error", "-xerror", "-nostdin", "-y", "-f", "image2pipe", "-c:v", "png", "-framerate"});
        words.insert(words.end(), {std::to_string(RenderMovie::picturesPerSecond), "-i",
                                   pictures_->temporaryPath().string()});
        if (sound_) {
            add({"-f", "f32le", "-ac"});
            words.insert(words.end(), {std::to_string(soundChannels_), "-ar", std::to_string(sampleRateHz_)});
            words.insert(words.end(), {"-i", sound_->temporaryPath().string()});
            add({"-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "20", "-c:a", "aac", "-movflags",
                 "+faststart", "-f", "mp4"});
        } else
            add({"-filter_complex", "split[a][b];[a]palettegen[p];[b][p]paletteuse=dither=none", "-f",
                 "gif"});
        words.push_back(movie_.temporaryPath().string());
        const auto result = runWatched("ffmpeg", words, keepGoing);
        if (!result)
            return path_ + ": .gif and .mp4 need the program ffmpeg, which did not start (" + result.error +
                   "); expected it on the path, or a name that ends in .webp";
        return result.value.empty() ? std::string{} : path_ + ": ffmpeg failed: " + result.value;
    }

    std::string path_;
    int sampleRateHz_, soundChannels_;
    std::vector<float> frames_; // of one block, interleaved
    AtomicFile movie_;
    std::optional<AtomicFile> pictures_, sound_; // temporary input files of ffmpeg, beside the movie
    std::int64_t pictureBytes_ = 0, soundBytes_ = 0;
};

constexpr double maxMovieSeconds = 600.0; ///< limits memory and disk space for pictures

/// Ending of movies on this computer: .mp4, with sound, if ffmpeg is installed, else .webp. Not on the render
/// thread.
inline std::string movieEnding() { return hasProgram("ffmpeg") ? ".mp4" : ".webp"; }

/// Writes a movie of the last `seconds` of the session: its scene runs, impacts and the outputs of the
/// actuators of `layout`; an .mp4 also has the contact sound in stereo, as the mixer's monitor plays it at
/// its default level. The file appears complete or not at all. `progress` is called with shares from 0 to 1
/// and cancels by returning false. Returns "", an error line or "cancelled". Not on the render thread.
std::string writeSessionMovie(const SavedSession& session, const LayoutDescription& layout, double seconds,
                              const std::string& path, const std::function<bool(double)>& progress);

} // namespace physvib
