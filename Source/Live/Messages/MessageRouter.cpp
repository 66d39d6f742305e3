// SPDX-License-Identifier: MIT
// Routes messages: looks up the name, checks values and time, acts, and answers queries.
#include "Live/Messages/MessageRouter.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/NameList.h"
#include "Live/Messages/MessageValues.h"

namespace physvib {

namespace {

// one frame at the lowest rate, so that a later time by this much is a later frame at any rate
constexpr std::int64_t frameNs = 1'000'000'000 / limits::minSampleRateHz;

/// A note if the felt position lags behind the path's position under this panning law; else empty.
std::string lagNote(Spread spread, const PhantomPanner& panner) {
    constexpr double meant = 0.3, nobodyFeels = 0.05;
    if (spread == Spread::layout) spread = spreadBy(panner.law());
    if (const Spread exact = panner.travelSpread();
        exact != Spread::equal && spread != exact && spread != Spread::alone)
        return "law: " + std::string(nameOf(spread)) + " lags on this layout; auto and " +
               std::string(nameOf(exact)) + " do not";
    for (const auto& one : panningLaws) {
        if (spread != spreadBy(one.law)) continue;
        const double felt = centroidOf(one.law, meant);
        if (std::abs(felt - meant) > nobodyFeels)
            return "law: " + std::string(one.name) + " lags: felt at " + fixedNumber(felt, 2) +
                   " of the way between two actuators where " + fixedNumber(meant, 1) +
                   " is meant; equal and energy do not";
    }
    return {};
}

double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

} // namespace

PlainMessage layoutAnswer(const Session& session) {
    const PhantomPanner panner = session.panner();
    const EnchanterLayout& layout = panner.layout();
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
             {"messages_s", time.outputLatencySeconds() - seconds(time.toldAheadNs())}}};
}

PlainMessage statusAnswer(const Session& session) {
    const WorldRunner& world = session.world();
    const SessionSize size = world.size();
    return {"status",
            {{"session_s", seconds(session.timeline().presentNs())},
             {"waiting", static_cast<double>(size.strikes)},
             {"bodies", static_cast<double>(size.bodies)},
             {"lost", static_cast<double>(world.drops())},
             {"stalls_s", seconds(world.slippedNs())},
             {"dropped", static_cast<double>(session.pulse().dropped())}}};
}

Result<PlainMessage> MessageRouter::take(const PlainMessage& message, MessageTag* tag,
                                         const ClipSource& clips) {
    const auto description = std::ranges::find(messageTable, message.name, &MessageDescription::name);
    if (description == messageTable.end())
        return Failure{inQuotes(message.name) + ": expected one of " + listed(namesOf(messageTable))};
    try {
        const PhantomPanner panner = session_.panner();
        const MessageValues values{message, *description, panner};
        if (const auto* const answer = std::get_if<MessageDescription::Answer*>(&description->act))
            return (*answer)(session_);
        expectTime(values, tag);
        std::string note;
        auto strikes = strikesOf(*description, values, clips, panner, note);
        const std::lock_guard lock{mutex_};
        const std::int64_t time = timeOf(values, tag);
        const bool isNow = !values.has("at") && !values.has("in") && (tag == nullptr || tag->isLate);
        if (std::holds_alternative<MessageDescription::Stop>(description->act))
            stop(time);
        else
            strike(std::move(strikes), time, isNow);
        if (note.empty()) return PlainMessage{};
        return PlainMessage{message.name, {{"note", note}}};
    } catch (const MessageError& error) {
        return Failure{message.name + ": " + error.what()};
    }
}

std::vector<CollisionEvent> MessageRouter::strikesOf(const MessageDescription& description,
                                                     const MessageValues& values, const ClipSource& clips,
                                                     const PhantomPanner& panner, std::string& note) {
    if (std::holds_alternative<MessageDescription::Clip>(description.act))
        return clip(values, clips, panner, note);
    const auto* const strikes = std::get_if<MessageDescription::Strikes*>(&description.act);
    if (strikes != nullptr && *strikes == pathStrikes) note = lagNote(values.spread(), panner);
    return strikes == nullptr
               ? std::vector<CollisionEvent>{}
               : (*strikes)(values, session_.world().state().scene->materials, session_.shaping());
}

