// SPDX-License-Identifier: GPL-3.0-or-later
// Movie files: animated WebP by libwebp; GIF and MP4 by the program ffmpeg, if installed; movies of sessions.
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

/// Body poses at 0, everyNs, 2 everyNs... before `endNs`; empty for events without a world.
using PoseSource = std::function<void(std::int64_t everyNs, std::int64_t endNs, const TakeWatch& see)>;

/// Errors are one line each. After an error, or without commit(), no file remains. One thread at a time.
class MovieOutput {
public:
    /// Checks that the file can be written: error().
    MovieOutput(const std::string& path, int sampleRateHz, int ears = 1)
        : path_{path}
        , sampleRateHz_{sampleRateHz}
        , ears_{ears}
        , movie_{path} {
        if (!path.ends_with(".webp")) pictures_.emplace(path + ".pictures");
        if (hasSound()) sound_.emplace(path + ".sound");
    }
    const std::string& error() const noexcept { return movie_.error(); }

    bool hasSound() const noexcept { return path_.ends_with(".mp4"); }
    /// Next frames of the sound track.
    bool takeSound(const float* const* channels, int frames) {
        frames_.clear();
        for (int k = 0; k < frames; ++k)
            for (int c = 0; c < ears_; ++c) frames_.push_back(channels[c][k]);
        const std::string_view bytes{reinterpret_cast<const char*>(frames_.data()),
                                     sizeof(float) * frames_.size()};
        if (!sound_->writeAt(soundBytes_, bytes)) return false;
        soundBytes_ += static_cast<std::int64_t>(bytes.size());
        return true;
    }

    /// Draws all pictures, with the bodies' poses. `keepGoing` gets progress from 0 to 1; if it returns
    /// false, drawing stops with the error "cancelled". Returns an error or "".
    std::string draw(const PictureInput& picture, const PoseSource& bodies,
                     const std::function<bool(double)>& keepGoing = {}) {
        const RenderMovie movie{picture};
        const std::int64_t everyNs = RenderMovie::timeNs(1), endNs = RenderMovie::timeNs(movie.count());
        bool isWhole = true;
        const Pictures all = [&](const auto& take) {
            const auto one = [&](std::int64_t timeNs, const picture::Image& image) {
                isWhole = !keepGoing || keepGoing(static_cast<double>(timeNs) / static_cast<double>(endNs));
                return isWhole && take(timeNs, image);
            };
            if (bodies)
                return bodies(everyNs, endNs,
                              [&](std::int64_t timeNs, const Scene& scene, const WorldPoses& poses) {
                                  return one(timeNs, movie.at(timeNs, poses, &scene));
                              });
            for (std::int64_t timeNs = 0; timeNs < endNs; timeNs += everyNs)
                if (!one(timeNs, movie.at(timeNs, {}))) return;
        };
        const auto watch = [&] { return isWhole = isWhole && (!keepGoing || keepGoing(1.0)); };
        const std::string error = pictures_ ? drawByFfmpeg(all, watch) : drawWebp(movie, all);
        return isWhole ? error : "cancelled";
    }
    [[nodiscard]] const std::string& commit() { return movie_.commit(); }

private:
    using Pictures =
        std::function<void(const std::function<bool(std::int64_t momentNs, const picture::Image&)>& take)>;
    std::string drawWebp(const RenderMovie& movie, const Pictures& all) {
        WebpMovie webp{RenderMovie::width, RenderMovie::height};
        all([&](std::int64_t momentNs, const picture::Image& image) {
            webp.add(image, momentNs / 1'000'000);
            return true;
        });
        return movie_.write(webp.bytes(RenderMovie::timeNs(movie.count()) / 1'000'000));
    }
    // ffmpeg reads finished files (concatenated PNGs, 32-bit samples) and writes a temporary file, which
    // commit() renames.
    std::string drawByFfmpeg(const Pictures& all, const std::function<bool()>& keepGoing) {
        all([&](std::int64_t, const picture::Image& image) {
            const std::string png = image.png();
            const bool isWritten = pictures_->writeAt(pictureBytes_, png);
            pictureBytes_ += static_cast<std::int64_t>(png.size());
            return isWritten;
        });
        for (const auto* beside : {&pictures_, &sound_})
            if (*beside && !(*beside)->error().empty())
                return path_ + (*beside)->error().substr((*beside)->error().find(": cannot be written"));
        if (!keepGoing()) return {};
        std::vector<std::string> words;
        const auto add = [&words](std::initializer_list<const char*> more) {
            words.insert(words.end(), more.begin(), more.end());
        };
        // without -xerror, ffmpeg takes a full disk at the end of its file for success
        add({"-v", "error", "-xerror", "-nostdin", "-y", "-f", "image2pipe", "-c:v", "png", "-framerate"});
        words.insert(words.end(), {std::to_string(RenderMovie::picturesPerSecond), "-i",
                                   pictures_->temporaryPath().string()});
        if (sound_) {
            add({"-f", "f32le", "-ac"});
            words.insert(words.end(), {std::to_string(ears_), "-ar", std::to_string(sampleRateHz_)});
            words.insert(words.end(), {"-i", sound_->temporaryPath().string()});
            add({"-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "20", "-c:a", "aac", "-movflags",
                 "+faststart", "-f", "mp4"});
        } else
            add({"-filter_complex", "split[a][b];[a]palettegen[p];[b][p]paletteuse=dither=none", "-f",
                 "gif"});
        words.push_back(movie_.temporaryPath().string());
        const auto ran = runWatched("ffmpeg", words, keepGoing);
        if (!ran)
            return path_ + ": .gif and .mp4 need the program ffmpeg, which did not start (" + ran.error +
                   "); expected it on the path, or a name that ends in .webp";
        return ran.value.empty() ? std::string{} : path_ + ": ffmpeg failed: " + ran.value;
    }

    std::string path_;
    int sampleRateHz_, ears_;
    std::vector<float> frames_; // interleaved, of one block
    AtomicFile movie_;
    std::optional<AtomicFile> pictures_, sound_; // temporary input files of ffmpeg, beside the movie
    std::int64_t pictureBytes_ = 0, soundBytes_ = 0;
};

constexpr double longestMovieSeconds = 600.0; ///< limits memory and disk space for pictures

/// The ending of a movie with sound, if this computer can write one, else of one without. Any thread but R.
inline std::string movieEnding() { return hasProgram("ffmpeg") ? ".mp4" : ".webp"; }

/// Writes a movie of the last `seconds` of the session, with all its scene runs and impacts in order
/// and the output of the actuators of `layout`; an .mp4 also has the sound of each contact, left and right,
/// as the mixer's monitor plays it at its usual level. The file appears complete or not at all. `progress`
/// gets shares of 0 to 1 and cancels by returning false. Returns an empty string or one error line,
/// "cancelled" if so. Any thread but the render thread.
std::string writeSessionMovie(const SavedSession& session, const LayoutDescription& layout, double seconds,
                              const std::string& path, const std::function<bool(double)>& progress);

} // namespace physvib
