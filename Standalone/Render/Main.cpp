// SPDX-License-Identifier: MIT
// Main program of `physvib-render`, which renders a scene or an event list to a WAV file, an event list and a
// picture; it needs only the library, no windows or audio devices.
#include "Core/CollisionEvent.h"
#include "Io/Disk/FileClash.h"
#include "Io/Text/CleanText.h"
#include "Io/Text/NameList.h"
#include "Io/Wav/WavSink.h"
#include "Live/Session/OfflineRender.h"
#include "Scene/EventsCsv.h"
#include "Scene/FieldSize.h"
#include "Scene/LayoutFile.h"
#include "Scene/SceneFile.h"
#include "Scene/World/Simulation.h"
#include <CLI/CLI.hpp>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <physvib/Version.h>
#include <string>
#if PHYSVIB_PICTURES
#include "Io/Disk/AtomicFile.h"
#include "Pictures/RenderPicture.h"
#endif

namespace physvib {
/// Check of an inclusive range. Unlike CLI11's own it rejects "nan", and its message has the range with
/// `unit`, which begins with a space.
template <class T>
CLI::Validator inRange(T low, T high, const std::string& unit = "") {
    const std::string range = CLI::detail::to_string(low) + " to " + CLI::detail::to_string(high) + unit;
    return {[=](std::string& text) {
                T value{};
                const bool isNumber = CLI::detail::lexical_cast(text, value);
                return isNumber && value >= low && value <= high
                           ? std::string{}
                           : "expected " + range + ", found \"" + text + "\"";
            },
            range};
}

} // namespace physvib
using namespace physvib;

namespace {

constexpr int exitFailed = 1, exitUsage = 2; // as for `physvib`

struct Options {
    std::string input, layout = "phone4", instructions = "best", wavPath, eventsPath, picturePath, field;
    double seconds = 10.0;
    int sampleRateHz = 48000;
    RunSettings run;

    bool isList() const { return input.ends_with(".csv"); }
    FieldSize statedField() const { return parseField(field).value_or(FieldSize{}); }
    std::int64_t frames() const { return std::max<std::int64_t>(1, std::llround(seconds * sampleRateHz)); }
};

/// Prints one line on stderr, with unprintable characters replaced, and returns `code`.
int reportExit(int code, std::string_view reason) {
    std::cerr << "physvib-render: " + cleanLine(reason) + '\n';
    return code;
}

/// Events to render, with their field.
struct Source {
    std::optional<Scene> scene; ///< none for an event list
    std::vector<CollisionEvent> events;
    SoundNames names;        ///< of the materials
    std::uint64_t drops = 0; ///< collisions that the world had no room for
    FieldSize field;         ///< not known: the layout's extent
    Provenance provenance{PHYSVIB_VERSION, {}};
};

Result<Source> loadSource(const Options& o) {
    Source source;
    if (o.isList()) {
        auto events = loadEventsCsv(o.input);
        if (!events) return Failure{events.error};
        source.events = std::move(events.value.events);
        source.names = std::move(events.value.names);
        source.field = o.statedField().isKnown() ? o.statedField() : events.value.field;
        source.provenance.entries.emplace_back("events", std::to_string(source.events.size()));
        return source;
    }
    const auto scene = findScene(o.input);
    if (!scene) return Failure{scene.error};
    auto simulated = simulateScene(scene.value, o.run, std::llround(o.seconds * 1e9));
    source.events = std::move(simulated.events);
    source.drops = simulated.drops;
    source.field = o.statedField();
    if (!source.field.isKnown()) source.field = {scene.value.fieldWidthMetres, scene.value.fieldHeightMetres};
    source.provenance.entries = {{"scene", scene.value.name},
                                 {"seed", std::to_string(o.run.seed)},
                                 {"steps_per_second", std::to_string(o.run.stepsPerSecond)}};
    for (const SceneVariable& variable : scene.value.variables)
        source.provenance.entries.emplace_back(variable.name, variable.value);
    source.scene = scene.value;
    source.names.addScene(scene.value);
    return source;
}

InstructionSet instructionSetNamed(const std::string& name) {
    return static_cast<InstructionSet>(std::ranges::find(instructionSetNames, name) -
                                       instructionSetNames.begin());
}

RendererSettings makeSettings(const Options& o, const ActuatorLayout& layout, const Source& source) {
    const FieldSize field = source.field.isKnown() ? source.field : extentOf(layout);
    RendererSettings settings{
        .sampleRateHz = o.sampleRateHz,
        .panner = {layout, PanningLaw::automatic, 1.0, field.widthMetres, field.heightMetres}};
    settings.instructions = instructionSetNamed(o.instructions);
    return settings;
}

/// Prints a warning with a count of lost or altered items, if it is above 0.
void warnIfAny(std::uint64_t count, const char* what) {
    if (count > 0) reportExit(0, "warning: " + std::string{what} + ": " + std::to_string(count));
}

/// Warns why nothing can be felt, or which events of a list lie outside the field.
void warnIfNotFelt(const Source& source, const PhantomPanner& panner, std::int64_t endNs) {
    const bool isGuessed = !source.field.isKnown();
    const std::string reason = silenceReason(source.events, panner, isGuessed, endNs);
    if (!reason.empty()) return void(reportExit(0, "warning: silent: " + reason));
    const std::string outside =
        source.scene ? "" : outsideFieldWarning(source.events, fieldOf(panner), isGuessed);
    if (!outside.empty()) reportExit(0, "warning: " + outside);
}

#if PHYSVIB_PICTURES
/// The picture of a render, from its samples as they are rendered. Message thread only.
struct RenderedPicture {
    RenderedPicture(const Options& o, const Source& source, int channels)
        : file{o.picturePath}
        , window{zoomWindow(source.events, o.sampleRateHz)}
        , whole{channels, 0, o.frames()}
        , zoom{channels, window.firstFrame, window.frameCount} {}

