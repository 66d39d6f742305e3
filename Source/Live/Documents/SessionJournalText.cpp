// SPDX-License-Identifier: MIT
// Writes a session journal line by line, and reads one up to its last complete part.
#include "Live/Documents/DocumentJson.h"
#include "Scene/SceneJson.h"
#include "Scene/SceneValidation.h"
#include <utility>

namespace physvib {
namespace {

// the indented session file is larger than the journal
constexpr std::size_t mostBytes = limits::maxSessionFileBytes / 4 * 3;

std::string lineOf(const char* name, OrderedJson item) {
    OrderedJson json;
    json[name] = std::move(item);
    return jsonLine(json) + "\n";
}

/// Builds a session from the lines of a journal.
class JournalReader {
public:
    void read(const JsonField& json) {
        if (lines_++ == 0) return begin(json);
        json.expectObject(
            {"take", "input", "stall", "control", "recordings", "clip", "strike", "world_end_s", "seconds"});
        if (json.has("take")) addTake(json["take"]);
        if (json.has("input")) addInput(json["input"]);
        if (json.has("stall")) addStall(json["stall"]);
        if (json.has("control")) detail::readTimedControl(json["control"], session_);
        if (json.has("recordings")) detail::readRecordingsChange(json["recordings"], session_.log);
        if (json.has("clip")) detail::readClipFile(json["clip"], session_.log);
        if (json.has("strike")) session_.log.strikes.push_back(detail::readStrike(json["strike"]));
        if (json.has("world_end_s")) take(json).worldEndNs = kinds::Time{}(json["world_end_s"]);
        if (json.has("seconds")) session_.lengthNs = kinds::Time{}(json["seconds"]);
    }

    SavedSession finish() {
        for (const SceneRun& take : session_.log.takes)
            if (const std::string fault = validate(take.whole()); !fault.empty()) throw JsonError({}, fault);
        if (session_.log.takes.empty()) throw JsonError({}, "expected at least 1 take, found none");
        return std::move(session_);
    }

private:
    void begin(const JsonField& json) { readTable<SavedSession, JournalHead>(json, session_); }
    SceneRun& take(const JsonField& json) {
        if (session_.log.takes.empty()) json.fail("expected a take first");
        return session_.log.takes.back();
    }
    void addTake(const JsonField& json) {
        auto& takes = session_.log.takes;
        takes.push_back(detail::readTakeStart(json, takes.empty() ? nullptr : &takes.back(), true));
    }
    void addInput(const JsonField& json) {
        SceneRun& last = take(json);
        if (last.inputs.size() == sceneLimits::maxLiveInputs)
            json.fail("expected at most " + std::to_string(sceneLimits::maxLiveInputs) + " inputs of a take");
        detail::readValue(json, last.inputs.emplace_back(), {}, last.scene->materials);
    }
    void addStall(const JsonField& json) {
        SceneRun& last = take(json);
        const WorldStall stall = detail::readStall(json, last);
        if (!last.stalls.empty() && last.stalls.back().worldNs == stall.worldNs)
            last.stalls.back() = stall;
        else
            last.stalls.push_back(stall);
    }

