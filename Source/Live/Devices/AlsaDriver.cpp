// SPDX-License-Identifier: MIT
// Reads ALSA's list of devices.
#include "Live/Devices/AlsaDriver.h"
#include "Live/Devices/AlsaDevice.h"
#include <algorithm>
#include <cstdlib>
#include <map>

namespace physvib {
namespace {

// Variants of devices that are listed anyway, and what plays nowhere.
bool isLeftOut(const std::string& id) {
    return id.empty() || id == "null" || id.starts_with("default:") || id.starts_with("sysdefault:") ||
           id.starts_with("plughw:");
}

std::string inOneLine(const std::string& text) {
    std::string line;
    for (const char c : text) line += c == '\n' ? std::string{"; "} : std::string{c};
    return line;
}

} // namespace

std::string AlsaDriver::hintText(const void* hint, const char* kind) const {
    char* const text = alsa_.device_name_get_hint(hint, kind);
    std::string found = text != nullptr ? text : "";
    std::free(text);
    return found;
}

void AlsaDriver::addHint(const void* hint) {
    const std::string id = hintText(hint, "NAME"), direction = hintText(hint, "IOID");
    if (isLeftOut(id)) return;
    std::string name = inOneLine(hintText(hint, "DESC"));
    if (name.empty()) name = id;
    // ALSA says of dmix and dsnoop that they have both directions, but they have one each.
    if (direction != "Output" && !id.starts_with("dmix")) inputs_.push_back({id, name});
    if (direction != "Input" && !id.starts_with("dsnoop")) outputs_.push_back({id, name});
}

void AlsaDriver::addUnlisted(const std::string& id, const std::string& name) {
    if (std::ranges::find(outputs_, id, &Listed::id) != outputs_.end()) return;
    const auto offers = [&](snd_pcm_stream_t direction) {
        const AlsaRange range = AlsaPcm{alsa_, id, direction}.range();
        return range.maxChannels > 0 && range.rateHz > 0;
    };
    if (offers(SND_PCM_STREAM_PLAYBACK)) outputs_.push_back({id, name + " output"});
    if (offers(SND_PCM_STREAM_CAPTURE)) inputs_.push_back({id, name + " input"});
}

void AlsaDriver::scan() {
    inputs_.clear();
    outputs_.clear();
    void** hints = nullptr;
    if (alsa_.device_name_hint(-1, "pcm", &hints) == 0) {
        for (void** hint = hints; *hint != nullptr; ++hint) addHint(*hint);
        alsa_.device_name_free_hint(hints);
    }
    addUnlisted("default", "Default ALSA");
    addUnlisted("pulse", "Pulseaudio");
    for (List* list : {&inputs_, &outputs_}) {
        const auto rank = [](const Listed& l) { return l.id == "default" ? 0 : l.id == "pulse" ? 1 : 2; };
        std::ranges::stable_sort(*list, {}, rank);
        std::map<std::string, int> total, seen;
        for (const Listed& l : *list) ++total[l.name];
        for (Listed& l : *list)
            if (const std::string name = l.name; total[name] > 1)
                l.name += " (" + std::to_string(++seen[name]) + ")";
    }
}

std::vector<std::string> AlsaDriver::deviceNames(bool inputs) {
    std::vector<std::string> names;
    for (const Listed& l : inputs ? inputs_ : outputs_) names.push_back(l.name);
    return names;
}

std::string AlsaDriver::idOf(const List& list, const std::string& name) {
    const auto at = std::ranges::find(list, name, &Listed::name);
    return at != list.end() ? at->id : "";
}

std::unique_ptr<AudioDevice> AlsaDriver::create(const std::string& name, bool withInputs) {
    const std::string id = idOf(outputs_, name);
    if (id.empty()) return nullptr;
    return std::make_unique<AlsaDevice>(alsa_, name, id, withInputs ? idOf(inputs_, name) : "");
}

} // namespace physvib
