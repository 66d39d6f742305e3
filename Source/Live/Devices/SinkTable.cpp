// SPDX-License-Identifier: MIT
// The table of sinks, and the parser of output names such as DEVICE+BOARD:auto.
#include "Live/Devices/SinkTable.h"
#include "Live/Pads/CoilFeed.h"
#include "Live/Pads/PadOutput.h"
#include "Live/Pads/ToneFeed.h"
#include "Live/Session/BoardOutput.h"

namespace physvib {
namespace {

std::vector<SinkUnit> listBoardPorts() {
    std::vector<SinkUnit> units;
    for (const SerialPortName& port : listSerialPorts())
        units.push_back({port.path, port.description, port.isLikelyBoard});
    return units;
}

std::vector<SinkUnit> listGamePads() {
    std::vector<SinkUnit> units;
    for (const GamePadInfo& pad : GamePads{}.list())
        if (std::ranges::find(units, pad.name, &SinkUnit::address) == units.end())
            units.push_back({pad.name, {}, pad.hasMotors});
    return units;
}

// USB vendor and product ids of Sony's DualSense and DualSense Edge, and Valve's Steam Controller of 2026.
constexpr std::array dualSenseModels{HidModel{0x054C, 0x0CE6, PadBus::bluetooth},
                                     HidModel{0x054C, 0x0DF2, PadBus::bluetooth}};
constexpr std::array steamModels{HidModel{0x28DE, 0x1302, PadBus::usb}};
// Nintendo's left and right Joy-Con and Pro Controller, connected by cable or radio.
constexpr std::array switchModels{HidModel{0x057E, 0x2006, PadBus::other},
                                  HidModel{0x057E, 0x2007, PadBus::other},
                                  HidModel{0x057E, 0x2009, PadBus::other}};
constexpr HidFeedKind dualSenseKind{dualSenseModels, "DualSense by Bluetooth"},
    steamKind{steamModels, "Steam Controller (2026)"}, switchKind{switchModels, "Switch controller"};

template <const HidFeedKind& kind>
std::vector<SinkUnit> listHidPads() {
    std::vector<SinkUnit> units;
    for (const HidNode& pad : HidDevice::list(kind.models)) units.push_back({pad.path.string(), pad.name});
    return units;
}

template <const HidFeedKind& kind, const CoilFormat& (*format)()>
std::unique_ptr<Sink> makeCoilOutput(const std::string& address, const PhantomPanner& panner) {
    return std::make_unique<HidOutput>(address, std::make_unique<CoilFeed>(kind, format(), panner));
}

std::unique_ptr<Sink> makeToneOutput(const std::string& address, const PhantomPanner& panner) {
    return std::make_unique<HidOutput>(address, std::make_unique<ToneFeed>(switchKind, panner));
}

template <class Output>
std::unique_ptr<Sink> makeOutput(const std::string& address, const PhantomPanner& panner) {
    return std::make_unique<Output>(address, panner);
}

/// The entry of a controller with two motors or coils; "auto" finds the first one.
constexpr SinkKind padKind(std::string_view name, std::string_view title, std::string_view tooltip,
                           std::string_view settingKey, decltype(SinkKind::listUnits) listUnits,
                           decltype(SinkKind::makeSink) make, bool acceptsRawReports = true) {
    return {name, title, tooltip, settingKey, anyPad, {}, 2, {}, false, listUnits, make, acceptsRawReports};
}

constinit const std::array sinkTable{
    SinkKind{"BOARD", "Four-channel board", "It plays the first four actuators beside the device", "board",
             anyBoard, "Serial port", limits::board::channels, "board: expected at most four actuators", true,
             listBoardPorts, makeOutput<BoardOutput>},
    padKind("PAD", "Game controller", "Its two motors follow all hits, felt together with the device",
            "controller", listGamePads, makeOutput<PadOutput>, false),
    padKind("DUALSENSE", "DualSense by Bluetooth",
            "Its two coils play the session's samples, up to 18 ms after the device", "dualsense",
            listHidPads<dualSenseKind>, makeCoilOutput<dualSenseKind, dualSenseSamples>),
    padKind("STEAM", "Steam Controller (2026)",
            "Its coils play the session's samples, up to 8 ms after the device", "steam",
            listHidPads<steamKind>, makeCoilOutput<steamKind, steamSamples>),
    padKind("SWITCH", "Switch controller",
            "Two tones on either side follow all hits, felt together with the device", "switch",
            listHidPads<switchKind>, makeToneOutput),
};

// Index at which the last sink of `text` starts, and its kind; npos: there is none.
std::size_t sinkStart(std::string_view text, const SinkKind*& kind) {
    std::size_t last = text.npos;
    for (const SinkKind& candidate : sinkTable) {
        const std::string prefix = std::string(candidate.name) + ":";
        const std::size_t plusAt = text.rfind("+" + prefix),
                          start = plusAt == text.npos && text.starts_with(prefix) ? 0 : plusAt;
        if (start != text.npos && (last == text.npos || start >= last)) last = start, kind = &candidate;
    }
    return last;
}

} // namespace

std::span<const SinkKind> sinkKinds() noexcept { return sinkTable; }

const SinkKind& findSinkKind(const SinkName& sink) noexcept {
    return *std::ranges::find(sinkTable, std::string_view{sink.kind}, &SinkKind::name);
}

OutputNames::OutputNames(std::string_view text) {
    const SinkKind* kind = nullptr;
    bool hasSinks = false;
    for (std::size_t start = sinkStart(text, kind); start != text.npos; start = sinkStart(text, kind)) {
        const auto address = text.substr(text.find(':', start) + 1);
        if (!address.empty()) sinks.insert(sinks.begin(), {std::string(kind->name), std::string(address)});
        text = text.substr(0, start);
        hasSinks = true;
    }
    device =
        hasSinks && text.empty() ? std::string(nullDeviceType) + ":" + nullDeviceName : std::string(text);
}

std::string channelCountError(const std::vector<SinkName>& sinks, int channels) {
    for (const SinkName& sink : sinks)
        if (const SinkKind& kind = findSinkKind(sink);
            !kind.tooManyActuatorsError.empty() && channels > kind.actuators)
            return std::string(kind.tooManyActuatorsError);
    return {};
}

std::string openSinks(const std::vector<SinkName>& names, const PhantomPanner& panner,
                      const std::function<bool()>& keepGoing, Sinks& opened) {
    if (names.size() > maxNamedSinks)
        return "expected at most " + std::to_string(maxNamedSinks) + " outputs beside the device, found " +
               std::to_string(names.size());
    for (const SinkName& sink : names) {
        opened.push_back(findSinkKind(sink).makeSink(sink.address, panner));
        if (!keepGoing) continue;
        if (auto error = opened.back()->awaitReady(keepGoing); !error.empty()) return error;
    }
    return {};
}

} // namespace physvib
