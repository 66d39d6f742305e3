// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the pictures of a movie in order, and encodes them with libwebp or ffmpeg.
#include "Calls/MovieOutput.h"
#include "Pictures/WebpMovie.h"
#include "System/Process.h"

namespace physvib {

MovieOutput::MovieOutput(const std::string& path, int sampleRateHz)
    : path_{path}
    , sampleRateHz_{sampleRateHz}
    , movie_{path} {
    if (!path.ends_with(".webp")) pictures_.emplace(path + ".pictures");
    if (hasSound()) sound_.emplace(path + ".sound");
}

bool MovieOutput::takeSound(const float* samples, int frames) {
    const std::string_view bytes{reinterpret_cast<const char*>(samples),
                                 sizeof(float) * static_cast<std::size_t>(frames)};
    if (!sound_->writeAt(soundBytes_, bytes)) return false;
    soundBytes_ += static_cast<std::int64_t>(bytes.size());
    return true;
}

std::string MovieOutput::draw(const PictureInput& picture, const PoseSource& bodies,
                              const std::function<bool(double)>& goesOn) {
    const RenderMovie movie{picture};
    const std::int64_t everyNs = RenderMovie::timeNs(1), endNs = RenderMovie::timeNs(movie.count());
    bool isWhole = true;
    const Pictures all = [&](const auto& take) {
        const auto one = [&](std::int64_t timeNs, const picture::Image& image) {
            isWhole = !goesOn || goesOn(static_cast<double>(timeNs) / static_cast<double>(endNs));
            return isWhole && take(timeNs, image);
        };
        if (bodies)
            return bodies(everyNs, endNs,
                          [&](std::int64_t timeNs, const Scene& scene, std::span<const BodyPose> poses) {
                              return one(timeNs, movie.at(timeNs, poses, &scene));
                          });
        for (std::int64_t timeNs = 0; timeNs < endNs; timeNs += everyNs)
            if (!one(timeNs, movie.at(timeNs, {}))) return;
    };
    const std::string error = pictures_ ? drawByFfmpeg(all) : drawWebp(movie, all);
    return isWhole ? error : "cancelled";
}

std::string MovieOutput::drawWebp(const RenderMovie& movie, const Pictures& all) {
    WebpMovie webp{RenderMovie::width, RenderMovie::height};
    all([&](std::int64_t momentNs, const picture::Image& image) {
        webp.add(image, momentNs / 1'000'000);
        return true;
    });
    return movie_.write(webp.bytes(RenderMovie::timeNs(movie.count()) / 1'000'000));
}

// ffmpeg reads finished files (concatenated PNGs, 32-bit samples) and writes a temporary file, which commit()
// renames.
std::string MovieOutput::drawByFfmpeg(const Pictures& all) {
    all([&](std::int64_t, const picture::Image& image) {
        const std::string png = image.png();
        const bool isWritten = pictures_->writeAt(pictureBytes_, png);
        pictureBytes_ += static_cast<std::int64_t>(png.size());
        return isWritten;
    });
    if (!pictures_->error().empty()) return pictures_->error();
    if (sound_ && !sound_->error().empty()) return sound_->error();
    std::vector<std::string> words{
        "-v",   "error",      "-nostdin",   "-y",
        "-f",   "image2pipe", "-framerate", std::to_string(RenderMovie::picturesPerSecond),
        "-c:v", "png",        "-i",         pictures_->temporaryPath().string()};
    const auto add = [&words](std::initializer_list<const char*> more) {
        words.insert(words.end(), more.begin(), more.end());
    };
    if (sound_) {
        add({"-f", "f32le", "-ac", "1", "-ar"});
        words.push_back(std::to_string(sampleRateHz_));
        words.insert(words.end(), {"-i", sound_->temporaryPath().string()});
        add({"-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "20", "-c:a", "aac", "-movflags", "+faststart",
             "-f", "mp4"});
    } else
        add({"-filter_complex", "split[a][b];[a]palettegen[p];[b][p]paletteuse=dither=none", "-f", "gif"});
    words.push_back(movie_.temporaryPath().string());
    const auto ran = runProgram("ffmpeg", words);
    if (!ran)
        return path_ + ": .gif and .mp4 need the program ffmpeg, which did not start (" + ran.error +
               "); expected it on the path, or a name that ends in .webp";
    return ran.value ? std::string{} : path_ + ": ffmpeg failed, for the reason above";
}

} // namespace physvib