    SavedSession session_;
    std::size_t lines_ = 0;
};

/// The text up to the last complete "seconds" line; lines after it were cut off.
std::string_view toldPart(std::string_view text) {
    constexpr std::string_view told = "\n{ \"seconds\": ";
    for (std::size_t at = text.rfind(told); at != std::string_view::npos && at > 0;
         at = text.rfind(told, at - 1))
        if (const std::size_t end = text.find('\n', at + 1); end != std::string_view::npos)
            return text.substr(0, end + 1);
    return text.substr(0, text.find('\n') + 1);
}

} // namespace

bool isJournal(std::string_view text) noexcept {
    constexpr std::size_t mostVersionBytes = 40;
    const std::string_view head = text.substr(0, std::min(text.find('\n'), mostVersionBytes));
    return head.starts_with("{ \"physvib_session\": ") &&
           head.find("\"journal\": ") != std::string_view::npos;
}

Result<SavedSession> readJournal(std::string_view text, std::string_view name) {
    std::string where{name};
    try {
        if (text.size() > limits::maxSessionFileBytes)
            throw JsonError({}, "expected at most " + std::to_string(limits::maxSessionFileBytes) +
                                    " bytes, found more");
        JournalReader reader;
        std::string_view rest = toldPart(text);
        for (std::size_t line = 1; !rest.empty(); ++line) {
            where = std::string(name) + ":" + std::to_string(line);
            const std::size_t end = rest.find('\n');
            const Json json = parseStrictly(rest.substr(0, end));
            reader.read(JsonField(json, {}));
            rest.remove_prefix(end + 1);
        }
        return reader.finish();
    } catch (const JsonError& error) {
        return Failure{where + ": " + error.what()};
    }
}

JournalLines::JournalLines(const SavedSession& session, std::filesystem::path folder)
    : channels_{session.channels}
    , folder_{std::move(folder)}
    , head_{jsonLine(writeTable<SavedSession, JournalHead>(session)) + "\n"}
    , bytes_{head_.size()} {}

std::string JournalLines::take(SessionLog& log, std::int64_t sessionNs) {
    if (!full_.empty()) {
        log = {std::vector<SceneRun>(1), {}, {}, {}, {}, {}};
        return {};
    }
    std::string text = linesOf(log, sessionNs);
    if (inputs_ > sceneLimits::maxLiveInputs)
        full_ = std::to_string(sceneLimits::maxLiveInputs) + " inputs";
    else if (bytes_ + text.size() > mostBytes)
        full_ = std::to_string(mostBytes / 1'000'000) + " MB";
    else if (sessionNs > limits::maxSessionNs)
        full_ = std::to_string(limits::maxSessionNs / 86'400'000'000'000) + " days";
    if (!full_.empty()) return {};
    bytes_ += text.size();
    toldNs_ = sessionNs;
    return text;
}

std::string JournalLines::linesOf(SessionLog& log, std::int64_t sessionNs) {
    std::string text;
    for (SceneRun& take : log.takes) {
        if (!std::exchange(isBegun_, true)) {
            text += lineOf("take", detail::takeStartJson(take, before_.scene ? &before_ : nullptr, true));
            inputs_ = 0;
            lastStall_ = {-1};
        }
        for (const LiveInput& input : take.inputs)
            text += lineOf("input", detail::inputJson(input, *take.scene));
        inputs_ += std::exchange(take.inputs, {}).size();
        for (const WorldStall& stall : take.stalls)
            if (std::exchange(lastStall_, stall) != stall) text += lineOf("stall", writeTable(stall));
        take.stalls.clear();
        if (&take == &log.takes.back()) break;
        text += lineOf("world_end_s", kinds::Time{}.write(take.worldEndNs));
        isBegun_ = false;
        before_.scene = take.scene;
    }
    if (log.takes.size() > 1) log.takes.erase(log.takes.begin(), log.takes.end() - 1);
    for (const RenderControl& control : controlsOf(log, true, channels_))
        text += lineOf("control", detail::timedControlJson(control));
    for (const RecordingsChange& change : log.recordings)
        text += lineOf("recordings", detail::recordingsJson(change, folder_));
    for (const ClipFile& clip : log.clips) text += lineOf("clip", detail::clipJson(clip, folder_));
    for (const CollisionEvent& strike : log.strikes) text += lineOf("strike", writeTable(strike));
    log.panners.clear();
    log.channels.clear();
    log.recordings.clear();
    log.clips.clear();
    log.strikes.clear();
    OrderedJson told{{"seconds", kinds::Time{}.write(sessionNs)}};
    if (!log.takes.empty()) told["world_end_s"] = kinds::Time{}.write(log.takes.back().worldEndNs);
    return text + jsonLine(told) + "\n";
}

} // namespace physvib
