// SPDX-License-Identifier: MIT
// Writes a session journal line by line, and reads one up to its last complete part.
#include "Live/Documents/DocumentJson.h"
#include "Scene/SceneJson.h"
#include "Scene/SceneValidation.h"
#include <utility>

namespace physvib {
namespace {

// the indented session file is larger than the journal
constexpr std::size_t maxJournalBytes = limits::maxSessionFileBytes / 4 * 3;

std::string formatLine(const char* name, OrderedJson item) {
    OrderedJson json;
    json[name] = std::move(item);
    return compactJson(json) + "\n";
}

/// Builds a session from the lines of a journal.
class JournalReader {
public:
    void read(const JsonField& json) {
        if (lineCount_++ == 0) return begin(json);
        json.expectObject(
            {"take", "input", "stall", "control", "recordings", "clip", "strike", "world_end_s", "seconds"});
        if (json.has("take")) addRun(json["take"]);
        if (json.has("input")) addInput(json["input"]);
        if (json.has("stall")) addStall(json["stall"]);
        if (json.has("control")) detail::readTimedControl(json["control"], session_);
        if (json.has("recordings")) detail::readRecordingsChange(json["recordings"], session_.log);
        if (json.has("clip")) detail::readClipFile(json["clip"], session_.log);
        if (json.has("strike")) session_.log.strikes.push_back(detail::readStrike(json["strike"]));
        if (json.has("world_end_s")) lastRun(json).worldEndNs = kinds::Time{}(json["world_end_s"]);
        if (json.has("seconds")) session_.lengthNs = kinds::Time{}(json["seconds"]);
    }

    SavedSession finish() {
        for (const SceneRun& run : session_.log.runs)
            if (const std::string error = validate(run.fullScene()); !error.empty())
                throw JsonError({}, error);
        if (session_.log.runs.empty()) throw JsonError({}, "expected at least 1 take, found none");
        return std::move(session_);
    }

private:
    void begin(const JsonField& json) { readTable<SavedSession, JournalHead>(json, session_); }
    SceneRun& lastRun(const JsonField& json) {
        if (session_.log.runs.empty()) json.fail("expected a take first");
        return session_.log.runs.back();
    }
    void addRun(const JsonField& json) {
        auto& runs = session_.log.runs;
        runs.push_back(detail::readRunStart(json, runs.empty() ? nullptr : &runs.back(), true));
    }
    void addInput(const JsonField& json) {
        SceneRun& last = lastRun(json);
        if (last.inputs.size() == sceneLimits::maxLiveInputs)
            json.fail("expected at most " + std::to_string(sceneLimits::maxLiveInputs) + " inputs of a take");
        detail::readValue(json, last.inputs.emplace_back(), {}, last.scene->materials);
    }
    void addStall(const JsonField& json) {
        SceneRun& last = lastRun(json);
        const WorldStall stall = detail::readStall(json, last);
        if (!last.stalls.empty() && last.stalls.back().worldNs == stall.worldNs)
            last.stalls.back() = stall;
        else
            last.stalls.push_back(stall);
    }