// Checks the time before a file is read. It is computed again afterwards, because reading takes time.
void MessageRouter::expectTime(const MessageValues& values, const MessageTag* tag) {
    const std::lock_guard lock{mutex_};
    MessageTag tried = tag == nullptr ? MessageTag{} : *tag;
    timeOf(values, tag == nullptr ? nullptr : &tried);
}

std::int64_t MessageRouter::nowNs() const {
    return std::max(
        {std::int64_t{0}, session_.timeline().presentNs() - session_.timeline().toldAheadNs(), latestNs_});
}

// Session times in the past are refused: a render of the log would differ from what was felt. A sender of
// time tags cannot know the session time, so a late tag is marked and acted on at once.
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
    const std::int64_t at = std::llround(values.number("at") * 1e9),
                       present = session_.timeline().presentNs();
    if (at < present)
        values.fail("at", "expected a session time that is not over: it is " +
                              fixedNumber(seconds(present), 3) + " s, found " + numberText(seconds(at)) +
                              " s");
    return aheadOrFail(values, "at", at);
}

std::int64_t MessageRouter::aheadOrFail(const MessageValues& values, std::string_view name,
                                        std::int64_t at) const {
    if (at > session_.timeline().presentNs() + std::llround(messages::mostAheadSeconds * 1e9))
        values.fail(name, "expected at most " + plainNumber(messages::mostAheadSeconds) + " s from now");
    return std::max<std::int64_t>(0, at - session_.timeline().toldAheadNs());
}

void MessageRouter::strike(std::vector<CollisionEvent> strikes, std::int64_t start, bool isNow) {
    if (isNow) latestNs_ = start;
    const double sceneGain = session_.shaping().gain;
    for (CollisionEvent& strike : strikes) {
        strike.timeNs += start;
        // levels are shares of full scale in every scene, so the scene's gain is divided out
        if (sceneGain > 0.0 && !isClip(strike.sound)) strike.amplitude /= sceneGain;
    }
    if (auto taken = session_.submit({Strikes{strikes, true}, 0}); !taken) throw MessageError{taken.error};
}

// Adds the clip to the session before its events, so that they find its samples. Reading a file takes long,
// but does not block other inputs.
std::vector<CollisionEvent> MessageRouter::clip(const MessageValues& values, const ClipSource& clips,
                                                const PhantomPanner& panner, std::string& note) {
    if (!clips) values.fail("file", "expected no clips here: no folder was given to read them from");
    if (values.word("file").empty()) values.fail("file", "expected a file's name");
    const auto loaded = clips(values.word("file"));
    if (!loaded) values.fail("file", loaded.error);
    auto strikes = clipStrikes(values, loaded.value, panner); // checked before anything is kept
    const auto number = session_.keepClip(loaded.value.channels);
    if (!number)
        values.fail("file", "expected no more than " + std::to_string(mostClips) +
                                " channels of clips in a session, and " +
                                std::to_string(limits::maxRecordingSamples) + " samples");
    note = loaded.value.channels.front().note;
    for (std::size_t j = 0; j < strikes.size(); ++j)
        strikes[j].sound = soundOfClip(*number + static_cast<int>(j));
    return strikes;
}

// If two messages have the same time, the second acts after the first.
void MessageRouter::stop(std::int64_t at) {
    if (at == latestNs_) at = latestNs_ = at + frameNs;
    if (auto taken = session_.submit({Stop{}, at}); !taken) throw MessageError{taken.error};
}

std::string takeSilence(MuteRequests& silence, const SilenceControl& control, MuteRequester holder) {
    if (control.isOn) {
        if (control.number == SilenceControl::unnumbered)
            silence.request(holder);
        else
            silence.request(holder, control.number);
        return {};
    }
    silence.lift(holder, control.number);
    std::string others;
    for (const auto& [other, words] : {std::pair{MuteRequester::machine, "at the machine"},
                                       {MuteRequester::standardInput, "by standard input"},
                                       {MuteRequester::osc, "by OSC"}})
        if (other != holder && silence.isHeldBy(other))
            others += std::string(others.empty() ? "" : " and ") + words;
    return others.empty() ? "" : "silence: still asked for " + others;
}

} // namespace physvib
