// SPDX-License-Identifier: MIT
// Reads and writes session files; scenes and inputs by the table in SceneFields.h.
#include "Live/Documents/SessionFile.h"
#include "Io/Disk/FileClash.h"
#include "Io/Disk/ReadFile.h"
#include "Live/Documents/DocumentJson.h"
#include "Scene/SceneEdits.h"
#include "Scene/SceneJson.h"
#include "Scene/SceneValidation.h"

namespace physvib {
namespace detail {
namespace {

// Throws if `time` is before `last`, the time of the list's item above.
void expectTimeOrder(std::int64_t last, std::int64_t time, const JsonField& item) {
    if (time < last) item["time_s"].fail("expected a time that is not before that of the item above");
}

/// Calls read(item) for each item of an optional list.
void readEach(const JsonField& json, std::string_view name, auto read) {
    if (!json.has(name)) return;
    const JsonField list = json[name];
    for (std::size_t i = 0, count = list.arraySize(); i < count; ++i) read(list.item(i));
}

SceneRun readRun(const JsonField& json, const SceneRun* prior) {
    SceneRun run = readRunStart(json, prior, false);
    if (json.has("inputs"))
        detail::readValue(json["inputs"], run.inputs, items(0, sceneLimits::maxLiveInputs),
                          run.scene->materials);
    readEach(json, "stalls", [&](const JsonField& stall) { run.stalls.push_back(readStall(stall, run)); });
    const bool isCheckedBefore = prior != nullptr && run.scene == prior->scene && run.inputs.empty();
    if (const std::string error = isCheckedBefore ? std::string{} : validate(run.fullScene()); !error.empty())
        json.fail(error);
    return run;
}

SavedSession readSessionRoot(const JsonField& root) {
    SavedSession session;
    readTable(root, session);
    SessionLog& log = session.log;
    const JsonField takes = root["takes"];
    if (takes.arraySize() == 0) takes.fail("expected at least 1 take, found none");
    std::size_t bodies = 0;
    readEach(root, "takes", [&](const JsonField& item) {
        log.runs.push_back(readRun(item, log.runs.empty() ? nullptr : &log.runs.back()));
        bodies += bodyCount(*log.runs.back().scene);
        if (bodies > limits::maxSessionBodies)
            takes.fail("expected at most " + std::to_string(limits::maxSessionBodies) +
                       " bodies in all takes");
    });
    readEach(root, "controls", [&](const JsonField& item) { readTimedControl(item, session); });
    readEach(root, "recordings", [&](const JsonField& item) { readRecordingsChange(item, log); });
    readEach(root, "clips", [&](const JsonField& item) { readClipFile(item, log); });
    readEach(root, "strikes", [&](const JsonField& item) { log.strikes.push_back(readStrike(item)); });
    if (root.has("desk")) session.mix = readMix(root["desk"]);
    return session;
}

OrderedJson runJson(const SceneRun& run, const SceneRun* prior) {
    OrderedJson json = runStartJson(run, prior, false);
    for (const LiveInput& input : run.inputs) json["inputs"].push_back(inputJson(input, *run.scene));
    for (const WorldStall& stall : run.stalls) json["stalls"].push_back(writeTable(stall));
    return json;
}

std::string relativePath(const std::filesystem::path& folder, const std::string& path) {
    if (folder.empty() || syntheticSeed(path)) return path;
    const auto absolute = std::filesystem::absolute(path).lexically_normal();
    return absolute.lexically_proximate(std::filesystem::absolute(folder).lexically_normal()).string();
}

} // namespace

std::size_t bodyCount(const Scene& scene) {
    std::size_t count = scene.bodies.size();
    for (const ScriptInput& input : scene.script)
        count +=
            std::holds_alternative<SpawnAction>(input.action) ? static_cast<std::size_t>(input.times) : 0;
    return count;
}

SceneRun readRunStart(const JsonField& json, const SceneRun* prior, bool isJournal) {
    SceneRun run;
    isJournal ? readTable<SceneRun, JournalRun>(json, run) : readTable(json, run);
    if (prior != nullptr && run.startNs < prior->startNs)
        json["start_s"].fail("expected a time that is not before that of the take above");
    if (prior != nullptr && !json.has("scene"))
        run.scene = prior->scene;
    else
        run.scene = std::make_shared<const Scene>(readFields<Scene>(json["scene"]));
    return run;
}

OrderedJson runStartJson(const SceneRun& run, const SceneRun* prior, bool isJournal) {
    OrderedJson json = isJournal ? writeTable<SceneRun, JournalRun>(run) : writeTable(run);
    const bool isSame = prior != nullptr && (prior->scene == run.scene || *prior->scene == *run.scene);
    if (!isSame) json["scene"] = fieldsJson(*run.scene, run.scene->materials);
    return json;
}

WorldStall readStall(const JsonField& json, const SceneRun& run) {
    const auto stall = kinds::Object<WorldStall>{}(json);
    expectTimeOrder(run.stalls.empty() ? 0 : run.stalls.back().worldNs, stall.worldNs, json);
    return stall;
}

void readTimedControl(const JsonField& json, SavedSession& session) {
    SessionLog& log = session.log;
    const OwnedControl control = readControl(json, session.channels, "time_s");
    const std::int64_t time = kinds::Time{}(json["time_s"]);
    expectTimeOrder(log.lastControlNs(), time, json);
    if (control.panner != nullptr)
        log.panners.push_back({time, *control.panner});
    else
        log.channels.push_back({time, control.kind, control.channel, control.value});
}

CollisionEvent readStrike(const JsonField& json) {
    auto strike = kinds::Object<CollisionEvent>{}(json);
    if (!json.has("sound")) convertLegacyClip(strike);
    if (isTooSlow(strike)) json["frequency_hz"].fail(tooSlowError(strike));
    if (!isPlayable(strike))
        json.fail("expected a strike that can be played: within the ranges of an event list, with a decay or "
                  "a duration");
    return strike;
}

void readClipFile(const JsonField& json, SessionLog& log) {
    if (log.clips.size() == maxClips)
        json.fail("expected at most " + std::to_string(maxClips) + " channels of clips, found more");
    log.clips.push_back(kinds::Object<ClipFile>{}(json));
}

void readRecordingsChange(const JsonField& json, SessionLog& log) {
    const auto change = kinds::Object<RecordingsChange>{}(json);
    expectTimeOrder(log.recordings.empty() ? 0 : log.recordings.back().timeNs, change.timeNs, json);
    log.recordings.push_back(change);
}

OrderedJson inputJson(const LiveInput& input, const Scene& scene) {
    return fieldsJson(input, scene.materials);
}

OrderedJson timedControlJson(const RenderControl& control) {
    OrderedJson timed{{"time_s", kinds::Time{}.write(control.timeNs)}};
    timed.update(controlJson(control));
    return timed;
}

OrderedJson clipJson(ClipFile clip, const std::filesystem::path& folder) {
    clip.file.path = relativePath(folder, clip.file.path);
    return writeTable(clip);
}

OrderedJson recordingsJson(RecordingsChange change, const std::filesystem::path& folder) {
    for (RecordingFile& file : change.files) file.path = relativePath(folder, file.path);
    return writeTable(change);
}

} // namespace detail

RenderingMethod readCustom(const JsonField& json, const Custom<RenderingMethod>&) {
    RenderingMethod method;
    if (!parseRenderingMethod(json.text(), method)) json.fail("expected a name from AV-FV-DRV to AF-FF-DRF");
    return method;
}
OrderedJson writeCustom(const Custom<RenderingMethod>&, const RenderingMethod& method) {
    const auto name = nameOf(method);
    return std::string(name.begin(), name.end());
}

Ceilings readCustom(const JsonField& list, const PerChannel<Ceilings>& kind) {
    if (list.arraySize() != static_cast<std::size_t>(kind.channels))
        list.fail("expected " + std::to_string(kind.channels) + " numbers, one per channel");
    Ceilings ceilings = RendererSettings::fullScale();
    for (std::size_t j = 0; j < list.arraySize(); ++j)
        ceilings[j] = static_cast<float>(list.item(j).numberWithin(minCeiling, 1.0));
    return ceilings;
}
OrderedJson writeCustom(const PerChannel<Ceilings>& kind, const Ceilings& ceilings) {
    return std::vector<double>(ceilings.begin(), ceilings.begin() + kind.channels);
}

Result<SavedSession> readSession(std::string_view text, std::string_view name) {
    if (isJournal(text)) return readJournal(text, name);
    return readJson(text, name, limits::maxSessionFileBytes,
                    [](const Json& root) { return detail::readSessionRoot(JsonField(root, {})); });
}

Result<SavedSession> loadSession(const std::filesystem::path& path) {
    auto session = loadText(path, limits::maxSessionFileBytes, readSession);
    const std::filesystem::path folder = path.parent_path();
    const auto resolve = [&](std::string& file) { file = (folder / file).lexically_normal().string(); };
    for (RecordingsChange& change : session.value.log.recordings)
        for (RecordingFile& file : change.files) {
            if (syntheticSeed(file.path)) continue;
            if (file.hash.empty() && !isWithin(folder, folder / file.path))
                return Failure{path.string() +
                               ": recordings: expected a hash for a file that is not in the session's folder "
                               "or below, found none for " +
                               inQuotes(file.path)};
            resolve(file.path);
        }
    for (ClipFile& clip : session.value.log.clips) resolve(clip.file.path);
    return session;
}

std::string sessionJson(const SavedSession& session, const std::filesystem::path& folder) {
    OrderedJson root = writeTable(session);
    const SceneRun* prior = nullptr;
    for (const SceneRun& run : session.log.runs) {
        root["takes"].push_back(detail::runJson(run, prior));
        prior = &run;
    }
    for (const RenderControl& control : logControls(session.log, true, session.channels))
        root["controls"].push_back(detail::timedControlJson(control));
    for (const RecordingsChange& change : session.log.recordings)
        root["recordings"].push_back(detail::recordingsJson(change, folder));
    for (const ClipFile& clip : session.log.clips) root["clips"].push_back(detail::clipJson(clip, folder));
    for (const CollisionEvent& strike : session.log.strikes) root["strikes"].push_back(writeTable(strike));
    if (session.mix) root["desk"] = writeTable(*session.mix);
    return prettyJson(root);
}

// A pause is one long stall at the end. Stalls of slow motion are shorter; after others the world steps on.
bool endsPaused(const SavedSession& session) {
    constexpr std::int64_t minPauseNs = 100'000'000;
    const SceneRun& last = session.log.runs.back();
    if (last.stalls.empty()) return false;
    const WorldStall& stall = last.stalls.back();
    return stall.worldNs >= last.worldEndNs && stall.steps == 1 && stall.lengthNs >= minPauseNs;
}

Mix mixAtEnd(const SavedSession& session) {
    Mix mix = session.mix.value_or(Mix{});
    mix.scene = std::make_shared<const Scene>(sceneAtEndOfRun(session.log.runs.back()));
    mix.seed = session.log.runs.back().seed;
    if (session.mix) return mix;
    const PhantomPanner& panner =
        session.log.panners.empty() ? session.panner : session.log.panners.back().panner;
    const bool isDescribed = session.log.panners.empty() && !session.layout.actuators.empty();
    mix.layout = isDescribed ? session.layout : describeLayout("own", panner.layout());
    mix.law = hasParts(panner.layout()) ? panner.requestedLaw() : panner.law();
    mix.exponent = panner.exponent();
    mix.strips.resize(static_cast<std::size_t>(mix.count()));
    const auto decibels = [](float gain) { return toDecibels(static_cast<double>(gain)); };
    for (std::size_t j = 0; j < mix.strips.size(); ++j) {
        mix.strips[j].output = static_cast<int>(j);
        mix.strips[j].ceilingDb = std::clamp(decibels(session.ceilings[j]), minCeilingDb, 0.0);
    }
    for (const ChannelChange& change : session.log.channels) {
        if (change.channel >= mix.count()) continue;
        Strip& strip = mix.strips[static_cast<std::size_t>(change.channel)];
        if (change.kind == RenderControl::Kind::mute) strip.isMuted = change.value != 0.0f;
        if (change.kind == RenderControl::Kind::ceiling)
            strip.ceilingDb = std::clamp(decibels(change.value), minCeilingDb, 0.0);
        if (change.kind != RenderControl::Kind::gain) continue;
        strip.isInverted = change.value < 0.0f;
        strip.gainDb = change.value == 0.0f
                           ? minStripDb
                           : std::clamp(decibels(std::abs(change.value)), minStripDb, maxStripDb);
    }
    return mix;
}

std::vector<RenderControl> logControls(const SessionLog& log, bool keepLayouts, int channels) {
    std::vector<RenderControl> all;
    if (keepLayouts)
        for (const PannerChange& change : log.panners)
            all.push_back({change.timeNs, RenderControl::Kind::panner, 0, 0.0f, &change.panner});
    for (const ChannelChange& change : log.channels)
        if (change.channel < channels)
            all.push_back({change.timeNs, change.kind, change.channel, change.value, {}});
    std::ranges::stable_sort(all, {}, &RenderControl::timeNs);
    return all;
}

} // namespace physvib