    SavedSession session_;
    std::size_t lineCount_ = 0;
};

/// The text up to the last complete "seconds" line; lines after it were cut off.
std::string_view completePart(std::string_view text) {
    constexpr std::string_view marker = "\n{ \"seconds\": ";
    for (std::size_t start = text.rfind(marker); start != std::string_view::npos && start > 0;
         start = text.rfind(marker, start - 1))
        if (const std::size_t end = text.find('\n', start + 1); end != std::string_view::npos)
            return text.substr(0, end + 1);
    return text.substr(0, text.find('\n') + 1);
}

} // namespace

bool isJournal(std::string_view text) noexcept {
    constexpr std::size_t maxVersionBytes = 40;
    const std::string_view head = text.substr(0, std::min(text.find('\n'), maxVersionBytes));
    return head.starts_with("{ \"physvib_session\": ") &&
           head.find("\"journal\": ") != std::string_view::npos;
}

Result<SavedSession> readJournal(std::string_view text, std::string_view name) {
    std::string location{name};
    try {
        if (text.size() > limits::maxSessionFileBytes)
            throw JsonError({}, "expected at most " + std::to_string(limits::maxSessionFileBytes) +
                                    " bytes, found more");
        JournalReader reader;
        std::string_view remaining = completePart(text);
        for (std::size_t line = 1; !remaining.empty(); ++line) {
            location = std::string(name) + ":" + std::to_string(line);
            const std::size_t end = remaining.find('\n');
            const Json json = parseStrictly(remaining.substr(0, end));
            reader.read(JsonField(json, {}));
            remaining.remove_prefix(end + 1);
        }
        return reader.finish();
    } catch (const JsonError& error) {
        return Failure{location + ": " + error.what()};
    }
}

JournalLines::JournalLines(const SavedSession& session, std::filesystem::path folder)
    : channels_{session.channels}
    , folder_{std::move(folder)}
    , head_{compactJson(writeTable<SavedSession, JournalHead>(session)) + "\n"}
    , bytesWritten_{head_.size()} {}

std::string JournalLines::nextLines(SessionLog& log, std::int64_t sessionNs) {
    if (!limitError_.empty()) {
        log = {std::vector<SceneRun>(1), {}, {}, {}, {}, {}};
        return {};
    }
    std::string text = formatLines(log, sessionNs);
    if (runInputs_ > sceneLimits::maxLiveInputs)
        limitError_ = std::to_string(sceneLimits::maxLiveInputs) + " inputs";
    else if (bodies_ > limits::maxSessionBodies)
        limitError_ = std::to_string(limits::maxSessionBodies) + " bodies";
    else if (bytesWritten_ + text.size() > maxJournalBytes)
        limitError_ = std::to_string(maxJournalBytes / 1'000'000) + " MB";
    else if (sessionNs > limits::maxSessionNs)
        limitError_ = std::to_string(limits::maxSessionNs / 86'400'000'000'000) + " days";
    if (!limitError_.empty()) return {};
    bytesWritten_ += text.size();
    completeNs_ = sessionNs;
    return text;
}

std::string JournalLines::formatLines(SessionLog& log, std::int64_t sessionNs) {
    std::string text;
    for (SceneRun& run : log.runs) {
        if (!std::exchange(isRunWritten_, true)) {
            text += formatLine("take",
                               detail::runStartJson(run, previousRun_.scene ? &previousRun_ : nullptr, true));
            bodies_ += detail::bodyCount(*run.scene);
            runInputs_ = 0;
            lastStall_ = {-1};
        }
        for (const LiveInput& input : run.inputs)
            text += formatLine("input", detail::inputJson(input, *run.scene));
        runInputs_ += std::exchange(run.inputs, {}).size();
        for (const WorldStall& stall : run.stalls)
            if (std::exchange(lastStall_, stall) != stall) text += formatLine("stall", writeTable(stall));
        run.stalls.clear();
        if (&run == &log.runs.back()) break;
        text += formatLine("world_end_s", kinds::Time{}.write(run.worldEndNs));
        isRunWritten_ = false;
        previousRun_.scene = run.scene;
    }
    if (log.runs.size() > 1) log.runs.erase(log.runs.begin(), log.runs.end() - 1);
    for (const RenderControl& control : logControls(log, true, channels_))
        text += formatLine("control", detail::timedControlJson(control));
    for (const RecordingsChange& change : log.recordings)
        text += formatLine("recordings", detail::recordingsJson(change, folder_));
    for (const ClipFile& clip : log.clips) text += formatLine("clip", detail::clipJson(clip, folder_));
    for (const CollisionEvent& strike : log.strikes) text += formatLine("strike", writeTable(strike));
    log = {std::move(log.runs), {}, {}, {}, {}, {}};
    OrderedJson last{{"seconds", kinds::Time{}.write(sessionNs)}};
    if (!log.runs.empty()) last["world_end_s"] = kinds::Time{}.write(log.runs.back().worldEndNs);
    return text + compactJson(last) + "\n";
}

} // namespace physvib
