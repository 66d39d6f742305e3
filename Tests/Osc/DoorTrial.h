// SPDX-License-Identifier: GPL-3.0-or-later
// What a session's doors promise, whatever comes: both doors on one session, without threads and sockets.
#pragma once
#include "../Fuzz/SessionFuzzing.h"
#include "Host/Osc/OscReceiver.h"
#include "Live/Session/OutputClock.h"
#include <algorithm>
#include <stdexcept>

namespace physvib::test {

/// Throws where a promise is broken.
class DoorTrial {
public:
    DoorTrial() { session_->prepare(8000, blockFrames); }

    /// As OscPort does: the reader silences, the worker does the rest.
    void packet(std::span<const char> bytes) {
        const std::uint64_t before = silence_.asked(MuteRequester::osc), asked = silencesIn(bytes);
        if (asked > 0) silence_.request(MuteRequester::osc, before + asked);
        const OscCounts counted = door_.counts();
        answers_.clear();
        hasLifted_ = false;
        door_.receive(bytes, clock_, answers_, before);
        const auto read = readOscPacket(bytes);
        demand(door_.counts().messages - counted.messages == read.value.size(), "messages counted otherwise");
        demand(silence_.asked(MuteRequester::osc) == before + asked, "silences counted otherwise than done");
        demand(asked == 0 || hasLifted_ || silence_.isSilent(), "asked for, and not silent");
        demandLine(door_.counts().fault);
        for (const auto& answer : answers_)
            demand(static_cast<bool>(readOscPacket(answer)), "an answer that cannot be read");
        goOn();
    }

    /// As InputListener does.
    void line(const std::string& text) {
        const bool silences = asksForSilence(text);
        if (silences) silence_.request(MuteRequester::standardInput);
        const auto read =
            readInputLine(text, session_->world().state().scene->materials, session_->channels());
        hasLifted_ = false;
        std::string fault = read.error;
        if (read) {
            if (const auto* message = std::get_if<PlainMessage>(&read.value))
                fault = messages_.take(*message, nullptr, fuzz::anyClip).error;
            else
                fault = act(read.value, MuteRequester::standardInput);
        }
        demand(!silences || silence_.isHeldBy(MuteRequester::standardInput), "asked for, and not silent");
        demandLine(fault);
        goOn();
    }

    /// The stop doors open, whatever came before.
    void demandThatSilenceSilences() {
        silence_.liftAll();
        demand(!silence_.isSilent(), "silent after all was lifted");
        packet(oscPacket(std::string{oscSilenceAddress}, {"", {{"on", 1.0}}}));
        demand(silence_.isHeldBy(MuteRequester::osc), "/physvib/silence did not silence");
        demand(answers_.size() == 1 && door_.refusals().empty(), "/physvib/silence was not answered");
        line(R"({"control": "silence", "on": true})");
        demand(silence_.isHeldBy(MuteRequester::standardInput), "a line did not silence");
        packet(oscPacket(std::string{oscSilenceAddress}, {"", {{"on", 0.0}}}));
        line(R"({"control": "silence", "on": false})");
        demand(!silence_.isSilent(), "its own off did not lift it");
    }

private:
    static constexpr int blockFrames = 64, triesPerBlock = 20, blocksPerSession = 200;

    static void demand(bool isTrue, const std::string& what) {
        if (!isTrue) throw std::runtime_error(what);
    }
    static void demandLine(const std::string& fault) {
        demand(fault.size() < 600, "too long a reason: " + fault);
        demand(std::ranges::none_of(fault, [](char c) { return static_cast<unsigned char>(c) < 0x20; }),
               "more than one line: " + fault);
    }

    std::string act(const LineInput& input, MuteRequester from) {
        if (const auto* action = std::get_if<Action>(&input)) return session_->submit({*action}).error;
        if (const auto* control = std::get_if<OwnedControl>(&input))
            return session_->submit({*control}).error;
        const auto* asked = std::get_if<SilenceControl>(&input);
        demand(asked != nullptr, "a message where none may be");
        SilenceControl control = *asked;
        if (control.number == SilenceControl::unnumbered) control.number = silence_.asked(from);
        hasLifted_ = hasLifted_ || !control.isOn;
        return takeSilence(silence_, control, from);
    }

    void goOn() {
        if (++tries_ % triesPerBlock != 0) return;
        if (++blocks_ % blocksPerSession == 0) session_->prepare(8000, blockFrames);
        session_->advance();
        std::array<std::array<float, blockFrames>, limits::maxEnchanters> samples;
        std::array<float*, limits::maxEnchanters> out{};
        for (std::size_t j = 0; j < out.size(); ++j) out[j] = samples[j].data();
        session_->render(out.data(), blockFrames, RenderMode::realtime);
        for (int j = 0; j < session_->channels(); ++j)
            for (const float sample : samples[static_cast<std::size_t>(j)])
                demand(sample >= -1.0f && sample <= 1.0f, "beyond full scale, or not a number");
    }

    const std::unique_ptr<Session> session_ = fuzz::makeSession();
    MessageRouter messages_{*session_};
    MuteRequests silence_;
    OscReceiver door_{
        *session_,
        messages_,
        {[this](const LineInput& input, const OscOrigin&) { return act(input, MuteRequester::osc); },
         {},
         fuzz::anyClip}};
    OscClock clock_;
    std::vector<std::vector<char>> answers_;
    bool hasLifted_ = false;
    int tries_ = 0, blocks_ = 0;
};

} // namespace physvib::test
