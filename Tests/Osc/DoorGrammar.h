// SPDX-License-Identifier: GPL-3.0-or-later
// Lines and packets for a session's doors, from a grammar that knows every message, control and input and
// mixes their names, fields, types, addresses, bundles and times. Seeded: the same with every library.
#pragma once
#include "../Fuzz/SessionFuzzing.h"
#include "Host/Osc/OscReceiver.h"
#include "Io/Json/JsonField.h"
#include "Live/Documents/DocumentJson.h"
#include "Live/Session/OutputClock.h"
#include "Scene/SceneFields.h"
#include "Support/ClosedForm.h"
#include <algorithm>
#include <bit>
#include <limits>
#include <stdexcept>

// What a session's doors promise, whatever comes: both doors on one session, without threads and sockets.
namespace physvib::test {

/// Throws where a promise is broken.
class DoorTrial {
public:
    DoorTrial() { session_->prepare(8000, blockFrames); }

    /// As OscPort does: the reader silences, the worker does the rest.
    void packet(std::span<const char> bytes) {
        const std::uint64_t before = silence_.requestCount(MuteRequester::osc),
                            asked = countSilenceRequests(bytes);
        if (asked > 0) silence_.request(MuteRequester::osc, before + asked);
        const OscCounts counted = door_.counts();
        answers_.clear();
        hasLifted_ = false;
        door_.receive(bytes, clock_, answers_, before);
        const auto read = readOscPacket(bytes);
        demand(door_.counts().messages - counted.messages == read.value.size(), "messages counted otherwise");
        demand(silence_.requestCount(MuteRequester::osc) == before + asked,
               "silences counted otherwise than done");
        demand(asked == 0 || hasLifted_ || silence_.isSilent(), "asked for, and not silent");
        demandLine(door_.counts().lastError);
        for (const auto& answer : answers_)
            demand(static_cast<bool>(readOscPacket(answer)), "an answer that cannot be read");
        goOn();
    }

    /// As InputListener does.
    void line(const std::string& text) {
        const bool silences = requestsSilence(text);
        if (silences) silence_.request(MuteRequester::standardInput);
        const auto read =
            readInputLine(text, session_->world().state().scene->materials, session_->channels());
        hasLifted_ = false;
        std::string fault = read.error;
        if (read) {
            if (const auto* message = std::get_if<PlainMessage>(&read.value))
                fault = messages_.handle(*message, nullptr, fuzz::anyClip).error;
            else
                fault = act(read.value, MuteRequester::standardInput);
        }
        demand(!silences || silence_.isRequestedBy(MuteRequester::standardInput),
               "asked for, and not silent");
        demandLine(fault);
        goOn();
    }

    /// The stop doors open, whatever came before.
    void demandThatSilenceSilences() {
        silence_.withdrawAll();
        demand(!silence_.isSilent(), "silent after all was lifted");
        packet(oscPacket(std::string{oscSilenceAddress}, {"", {{"on", 1.0}}}));
        demand(silence_.isRequestedBy(MuteRequester::osc), "/physvib/silence did not silence");
        demand(answers_.size() == 1 && door_.refusals().empty(), "/physvib/silence was not answered");
        line(R"({"control": "silence", "on": true})");
        demand(silence_.isRequestedBy(MuteRequester::standardInput), "a line did not silence");
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
        if (control.number == SilenceControl::unnumbered) control.number = silence_.requestCount(from);
        hasLifted_ = hasLifted_ || !control.isOn;
        return applySilence(silence_, control, from);
    }

