// SPDX-License-Identifier: MIT
// Handles a message: looks up its name, checks values and time, submits its events, or answers its query.
#include "Live/Messages/MessageRouter.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/NameList.h"
#include "Live/Messages/MessageValues.h"

namespace physvib {

namespace {

// one frame at the lowest rate, so that a later time by this much is a later frame at any rate
constexpr std::int64_t frameNs = 1'000'000'000 / limits::minSampleRateHz;

/// A note for the sender if a vibration seems to lag behind its path under this panning law; else empty.
std::string lagNote(Spread spread, const PhantomPanner& panner) {
    constexpr double intendedShare = 0.3, maxLag = 0.05;
    if (spread == Spread::layout) spread = spreadBy(panner.law());
    if (const Spread exact = panner.travelSpread();
        exact != Spread::equal && spread != exact && spread != Spread::nearest)
        return "law: " + std::string(nameOf(spread)) + " lags on this layout; auto and " +
               std::string(nameOf(exact)) + " do not";
    for (const auto& law : panningLaws) {
        if (spread != spreadBy(law.law)) continue;
        const double centroid = centroidOf(law.law, intendedShare);
        if (std::abs(centroid - intendedShare) > maxLag)
            return "law: " + std::string(law.name) + " lags: felt at " + fixedNumber(centroid, 2) +
                   " of the way between two actuators where " + fixedNumber(intendedShare, 1) +
                   " is meant; equal and energy do not";
    }
    return {};
}

double toSeconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

} // namespace

PlainMessage layoutAnswer(const Session& session) {
    const PhantomPanner panner = session.panner();
    const ActuatorLayout& layout = panner.layout();
    const double scaleX = panner.fieldWidthMetres() / layout.extentWidthMetres,
                 scaleY = panner.fieldHeightMetres() / layout.extentHeightMetres;
    std::vector<double> places;
    for (std::size_t j = 0; j < static_cast<std::size_t>(layout.count); ++j)
        places.insert(places.end(), {layout.places[j].xMetres * scaleX, layout.places[j].yMetres * scaleY});
    return {"layout",
            {{"law", std::string(nameOf(panner.law()))},
             {"exponent", panner.exponent()},
             {"field_m", std::vector{panner.fieldWidthMetres(), panner.fieldHeightMetres()}},
             {"enchanters_m", places}}};
}

PlainMessage latencyAnswer(const Session& session) {
    const Timeline& time = session.timeline();
    return {"latency",
            {{"play_out_s", time.outputLatencySeconds()},
             {"direct_s", time.directSeconds()},
             {"messages_s", time.outputLatencySeconds() - toSeconds(time.inputLeadNs())}}};
}

PlainMessage statusAnswer(const Session& session) {
    const WorldRunner& world = session.world();
    const SessionSize size = world.size();
    return {"status",
            {{"session_s", toSeconds(session.timeline().presentNs())},
             {"waiting", static_cast<double>(size.strikes)},
             {"bodies", static_cast<double>(size.bodies)},
             {"lost", static_cast<double>(world.drops())},
             {"stalls_s", toSeconds(world.stalledNs())},
             {"dropped", static_cast<double>(session.pulse().dropped())}}};
}

Result<PlainMessage> MessageRouter::handle(const PlainMessage& message, MessageTag* tag,
                                           const ClipSource& clips) {
    const auto description = std::ranges::find(messageTable, message.name, &MessageDescription::name);
    if (description == messageTable.end())
        return Failure{inQuotes(message.name) + ": expected one of " + nameList(entryNames(messageTable))};
    try {
        const PhantomPanner panner = session_.panner();
        const MessageValues values{message, *description, panner};
        if (const auto* const answer = std::get_if<MessageDescription::Answer*>(&description->action))
            return (*answer)(session_);
        checkTime(values, tag);
        std::string note;
        auto strikes = makeStrikes(*description, values, clips, panner, note);
        const std::lock_guard lock{mutex_};
        const std::int64_t timeNs = resolveTimeNs(values, tag);
        const bool isNow = !values.has("at") && !values.has("in") && (tag == nullptr || tag->isLate);
        if (std::holds_alternative<MessageDescription::Stop>(description->action))
            submitStop(timeNs);
        else
            submitStrikes(std::move(strikes), timeNs, isNow);
        if (note.empty()) return PlainMessage{};
        return PlainMessage{message.name, {{"note", note}}};
    } catch (const MessageError& error) {
        return Failure{message.name + ": " + error.what()};
    }
}

std::vector<CollisionEvent> MessageRouter::makeStrikes(const MessageDescription& description,
                                                       const MessageValues& values, const ClipSource& clips,
                                                       const PhantomPanner& panner, std::string& note) {
    if (std::holds_alternative<MessageDescription::Clip>(description.action))
        return addClip(values, clips, panner, note);
    const auto* const strikes = std::get_if<MessageDescription::Strikes*>(&description.action);
    if (strikes != nullptr && *strikes == pathStrikes) note = lagNote(values.spread(), panner);
    return strikes == nullptr
               ? std::vector<CollisionEvent>{}
               : (*strikes)(values, session_.world().state().scene->materials, session_.shaping());
}

// Checks the time before a file is read. It is computed again afterwards, because reading takes time.
void MessageRouter::checkTime(const MessageValues& values, const MessageTag* tag) {
    const std::lock_guard lock{mutex_};
    MessageTag tagCopy = tag == nullptr ? MessageTag{} : *tag;
    resolveTimeNs(values, tag == nullptr ? nullptr : &tagCopy);
}

std::int64_t MessageRouter::nowNs() const {
    return std::max(
        {std::int64_t{0}, session_.timeline().presentNs() - session_.timeline().inputLeadNs(), latestNowNs_});
}

// Session times in the past are refused: a render of the log would differ from what was felt. A sender of
// time tags cannot know the session time, so a late tag is marked and acted on at once.
std::int64_t MessageRouter::resolveTimeNs(const MessageValues& values, MessageTag* tag) const {
    values.expectOneOf({"at", "in"});
    if (tag != nullptr) {
        for (const char* name : {"at", "in"})
            if (values.has(name)) values.fail(name, "expected either this or a time tag");
        tag->isLate = tag->sessionNs < session_.timeline().presentNs();
        return tag->isLate ? nowNs() : scheduledNs(values, "time tag", tag->sessionNs);
    }
    if (values.has("in")) return nowNs() + std::llround(values.number("in") * 1e9);
    if (!values.has("at") || values.isText("at")) {
        if (values.text("at") != "now") values.fail("at", "expected a session time, or now");
        return nowNs();
    }
    const std::int64_t timeNs = std::llround(values.number("at") * 1e9),
                       presentNs = session_.timeline().presentNs();
    if (timeNs < presentNs)
        values.fail("at", "expected a session time that is not over: it is " +
                              fixedNumber(toSeconds(presentNs), 3) + " s, found " +
                              numberText(toSeconds(timeNs)) + " s");
    return scheduledNs(values, "at", timeNs);
}

std::int64_t MessageRouter::scheduledNs(const MessageValues& values, std::string_view name,
                                        std::int64_t timeNs) const {
    if (timeNs > session_.timeline().presentNs() + std::llround(messages::maxAheadSeconds * 1e9))
        values.fail(name, "expected at most " + plainNumber(messages::maxAheadSeconds) + " s from now");
    return std::max<std::int64_t>(0, timeNs - session_.timeline().inputLeadNs());
}

void MessageRouter::submitStrikes(std::vector<CollisionEvent> strikes, std::int64_t startNs, bool isNow) {
    if (isNow) latestNowNs_ = startNs;
    const double sceneGain = session_.shaping().gain;
    for (CollisionEvent& strike : strikes) {
        strike.timeNs += startNs;
        // levels are shares of full scale in every scene, so the scene's gain is divided out
        if (sceneGain > 0.0 && !isClip(strike.sound)) strike.amplitude /= sceneGain;
    }
    if (auto sent = session_.submit({Strikes{strikes, true}, 0}); !sent) throw MessageError{sent.error};
}

// Adds the clip to the session before its events, so that they find its samples. Reading a file takes long,
// but does not block other inputs.
std::vector<CollisionEvent> MessageRouter::addClip(const MessageValues& values, const ClipSource& clips,
                                                   const PhantomPanner& panner, std::string& note) {
    if (!clips) values.fail("file", "expected no clips here: no folder was given to read them from");
    if (values.text("file").empty()) values.fail("file", "expected a file's name");
    const auto loaded = clips(values.text("file"));
    if (!loaded) values.fail("file", loaded.error);
    auto strikes = clipStrikes(values, loaded.value, panner); // checked before anything is kept
    const auto number = session_.addClip(loaded.value.channels);
    if (!number)
        values.fail("file", "expected no more than " + std::to_string(maxClips) +
                                " channels of clips in a session, and " +
                                std::to_string(limits::maxRecordingSamples) + " samples");
    note = loaded.value.channels.front().note;
    for (std::size_t j = 0; j < strikes.size(); ++j)
        strikes[j].sound = soundOfClip(*number + static_cast<int>(j));
    return strikes;
}

// If two messages have the same time, the second acts after the first.
void MessageRouter::submitStop(std::int64_t timeNs) {
    if (timeNs == latestNowNs_) timeNs = latestNowNs_ = timeNs + frameNs;
    if (auto sent = session_.submit({Stop{}, timeNs}); !sent) throw MessageError{sent.error};
}

std::string applySilence(MuteRequests& silence, const SilenceControl& control, MuteRequester requester) {
    if (control.isOn) {
        if (control.number == SilenceControl::unnumbered)
            silence.request(requester);
        else
            silence.request(requester, control.number);
        return {};
    }
    silence.withdraw(requester, control.number);
    std::string others;
    for (const auto& [other, phrase] : {std::pair{MuteRequester::machine, "at the machine"},
                                        {MuteRequester::standardInput, "by standard input"},
                                        {MuteRequester::osc, "by OSC"}})
        if (other != requester && silence.isRequestedBy(other))
            others += std::string(others.empty() ? "" : " and ") + phrase;
    return others.empty() ? "" : "silence: still asked for " + others;
}

} // namespace physvib