    void addSamples(const float* const* channels, int frames) {
        whole.add(channels, frames);
        zoom.add(channels, frames);
    }

    /// Empty, or one line with file and reason.
    std::string draw(const Options& o, const Source& source, const LayoutDescription& layout,
                     const PhantomPanner& panner) {
        PictureInput picture;
        picture.title = source.scene ? source.scene->name : fileNameOf(o.input);
        picture.subtitle = source.scene ? source.scene->description : "an event list";
        picture.fieldWidthMetres = panner.fieldWidthMetres();
        picture.fieldHeightMetres = panner.fieldHeightMetres();
        if (source.scene) {
            picture.scene = &*source.scene;
            picture.poses = posesAtStrongest(*source.scene, o.run, source.events);
        }
        picture.layout = layout.geometry;
        for (const auto& actuator : layout.actuators) picture.labels.push_back(actuator.label);
        picture.law = std::string{nameOf(panner.law())} + " law";
        picture.provenance = provenanceLine(source.provenance);
        picture.events = source.events;
        picture.waveform = &whole;
        picture.zoom = &zoom;
        picture.sampleRateHz = o.sampleRateHz;
        picture.durationSeconds = static_cast<double>(o.frames()) / o.sampleRateHz;
        return file.write(picturePng(picture));
    }