    void goOn() {
        if (++tries_ % triesPerBlock != 0) return;
        if (++blocks_ % blocksPerSession == 0) session_->prepare(8000, blockFrames);
        session_->advance();
        std::array<std::array<float, blockFrames>, limits::maxActuators> samples;
        std::array<float*, limits::maxActuators> out{};
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

class DoorGrammar {
public:
    explicit DoorGrammar(std::uint32_t seed)
        : random_{seed} {
        for (const auto& message : messageTable) {
            names_.emplace_back(message.name);
            for (const auto& argument : message.arguments) arguments_.push_back(&argument);
        }
        for (const auto& argument : messages::timeArguments) arguments_.push_back(&argument);
        for (const auto& control : controlTable) {
            names_.emplace_back(control.name);
            if (!control.field.empty()) fields_.emplace_back(control.field);
        }
        for (const auto name : actionNames) names_.emplace_back(name);
        for (const char* name : {"silence", "silence", "silence", "silence", "Silence", "", "stop ", "hit"})
            names_.emplace_back(name);
        for (const auto* argument : arguments_) fields_.emplace_back(argument->name);
        // what other kinds of lines have, and what makes a line one of a kind
        for (const char* field : {"message", "control", "input", "answer", "on", "channel", "id", "body",
                                  "angle_rad", "gravity_m_per_s2", "impulse_ns", "velocity_m_per_s",
                                  "material", "roughness", "joint", "over_s", "silence", "", "panning"})
            fields_.emplace_back(field);
    }

    /// With a name of the tables, and its own fields or any.
    PlainMessage message() {
        PlainMessage plain{any(names_), {}};
        const auto known = std::ranges::find(messageTable, plain.name, &MessageDescription::name);
        if (known != messageTable.end())
            for (const auto& argument : known->arguments)
                if (oneIn(2)) plain.values.push_back({std::string{argument.name}, valueOf(argument)});
        const auto control = std::ranges::find(controlTable, plain.name, &ControlDescription::name);
        if (control != controlTable.end() && !oneIn(4)) {
            plain.values.push_back({"channel", static_cast<double>(1 + random_.below(5))});
            if (!control->field.empty())
                plain.values.push_back(
                    {std::string{control->field},
                     oneIn(2) ? random_.uniform(control->minimum, control->maximum) : number()});
        }
        const auto act = std::ranges::find(acts, plain.name, &Act::name);
        if (act != acts.end() && !oneIn(4)) {
            if (act->hasBody) plain.values.push_back({"body", "ball"});
            std::vector<double> numbers(act->numbers);
            for (double& one : numbers) one = random_.uniform(-1.0, 1.0);
            if (act->numbers == 1) plain.values.push_back({act->field, numbers[0]});
            if (act->numbers > 1) plain.values.push_back({act->field, std::move(numbers)});
        }
        if (containsSilenceWord(plain.name) && oneIn(2))
            plain.values.push_back({"on", static_cast<double>(oneIn(2))});
        while (oneIn(3)) plain.values.push_back({any(fields_), value()});
        return plain;
    }

    /// A line of JSON of any kind, often broken.
    std::string line() {
        const PlainMessage plain = message();
        Json json{{kind(plain.name), plain.name}};
        for (const NamedValue& one : plain.values) {
            json[one.name] = std::visit([](const auto& found) { return Json(found); }, one.value);
            if (one.name == "on" && oneIn(2)) json[one.name] = oneIn(2);
            if (oneIn(40)) json[one.name] = Json{{any(fields_), any(fields_)}};
        }
        if (oneIn(20)) json["body"] = "ball";
        if (oneIn(5)) json["id"] = random_.below(100);
        std::string text = json.dump(-1, ' ', oneIn(4), Json::error_handler_t::replace);
        if (oneIn(20)) text.insert(1, "\"" + any(fields_) + "\": " + std::to_string(random_.below(3)) + ", ");
        return broken(std::move(text));
    }

    std::vector<char> packet() {
        const std::string bytes = broken(oneIn(3) ? bundle(0) : osc());
        return {bytes.begin(), bytes.end()};
    }

private:
    /// Inputs that packets can have: their fields are not nested.
    struct Act {
        const char* name;
        bool hasBody;
        const char* field;
        std::size_t numbers;
    };
    static constexpr std::array acts{Act{"tilt", false, "angle_rad", 1},
                                     Act{"gravity", false, "gravity_m_per_s2", 2},
                                     Act{"impulse", true, "impulse_ns", 2},
                                     Act{"velocity", true, "velocity_m_per_s", 2},
                                     Act{"remove", true, "", 0},
                                     Act{"grip", true, "to_m", 2}};

    bool oneIn(int count) { return random_.below(count) == 0; }
    template <class List>
    const typename List::value_type& any(const List& list) {
        return list[static_cast<std::size_t>(random_.below(static_cast<int>(list.size())))];
    }
    std::string kind(const std::string& name) {
        constexpr std::array<const char*, 4> kinds{"message", "control", "input", "silence"};
        if (oneIn(8)) return any(kinds);
        if (std::ranges::find(messageTable, name, &MessageDescription::name) != messageTable.end() &&
            !oneIn(3))
            return "message";
        return std::ranges::find(actionNames, name) != actionNames.end() ? "input" : "control";
    }

    double number() {
        constexpr std::array odd{0.0,   -0.0,   1.0,    -1.0,   2.0,   0.5,     1e-6, 1e-320,
                                 1e300, -1e300, 3.4e38, 1e-9,   64.0,  65.0,    1e6,  86'400.0,
                                 4e9,   9e15,   0.1,    3600.0, 1e-45, 20'000.0};
        if (oneIn(3)) return random_.uniform(0.0, 2.0);
        if (oneIn(3)) return random_.logUniform(1e-3, 1e5);
        return any(odd);
    }
    std::string word() {
        constexpr std::array words{"A",        "B",         "ZZ",    "now",  "layout",  "linear",   "energy",
                                   "alone",    "auto",      "equal", "wood", "ABA-250", "ABCDDCBA", "a.wav",
                                   "../x.wav", "/dev/zero", "on",    "1",    "stop",    "silence",  "hand",
                                   "\xff\xfe", "\n\x1b[2J", "{",     "%n%s"};
        if (oneIn(60)) return std::string(static_cast<std::size_t>(random_.below(5000)), 'A');
        return any(words);
    }
    PlainValue value() {
        if (oneIn(3)) return word();
        if (!oneIn(3)) return number();
        std::vector<double> numbers(static_cast<std::size_t>(random_.below(oneIn(20) ? 2000 : 8)));
        for (double& one : numbers) one = number();
        return numbers;
    }
    PlainValue valueOf(const MessageArgument& argument) {
        if (oneIn(6)) return value();
        if (argument.type == MessageArgument::Type::number) {
            if (oneIn(4)) return oneIn(2) ? argument.minimum : std::min(argument.maximum, 30.0);
            return random_.uniform(argument.minimum, std::min(argument.maximum, 500.0));
        }
        if (argument.type == MessageArgument::Type::text || oneIn(2)) return word();
        std::vector<double> numbers(static_cast<std::size_t>(2 * (1 + random_.below(6))));
        for (double& one : numbers) one = random_.uniform(0.0, 2.0);
        if (argument.type == MessageArgument::Type::numbers) std::ranges::sort(numbers);
        return numbers;
    }

    static std::string padded(std::string text) { return text.append(4 - text.size() % 4, '\0'); }
    static std::string big(std::uint64_t number, int bytes) {
        std::string text;
        for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
            text += static_cast<char>(number >> shift & 255U);
        return text;
    }
    std::string address(const std::string& name) {
        constexpr std::array patterns{
            "/physvib/*",           "/physvib/sil*", "/*/silence",       "/physvib/{silence,stop}",
            "/physvib/[a-z]ilence", "/physvib/sil[", "/?hysvib/silenc?", "//silence"};
        if (oneIn(12)) return any(patterns);
        if (oneIn(12)) return "/physvib/answer/" + name;
        if (oneIn(12)) return std::string{any(sensorFormats).address};
        if (oneIn(20)) return name;
        return "/physvib/" + name + (oneIn(20) ? "/" : "");
    }
    /// A number of any type that packets have.
    void add(double number, std::string& types, std::string& data) {
        switch (random_.below(8)) {
        case 0:
            types += 'i', data += big(static_cast<std::uint32_t>(static_cast<std::int32_t>(
                                          number > 2e9 || number < -2e9 ? 7.0 : number)),
                                      4);
            break;
        case 1: types += 'd', data += big(std::bit_cast<std::uint64_t>(number), 8); break;
        case 2:
            types += 'h', data += big(static_cast<std::uint64_t>(static_cast<std::int64_t>(
                                          number > 9e18 || number < -9e18 ? 7.0 : number)),
                                      8);
            break;
        case 3: types += number != 0.0 ? 'T' : 'F'; break;
        default: {
            const float narrow = std::abs(number) > 3.4e38 ? std::numeric_limits<float>::infinity()
                                                           : static_cast<float>(number);
            types += 'f', data += big(std::bit_cast<std::uint32_t>(narrow), 4);
        }
        }
    }
    std::string osc() {
        const PlainMessage plain = message();
        std::string types = ",", data;
        for (const NamedValue& one : plain.values) {
            if (!oneIn(30)) types += oneIn(10) ? 'S' : 's', data += padded(one.name.c_str());
            if (const auto* text = std::get_if<std::string>(&one.value))
                types += 's', data += padded(text->c_str());
            if (const auto* only = std::get_if<double>(&one.value)) add(*only, types, data);
            if (const auto* list = std::get_if<std::vector<double>>(&one.value))
                for (const double item : *list) add(item, types, data);
        }
        if (oneIn(25))
            types += "bNIcmtr[]"[random_.below(9)],
                data += big(static_cast<std::uint64_t>(random_.below(9)), 8);
        return padded(address(plain.name)) + padded(types) + data;
    }
    std::string bundle(int depth) {
        constexpr std::array<OscTag, 6> tags{
            oscNow, 0, 2, ~OscTag{0}, OscTag{oscEpochSeconds + 1} << 32, OscTag{oscEpochSeconds + 60} << 32};
        std::string bytes = padded("#bundle") + big(any(tags), 8);
        for (int count = random_.below(4); count > 0; --count) {
            const std::string element = depth < 20 && oneIn(4) ? bundle(depth + 1) : osc();
            bytes +=
                big(oneIn(40) ? static_cast<std::uint64_t>(random_.below(200)) : element.size(), 4) + element;
        }
        return bytes;
    }

    /// One in six is cut, or has other bytes.
    std::string broken(std::string bytes) {
        if (!oneIn(6) || bytes.empty()) return bytes;
        const auto at = static_cast<std::size_t>(random_.below(static_cast<int>(bytes.size())));
        switch (random_.below(4)) {
        case 0: bytes.resize(at); break;
        case 1: bytes[at] = static_cast<char>(random_.below(256)); break;
        case 2: bytes.insert(at, 1, static_cast<char>(random_.below(256))); break;
        default: bytes.insert(at, bytes.substr(at / 2, 40)); break;
        }
        return bytes;
    }

    Random random_;
    std::vector<std::string> names_, fields_;
    std::vector<const MessageArgument*> arguments_;
};

} // namespace physvib::test
