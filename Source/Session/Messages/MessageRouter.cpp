// SPDX-License-Identifier: MIT
// Names, times and answers.
#include "Session/Messages/MessageRouter.h"
#include "Core/ClipNumber.h"
#include "Files/Disk/FileLimits.h"
#include "Files/Text/NumberText.h"
#include "Session/Messages/MessageStrikes.h"
#include "Session/Messages/MessageValues.h"
#include <algorithm>
#include <cmath>

namespace physvib {

namespace {

constexpr std::int64_t frameNs = 1'000'000'000 / limits::minSampleRateHz; // of any rate: what is that much later has a later frame

double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

std::string knownNames() {
    std::string names;
    for (const MessageDescription& one : messageTable) names.append(names.empty() ? "" : ", ").append(one.name);
    return names;
}

PlainMessage layoutAnswer(const PhantomPanner& panner) {
    const EnchanterLayout& layout = panner.layout();
    const double scaleX = panner.fieldWidthMetres() / layout.extentWidthMetres, scaleY = panner.fieldHeightMetres() / layout.extentHeightMetres;
    std::vector<double> places;
    for (std::size_t j = 0; j < static_cast<std::size_t>(layout.count); ++j)
        places.insert(places.end(), {layout.places[j].xMetres * scaleX, layout.places[j].yMetres * scaleY});
    return {"layout",
            {{"law", std::string(panningLawNames[static_cast<std::size_t>(panner.law())])},
             {"exponent", panner.exponent()},
             {"field_m", std::vector{panner.fieldWidthMetres(), panner.fieldHeightMetres()}},
             {"enchanters_m", places}}};
}

} // namespace

Result<PlainMessage> MessageRouter::take(const PlainMessage& message, MessageTag* tag, const ClipSource& clips) {
    const auto description = std::ranges::find(messageTable, message.name, &MessageDescription::name);
    if (description == messageTable.end()) return Failure{inQuotes(message.name) + ": expected one of " + knownNames()};
    const auto kind = static_cast<MessageKind>(description - messageTable.begin());
    try {
        const PhantomPanner panner = session_.panner();
        const MessageValues values{message, *description, panner};
        if (description->isQuery) return answer(kind);
        expectTime(values, tag);
        std::string note;
        auto strikes = kind == MessageKind::clip ? clip(values, clips, panner, note) : strikesOf(kind, values, session_.world().state().scene->materials, session_.shaping());
        const std::lock_guard lock{mutex_};
        const std::int64_t time = timeOf(values, tag);
        const bool isNow = !values.has("at") && !values.has("in") && (tag == nullptr || tag->isLate);
        if (kind == MessageKind::stop) stop(time);
        else strike(std::move(strikes), time, isNow);
        return note.empty() ? PlainMessage{} : PlainMessage{message.name, {{"note", note}}};
    } catch (const MessageError& error) {
        return Failure{message.name + ": " + error.what()};
    }
}

// Before a file is read for it. What is left of the time is looked at again when it has been.
void MessageRouter::expectTime(const MessageValues& values, const MessageTag* tag) {
    const std::lock_guard lock{mutex_};
    MessageTag tried = tag == nullptr ? MessageTag{} : *tag;
    timeOf(values, tag == nullptr ? nullptr : &tried);
}

std::int64_t MessageRouter::nowNs() const { return std::max({std::int64_t{0}, session_.timeline().presentNs() - session_.timeline().toldAheadNs(), latestNs_}); }

// Session times that are over are refused: what is rendered again would not be what was felt. Who sends tags cannot know: such
// a message is late, and done at once.
std::int64_t MessageRouter::timeOf(const MessageValues& values, MessageTag* tag) const {
    values.expectOneOf({"at", "in"});
    if (tag != nullptr) {
        for (const char* own : {"at", "in"})
            if (values.has(own)) values.fail(own, "expected either this or a time tag");
        tag->isLate = tag->sessionNs < session_.timeline().presentNs();
        return tag->isLate ? nowNs() : aheadOrFail(values, "time tag", tag->sessionNs);
    }
    if (values.has("in")) return nowNs() + std::llround(values.number("in") * 1e9);
    if (!values.has("at") || values.isWord("at")) {
        if (values.word("at") != "now") values.fail("at", "expected a session time, or now");
        return nowNs();
    }
    const std::int64_t at = std::llround(values.number("at") * 1e9), present = session_.timeline().presentNs();
    if (at < present) values.fail("at", "expected a session time that is not over: it is " + fixedNumber(seconds(present), 3) + " s, found " + numberText(seconds(at)) + " s");
    return aheadOrFail(values, "at", at);
}

std::int64_t MessageRouter::aheadOrFail(const MessageValues& values, std::string_view name, std::int64_t at) const {
    if (at > session_.timeline().presentNs() + std::llround(messages::mostAheadSeconds * 1e9)) values.fail(name, "expected at most " + plainNumber(messages::mostAheadSeconds) + " s from now");
    return std::max<std::int64_t>(0, at - session_.timeline().toldAheadNs());
}

void MessageRouter::strike(std::vector<CollisionEvent> strikes, std::int64_t start, bool isNow) {
    if (isNow) latestNs_ = start;
    const double sceneGain = session_.shaping().gain;
    for (CollisionEvent& strike : strikes) {
        strike.timeNs += start;
        if (sceneGain > 0.0 && !isClip(strike.frequencyHz)) strike.amplitude /= sceneGain; // a level is of full scale, in every scene
    }
    if (auto taken = session_.take({Strikes{strikes, true}, 0}); !taken) throw MessageError{taken.error};
}

// Kept before it is struck: a strike finds its samples. Reading and keeping takes long; no other door waits for it.
std::vector<CollisionEvent> MessageRouter::clip(const MessageValues& values, const ClipSource& clips, const PhantomPanner& panner, std::string& note) {
    if (!clips) values.fail("file", "expected no clips here: no folder was given to read them from");
    if (values.word("file").empty()) values.fail("file", "expected a file's name");
    const auto loaded = clips(values.word("file"));
    if (!loaded) values.fail("file", loaded.error);
    auto strikes = clipStrikes(values, loaded.value, panner); // refused before anything is kept
    const auto number = session_.keepClip(loaded.value.channels);
    if (!number) values.fail("file", "expected no more than " + std::to_string(mostClips) + " channels of clips in a session, and " + std::to_string(limits::maxRecordingSamples) + " samples");
    note = loaded.value.channels.front().note;
    for (std::size_t j = 0; j < strikes.size(); ++j) strikes[j].frequencyHz = clipFrequencyHz(*number + static_cast<int>(j));
    return strikes;
}

// Of two messages of one moment, the second acts on the first.
void MessageRouter::stop(std::int64_t at) {
    if (at == latestNs_) at = latestNs_ = at + frameNs;
    if (auto taken = session_.take({Stop{}, at}); !taken) throw MessageError{taken.error};
}

PlainMessage MessageRouter::answer(MessageKind query) const {
    if (query == MessageKind::layout) return layoutAnswer(session_.panner());
    if (query == MessageKind::latency) return {"latency", {{"play_out_s", session_.timeline().playOutSeconds()},
                                                               {"direct_s", session_.timeline().directSeconds()},
                                                               {"messages_s", session_.timeline().playOutSeconds() - seconds(session_.timeline().toldAheadNs())}}};
    const SessionSize size = session_.world().size();
    return {"status",
            {{"session_s", seconds(session_.timeline().presentNs())},
             {"waiting", static_cast<double>(size.strikes)},
             {"bodies", static_cast<double>(size.bodies)},
             {"lost", static_cast<double>(session_.world().drops())},
             {"stalls_s", seconds(session_.world().slippedNs())}}};
}

} // namespace physvib