    AtomicFile file;
    FrameWindow window;
    WaveformEnvelope whole, zoom;
};
#endif

/// Renders the events to the WAV file and the picture that the options request; empty, or one error line.
std::string writeSamples(const Options& o, const Source& source, const LayoutDescription& layout) {
    const RendererSettings settings = makeSettings(o, layout.geometry, source);
    std::optional<WavSink> wav;
    if (!o.wavPath.empty() &&
        !wav.emplace(o.wavPath, settings.outputs(), o.sampleRateHz, provenanceLine(source.provenance))
             .error()
             .empty())
        return wav->error();
#if PHYSVIB_PICTURES
    std::optional<RenderedPicture> picture;
    if (!o.picturePath.empty() && !picture.emplace(o, source, settings.outputs()).file.error().empty())
        return picture->file.error();
#endif
    const auto status =
        renderOffline(source.events, {settings, o.frames()}, [&](const float* const* channels, int frames) {
#if PHYSVIB_PICTURES
            if (picture) picture->addSamples(channels, frames);
#endif
            return !wav || wav->write(channels, frames);
        });
    warnIfAny(status.rejected, "events that could not be played");
    warnIfAny(status.withoutPart,
              "events of a part of the body that no actuator has, felt by their place on all");
    warnIfAny(status.stolen, "modes faded out early because too many different ones sounded at once");
    warnIfNotFelt(source, settings.panner, std::llround(o.seconds * 1e9));
    std::string error;
#if PHYSVIB_PICTURES
    if (picture) error = picture->draw(o, source, layout, settings.panner);
#endif
    if (error.empty() && wav) error = wav->finish();
#if PHYSVIB_PICTURES
    if (error.empty() && picture) error = picture->file.commit();
#endif
    return error;
}

/// Renders and writes; empty, or one error line.
std::string render(const Options& o) {
    const auto layout = findLayout(o.layout);
    if (!layout) return layout.error;
    if (!o.wavPath.empty() && !fitsWav(layout.value.geometry.count, o.frames()))
        return "--seconds: too long; a WAV file holds at most 4 GB of samples";
    std::optional<AtomicFile> eventsFile;
    if (!o.eventsPath.empty() && !eventsFile.emplace(o.eventsPath).error().empty())
        return eventsFile->error();
    const auto source = loadSource(o);
    if (!source) return source.error;
    warnIfAny(source.value.drops, "collisions lost because too many began in one physics step");
    std::string error;
    if (eventsFile)
        error = eventsFile->write(
            eventsCsv(source.value.events, source.value.field, source.value.provenance, source.value.names));
    if (error.empty() && !(o.wavPath.empty() && o.picturePath.empty()))
        error = writeSamples(o, source.value, layout.value);
    if (error.empty() && eventsFile) error = eventsFile->commit();
    if (error.empty()) std::cout << source.value.events.size() << " events\n";
    return error;
}

void declare(CLI::App& app, Options& o) {
    app.set_version_flag("--version", "physvib-render " PHYSVIB_VERSION);
    app.add_option("scene", o.input, "a built-in scene, SCENE.json, or EVENTS.csv")->required();
    app.add_option("--seconds", o.seconds, "length of the render")
        ->check(inRange(0.001, 86400.0, " s"))
        ->capture_default_str();
    app.add_option("--seed", o.run.seed, "seed of the scene")->capture_default_str();
    app.add_option("--steps-per-second", o.run.stepsPerSecond, "physics steps per second")
        ->check(inRange(Simulation::minStepsPerSecond, Simulation::maxStepsPerSecond))
        ->capture_default_str();
    app.add_option("--layout", o.layout, rangeList(layoutPresetNames) + " or a layout file")
        ->capture_default_str();
    app.add_option("--field", o.field,
                   "metres that x and y span (scene: its field; events: as they say, or the layout's extent)")
        ->check([](const std::string& word) {
            return parseField(word) ? std::string{} : std::string{expectedFieldText} + inQuotes(word);
        })
        ->type_name("W,H");
    app.add_option("--rate", o.sampleRateHz, "sample rate in Hz")
        ->check(inRange(limits::minSampleRateHz, limits::maxSampleRateHz))
        ->capture_default_str();
    app.add_option("--instructions", o.instructions,
                   "vector instructions, all with the same bytes; scalar: double precision")
        ->check(
            CLI::IsMember(std::vector<std::string>(instructionSetNames.begin(), instructionSetNames.end())))
        ->check([](const std::string& name) {
            return isAvailable(instructionSetNamed(name)) ? std::string{}
                                                          : "this build or processor has no " + name;
        })
        ->capture_default_str();
    app.add_option("--out", o.wavPath, "32-bit float WAV, one channel per actuator")->type_name("FILE.wav");
    app.add_option("--events", o.eventsPath, "the collisions as an event list")->type_name("FILE.csv");
#if PHYSVIB_PICTURES
    app.add_option("--picture", o.picturePath, "the world, every channel and every hit")
        ->type_name("FILE.png")
        ->check([](const std::string& path) { return fileExtensionError(path, {".png"}); });
#endif
}

extern "C" void exitOnSignal(int signal) {
    removeFilesOnSignal();
    std::_Exit(128 + signal);
}

} // namespace

int main(int argc, char** argv) {
    for (const int signal : endingSignals())
        if (std::signal(signal, exitOnSignal) == SIG_IGN) std::signal(signal, SIG_IGN); // so that nohup works
    Options o;
    CLI::App app{"Collisions one can feel: a scene or an event list to a WAV file. The library without "
                 "windows and devices."};
    declare(app, o);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& end) {
        return end.get_exit_code() == 0 ? app.exit(end) : reportExit(exitUsage, end.what());
    }
    const std::vector<std::string> outputs{o.wavPath, o.eventsPath, o.picturePath}, inputs{o.input};
    if (std::ranges::all_of(outputs, &std::string::empty))
        return reportExit(exitUsage, PHYSVIB_PICTURES ? "expected --out, --events or --picture"
                                                      : "expected --out or --events");
    if (const std::string clash = fileClashError(outputs, inputs); !clash.empty())
        return reportExit(exitUsage, clash);
    try {
        const std::string error = render(o);
        return error.empty() ? 0 : reportExit(exitFailed, error);
    } catch (const std::exception& e) {
        return reportExit(exitFailed, e.what());
    }
}
