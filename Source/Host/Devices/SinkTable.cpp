// SPDX-License-Identifier: GPL-3.0-or-later
// The table, and how its names are read.
#include "Host/Devices/SinkTable.h"
#include "Core/Limits.h"
#include "Host/Devices/NoDevice.h"
#include "Live/Pads/PadOutput.h"
#include "Live/Session/BoardOutput.h"
#include <algorithm>
#include <array>

namespace physvib {
namespace {

struct SinkKind {
    std::string_view name;
    int channels;             // 0: as many as there are
    std::string_view tooMany; // more enchanters than that
    std::unique_ptr<Sink> (*make)(const std::string& where, const PhantomPanner& panner);
};

const std::array sinkKinds{
    SinkKind{"BOARD", limits::board::channels, "board: expected at most four actuators",
             [](const std::string& where, const PhantomPanner& panner) -> std::unique_ptr<Sink> {
                 return std::make_unique<BoardOutput>(where, panner);
             }},
    SinkKind{"PAD",
             0,
             {},
             [](const std::string& where, const PhantomPanner& panner) -> std::unique_ptr<Sink> {
                 return std::make_unique<PadOutput>(where, panner);
             }},
};

const SinkKind& kindOf(const SinkName& sink) {
    return *std::ranges::find(sinkKinds, std::string_view{sink.kind}, &SinkKind::name);
}

// Where the last sink of `text` begins; npos: there is none.
std::size_t lastSink(std::string_view text, const SinkKind*& kind) {
    std::size_t last = text.npos;
    for (const SinkKind& one : sinkKinds) {
        const std::string mark = std::string(one.name) + ":";
        const std::size_t behind = text.rfind("+" + mark),
                          at = behind == text.npos && text.starts_with(mark) ? 0 : behind;
        if (at != text.npos && (last == text.npos || at >= last)) last = at, kind = &one;
    }
    return last;
}

} // namespace

OutputNames::OutputNames(std::string_view text) {
    const SinkKind* kind = nullptr;
    bool hasSinks = false;
    for (std::size_t at = lastSink(text, kind); at != text.npos; at = lastSink(text, kind)) {
        const auto where = text.substr(text.find(':', at) + 1);
        if (!where.empty()) sinks.insert(sinks.begin(), {std::string(kind->name), std::string(where)});
        text = text.substr(0, at);
        hasSinks = true;
    }
    device = hasSinks && text.empty() ? std::string(noDeviceType) + ":" + noDeviceName : std::string(text);
}

std::string channelFault(const std::vector<SinkName>& sinks, int channels) {
    for (const SinkName& sink : sinks)
        if (const SinkKind& kind = kindOf(sink); kind.channels > 0 && channels > kind.channels)
            return std::string(kind.tooMany);
    return {};
}

std::string openSinks(const std::vector<SinkName>& wanted, const PhantomPanner& panner,
                      const std::function<bool()>& goesOn, Sinks& opened) {
    if (wanted.size() > mostNamedSinks)
        return "expected at most " + std::to_string(mostNamedSinks) + " outputs beside the device, found " +
               std::to_string(wanted.size());
    for (const SinkName& sink : wanted) {
        opened.push_back(kindOf(sink).make(sink.where, panner));
        if (auto fault = opened.back()->awaitReady(goesOn); !fault.empty()) return fault;
    }
    return {};
}

} // namespace physvib
