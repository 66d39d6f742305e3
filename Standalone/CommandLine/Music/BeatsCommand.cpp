// SPDX-License-Identifier: GPL-3.0-or-later
// The command `physvib beats`: processes a music file in blocks, into events or a low-passed signal. Output
// files are complete or not written.
#include "CommandLine/Command.h"
#include "CommandLine/Measure/RecordingList.h"
#include "CommandLine/Music/BeatOptions.h"
#include "Host/Music/BeatDetector.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Disk/FileClash.h"
#include "Io/Text/NameList.h"
#include "Io/Wav/WavSink.h"
#include "Live/Recordings/ReadRecording.h"
#include "Live/Session/OfflineRender.h"
#include "Scene/EventsCsv.h"
#include "Scene/LayoutFile.h"
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

namespace physvib {
namespace {

struct MusicOptions {
    std::string music;
    std::string eventsPath, wavPath; ///< empty: not written
    bool playsMusic = false;         ///< write the low-passed music itself to the WAV
    std::string band;                ///< its band in Hz; empty: default
    std::string actuators;           ///< actuators that play it; empty: all
    std::string layout = "phone4";
    BeatOptions beats;
};

Provenance provenanceOf(const MusicOptions& o) {
    return {PHYSVIB_VERSION, {{"music", fileNameOf(o.music)}, {"layout", o.layout}}};
}

std::string rateError(int rateHz) {
    if (isSampleRate(rateHz)) return {};
    return "expected a rate of " + std::to_string(limits::minSampleRateHz) + " to " +
           std::to_string(limits::maxSampleRateHz) + " Hz, found " + std::to_string(rateHz) + " Hz";
}

/// Averages all channels of the music.
class MonoReceiver : public SoundReceiver {
public:
    int rateHz() const noexcept { return static_cast<int>(format_.sampleRateHz); }
    std::int64_t frames() const noexcept { return format_.frames; }

    std::string begin(const SoundFormat& format) final {
        format_ = format;
        std::string error = streamError(format);
        if (error.empty()) error = rateError(rateHz());
        return error.empty() ? open() : error;
    }
    std::string receive(const float* const* channels, int frames) final {
        mono_.assign(static_cast<std::size_t>(frames), 0.0f);
        const float share = 1.0f / static_cast<float>(format_.channels);
        for (std::int64_t j = 0; j < format_.channels; ++j)
            for (std::size_t i = 0; i < mono_.size(); ++i) mono_[i] += share * channels[j][i];
        return processMono(mono_);
    }

protected:
    ~MonoReceiver() = default;

private:
    virtual std::string open() = 0;
    virtual std::string processMono(std::span<float> mono) = 0;

    SoundFormat format_;
    std::vector<float> mono_;
};

class BeatReceiver final : public MonoReceiver {
public:
    BeatReceiver(const BeatOptions& options, const BeatVoices& voices, const ActuatorLayout& layout)
        : options_{options}
        , voices_{voices}
        , layout_{layout} {}

    /// Detected beats in time order.
    std::vector<CollisionEvent>& events() {
        std::ranges::stable_sort(events_, {}, &CollisionEvent::timeNs);
        return events_;
    }
    const std::array<std::size_t, beatBands.size()>& counts() const noexcept { return counts_; }

private:
    std::string open() override {
        detector_ = std::make_unique<BeatDetector>(rateHz(), options_.sensitivity);
        return {};
    }
    std::string processMono(std::span<float> mono) override {
        detector_->process(mono, [this](const BandOnset& onset) { addBeat(onset); });
        return events_.size() <= limits::maxEventRows
                   ? ""
                   : "expected at most " + std::to_string(limits::maxEventRows) + " strikes";
    }
    void addBeat(const BandOnset& onset) {
        const std::int64_t rate = rateHz(), ns = 1'000'000'000;
        const std::int64_t timeNs = onset.frame / rate * ns + onset.frame % rate * ns / rate;
        makeBeatEvents(onset, timeNs, voices_, layout_, layout_.extentWidthMetres, layout_.extentHeightMetres,
                       [this](const CollisionEvent& e) { events_.push_back(e); });
        ++counts_[static_cast<std::size_t>(onset.band)];
    }

    const BeatOptions& options_;
    const BeatVoices& voices_;
    const ActuatorLayout& layout_;
    std::unique_ptr<BeatDetector> detector_;
    std::vector<CollisionEvent> events_;
    std::array<std::size_t, beatBands.size()> counts_{};
};

/// Writes the filtered music to a WAV file, on the channels of some actuators.
class BandReceiver final : public MonoReceiver {
public:
    BandReceiver(const MusicOptions& options, int channels, ActuatorSet actuators, FrequencyBand band)
        : options_{options}
        , actuators_{actuators}
        , band_{band}
        , channels_(static_cast<std::size_t>(channels)) {}
    std::string finish() { return wav_->finish(); }

private:
    std::string open() override {
        if (band_.lowHz >= 0.5 * rateHz())
            return "expected a band that begins below half the rate, " + std::to_string(rateHz() / 2) + " Hz";
        bandPass_.emplace(band_, rateHz());
        return wav_
            .emplace(options_.wavPath, static_cast<int>(channels_.size()), rateHz(),
                     provenanceLine(provenanceOf(options_)))
            .error();
    }
    std::string processMono(std::span<float> mono) override {
        bandPass_->process(mono);
        const auto level = static_cast<float>(options_.beats.level);
        for (float& sample : mono) sample = std::clamp(level * sample, -1.0f, 1.0f);
        silence_.assign(mono.size(), 0.0f);
        for (std::size_t j = 0; j < channels_.size(); ++j)
            channels_[j] = actuators_[j] ? mono.data() : silence_.data();
        return wav_->write(channels_.data(), static_cast<int>(mono.size())) ? "" : wav_->error();
    }

