// SPDX-License-Identifier: GPL-3.0-or-later
// Output files of a render: WAV, event list, picture, movie, motor commands, on/off pattern. They appear
// together at the end, or not at all.
#pragma once
#include "Calls/LoadedRender.h"
#include "Calls/MovieOutput.h"
#include "Core/Actuators/VibrationConverter.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Provenance.h"
#include "Io/Text/NumberText.h"
#include "Io/Wav/WavSink.h"
#include "Pictures/WaveformEnvelope.h"
#include "Scene/PadFile.h"
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace physvib {

/// Collects a render as on and off times, for motors without other states. csv() is `channel,on_s,off_s`, a
/// line per pulse, channels from 1. Message thread.
class OnOffPattern final : public VibrationConverter {
public:
    OnOffPattern(int channels, int sampleRateHz, double threshold)
        : steps_(static_cast<std::size_t>(channels), OnOffSteps{sampleRateHz, threshold})
        , rows_(static_cast<std::size_t>(channels)) {}

    bool convert(const float* const* channels, int frames) override {
        for (std::size_t j = 0; j < steps_.size(); ++j)
            for (int n = 0; n < frames; ++n)
                steps_[j].add(channels[j][n], [&](long long step, bool isOn) { addEdge(j, step, isOn); });
        return true;
    }

    std::string csv(const Provenance& provenance) const {
        std::string text = provenanceComment(provenance) + "channel,on_s,off_s\n";
        for (std::size_t j = 0; j < rows_.size(); ++j)
            text += rows_[j] + (steps_[j].isOn() ? secondsText(steps_[j].steps()) + "\n" : "");
        return text;
    }

private:
    static std::string secondsText(long long step) {
        return fixedNumber(static_cast<double>(step) / OnOffSteps::stepsPerSecond, 2);
    }
    void addEdge(std::size_t channel, long long step, bool isOn) {
        rows_[channel] +=
            isOn ? std::to_string(channel + 1) + "," + secondsText(step) + "," : secondsText(step) + "\n";
    }

    std::vector<OnOffSteps> steps_;
    std::vector<std::string> rows_;
};

/// A copy of a block of samples, each channel multiplied by its own scale. Message thread.
class ScaledBlock {
public:
    /// Valid until the next call.
    const float* const* copyScaled(const float* const* channels, int count, int frames, const auto& scales) {
        samples_.resize(static_cast<std::size_t>(count));
        pointers_.clear();
        for (std::size_t j = 0; j < samples_.size(); ++j) {
            const auto scale = static_cast<float>(scales[j]);
            samples_[j].assign(channels[j], channels[j] + frames);
            for (float& sample : samples_[j]) sample *= scale;
            pointers_.push_back(samples_[j].data());
        }
        return pointers_.data();
    }

private:
    std::vector<std::vector<float>> samples_;
    std::vector<const float*> pointers_;
};

/// Writes all output files of a render. Errors are one line each; after one, no file is left. Message thread.
class RenderOutputs {
public:
    /// `job` outlives this object; its layout is known, its events need not be.
    explicit RenderOutputs(const LoadedRender& job);

    /// Opens every requested file. Returns an empty string or one error line.
    std::string open();

    /// To be called when the job's events are known: the picture enlarges the strongest one.
    void startZoom();

    /// Computes the commands of a game controller from the events and these controls, if requested.
    void computeMotorCommands(const std::vector<RenderControl>& controls);

    /// Writes the next frames of all actuators; false after an error.
    bool write(const float* const* channels, int frames);

    /// True if an output needs the contact sound: --contact-sound, or a movie.
    bool needsContactSound() const noexcept { return contactWav_ || (movie_ && movie_->hasSound()); }

    /// Writes the next frames of the contact sound; false after an error.
    bool writeContactSound(const float* const* channels, int frames);

    /// Writes the next frames of the onset markers; false after an error.
    bool writeMarks(const float* samples, int frames) { return markerWav_->write(&samples, frames); }

    void setMarkSummary(const OnsetMarks& marks); ///< text for summarise()

    /// Completes all files and puts them in place. Returns an empty string or one error line.
    std::string finish();

    /// Prints a line per file with its contents.
    void summarise(std::ostream& out) const;

private:
    std::string openMotors();
    Provenance provenance() const;
    Provenance inputProvenance() const;
    std::string provenanceText() const;
    RunSettings sceneRun() const; ///< of the session's first scene, for pictures and movies
    PoseSource poses() const;
    PictureInput pictureInput() const;
    std::string writePictureFile();
    void showProgress();
    bool writeWav(const float* const* channels, int frames);

    const LoadedRender& job_;
    std::optional<AtomicFile> eventsFile_, pictureFile_, patternFile_, motorsFile_;
    PadProfile padProfile_;
    std::vector<PadCommand> motorCommands_;
    std::optional<WavSink> wav_, contactWav_, markerWav_;
    ScaledBlock voltBlock_;
    std::string markSummary_;
    OnOffPattern onOffPattern_;
    WaveformEnvelope envelope_;
    std::optional<MovieOutput> movie_;
    std::optional<WaveformEnvelope> zoomEnvelope_;
    std::int64_t framesWritten_ = 0;
    int lastPercent_ = -1;
};

} // namespace physvib
