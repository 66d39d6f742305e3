// SPDX-License-Identifier: MIT
// Reading and writing a session; scenes and inputs by the table in SceneFields.h.
#include "Live/Documents/SessionFile.h"
#include "Core/ClipNumber.h"
#include "Core/Decibels.h"
#include "Io/Disk/FileClash.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Json/JsonText.h"
#include "Io/Text/NumberText.h"
#include "Live/Documents/ControlJson.h"
#include "Live/Documents/MixJson.h"
#include "Live/Documents/SessionJournalText.h"
#include "Live/Documents/SessionJson.h"
#include "Scene/EventColumns.h"
#include "Scene/JsonReader.h"
#include "Scene/JsonWriter.h"
#include "Scene/SceneEdits.h"
#include "Scene/SceneFileLimits.h"
#include "Scene/SceneValidation.h"
#include "Scene/World/Simulation.h"
#include <cmath>

namespace physvib {
namespace detail {
namespace {

constexpr const char* sessionVersionField = "physvib_session";
constexpr std::array<std::string_view, 2> timingNames{"onset", "release"};
constexpr std::array<std::string_view, 2> locationNames{"contact", "fixture"};
constexpr double maxSeconds = static_cast<double>(limits::maxSessionNs) * 1e-9;

int readWhole(const JsonField& field, int least, int most) {
    const int found = field.wholeNumber();
    if (found < least || found > most)
        field.fail("expected " + std::to_string(least) + " to " + std::to_string(most) + ", found " +
                   std::to_string(found));
    return found;
}

// Times of a list never go back.
std::int64_t readNextTime(const JsonField& item, std::int64_t last) {
    const std::int64_t time = readTime(item["time_s"]);
    if (time < last) item["time_s"].fail("expected a time that is not before that of the item above");
    return time;
}

/// With those that its script spawns.
std::size_t bodiesOf(const Scene& scene) {
    std::size_t count = scene.bodies.size();
    for (const ScriptInput& input : scene.script)
        count +=
            std::holds_alternative<SpawnAction>(input.action) ? static_cast<std::size_t>(input.times) : 0;
    return count;
}

SceneTake readTake(const JsonField& json, const SceneTake* before) {
    json.expectObject({"start_s", "world_end_s", "seed", "scene", "inputs", "stalls"});
    SceneTake take = readTakeStart(json, before);
    take.worldEndNs = readTime(json["world_end_s"]);
    if (json.has("inputs"))
        detail::readValue(json["inputs"], take.inputs, items(0, sceneLimits::maxLiveInputs),
                          take.scene->materials);
    for (std::size_t i = 0, count = json.has("stalls") ? json["stalls"].arraySize() : 0; i < count; ++i) {
        const JsonField stall = json["stalls"].item(i);
        take.stalls.push_back(readStall(stall, take));
    }
    const bool isKnownToBeValid = before != nullptr && take.scene == before->scene && take.inputs.empty();
    if (const std::string fault = isKnownToBeValid ? std::string{} : validate(take.whole()); !fault.empty())
        json.fail(fault);
    return take;
}

} // namespace

std::int64_t readTime(const JsonField& seconds) { return std::llround(seconds.numberUpTo(maxSeconds) * 1e9); }
double seconds(std::int64_t ns) { return static_cast<double>(ns) / 1e9; } // the nearest to the decimal number

SceneTake readTakeStart(const JsonField& json, const SceneTake* before) {
    SceneTake take;
    take.startNs = readTime(json["start_s"]);
    if (before != nullptr && take.startNs < before->startNs)
        json["start_s"].fail("expected a time that is not before that of the take above");
    take.seed = static_cast<std::uint32_t>(json["seed"].numberUpTo(4294967295.0));
    if (before != nullptr && !json.has("scene"))
        take.scene = before->scene;
    else
        take.scene = std::make_shared<const Scene>(readFields<Scene>(json["scene"]));
    return take;
}

WorldStall readStall(const JsonField& json, const SceneTake& take) {
    json.expectObject({"time_s", "seconds", "steps"});
    const std::int64_t last = take.stalls.empty() ? 0 : take.stalls.back().worldNs;
    return {readNextTime(json, last), readTime(json["seconds"]),
            json.has("steps") ? readWhole(json["steps"], 1, 1'000'000'000) : 1};
}

void readTimedControl(const JsonField& json, SavedSession& session) {
    SessionLog& log = session.log;
    const RenderControl control = readControl(json, session.channels, "time_s");
    const std::int64_t time = readNextTime(json, session.log.lastControlNs());
    if (control.kind == RenderControl::Kind::panner)
        log.panners.push_back({time, control.panner});
    else
        log.channels.push_back({time, control.kind, control.channel, control.value});
}

namespace {

// One per channel; left out: full scale.
void readCeilings(const JsonField& list, SavedSession& session) {
    if (list.arraySize() != static_cast<std::size_t>(session.channels))
        list.fail("expected " + std::to_string(session.channels) + " numbers, one per channel");
    for (std::size_t j = 0; j < list.arraySize(); ++j) {
        if (list.item(j).number() <= 0.0) list.item(j).fail("expected a number > 0");
        session.ceilings[j] = static_cast<float>(list.item(j).numberUpTo(1.0));
    }
}

} // namespace

namespace {

StrikeCourse readCourse(const JsonField& strike) {
    StrikeCourse course;
    if (strike.has("travel_s")) {
        course.travelNs = readTime(strike["travel_s"]);
        course.toX = strike["to_x_m"].number();
        course.toY = strike["to_y_m"].number();
    }
    if (strike.has("since_s")) course.sinceNs = readTime(strike["since_s"]);
    if (strike.has("spread")) course.spread = static_cast<Spread>(strike["spread"].oneOf(spreadNames));
    return course;
}

} // namespace

CollisionEvent readStrike(const JsonField& json) {
    json.expectObject({"time_s", "frequency_hz", "decay_per_s", "amplitude", "x_m", "y_m", "duration_s",
                       "to_x_m", "to_y_m", "travel_s", "since_s", "spread"});
    CollisionEvent strike;
    strike.timeNs = readTime(json["time_s"]);
    strike.frequencyHz = json["frequency_hz"].positiveNumber();
    strike.decayPerSecond = json["decay_per_s"].number();
    strike.amplitude = json["amplitude"].number();
    strike.x = json["x_m"].number();
    strike.y = json["y_m"].number();
    if (json.has("duration_s")) strike.durationNs = readTime(json["duration_s"]);
    strike.course = readCourse(json);
    if (isTooSlow(strike)) json["frequency_hz"].fail(tooSlowFault(strike));
    if (!isPlayable(strike))
        json.fail("expected a strike that can be played: within the ranges of an event list, with a decay or "
                  "a duration");
    return strike;
}

namespace {

RecordingFile readRecordingFile(const JsonField& json) {
    json.expectObject({"frequency_hz", "file", "hash", "decay_per_s", "matched"});
    RecordingFile file{json["frequency_hz"].positiveNumber(), json["file"].text()};
    if (json.has("hash")) file.hash = json["hash"].text();
    if (json.has("decay_per_s")) file.decayPerSecond = json["decay_per_s"].positiveNumber();
    if (json.has("matched")) file.isMatched = json["matched"].truth();
    return file;
}

} // namespace

void readClipFile(const JsonField& json, SessionLog& log) {
    json.expectObject({"frequency_hz", "file", "channel", "hash"});
    const auto number = static_cast<int>(log.clips.size());
    if (number == mostClips)
        json.fail("expected at most " + std::to_string(mostClips) + " channels of clips, found more");
    if (const double found = json["frequency_hz"].positiveNumber(); found != clipFrequencyHz(number))
        json["frequency_hz"].fail("expected " + numberText(clipFrequencyHz(number)) + ", for clip " +
                                  std::to_string(number + 1) + ", found " + numberText(found));
    ClipFile clip{{clipFrequencyHz(number), json["file"].text()},
                  json.has("channel") ? readWhole(json["channel"], 0, limits::maxEnchanters - 1) : 0};
    clip.file.hash = json["hash"].text();
    log.clips.push_back(std::move(clip));
}

void readRecordingsChange(const JsonField& json, SessionLog& log) {
    json.expectObject({"time_s", "files"});
    RecordingsChange change{readNextTime(json, log.recordings.empty() ? 0 : log.recordings.back().timeNs),
                            {}};
    for (std::size_t k = 0; k < json["files"].arraySize(); ++k)
        change.files.push_back(readRecordingFile(json["files"].item(k)));
    log.recordings.push_back(std::move(change));
}

namespace {

EventShaping readShaping(const JsonField& json) {
    json.expectObject(
        {"method", "fixed_amplitude", "remap_hz", "gain", "perceived_level", "gamma", "holds_level"});
    EventShaping shaping;
    if (json.has("method") && !renderingMethodNamed(json["method"].text(), shaping.method))
        json["method"].fail("expected a name from AV-FV-DRV to AF-FF-DRF");
    if (json.has("fixed_amplitude"))
        shaping.method.fixedAmplitude = json["fixed_amplitude"].numberUpTo(limits::maxAmplitude);
    if (json.has("holds_level")) shaping.method.holdsLevel = json["holds_level"].truth();
    if (json.has("gain")) shaping.gain = json["gain"].numberUpTo(limits::maxAmplitude);
    if (json.has("perceived_level")) shaping.perceived.isWeighted = json["perceived_level"].truth();
    if (json.has("gamma")) shaping.truncation = json["gamma"].numberWithin(0.0, EventShaping::mostTruncation);
    if (json.has("remap_hz")) shaping.remap.band = readBand(json["remap_hz"]);
    return shaping;
}

} // namespace

SavedSession readSessionHead(const JsonField& root, std::initializer_list<std::string_view> others) {
    checkVersion(root, sessionVersionField, sessionFormatVersion);
    std::vector<std::string_view> known{sessionVersionField, "steps_per_second", "timing",    "location",
                                        "limiter",           "ceilings",         "equalised", "shaping",
                                        "channels",          "panning"};
    known.insert(known.end(), others);
    root.expectOnly(known);
    SavedSession session;
    session.run.stepsPerSecond =
        readWhole(root["steps_per_second"], Simulation::minStepsPerSecond, Simulation::maxStepsPerSecond);
    session.run.timing = static_cast<ImpactTiming>(root["timing"].oneOf(timingNames));
    session.run.location = static_cast<ImpactLocation>(root["location"].oneOf(locationNames));
    session.limiterEnabled = root["limiter"].truth();
    session.channels = readWhole(root["channels"], 1, limits::maxEnchanters);
    if (root.has("ceilings")) readCeilings(root["ceilings"], session);
    if (root.has("equalised")) session.equalised = readEqualised(root["equalised"], session.channels);
    if (root.has("shaping")) session.shaping = readShaping(root["shaping"]);
    session.panner = readPanner(root["panning"], session.channels);
    return session;
}

namespace {

SavedSession readSessionRoot(const JsonField& root) {
    SavedSession session =
        readSessionHead(root, {"seconds", "takes", "controls", "recordings", "clips", "strikes", "desk"});
    session.lengthNs = readTime(root["seconds"]);
    const JsonField takes = root["takes"];
    if (takes.arraySize() == 0) takes.fail("expected at least 1 take, found none");
    for (std::size_t i = 0, bodies = 0; i < takes.arraySize(); ++i) {
        session.log.takes.push_back(
            readTake(takes.item(i), session.log.takes.empty() ? nullptr : &session.log.takes.back()));
        bodies += bodiesOf(*session.log.takes.back().scene);
        if (bodies > limits::maxTakeBodies)
            takes.fail("expected at most " + std::to_string(limits::maxTakeBodies) + " bodies in all takes");
    }
    for (std::size_t i = 0, count = root.has("controls") ? root["controls"].arraySize() : 0; i < count; ++i)
        readTimedControl(root["controls"].item(i), session);
    for (std::size_t i = 0, count = root.has("recordings") ? root["recordings"].arraySize() : 0; i < count;
         ++i)
        readRecordingsChange(root["recordings"].item(i), session.log);
    for (std::size_t i = 0, count = root.has("clips") ? root["clips"].arraySize() : 0; i < count; ++i)
        readClipFile(root["clips"].item(i), session.log);
    for (std::size_t i = 0, count = root.has("strikes") ? root["strikes"].arraySize() : 0; i < count; ++i)
        session.log.strikes.push_back(readStrike(root["strikes"].item(i)));
    if (root.has("desk")) {
        session.mix = readMix(root["desk"]);
        session.mix->scene = std::make_shared<const Scene>(sceneAsLeft(session.log.takes.back()));
        session.mix->seed = session.log.takes.back().seed;
    }
    return session;
}

} // namespace

OrderedJson strikeJson(const CollisionEvent& strike) {
    OrderedJson json{{"time_s", seconds(strike.timeNs)},
                     {"frequency_hz", strike.frequencyHz},
                     {"decay_per_s", strike.decayPerSecond},
                     {"amplitude", strike.amplitude},
                     {"x_m", strike.x},
                     {"y_m", strike.y}};
    if (strike.durationNs > 0) json["duration_s"] = seconds(strike.durationNs);
    const StrikeCourse& course = strike.course;
    if (course.travelNs > 0)
        json.update({{"to_x_m", course.toX}, {"to_y_m", course.toY}, {"travel_s", seconds(course.travelNs)}});
    if (course.sinceNs > 0) json["since_s"] = seconds(course.sinceNs);
    if (course.spread != Spread::layout) json["spread"] = nameOf(course.spread);
    return json;
}

OrderedJson takeStartJson(const SceneTake& take, const SceneTake* before, bool withEnd) {
    OrderedJson json{{"start_s", seconds(take.startNs)}};
    if (withEnd) json["world_end_s"] = seconds(take.worldEndNs);
    json["seed"] = take.seed;
    const bool isSame = before != nullptr && (before->scene == take.scene || *before->scene == *take.scene);
    if (!isSame) json["scene"] = fieldsJson(*take.scene, take.scene->materials);
    return json;
}

OrderedJson inputJson(const LiveInput& input, const Scene& scene) {
    return fieldsJson(input, scene.materials);
}

OrderedJson stallJson(const WorldStall& stall) {
    OrderedJson json{{"time_s", seconds(stall.worldNs)}, {"seconds", seconds(stall.lengthNs)}};
    if (stall.steps > 1) json["steps"] = stall.steps;
    return json;
}

OrderedJson timedControlJson(const RenderControl& control) {
    OrderedJson timed{{"time_s", seconds(control.timeNs)}};
    timed.update(controlJson(control));
    return timed;
}

namespace {

OrderedJson takeJson(const SceneTake& take, const SceneTake* before) {
    OrderedJson json = takeStartJson(take, before, true);
    for (const LiveInput& input : take.inputs) json["inputs"].push_back(inputJson(input, *take.scene));
    for (const WorldStall& stall : take.stalls) json["stalls"].push_back(stallJson(stall));
    return json;
}

OrderedJson shapingJson(const EventShaping& shaping) {
    const auto name = nameOf(shaping.method);
    OrderedJson json{{"method", std::string(name.begin(), name.end())},
                     {"fixed_amplitude", shaping.method.fixedAmplitude}};
    if (shaping.method.holdsLevel) json["holds_level"] = true;
    if (shaping.remap.band.isKnown()) json["remap_hz"] = bandJson(shaping.remap.band);
    if (shaping.gain != 1.0) json["gain"] = shaping.gain;
    if (shaping.perceived.isWeighted) json["perceived_level"] = true;
    if (shaping.truncation != 0.0) json["gamma"] = shaping.truncation;
    return json;
}

std::string besides(const std::filesystem::path& folder, const std::string& path) {
    if (folder.empty() || syntheticSeed(path)) return path;
    const auto whole = std::filesystem::absolute(path).lexically_normal();
    return whole.lexically_proximate(std::filesystem::absolute(folder).lexically_normal()).string();
}

} // namespace

OrderedJson clipJson(const ClipFile& clip, const std::filesystem::path& folder) {
    OrderedJson json{{"frequency_hz", clip.file.frequencyHz}, {"file", besides(folder, clip.file.path)}};
    if (clip.channel > 0) json["channel"] = clip.channel;
    json["hash"] = clip.file.hash;
    return json;
}

OrderedJson recordingsJson(const RecordingsChange& change, const std::filesystem::path& folder) {
    OrderedJson json{{"time_s", seconds(change.timeNs)}, {"files", OrderedJson::array()}};
    for (const RecordingFile& file : change.files) {
        OrderedJson one{{"frequency_hz", file.frequencyHz}, {"file", besides(folder, file.path)}};
        if (!file.hash.empty()) one["hash"] = file.hash;
        if (file.decayPerSecond > 0.0) one["decay_per_s"] = file.decayPerSecond;
        if (file.isMatched) one["matched"] = true;
        json["files"].push_back(std::move(one));
    }
    return json;
}

OrderedJson sessionHeadJson(const SavedSession& session, bool isJournal) {
    OrderedJson root{{sessionVersionField, sessionFormatVersion}};
    if (isJournal)
        root["journal"] = journalFormatVersion;
    else
        root["seconds"] = seconds(session.lengthNs);
    root["steps_per_second"] = session.run.stepsPerSecond;
    root["timing"] = timingNames[static_cast<std::size_t>(session.run.timing)];
    root["location"] = locationNames[static_cast<std::size_t>(session.run.location)];
    root["limiter"] = session.limiterEnabled;
    root["channels"] = session.channels;
    root["panning"] = pannerJson(session.panner);
    if (!isJournal) root["takes"] = OrderedJson::array();
    const std::vector<double> ceilings(session.ceilings.begin(), session.ceilings.begin() + session.channels);
    if (std::ranges::any_of(ceilings, [](double most) { return most != 1.0; })) root["ceilings"] = ceilings;
    if (std::ranges::any_of(session.equalised, &EqualisedActuator::isKnown))
        root["equalised"] = equalisedJson(session.equalised, session.channels);
    if (session.shaping != EventShaping{}) root["shaping"] = shapingJson(session.shaping);
    return root;
}

} // namespace detail

Result<SavedSession> readSession(std::string_view text, std::string_view name) {
    if (isJournal(text)) return readJournal(text, name);
    return readJson(text, name, limits::maxSessionFileBytes,
                    [](const Json& root) { return detail::readSessionRoot(JsonField(root, {})); });
}

Result<SavedSession> loadSession(const std::filesystem::path& path) {
    auto session = loadText(path, limits::maxSessionFileBytes, readSession);
    for (const RecordingsChange& change : session.value.log.recordings)
        for (const RecordingFile& file : change.files)
            if (file.hash.empty() && !syntheticSeed(file.path) &&
                !isWithin(path.parent_path(), path.parent_path() / file.path))
                return Failure{path.string() +
                               ": recordings: expected a hash for a file that is not in the session's folder "
                               "or below, found none for " +
                               inQuotes(file.path)};
    for (RecordingsChange& change : session.value.log.recordings)
        for (RecordingFile& file : change.files)
            if (!syntheticSeed(file.path))
                file.path = (path.parent_path() / file.path).lexically_normal().string();
    for (ClipFile& clip : session.value.log.clips)
        clip.file.path = (path.parent_path() / clip.file.path).lexically_normal().string();
    return session;
}

std::string sessionJson(const SavedSession& session, const std::filesystem::path& folder) {
    OrderedJson root = detail::sessionHeadJson(session, false);
    const SceneTake* before = nullptr;
    for (const SceneTake& take : session.log.takes) {
        root["takes"].push_back(detail::takeJson(take, before));
        before = &take;
    }
    for (const RenderControl& control : controlsOf(session.log, true, session.channels))
        root["controls"].push_back(detail::timedControlJson(control));
    for (const RecordingsChange& change : session.log.recordings)
        root["recordings"].push_back(detail::recordingsJson(change, folder));
    for (const ClipFile& clip : session.log.clips) root["clips"].push_back(detail::clipJson(clip, folder));
    for (const CollisionEvent& strike : session.log.strikes)
        root["strikes"].push_back(detail::strikeJson(strike));
    if (session.mix) root["desk"] = mixJson(*session.mix);
    return jsonLines(root);
}

Mix mixOf(const SavedSession& session) {
    if (session.mix) return *session.mix;
    Mix mix;
    mix.scene = std::make_shared<const Scene>(sceneAsLeft(session.log.takes.back()));
    mix.seed = session.log.takes.back().seed;
    const PhantomPanner& panner =
        session.log.panners.empty() ? session.panner : session.log.panners.back().panner;
    mix.layout = describeLayout("own", panner.layout());
    mix.law = panner.law();
    mix.exponent = panner.exponent();
    mix.strips.resize(static_cast<std::size_t>(mix.count()));
    const auto decibels = [](float gain) { return toDecibels(static_cast<double>(gain)); };
    for (std::size_t j = 0; j < mix.strips.size(); ++j) {
        mix.strips[j].output = static_cast<int>(j);
        mix.strips[j].ceilingDb = std::clamp(decibels(session.ceilings[j]), leastCeilingDb, 0.0);
    }
    for (const ChannelChange& change : session.log.channels) {
        if (change.channel >= mix.count()) continue;
        Strip& strip = mix.strips[static_cast<std::size_t>(change.channel)];
        if (change.kind == RenderControl::Kind::mute) strip.isMuted = change.value != 0.0f;
        if (change.kind == RenderControl::Kind::ceiling)
            strip.ceilingDb = std::clamp(decibels(change.value), leastCeilingDb, 0.0);
        if (change.kind != RenderControl::Kind::gain) continue;
        strip.isInverted = change.value < 0.0f;
        strip.gainDb = change.value == 0.0f
                           ? leastStripDb
                           : std::clamp(decibels(std::abs(change.value)), leastStripDb, mostStripDb);
    }
    return mix;
}

std::vector<RenderControl> controlsOf(const SessionLog& log, bool keepLayouts, int channels) {
    std::vector<RenderControl> all;
    if (keepLayouts)
        for (const PannerChange& change : log.panners)
            all.push_back({change.timeNs, RenderControl::Kind::panner, 0, 0.0f, change.panner});
    for (const ChannelChange& change : log.channels)
        if (change.channel < channels)
            all.push_back({change.timeNs, change.kind, change.channel, change.value, {}});
    std::ranges::stable_sort(all, {}, &RenderControl::timeNs);
    return all;
}

} // namespace physvib