    const MusicOptions& options_;
    ActuatorSet actuators_;
    FrequencyBand band_;
    std::vector<const float*> channels_;
    std::optional<BandPass> bandPass_;
    std::optional<WavSink> wav_;
    std::vector<float> silence_;
};

void renderWav(WavSink& wav, std::span<const CollisionEvent> events, const ActuatorLayout& layout, int rateHz,
               std::int64_t frames) {
    OfflineSettings settings;
    settings.renderer.sampleRateHz = rateHz;
    settings.renderer.panner = PhantomPanner{layout, PanningLaw::automatic, 1.0, layout.extentWidthMetres,
                                             layout.extentHeightMetres};
    settings.frames = frames;
    const RenderStatus status = renderOffline(events, settings, [&](const float* const* channels, int count) {
        return wav.write(channels, count);
    });
    warnIfAny(status.rejected, "strikes that could not be played at " + std::to_string(rateHz) + " Hz");
}

int renderBeats(const MusicOptions& o, const LayoutDescription& layout) {
    const auto voices = parseBeatVoices(o.beats, layout.geometry.count);
    if (!voices) return reportExit(exitUsage, voices.error);
    std::optional<AtomicFile> csvFile;
    if (!o.eventsPath.empty() && !csvFile.emplace(o.eventsPath).error().empty())
        return reportExit(exitFailed, csvFile->error());
    BeatReceiver beats{o.beats, voices.value, layout.geometry};
    if (const std::string error = streamRecording(o.music, beats); !error.empty())
        return reportExit(exitFailed, error);
    const auto& events = beats.events();
    if (events.empty())
        return reportExit(exitFailed, o.music + ": expected beats, found none (see --sensitivity)");
    std::optional<WavSink> wav;
    if (!o.wavPath.empty()) {
        wav.emplace(o.wavPath, layout.geometry.count, beats.rateHz(), provenanceLine(provenanceOf(o)));
        if (wav->error().empty()) renderWav(*wav, events, layout.geometry, beats.rateHz(), beats.frames());
        if (!wav->complete().empty()) return reportExit(exitFailed, wav->error());
    }
    if (csvFile && (!csvFile->write(eventsCsv(events, extentOf(layout.geometry), provenanceOf(o))).empty() ||
                    !csvFile->commit().empty()))
        return reportExit(exitFailed, csvFile->error());
    if (wav && !wav->finish().empty()) return reportExit(exitFailed, wav->error());
    std::cout << "beats";
    for (std::size_t band = 0; band < beatBands.size(); ++band)
        std::cout << (band > 0 ? ", " : ": ") << beatBands[band].name << ' ' << beats.counts()[band];
    std::cout << "; " << events.size() << " strikes\n";
    return exitDone;
}

int renderMusic(const MusicOptions& o, const LayoutDescription& layout) {
    if (o.wavPath.empty() || !o.eventsPath.empty())
        return reportExit(exitUsage,
                          "--through: expected --render FILE.wav, and no --out: music has no strikes");
    const auto band = o.band.empty() ? Result{BandPass::defaultBand} : parseBand(o.band);
    if (!band) return reportExit(exitUsage, band.error);
    const int count = layout.geometry.count;
    ActuatorSet actuators;
    actuators.set();
    if (!o.actuators.empty() && !parseActuatorLetters(o.actuators, count, actuators))
        return reportExit(exitUsage, "--enchanters: expected letters of the " + std::to_string(count) +
                                         " actuators, each once, like AC, found " + inQuotes(o.actuators));
    BandReceiver receiver{o, count, actuators, band.value};
    if (const std::string error = streamRecording(o.music, receiver); !error.empty())
        return reportExit(exitFailed, error);
    if (const std::string error = receiver.finish(); !error.empty()) return reportExit(exitFailed, error);
    std::cout << o.wavPath << "  " << count << " channels, " << numberText(band.value.lowHz) << " to "
              << numberText(band.value.highHz) << " Hz of the music\n";
    return exitDone;
}

void declareBeats(OptionTable& command, MusicOptions& o) {
    command.add("music", o.music, "WAV, AIFF, FLAC, Ogg Vorbis or Opus, of up to a day")
        .required()
        .as("MUSIC.wav");
    command.add("--out", o.eventsPath, "its beats as an event list").outputFile("EVENTS.csv");
    command
        .add("--render", o.wavPath,
             "what is felt, a channel per actuator, as long as the music and at its rate")
        .outputFile("FILE.wav");
    command.add("--through", o.playsMusic,
                "not its beats but the music itself, between the slopes of --band");
    command.add("--band", o.band, "Hz that the actuators render, with --through: 50-500 unless told")
        .as("LO-HI");
    command.add("--enchanters", o.actuators, "who feels it, with --through: all unless told").as("AC");
    command.add("--layout", o.layout, rangeList(layoutPresetNames) + ", study1 or a layout file");
    declareBeatOptions(command, o.beats);
}

int runBeats(const MusicOptions& o) {
    if (o.eventsPath.empty() && o.wavPath.empty())
        return reportExit(exitUsage, "beats: nothing to write; give --out or --render");
    if (!o.playsMusic && !(o.band.empty() && o.actuators.empty()))
        return reportExit(exitUsage,
                          "--band, --enchanters: expected with --through; see --low, --mid, --high");
    const auto layout = resolveLayout(o.layout);
    if (!layout) return reportExit(exitFailed, layout.error);
    return o.playsMusic ? renderMusic(o, layout.value) : renderBeats(o, layout.value);
}

} // namespace

Command beatsCommand() {
    return makeCommand("beats", "music as strikes on actuators, or what of it they can render", declareBeats,
                       runBeats);
}

} // namespace physvib
