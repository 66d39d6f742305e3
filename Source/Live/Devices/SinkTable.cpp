// SPDX-License-Identifier: MIT
// The table of sinks, and the parser of output names such as DEVICE+BOARD:auto.
#include "Live/Devices/SinkTable.h"
#include "Live/Pads/CoilFeed.h"
#include "Live/Pads/PadOutput.h"
#include "Live/Pads/ToneFeed.h"
#include "Live/Session/BoardOutput.h"

namespace physvib {
namespace {

std::vector<SinkPlace> serialPorts() {
    std::vector<SinkPlace> places;
    for (const SerialPortName& port : listSerialPorts())
        places.push_back({port.path, port.description, port.isLikelyBoard});
    return places;
}

std::vector<SinkPlace> gamePads() {
    std::vector<SinkPlace> places;
    for (const GamePadInfo& pad : GamePads{}.list())
        if (std::ranges::find(places, pad.name, &SinkPlace::where) == places.end())
            places.push_back({pad.name, {}, pad.hasMotors});
    return places;
}

// Sony's DualSense and DualSense Edge; Valve's controller of 2026 by its cable.
constexpr std::array dualSenses{HidModel{0x054C, 0x0CE6, PadBus::bluetooth},
                                HidModel{0x054C, 0x0DF2, PadBus::bluetooth}};
constexpr std::array steamControllers{HidModel{0x28DE, 0x1302, PadBus::usb}};
// Nintendo's Joy-Cons, left and right, and Pro Controller, whichever way the kernel's driver has them.
constexpr std::array switches{HidModel{0x057E, 0x2006, PadBus::other},
                              HidModel{0x057E, 0x2007, PadBus::other},
                              HidModel{0x057E, 0x2009, PadBus::other}};
constexpr HidFeedKind dualSense{dualSenses, "DualSense by Bluetooth"},
    steam{steamControllers, "Steam Controller (2026)"}, nintendo{switches, "Switch controller"};

template <const HidFeedKind& kind>
std::vector<SinkPlace> hidPads() {
    std::vector<SinkPlace> places;
    for (const HidPlace& pad : HidDevice::list(kind.models)) places.push_back({pad.node.string(), pad.name});
    return places;
}

template <const HidFeedKind& kind, const CoilFormat& (*format)()>
std::unique_ptr<Sink> coils(const std::string& where, const PhantomPanner& panner) {
    return std::make_unique<HidOutput>(where, std::make_unique<CoilFeed>(kind, format(), panner));
}

std::unique_ptr<Sink> tones(const std::string& where, const PhantomPanner& panner) {
    return std::make_unique<HidOutput>(where, std::make_unique<ToneFeed>(nintendo, panner));
}

template <class Output>
std::unique_ptr<Sink> plain(const std::string& where, const PhantomPanner& panner) {
    return std::make_unique<Output>(where, panner);
}

/// The entry of a controller with two motors or coils, which is found without a name.
constexpr SinkKind pad(std::string_view name, std::string_view title, std::string_view about,
                       std::string_view setting, decltype(SinkKind::places) places,
                       decltype(SinkKind::make) make, bool takesReports = true) {
    return {name, title, about, setting, anyPad, {}, 2, {}, false, places, make, takesReports};
}

constinit const std::array allKinds{
    SinkKind{"BOARD", "Four-channel board", "It plays the first four actuators beside the device", "board",
             anyBoard, "Serial port", limits::board::channels, "board: expected at most four actuators", true,
             serialPorts, plain<BoardOutput>},
    pad("PAD", "Game controller", "Its two motors follow all hits, felt together with the device",
        "controller", gamePads, plain<PadOutput>, false),
    pad("DUALSENSE", "DualSense by Bluetooth",
        "Its two coils play the session's samples, up to 18 ms after the device", "dualsense",
        hidPads<dualSense>, coils<dualSense, dualSenseSamples>),
    pad("STEAM", "Steam Controller (2026)",
        "Its coils play the session's samples, up to 8 ms after the device", "steam", hidPads<steam>,
        coils<steam, steamSamples>),
    pad("SWITCH", "Switch controller",
        "Two tones on either side follow all hits, felt together with the device", "switch",
        hidPads<nintendo>, tones),
};

// Position where the last sink of `text` starts; npos: there is none.
std::size_t lastSink(std::string_view text, const SinkKind*& kind) {
    std::size_t last = text.npos;
    for (const SinkKind& one : allKinds) {
        const std::string mark = std::string(one.name) + ":";
        const std::size_t behind = text.rfind("+" + mark),
                          at = behind == text.npos && text.starts_with(mark) ? 0 : behind;
        if (at != text.npos && (last == text.npos || at >= last)) last = at, kind = &one;
    }
    return last;
}

} // namespace

std::span<const SinkKind> sinkKinds() noexcept { return allKinds; }

const SinkKind& kindOf(const SinkName& sink) noexcept {
    return *std::ranges::find(allKinds, std::string_view{sink.kind}, &SinkKind::name);
}

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
        if (const SinkKind& kind = kindOf(sink); !kind.tooMany.empty() && channels > kind.actuators)
            return std::string(kind.tooMany);
    return {};
}

std::string openSinks(const std::vector<SinkName>& wanted, const PhantomPanner& panner,
                      const std::function<bool()>& keepGoing, Sinks& opened) {
    if (wanted.size() > mostNamedSinks)
        return "expected at most " + std::to_string(mostNamedSinks) + " outputs beside the device, found " +
               std::to_string(wanted.size());
    for (const SinkName& sink : wanted) {
        opened.push_back(kindOf(sink).make(sink.where, panner));
        if (!keepGoing) continue;
        if (auto fault = opened.back()->awaitReady(keepGoing); !fault.empty()) return fault;
    }
    return {};
}

} // namespace physvib
